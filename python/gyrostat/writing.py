# SPDX-License-Identifier: BSD-3-Clause
"""Files that are there whole, or as they were before."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["write_text", "written"]


@contextmanager
def written(file: str | os.PathLike[str]) -> Iterator[Path]:
    """A file to write into, which takes the place of `file` when it is written: an interruption or a full disk leaves what was there before. What is no
    plain file, such as a pipe, is written itself. An OSError names the file."""
    wanted = Path(file)
    plain = (wanted.is_file() or not wanted.exists()) and os.access(wanted.parent, os.W_OK)
    whole = wanted.resolve() if plain else wanted  # through links
    beside = whole.with_name(f".{whole.stem}.{os.getpid()}{whole.suffix}") if plain else whole
    try:
        yield beside
        if plain:
            with beside.open("rb+") as stream:
                os.fsync(stream.fileno())
            beside.replace(whole)
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(wanted)) from None
    finally:
        if plain:
            beside.unlink(missing_ok=True)


def write_text(file: str | os.PathLike[str], *parts: str) -> None:
    """Write text, that may be long, without copying it."""
    with written(file) as beside, beside.open("w", encoding="utf-8", newline="\n") as stream:
        for part in parts:
            stream.write(part)
