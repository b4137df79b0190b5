"""The keys of a graph document, and which node takes which: the language's own words."""

from __future__ import annotations

import re

TOP_KEYS = ("$schema", "graphfx", "doc", "seed", "time", "use", "params", "attributes", "values", "inputs", "outputs", "expose",
            "nodes")
TIME_KEYS = ("fps", "frames", "preroll", "substeps", "method", "order", "tolerance", "precision")
PARAM_KEYS = ("type", "default", "min", "max", "unit", "doc")
ATTRIBUTE_KEYS = ("type", "default", "unit", "doc")
ATTRIBUTE_TYPES = ("float", "vec3", "point", "direction", "color", "cluster")
"""Types of a graph's own attributes; `cluster` tells of a cluster that an emitter around the graph declares."""
CLUSTER_KEYS = ("count", "by")
CLUSTER_WAYS = ("turn", "nearest")
"""How an emitter numbers its particles, the default first."""
PARAM_TYPES = ("float", "int", "bool", "vec3", "point", "direction", "color", "string", "path", "interval", "list",
               "mesh")
REFERENCE_TYPES = ("node", "nodes", "stream", "selector", "surface", "mesh")
"""Types of parameters that name another node; `nodes` is a list of them."""
METHODS = ("auto", "exact", "strang", "adaptive", "rk45", "sims")
ORDERS = (4, 6, 8)
"""Orders of the method `adaptive`."""

KEYS = {
    "emit": ("type", "doc", "during", "enabled", "seed_key", "clusters", "values", "set"),
    "spawn": ("type", "doc", "from", "when", "only", "during", "enabled", "seed_key", "values", "set"),
    "stack": ("type", "doc", "from", "only", "during", "enabled", "seed_key", "ops"),
    "operators": ("type", "id", "doc", "from", "when", "only", "during", "enabled", "seed_key"),
    "set": ("type", "id", "doc", "from", "when", "only", "during", "enabled", "seed_key", "set"),
    "fade": ("type", "id", "doc", "from", "only", "during", "enabled", "seed_key", "set"),
    "group": ("type", "id", "doc", "from", "inputs", "only", "during", "enabled", "seed_key"),
    "image": ("type", "doc", "from", "enabled"),
    "preview": ("type", "doc", "from", "enabled"),
    "emitters": ("type", "doc", "from", "during", "enabled", "seed_key", "values", "set"),
    "selectors": ("type", "doc", "from", "seed_key", "per"),
    "renders": ("type", "doc", "enabled"),
    "geometry": ("type", "doc", "seed_key"),
}
"""Keys besides the parameters, by role where the role is here, else by kind; in canonical order."""

MOMENTS = {
    "assign": ("frame", "step", "birth", "hit", "death"),
    "set": ("frame", "step", "birth", "hit", "death"),
    "spawn": ("", "birth", "hit", "death"),
    "kill": ("step", "frame", "hit"),
    "recycle": ("death", "step", "hit"),
}
"""The moments at which a role may act, its default first ('' where it has none); all others act through the whole step."""
CONDITIONS = ("all", "any", "not")
"""Conditions made of conditions, in `only`."""
TAIL = ("tail.radius", "tail.color", "tail.opacity")
"""What the operator `set` may set of the tail alone."""
PICTURES = ("image", "preview")
"""Roles of the nodes that draw streams into pictures."""
OUTPUTS = (*PICTURES, "movie")
"""Roles of the nodes that write files; all others live only through them, and inside a group they are passed over."""
LOOKS = {"blend": ("over", "add"), "falloff": ("linear", "gaussian", "disc"), "streak": ("exposed", "solid")}
"""What an entry of an image's `from` may say, the default first."""

VALUE_KEYS = {
    "param": (), "expr": (), "keys": ("interpolation", "repeat"), "ramp": ("over", "interpolation"), "rand": ("per", "vary"),
}
"""The language's own values with their modifiers; all others are nodes of the kind `values`, with `per`."""
INTERPOLATIONS = ("linear", "step", "smooth", "spline")
"""How keys and ramps go from point to point; a spline is a cubic (Catmull and Rom 1974) through all of them."""
REPEATS = ("hold", "loop", "mirror")
SCOPES = ("life", "particle", "hit", "frame", "graph")

ID = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*")
"""What a node's id looks like."""
WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
"""What the name of a parameter or a value looks like, so that expressions can say it."""


def keys_of(role: str, kind: str) -> tuple[str, ...]:
    """Return the keys, besides parameters, that a node of this role and kind takes."""
    return KEYS.get(role) or KEYS.get(kind, ("type", "doc"))
