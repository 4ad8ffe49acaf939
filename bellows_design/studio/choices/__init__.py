"""What may be chosen on the page, and the design that the choices make."""
