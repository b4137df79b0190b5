"""`graphfx schema`: the JSON Schema of graphs, for editors."""

from __future__ import annotations

import json

import click

from graphfx.cli.options import debug, library


@click.command()
@click.option("--out", metavar="FILE", help="Write it to a file instead of printing it.")
@library
@debug
def command(out: str | None, library: tuple[str, ...]) -> None:
    """Print the JSON Schema of graphs.

    With it editors complete and check node types and parameters.
    """
    from graphfx.graph.schema import schema
    from graphfx.node import Library, library_roots

    text = json.dumps(schema(Library(library_roots(library))), indent=2) + "\n"
    if out is None:
        click.echo(text, nl=False)
        return
    from graphfx.output.atomic import whole_file

    with whole_file(out) as stream:
        stream.write(text.encode())
