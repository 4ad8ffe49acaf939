"""HTTP and the websocket of the studio, bound to this machine alone."""
