"""`graphfx nodes`: what node types there are, and all about one."""

from __future__ import annotations

import click

from graphfx.cli.options import debug, library
from graphfx.errors import UsageError, suggestion


@click.command()
@click.argument("name", required=False)
@library
@debug
def command(name: str | None, library: tuple[str, ...]) -> None:
    """List the node types, or describe one.

    With NAME: what it does, its parameters with units and ranges, and a graph that runs.
    """
    from graphfx.cli.node_docs import describe, table
    from graphfx.node import Library, library_roots

    nodes = Library(library_roots(library))
    if name is None:
        click.echo(table(nodes))
        return
    if name not in nodes:
        raise UsageError(f"there is no node type '{name}'.{suggestion(name, nodes)} 'graphfx nodes' lists them")
    click.echo(describe(nodes[name], nodes))
