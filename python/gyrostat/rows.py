# SPDX-License-Identifier: BSD-3-Clause
"""A checked scene as the row of numbers that the compiled core takes of it, where in the row a key is, and how a study varies it."""

import difflib
import math
import operator
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES, Family
from gyrostat.fields import Field, parts_of
from gyrostat.orientation import FORMS, form_of, rotation_rows
from gyrostat.schema import interval
from gyrostat.vary import Floats, Number, Plan, as_varied, number_in, read_cases, told_of

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["SETTINGS", "Place", "inputs_of", "integer", "numbers_of", "place_of", "plan_of", "refilled", "request", "turned"]

# Words of a table [vary] beside its keys.
SETTINGS: Final = ("n", "seed", "design", "cases")
T = TypeVar("T")

WIDTHS: Final = {"number": 1, "choice": 1, "vector": 3, "axis": 3, "direction": 3, "moments": 3, "quaternion": 4, "turn": 4, "inertia": 9, "matrix": 9,
                 "number or record": 1, "vector or record": 3}
# Numbers of a row of a table.
_ROWS: Final = {"rows": 3, "intervals": 2, "matrix": 3, "rotation": 3}
# As many numbers as are given.
_LISTS: Final = ("numbers", "times", "rows", "intervals", "rotation")


def _parts(field: Field, value: Any) -> tuple[Field, ...]:
    """The keys of a record; none of what is given as a number or a vector, and may be one."""
    if field.form == "records":
        return parts_of(field, value) or ()
    return field.parts if field.form == "record" or isinstance(value, Mapping) else ()


def _numbers(field: Field, value: Any) -> Iterator[float]:
    """The numbers of a key; NaN where it has no value."""
    if field.form == "records":
        for item in value:
            for part in _parts(field, item):
                yield from _numbers(part, item[part.name])
    elif parts := _parts(field, value):
        for part in parts:
            yield from _numbers(part, None if value is None else value[part.name])
    elif field.form not in WIDTHS and field.form not in _LISTS:
        return
    elif value is None:
        yield from [math.nan] * WIDTHS.get(field.form, 0)
    elif field.form == "choice":
        yield float(field.choices.index(value))
    elif field.form == "inertia":
        given = np.array(value, dtype=float)
        yield from (np.diag(given) if given.ndim == 1 else given).ravel().tolist()
    else:
        yield from np.ravel(value).tolist()


def refilled(field: Field, value: Any, numbers: Iterator[Any]) -> Any:
    """The value of a key with other numbers in it, as many as _numbers tells, which may be anything; words stay as they are."""
    if field.form == "records":
        return tuple({**item, **{part.name: refilled(part, item[part.name], numbers) for part in _parts(field, item)}} for item in value)
    if parts := _parts(field, value):
        made = {part.name: refilled(part, None if value is None else value[part.name], numbers) for part in parts}
        return value if value is None else {**value, **made}
    taken = [next(numbers) for _ in _numbers(field, value)]
    if value is None or not taken or field.form == "choice":
        return value
    if field.form == "inertia":
        return tuple(tuple(taken[i:i + 3]) for i in (0, 3, 6))
    if isinstance(value, tuple):
        width = len(taken) // len(value)
        return tuple(tuple(taken[i:i + width]) for i in range(0, len(taken), width)) if isinstance(value[0], tuple) else tuple(taken)
    return taken[0]


def inputs_of(family: Family) -> tuple[tuple[str, str, Field], ...]:
    """The keys that can vary, in their order: full name, table and field. A family of which the compiled core lists none takes all that
    have numbers, but the question and the forms of an attitude that the quaternion stands for: direction cosines vary by themselves."""
    if names := [name for name, _, _ in family.facts.inputs]:
        return tuple((name, *_field(family, name)) for name in names)
    left_out = {field.name for field in FORMS if field.form != "rotation"}
    numeric = {*WIDTHS, *_LISTS, "record", "records"} - {"choice"}
    return tuple((f"{table}.{field.name}" if table else field.name, table, field) for table, fields in family.keys.items() if table != "solve"
                 for field in fields if field.form in numeric and field.name not in left_out)


def _field(family: Family, key: str) -> tuple[str, Field]:
    """Table and field of a full key."""
    table, _, name = key.rpartition(".")
    return table, next(field for field in family.keys[table] if field.name == name)


def _value(scene: "Scene", table: str, field: Field) -> Any:
    return scene.tables[table][field.name] if table else scene.top[field.name]


def numbers_of(scene: "Scene") -> Floats:
    """The numbers of a scene in the order of inputs_of; NaN is what it leaves out."""
    made: list[float] = []
    for _, table, field in inputs_of(FAMILIES[scene.kind]):
        made += _numbers(field, _value(scene, table, field))
    return np.array(made)


