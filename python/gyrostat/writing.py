# SPDX-License-Identifier: BSD-3-Clause
"""Files that are there whole, or as they were before."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["write_text", "written"]


@contextmanager
def written(file: str | os.PathLike[str]) -> Iterator[Path]:
    """A file to write into, which takes the place of `file` when it is written, with its rights: an interruption or a full disk leaves what was there before.
    What is no plain file, such as a pipe, or may not be written, is opened itself. An OSError names the file."""
    whole = Path(file).resolve()  # through links
    there = whole.is_file() and os.access(whole, os.W_OK)
    if not (there or not whole.exists()) or not os.access(whole.parent, os.W_OK):
        yield Path(file)
        return
    beside = whole.with_name(f".{whole.stem}.{os.getpid()}{whole.suffix}")
    try:
        yield beside
        with beside.open("rb+") as stream:
            os.fsync(stream.fileno())
        if there:
            shutil.copymode(whole, beside)
        beside.replace(whole)
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), os.fspath(file)) from None
    finally:
        beside.unlink(missing_ok=True)


def write_text(file: str | os.PathLike[str], *parts: str) -> None:
    """Write text, that may be long, without copying it."""
    with written(file) as beside, beside.open("w", encoding="utf-8", newline="\n") as stream:
        for part in parts:
            stream.write(part)
