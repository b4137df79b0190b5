"""`graphfx check`: tell everything that is wrong with graphs."""

from __future__ import annotations

import click

from graphfx.cli.failure import show
from graphfx.cli.options import debug, library
from graphfx.errors import GraphfxError, Problem


@click.command()
@click.argument("graphs", metavar="GRAPH...", nargs=-1, required=True)
@library
@debug
@click.pass_context
def command(context: click.Context, graphs: tuple[str, ...], library: tuple[str, ...]) -> None:
    """Tell everything that is wrong with graphs.

    Nothing is cooked. Each problem has its place in the file. Exits with 1 if there are any.
    """
    code = 0
    for graph in graphs:
        try:
            problems = problems_of(graph, library)
            code = max(code, 1 if problems else 0)
        except GraphfxError as error:
            problems = error.problems
            code = max(code, error.exit_code)
        show(problems)
        if not problems:
            click.echo(f"{graph}: nothing is wrong")
    context.exit(code)


def problems_of(graph: str, library: tuple[str, ...]) -> list[Problem]:
    """Return what is wrong with a graph: first with the document, then, if it can stand alone, with planning it."""
    from graphfx.cook.checks import problems_before
    from graphfx.graph.check import check
    from graphfx.graph.document import load_document
    from graphfx.graph.flatten import flatten
    from graphfx.node import Library, library_roots
    from graphfx.plan.make import make_plan

    nodes = Library(library_roots(library))
    document = load_document(graph)
    problems = check(document, nodes)
    data = document.root.data()
    if problems or "inputs" in data or "outputs" in data:
        return problems
    if any("default" not in parameter for parameter in data.get("params", {}).values()):
        return []
    try:
        return problems_before(make_plan(flatten(document, nodes)))
    except GraphfxError as error:
        return error.problems
