# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a sweep of general scenes: what the keys that vary come to in the numbers of the compiled problem, of all rows at once."""

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core
from gyrostat.broadcast import Floats
from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES
from gyrostat.families.general.clock import since
from gyrostat.families.general.functions import QUESTION, START_ERRORS, OverRows, posed, stacked, varies
from gyrostat.families.general.scene import arguments
from gyrostat.orientation import axes_of, form_of, quaternions
from gyrostat.rows import Place, inputs_of, numbers_of, refilled

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["posed_of", "request"]


def request(scene: "Scene", places: Iterable[Place], columns: Iterable[Floats], sound: NDArray[np.bool_]) -> dict[str, Any]:
    """The scene as the compiled core takes it, its numbers, the places of those that vary, and what they are in each row (k, n): NaN in a row that
    is not sound, which is not asked."""
    return (_of_plain if scene.starts_plainly else _of_going_on)(scene, list(zip(places, columns, strict=True)), sound)


def _of_plain(scene: "Scene", varied: list[tuple[Place, Floats]], sound: NDArray[np.bool_]) -> dict[str, Any]:
    """Of a scene whose start is its own: all rows at once."""
    numbers: list[Any] = numbers_of(scene).tolist()
    for place, column in varied:
        for number in place.numbers:
            numbers[number] = np.where(sound, column, numbers[number]).view(OverRows)
    alone, together = posed_of(scene), posed_of(_with_numbers(scene, iter(numbers)))
    given, names = _core.general_numbers(alone)
    at: list[int] = []
    values: list[Floats] = []
    leaves, single, first = dict(_leaves(together)), dict(_leaves(alone)), 0
    for name, width in names:
        if width and np.ndim(leaves[name]) > np.ndim(single[name]):
            at += range(first, first + width)
            values.append(np.reshape(leaves[name], (len(sound), width)).T)
        first += width
    every = np.concatenate(values) if values else np.empty((0, len(sound)))
    return {**_asking(scene), "scene": alone, "numbers": given, "places": at, "values": np.where(sound, every, np.nan)}


def _of_going_on(scene: "Scene", varied: list[tuple[Place, Floats]], sound: NDArray[np.bool_]) -> dict[str, Any]:
    """Of a scene that begins where another ends, by a clock that began before, or with an error of its start: row by row, as what is handed on hangs on
    the body of the row."""
    whole: list[float] = numbers_of(scene).tolist()
    alone, given = _going_on(scene)
    rows = np.full((len(sound), len(given)), np.nan)
    for row in np.flatnonzero(sound).tolist():
        numbers = list(whole)
        for place, column in varied:
            for number in place.numbers:
                numbers[number] = float(column[row])
        with contextlib.suppress(DomainError, np.linalg.LinAlgError):  # a row without numbers has no answer
            rows[row] = _going_on(_with_numbers(scene, iter(numbers)))[1]
    at = np.flatnonzero(np.any(rows != given, axis=0)).tolist()
    return {**_asking(scene), "scene": alone, "numbers": given, "places": at, "values": np.ascontiguousarray(rows[:, at].T)}


def _going_on(scene: "Scene") -> tuple[dict[str, Any], Floats]:
    """The scene as the compiled core takes it, and its numbers with those of the error of its start behind them."""
    error = arguments(scene).get("start_error", {})
    made = since(scene.start_time, posed_of(scene))
    return made, np.concatenate([_core.general_numbers(made)[0], [error.get(name, 0.0) for name in START_ERRORS]])


def _asking(scene: "Scene") -> dict[str, Any]:
    solve = scene.tables["solve"]
    return {"recognise": solve["recognise"], "euler": axes_of(solve["euler"]) if solve["euler"] else None}


def posed_of(scene: "Scene") -> dict[str, Any]:
    """The physics of a scene as the compiled ladder takes it."""
    return posed(**{name: value for name, value in arguments(scene).items() if name not in (*QUESTION, "start_time", "start_error")})


def _with_numbers(scene: "Scene", numbers: Iterator[Any]) -> "Scene":
    """The scene with other numbers."""
    tables, top = {name: dict(table) for name, table in scene.tables.items()}, dict(scene.top)
    for _, table, field in inputs_of(FAMILIES[scene.kind]):
        home = tables[table] if table else top
        home[field.name] = refilled(field, home[field.name], numbers)
    form = form_of(tables["initial"])
    if form.startswith("dcm") and (varies(tables["initial"][form]) or tables["initial"][form] != scene.tables["initial"][form]):
        tables["initial"]["attitude"] = _of_matrix(form, tables["initial"][form])
    return replace(scene, tables=tables, top=top)


def _of_matrix(form: str, matrix: tuple[Any, ...]) -> tuple[Any, ...]:
    """The quaternion of direction cosines, of one row or of all."""
    if not varies(matrix):
        return quaternions(form, [matrix])[0]
    made = np.reshape(quaternions(form, np.asarray(stacked(matrix))), (-1, 4))
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
