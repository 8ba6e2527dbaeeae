# SPDX-License-Identifier: BSD-3-Clause
"""A checked scene as the row of numbers that the compiled core takes of it, where in the row a key is, and how a study varies it."""

import difflib
import math
import operator
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES, Family
from gyrostat.fields import Field
from gyrostat.schema import interval
from gyrostat.vary import Floats, Number, Plan, as_varied, number_in, read_cases

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["SETTINGS", "Place", "numbers_of", "place_of", "plan_of"]

# Words of a table [vary] beside its keys.
SETTINGS: Final = ("n", "seed", "design", "cases")
T = TypeVar("T")

WIDTHS: Final = {"number": 1, "choice": 1, "vector": 3, "direction": 3, "moments": 3, "quaternion": 4, "inertia": 9}


def _numbers(field: Field, value: Any) -> Iterator[float]:
    """The numbers of a key; NaN where it has no value."""
    if field.form == "record":
        for part in field.parts:
            yield from _numbers(part, None if value is None else value[part.name])
    elif field.form == "records":
        for item in value:
            for part in field.parts:
                yield from _numbers(part, item[part.name])
    elif value is None:
        yield from [math.nan] * WIDTHS[field.form]
    elif field.form == "choice":
        yield float(field.choices.index(value))
    elif field.form == "inertia":
        given = np.array(value, dtype=float)
        yield from (np.diag(given) if given.ndim == 1 else given).ravel().tolist()
    else:
        yield from (value if isinstance(value, tuple) else (value,))


def _field(family: Family, key: str) -> tuple[str, Field]:
    """Table and field of a full key."""
    table, _, name = key.rpartition(".")
    return table, next(field for field in family.keys[table] if field.name == name)


def _value(scene: "Scene", table: str, field: Field) -> Any:
    return scene.tables[table][field.name] if table else scene.top[field.name]


def numbers_of(scene: "Scene") -> Floats:
    """The numbers of a scene in the order of its family's inputs; NaN is what it leaves out."""
    family = FAMILIES[scene.kind]
    made: list[float] = []
    for key, _, _ in family.facts.inputs:
        table, field = _field(family, key)
        made += _numbers(field, _value(scene, table, field))
    return np.array(made)


@dataclass(frozen=True, slots=True)
class Place:
    """Where the number of a key is in the row, and what it may be."""

    key: str  # in full, such as "torque.control[0]"
    numbers: tuple[int, ...]  # two of a product of inertia
    field: Field
    product: bool = False  # a product of inertia, which the bounds of the field do not hold for

    def read(self, value: Number) -> float:
        """A number as it was given: in the unit of the key or with one; of a choice its word. Raises DomainError."""
        if self.field.form == "choice":
            if value not in self.field.choices:
                raise DomainError(f"{self.key} = {value}: use one of {', '.join(self.field.choices)}")
            return float(self.field.choices.index(str(value)))
        try:
            return number_in(value, self.field.unit)
        except DomainError as error:
            raise DomainError(f"{self.key}: {error}") from None

    def outside(self, values: Floats) -> NDArray[np.bool_]:
        """Which of the values (n,) the key does not allow; NaN among them."""
        if self.product:
            return ~np.isfinite(values)
        low, high = self.field.low, self.field.high
        above = values > low if self.field.open_low else values >= low
        below = values < high if self.field.open_high else values <= high
        return ~(above & below)

    @property
    def remedy(self) -> str:
        """What would be allowed."""
        return f"{self.key} is not {'finite' if self.product else interval(self.field) or 'finite'}"


def _indices(key: str, text: str | None, field: Field, tensor: bool) -> tuple[int, ...]:
    """Places of a component among the numbers of a key."""
    found = [int(part) for part in text.split(",")] if text else []
    components = WIDTHS[field.form]
    example = f"{key}[0,1]" if tensor else f"{key}[0]"
    if components == 1:
        if found:
            raise DomainError(f"{key}[{text}]: {key} is one number; leave out [{text}]")
        return (0,)
    if field.form == "inertia" and len(found) == 2 and max(found) < 3:
        i, j = found
        return tuple({3 * i + j, 3 * j + i})
    if field.form == "inertia" and len(found) == 1 and not tensor and found[0] < 3:
        return (4 * found[0],)
    if field.form == "inertia" or len(found) != 1 or found[0] >= components:
        raise DomainError(f"{key}{f'[{text}]' if text else ''}: one component varies at a time; name it, such as {example}, counting from 0")
    return (found[0],)


def _unknown(family: Family, key: str) -> DomainError:
    known = [name for name, _, _ in family.facts.inputs]
    near = difflib.get_close_matches(key, known, 1, 0.5)
    return DomainError(f"{key}: no key of this name can vary; " + (f"did you mean {near[0]}? " if near else "")
                       + f"in scenes of the kind {family.name} these can: {', '.join(known)}")


