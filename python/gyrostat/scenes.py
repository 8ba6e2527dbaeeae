# SPDX-License-Identifier: BSD-3-Clause
"""Scene files: read, checked in full, and handed on as a `Scene`. Whatever is wrong comes back as one `SceneError`."""

import difflib
import json
import math
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from dataclasses import field as member
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.asking import AskError, asked, knows_attitude, parse_ask
from gyrostat.errors import DomainError, Mistake, Refused, SceneError
from gyrostat.families import FAMILIES, Family
from gyrostat.fields import ARRAYS, GENERAL, LIMIT, MOST_SAMPLES, REQUIRED, ROUNDING, TIMES, UNSET, Choices, Field, Table, Values, inertia_parts, parts_of, table_of
from gyrostat.orientation import axes_of, form_of, require_rotation, settle
from gyrostat.rows import SETTINGS, plan_of
from gyrostat.units import PATTERN, SHARE_PATTERN, spelled, split, to_si

__all__ = ["Scene", "bundled", "find", "load", "parse_override", "scene_from"]

MOST_BYTES: Final = 64 * 2**20
# Scenes that go on from each other.
MOST_BEFORE: Final = 16
# An attitude is taken as a unit quaternion when its norm is 1 within this.
UNIT_TOLERANCE: Final = 1e-6
# An axis is taken as a unit vector when its length is 1 within this.
AXIS_TOLERANCE: Final = 1e-8
# Off-diagonal pairs, and the triangle inequality, may be off by this share of the largest element.
TENSOR_TOLERANCE: Final = 1e-9
# Where the moments themselves are used, as they stand, they may miss the triangle inequality by rounding alone.
MOMENTS_TOLERANCE: Final = 1e-15


@dataclass(frozen=True, eq=False)
class Scene:
    """A checked scene: what `tables` holds is complete (defaults filled in), finite and physical, in SI units; the attitude at the start, in
    whatever form it was given, is the quaternion `attitude`, too.

    `written` holds by full key what was given with units. `path` is the file it came from, or None. Change a value with `replace`, which checks again.
    Scenes are equal that say the same, whatever files they came from.
    """

    name: str
    kind: str
    source: str
    tables: Values
    path: Path | None = None
    top: Mapping[str, Any] = member(default_factory=dict)  # keys of the kind's own at the top, such as the wheels
    written: Mapping[str, Any] = member(default_factory=dict)
    before: "Scene | None" = member(default=None, repr=False)  # the scene at whose end this one begins

    @property
    def times(self) -> NDArray[np.float64]:
        """Times of the answer (n,) [s]."""
        return self._times.copy()

    @cached_property
    def _times(self) -> NDArray[np.float64]:
        solve = self.tables["solve"]
        if solve["times"] is not UNSET:
            return np.array(solve["times"], dtype=np.float64)
        begin = self.start_time
        return np.linspace(begin, begin + solve["duration"], solve["samples"])

    @property
    def start_time(self) -> float:
        """Where the clock of this scene begins [s]: by default 0, or at the last time of the scene before it."""
        if self.before is not None:
            return float(self.before.times[-1])
        return float(self.tables.get("initial", {}).get("time") or 0.0)

    @property
    def starts_plainly(self) -> bool:
        """The start is told by the scene itself, without error, at t = 0."""
        start = self.tables.get("initial", {})
        return self.before is None and not start.get("time") and start.get("error") is UNSET

    @property
    def tolerance(self) -> float:
        """Greatest relative error wanted in any output column."""
        return float(self.tables["solve"]["tolerance"])

    @property
    def vary(self) -> Mapping[str, Any]:
        """The table [vary]: what varies from row to row of a sweep."""
        return self.top.get("vary") or {}

    @property
    def model(self) -> str:
        """Rung asked for, or "auto"."""
        return str(self.tables["solve"]["model"])

    def to_dict(self) -> dict[str, Any]:
        """Plain data in the layout of a scene file, with units where they were given; keys without a value are left out."""
        made: dict[str, Any] = {"name": self.name, "kind": self.kind}
        if self.source:
            made["source"] = self.source
        made |= {key: self.written.get(key, _plain(value)) for key, value in self.top.items() if value}
        for table, values in self.tables.items():
            instead = table == "initial" and form_of(values)  # of the attitude
            if given := {key: self.written.get(f"{table}.{key}", _plain(value)) for key, value in values.items()
                         if value is not UNSET and not (instead and key == "attitude")}:
                made[table] = given
        return made

    @cached_property
    def _words(self) -> str:
        """All that it says, and what the scenes before it say."""
        return json.dumps([self.to_dict(), self.before and self.before._words], default=str)

    def __eq__(self, other: object) -> bool:
        return self._words == other._words if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._words)

    def told(self) -> dict[str, Any]:
        """As to_dict(), for wherever it is read: the file that the motion goes on `from` by its full path, unless it is bundled."""
        made = self.to_dict()
        if self.before is not None and self.before.path is not None:
            given = made["from"]
            name = given if isinstance(given, str) else given["file"]
            if name not in dict(bundled()):
                full = str(self.before.path.resolve())
                made["from"] = full if isinstance(given, str) else {**given, "file": full}
        return made

    def replace(self, **overrides: Any) -> "Scene":
        """The same scene with some keys changed: by name (`tolerance=1e-9`) or dotted (`**{"torque.drag": 0.0}`)."""
        if not overrides:
            return self
        return self._changed(overrides) or self.with_data(self.to_dict(), overrides)

    def with_data(self, data: Mapping[str, Any], overrides: Mapping[str, Any] | None = None) -> "Scene":
        """The scene that plain data make in the place of this one, beside the same file."""
        return _check(data, _Source(self._label(), path=self.path), overrides or {})

    def _changed(self, overrides: Mapping[str, Any]) -> "Scene | None":
        """The scene with keys changed that stand alone, or were chosen among alternatives before, or are times, where all is well; None: the whole is to be
        checked."""
        family = FAMILIES[self.kind]
        tables, written, of_motion, new_times = dict(self.tables), dict(self.written), False, set()
        for key, value in overrides.items():
            found = family.single_keys.get(key) or family.chosen_keys.get(key) or family.time_keys.get(key)
            if found is None:
                return None
            table, field = found
            if key in family.time_keys and value is not None:
                new_times.add(f"{table}.{field.name}")
            elif key not in family.single_keys and (value is None or self.tables[table][field.name] is UNSET):
                return None
            try:
                read = _read(field, value := _plain(value))
            except Refused:
                return None
            tables[table] = {**tables[table], field.name: read}
            of_motion |= table != "solve" or field.name in ("ask", "euler")
            written.pop(f"{table}.{field.name}", None)
            if _worded(field, value):
                written[f"{table}.{field.name}"] = _told(field, value, read)
        if new_times and not _one_way(tables, written, new_times):
            return None
        if of_motion:
            try:
                asked(self.kind, tables["solve"]["ask"], knows_attitude(self.kind, tables))
            except AskError:
                return None
            if any(family.mistakes({"": self.top, **tables})):
                return None
        made = Scene(self.name, self.kind, self.source, tables, self.path, self.top, written, self.before)
        if not new_times and made.start_time == self.start_time:
            made.__dict__["_times"] = self._times
        elif made._times[0] < made.start_time:
            return None
        return made

    def _label(self) -> str:
        return self.name if self.path is None else str(self.path)

    def _repr_html_(self) -> str:
        from gyrostat.notebook import scene_html

        return scene_html(self)


