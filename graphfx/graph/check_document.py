"""Read a document and the groups that it uses into a `Graph`; every mistake on the way is collected."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

from graphfx.errors import GraphError, LimitError, Location, suggestion
from graphfx.graph.check_graph import GraphReader
from graphfx.graph.check_nodes import NodeReader
from graphfx.graph.check_streams import check_references
from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking
from graphfx.graph.document import Document, load_document
from graphfx.graph.items import Item
from graphfx.graph.literals import Literals
from graphfx.graph.model import Graph
from graphfx.graph.named import NamedValues
from graphfx.graph.names import ID, TOP_KEYS
from graphfx.graph.own import OwnReader
from graphfx.graph.paths import PathRefused, find_file
from graphfx.graph.scope import Scope

VERSION = 1


@dataclass
class Groups:
    """The documents that a graph uses, each read once; `chain` are those being read, outermost first."""

    known: dict[Path, Graph | None] = field(default_factory=dict)
    chain: list[tuple[Path, str]] = field(default_factory=list)


def read_graph(document: Document, checking: Checking, groups: Groups | None = None, whole: bool = True) -> Graph:
    """Return the graph that a document says, as far as it is right; problems go to `checking`.

    A part of a graph, not `whole`, may name nodes that are not in it.
    """
    groups = groups or Groups()
    before = len(checking.problems)
    checking.problems.extend(document.problems)
    root = document.root
    graph = Graph(document.name, document.file, document.folder, root.location, digest=document.digest)
    if not root.is_object:
        checking.mismatch(root, "", 'a graph should be an object such as {"graphfx": 1, "nodes": {}}')
        return graph
    part = root.value.get
    _top(checking, root)
    graph.doc = checking.text(part("doc"), "doc", "doc") if part("doc") else ""
    folders = [*([document.folder] if document.folder else []), *(library / "graphs" for library in checking.library.roots)]
    literals = Literals(checking, folders)
    around = GraphReader(checking, graph, literals)
    around.seed(part("seed"))
    around.time(part("time"))
    _use(checking, graph, part("use"), folders, groups)
    around.params(part("params"))
    around.inputs(part("inputs"))
    own = OwnReader(checking, graph, literals)
    own.attributes(part("attributes"))
    own.clusters(part("nodes"))
    own.merge()
    reader = ValueReader(checking, literals)
    scope = Scope("", "", graph.params, lambda name: None, broken=graph.broken, own=graph.attributes, clusters=graph.clusters,
                  groups_own=graph.groups_own)
    values = NamedValues(checking, reader, part("values"), scope)
    _nodes(checking, graph, part("nodes"), NodeReader(checking, graph, reader, values))
    if whole:
        check_references(checking, graph, reader.meshes)
        around.outputs(part("outputs"))
        around.expose(part("expose"))
    graph.sound = len(checking.problems) == before
    return graph


def _top(checking: Checking, root: Item) -> None:
    for key, _ in root.entries():
        if key not in TOP_KEYS:
            checking.complain(root.key_location(key), key, f"a graph has no key '{key}'." + suggestion(key, TOP_KEYS),
                              f"its keys: {', '.join(TOP_KEYS[1:])}")
    version = root.value.get("graphfx")
    if version is None:
        checking.complain(root.location, "", f'the version of the language is missing; begin with "graphfx": {VERSION}')
    elif version.is_number and version.value > VERSION:
        checking.complain(version.location, "graphfx", f"this is version {version.value} of the language, and this graphfx reads "
                          f"version {VERSION}; a newer graphfx is needed")
    elif version.value != VERSION or isinstance(version.value, bool):
        checking.mismatch(version, "graphfx", f'the version of the language should be {VERSION}, as in "graphfx": {VERSION}')


def _use(checking: Checking, graph: Graph, item: Item | None, folders: list[Path], groups: Groups) -> None:
    """Read the groups that a graph names."""
    if item is not None and not item.is_object:
        checking.mismatch(item, "use", "\"use\" should be an object {name: path}")
    for name, given in item.entries() if item is not None else ():
        path = f"use.{name}"
        if checking.named(item, name, path, "the name of a group", ID) and name in checking.library:  # type: ignore[arg-type]
            checking.complain(item.key_location(name), path,  # type: ignore[union-attr]
                              f"'{name}' is a node type of the library; give the group another name")
        text = checking.text(given, path, "the path of a group")
        try:
            used = _group(checking, find_file(text, folders), text, given.location, path, groups) if given.is_text else None
        except PathRefused as refusal:
            checking.complain(given.location, path, str(refusal), *refusal.notes)
            used = None
        if used is None:
            graph.broken.add(path)
        else:
            graph.use[name] = used
            graph.digest = hashlib.blake2b(f"{graph.digest} {name} {used.digest}".encode(), digest_size=16).hexdigest()


def _group(checking: Checking, file: Path, text: str, location: Location, path: str, groups: Groups) -> Graph | None:
    real = file.resolve()
    files = [known for known, _ in groups.chain]
    if real in files:
        circle = " -> ".join([*(name for _, name in groups.chain[files.index(real):]), text])
        checking.complain(location, path, f"these groups use one another in a circle: {circle}; break it at one of them")
        return None
    if len(groups.chain) >= checking.limits.group_depth:
        checking.complain(location, path, f"groups use groups deeper than the limit of {checking.limits.group_depth}; "
                          "raise the limit on group_depth if that is meant")
        return None
    if real not in groups.known:
        groups.chain.append((real, text))
        try:
            groups.known[real] = read_graph(load_document(file, checking.limits), checking, groups)
        except (GraphError, LimitError) as error:
            checking.problems.extend(error.problems)
            groups.known[real] = None
        groups.chain.pop()
    return groups.known[real]


def _nodes(checking: Checking, graph: Graph, item: Item | None, reader: NodeReader) -> None:
    if item is None or not item.is_object:
        checking.complain(graph.location if item is None else item.location, "" if item is None else "nodes",
                          '"nodes" is missing; a graph needs "nodes": {id: {"type": ...}, ...}' if item is None
                          else f"\"nodes\" should be an object of nodes by id; here stands {item.words}")
        return
    for name, given in item.entries():
        path = f"nodes.{name}"
        if not checking.named(item, name, path, "an id", ID):
            continue
        if name in graph.inputs:
            checking.complain(item.key_location(name), path,
                              f"'{name}' is an input of this group already; give the node another id")
            continue
        graph.nodes[name] = reader.entry(name, given, name, path)


def starting_from(document: Document) -> Groups:
    """Return groups with the document itself at the head of the chain, so that using it is a circle."""
    if document.folder is None:
        return Groups()
    file = (document.folder / Path(document.file).name).resolve()
    return Groups(chain=[(file, Path(document.file).name)])