def place_of(scene: "Scene", key: str) -> Place:
    """Where a number is: "torque.drag", "torque.control[0]" (counted from 0), "body.inertia[0,1]", "wheel[1].rate", "wheel[0].axis[2]"; the
    table may be left out where one only has the key. Raises DomainError."""
    bare = key.replace(" ", "")
    element = re.fullmatch(r"([\w-]+)\[(\d+)\]\.([\w-]+)(?:\[(\d+)\])?", bare)
    single = re.fullmatch(r"([\w.-]+)(?:\[(\d+(?:,\d+)?)\])?", bare)
    family = FAMILIES[scene.kind]
    first = 0
    for full, width, listed in family.facts.inputs:
        table, field = _field(family, full)
        value = _value(scene, table, field)
        if listed:
            if element and element[1] == full:
                if int(element[2]) >= len(value):
                    raise DomainError(f"{key}: the scene has {len(value)} of {full}, counted from 0")
                return _part(key, full, field, first + width * int(element[2]), element[3], element[4], f"{full}[{element[2]}]")
            continue
        if single and field.form == "record" and single[1].startswith(f"{full}."):
            if value is None:
                raise _not_given(full)
            return _part(key, full, field, first, single[1].removeprefix(f"{full}."), single[2], full)
        if single and field.form != "record" and (single[1] == full or (single[1] == field.name and _alone(family, field.name))):
            if value is None:
                raise _not_given(full)
            indices = _indices(full, single[2], field, field.form == "inertia" and isinstance(value[0], tuple))
            product = field.form == "inertia" and indices[0] % 4 != 0
            return Place(full + (f"[{single[2]}]" if single[2] else ""), tuple(first + i for i in indices), field, product)
        first += width
    raise _unknown(family, key)


def _flat(table: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """The keys of a table in full; those of tables in it by their dotted name."""
    for key, value in table.items():
        if isinstance(value, Mapping) and key != "cases":
            yield from _flat(value, f"{before}{key}.")
        else:
            yield before + key, value


def plan_of(scene: "Scene", vary: Mapping[str, Any] | None = None, *, cases: Any = None, **settings: Any) -> tuple[Plan, dict[str, Place]]:
    """Which rows a study has, and where its numbers are, by full key: of what the table [vary] of the scene says and of what is given here, which
    goes first. settings: n, seed, design. Raises DomainError."""
    if not FAMILIES[scene.kind].facts.inputs:
        raise DomainError(f"no number of a scene of the kind {scene.kind} can vary; write it as one of a kind of which it is an instance, "
                          "if gyrostat recognise finds one")
    own = dict(_flat(scene.vary))
    beside = scene.path.parent if scene.path is not None and cases is None else Path()
    table = own.get("cases") if cases is None else cases
    if isinstance(table, str | os.PathLike):
        table = read_cases(beside / table)
    chosen = {name: own.get(name) if settings.get(name) is None else settings[name] for name in ("n", "seed", "design")}
    for name in ("n", "seed"):
        chosen[name] = None if chosen[name] is None else _integer(name, chosen[name])
    places: dict[str, Place] = {}

    def in_full(given: Mapping[str, T]) -> dict[str, T]:
        found: dict[str, T] = {}
        for key, value in given.items():
            place = place_of(scene, key)
            if place.key in found:
                raise DomainError(f"{key}: {place.key} is there twice")
            places[place.key], found[place.key] = place, value
        return found

    listed = {key: tuple(value if isinstance(value, str) else float(value) for value in values) for key, values in in_full(table or {}).items()}
    from_scene = {key: value for key, value in in_full({key: own[key] for key in own if key not in SETTINGS}).items() if key not in listed}
    varied = {key: _varied(key, value) for key, value in {**from_scene, **in_full(vary or {})}.items()}
    _require_apart([places[key] for key in (*listed, *varied)])
    plan = Plan.of(varied, listed, {key: place.read for key, place in places.items()}, chosen["n"], chosen["seed"] or 0, chosen["design"] or "random")
    return plan, {key: places[key] for key in (*listed, *varied)}


def _integer(name: str, value: Any) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise DomainError(f"{name} = {value}: give an integer") from None


def _require_apart(places: list[Place]) -> None:
    """No two keys stand for the same number, as [0,1] and [1,0] of an inertia do. A key itself may be among the cases and vary (Plan.of)."""
    keys: dict[int, str] = {}
    for place in places:
        for number in place.numbers:
            if keys.setdefault(number, place.key) != place.key:
                raise DomainError(f"{place.key}: this is the number that {keys[number]} stands for, too")


def _varied(key: str, value: Any) -> Any:
    try:
        return as_varied(value)
    except DomainError as error:
        raise DomainError(f"{key}: {error}") from None


def _alone(family: Family, name: str) -> bool:
    return sum(key.rpartition(".")[2] == name for key, _, _ in family.facts.inputs) == 1


def _not_given(key: str) -> DomainError:
    return DomainError(f"{key}: the scene has no value of it: give it one, from which the rows depart")


def _part(key: str, full: str, field: Field, first: int, name: str, index: str | None, shown: str) -> Place:
    """The number of a key in a record."""
    for part in field.parts:
        if part.name == name:
            at = _indices(f"{shown}.{name}", index, part, False)[0]
            return Place(f"{shown}.{name}{f'[{index}]' if index else ''}", (first + at,), part)
        first += WIDTHS[part.form]
    raise DomainError(f"{key}: {full} has no key {name}; it has {', '.join(part.name for part in field.parts)}")