def _one_way(tables: dict[str, Any], written: dict[str, Any], new: set[str]) -> bool:
    """Leave of the alternative ways of telling times the one to which the new keys belong; False: they are none, or not whole."""
    chosen = [choice for choice in TIMES if new <= set(choice)]
    if not chosen:
        return False
    for key in (key for choice in TIMES if choice not in chosen for key in choice):
        table, _, name = key.rpartition(".")
        tables[table] = {**tables[table], name: UNSET}
        written.pop(key, None)
    return all(tables[table_of(key)][key.rpartition(".")[2]] is not UNSET for key in chosen[0])


@dataclass
class _Source:
    """Where the data came from, for messages."""

    label: str
    text: str = ""
    path: Path | None = None
    after: tuple[Path, ...] = ()  # the files of scenes that go on from this one
    overridden: frozenset[str] = frozenset()

    def where(self, key: str, element: int = 1) -> str:
        """element: which of the tables of an array of tables, counted from 1."""
        if key in self.overridden:
            return f"{self.label} (set on the command line or by keyword)"
        line = self._line(key, element)
        return f"{self.label}:{line}" if line else self.label

    def _line(self, key: str, element: int) -> int:
        table, _, name = key.rpartition(".")
        inside, seen = "", 0
        for number, line in enumerate(self.text.splitlines(), 1):
            if header := re.match(r"\s*\[+\s*([\w.-]+)\s*\]+", line):
                inside = header[1]
                seen += inside == key
                if seen == element:
                    return number
            elif (found := re.match(r"\s*([\w-]+)\s*=", line)) and found[1] == name and inside == table:
                return number
        return 0


