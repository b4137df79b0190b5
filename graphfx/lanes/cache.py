"""The cache of compiled code on disk, which is never stale and never trusted unread.

Numba's own cache returns old code when a function that is *called* changes, and unpickles whatever
lies there. Here every entry is one file, named by a hash of all that matters (sources, signature,
versions, processor) and opening with the SHA-256 of the rest. What does not match is compiled
again; files are written under a temporary name and renamed.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

import llvmlite
import numba
from numba.core.caching import CompileResultCacheImpl, _Cache
from numba.core.compiler import CompileResult
from numba.core.runtime import rtsys

PACKAGE = Path(__file__).resolve().parent.parent

compilations: list[tuple[str, float]] = []
"""Name and seconds of everything compiled (not loaded) by this process."""
listeners: list[Callable[[str], None]] = []
"""Called with the name of what is about to be compiled."""


def cache_folder() -> Path:
    """Return the folder for compiled code: GRAPHFX_CACHE, or `graphfx` in the user's cache folder."""
    given = os.environ.get("GRAPHFX_CACHE")
    if given:
        return Path(given)
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "graphfx"


def digest_of(parts: Iterable[bytes]) -> str:
    """Return a hash of byte strings, their borders included."""
    hasher = hashlib.blake2b(digest_size=16)
    for part in parts:
        hasher.update(len(part).to_bytes(8, "little"))
        hasher.update(part)
    return hasher.hexdigest()


def code_digest(code: CodeType) -> str:
    """Return a hash of a function's bytecode, with the constants and names in it, and those of functions inside it."""
    constants = [code_digest(part) if isinstance(part, CodeType) else repr(part) for part in code.co_consts]
    return digest_of([code.co_code, *(text.encode() for text in (*constants, *code.co_names))])


@cache
def _folder_digest(folder: Path) -> str:
    return digest_of(part for file in sorted(folder.glob("*.py")) for part in (file.name.encode(), file.read_bytes()))


@cache
def _versions() -> str:
    return f"{numba.__version__} {llvmlite.__version__} {sys.version}"


def engine_digest(*folders: str) -> str:
    """Return a hash of the engine's sources that compiled code rests on, and of the versions of its compilers."""
    return digest_of([_versions().encode(), *(_folder_digest(PACKAGE / folder).encode() for folder in folders)])


class CheckedCache(_Cache):
    """Numba's cache interface over files that check themselves.

    `stamp` must change whenever anything changes that the code is made from, apart from the
    function's own bytecode, its signature and the processor.
    """

    def __init__(self, name: str, code: bytes, stamp: str):
        self.name = name
        self._key = [name.encode(), code, stamp.encode()]
        self._enabled = True
        self._started = 0.0

    @property
    def cache_path(self) -> str:
        """Return the folder."""
        return str(cache_folder())

    def enable(self) -> None:
        """Use the cache."""
        self._enabled = True

    def disable(self) -> None:
        """Leave the cache alone."""
        self._enabled = False

    def flush(self) -> None:
        """Do nothing: entries are never wrong."""

    def _file(self, signature: Any, codegen: Any) -> Path:
        key = digest_of([*self._key, repr(signature).encode(), repr(codegen.magic_tuple()).encode()])
        return cache_folder() / f"{self.name.rpartition('.')[2]}-{key}.code"

    def load_overload(self, signature: Any, target_context: Any) -> CompileResult | None:
        """Return the stored code, or None; what is damaged is removed.

        Of Numba's context only the runtime is made ready, to which stored code refers. The registries are not
        loaded: they cost half a second, and the compiler loads them when there is something to compile.
        """
        rtsys.initialize(target_context)
        file = self._file(signature, target_context.codegen())
        try:
            content = file.read_bytes() if self._enabled else b""
        except OSError:
            content = b""
        if len(content) > 32 and hashlib.sha256(content[32:]).digest() == content[:32]:
            with suppress(ImportError):  # what was made from a module that is not here now is made again
                return CompileResult._rebuild(target_context, *pickle.loads(content[32:]))
        elif content:
            _remove(file)
        for listener in listeners:
            listener(self.name)
        self._started = time.perf_counter()
        return None

    def save_overload(self, signature: Any, result: CompileResult) -> None:
        """Store new code; a folder that cannot be written only costs the time to compile again."""
        compilations.append((self.name, time.perf_counter() - self._started))
        if not self._enabled or not CompileResultCacheImpl.check_cachable(self, result):
            return
        content = pickle.dumps(result._reduce(), protocol=pickle.HIGHEST_PROTOCOL)
        file = self._file(signature, result.codegen)
        try:
            file.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            handle, temporary = tempfile.mkstemp(dir=file.parent, suffix=".part")
        except OSError:
            return
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(hashlib.sha256(content).digest() + content)
            os.replace(temporary, file)
        except OSError:
            _remove(Path(temporary))

    _lineno = 0

    @property
    def _locator(self) -> Any:
        return type("Locator", (), {"_py_file": self.name})


def _remove(file: Path) -> None:
    """Remove a file; where that is not allowed it stays, and is passed over each time."""
    with suppress(OSError):
        file.unlink()
