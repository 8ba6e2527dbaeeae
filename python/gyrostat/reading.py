# SPDX-License-Identifier: BSD-3-Clause
"""The values of a scene's keys, one reader a form: each returns the value to keep, in SI units, or raises Refused(problem, remedy)."""

import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final

import numpy as np

from gyrostat.advice import meaning_of, nearest, show, suggested, type_of
from gyrostat.asking import parse_ask
from gyrostat.errors import Refused
from gyrostat.families import FAMILIES
from gyrostat.fields import ARRAYS, LIMIT, MOST_SAMPLES, REQUIRED, ROUNDING, UNSET, Field, inertia_parts, parts_of
from gyrostat.orientation import axes_of, require_rotation
from gyrostat.units import SHARE_PATTERN, split, to_si

__all__ = ["as_given", "plain", "read_value", "spread", "tensor_rows", "worded"]

# An attitude is taken as a unit quaternion when its norm is 1 within this.
UNIT_TOLERANCE: Final = 1e-6
# An axis is taken as a unit vector when its length is 1 within this.
AXIS_TOLERANCE: Final = 1e-8
# Off-diagonal pairs, and the triangle inequality, may be off by this share of the largest element.
TENSOR_TOLERANCE: Final = 1e-9
# Where the moments themselves are used, as they stand, they may miss the triangle inequality by rounding alone.
MOMENTS_TOLERANCE: Final = 1e-15


