"""`graphfx plan`: what will run, and what was left out."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TYPE_CHECKING

import click

from graphfx.cli.options import debug, library, parameters

if TYPE_CHECKING:
    from graphfx.program import Function


@click.command()
@click.argument("graph")
@click.option("--source", is_flag=True, help="Show the generated source of every kernel too.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@parameters
@library
@debug
def command(graph: str, source: bool, as_json: bool, parameters: dict[str, str], library: tuple[str, ...]) -> None:
    """Show what GRAPH will run and what it leaves out.

    Nodes with the reason why any was dropped, bytes per particle, how the motion is computed, and the
    programs, a line for each instruction: results = function operands [mask] ; node.
    """
    from graphfx.cook.pilot import planned
    from graphfx.graph.flatten import flatten
    from graphfx.node import Library, library_roots
    from graphfx.plan.listing import listing, plan_data

    plan = planned(flatten(graph, Library(library_roots(library)), parameters))
    if as_json:
        click.echo(json.dumps(plan_data(plan), indent=2))
        return
    click.echo(listing(plan, _kernel_source(plan.precision) if source else None))


def _kernel_source(precision: int) -> Callable[[Function], str]:
    from graphfx.lanes.memory import FLOAT_LANES
    from graphfx.machine.kernels import DTYPES, kernel_source

    lanes = FLOAT_LANES[DTYPES[precision]]
    return lambda function: kernel_source(function, 1 if function.branches else lanes)[0]