@dataclass(frozen=True, slots=True)
class Place:
    """Where the number of a key is in the row, and what it may be."""

    key: str  # in full, such as "torque.control[0]"; by the name of a wheel or torque where that was said
    numbers: tuple[int, ...]  # two of a product of inertia, three of a coefficient that stands for a matrix
    field: Field
    product: bool = False  # a product of inertia, which the bounds of the field do not hold for

    def read(self, value: Number) -> float:
        """A number as it was given: in the unit of the key or with one; of a choice its word. Raises DomainError, which does not name the key."""
        if self.field.form == "choice":
            if value not in self.field.choices:
                raise DomainError(f"{value}: use one of {', '.join(self.field.choices)}")
            return float(self.field.choices.index(str(value)))
        return number_in(value, self.field.unit)

    def outside(self, values: Floats) -> NDArray[np.bool_]:
        """Which of the values (n,) the key does not allow; NaN among them."""
        if self._is_free:
            return ~np.isfinite(values)
        if self.field.form == "choice":
            return np.zeros(values.shape, dtype=bool)
        low, high = self.field.low, self.field.high
        above = values > low if self.field.open_low else values >= low
        below = values < high if self.field.open_high else values <= high
        return ~(above & below)

    def why(self, value: float) -> str:
        """What would be allowed in the place of a value that is outside."""
        if not math.isfinite(value):
            return f"{self.key} is not finite"
        return f"{self.key} is over {self.field.high:g}" if value > self.field.high else f"{self.key} is not {interval(self.field) or f'>= {self.field.low:g}'}"

    @property
    def _is_free(self) -> bool:
        """Any number may stand here: what it must be hangs on others."""
        return self.product or self.field.form == "rotation"


def _indices(key: str, text: str | None, field: Field, value: Any) -> tuple[int, ...]:
    """Places of a component among the numbers of a key."""
    found = [int(part) for part in text.split(",")] if text else []
    components = sum(1 for _ in _numbers(field, value))
    width = 3 if field.form == "inertia" else _ROWS.get(field.form)
    alone = field.form == "inertia" and not isinstance(value[0], tuple)  # one index names a component as well as two
    if WIDTHS.get(field.form) == 1:
        if found:
            raise DomainError(f"{key}[{text}]: {key} is one number; leave out [{text}]")
        return (0,)
    if field.form == "inertia" and len(found) == 2 and max(found) < 3:
        i, j = found
        return tuple({3 * i + j, 3 * j + i})
    if field.form == "matrix" and not np.any(np.array(value) - np.diag(np.diag(value))):
        alone = True
        if not found and np.all(np.diag(value) == value[0][0]):
            return (0, 4, 8)  # one number for all axes
    if alone and len(found) == 1 and found[0] < 3:
        return (4 * found[0],)
    if width and len(found) == 2 and found[1] < width and width * found[0] < components:
        return (width * found[0] + found[1],)
    if width or len(found) != 1 or found[0] >= components:
        one = 2 if alone else -1 if width else components - 1
        raise DomainError(f"{key}{f'[{text}]' if text else ''}: {_no_component(key, found, one, (components // width - 1, width - 1) if width else None)}")
    return (found[0],)


def _no_component(key: str, found: list[int], last: int, ends: tuple[int, int] | None) -> str:
    """Why there is no component of these indices. last: the greatest index where one index names one, else -1; ends: the greatest of two, where two do."""
    example = f"{key}[0]" if last >= 0 else f"{key}[0,1]"
    if not found:
        return f"one component varies at a time; name it, such as {example}, counting from 0"
    if len(found) == 1 and last < 0:
        return f"two indices name a component here, that of its row and that of its column, such as {example}; they count from 0"
    if len(found) == 2 and ends is None:
        return f"one index names a component here; write {example}, counting from 0"
    return "there is no such component; " + (f"they count from 0 to {last}" if len(found) == 1 or ends is None else
                                             f"rows count from 0 to {ends[0]}, columns to {ends[1]}")


def _unknown(family: Family, key: str) -> DomainError:
    known = [name for name, _, _ in inputs_of(family)]
    near = difflib.get_close_matches(key, known, 1, 0.6)
    whole = next((name for name in known if key.startswith(f"{name}.")), "")  # told by another form of it
    if whole:
        return DomainError(f"{key}: no key of this name can vary; {whole} varies by its components, such as {whole}[0,0], whichever form the scene gives it in")
    return DomainError(f"{key}: no key of this name can vary; " + (f"did you mean {near[0]}? " if near else "")
                       + f"in scenes of the kind {family.name} these can: {', '.join(known)}")


