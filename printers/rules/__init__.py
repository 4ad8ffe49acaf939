"""One file for each family of rules; every rule turns measurements into results."""
