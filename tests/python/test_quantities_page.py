# SPDX-License-Identifier: BSD-3-Clause
"""docs/command-line.md lists the columns, scalars and rungs that the package knows. --write: write them there anew."""

import sys
from collections.abc import Iterator
from pathlib import Path

from gyrostat.about import family_tables
from gyrostat.families import FAMILIES

PAGE = Path(__file__).resolve().parents[2] / "docs" / "command-line.md"
BEGIN, END = "<!-- begin: written by tests/python/test_quantities_page.py --write -->\n", "<!-- end -->\n"


def _lines() -> Iterator[str]:
    for kind in FAMILIES:
        yield f"### {kind}"
        for title, heads, rows in family_tables(kind):
            yield f"\n{title.partition(': ')[2].capitalize()}:\n"
            yield from (f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |" for row in (heads, ["---"] * len(heads), *rows))
        yield ""


def _page() -> tuple[str, str]:
    """The page as it is and as it ought to be."""
    text = PAGE.read_text(encoding="utf-8")
    before, after = text.split(BEGIN)[0], text.split(END)[1]
    return text, before + BEGIN + "\n".join(_lines()) + END + after


def test_the_page_lists_what_the_package_knows() -> None:
    text, right = _page()
    assert text == right, f"run {sys.executable} {__file__} --write"


if __name__ == "__main__" and "--write" in sys.argv:
    PAGE.write_text(_page()[1], encoding="utf-8")
