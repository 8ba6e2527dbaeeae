# SPDX-License-Identifier: BSD-3-Clause
"""What a key of a scene file is, and the keys that all kinds have. Those of a kind: families/KIND/scene.py."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final, Literal

__all__ = ["ARRAYS", "Choice", "Choices", "Field", "Found", "GENERAL", "LIMIT", "MOST_SAMPLES", "REQUIRED", "ROUNDING", "TIMES", "Table", "UNSET", "Values",
           "head_keys", "inertia_parts", "needed", "parts_of", "solve_keys", "table_of"]

# An axis is a vector of any length but 0, a turn such a quaternion; a matrix is one number, three along the diagonal, or nine; rows are threes, intervals pairs of numbers.
Form = Literal["text", "choice", "flag", "number", "count", "vector", "axis", "direction", "quaternion", "turn", "rotation", "sequence", "inertia", "moments",
               "matrix", "numbers", "rows", "intervals", "times", "record", "records", "text or record", "number or record", "vector or record", "ask", "vary", "scene"]
# Of several numbers, which may stand in { value = [...], unit = "..." }.
ARRAYS: Final = ("vector", "inertia", "moments", "matrix", "numbers", "rows", "intervals", "times")

GENERAL: Final = "general"  # the kind of a scene that names none
REQUIRED: Final = "required"  # the key must be given
UNSET: Final = None  # the key may be left out and then has no value

# Greatest size of any number: its square, and products of a few of them, stay finite in double precision.
LIMIT: Final = 1e60
MOST_SAMPLES: Final = 1_000_000
# What is of unit length, or at a bound, within this is so by rounding.
ROUNDING: Final = 1e-15


@dataclass(frozen=True, slots=True)
class Field:
    """One key: its form, meaning and legal interval. Bounds hold for every element."""

    name: str
    form: Form
    meaning: str
    unit: str = ""
    default: Any = REQUIRED
    choices: tuple[str, ...] = ()
    low: float = -LIMIT
    high: float = LIMIT
    open_low: bool = False  # the lower bound itself is not allowed
    open_high: bool = False
    parts: tuple["Field", ...] = ()  # of a record, or of each of several: its keys
    # Of records of several sorts: the keys of each sort. A record is of the first sort whose choices it takes in the keys `by`.
    sorts: tuple[tuple["Field", ...], ...] = ()
    by: tuple[str, ...] = ()


Table = tuple[Field, ...]


def parts_of(field: Field, value: Mapping[str, Any]) -> Table | None:
    """The keys of one record; None where it is of no sort."""
    if not field.sorts:
        return field.parts
    for sort in field.sorts:
        tied = [part for part in sort if part.name in field.by]
        if all(value.get(part.name, part.default) in part.choices for part in tied) and not any(
                name in value and all(part.name != name for part in tied) for name in field.by):
            return sort
    return None


def inertia_parts(field: Field) -> Table:
    """The keys of an inertia that is given by moments and products."""
    return (
        Field("moments", "vector", "diagonal of the tensor", field.unit, low=field.low),
        Field("products", "vector", "products of inertia xy, xz, yz", field.unit),
        Field("sign", "choice", 'sign of the products: with "tensor" they are elements of the tensor, -integral of xy dm; with "integral" they are +integral of '
              "xy dm, and the tensor has the negatives", choices=("tensor", "integral")),
    )


# What the checked tables of a scene hold, and what is wrong with them beyond any single key: full key, value, problem and remedy.
Values = Mapping[str, Mapping[str, Any]]
Found = Iterator[tuple[str, Any, str, str]]


def head_keys(kind: str) -> Table:
    """The keys at the top of a scene file."""
    return (
        Field("name", "text", "name of the scene"),
        Field("kind", "choice", "family of the scene", default=GENERAL if kind == GENERAL else REQUIRED, choices=(kind,)),
        Field("source", "text", "where the numbers come from", default=""),
        Field("vary", "vary", "what varies from row to row of a sweep, each key in full and in quotes, and how; beside them n, seed, design, cases",
              default=UNSET),
    )


def solve_keys(rungs: Iterable[str], integrators: Iterable[str]) -> Table:
    """The keys of the table [solve] that all kinds have."""
    return (
        Field("duration", "number", "length of an even grid of times that begins with the motion", "s", UNSET, low=0, open_low=True),
        Field("samples", "count", "number of times of the even grid", "", UNSET, low=2, high=MOST_SAMPLES),
        Field("times", "times", "times of the answer, increasing, the first not before the start", "s", UNSET, low=0),
        Field("tolerance", "number", "greatest relative error wanted in what is asked", "", 1e-6, low=1e-15, high=0.5),
        Field("ask", "ask", "columns and scalars wanted: names, \"all\", or a table of name = tolerance, relative or with a unit", "", UNSET),
        Field("model", "choice", "rung of the ladder, or auto", "", "auto", ("auto", *rungs)),
        Field("integrator", "choice", "for rungs that integrate", "", "auto", ("auto", *integrators)),
    )


# A way to give something: full keys ("table.key"), wanted together. Without keys: it may be left out.
Choice = tuple[str, ...]
# Ways of which exactly one must be taken, whole.
Choices = tuple[Choice, ...]

# The times of every kind.
TIMES: Final[Choices] = (("solve.duration", "solve.samples"), ("solve.times",))


def table_of(key: str) -> str:
    """The table of a full key; empty at the top."""
    return key.rpartition(".")[0]


def needed(table: str, keys: Mapping[str, Table], alternatives: Iterable[Choices]) -> bool:
    """No scene with these keys can do without the table."""
    return any(field.default is REQUIRED for field in keys[table]) or any(
        all(any(table_of(key) == table for key in choice) for choice in choices) for choices in alternatives)
