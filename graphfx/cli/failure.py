"""From whatever goes wrong to a plain message on stderr and an exit code."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import click
from click import exceptions

from graphfx.cli.options import Settings
from graphfx.cli.stopping import exit_code, say, stoppable
from graphfx.errors import EXIT_BUG, EXIT_LIMIT, EXIT_OK, EXIT_USAGE, GraphfxError, Problem, suggestion

EXIT_PIPE = 141
"""Whoever read the output has gone, as a shell reports it: 128 + SIGPIPE."""


def carry_out(command: click.Command, arguments: list[str]) -> int:
    """Run a command line; print what goes wrong, and return the exit code."""
    settings = Settings()
    try:
        try:
            with stoppable(), command.make_context("graphfx", arguments, obj=settings) as context:
                command.invoke(context)
        finally:
            sys.stdout.flush()
    except exceptions.Exit as end:
        return end.exit_code
    except BrokenPipeError:
        return _leave_quietly()
    except (KeyboardInterrupt, click.Abort) as stop:
        say("stopped")
        return exit_code(stop)
    except exceptions.UsageError as error:
        click.echo(usage_message(error), err=True)
        return EXIT_USAGE
    except Exception as error:
        if settings.debug:
            traceback.print_exc()
        return _tell(error)
    return EXIT_OK


def show(problems: Iterable[Problem]) -> None:
    """Print problems, one after another."""
    for problem in problems:
        place = problem.location
        click.echo(str(replace(problem, location=replace(place, file=from_here(place.file)))), err=True)


def from_here(file: str) -> str:
    """Return a file as one would type it here: relative where it lies below the current folder."""
    path = Path(file)
    return str(path.relative_to(Path.cwd())) if path.is_absolute() and path.is_relative_to(Path.cwd()) else file


def _tell(error: Exception) -> int:
    if not isinstance(error, GraphfxError):
        from graphfx.node.mistakes import in_a_node

        error = in_a_node(error) or error
    if isinstance(error, GraphfxError):
        show(error.problems)
        return error.exit_code
    if isinstance(error, MemoryError):
        click.echo(f"there is not enough memory{f': {error}' if str(error) else ''}", err=True)
        return EXIT_LIMIT
    place = traceback.extract_tb(error.__traceback__)[-1]
    said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    where = f"{Path(place.filename).name}:{place.lineno}"
    click.echo(f"graphfx itself is wrong: {said} ({where}); run with --debug to see where", err=True)
    return EXIT_BUG


def usage_message(error: exceptions.UsageError) -> str:
    """Return what is wrong with a command line, with a suggestion for a mistyped option."""
    command = error.ctx.command_path if error.ctx else "graphfx"
    if isinstance(error, exceptions.NoSuchOption):
        known = [name for parameter in error.ctx.command.params for name in parameter.opts] if error.ctx else []
        message = f"there is no option '{error.option_name}'.{suggestion(error.option_name, [*known, '--help'])}"
    elif isinstance(error, exceptions.MissingParameter) and error.param is not None:
        message = f"{error.param.human_readable_name} is missing"
    elif isinstance(error, exceptions.BadParameter) and error.param is not None:
        message = f"{error.param.opts[0]}: {error.message}"
    else:
        message = error.format_message()
    return f"{command}: {message}\n  '{command} --help' says what it takes"


def _leave_quietly() -> int:
    """Let go of an output that nobody reads, so that Python does not complain of it at its end."""
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, sys.stdout.fileno())
    return EXIT_PIPE