def plain(value: Any) -> Any:
    """Numpy arrays, tuples and mappings as lists and dicts, keys without a value left out; other things as they are."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items() if item is not UNSET}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value


def _text(field: Field, value: Any) -> str:
    if not isinstance(value, str):
        raise Refused(f"this is {type_of(value)}, not text", f'write {field.name} = "{"-".join(str(value)) if field.form == "sequence" and type(value) is int else "..."}" in quotes')
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
        raise Refused(f"this is {type_of(value)}, not text", allowed)
    if field.name == "integrator" and any(value in family.facts.integrators for family in FAMILIES.values()):
        raise Refused("this kind of scene has no such integrator", allowed)
    near = nearest(value, field.choices)
    raise Refused(f"unknown {field.name}", f'did you mean "{near}"? {allowed}' if near else allowed)


def _with_unit(field: Field, text: str, element: str) -> float:
    """The number of a text, in SI units."""
    what = f"{element} = {show(text)}: " if element else ""
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
            raise Refused(f"{element or 'this'} is {type_of(value)}, not a number", f"give a number{unit} without quotes")
        number = _with_unit(field, value, element)
    else:
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
    what = f"{element} = {show(value)}" if element else "this"
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
        raise Refused(f"this is {type_of(value)}, not a truth value", f"write {field.name} = true or {field.name} = false")
    return value


def _count(field: Field, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise Refused(f"this is {type_of(value)}, not an integer", f"write an integer, such as {field.name} = 401")
    if not field.low <= value <= field.high:
        raise Refused("this is out of range", f"give an integer from {field.low:.0f} to {field.high:.0f}")
    return value


def _list(value: Any, length: int, example: str) -> list[Any]:
    if not isinstance(value, list):
        raise Refused(f"this is {type_of(value)}, not an array", f"write {length} numbers, such as {example}" + (
            f', with a unit as {{ value = {example}, unit = "..." }}' if isinstance(value, str) and value.lstrip().startswith("[") else ""))
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
        raise Refused(f"this is {'an empty array' if value == [] else type_of(value)}, not an array of numbers", f"write {field.name} = [0.0, 1.0, 2.5]")
    if len(value) > MOST_SAMPLES:
        raise Refused(f"there are {len(value)} numbers", f"give at most {MOST_SAMPLES}")
    return tuple(_number(field, item, f"element {i}") for i, item in enumerate(value, 1))


def _table_rows(field: Field, value: Any, width: int, example: str) -> tuple[tuple[float, ...], ...]:
    if not isinstance(value, list) or not value:
        raise Refused(f"this is {'an empty array' if value == [] else type_of(value)}, not an array of arrays", f"write {field.name} = [{example}, ...]")
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
    _unit(q, UNIT_TOLERANCE, "quaternion")
    return q  # what is made of it makes it unit: a row in which one of the numbers varies is that scene


def _turn(field: Field, value: Any) -> tuple[float, ...]:
    """A quaternion of any length but 0."""
    items = _list(value, 4, "[0.0, 0.0, 0.0, 1.0] (x, y, z, w)")
    q = tuple(_number(field, item, f"element {i}") for i, item in enumerate(items, 1))
    if not any(q):
        raise Refused("a zero quaternion is no rotation", "write a quaternion [x, y, z, w], such as [0.0, 0.0, 0.0, 1.0]")
    return q


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
        raise Refused(f"this is {type_of(value)}, not an array", "write times in seconds, such as [0.0, 10.0, 250.0]")
    if not value:
        raise Refused("there are no times", "write at least one time, or duration and samples instead")
    if len(value) > MOST_SAMPLES:
        raise Refused(f"there are {len(value)} times", f"give at most {MOST_SAMPLES}")
    times = tuple(_number(field, item, f"element {i}") for i, item in enumerate(value, 1))
    for i, (before, after) in enumerate(zip(times, times[1:], strict=False), 2):
        if not after > before:
            raise Refused(f"element {i} = {after!r} does not come after {before!r}", "put the times in increasing order, each once")
    return times


def tensor_rows(field: Field, value: Mapping[str, Any]) -> list[Any]:
    """The rows of an inertia given by moments and products."""
    given = _parts(Field(field.name, "record", field.meaning, parts=inertia_parts(field)), value, "",
                   f'{field.name} = {{ moments = [...], products = [...], sign = "tensor" }}, or three moments, or a tensor')
    (x, y, z), (xy, xz, yz) = given["moments"], (product if given["sign"] == "tensor" else -product for product in given["products"])
    return [[x, xy, xz], [xy, y, yz], [xz, yz, z]]


def _inertia(field: Field, value: Any) -> tuple[Any, ...]:
    example = "[35.0, 22.0, 16.0]"
    items = tensor_rows(field, value) if isinstance(value, dict) else _list(value, 3, f"{example}, or three rows of three")
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
        raise Refused(f"this is {type_of(value)}, not a table", f"write {field.name} = {example}")
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
        return _vector(field, spread(field, value))
    made = _record(field, value)
    if sum(each is not UNSET for each in made.values()) != 1:
        ways = " or ".join(f"{{ {part.name} = [...] }}" for part in field.parts)
        raise Refused(f"the table has {len(value)} keys", f"write three numbers, or {ways}")
    return made


def _records(field: Field, value: Any) -> tuple[dict[str, Any], ...]:
    if not isinstance(value, list):
        raise Refused(f"this is {type_of(value)}, not an array of tables", f"write [[{field.name}]] above the keys of each")
    made = []
    for i, item in enumerate(value):
        if not isinstance(item, dict):
            raise Refused(f"element {i + 1} is {type_of(item)}, not a table", f"write [[{field.name}]] above the keys of each")
        made.append(_parts(field, item, f"{field.name}[{i}]: ", f"write {{}} under [[{field.name}]]"))
    return tuple(made)


def _parts(field: Field, value: Mapping[str, Any], where: str, example: str) -> dict[str, Any]:
    """The keys of one record; `where` says which of several."""
    parts = parts_of(field, value)
    if parts is None:
        raise Refused(*_no_sort(field, value, where))
    names = [part.name for part in parts]
    for key in value:
        if key not in names:
            raise Refused(f"{where}unknown key {show(str(key))}", suggested(str(key), names) or f"the keys here are {', '.join(names)}")
    made: dict[str, Any] = {}
    for part in parts:
        if part.name not in value and part.default is REQUIRED:
            raise Refused(f"{where}the key {part.name} is missing", f"give the {meaning_of(part)}: {example.replace('{}', f'{part.name} = ...')}")
        if part.name not in value:
            made[part.name] = part.default
            continue
        try:
            given = value[part.name]
            made[part.name] = _number(part, given, part.name) if part.form == "number" else read_value(part, given)
        except Refused as error:
            problem, remedy = error.args
            named = problem if part.form == "number" else f"{part.name} = {show(value[part.name])}: {problem}"
            raise Refused(where + named, remedy) from None
    return made


def _no_sort(field: Field, value: Mapping[str, Any], where: str) -> tuple[str, str]:
    """Why a record is of no sort, and what would be right."""
    for name in field.by:
        known = list(dict.fromkeys(choice for sort in field.sorts for part in sort if part.name == name for choice in part.choices))
        if name not in value and name == field.by[0]:
            return f"{where}the key {name} is missing", f"write {name} = one of {', '.join(known)}"
        if name in value and value[name] not in known:
            meant = suggested(str(value[name]), known, '"{}"')
            return f"{where}{name} = {show(value[name])} is unknown", (meant + (" " if meant.endswith("?") else "; ") if meant else "") + f"use one of {', '.join(known)}"
    first = field.by[0]
    extra = next(name for name in field.by[1:] if name in value)
    return f'{where}{first} = {show(value[first])} has no key {extra}', f"leave out {extra}"


def _ask(field: Field, value: Any) -> Any:
    """Names and units are looked at when the kind is known."""
    if isinstance(value, str):
        value = parse_ask(value)
    if isinstance(value, str | dict):  # "all", "default", or tolerances
        return value
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise Refused(f"this is {type_of(value)}, not an array of names", 'write "all", names such as ["attitude"], or { attitude = "0.1 deg" }')
    return tuple(value)


def _vary(field: Field, value: Any) -> dict[str, Any]:
    """Its keys are looked at when the scene is known."""
    if not isinstance(value, dict):
        raise Refused(f"this is {type_of(value)}, not a table", "write [vary] on a line of its own, then its keys")
    return value


def _scene(field: Field, value: Any) -> dict[str, Any]:
    """It is read where the scene is that begins at its end."""
    if not isinstance(value, dict):
        raise Refused(f"this is {type_of(value)}, not a table", "write a scene out, in the layout of a scene file")
    return value


_READERS: Final[dict[str, Callable[[Field, Any], Any]]] = {
    "text": _text, "choice": _choice, "flag": _flag, "number": _number, "count": _count, "vector": _vector, "axis": _axis, "direction": _direction,
    "quaternion": _quaternion, "turn": _turn, "rotation": _rotation, "sequence": _sequence, "inertia": _inertia, "moments": _moments, "matrix": _matrix,
    "numbers": _numbers, "rows": lambda field, value: _table_rows(field, value, 3, "[0.0, 0.1, 0.0]"), "intervals": _intervals, "times": _times,
    "record": _record, "records": _records, "text or record": _text_or_record, "number or record": _number_or_record, "vector or record": _vector_or_record, "ask": _ask, "vary": _vary, "scene": _scene,
}


def spread(field: Field, value: Mapping[str, Any]) -> Any:
    """{ value = [...], unit = "..." } as an array of numbers with units."""
    form = f'{field.name} = {{ value = [...], unit = "{field.unit or "..."}" }}'
    if set(value) != {"value", "unit"}:
        raise Refused(f"a table here has the keys value and unit, not {', '.join(map(str, value)) or 'none'}", f"write {form}, or an array")
    if not isinstance(value["value"], list):
        raise Refused(f"value is {type_of(value['value'])}, not an array", f"write {form}")
    if not isinstance(value["unit"], str) or not value["unit"].strip():
        raise Refused(f"unit is {show(value['unit'])}", f"write {form}")

    def with_unit(item: Any) -> Any:
        if isinstance(item, list):
            return [with_unit(each) for each in item]
        if isinstance(item, str):
            raise Refused(f"value holds the text {show(item)}", "write numbers alone beside a unit")
        number = isinstance(item, int | float) and not isinstance(item, bool) and abs(item) <= LIMIT
        return f"{item!r} {value['unit']}" if number else item

    return with_unit(value["value"])


def read_value(field: Field, value: Any) -> Any:
    """The value of a key as it is kept. Raises Refused."""
    if isinstance(value, dict) and field.form in ARRAYS and not (field.form in ("inertia", "moments") and {"moments", "products", "sign"} & set(value)):
        value = spread(field, value)
    return _READERS[field.form](field, value)


def worded(field: Field, value: Any) -> bool:
    """Numbers of the value have units, or stand otherwise than they are kept."""
    match field.form:
        case "records":
            return any(worded(part, item[part.name]) for item in value for part in parts_of(field, item) or () if part.name in item)
        case "record" | "text or record" | "number or record" | "vector or record" if isinstance(value, dict) and "value" not in value:
            return any(worded(part, value[part.name]) for part in field.parts if part.name in value)
        case "number" | "number or record":
            return isinstance(value, str)
        case "matrix" if not isinstance(value, list | dict):
            return isinstance(value, str)
        case "vector" | "axis" | "inertia" | "moments" | "matrix" | "numbers" | "rows" | "intervals" | "times" | "vector or record":
            kinds = set(map(type, value))
            return isinstance(value, dict) or str in kinds or (list in kinds and any(str in map(type, row) for row in value))
        case _:
            return False


def as_given(field: Field, value: Any, read: Any) -> Any:
    """A value as it was given; of records the keys that were left out, too."""
    if field.form == "records":
        return [as_given(Field(field.name, "record", "", parts=parts_of(field, item) or ()), item, each) for item, each in zip(value, read, strict=True)]
    if field.form == "record" or (field.form.endswith("or record") and isinstance(value, dict) and "value" not in value):
        return {part.name: as_given(part, value[part.name], read[part.name]) if part.name in value else plain(read[part.name]) for part in field.parts
                if part.name in value or read[part.name] is not UNSET}
    return plain(value if worded(field, value) else read)
