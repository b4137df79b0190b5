"""Stack: operators that act on one stream, in order.

`ops` is the list; `from` names the stream, or several to merge. Its `only`, `during` and `enabled`
hold for each operator besides its own.
"""

from graphfx.node import language


@language("stack", "operators")
def stack() -> None:
    """Act with each operator."""
