# SPDX-License-Identifier: BSD-3-Clause
"""Files that are there whole, or as they were before."""

import os
import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["write_text", "written"]


@contextmanager
def written(file: str | os.PathLike[str]) -> Iterator[Path]:
    """A file to write into, which takes the place of `file` when it is written, with its rights: an interruption or a full disk leaves what was there before.
    What is no plain file, such as a pipe, or may not be written, is opened itself. An OSError names the file."""
    named = Path(file)
    whole = named.resolve()  # through links
    exists = named.exists()  # looked for once: another may write it in the meantime
    there = exists and named.is_file() and os.access(whole, os.W_OK)
    if _is_stream(named) or (exists and not there) or not os.access(whole.parent, os.W_OK):
        yield named
        return
    beside = whole.with_name(f".{whole.stem}.{os.getpid()}-{threading.get_ident()}{whole.suffix}")
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


def _is_stream(file: Path) -> bool:
    """Whether it is open already, as /dev/stdout is, which may be a file that holds more."""
    return any(file.absolute().is_relative_to(place) for place in ("/dev/stdout", "/dev/stderr", "/dev/fd", "/proc"))


def write_text(file: str | os.PathLike[str], *parts: str) -> None:
    """Write text, that may be long, without copying it."""
    with written(file) as beside, beside.open("a" if _is_stream(beside) else "w", encoding="utf-8", newline="\n") as stream:
        for part in parts:
            stream.write(part)