def place_of(scene: "Scene", key: str) -> Place:
    """Where a number is: "torque.drag", "torque.control[0]" (counted from 0), "body.inertia[0,1]", "wheel[1].rate", "wheel[0].axis[2]",
    "torque[0].factor.mean", "wheel.pitch.rate" of the one named pitch; the table may be left out where one only has the key. Raises DomainError."""
    place = _located(scene, key)
    if place.key.startswith("orbit.") and all(scene.tables["orbit"][name] is None for name in ("radius", "altitude", "rate", "period")):
        raise DomainError(f"{key}: the scene has no orbit: give it one, from which the rows depart")
    if place.field.form == "choice" and not FAMILIES[scene.kind].facts.inputs:
        raise DomainError(f"{key}: this is a word; in scenes of the kind {scene.kind} numbers alone vary")
    return place


def _located(scene: "Scene", key: str) -> Place:
    bare = key.replace(" ", "").replace("][", ",")
    element = re.fullmatch(r"([\w-]+)\[(\d+)\]\.([\w.-]+)(?:\[(\d+(?:,\d+)?)\])?", bare)
    single = re.fullmatch(r"([\w.-]+)(?:\[(\d+(?:,\d+)?)\])?", bare)
    family = FAMILIES[scene.kind]
    first = 0
    for full, table, field in inputs_of(family):
        value = _value(scene, table, field)
        if field.form == "records":
            if (by_place := _by_place(full, value, bare)) != bare:
                found = _located(scene, by_place)
                return replace(found, key=bare) if re.fullmatch(r"[\w.,\[\]-]+", key) else found  # a file takes no other names
            if element and element[1] == full:
                place = int(element[2])
                if place >= len(value):
                    raise DomainError(f"{key}: the scene has {len(value)} of {full}, counted from 0")
                first += sum(1 for _ in _numbers(field, value[:place]))
                return _part(key, (full, f"{full}[{place}]"), _parts(field, value[place]), value[place], first, (element[3], element[4]))
        elif (parts := _parts(field, value)) and single and single[1].startswith(f"{full}."):
            if value is None:
                raise _not_given(full)
            return _part(key, (full, full), parts, value, first, (single[1].removeprefix(f"{full}."), single[2]))
        elif parts and single and single[1] == full:
            given = [part.name for part in parts if value is not None and value[part.name] is not None]
            raise DomainError(f"{key}: {full} is given by keys of its own; name one of them, such as {full}.{given[0]}" if given else str(_not_given(full)))
        elif not parts and single and (single[1] == full or (single[1] == field.name and _alone(family, field.name))):
            return _place(full, field, value, first, single[2])
        first += sum(1 for _ in _numbers(field, value))
    raise _unknown(family, key)


def _by_place(full: str, records: Iterable[Mapping[str, Any]], key: str) -> str:
    """The key with the place of a record for its name, `wheel[1].rate` for `wheel.pitch.rate`; as it is where it names none of them, or several."""
    names = [str(item.get("name") or "").replace(" ", "") for item in records]
    found = [name for name in names if name and names.count(name) == 1 and key.startswith(f"{full}.{name}.")]
    if not found:
        return key
    name = max(found, key=len)  # which may have points in it
    return f"{full}[{names.index(name)}]{key.removeprefix(f'{full}.{name}')}"


def _place(full: str, field: Field, value: Any, first: int, index: str | None) -> Place:
    if value is None:
        raise _not_given(full)
    indices = _indices(full, index, field, value)
    return Place(full + (f"[{index}]" if index else ""), tuple(first + i for i in indices), field, field.form == "inertia" and indices[0] % 4 != 0)


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
    own = dict(_flat(scene.vary))
    beside = scene.path.parent if scene.path is not None and cases is None else Path()
    table = own.get("cases") if cases is None else cases
    if isinstance(table, str | os.PathLike):
        table = read_cases(beside / table)
    table = _columns({} if table is None else table)
    chosen = {name: own.get(name) if settings.get(name) is None else settings[name] for name in ("n", "seed", "design")}
    for name in ("n", "seed"):
        chosen[name] = None if chosen[name] is None else integer(name, chosen[name])
    places: dict[str, Place] = {}

    def in_full(given: Mapping[str, T]) -> dict[str, T]:
        found: dict[str, T] = {}
        for key, value in given.items():
            place = place_of(scene, key)
            if place.key in found:
                raise DomainError(f"{key}: {place.key} is there twice")
            places[place.key], found[place.key] = place, value
        return found

    listed = {key: tuple(value if isinstance(value, str) else float(value) for value in values) for key, values in in_full(table).items()}
    from_scene = {key: value for key, value in in_full({key: own[key] for key in own if key not in SETTINGS}).items() if key not in listed}
    if not isinstance(vary or {}, Mapping) or not all(isinstance(key, str) for key in vary or {}):
        raise DomainError(f"vary = {str(vary)[:60]}: give a table, key -> how it varies")
    varied = {}
    for key, value in {**from_scene, **in_full(vary or {})}.items():
        with told_of(key):
            varied[key] = each = as_varied(value)
        if places[key].field.form == "choice" and each.name not in ("list", "choice"):
            raise DomainError(f"{key}: this is a word: write choice(...), or a list of words")
    _require_apart([places[key] for key in (*listed, *varied)])
    if "initial.time" in places:
        raise DomainError("initial.time: all rows have one clock, as they have the same times; make a study for each")
    plan = Plan.of(varied, listed, {key: place.read for key, place in places.items()}, chosen["n"], chosen["seed"] or 0, chosen["design"] or "random")
    return plan, {key: places[key] for key in (*listed, *varied)}


