"""A node's sample, cooked small."""

from __future__ import annotations

import tempfile
from pathlib import Path

from graphfx.authoring.sample import sample
from graphfx.contract.subject import Subject
from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten

LAST = 4
SIZE = [32, 18]


def cooks(subject: Subject) -> None:
    """The graph that its docs show cooks, and has the node in its plan."""
    data = sample(subject.node_type, subject.library)
    data["time"] = {"frames": [1, LAST], "method": "strang"}
    data["nodes"]["frames"]["size"] = SIZE
    effect = Effect(flatten(document_of(data), subject.library))
    with tempfile.TemporaryDirectory() as folder:
        files = effect.cook(folder, threads=1)
        pictures = LAST * len(effect.plan.stills) + len(effect.plan.movies)
        assert len(files) == pictures and all(Path(file).stat().st_size for file in files), "its sample wrote no pictures"
    if subject.node_type.kind not in ("values", "geometry") and subject.node_type.role != "stack":
        kept = {effect.flat.nodes[path].node_type.name for path in effect.plan.schedule.order}
        assert subject.node_type.name in kept, "the plan of its sample leaves the node out"
