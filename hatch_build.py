"""Build hook: the library of nodes and graphs goes into the wheel as `graphfx/bundled/`, without the gallery's pictures.

An editable install finds it in the checkout instead.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

SUFFIXES = (".py", ".json", ".md", ".png", ".jpg", ".obj")


class LibraryHook(BuildHookInterface):
    """Lists the library's files for a standard wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the files; `version` is "standard" or "editable"."""
        if version != "standard":
            return
        root = Path(self.root)
        gallery = root / "graphs" / "gallery"
        for folder in ("nodes", "graphs"):
            files = [file for file in sorted((root / folder).rglob("*")) if file.suffix in SUFFIXES and file.parent != gallery]
            if not files:
                raise RuntimeError(f"there is nothing in {folder}/: the wheel would have no library")
            build_data["force_include"] |= {str(file): f"graphfx/bundled/{file.relative_to(root).as_posix()}" for file in files}
