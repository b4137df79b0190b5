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
    """List the node types and groups, or describe one.

    With NAME: what it does, its parameters with units and ranges, and a graph that runs. A word that is no
    node type finds those whose text has it.
    """
    from graphfx.cli.group_docs import describe_group, group_data, group_lines, group_texts, groups_of
    from graphfx.cli.node_docs import describe, load_all, mentions, node_data, table, texts_of
    from graphfx.cli.value_docs import describe_value, value_lines, value_texts
    from graphfx.cli.word_docs import TOPIC, attribute_lines, describe_attributes
    from graphfx.graph.names import VALUE_KEYS
    from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES, OTHER_NAMES, Library, library_roots

    nodes = Library(library_roots(library))
    if name is not None and name in nodes:
        click.echo(json.dumps(node_data(nodes[name], nodes), indent=2) if as_json else describe(nodes[name], nodes))
        return
    types, problems = load_all(nodes)
    groups = groups_of(nodes)
    if name is not None and name in groups:
        click.echo(json.dumps(group_data(groups[name]), indent=2) if as_json else describe_group(groups[name], nodes))
        return
    if name in VALUE_KEYS and not as_json:
        click.echo(describe_value(str(name), nodes))
        return
    if name == TOPIC:
        click.echo(describe_attributes())
        return
    attribute = OTHER_NAMES.get(str(name), str(name))
    if attribute in {**ATTRIBUTES, **DERIVED_ATTRIBUTES}:
        click.echo("\n".join([*attribute_lines((attribute,)), f"an attribute of particles; 'graphfx nodes {TOPIC}' lists all"]))
        return
    if name is not None:
        found = mentions(name, texts_of(types) | value_texts() | group_texts(groups))
        near = suggestion(name, [*nodes, *VALUE_KEYS, *groups])
        hint = " These speak of it:" if found else f"{near} 'graphfx nodes' lists them"
        raise UsageError(Problem(f"there is no node type '{name}'.{hint}", notes=tuple(found)))
    if as_json:
        click.echo(json.dumps([node_data(types[each], nodes) for each in sorted(types)], indent=2))
    else:
        parts = {"values of the language": value_lines(), "groups": group_lines(groups)}
        further = [line for title, lines in parts.items() for line in ("", title, *(f"  {line}" for line in lines))]
        hint = f"'graphfx nodes NAME' says all about one; 'graphfx nodes {TOPIC}' lists what particles have."
        click.echo("\n".join([table(types), *further, "", hint]))
    if problems:
        show(problems)
        context.exit(EXIT_GRAPH)
