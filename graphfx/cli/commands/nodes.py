"""`graphfx nodes`: what node types there are, and all about one."""

from __future__ import annotations

import json

import click

from graphfx.cli.failure import show
from graphfx.cli.options import debug, library
from graphfx.errors import EXIT_GRAPH, Problem, UsageError, suggestion


@click.command()
@click.argument("name", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@library
@debug
@click.pass_context
def command(context: click.Context, name: str | None, as_json: bool, library: tuple[str, ...]) -> None:
    """List the node types, or describe one.

    With NAME: what it does, its parameters with units and ranges, and a graph that runs. A word that is no
    node type finds those whose text has it.
    """
    from graphfx.cli.node_docs import describe, load_all, mentions, node_data, table
    from graphfx.node import Library, library_roots

    nodes = Library(library_roots(library))
    if name is not None and name in nodes:
        click.echo(json.dumps(node_data(nodes[name], nodes), indent=2) if as_json else describe(nodes[name], nodes))
        return
    types, problems = load_all(nodes)
    if name is not None:
        found = mentions(name, types)
        hint = " These speak of it:" if found else " 'graphfx nodes' lists them"
        raise UsageError(Problem(f"there is no node type '{name}'.{suggestion(name, nodes)}{hint}", notes=tuple(found)))
    click.echo(json.dumps([node_data(types[each], nodes) for each in sorted(types)], indent=2) if as_json else table(types))
    if problems:
        show(problems)
        context.exit(EXIT_GRAPH)
