# SPDX-License-Identifier: BSD-3-Clause
"""What all galleries share."""

import textwrap
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Drawing", "finish"]

# Name of the file without its ending, and what draws it.
Drawing = tuple[str, "Callable[[], Figure]"]


def finish(figure: "Figure", title: str, seen: Sequence[str]) -> None:
    """Title above, and below a paragraph for each thing that is seen."""
    figure.suptitle(title, fontsize=13)
    width = round(12.5 * figure.get_figwidth())
    figure.supxlabel("\n".join(textwrap.fill(text, width) for text in seen), fontsize=9, x=0.01, ha="left")
