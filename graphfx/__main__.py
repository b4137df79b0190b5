"""`python -m graphfx` is the command `graphfx`."""

from graphfx.cli.main import main

main()
