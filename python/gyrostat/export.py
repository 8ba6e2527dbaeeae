# SPDX-License-Identifier: BSD-3-Clause
"""An answer in the forms of other programs: JSON, CSV, pandas, xarray, NetCDF."""

import json
import math
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat._core import csv_rows, json_numbers
from gyrostat.answer import Answer, Attempt, DataError, Scalars, Warning_
from gyrostat.errors import DomainError
from gyrostat.facts import FACTS, TIME, UNITS
from gyrostat.sweep_files import import_xarray
from gyrostat.writing import write_text, written

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["from_json", "to_csv", "to_dataframe", "to_dict", "to_json", "to_netcdf", "to_xarray"]

_AXES: Final = ("x", "y", "z", "w")


def _units(answer: Answer) -> dict[str, str]:
    return {name: UNITS.get(name, "") for name in ("t", *answer.columns, *answer.scalars)}


def _meanings(answer: Answer) -> dict[str, str]:
    facts = FACTS[answer.scene["kind"]].quantities
    return {"t": TIME, **{name: facts[name].meaning for name in (*answer.columns, *answer.scalars)}}


def _parts(answer: Answer) -> dict[str, Any]:
    """The object of JSON, with arrays in it."""
    data = answer.data_error
    return {
        "scene": answer.scene, "model": answer.model, "tolerance": answer.tolerance, "met": answer.met, "error": answer.error,
        "warnings": [{"code": w.code, "message": w.message} for w in answer.warnings],
        "t": answer.t, "columns": answer.columns, "scalars": answer.scalars, "scalar_error": answer.scalar_error,
        "counts": answer.counts, "seconds": answer.seconds,
        "tried": [{"model": a.model, "error": a.error, "accepted": a.accepted, "why": a.why, "predicted": a.predicted, "spent": a.spent}
                  for a in answer.tried],
        "units": _units(answer), "meanings": _meanings(answer), "scale": answer.scale, "tolerances": answer.tolerances,
        **({"own_torque": True} if answer.own_torque else {}),
        **({} if data is None else {"data_error": {name: {"effect": effect, "mostly": data.mostly[name]} for name, effect in data.effect.items()}}),
    }


def _plain(value: Any) -> Any:
    """Arrays as lists, and None in place of what is not finite."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value


def to_dict(answer: Answer) -> dict[str, Any]:
    """See Answer.to_dict."""
    return {key: _plain(value) for key, value in _parts(answer).items()}


def _json(value: Any) -> Iterator[str]:
    """What json.dumps makes of the plain value, in pieces, and of arrays at the speed of the compiled core."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        yield json_numbers(value)
    elif isinstance(value, Mapping):
        yield "{"
        for i, (key, item) in enumerate(value.items()):
            yield f"{', ' if i else ''}{json.dumps(key)}: "
            yield from _json(item)
        yield "}"
    else:
        try:
            yield json.dumps(value.tolist() if isinstance(value, np.ndarray) else value, allow_nan=False)
        except ValueError:  # something in it is not finite
            yield json.dumps(_plain(value))


def _written(text: str, file: str | os.PathLike[str] | None, end: str = "") -> str:
    """The text, which goes into the file, too, where one is named."""
    if file is not None:
        write_text(file, text, end)
    return text


def to_json(answer: Answer, file: str | os.PathLike[str] | None = None) -> str:
    """See Answer.to_json."""
    return _written("".join(_json(_parts(answer))), file, "\n")


def from_json(file: str | os.PathLike[str]) -> Answer:
    """See Answer.from_json."""
    try:
        read = json.loads(Path(file).read_text(encoding="utf-8"))
        return _answer_of(read)
    except (ValueError, LookupError, TypeError, AttributeError) as wrong:
        raise DomainError(f"{os.fspath(file)}: this is no answer that gyrostat has written as JSON ({type(wrong).__name__}: {wrong})") from None


def _answer_of(read: dict[str, Any]) -> Answer:
    def numbers(values: Mapping[str, Any], none: float) -> dict[str, float]:
        return {name: none if value is None else float(value) for name, value in values.items()}

    def column(values: list[Any]) -> NDArray[Any]:
        return np.array(values) if values and isinstance(values[0], str) else np.array(values, dtype=float)

    def scalar(value: Any) -> Any:
        return np.array(value, dtype=float) if isinstance(value, list) and value and not isinstance(value[0], str) else value

    scene, effect = read["scene"], read.get("data_error")
    return Answer(
        told=lambda: scene, model=read["model"], tolerance=read["tolerance"], met=read["met"], error=numbers(read["error"], math.inf),
        warnings=tuple(Warning_(**each) for each in read["warnings"]), t=np.array(read["t"], dtype=float),
        columns={name: column(values) for name, values in read["columns"].items()},
        scalars=Scalars({name: scalar(value) for name, value in read["scalars"].items()}),
        scalar_error=numbers(read["scalar_error"], math.nan), scale=numbers(read["scale"], math.inf), tolerances=numbers(read["tolerances"], math.inf),
        counts=read["counts"], seconds=read["seconds"], tried=tuple(Attempt(**each) for each in read["tried"]),
        own_torque=read.get("own_torque", False),
        data_error=None if effect is None else DataError(numbers({name: each["effect"] for name, each in effect.items()}, math.inf),
                                                         {name: each["mostly"] for name, each in effect.items()}))


