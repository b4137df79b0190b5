"""Files are written beside the frames that come after them."""

from __future__ import annotations

import threading
from collections import defaultdict

import pytest

from graphfx.cook.writing import Writer
from graphfx.errors import UsageError

from .effects import made

PATIENCE = 60
"""Seconds to wait for what should come at once."""


def test_the_next_frame_is_drawn_while_a_file_is_written(monkeypatch, tmp_path):
    """Writing frame 1 ends only after frame 2 was begun, and so on: one waits for the other, and neither for ever."""
    draw, write = Writer.draw, Writer.write
    begun, told = defaultdict(threading.Event), []

    def noted(writer, file, image, simulation, frame):
        begun[frame].set()
        return draw(writer, file, image, simulation, frame)

    def patient(writer, file, image, film, frame):
        told.append((frame, frame == 4 or begun[frame + 1].wait(PATIENCE)))
        write(writer, file, image, film, frame)

    monkeypatch.setattr(Writer, "draw", noted)
    monkeypatch.setattr(Writer, "write", patient)
    files = made().cook(tmp_path, range(1, 5), 2)
    assert told == [(frame, True) for frame in range(1, 5)] and all(file.is_file() for file in files)


def test_an_image_is_named_by_number_or_id():
    """A frame is drawn of the image of a number or of its id; one that is not there is told with those that are."""
    second = {"type": "image", "from": "sky", "camera": "view", "size": [32, 18], "file": "second.####.png"}
    effect = made(nodes={"second": second})
    ids = [image.node.path for image in effect.plan.images]
    assert {effect.frame(2, image=id).size for id in ids} == {effect.frame(2, image=k).size for k in range(2)}
    assert effect.frame(2, image="second").size == (32, 18)
    for wrong in ("third", 2):
        with pytest.raises(UsageError, match=f"the graph has no image {wrong!r}; it has: {', '.join(ids)}"):
            effect.frame(2, image=wrong)
