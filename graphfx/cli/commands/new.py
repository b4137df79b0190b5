"""`graphfx new`: begin a node, or a graph."""

from __future__ import annotations

import keyword
import re
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphfx.cli.options import debug
from graphfx.errors import OutputError, UsageError, suggestion

if TYPE_CHECKING:
    from graphfx.node import Library


@click.group()
def command() -> None:
    """Begin a node or a graph.

    \b
    graphfx new node drift --kind operators --role flow --in library
    graphfx new graph fountain
    """


@command.command()
@click.argument("name")
@click.option("--kind", default="operators", show_default=True, help="operators, selectors, values or geometry.")
@click.option("--role", default=None, help="How the engine treats it: flow, linear, acceleration, surface, ...")
@click.option("--in", "folder", default=".", metavar="FOLDER", help="The library folder; nodes/ and tests/ are made in it.")
@debug
def node(name: str, kind: str, role: str | None, folder: str) -> None:
    """Write a node's file and its test, which passes.

    The node works as it stands; change its formula, and its case worked out by hand. 'pytest FOLDER' runs the test.
    """
    from graphfx.cli.scaffold import node_text, test_text
    from graphfx.node import Library, library_roots

    root = Path(folder)
    role = checked_role(kind, role)
    check_name(name, Library(library_roots([root] if (root / "nodes").is_dir() else [])), f"nodes/{kind}")
    write({root / "nodes" / kind / f"{name}.py": node_text(name, kind, role),
           root / "tests" / f"test_{name}.py": test_text(name, role)})
    click.echo(f"'pytest {root / 'tests' / f'test_{name}.py'}' tests it; 'graphfx nodes {name} --library {root}' shows it")


@command.command()
@click.argument("name")
@click.option("--in", "folder", default=".", metavar="FOLDER", help="Where to write it.")
@debug
def graph(name: str, folder: str) -> None:
    """Write a small graph that cooks: particles that fall."""
    from graphfx.authoring import Graph

    name = name.removesuffix(".json")
    if not re.fullmatch(r"[A-Za-z0-9_-]+", name):
        raise UsageError(f"a graph's name is made of letters, digits, '_' and '-'; '{name}' is not")
    g = Graph(f"{name.replace('_', ' ').capitalize()}: say here what it shows.", frames=(1, 48), name=name)
    velocity = g.in_cone(angle=20, length=g.rand(4, 6))
    source = g.emit("source", rate=2000, life=2, set={"velocity": velocity, "color": g.rand("#4080ff", "#ffffff")})
    fall = source.stack("fall").gravity().bounce_plane()
    g.image("frames", of=fall, camera=g.camera("view", position=(0, 1.5, 6), target=(0, 1, 0)), size=(640, 360))
    file = Path(folder) / f"{name}.json"
    write({file: g.text})
    click.echo(f"'graphfx cook {file}' cooks it")


def checked_role(kind: str, role: str | None) -> str:
    """Return the role of a new node, or say which there are."""
    from graphfx.cli.scaffold import DEFAULT_ROLES, roles_of

    roles = roles_of(kind)
    if not roles:
        raise UsageError(f"--kind {kind}: a new node is one of {', '.join(DEFAULT_ROLES)}.{suggestion(kind, DEFAULT_ROLES)}")
    if role is not None and role not in roles:
        raise UsageError(f"--role {role}: {kind} have the roles {', '.join(roles)}.{suggestion(role, roles)}")
    return role or roles[0]


def check_name(name: str, library: Library, folder: str) -> None:
    """Refuse a name that cannot be a function's, or means something already."""
    import graphfx.math
    from graphfx.graph.names import VALUE_KEYS
    from graphfx.node import ATTRIBUTES, COMMON_KEYS, DERIVED_ATTRIBUTES

    if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or keyword.iskeyword(name):
        raise UsageError(f"a node's name is a function's: small letters, digits and '_', as in 'blow_away'; '{name}' is not")
    if name in library:
        raise UsageError(f"there is a node type '{name}' already, in nodes/{library.kind_of(name)}; choose another name")
    taken = {*VALUE_KEYS, *COMMON_KEYS, *ATTRIBUTES, *DERIVED_ATTRIBUTES, *dir(graphfx.math)}
    if name in taken:
        raise UsageError(f"'{name}' means something already, in graphs or in graphfx.math; choose another name")


def write(files: dict[Path, str]) -> None:
    """Write new files; refuse to write over any."""
    from graphfx.output.atomic import whole_file

    for file in files:
        if file.exists():
            raise UsageError(f"{file} is there already; choose another name, or delete it")
    for file, text in files.items():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"the folder {file.parent} cannot be made: {error.strerror}") from error
        with whole_file(str(file)) as stream:
            stream.write(text.encode())
        click.echo(f"wrote {file}")
