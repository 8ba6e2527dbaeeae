# SPDX-License-Identifier: BSD-3-Clause
"""Text, tables and progress on the terminal: rich where it is installed and someone is watching, plain text elsewhere."""

import math
import os
import shutil
import sys
import textwrap
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, TextIO

from gyrostat.errors import DomainError

__all__ = ["Progress", "check_output", "leave", "say", "short", "show_table", "small"]


def check_output(file: Path | None) -> None:
    """Raise DomainError where a file cannot be written, for its folder is not there or a folder has its name: to be asked before long work."""
    if file is None:
        return
    if file.parent.exists() and not file.parent.is_dir():
        raise DomainError(f"{file}: {file.parent} is a file, not a folder; name another")
    if not file.parent.is_dir():
        raise DomainError(f"{file}: there is no folder {file.parent}; make it, or name another")
    if file.suffix.lower() == ".zarr" and file.is_file():
        raise DomainError(f"{file}: this is a file, and results in .zarr are a folder; remove it, or name another")
    if file.suffix.lower() != ".zarr" and file.is_dir():
        raise DomainError(f"{file}: this is a folder; name a file, such as {file / f'results{file.suffix}'}")


def short(value: Any, digits: int = 9) -> str:
    """A number or vector for reading."""
    if value is None:
        return "-"
    if hasattr(value, "__len__"):
        return "(" + ", ".join(short(float(v), 6) for v in value) + ")"
    if math.isnan(value):
        return "-"
    return "infinite" if math.isinf(value) else f"{value:.{digits}g}"


def small(error: float | None) -> str:
    """An error for reading."""
    return "-" if error is None or math.isnan(error) else f"{error:.2g}"


def _rich(out: TextIO) -> bool:
    if out is None or not out.isatty():
        return False
    try:
        import rich  # noqa: F401
    except ImportError:
        return False
    return True


def leave(out: TextIO) -> None:
    """Let a stream whose reader went away swallow what else is written."""
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        os.dup2(nowhere.fileno(), out.fileno())


def say(text: str, out: TextIO) -> None:
    """Print a line. Where the standard error takes none the work goes on without."""
    try:
        print(text, file=out)
    except OSError:
        if out is not sys.stderr:
            raise
        leave(out)


def show_table(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]], out: TextIO) -> None:
    """Print a table; columns of numbers stand to the right."""
    if not rows:
        return
    if _rich(out):
        from rich import box
        from rich.console import Console
        from rich.markup import escape
        from rich.table import Table

        table = Table(title=escape(title) or None, title_justify="left", box=box.SIMPLE_HEAD, show_header=any(heads))
        for i, head in enumerate(heads):
            table.add_column(escape(head), no_wrap=i == 0, overflow="fold")
        for row in rows:
            table.add_row(*(escape(cell) for cell in row))
        Console(file=out).print(table)
        return
    widths = [max(len(line[i]) for line in (heads, *rows)) for i in range(len(heads))]
    last_room = max(30, shutil.get_terminal_size((120, 24)).columns - 2 - sum(widths[:-1]) - 2 * (len(widths) - 1))
    if title:
        say(f"\n{title}", out)
    for line in (heads, *rows) if any(heads) else rows:
        start = "".join(f"  {cell:<{width}}" for cell, width in zip(line[:-1], widths[:-1], strict=True))
        parts = textwrap.wrap(line[-1], last_room) or [""]
        say(f"{start}  {parts[0]}".rstrip(), out)
        for part in parts[1:]:
            say(" " * len(start) + f"  {part}", out)


class Progress:
    """A progress bar on the standard error while the block runs; nothing where nobody is watching."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._bar: Any = None
        self._task: Any = None

    def __enter__(self) -> "Progress":
        if _rich(sys.stderr):
            from rich.console import Console
            from rich.markup import escape
            from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

            self._bar = Progress(TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %"),
                                 TimeElapsedColumn(), TimeRemainingColumn(), TextColumn("{task.fields[what]}"),
                                 console=Console(stderr=True), transient=True)
            self._task = self._bar.add_task(escape(self._title), total=1.0, what="")
            self._bar.start()
        return self

    def update(self, done: float, what: str = "") -> None:
        """Show the share done, from 0 to 1, and what is at hand."""
        if self._bar is not None:
            self._bar.update(self._task, completed=done, what=what)

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if self._bar is not None:
            self._bar.stop()