def _columns(table: Any) -> dict[str, Any]:
    """A table of cases by its keys. Raises DomainError."""
    wanted = "cases: give a table, key -> as many values of each, or the name of a file in CSV"
    if not hasattr(table, "items"):
        raise DomainError(wanted)
    found = {str(key): list(values) if isinstance(values, Iterable) and not isinstance(values, str) else None for key, values in table.items()}
    if any(values is None or not all(isinstance(value, str | Real) and not isinstance(value, bool) for value in values) for values in found.values()):
        raise DomainError(wanted)
    return found


def integer(name: str, value: Any) -> int:
    try:
        if not isinstance(value, bool):
            return operator.index(value)
    except TypeError:
        pass
    raise DomainError(f'{name} = "{value}": give an integer without quotes' if isinstance(value, str) else f"{name} = {value}: give an integer")


def _require_apart(places: list[Place]) -> None:
    """No two keys stand for the same number, as [0,1] and [1,0] of an inertia do. A key itself may be among the cases and vary (Plan.of)."""
    keys: dict[int, str] = {}
    for place in places:
        for number in place.numbers:
            if keys.setdefault(number, place.key) != place.key:
                raise DomainError(f"{place.key}: this is the number that {keys[number]} stands for, too")


def request(scene: "Scene", places: Iterable[Place], columns: Iterable[Floats], sound: NDArray[np.bool_]) -> dict[str, Any]:
    """What the compiled sweep takes of a scene and its rows: its numbers, the places of those that vary, and what they are in each row (k, n): NaN
    in a row that is not sound, which is not asked."""
    if own := FAMILIES[scene.kind].part("rows"):
        made: dict[str, Any] = own.request(scene, places, columns, sound)
        return made
    held = [(number, np.where(sound, column, np.nan)) for place, column in zip(places, columns, strict=True) for number in place.numbers]
    return {"numbers": numbers_of(scene), "places": [number for number, _ in held], "values": np.array([column for _, column in held])}


def turned(scene: "Scene", places: Iterable[Place], columns: Iterable[Floats], n: int) -> tuple[list[str], NDArray[np.bool_]] | None:
    """Of n rows of a scene that begins with direction cosines: why those of a row are no rotation, empty where they are one, and which are rounded; None
    for a scene that gives its attitude in another form."""
    initial = scene.tables.get("initial", {})
    form = form_of(initial)
    if not form.startswith("dcm"):
        return None
    matrices = np.tile(np.array(initial[form], dtype=float), (n, 1, 1))
    for place, column in zip(places, columns, strict=True):
        if place.field.name == form:
            number = place.numbers[0] - place_of(scene, f"initial.{form}[0,0]").numbers[0]
            matrices[:, number // 3, number % 3] = column
    return rotation_rows(matrices)


def _alone(family: Family, name: str) -> bool:
    return sum(key.rpartition(".")[2] == name for key, _, _ in inputs_of(family)) == 1


def _not_given(key: str) -> DomainError:
    return DomainError(f"{key}: the scene has no value of it: give it one, from which the rows depart")


def _part(key: str, shown: tuple[str, str], parts: tuple[Field, ...], value: Mapping[str, Any], first: int, asked: tuple[str, str | None]) -> Place:
    """The number of a key in a record, or in a record in it. shown: name of the record for a message, and as it begins the full key."""
    name, _, deeper = asked[0].partition(".")
    numeric = [part for part in parts if any(True for _ in _numbers(part, value[part.name])) or value[part.name] is None and part.form != "text"]
    for part in parts:
        if part.name == name and part in numeric:
            full, given = f"{shown[1]}.{name}", value[name]
            if not deeper and not _parts(part, given):
                return _place(full, part, given, first, asked[1])
            if deeper and given is not None and (inner := _parts(part, given)):
                return _part(key, (full, full), inner, given, first, (deeper, asked[1]))
        first += sum(1 for _ in _numbers(part, value[part.name]))
    raise DomainError(f"{key}: {shown[0]} has no key {name}; it has {', '.join(part.name for part in numeric)}")