def _plain(value: Any) -> Any:
    """Numpy arrays, tuples and mappings as lists and dicts, keys without a value left out; other things as they are."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items() if item is not UNSET}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value


def _show(value: Any) -> str:
    """A value as it would stand in a scene file, at most about 60 characters."""
    if isinstance(value, bool):
        text = "true" if value else "false"
    elif isinstance(value, int) and value.bit_length() > 200:
        text = f"an integer of {value.bit_length()} bits"
    elif isinstance(value, str):
        text = '"' + (value if len(value) < 60 else value[:57] + "...") + '"'
    elif isinstance(value, list | tuple):
        shown = []
        for item in value[:9]:
            shown.append(_show(item))
            if sum(map(len, shown)) > 60:
                break
        text = "[" + ", ".join(shown) + (", ..." if len(shown) < len(value) else "") + "]"
    elif isinstance(value, dict):
        text = "a table" if value else "an empty table"
    elif isinstance(value, int | float):
        text = repr(value)
    else:
        text = str(value)
    return "".join(c if c.isprintable() else "?" for c in text)[:90]


def _kind_of(value: Any) -> str:
    names = {bool: "a truth value", str: "text", list: "an array", dict: "a table", int: "an integer", float: "a number"}
    return names.get(type(value), f"of type {type(value).__name__}")


def _near(word: str, words: Iterable[str]) -> str:
    found = difflib.get_close_matches(word, list(words), 1, 0.6)
    return found[0] if found else ""


# ---- one reader a form; each returns the value to keep or raises Refused(problem, remedy) ----


def _text(field: Field, value: Any) -> str:
    if not isinstance(value, str):
        raise Refused(f"this is {_kind_of(value)}, not text", f'write {field.name} = "..." in quotes')
    if any("\ud800" <= c <= "\udfff" for c in value):
        raise Refused("the text holds half a character", "write valid Unicode text")
    if field.default is REQUIRED and not value.strip():
        raise Refused("the text is empty", f"write the {field.meaning}")
    return value


def _choice(field: Field, value: Any) -> str:
    if value in field.choices and isinstance(value, str):
        return value
    allowed = f"use one of {', '.join(field.choices)}"
    if not isinstance(value, str):
        raise Refused(f"this is {_kind_of(value)}, not text", allowed)
    if field.name == "integrator" and any(value in family.facts.integrators for family in FAMILIES.values()):
        raise Refused("this kind of scene has no such integrator", allowed)
    near = _near(value, field.choices)
    raise Refused(f"unknown {field.name}", f'did you mean "{near}"? {allowed}' if near else allowed)


def _with_unit(field: Field, text: str, element: str) -> float:
    """The number of a text, in SI units."""
    what = f"{element} = {_show(text)}: " if element else ""
    try:
        number, unit = split(text)
        if unit and (field.unit or (field.name == "tolerance" and re.fullmatch(SHARE_PATTERN, text))):
            return to_si(number, unit, field.unit)
    except Refused as error:
        raise Refused(what + error.problem, error.remedy) from None
    if field.unit:
        raise Refused(f"{what}this is a text without a unit", f'give a number ({field.unit}) without quotes, or a text with its unit: '
                      f'"{text.strip()} {field.unit}"')
    of_one = '; a tolerance with a unit is that of one column or scalar, as in ask = { attitude = "0.1 deg" }' if field.name == "tolerance" and unit else ""
    raise Refused(f"{what}this is text, and what is wanted has no unit", f"give the bare number without quotes{of_one}")


def _number(field: Field, value: Any, element: str = "") -> float:
    unit = f" ({field.unit})" if field.unit else ""
    if isinstance(value, bool) or not isinstance(value, int | float):
        if not isinstance(value, str):
            raise Refused(f"{element or 'this'} is {_kind_of(value)}, not a number", f"give a number{unit} without quotes")
        number = _with_unit(field, value, element)
    else:
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
    what = f"{element} = {_show(value)}" if element else "this"
    if not math.isfinite(number):
        raise Refused(f"{what} is not finite", f"give a finite number{unit}")
    if not field.low <= number <= field.high or (field.open_low and number == field.low) or (field.open_high and number == field.high):
        most = f" and <= {LIMIT:g}" if number > LIMIT and field.low > -LIMIT and field.high >= LIMIT else ""
        raise Refused(f"{what} is out of range", f"give a number {_interval(field)}{most}{unit}")
    return number


def _interval(field: Field) -> str:
    low = f"{'> ' if field.open_low else '>= '}{field.low:g}" if field.low > -LIMIT else f">= -{LIMIT:g}"
    if field.high < LIMIT:
        return f"{low} and {'<' if field.open_high else '<='} {field.high:g}"
    return low if field.low > -LIMIT else f"of size at most {LIMIT:g}"


def _flag(field: Field, value: Any) -> bool:
    if not isinstance(value, bool):
        raise Refused(f"this is {_kind_of(value)}, not a truth value", f"write {field.name} = true or {field.name} = false")
    return value


def _count(field: Field, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise Refused(f"this is {_kind_of(value)}, not an integer", f"write an integer, such as {field.name} = 401")
    if not field.low <= value <= field.high:
        raise Refused("this is out of range", f"give an integer from {field.low:.0f} to {field.high:.0f}")
    return value


def _list(value: Any, length: int, example: str) -> list[Any]:
    if not isinstance(value, list):
        raise Refused(f"this is {_kind_of(value)}, not an array", f"write {length} numbers, such as {example}")
    if len(value) != length:
        raise Refused(f"the array has {len(value)} elements", f"write {length} numbers, such as {example}")
    return value


def _vector(field: Field, value: Any) -> tuple[float, ...]:
    items = _list(value, 3, "[0.1, 0.2, 0.3]")
    return tuple(_number(field, item, f"element {i}") for i, item in enumerate(items, 1))


def _axis(field: Field, value: Any) -> tuple[float, ...]:
    axis = _vector(field, value)
    if not any(axis):
        raise Refused("a zero vector has no direction", "write a vector along the axis, such as [0.0, 0.0, 1.0]")
    return axis


def _numbers(field: Field, value: Any) -> tuple[float, ...]:
    if not isinstance(value, list) or not value:
        raise Refused(f"this is {'an empty array' if value == [] else _kind_of(value)}, not an array of numbers", f"write {field.name} = [0.0, 1.0, 2.5]")
    if len(value) > MOST_SAMPLES:
        raise Refused(f"there are {len(value)} numbers", f"give at most {MOST_SAMPLES}")
    return tuple(_number(field, item, f"element {i}") for i, item in enumerate(value, 1))


def _table_rows(field: Field, value: Any, width: int, example: str) -> tuple[tuple[float, ...], ...]:
    if not isinstance(value, list) or not value:
        raise Refused(f"this is {'an empty array' if value == [] else _kind_of(value)}, not an array of arrays", f"write {field.name} = [{example}, ...]")
    made = []
    for i, row in enumerate(value, 1):
        if not isinstance(row, list) or len(row) != width:
            raise Refused(f"element {i} is not an array of {width} numbers", f"write {field.name} = [{example}, ...]")
        made.append(tuple(_number(field, item, f"element ({i}, {j})") for j, item in enumerate(row, 1)))
    return tuple(made)


def _matrix(field: Field, value: Any) -> tuple[tuple[float, ...], ...]:
    """One number, three along the diagonal, or three rows of three."""
    if not isinstance(value, list):
        diagonal: tuple[float, ...] = (_number(field, value),) * 3
    elif any(isinstance(item, list) for item in value):
        return tuple(map(tuple, _rows(field, _list(value, 3, "three rows of three"), "a matrix")))
    else:
        diagonal = _vector(field, value)
    return tuple(tuple(diagonal[i] if i == j else 0.0 for j in range(3)) for i in range(3))


def _intervals(field: Field, value: Any) -> tuple[tuple[float, ...], ...]:
    made = _table_rows(field, value, 2, "[0.0, 10.0]")
    last = -math.inf
    for i, (begin, end) in enumerate(made, 1):
        if not begin < end:
            raise Refused(f"interval {i} ends at {end!r}, not after its begin {begin!r}", "write begin and end of each, as [[0.0, 10.0]]")
        if begin < last:
            raise Refused(f"interval {i} begins at {begin!r}, before the end of the one ahead, {last!r}", "put the intervals in order, none in another")
        last = end
    return made


def _unit(numbers: tuple[float, ...], tolerance: float, what: str) -> tuple[float, ...]:
    norm = math.hypot(*numbers)
    if abs(norm - 1) > tolerance:
        unit = ", ".join(f"{x / norm:.15g}" for x in numbers)
        raise Refused(f"the norm is {norm:.9g}, not 1", f"write the unit {what} [{unit}]")
    return numbers if abs(norm - 1) <= ROUNDING else tuple(x / norm for x in numbers)


def _quaternion(field: Field, value: Any) -> tuple[float, ...]:
    order, identity = ("w, x, y, z", "[1.0, 0.0, 0.0, 0.0]") if field.name == "quaternion_scalar_first" else ("x, y, z, w", "[0.0, 0.0, 0.0, 1.0]")
    items = _list(value, 4, f"{identity} ({order})")
    q = tuple(_number(field, item, f"element {i}") for i, item in enumerate(items, 1))
    if not any(q):
        raise Refused("a zero quaternion is no rotation", f"write a unit quaternion [{order}], such as {identity}")
    return _unit(q, UNIT_TOLERANCE, "quaternion")


def _turn(field: Field, value: Any) -> tuple[float, ...]:
    """A quaternion of any length but 0."""
    items = _list(value, 4, "[0.0, 0.0, 0.0, 1.0] (x, y, z, w)")
    q = tuple(_number(field, item, f"element {i}") for i, item in enumerate(items, 1))
    if not any(q):
        raise Refused("a zero quaternion is no rotation", "write a quaternion [x, y, z, w], such as [0.0, 0.0, 0.0, 1.0]")
    return _unit(q, math.inf, "quaternion")


def _direction(field: Field, value: Any) -> tuple[float, ...]:
    axis = _vector(field, value)
    if not any(axis):
        raise Refused("a zero vector has no direction", "write a unit vector, such as [0.0, 0.0, 1.0]")
    return _unit(axis, AXIS_TOLERANCE, "vector")


def _rows(field: Field, items: list[Any], what: str) -> list[list[float]]:
    """Three rows of three numbers."""
    rows = []
    for i, row in enumerate(items, 1):
        if not isinstance(row, list) or len(row) != 3:
            raise Refused(f"row {i} is not an array of three numbers", f"write {what} as three rows of three numbers")
        rows.append([_number(field, item, f"element ({i}, {j})") for j, item in enumerate(row, 1)])
    return rows


def _rotation(field: Field, value: Any) -> tuple[tuple[float, ...], ...]:
    items = _list(value, 3, "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]")
    made = tuple(map(tuple, _rows(field, items, "direction cosines")))
    require_rotation(made)
    return made


def _sequence(field: Field, value: Any) -> str:
    axes_of(text := _text(field, value))
    return text


def _times(field: Field, value: Any) -> tuple[float, ...]:
    if not isinstance(value, list):
        raise Refused(f"this is {_kind_of(value)}, not an array", "write times in seconds, such as [0.0, 10.0, 250.0]")
    if not value:
        raise Refused("there are no times", "write at least one time, or duration and samples instead")
    if len(value) > MOST_SAMPLES:
        raise Refused(f"there are {len(value)} times", f"give at most {MOST_SAMPLES}")
    times = tuple(_number(field, item, f"element {i}") for i, item in enumerate(value, 1))
    for i, (before, after) in enumerate(zip(times, times[1:], strict=False), 2):
        if not after > before:
            raise Refused(f"element {i} = {after!r} does not come after {before!r}", "put the times in increasing order, each once")
    return times


def _tensor(field: Field, value: Mapping[str, Any]) -> list[Any]:
    """The rows of an inertia given by moments and products."""
    given = _parts(Field(field.name, "record", field.meaning, parts=inertia_parts(field)), value, "",
                   f'{field.name} = {{ moments = [...], products = [...], sign = "tensor" }}, or three moments, or a tensor')
    (x, y, z), (xy, xz, yz) = given["moments"], (product if given["sign"] == "tensor" else -product for product in given["products"])
    return [[x, xy, xz], [xy, y, yz], [xz, yz, z]]


def _inertia(field: Field, value: Any) -> tuple[Any, ...]:
    example = "[35.0, 22.0, 16.0]"
    items = _tensor(field, value) if isinstance(value, dict) else _list(value, 3, f"{example}, or three rows of three")
    if not any(isinstance(item, list) for item in items):
        moments = tuple(_number(field, item, f"element {i}") for i, item in enumerate(items, 1))
        _triangle(moments)
        return moments
    rows = _rows(Field(field.name, "number", field.meaning, field.unit), items, "a symmetric tensor")
    tensor = np.array(rows)
    size = float(np.max(np.abs(tensor)))
    for i, j in ((0, 1), (0, 2), (1, 2)):
        if abs(tensor[i, j] - tensor[j, i]) > TENSOR_TOLERANCE * size:
            raise Refused(f"the tensor is not symmetric: element ({i + 1}, {j + 1}) = {rows[i][j]!r} but "
                         f"({j + 1}, {i + 1}) = {rows[j][i]!r}", "make the two equal")
    tensor = (tensor + tensor.T) / 2
    moments = tuple(float(x) for x in np.linalg.eigvalsh(tensor))
    if moments[0] < max(field.low, 1e-12 * size):
        raise Refused(f"the principal moments are {_listed(moments)}", "a body has three positive principal moments")
    _triangle(moments)
    return tuple(tuple(float(x) for x in row) for row in tensor)


def _moments(field: Field, value: Any) -> tuple[float, ...]:
    read = _inertia(field, value)
    if isinstance(read[0], tuple):
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if read[i][j]:
                raise Refused(f"the products of inertia are not zero: element ({i + 1}, {j + 1}) = {read[i][j]!r}",
                             "give the three principal moments, and all vectors along the principal axes, axis 3 the spin axis")
        read = tuple(read[i][i] for i in range(3))
    _triangle(read, MOMENTS_TOLERANCE)
    return read


def _listed(numbers: Iterable[float]) -> str:
    return ", ".join(f"{x:.9g}" for x in numbers)


def _triangle(moments: Iterable[float], tolerance: float = TENSOR_TOLERANCE) -> None:
    a, b, c = sorted(moments)
    if a < c * 1e-12:
        raise Refused(f"the smallest moment {a:.9g} is below 1e-12 of the largest {c:.9g}", "check the unit (kg m^2) of each moment")
    if a + b < c * (1 - tolerance):
        raise Refused(f"the principal moment {c:.9g} exceeds the sum of the two others, {a:.9g} + {b:.9g}",
                     "no rigid body has these moments (triangle inequality): check the numbers, or the signs of the products of inertia")


def _record(field: Field, value: Any) -> dict[str, Any]:
    example = "{ " + ", ".join(f"{part.name} = ..." for part in field.parts) + " }"
    if not isinstance(value, dict):
        raise Refused(f"this is {_kind_of(value)}, not a table", f"write {field.name} = {example}")
    return _parts(field, value, "", f"{field.name} = {example}")


def _text_or_record(field: Field, value: Any) -> Any:
    if value == "":
        raise Refused("the text is empty", "name a scene file, or a bundled scene (gyrostat scenes lists them)")
    return _record(field, value) if isinstance(value, dict) else _text(field, value)


def _number_or_record(field: Field, value: Any) -> Any:
    return _record(field, value) if isinstance(value, dict) else _number(field, value)


def _vector_or_record(field: Field, value: Any) -> Any:
    """Three numbers, or a record with one of its keys."""
    if not isinstance(value, dict):
        return _vector(field, value)
    if "value" in value:
        return _vector(field, _spread(field, value))
    made = _record(field, value)
    if sum(each is not UNSET for each in made.values()) != 1:
        ways = " or ".join(f"{{ {part.name} = [...] }}" for part in field.parts)
        raise Refused(f"the table has {len(value)} keys", f"write three numbers, or {ways}")
    return made


def _records(field: Field, value: Any) -> tuple[dict[str, Any], ...]:
    if not isinstance(value, list):
        raise Refused(f"this is {_kind_of(value)}, not an array of tables", f"write [[{field.name}]] above the keys of each")
    made = []
    for i, item in enumerate(value, 1):
        if not isinstance(item, dict):
            raise Refused(f"element {i} is {_kind_of(item)}, not a table", f"write [[{field.name}]] above the keys of each")
        made.append(_parts(field, item, f"{field.name} {i}: ", f"write {{}} under [[{field.name}]]"))
    return tuple(made)


def _parts(field: Field, value: Mapping[str, Any], where: str, example: str) -> dict[str, Any]:
    """The keys of one record; `where` says which of several."""
    parts = parts_of(field, value)
    if parts is None:
        raise Refused(*_no_sort(field, value, where))
    names = [part.name for part in parts]
    for key in value:
        if key not in names:
            near = _near(str(key), names)
            raise Refused(f"{where}unknown key {_show(str(key))}", f"did you mean {near}?" if near else f"the keys here are {', '.join(names)}")
    made: dict[str, Any] = {}
    for part in parts:
        if part.name not in value and part.default is REQUIRED:
            raise Refused(f"{where}the key {part.name} is missing", f"give the {_meaning(part)}: {example.replace('{}', f'{part.name} = ...')}")
        if part.name not in value:
            made[part.name] = part.default
            continue
        try:
            given = value[part.name]
            made[part.name] = _number(part, given, part.name) if part.form == "number" else _read(part, given)
        except Refused as error:
            problem, remedy = error.args
            named = problem if part.form == "number" else f"{part.name} = {_show(value[part.name])}: {problem}"
            raise Refused(where + named, remedy) from None
    return made


def _no_sort(field: Field, value: Mapping[str, Any], where: str) -> tuple[str, str]:
    """Why a record is of no sort, and what would be right."""
    for name in field.by:
        known = list(dict.fromkeys(choice for sort in field.sorts for part in sort if part.name == name for choice in part.choices))
        if name not in value and name == field.by[0]:
            return f"{where}the key {name} is missing", f"write {name} = one of {', '.join(known)}"
        if name in value and value[name] not in known:
            near = _near(str(value[name]), known)
            return f"{where}{name} = {_show(value[name])} is unknown", (f'did you mean "{near}"? ' if near else "") + f"use one of {', '.join(known)}"
    first = field.by[0]
    extra = next(name for name in field.by[1:] if name in value)
    return f'{where}{first} = {_show(value[first])} has no key {extra}', f"leave out {extra}"


def _ask(field: Field, value: Any) -> Any:
    """Names and units are looked at when the kind is known."""
    if isinstance(value, str):
        value = parse_ask(value)
    if value in ("all", "default") or isinstance(value, dict):
        return value
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise Refused(f"this is {_kind_of(value)}, not an array of names", 'write "all", names such as ["attitude"], or { attitude = "0.1 deg" }')
    return tuple(value)


def _vary(field: Field, value: Any) -> dict[str, Any]:
    """Its keys are looked at when the scene is known."""
    if not isinstance(value, dict):
        raise Refused(f"this is {_kind_of(value)}, not a table", "write [vary] on a line of its own, then its keys")
    return value


_READERS: Final[dict[str, Callable[[Field, Any], Any]]] = {
    "text": _text, "choice": _choice, "flag": _flag, "number": _number, "count": _count, "vector": _vector, "axis": _axis, "direction": _direction,
    "quaternion": _quaternion, "turn": _turn, "rotation": _rotation, "sequence": _sequence, "inertia": _inertia, "moments": _moments, "matrix": _matrix,
    "numbers": _numbers, "rows": lambda field, value: _table_rows(field, value, 3, "[0.0, 0.1, 0.0]"), "intervals": _intervals, "times": _times,
    "record": _record, "records": _records, "text or record": _text_or_record, "number or record": _number_or_record, "vector or record": _vector_or_record, "ask": _ask, "vary": _vary,
}


def _spread(field: Field, value: Mapping[str, Any]) -> Any:
    """{ value = [...], unit = "..." } as an array of numbers with units."""
    form = f'{field.name} = {{ value = [...], unit = "{field.unit or "..."}" }}'
    if set(value) != {"value", "unit"}:
        raise Refused(f"a table here has the keys value and unit, not {', '.join(map(str, value)) or 'none'}", f"write {form}, or an array")
    if not isinstance(value["value"], list):
        raise Refused(f"value is {_kind_of(value['value'])}, not an array", f"write {form}")
    if not isinstance(value["unit"], str) or not value["unit"].strip():
        raise Refused(f"unit is {_show(value['unit'])}", f"write {form}")

    def spread(item: Any) -> Any:
        if isinstance(item, list):
            return [spread(each) for each in item]
        if isinstance(item, str):
            raise Refused(f"value holds the text {_show(item)}", "write numbers alone beside a unit")
        number = isinstance(item, int | float) and not isinstance(item, bool) and abs(item) <= LIMIT
        return f"{item!r} {value['unit']}" if number else item

    return spread(value["value"])


def _read(field: Field, value: Any) -> Any:
    """The value of a key as it is kept. Raises Refused."""
    if isinstance(value, dict) and field.form in ARRAYS and not (field.form in ("inertia", "moments") and {"moments", "products", "sign"} & set(value)):
        value = _spread(field, value)
    return _READERS[field.form](field, value)


def _worded(field: Field, value: Any) -> bool:
    """Numbers of the value have units, or stand otherwise than they are kept."""
    match field.form:
        case "records":
            return any(_worded(part, item[part.name]) for item in value for part in parts_of(field, item) or () if part.name in item)
        case "record" | "text or record" | "number or record" | "vector or record" if isinstance(value, dict) and "value" not in value:
            return any(_worded(part, value[part.name]) for part in field.parts if part.name in value)
        case "number" | "number or record":
            return isinstance(value, str)
        case "matrix" if not isinstance(value, list | dict):
            return isinstance(value, str)
        case "vector" | "axis" | "inertia" | "moments" | "matrix" | "numbers" | "rows" | "intervals" | "times" | "vector or record":
            kinds = set(map(type, value))
            return isinstance(value, dict) or str in kinds or (list in kinds and any(str in map(type, row) for row in value))
        case _:
            return False


def _told(field: Field, value: Any, read: Any) -> Any:
    """A value as it was given; of records the keys that were left out, too."""
    if field.form == "records":
        return [_told(Field(field.name, "record", "", parts=parts_of(field, item) or ()), item, each) for item, each in zip(value, read, strict=True)]
    if field.form == "record" or (field.form.endswith("or record") and isinstance(value, dict) and "value" not in value):
        return {part.name: _told(part, value[part.name], read[part.name]) if part.name in value else _plain(read[part.name]) for part in field.parts
                if part.name in value or read[part.name] is not UNSET}
    return value if _worded(field, value) else _plain(read)


# ---- the whole scene ----


def _ways_of_kind(tree: Mapping[str, Any]) -> str:
    """What to write where the kind is missing: one of those that know all tables that are there."""
    others = [name for name in FAMILIES if name != GENERAL]
    fitting = [name for name in others if all(key in FAMILIES[name].keys or not isinstance(tree[key], dict) for key in tree)] or others
    return "write " + " or ".join(f'kind = "{name}"' for name in fitting) + (" where it is one of these" if len(fitting) > 1 else "")


def _check(data: Mapping[str, Any], source: _Source, overrides: Mapping[str, Any] | None = None) -> Scene:
    """The scene that `data` describes, or SceneError with every mistake found."""
    tree: dict[str, Any] = {str(key): _plain(value) for key, value in data.items()}
    if overrides:
        source.overridden = frozenset(_override(tree, source, overrides))
    mistakes: list[Mistake] = []

    def wrong(key: str, value: Any, problem: str, remedy: str, shown: bool = True) -> None:
        element = re.match(rf"{re.escape(key)} (\d+)\b", problem)
        mistakes.append(Mistake(source.where(key, int(element[1]) if element else 1), key, _show(value) if shown else "", problem, remedy))

    kind = tree.get("kind", GENERAL)
    if not isinstance(kind, str) or kind not in FAMILIES:
        near = _near(kind, FAMILIES) if isinstance(kind, str) else ""
        wrong("kind", kind, "unknown kind", (f'did you mean "{near}"? ' if near else "") + f"this version answers: {', '.join(FAMILIES)}")
        raise SceneError(*mistakes)

    family = FAMILIES[kind]
    layout = family.keys
    read: dict[str, dict[str, Any]] = {}
    written: dict[str, Any] = {}
    unread: set[str] = set()
    for key in tree:
        if key not in layout and all(field.name != key for field in layout[""]):
            wrong(key, tree[key], "unknown " + ("table" if isinstance(tree[key], dict) else "key"),
                  _advice(key, "", family), not isinstance(tree[key], dict))
    for table, fields in layout.items():
        given: Any = tree.get(table, {}) if table else tree
        if table and table not in tree and family.needs(table) and not _goes_on(table, tree):
            wrong(table, "", f"the table [{table}] is missing", f"add [{table}] with {_wanted(family, table)}", False)
            unread.add(table)
            continue
        if not isinstance(given, dict):
            unread.add(table)
            wrong(table, given, f"this is {_kind_of(given)}, not a table", f"write [{table}] on a line of its own, then its keys")
            continue
        prefix = table + "." if table else ""
        if table:
            for key in given:
                if all(field.name != key for field in fields):
                    wrong(prefix + str(key), given[key], "unknown key", _advice(str(key), table, family))
        values: dict[str, Any] = {}
        for field in fields:
            if field.name not in given:
                values[field.name] = field.default
                if field.default is REQUIRED:
                    wrong(prefix + field.name, "", "the key is missing", f"give the {_meaning(field)}", False)
                continue
            try:
                values[field.name] = _read(field, value := given[field.name])
                if _worded(field, value):
                    written[prefix + field.name] = _told(field, value, values[field.name])
            except Refused as error:
                wrong(prefix + field.name, given[field.name], *error.args)
        read[table] = values
    for choices in family.alternatives:
        if not any(table_of(key) in unread for choice in choices for key in choice):
            _one_of(choices, tree, wrong)
    if not mistakes:
        settle(read["initial"])
        try:
            asked(kind, read["solve"]["ask"], knows_attitude(kind, read))
        except AskError as error:
            wrong("solve.ask", read["solve"]["ask"], error.problem, error.remedy)
        for key, value, problem, remedy in (*family.mistakes(read), *(() if "kind" in tree else family.doubts(read))):
            wrong(key, _plain(value), problem, remedy, value != "")
    if mistakes:
        if "kind" not in tree and _may_be_another(tree, mistakes):
            mistakes.insert(0, Mistake(source.label, "kind", "", f"the key is missing, and what is there is no scene of the kind {GENERAL}", _ways_of_kind(tree)))
        raise SceneError(*mistakes)
    head = read.pop("")
    top = {key: value for key, value in head.items() if key not in ("name", "kind", "source")}
    made = Scene(head["name"], kind, head["source"], read, source.path, top, written, _before(top["from"], source) if top.get("from") else None)
    if (times := read["solve"]["times"]) is not UNSET and times[0] < made.start_time:
        raise SceneError(Mistake(source.where("solve.times"), "solve.times", _show(list(times)), f"the motion begins at {made.start_time!r} s",
                                 "give times from there, or duration and samples, which count from there"))
    if not overrides:  # what varies may hang on keys that were replaced; a sweep looks again
        _check_varied(made, source)
    return made


def _may_be_another(tree: Mapping[str, Any], mistakes: Sequence[Mistake]) -> bool:
    """Whether a scene of no kind may be one of another kind than general: something is unknown that others have, and nothing stands that they lack."""
    if any(isinstance(tree.get(name), list) for name in ("wheel", "torque")) or "orbit" in tree:
        return False
    keys = [mistake.key for mistake in mistakes if mistake.problem.startswith(("unknown", "the table", "this is a table, not"))]
    return any(any(key in family.keys for family in FAMILIES.values()) or _kinds_with(key.rpartition(".")[2], table_of(key)) for key in keys)


def _before(given: Any, source: _Source) -> Scene:
    """The scene at whose end another begins, by its key `from`; `source` is that of the other."""

    def fail(problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake(source.where("from"), "from", "", problem, remedy))

    name = Path(given if isinstance(given, str) else given["file"])
    here = source.path.parent / name if source.path else name
    file = find(here if here.exists() else name)
    known = [each.resolve() for each in (*source.after, source.path) if each]
    if file.resolve() in known:
        raise fail(f"{name} goes on from this scene in turn", "begin one of the two with [initial]")
    if len(known) >= MOST_BEFORE:
        raise fail(f"over {MOST_BEFORE} scenes go on from each other", "begin one of them with [initial]")
    return _load(file, {}, tuple(known))


def _check_varied(scene: Scene, source: _Source) -> None:
    """What the table [vary] says has a meaning; a table of cases is looked at when it is wanted."""
    try:
        if not set(scene.vary) <= set(SETTINGS):
            plan_of(scene, cases={} if "cases" in scene.vary else None)
    except DomainError as error:
        problem, _, remedy = str(error).partition("; ")
        raise SceneError(Mistake(source.where("vary"), "vary", "", problem, remedy or "write what docs/sweeps.md says")) from None


def _meaning(field: Field) -> str:
    return field.meaning + (f" ({field.unit})" if field.unit else "")


def _ways(choices: Choices) -> str:
    """The alternatives for reading: "in [solve] give either duration and samples or times"."""
    tables = {table_of(key) for choice in choices for key in choice}
    if len(tables) == 1:
        return f"in [{tables.pop()}] give either {_bare(choices)}"
    return "give either " + ", or ".join(" and ".join(filter(None, (", ".join(choice[:-1]), choice[-1]))) for choice in choices)


def _bare(choices: Choices) -> str:
    return " or ".join(" and ".join(key.rpartition(".")[2] for key in choice) for choice in choices if choice)


def _wanted(family: Family, table: str) -> str:
    names = [field.name for field in family.keys[table] if field.default is REQUIRED]
    names += [_bare(choices) for choices in family.alternatives if all(table_of(key) == table for choice in choices for key in choice)]
    return ", ".join(names)


def _goes_on(table: str, tree: Mapping[str, Any]) -> bool:
    """The table may be left out, for the scene begins where another ends."""
    return table == "initial" and "from" in tree


def _one_of(choices: Choices, tree: Mapping[str, Any], wrong: Callable[..., None]) -> None:
    given = {f"{table}.{name}": value for table, values in tree.items() if isinstance(values, dict) for name, value in values.items()}
    started = [choice for choice in choices if any(key in given for key in choice)]
    if not started:
        if () not in choices and not _goes_on(table_of(choices[0][0]), tree):
            wrong(choices[0][0], "", "the key is missing", _ways(choices), False)
    elif len(started) > 1:
        first, extra = (next(key for key in choice if key in given) for choice in started[:2])
        wrong(extra, given[extra], f"given beside {first}", _ways(choices))
    else:
        for key in started[0]:
            if key not in given:
                wrong(key, "", "the key is missing", _ways(choices), False)


def _advice(key: str, table: str, family: Family) -> str:
    """What to do about a key that `table` does not have."""
    layout = family.keys
    here = [field.name for field in layout[table]] + ([name for name in layout if name] if not table else [])
    homes = [name for name, fields in layout.items() if any(field.name == key for field in fields)]
    if homes and not homes[0]:
        return f"{key} belongs at the top of the file, before the first table"
    if homes:
        return f"{key} belongs in {' or '.join(f'[{home}]' for home in homes)}"
    if near := _near(key, here):
        return f"did you mean {near}?"
    if not table and (kinds := [family.name for family in FAMILIES.values() if key in family.keys]):
        return f"only scenes of the kind {' or '.join(kinds)} have it"
    if not table and (near := _near(key, {name for family in FAMILIES.values() for name in family.keys if name})):
        kinds = [family.name for family in FAMILIES.values() if near in family.keys]
        return f"did you mean {near}, which scenes of the kind {' or '.join(kinds)} have?"
    for name, fields in layout.items():
        if near := _near(key, [field.name for field in fields]):
            return f"did you mean {name + '.' if name else ''}{near}?"
    if kinds := _kinds_with(key, table):
        return f"leave it out: only scenes of the kind {' or '.join(kinds)} have it"
    return f"the keys here are {', '.join(here)}"


def _kinds_with(key: str, table: str) -> list[str]:
    """The kinds whose `table` has the key; of every table where none is named."""
    return [family.name for family in FAMILIES.values()
            if any(field.name == key for name, fields in family.keys.items() if table in ("", name) for field in fields)]


def _advice_anywhere(key: str, layout: Mapping[str, Table]) -> str:
    """What to do about a key, named without its table, that no table has."""
    names = [field.name for fields in layout.values() for field in fields]
    if near := _near(key, names):
        return f"did you mean {near}?"
    if kinds := _kinds_with(key, ""):
        return f"leave it out: only scenes of the kind {' or '.join(kinds)} have it"
    return f"the keys are {', '.join(names)}"


def _override(tree: dict[str, Any], source: _Source, overrides: Mapping[str, Any]) -> Iterator[str]:
    """Put each override into the tree (taking out what it is an alternative to); yields the full keys."""
    kind = overrides.get("kind", tree.get("kind", GENERAL))
    family = FAMILIES.get(kind) if isinstance(kind, str) else None
    layout: Mapping[str, Table] = family.keys if family else {}
    full: dict[str, Any] = {}
    for given, value in overrides.items():
        key = _dotted(given)
        if key is None:
            raise SceneError(Mistake(f"{source.label} (set on the command line or by keyword)", _show(given)[1:-1], _show(_plain(value)), *_NO_KEY))
        table, _, name = key.rpartition(".")
        if not table:
            bare = _without_places(name)
            homes = [home for home, fields in layout.items() if any(field.name == bare for field in fields)]
            there = [home for home in homes if not home or (isinstance(table_there := tree.get(home), dict) and bare in table_there)]
            if not there and "solve" not in homes:
                homes = [*_in_lists(tree, layout, bare), *homes]
            if not homes and name in layout:
                first = next(iter(value)) if isinstance(value, Mapping) and value else layout[name][0].name
                raise SceneError(Mistake(f"{source.label} (set on the command line or by keyword)", key, _show(_plain(value)), "a table is not replaced as a whole",
                                         f'set its keys one by one, as {name}.{first}, in Python replace(**{{"{name}.{first}": ...}}); keys that are not named stay'))
            if not homes and name not in ("kind", "name", "source"):
                raise SceneError(Mistake(f"{source.label} (set on the command line or by keyword)", key, _show(_plain(value)), "unknown key",
                                         _advice_anywhere(name, layout)))
            if len(homes) > 1:
                if len(there) != 1:
                    full_keys = " or ".join(f"{home}.{name}" for home in homes)
                    raise SceneError(Mistake(f"{source.label} (set on the command line or by keyword)", key, _show(_plain(value)),
                                             f"several tables have a key {name}", f"write {full_keys}"))
                homes = there
            table = homes[0] if homes else ""
        full[f"{table}.{name}" if table else name] = _plain(value)
    plains = set(map(_without_places, full))
    for key, value in full.items():
        table, _, name = key.rpartition(".")
        home = _home(tree, table, source)
        plain = _without_places(key)
        for choices in family.alternatives if family else ():
            for rival in (rival for choice in choices if plain not in choice and any(plain in other for other in choices) for rival in choice):
                beside = tree.get(table_of(rival))
                if rival not in plains and isinstance(beside, dict):
                    beside.pop(rival.rpartition(".")[2], None)
        _put(home, name, value, key, source)
        yield plain
        if isinstance(tree.get(head := plain.partition(".")[0]), list):
            yield head  # of which mistakes in one of its tables are told


def _in_lists(tree: Mapping[str, Any], layout: Mapping[str, Table], key: str) -> list[str]:
    """The tables in lists, as wheel[0], that can have this key."""
    made = []
    for field in layout.get("", ()):
        tables = tree.get(field.name)
        for i, table in enumerate(tables if isinstance(tables, list) else ()):
            if isinstance(table, dict) and any(part.name == key for part in parts_of(field, table) or ()):
                made.append(f"{field.name}[{i}]")
    return made


def _without_places(key: str) -> str:
    return re.sub(r"\[[\d,]+\]", "", key)


def _home(tree: dict[str, Any], table: str, source: _Source) -> dict[str, Any]:
    """The table of this dotted name, made where there is none: of arrays of tables by its place, `wheel[1]`, or by its name, `wheel.pitch`, or the only one."""

    def fail(problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake(f"{source.label} (set on the command line or by keyword)", table, "", problem, remedy))

    home: Any = tree
    for part in table.split(".") if table else ():
        name, _, place = part.rstrip("]").partition("[")
        if isinstance(home, list):
            named = [item for item in home if isinstance(item, dict) and item.get("name") == name]
            if len(named) != 1:
                raise fail(f"there is no one table named {name} here", f"write its place, such as {table.partition('.')[0]}[0], counted from 0")
            home = named[0]
        else:
            home = home.setdefault(name, {})
        if place:
            if not (isinstance(home, list) and int(place) < len(home)):
                raise fail(f"there is no {part}", f"there are {len(home)}, counted from 0" if isinstance(home, list) else f"leave out [{place}]")
            home = home[int(place)]
        if not isinstance(home, dict | list):
            raise SceneError(Mistake(source.label, table, _show(home), "this is not a table", f"write [{table}] and its keys"))
    if isinstance(home, list):
        if len(home) != 1 or not isinstance(home[0], dict):
            raise fail(f"there are {len(home)} of these tables", f"write which, such as {table}[0].KEY, counted from 0, or {table}.NAME.KEY of the one with this name")
        home = home[0]
    found: dict[str, Any] = home
    return found


_INERTIA: Final = Field("inertia", "inertia", "inertia", "kg m^2")


def _put(home: dict[str, Any], name: str, value: Any, key: str, source: _Source) -> None:
    """Set a key, or one number of it: `control[0]`, `axis[2]`, `inertia[0,1]`, and of an inertia the same of the other side."""
    name, _, places = name.rstrip("]").partition("[")
    if not places:
        home[name] = value
        return
    indices = [int(place) for place in places.split(",")]
    for each in [indices, indices[::-1]] if name == "inertia" and len(indices) == 2 else [indices]:
        if isinstance(row := home.get(name), dict):
            try:
                home[name] = row = _spread(Field(name, "numbers", name), row) if "value" in row or name != "inertia" else _tensor(_INERTIA, row)
            except Refused:
                pass  # it holds no such number, or what is wrong with it is told of the scene
        for place in each[:-1]:
            row = row[place] if isinstance(row, list) and place < len(row) else None
        if not isinstance(row, list) or each[-1] >= len(row) or isinstance(row[each[-1]], list | dict):
            raise SceneError(Mistake(f"{source.label} (set on the command line or by keyword)", key, _show(value), "there is no such number",
                                     f"places are counted from 0, as {name}[0] of a vector and {name}[0,1] of a matrix, where the scene gives one"))
        row[each[-1]] = value


# A dotted key: tables have one place at most, the number at its end two.
_KEY: Final = re.compile(r"([A-Za-z0-9_-]+(\[[0-9]{1,6}\])?\.)*[A-Za-z0-9_-]+(\[[0-9]{1,6}(,[0-9]{1,6})?\])?")
_NO_KEY: Final = ("this is no key", "write a key such as torque.drag, torque.control[0] or wheel[1].rate, places counted from 0")


def _dotted(key: str) -> str | None:
    """The key as it is looked up, without blanks about its places, `[i][j]` as `[i,j]`; None where it is none."""
    made = re.sub(r"\s*([\[\],])\s*", r"\1", key).replace("][", ",")
    return made if _KEY.fullmatch(made) else None


def parse_override(text: str) -> tuple[str, Any]:
    """`key=value` of the command line: a dotted key, with the places of tables and numbers in lists, or the bare name of one, and a TOML value, a bare
    word or a number with a unit."""

    def fail(key: str, value: str, problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake("--set", _show(key)[1:-1], value, problem, remedy))

    key, equals, value = text.partition("=")
    key, value = key.strip(), value.strip()
    if not equals:
        raise fail(key, "", "there is no value", "write --set key=value, such as --set tolerance=1e-9")
    dotted = _dotted(key)
    if dotted is None:
        raise fail(key, _show(value), *_NO_KEY)
    key = dotted
    try:
        read = tomllib.loads(f"value = {value}\n")
        if set(read) == {"value"}:
            return key, read["value"]
    except (tomllib.TOMLDecodeError, ValueError, RecursionError):
        if re.fullmatch(r"[A-Za-z][A-Za-z0-9_:-]*|[1-3]-[1-3]-[1-3]", value) or re.fullmatch(f"{PATTERN}|{SHARE_PATTERN}", value):
            return key, value
        if found := re.fullmatch(r"([-+.0-9eE]*[0-9.]) *([A-Za-z°/].*)", value):
            meant = f"{found[1]} {spelled(found[2])}"
            shown = meant if re.fullmatch(PATTERN, meant) else "3 h"
            raise fail(key, _show(value), f"this is neither a TOML value nor a number with a unit, as {found[2]} is none",
                       f"put a value with a unit in quotes: --set '{key}=\"{shown}\"'")
    raise fail(key, _show(value), "this is no TOML value", 'write a number, an array such as [1.0, 2.0, 3.0], or text in quotes')


def scene_from(data: Mapping[str, Any], label: str = "scene", **overrides: Any) -> Scene:
    """The scene that a dict in the layout of a scene file describes. Raises SceneError."""
    return _check(data, _Source(label), overrides)


def load(path: str | os.PathLike[str], **overrides: Any) -> Scene:
    """Read a scene file (TOML), or a bundled scene by name; overrides as in `Scene.replace`. Raises SceneError, and DomainError for what names no file."""
    if not isinstance(path, str | os.PathLike):
        raise DomainError(f"path = {str(path)[:60]}: name a scene file or a bundled scene; gyrostat.solve and its kin take a dict in the layout of a scene file, too")
    return _load(path, overrides)


def _load(path: str | os.PathLike[str], overrides: Mapping[str, Any], after: tuple[Path, ...] = ()) -> Scene:
    file = find(path)
    label = _printable(str(path))

    def fail(problem: str, remedy: str) -> SceneError:
        return SceneError(Mistake(label, "", "", problem, remedy))

    try:
        if file.is_dir():
            raise fail("this is a directory", "name a scene file")
        if file.stat().st_size > MOST_BYTES:
            raise fail(f"the file is over {MOST_BYTES // 2**20} MiB", "a scene file is a few lines of TOML")
        with file.open("rb") as stream:
            raw = stream.read(MOST_BYTES + 1)
    except SceneError:
        raise
    except FileNotFoundError:
        known = [name for name, _ in bundled()]
        near = _near(str(path), known)
        raise fail("there is no such file", f"did you mean the bundled scene {near}?" if near else
                   "name a scene file, or a bundled scene (gyrostat scenes lists them)") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise fail(f"the file cannot be read ({reason})", "name a readable scene file") from None
    if len(raw) > MOST_BYTES:
        raise fail(f"the file is over {MOST_BYTES // 2**20} MiB", "a scene file is a few lines of TOML")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise fail(f"byte {error.start + 1} is not UTF-8", "save the file as UTF-8 text") from None
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
        where = f"{label}:{place[1]}" if place else label
        problem = str(error)
        if place:
            line = text.split("\n")[int(place[1]) - 1].strip()[:60]
            problem = problem.replace(place[0], f"in column {place[2]} of the line '{line}'")
        raise SceneError(Mistake(where, "", "", f"this is not TOML: {_printable(problem)}", "correct the line")) from None
    except RecursionError:
        raise fail("arrays or tables are nested too deep", "a scene file is a few lines of TOML") from None
    except ValueError as error:
        raise fail(f"a value cannot be read ({_printable(str(error))[:80]})", "write ordinary numbers") from None
    beside = None if file.is_relative_to("/dev") else file  # what comes through a pipe stands in no folder
    return _check(data, _Source(label, text, beside, after), overrides)


def _printable(text: str) -> str:
    return "".join(c if c.isprintable() else "?" for c in text)


def _folder() -> Path | None:
    """Where the bundled scenes are: beside the package, or in the source tree."""
    here = Path(__file__).resolve().parent
    return next((folder for folder in (here / "scenes", here.parents[1] / "scenes") if folder.is_dir()), None)


def bundled() -> list[tuple[str, Path]]:
    """Name and file of each scene that comes with gyrostat."""
    folder = _folder()
    return [(file.stem, file) for file in sorted(folder.glob("*.toml"))] if folder else []


def find(path: str | os.PathLike[str]) -> Path:
    """The file that a path or the name of a bundled scene stands for; the path itself where there is no such scene."""
    file = Path(path)
    try:
        if file.is_file():
            return file
    except (OSError, ValueError):
        return file
    return dict(bundled()).get(str(path), file)
