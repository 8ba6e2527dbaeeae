# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the papers again: as printed, right, and by the full motion. Needs matplotlib."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Final

from gyrostat.errors import DomainError
from gyrostat.gallery import deceleration, heavy, rotor, spinning

__all__ = ["figures", "papers", "reproduce"]

Progress = Callable[[float, str], None]

# Each module lists its `figures()` and makes the `drawings(figures)`.
PAPERS: Final[dict[str, ModuleType]] = {"deceleration": deceleration, "heavy": heavy, "rotor": rotor, "spinning": spinning}


def papers() -> list[str]:
    """Names of the papers that can be reproduced."""
    return list(PAPERS)


def figures(paper: str) -> list[str]:
    """Names of the figures of a paper that can be reproduced: its numbers, and words for figures of our own."""
    if paper not in PAPERS:
        raise DomainError(f"paper = {paper!r}: use one of {', '.join(PAPERS)}")
    names: list[str] = PAPERS[paper].figures()
    return names


def reproduce(paper: str, figure: int | str | None, directory: Path, progress: Progress | None = None) -> list[Path]:
    """Draw one figure of a paper, or all, into a folder; the files written. Figures of the same runs share a file.

    progress is called with the share done, from 0 to 1, and the name of the file at hand.
    Raises DomainError for a paper or a figure that is not among `papers` and `figures`.
    """
    names = figures(paper)
    if figure is not None:
        if str(figure) not in names:
            raise DomainError(f"figure = {figure!r}: use one of {', '.join(names)}")
        names = [str(figure)]
    drawings = PAPERS[paper].drawings(names)
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for done, (name, draw) in enumerate(drawings):
        if progress is not None:
            progress(done / len(drawings), name)
        file = directory / f"{name}.png"
        draw().savefig(file, dpi=130)
        files.append(file)
    if progress is not None:
        progress(1.0, "")
    return files
