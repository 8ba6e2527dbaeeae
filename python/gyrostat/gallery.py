# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the papers again: as printed, right, and by the full motion. Needs matplotlib."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from gyrostat.drawing import save
from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES

__all__ = ["figures", "papers", "reproduce"]

Progress = Callable[[float, str], None]


def _part(paper: str) -> Any:
    """What lists the `figures()` of the paper and makes the `drawings(figures)`."""
    if paper not in papers():
        raise DomainError(f"paper = {paper!r}: use one of {', '.join(papers())}")
    return FAMILIES[paper].part("gallery")


def papers() -> list[str]:
    """Names of the papers that can be reproduced."""
    return sorted(name for name, family in FAMILIES.items() if family.part("gallery"))


def figures(paper: str) -> list[str]:
    """Names of the figures of a paper that can be reproduced: its numbers, and words for figures of our own."""
    names: list[str] = _part(paper).figures()
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
    drawings = _part(paper).drawings(names)
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for done, (name, draw) in enumerate(drawings):
        if progress is not None:
            progress(done / len(drawings), name)
        file = directory / f"{name}.png"
        save(draw(), file)
        files.append(file)
    if progress is not None:
        progress(1.0, "")
    return files
