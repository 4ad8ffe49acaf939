"""The report as pictures: a contact sheet, and pages."""
