# SPDX-License-Identifier: BSD-3-Clause
"""What the ladder answers: columns over time, scalars, the error estimate of each, and how the answer was found."""

import csv
import io
import json
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.facts import MEANINGS, UNITS

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

__all__ = ["Answer", "Attempt", "Warning_", "UNITS"]

_AXES: Final = ("x", "y", "z", "w")


@dataclass(frozen=True, slots=True)
class Warning_:
    """Something the user should know: a code to test for and a sentence."""

    code: str
    message: str


@dataclass(frozen=True, slots=True)
class Attempt:
    """A rung that was looked at; `error` is its own estimate, None where it was passed over unsolved."""

    model: str
    error: float | None
    accepted: bool
    why: str


@dataclass(frozen=True, eq=False)
class Answer:
    """Answer to a scene.

    columns : name -> (n,) or (n, k) array over the times `t` [s] (`regime`: text); UNITS holds their units.
    error : name -> estimated greatest error over the span, relative to the greatest norm of that column
        (attitude: rotation angle [rad]; modulus_squared: absolute). met : the greatest error is within `tolerance`.
    """

    scene: dict[str, Any]
    model: str
    tolerance: float
    met: bool
    error: dict[str, float]
    warnings: tuple[Warning_, ...]
    t: NDArray[np.float64]
    columns: dict[str, NDArray[Any]]
    scalars: dict[str, Any]
    counts: dict[str, int]
    seconds: float
    tried: tuple[Attempt, ...] = field(default=())

    @classmethod
    def of(cls, scene: Mapping[str, Any], times: NDArray[np.float64], tolerance: float, made: Mapping[str, Any]) -> "Answer":
        """The answer that the compiled ladder `made` for a scene."""
        return cls(
            scene=dict(scene), model=made["model"], tolerance=tolerance, met=made["met"], error=dict(made["error"]),
            warnings=tuple(Warning_(w["code"], w["message"]) for w in made["warnings"]), t=times,
            columns={name: np.asarray(values) for name, values in made["columns"].items()},
            scalars=dict(made["scalars"]), counts=dict(made["counts"]), seconds=made["seconds"],
            tried=tuple(Attempt(a["model"], a["error"], a["accepted"], a["why"]) for a in made["tried"]),
        )

    @property
    def greatest_error(self) -> float:
        """Greatest estimated error of any column."""
        return max((e for e in self.error.values() if not math.isnan(e)), default=math.nan)

    def __getitem__(self, column: str) -> NDArray[Any]:
        """A column by name, or "t"."""
        return self.t if column == "t" else self.columns[column]

    def __repr__(self) -> str:
        met = "met" if self.met else "not met"
        return (f"<Answer of {self.scene.get('name', 'a scene')} by {self.model}: error {self.greatest_error:.2g}, "
                f"tolerance {self.tolerance:g} {met}, {len(self.t)} times, {', '.join(self.columns)}>")

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON: numbers that are not finite become None."""
        return {
            "scene": self.scene, "model": self.model, "tolerance": self.tolerance, "met": self.met,
            "error": _finite(self.error),
            "warnings": [{"code": w.code, "message": w.message} for w in self.warnings],
            "t": _finite(self.t), "columns": _finite(self.columns), "scalars": _finite(self.scalars),
            "counts": self.counts, "seconds": self.seconds,
            "tried": [{"model": a.model, "error": _finite(a.error), "accepted": a.accepted, "why": a.why} for a in self.tried],
        }

    def to_json(self) -> str:
        """One JSON object; every number reads back as the same double."""
        return json.dumps(self.to_dict(), allow_nan=False)

    def to_csv(self) -> str:
        """Comma-separated columns under one header line (vectors as _x, _y, _z, quaternions also _w)."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        flat = list(self._flat())
        writer.writerow([name for name, _ in flat])
        writer.writerows(zip(*(values.tolist() for _, values in flat), strict=True))
        return text.getvalue()

    def _flat(self) -> Iterator[tuple[str, NDArray[Any]]]:
        yield "t", self.t
        for name, values in self.columns.items():
            if values.ndim == 1:
                yield name, values
            else:
                for axis, part in zip(_AXES, values.T, strict=False):
                    yield f"{name}_{axis}", part

    def to_xarray(self) -> "xarray.Dataset":
        """An xarray.Dataset over t, with units, errors and scalars as attributes. Needs xarray."""
        try:
            import xarray
        except ImportError as error:
            raise ImportError("xarray is not installed: pip install 'gyrostat[xarray]'") from error
        variables: dict[str, Any] = {}
        for name, values in self.columns.items():
            axis = {1: (), 2: ("axis" if values.shape[-1] == 3 else "component",)}[values.ndim]
            attributes: dict[str, Any] = {"units": UNITS.get(name, ""), "long_name": MEANINGS.get(name, name)}
            if name in self.error and math.isfinite(self.error[name]):
                attributes["estimated_error"] = self.error[name]
            variables[name] = (("t", *axis), values, attributes)
        coordinates: dict[str, Any] = {"t": ("t", self.t, {"units": "s", "long_name": "time"})}
        if any("axis" in dims for dims, _, _ in variables.values()):
            coordinates["axis"] = list(_AXES[:3])
        if any("component" in dims for dims, _, _ in variables.values()):
            coordinates["component"] = list(_AXES)
        attributes = {
            "title": str(self.scene.get("name", "")), "source": str(self.scene.get("source", "")), "model": self.model,
            "tolerance": self.tolerance, "met": int(self.met), "scene": json.dumps(self.scene),
            "warnings": "\n".join(f"{w.code}: {w.message}" for w in self.warnings),
            **{name: np.asarray(value, dtype=float) for name, value in self.scalars.items() if value is not None},
        }
        return xarray.Dataset(variables, coordinates, attributes)

    def to_netcdf(self, file: str | os.PathLike[str]) -> None:
        """Write a NetCDF file (format 3). Needs xarray and scipy."""
        dataset = self.to_xarray()
        try:
            import scipy.io  # noqa: F401
        except ImportError as error:
            raise ImportError("scipy is not installed: pip install 'gyrostat[xarray]'") from error
        dataset.to_netcdf(file, engine="scipy")

    def plot(self, file: str | os.PathLike[str] | None = None) -> "Figure":
        """A figure of the answer; written to `file` (PNG, SVG, PDF by its ending) where one is named. Needs matplotlib."""
        from gyrostat.plots import plot_answer, save

        figure = plot_answer(self)
        if file is not None:
            save(figure, Path(file))
        return figure


def _finite(value: Any) -> Any:
    """Arrays as lists, and None in place of what is not finite."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return value
