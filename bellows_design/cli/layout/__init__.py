"""How the command line presents itself: panels of the help, examples, sentences on mistakes."""
