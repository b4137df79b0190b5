"""A plan as text: what runs, what was left out and why, and every program as an assembly listing.

Each line of a program is `results = function operands [mask] ; node`. Names that repeat are numbered
(`distance`, `distance.2`), so the same plan always reads the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.make import EmitterPlan, Plan
from graphfx.plan.pictures import ImagePlan
from graphfx.program import Call, Draw, Function, Instruction, Loop, Operand, Program, Uniform

REALS = {"float": 1, "vec3": 3, "color": 3}
BYTES = {"mask": 1, "id": 8, "time": 8, "count": 4}
NOTE_COLUMN = 76


def bytes_of(type_: str, precision: int) -> int:
    """Return the bytes that a stored column takes per particle."""
    return REALS[type_] * precision // 8 if type_ in REALS else BYTES[type_]


def plan_data(plan: Plan) -> dict[str, Any]:
    """Return what a plan says, as plain data."""
    flat = plan.flat
    nodes = [{"path": path, "type": flat.nodes[path].node_type.name, "kept": True} for path in plan.schedule.order]
    nodes += [
        {"path": path, "type": flat.nodes[path].node_type.name, "kept": False, "reason": reason}
        for path, reason in plan.schedule.dropped.items()
    ]
    time = {
        "fps": flat.time.fps,
        "frames": [flat.time.first, flat.time.last],
        "preroll": flat.time.preroll,
        "substeps": flat.time.substeps,
        "precision": plan.precision,
    }
    return {
        "graph": flat.name,
        "seed": flat.seed,
        "time": time,
        "nodes": nodes,
        "images": [_image_data(image) for image in plan.images],
        "movies": [{"path": movie.node.path, "image": movie.image.node.path} for movie in plan.movies],
        "emitters": [_emitter_data(emitter, plan.precision) for emitter in plan.emitters.values()],
    }


def _image_data(image: ImagePlan) -> dict[str, Any]:
    return {
        "path": image.node.path,
        "type": image.node.node_type.name,
        "size": [int(number) for number in image.value("size")],
        "camera": image.camera.path,
        "draws": list(dict.fromkeys([*(drawn.path for drawn in image.streams), *(node.path for node in image.polygons)])),
    }


def _emitter_data(emitter: EmitterPlan, precision: int) -> dict[str, Any]:
    attributes = emitter.attributes
    columns = [
        {"name": name, "type": type_, "bytes": bytes_of(type_, precision), "reason": attributes.reasons[name]}
        for name, type_ in attributes.columns.items()
    ]
    told = {*attributes.read, *emitter.node.sets, "life"}
    omitted = {name: f"{shown(value)} for all" for name, value in emitter.constants.items() if name in told}
    omitted |= dict.fromkeys((name for name in attributes.unread if name in told), "nothing reads it")
    return {
        "path": emitter.path,
        "method": emitter.method,
        "reason": emitter.reason,
        "bytes": sum(column["bytes"] for column in columns),
        "attributes": columns,
        "not_stored": omitted,
        "programs": [
            {
                "name": program.program.name,
                "instructions": sum(1 for _ in program.program.walk()),
                "lines": ProgramListing(program.program).lines(program),
            }
            for program in emitter.made_programs
        ],
    }


def listing(plan: Plan, source: Callable[[Function], str] | None = None) -> str:
    """Return a plan as text; `source` gives the generated source of a function's kernel, which is then shown too."""
    data = plan_data(plan)
    lines = [_title(data), "", "nodes", *_node_lines(data["nodes"])]
    for image in data["images"]:
        size, drawn = " x ".join(map(str, image["size"])), ", ".join(image["draws"]) or "nothing"
        lines += ["", f"{image['type']} {image['path']}: {size}, seen from {image['camera']}, draws {drawn}"]
    lines += [f"movie {movie['path']}: the pictures of {movie['image']}" for movie in data["movies"]]
    for emitter in data["emitters"]:
        lines += ["", *_emitter_lines(emitter)]
    if source is not None:
        lines += _source_lines(plan, source)
    return "\n".join(lines)


def _title(data: dict[str, Any]) -> str:
    time, (first, last) = data["time"], data["time"]["frames"]
    steps = "1 step a frame" if time["substeps"] == 1 else f"{time['substeps']} steps a frame"
    before = f", simulated from {-time['preroll']:g} s" if time["preroll"] else ""
    return f"{data['graph']}: frames {first} to {last} at {time['fps']:g} per second{before}, {steps}, {time['precision']} bits"


def _node_lines(nodes: list[dict[str, Any]]) -> Iterator[str]:
    width = max(len(node["path"]) for node in nodes)
    kinds = max(len(node["type"]) for node in nodes)
    for node in nodes:
        reason = "" if node["kept"] else f"  {node['reason']}"
        yield f"  {'kept   ' if node['kept'] else 'dropped'} {node['path']:{width}}  {node['type']:{kinds}}{reason}".rstrip()


