# SPDX-License-Identifier: BSD-3-Clause
"""What rounding of the numbers of a scene makes of its answer: the part of an error that no method can take away."""

import contextlib
import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat._core import Monitor
from gyrostat.answer import Answer, DataError
from gyrostat.errors import ConvergenceError, DomainError, SceneError
from gyrostat.facts import Quantity
from gyrostat.families import FAMILIES
from gyrostat.rotation import angle_between, quaternion_from_euler_312
from gyrostat.scenes import Scene

__all__ = ["data_error"]

# By how much a number is moved, of itself, and what one rounding does to it at most: what so many roundings change stands out of the rounding of the
# solution itself, and is in proportion unless the motion is chaotic.
MOVED: Final = 2.0**-47
ROUNDING: Final = 2.0**-53
# Steps of loose tolerances may differ between neighbours; in those of this one or a tighter one what is left of that is below rounding's effect.
STEADY: Final = 1e-10
# A change beyond this is not in proportion.
PROPORTIONAL: Final = 0.1
# More numbers than these, as a table over time may have, are moved several at once, up and down by turns.
MOST: Final = 64
# Not data of the motion, or times, at which a jump may be asked for.
LEFT: Final = frozenset({"solve", "vary", "times", "time", "on", "error"})

Move = dict[tuple[Any, ...], float]  # from the place of a number to its new value


def data_error(scene: Scene, answer: Answer, *, monitor: Monitor | None = None, told: Callable[[float], None] | None = None) -> DataError:
    """Solve a scene again by the rung of its answer, with one number after the other moved to both sides, and add up what changes.

    Numbers that are equal under one key, as the moments of a symmetric body or both halves of a tensor, move together, and zero stays; times do not move.
    A body that is symmetric in turned axes has a tensor whose rounding parts its moments, and that is told.

    monitor : can cancel the work. told : is called with the share that is done, from 0 to 1.
    """
    family = FAMILIES[scene.kind]
    quantities = _judged(answer, family.facts.columns, family.facts.scalars)
    data = dataclasses.replace(scene, written={}).to_dict()
    solving = {**data["solve"], "model": answer.model, "ask": list(quantities)}

    def solved(move: Move) -> Answer | None:
        with contextlib.suppress(SceneError, DomainError, ConvergenceError):
            return family.solve(**family.arguments(scene.with_data(_put(data, move))), monitor=monitor)
        return None

    effect = dict.fromkeys(quantities, 0.0)
    greatest, mostly = dict(effect), dict.fromkeys(effect, "")
    base = None
    for tolerance in (min(STEADY, scene.tolerance), scene.tolerance):
        data["solve"] = {**solving, "tolerance": tolerance}
        base = solved({})
        if base is not None:
            break
    moves = list(_moves(data))
    for done, (key, move) in enumerate(moves):
        sides = [solved(move), solved({place: 2 * _at(data, place) - value for place, value in move.items()})]
        others = [other for other in sides if other is not None]
        for name, quantity in quantities.items():
            off = math.inf if base is None or not others else max(_distance(quantity, base, other) for other in others)
            change = off * (ROUNDING / MOVED) if off < PROPORTIONAL else math.inf
            effect[name] += change
            if change > greatest[name]:
                greatest[name], mostly[name] = change, key
        if told is not None:
            told((done + 1) / len(moves))
    return DataError(effect, mostly)


def _numbers(value: Any, place: tuple[Any, ...]) -> Iterator[tuple[tuple[Any, ...], float]]:
    """Every number that is data, with its place."""
    if isinstance(value, Mapping):
        for key, item in value.items():
            if key not in LEFT:
                yield from _numbers(item, (*place, key))
    elif isinstance(value, list | tuple):
        for i, item in enumerate(value):
            yield from _numbers(item, (*place, i))
    elif isinstance(value, float) and value != 0 and math.isfinite(value):
        yield place, value


def _key(place: tuple[Any, ...]) -> str:
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in place).removeprefix(".")


def _moves(plain: Mapping[str, Any]) -> Iterator[tuple[str, Move]]:
    """The key of each number, and where it and its equals stand, moved."""
    equals: dict[Any, Move] = {}
    for place, value in _numbers(plain, ()):
        equals.setdefault((*(part for part in place if isinstance(part, str)), abs(value)), {})[place] = value
    every = list(equals.values())
    for first in range(min(MOST, len(every))):
        together = every[first::MOST]
        move = {place: value * (1 + (MOVED if i % 2 == 0 else -MOVED)) for i, each in enumerate(together) for place, value in each.items()}
        yield _key(next(iter(move))) + (", ..." if len(together) > 1 else ""), move


def _put(value: Any, move: Move, place: tuple[Any, ...] = ()) -> Any:
    """The value with the numbers that move in their new places."""
    if isinstance(value, Mapping):
        return {key: _put(item, move, (*place, key)) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_put(item, move, (*place, i)) for i, item in enumerate(value)]
    return move.get(place, value)


def _judged(answer: Answer, columns: Mapping[str, Quantity], scalars: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Columns and scalars whose error is stated."""
    numbers = [name for name, value in answer.scalars.items() if value is not None and not math.isnan(answer.scalar_error[name])]
    return {**{name: columns[name] for name in answer.columns if name in answer.error}, **{name: scalars[name] for name in numbers}}


def _at(value: Any, place: tuple[Any, ...]) -> Any:
    for part in place:
        value = value[part]
    return value


def _distance(quantity: Quantity, first: Answer, second: Answer) -> float:
    """Greatest difference of a column or scalar in two answers, in the measure of its error."""
    name = quantity.name
    if name in first.columns:
        a, b = first.columns[name], second.columns.get(name)
        scale = first.scale.get(name, 0.0)
    else:
        a, b = (np.array(made.scalars.get(name), dtype=float).reshape(1, -1) for made in (first, second))
        scale = 0.0
    if b is None or np.shape(a) != np.shape(b):
        return math.inf
    known = np.isfinite(_size(a))
    if np.any(known != np.isfinite(_size(b))):  # one has a value where the other has none
        return math.inf
    if not np.any(known):
        return 0.0
    if quantity.measure == "angle":
        x, y = (quaternion_from_euler_312(each[known]) if quantity.width == 3 else each[known] for each in (a, b))
        return float(np.max(angle_between(x, y)))
    off = float(np.max(_size(a[known] - b[known])))
    size = 1.0 if quantity.measure == "absolute" else max(float(np.max(_size(a[known]))), scale)
    return off / size if off > 0 else 0.0


def _size(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Length of vectors (n, k), size of numbers (n,)."""
    made: NDArray[np.float64] = np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=1)
    return made
