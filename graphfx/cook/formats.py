"""Which files an image is written as, by the end of its name, and what each can hold."""

from __future__ import annotations

from collections.abc import Iterator

from graphfx.output import exr
from graphfx.plan.pictures import ImagePlan

FORMATS = {".png": (8, 16), ".exr": (16, 32)}
"""The bits that a number may have, the default first, by the end of the name."""


CALLED = {".png": "a PNG", ".exr": "an EXR"}


def ending(name: str) -> str:
    """Return the end of a file's name that says its format, or nothing."""
    return next((end for end in FORMATS if name.lower().endswith(end)), "")


def bits_of(image: ImagePlan) -> int:
    """Return the bits of a number in an image's files."""
    given = image.value("bits")
    return int(given) if given is not None else FORMATS[ending(str(image.value("file")))][0]


def faults_of_format(image: ImagePlan, name: str) -> Iterator[tuple[str, str]]:
    """Yield each parameter of an image that its file, named so, cannot hold, and what is wrong with it."""
    end = ending(name)
    if not end:
        known = " or ".join(FORMATS)
        yield "file", f"'{name}': pictures are written as PNG and as EXR; let the name end in {known}"
        return
    bits = image.value("bits")
    if bits is not None and int(bits) not in FORMATS[end]:
        known = " or ".join(map(str, FORMATS[end]))
        other = next((other for other, known in FORMATS.items() if int(bits) in known), "")
        yield "bits", f"the numbers of {CALLED[end]} have {known} bits; say so, or let the file's name end in {other}"
    if end == ".png":
        if image.value("channels"):
            yield "channels", "a PNG holds colour and alpha alone; leave channels out, or let the file's name end in .exr"
        if image.value("deep"):
            yield "deep", "a PNG holds no samples; leave deep out, or let the file's name end in .exr"
    elif not image.value("deep") and (fault := exr.fault()):
        yield "file", f"'{name}': {fault}"
