"""Files that are whole or not there: written under another name in the same folder, then renamed."""

from __future__ import annotations

import errno
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from graphfx.errors import OutputError, Problem

_FULL = "; free some space there, or write to another disk"
_BARRED = "; let it be written there, or choose another folder"
WHAT_TO_DO = {
    errno.ENOSPC: _FULL,
    getattr(errno, "EDQUOT", errno.ENOSPC): _FULL,
    errno.EFBIG: "; no file may be so large there: choose another folder, or write smaller pictures",
    errno.EACCES: _BARRED,
    errno.EPERM: _BARRED,
    errno.EROFS: _BARRED,
    errno.ENAMETOOLONG: "; give it a shorter name",
}
"""What to do, by what the system says."""


def make_folder(file: Path) -> None:
    """Make the folder of a file; raise OutputError where that cannot be."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {file.parent}: {error.strerror}") from error


@contextmanager
def whole_path(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give the path of a file that is yet to be written, and that becomes the file `path` when the block ends well.

    If it does not, whatever the reason, nothing is left behind and a former file keeps its content.
    """
    target = Path(path)
    temporary = target.with_name(f".{secrets.token_hex(8)}.part")
    try:
        yield temporary
        _keep_content(temporary)
        os.replace(temporary, target)
        _keep_rename(target.parent)
    except OSError as error:
        what_to_do = WHAT_TO_DO.get(error.errno or 0, "")
        raise OutputError(Problem(f"cannot write {target}: {error.strerror or error}{what_to_do}")) from error
    finally:
        with suppress(OSError):
            temporary.unlink()


@contextmanager
def whole_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Open a stream whose content becomes the file `path` when the block ends well, as `whole_path` does."""
    with whole_path(path) as temporary:
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
        with open(os.open(temporary, flags, 0o666), "wb") as stream:
            yield stream


def _keep_content(file: Path) -> None:
    """Bring a file's content to the disk, so that its new name never stands for less."""
    handle = os.open(file, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _keep_rename(folder: Path) -> None:
    """Bring the folder's entry to the disk, where the system allows it."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
