"""Check a document against the language and the node types: all problems, not only the first."""

from __future__ import annotations

from graphfx.errors import Problem
from graphfx.graph.check_document import read_graph, starting_from
from graphfx.graph.checking import Checking, in_order
from graphfx.graph.document import Document
from graphfx.graph.flatten import check_flat
from graphfx.node import Library


def check(document: Document, library: Library) -> list[Problem]:
    """Return everything that is wrong with a document and the groups that it uses, in order of place."""
    checking = Checking(library, document.limits)
    graph = read_graph(document, checking, starting_from(document))
    if not checking.problems:
        checking.problems.extend(check_flat(graph, checking))
    return in_order(checking.problems, document.file)


def check_part(document: Document, library: Library) -> list[Problem]:
    """Return what is wrong with a part of a graph by itself: nodes that it names may be missing."""
    checking = Checking(library, document.limits)
    read_graph(document, checking, starting_from(document), whole=False)
    return in_order(checking.problems, document.file)