def _per_wheel(answer: Answer) -> set[str]:
    """The columns that have a number for each wheel."""
    facts = FACTS.get(answer.scene.get("kind", ""))
    return {column.name for column in facts.columns.values() if column.width == 0} if facts else set()


def _flat(answer: Answer) -> Iterator[tuple[str, NDArray[Any]]]:
    """Columns of one number each, without the time."""
    per_wheel = _per_wheel(answer)
    for name, values in answer.columns.items():
        if values.ndim == 1:
            yield name, values
        else:
            axes = tuple(str(i) for i in range(1, values.shape[1] + 1)) if name in per_wheel else _AXES
            for axis, part in zip(axes, values.T, strict=False):
                yield f"{name}_{axis}", part


def to_csv(answer: Answer, file: str | os.PathLike[str] | None = None) -> str:
    """See Answer.to_csv."""
    head = ",".join(["t", *(name for name, _ in _flat(answer))])
    columns = [answer.t, *(values.astype("S") if values.dtype.kind == "U" else values for values in answer.columns.values())]
    return _written(f"{head}\n{csv_rows(columns)}", file)


def to_dataframe(answer: Answer) -> "pandas.DataFrame":
    """See Answer.to_dataframe."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("pandas is not installed: pip install 'gyrostat[pandas]'") from error
    frame = pandas.DataFrame(dict(_flat(answer)), index=pandas.Index(answer.t, name="t"))
    told = _parts(answer)
    frame.attrs.update({key: _plain(told[key]) for key in ("model", "tolerance", "met", "error", "scalars", "scalar_error", "units")})
    return frame


def _scalar_attributes(answer: Answer) -> Iterator[tuple[str, Any]]:
    """Value, unit and error of each scalar that is known."""
    for name, value in answer.scalars.items():
        if value is None:
            continue
        if isinstance(value, str | list):  # words
            yield name, value if isinstance(value, str) else ", ".join(value)
            continue
        yield name, np.asarray(value, dtype=float)
        if unit := UNITS.get(name):
            yield f"{name}_units", unit
        if math.isfinite(answer.scalar_error[name]):
            yield f"{name}_estimated_error", answer.scalar_error[name]


def to_xarray(answer: Answer) -> "xarray.Dataset":
    """See Answer.to_xarray."""
    variables: dict[str, Any] = {}
    per_wheel, meanings = _per_wheel(answer), _meanings(answer)
    for name, values in answer.columns.items():
        axis = {1: (), 2: ("wheel" if name in per_wheel else "axis" if values.shape[-1] == 3 else "component",)}[values.ndim]
        attributes: dict[str, Any] = {"units": UNITS.get(name, ""), "long_name": meanings[name]}
        if name in answer.error and math.isfinite(answer.error[name]):
            attributes["estimated_error"] = answer.error[name]
        if name in answer.tolerances:
            attributes["tolerance"] = answer.tolerances[name]
        variables[name] = (("t", *axis), values, attributes)
    coordinates: dict[str, Any] = {"t": ("t", answer.t, {"units": UNITS["t"], "long_name": TIME})}
    if any("axis" in dims for dims, _, _ in variables.values()):
        coordinates["axis"] = list(_AXES[:3])
    if any("component" in dims for dims, _, _ in variables.values()):
        coordinates["component"] = list(_AXES)
    attributes = {
        "title": str(answer.scene.get("name", "")), "source": str(answer.scene.get("source", "")), "model": answer.model,
        "tolerance": answer.tolerance, "met": int(answer.met), "scene": json.dumps(answer.scene),
        "warnings": "\n".join(f"{w.code}: {w.message}" for w in answer.warnings),
        **dict(_scalar_attributes(answer)),
    }
    made: xarray.Dataset = import_xarray().Dataset(variables, coordinates, attributes)
    return made


def to_netcdf(answer: Answer, file: str | os.PathLike[str]) -> None:
    """See Answer.to_netcdf."""
    dataset = to_xarray(answer)
    try:
        import scipy.io  # noqa: F401
    except ImportError as error:
        raise ImportError("scipy is not installed: pip install 'gyrostat[xarray]'") from error
    with written(file) as beside:
        dataset.to_netcdf(beside, engine="scipy")
