"""Build graphs in Python: `graphfx.Graph`. Names come from the node library, text from the canonical form."""

from graphfx.authoring.graph import Graph

__all__ = ["Graph"]
