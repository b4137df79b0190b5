"""`graphfx format`: bring graphs into their one canonical form."""

from __future__ import annotations

from pathlib import Path

import click

from graphfx.cli.failure import show
from graphfx.cli.options import debug, library
from graphfx.errors import GraphfxError, UsageError


@click.command()
@click.argument("graphs", metavar="GRAPH...", nargs=-1, required=True)
@click.option("--write", is_flag=True, help="Change the files themselves.")
@click.option("--check", is_flag=True, help="Change nothing; exit with 1 if a file is not in its canonical form.")
@library
@debug
@click.pass_context
def command(context: click.Context, graphs: tuple[str, ...], write: bool, check: bool, library: tuple[str, ...]) -> None:
    """Print graphs in their canonical form.

    Keys in order, defaults left out; what a graph means does not change.
    """
    if write and check:
        raise UsageError("--write changes files and --check does not; give one of them")
    code = 0
    for graph in graphs:
        try:
            code = max(code, _format(graph, write, check, library))
        except GraphfxError as error:
            show(error.problems)
            code = max(code, error.exit_code)
    context.exit(code)


def _format(graph: str, write: bool, check: bool, library: tuple[str, ...]) -> int:
    from graphfx.graph.document import load_document
    from graphfx.graph.format import canonical
    from graphfx.node import Library, library_roots

    text = canonical(load_document(graph), Library(library_roots(library)))
    if not (write or check):
        click.echo(text, nl=False)
        return 0
    if Path(graph).read_bytes() == text.encode():
        return 0
    if check:
        click.echo(f"{graph}: not in canonical form; 'graphfx format --write {graph}' mends it")
        return 1
    from graphfx.output.atomic import whole_file

    with whole_file(graph) as stream:
        stream.write(text.encode())
    click.echo(f"{graph}: formatted")
    return 0
