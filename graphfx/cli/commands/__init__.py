"""One command a file, named as the command; what it needs of the engine it imports when it runs."""
