"""Options that several commands share."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import click

from graphfx.errors import UsageError


@dataclass
class Settings:
    """What holds for the whole command line."""

    debug: bool = False


def _set_debug(context: click.Context, parameter: click.Parameter, given: bool) -> None:
    if given:
        context.find_object(Settings).debug = True  # type: ignore[union-attr]


debug: Callable[[Any], Any] = click.option("--debug", is_flag=True, is_eager=True, expose_value=False, callback=_set_debug,
                                           help="Show where in graphfx an error came from.")
library: Callable[[Any], Any] = click.option("--library", multiple=True, metavar="DIR",
                                             help="A further folder with nodes/ and graphs/; may be given more than once.")


def _parse_settings(context: click.Context, parameter: click.Parameter, given: tuple[str, ...]) -> dict[str, str]:
    parsed: dict[str, str] = {}
    for text in given:
        name, equals, value = text.partition("=")
        if not (equals and name.strip()):
            raise UsageError(f"--set {text}: write it as name=value")
        parsed[name.strip()] = value.strip()
    return parsed


parameters: Callable[[Any], Any] = click.option(
    "--set", "parameters", multiple=True, metavar="NAME=VALUE", callback=_parse_settings,
    help="Give a parameter of the graph a value; may be given more than once.")
threads: Callable[[Any], Any] = click.option(
    "--threads", type=click.IntRange(1, 256), metavar="N", help="Threads to use; all processors if not given.")


class Bytes(click.ParamType):
    """A number of bytes, such as 500MB, 1.5G or 123456; a K is 1000 bytes, a Ki 1024."""

    name = "bytes"
    _SHAPE = re.compile(r"([0-9]*\.?[0-9]+)\s*([kmgt]?)(i?)b?", re.IGNORECASE)

    def convert(self, value: Any, param: click.Parameter | None, context: click.Context | None) -> int:
        """Return the number."""
        if isinstance(value, int):
            return value
        found = self._SHAPE.fullmatch(value.strip())
        if found is None or float(found[1]) == 0:
            self.fail(f"'{value}' is no size; write 500MB, 1.5G or a number of bytes", param, context)
        power = " kmgt".index(found[2].lower() or " ")
        return int(float(found[1]) * (1024 if found[3] else 1000) ** power)


def _keep_limit(context: click.Context, parameter: click.Parameter, given: int | None) -> None:
    """Put a limit that is given among the command's `limits`, by its name there."""
    limits = context.params.setdefault("limits", {})
    if given is not None:
        limits[(parameter.name or "").removeprefix("limit_")] = given


def limits(command: Any) -> Any:
    """Give a command the options that raise or lower limits; it gets `limits`, those that were stated."""
    shared: dict[str, Any] = {"expose_value": False, "callback": _keep_limit}
    number: dict[str, Any] = {"type": click.IntRange(1), "metavar": "N", **shared}
    for option in (click.option("--memory", type=Bytes(), metavar="SIZE", **shared,
                                help="Memory to use, such as 1G: larger pictures are made in parts; what is free, if not given."),
                   click.option("--limit-disk", type=Bytes(), metavar="SIZE", **shared,
                                help="What all pictures may take on the disk, such as 500MB; what is free there, if not given."),
                   click.option("--limit-pixels", help="Pixels of a picture, at most.", **number),
                   click.option("--limit-particles", help="Particles of an emitter alive at once, at most.", **number)):
        command = option(command)
    return command


Size = tuple[int, int | None]
"""Width and height in pixels; the height may follow from a picture's."""


class _Size(click.ParamType):
    name = "size"

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> Size:
        """Return the size that was typed."""
        if isinstance(value, tuple):
            return value[0], value[1]
        found = re.fullmatch(r"(\d{1,5})(?:x(\d{1,5}))?", value)
        if found is None or not all(0 < int(part) <= 65536 for part in found.groups() if part):
            self.fail(f"'{value}' is no size; write 320 for the width, or 320x180; each from 1 to 65536", parameter, context)
        return int(found[1]), int(found[2]) if found[2] else None


def sized(widest: int) -> Callable[[Any], Any]:
    """Give a command the option of a picture's size, which is so wide at most unless it is given."""
    return click.option("--size", type=_Size(), metavar="WIDTH[xHEIGHT]",
                        help=f"Pixels; as the picture, but {widest} wide at most, if not given.")


size = sized(640)
