"""The command `graphfx`."""

from __future__ import annotations

import importlib
import os
import pkgutil
import sys
from collections.abc import Sequence
from typing import Any

import click

import graphfx
from graphfx.cli import commands
from graphfx.cli.failure import carry_out
from graphfx.cli.options import debug
from graphfx.errors import suggestion

COMPLETION = "_GRAPHFX_COMPLETE"
"""Set by the shell when it asks for completions."""


class Commands(click.Group):
    """A group whose commands are the files of a folder; `contact-sheet` is contact_sheet.py."""

    def list_commands(self, context: click.Context) -> list[str]:
        """Return the names of the commands."""
        return sorted(module.name.replace("_", "-") for module in pkgutil.iter_modules(commands.__path__))

    def get_command(self, context: click.Context, name: str) -> click.Command | None:
        """Import a command's file."""
        if name not in self.list_commands(context):
            return None
        command: click.Command = importlib.import_module(f"{commands.__name__}.{name.replace('-', '_')}").command
        command.name = name
        return command

    def resolve_command(self, context: click.Context, arguments: list[str]) -> Any:
        """Find the command that the first argument names."""
        names = self.list_commands(context)
        if not arguments[0].startswith("-") and arguments[0] not in names:
            raise click.UsageError(f"there is no command '{arguments[0]}'.{suggestion(arguments[0], names)}", context)
        return super().resolve_command(context, arguments)

    def main(self, args: Sequence[str] | None = None, prog_name: str | None = None, **options: Any) -> Any:  # type: ignore[override]
        """Run the command and leave the process with its exit code."""
        if COMPLETION in os.environ:
            return super().main(args, prog_name, complete_var=COMPLETION, **options)
        sys.exit(carry_out(self, list(sys.argv[1:] if args is None else args)))


@click.group(cls=Commands, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(graphfx.__version__, prog_name="graphfx", message="%(prog)s %(version)s")
@debug
@click.pass_context
def main(context: click.Context) -> None:
    """Particle effects as node graphs, cooked headless.

    \b
    graphfx cook effect.json --frames 1-48
    graphfx nodes vortex

    Exit codes: 0 done, 1 a graph or node is wrong, 2 the command line is wrong, 3 an output cannot be
    written, 4 a limit was reached, 5 the cook failed, 70 graphfx itself is wrong, 130 stopped by Ctrl-C,
    128 + N by signal N.
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())
