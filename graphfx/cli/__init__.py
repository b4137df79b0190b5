"""The command `graphfx`: every file of `commands` is one, imported only when it is asked for."""
