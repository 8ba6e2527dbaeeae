# SPDX-License-Identifier: BSD-3-Clause
"""An answer for reading, on the terminal and in a notebook."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, TextIO

from gyrostat.answer import Answer
from gyrostat.console import say, short, show_table, small
from gyrostat.facts import UNITS

__all__ = ["head", "report", "summary", "tables", "tail"]

# Title, heads and rows.
Table = tuple[str, Sequence[str], Sequence[Sequence[str]]]


def summary(answer: Answer) -> str:
    """How the answer was found and how good it is, in a line."""
    return f"answered by {answer.model}: {answer.verdict}"


def head(answer: Answer) -> list[str]:
    """The lines above the tables."""
    lacking = f" ({', '.join(answer.without_value)})" if answer.without_value else ""
    warnings = [f"warning, {w.code}: {w.message}{lacking if w.code == 'no-value' else ''}" for w in answer.warnings]
    return [f"{answer.scene.get('name', '')} ({answer.scene.get('kind', '')})", summary(answer), *warnings]


def tail(answer: Answer) -> str:
    """The line below the tables."""
    return f"{answer.seconds:.3g} s of CPU time; " + ", ".join(f"{value} {key}" for key, value in answer.counts.items())


def _scalar(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, list):  # of names
        return ", ".join(value) or "none"
    if name == "stop_time" and value == math.inf:
        return "never"
    if name == "stable" and value is not None:
        return "yes" if value else "no"
    if name == "attractor" and value is None:
        return "not certified"
    return short(value)


def _time(seconds: float | None) -> str:
    """A cost, in a unit that suits it."""
    if not seconds:
        return "-"
    unit, size = next((u, s) for u, s in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)) if seconds >= s or u == "us")
    return f"{seconds / size:.3g} {unit}"


def tables(answer: Answer) -> Iterator[Table]:
    """What was tried, scalars and columns."""
    tried = [[a.model, small(a.error), "answered" if a.accepted else "passed over", a.why, _time(a.predicted), _time(a.spent)] for a in answer.tried]
    yield "What was tried", ["rung", "estimated error", "", "why", "predicted", "spent"], tried
    more = ["of one rounding of the data", "mostly of"] if answer.data_error else []
    scalars = [[name, _scalar(name, value), UNITS.get(name, ""), small(answer.scalar_error[name]), *_of_data(answer, name)]
               for name, value in answer.scalars.items()]
    yield "Scalars", ["name", "value", "unit", "estimated error", *more], scalars
    columns, count = [], len(answer.t)
    shown = [0, -1] if count > 1 else [0]
    for name, values in answer.columns.items():
        ends = [str(value) if values.dtype.kind == "U" else short(value) for value in values[shown]]
        columns.append([name, UNITS.get(name, ""), *ends, small(answer.error.get(name)), *_of_data(answer, name)])
    heads = ["name", "unit", *(f"t = {t:g} s" for t in answer.t[shown]), "estimated error", *more]
    yield f"Columns, {count} time{'s' if count > 1 else ''}", heads, columns


def _of_data(answer: Answer, name: str) -> list[str]:
    """What one rounding of the data changes, and the number that makes the most of it, where that was asked for."""
    data = answer.data_error
    return [] if data is None else [small(data.effect.get(name)), data.mostly.get(name, "")]


def report(answer: Answer, out: TextIO) -> None:
    """Print the answer."""
    for line in head(answer):
        say(line, out)
    for title, heads, rows in tables(answer):
        show_table(title, heads, rows, out)
    say(tail(answer), out)
