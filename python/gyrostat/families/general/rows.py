# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a sweep of general scenes: what the keys that vary come to in the numbers of the compiled problem, of all rows at once."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core
from gyrostat.broadcast import Floats
from gyrostat.families import FAMILIES
from gyrostat.families.general.functions import QUESTION, OverRows, posed
from gyrostat.families.general.scene import arguments
from gyrostat.fields import ROUNDING
from gyrostat.orientation import axes_of
from gyrostat.rows import Place, inputs_of, numbers_of, refilled

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["request"]


def request(scene: "Scene", places: Iterable[Place], columns: Iterable[Floats], sound: NDArray[np.bool_]) -> dict[str, Any]:
    """The scene as the compiled core takes it, its numbers, the places of those that vary, and what they are in each row (k, n): NaN in a row that
    is not sound, which is not asked."""
    numbers: list[Any] = numbers_of(scene).tolist()
    for place, column in zip(places, columns, strict=True):
        for number in place.numbers:
            numbers[number] = np.where(sound, column, numbers[number]).view(OverRows)
    alone, varied = _posed(scene), _posed(_with_numbers(scene, iter(numbers)))
    given, names = _core.general_numbers(alone)
    at: list[int] = []
    values: list[Floats] = []
    leaves, single, first = dict(_leaves(varied)), dict(_leaves(alone)), 0
    for name, width in names:
        if width and np.ndim(leaves[name]) > np.ndim(single[name]):
            at += range(first, first + width)
            values.append(np.reshape(leaves[name], (len(sound), width)).T)
        first += width
    every = np.concatenate(values) if values else np.empty((0, len(sound)))
    solve = scene.tables["solve"]
    sequence = axes_of(solve["euler"]) if solve["euler"] else None
    return {"scene": alone, "recognise": solve["recognise"], "euler": sequence, "numbers": given, "places": at, "values": np.where(sound, every, np.nan)}


def _posed(scene: "Scene") -> dict[str, Any]:
    return posed(**{name: value for name, value in arguments(scene).items() if name not in QUESTION})


def _with_numbers(scene: "Scene", numbers: Iterator[Any]) -> "Scene":
    """The scene with other numbers; an attitude is brought to unit length as that of a scene file is."""
    tables, top = {name: dict(table) for name, table in scene.tables.items()}, dict(scene.top)
    for _, table, field in inputs_of(FAMILIES[scene.kind]):
        home = tables[table] if table else top
        made = refilled(field, home[field.name], numbers)
        home[field.name] = _unit_turn(made) if field.form == "turn" and made is not None else made
    return replace(scene, tables=tables, top=top)


def _unit_turn(turn: tuple[Any, ...]) -> tuple[Any, ...]:
    if not any(isinstance(each, OverRows) for each in turn):
        return turn
    rows = np.stack(np.broadcast_arrays(*turn), -1)
    lengths = np.array([math.hypot(*row) for row in rows.tolist()])
    with np.errstate(invalid="ignore"):
        made = np.where((np.abs(lengths - 1) <= ROUNDING)[:, None], rows, rows / lengths[:, None])
    return tuple(column.view(OverRows) for column in np.ascontiguousarray(made.T))


def _leaves(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """What is in dicts and lists of them, by names such as "wheels[0].table.values"."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _leaves(each, f"{name}.{key}" if name else key)
    elif isinstance(value, list):
        for place, each in enumerate(value):
            yield from _leaves(each, f"{name}[{place}]")
    else:
        yield name, value
