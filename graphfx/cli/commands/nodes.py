"""`graphfx nodes`: what node types there are, and all about one."""

from __future__ import annotations

import json

import click

from graphfx.cli.options import debug, library
from graphfx.errors import Problem, UsageError, suggestion


@click.command()
@click.argument("name", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@library
@debug
def command(name: str | None, as_json: bool, library: tuple[str, ...]) -> None:
    """List the node types, or describe one.

    With NAME: what it does, its parameters with units and ranges, and a graph that runs. A word that is no
    node type finds those whose text has it.
    """
    from graphfx.cli.node_docs import describe, mentions, node_data, table
    from graphfx.node import Library, library_roots

    nodes = Library(library_roots(library))
    if name is not None and name not in nodes:
        found = mentions(name, nodes)
        hint = " These speak of it:" if found else " 'graphfx nodes' lists them"
        raise UsageError(Problem(f"there is no node type '{name}'.{suggestion(name, nodes)}{hint}", notes=tuple(found)))
    if as_json:
        named = [name] if name is not None else sorted(nodes)
        data = [node_data(nodes[each], nodes) for each in named]
        click.echo(json.dumps(data[0] if name is not None else data, indent=2))
    else:
        click.echo(table(nodes) if name is None else describe(nodes[name], nodes))