def _emitter_lines(emitter: dict[str, Any]) -> Iterator[str]:
    yield f"emitter {emitter['path']}"
    yield f"  motion: {emitter['method']}; {emitter['reason']}"
    yield f"  {emitter['bytes']} bytes a particle"
    names = [*emitter["not_stored"], *(column["name"] for column in emitter["attributes"])]
    width = max(map(len, names), default=0)
    for column in emitter["attributes"]:
        yield f"    {column['name']:{width}} {column['bytes']:3}  {column['reason']}"
    for name, reason in emitter["not_stored"].items():
        yield f"    {name:{width}}   0  {reason}"
    for program in emitter["programs"]:
        yield ""
        yield f"  program {program['name']} ({program['instructions']} instructions)"
        yield from (f"    {line}" for line in program["lines"])


def _source_lines(plan: Plan, source: Callable[[Function], str]) -> Iterator[str]:
    seen: set[str] = set()
    for emitter in plan.emitters.values():
        for program in emitter.programs:
            for instruction in program.walk():
                if isinstance(instruction, Call):
                    function = instruction.function
                    name = function.bundle.name if function.bundle else function.name
                    if name not in seen:
                        seen.add(name)
                        yield from ("", f"kernel {name}", *(f"  {line}" for line in source(function).splitlines()))


def shown(value: Any) -> str:
    """Return a constant as a listing shows it."""
    if isinstance(value, (tuple, list)):
        return "(" + ", ".join(shown(part) for part in value) + ")"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    return value if isinstance(value, str) else f"{float(value):g}"


@dataclass
class ProgramListing:
    """One program's lines; operands get their names in the order in which they appear."""

    program: Program
    names: dict[int, str] = field(default_factory=dict)
    taken: dict[str, int] = field(default_factory=dict)

    def lines(self, made: FrameProgram | None = None) -> list[str]:
        """Return the program: what it is given, its instructions, what it gives back."""
        program = self.program
        listed = [
            *([f"given   {', '.join(map(self.name, program.uniforms))}"] if program.uniforms else []),
            *([f"load    {', '.join(map(self.name, program.loads.values()))}"] if program.loads else []),
        ]
        if made is not None:
            listed += self._step_lines(made)
        listed += self._body(program.body, "")
        if program.rejects is not None:
            listed.append(f"reject  {self.name(program.rejects)}")
        named = {name: self.name(column) for name, column in program.stores.items()}
        stored = [name if name == column else f"{name} = {column}" for name, column in named.items()]
        return [*listed, *([f"store   {', '.join(stored)}"] if stored else [])]

    def _step_lines(self, made: FrameProgram) -> Iterator[str]:
        """Yield what is found once a step, for all particles together."""
        for time, step in made.steps:
            if not step.exports:
                continue
            inner = ProgramListing(step.builder.program)
            yield f"once, at the {time if isinstance(time, str) else f'{time[0]} of step {time[1]}'}:"
            yield from inner._body(step.builder.program.body, "  ")
            yield from (f"  {self.name(uniform)} = {inner.name(operand)}" for uniform, operand in step.exports)

    def _body(self, body: list[Instruction], indent: str) -> Iterator[str]:
        for instruction in body:
            if isinstance(instruction, Loop):
                head = f"{indent}while {self.name(instruction.mask)}, at most {instruction.limit} times:"
                yield self._noted(head, instruction.note)
                yield from self._body(instruction.body, indent + "  ")
            else:
                yield self._noted(indent + self._line(instruction), instruction.note)

    def _line(self, instruction: Call | Draw) -> str:
        if isinstance(instruction, Draw):
            key = ":".join(f"{word:08x}" for word in instruction.key)
            operands = map(self.name, (instruction.identity, instruction.life, instruction.cell))
            written, done = self.name(instruction.result), f"philox {key}, {', '.join(operands)}"
        else:
            done = f"{instruction.function.name} {', '.join(map(self.name, instruction.operands))}".rstrip()
            written = ", ".join(map(self.name, instruction.results))
        under = "" if instruction.mask is self.program.context else f" [{self.name(instruction.mask)}]"
        return f"{written} = {done}{under}"

    @staticmethod
    def _noted(line: str, note: str) -> str:
        return f"{line:{NOTE_COLUMN}} ; {note}" if note else line

    def name(self, operand: Operand) -> str:
        """Return an operand's name, or the constant that it is."""
        if isinstance(operand, Uniform) and operand.value is not None:
            return shown(operand.value)
        if id(operand) not in self.names:
            plain = operand.name.replace(" ", "_")
            self.taken[plain] = self.taken.get(plain, 0) + 1
            self.names[id(operand)] = plain if self.taken[plain] == 1 else f"{plain}.{self.taken[plain]}"
        return self.names[id(operand)]
