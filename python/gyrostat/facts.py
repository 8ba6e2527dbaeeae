# SPDX-License-Identifier: BSD-3-Clause
"""What the compiled families say of themselves: columns, scalars, rungs, integrators and warnings, with units and meanings."""

from dataclasses import dataclass
from typing import Any, Final

from gyrostat import _core

__all__ = ["FACTS", "TIME", "UNITS", "Facts", "Quantity"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """A column or a scalar of an answer."""

    name: str
    width: int
    unit: str
    meaning: str
    frame: str = ""  # of a column
    measure: str = ""  # how its error is measured: relative, angle, absolute; empty: it has none
    scale: str = ""  # of a relative column: what its error is relative to where the column itself is smaller
    kind: str = "number"  # number, flag (1 yes, 0 no), place (an index into a list), word (a place in `words`), words (some of them)
    words: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Facts:
    """One family."""

    name: str
    columns: dict[str, Quantity]
    scalars: dict[str, Quantity]
    rungs: dict[str, str]  # name -> meaning, from the cheapest on
    integrators: tuple[str, ...]
    warnings: dict[str, str]  # code -> text
    inputs: tuple[tuple[str, int, bool], ...]  # of a row of a sweep, in their order: key, how many numbers, whether any number of these

    @property
    def quantities(self) -> dict[str, Quantity]:
        """Columns and scalars."""
        return {**self.columns, **self.scalars}


def _facts(entry: dict[str, Any]) -> Facts:
    columns, scalars = ({each["name"]: Quantity(**each) for each in entry[what]} for what in ("columns", "scalars"))
    return Facts(entry["name"], columns, scalars, {rung["name"]: rung["meaning"] for rung in entry["rungs"]}, tuple(entry["integrators"]),
                 {warning["code"]: warning["text"] for warning in entry["warnings"]}, tuple(entry["inputs"]))


FACTS: Final[dict[str, Facts]] = {entry["name"]: _facts(entry) for entry in _core.families()}

# Of the columns and scalars of all families, and of the time: a quantity of one name has one unit.
UNITS: Final[dict[str, str]] = {"t": "s", **{q.name: q.unit for facts in FACTS.values() for q in facts.quantities.values()}}
TIME: Final = "time"  # what t means
