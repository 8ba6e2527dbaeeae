# SPDX-License-Identifier: BSD-3-Clause
"""What the ladder answers: columns over time, scalars, the error estimate of each, and how the answer was found."""

import io
import math
import os
from collections.abc import Callable, Iterator, KeysView, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gyrostat.console import small
from gyrostat.errors import DomainError
from gyrostat.facts import FACTS
from gyrostat.orientation import NOT_ORTHONORMAL, form_of

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from gyrostat.view import View

__all__ = ["Answer", "Attempt", "DataError", "Warning_"]


@dataclass(frozen=True, slots=True)
class Warning_:
    """Something the user should know: a code to test for and a sentence."""

    code: str
    message: str


@dataclass(frozen=True, slots=True)
class Attempt:
    """A rung that was looked at.

    error : its own estimate, None where it was passed over unsolved.
    predicted, spent : what an answer by it was to cost, and what it took [s]. Rungs are asked in the order of the predictions, which are made
        for a core of some 3 GHz; None where there is none. Nothing is spent on a rung that was left out since it would have cost more.
    """

    model: str
    error: float | None
    accepted: bool
    why: str
    predicted: float | None
    spent: float


@dataclass(frozen=True, slots=True)
class DataError:
    """What one rounding of each number of a scene changes in its answer, all to the worse: the part of an error that no method can take away.

    effect : name of a column or scalar -> the change, measured as its stated error is; infinite where it is not in proportion.
    mostly : name -> the key of the number that makes the most of it, such as "body.inertia[0]"; empty where nothing does.
    """

    effect: dict[str, float]
    mostly: dict[str, str]


def _known(value: Any) -> Any:
    """None for a number that has no value."""
    return None if isinstance(value, float) and math.isnan(value) else value


class Scalars(dict[str, Any]):
    """The scalars of an answer by name; the KeyError of one that is not there names those that are."""

    def __missing__(self, name: str) -> Any:
        there = f"the scalars of this answer are {', '.join(self)}" if self else "this answer has none"
        raise KeyError(f'there is no scalar "{name}"; {there}; `gyrostat info --columns` lists those of each kind, to be asked for by name')


@dataclass(frozen=True, eq=False)
class Answer:
    """Answer to a scene: `answer["attitude"]` is a column, `list(answer)` are the names of all, `answer.t` their times.

    columns : name -> (n,) or (n, k) array over the times `t` [s] (`regime`: text).
    error : name -> estimated greatest error over the span, relative to the greatest norm of that column or to its scale, whichever is
        greater (attitude: rotation angle [rad]; modulus_squared: absolute). met : the greatest error is within `tolerance`.
    scale : name -> what the scene makes of a column's scale, in its unit, so that no error is relative to a column that vanishes.
    scalars : name -> number, vector, truth value, words, or None where it has no value; a vector whose components have none is NaN.
    scalar_error : name -> estimated error, relative; NaN where the scalar has none, being a definition, infinite or not known.
    tolerances : name -> what the error of a column or scalar was held against; what was not asked for is not there.
    data_error : what one rounding of each number of the scene changes; None unless it was asked for, as `solve(scene, data_error=True)` does.
    gyrostat.facts has units and meanings; `gyrostat info --columns` prints them.
    """

    told: Callable[[], dict[str, Any]] = field(repr=False)
    model: str
    tolerance: float
    met: bool
    error: dict[str, float]
    warnings: tuple[Warning_, ...]
    t: NDArray[np.float64]
    columns: dict[str, NDArray[Any]]
    scalars: Scalars
    scalar_error: dict[str, float]
    scale: dict[str, float]
    tolerances: dict[str, float]
    counts: dict[str, int]
    seconds: float
    tried: tuple[Attempt, ...] = field(default=())
    data_error: DataError | None = None
    own_torque: bool = False  # a function of the caller's acted, which the scene does not hold

    @classmethod
    def of(cls, told: Callable[[], dict[str, Any]], times: NDArray[np.float64], tolerance: float, made: Mapping[str, Any]) -> "Answer":
        """The answer that the compiled ladder `made` for the scene that `told` tells."""
        return cls(
            told=told, model=made["model"], tolerance=tolerance, met=made["met"], error=dict(made["error"]),
            warnings=tuple(Warning_(w["code"], w["message"]) for w in made["warnings"]), t=times,
            columns={name: np.asarray(values) for name, values in made["columns"].items()},
            scalars=Scalars({name: _known(value) for name, value in made["scalars"].items()}),
            scalar_error={name: made["scalar_error"].get(name, math.nan) for name in made["scalars"]},
            scale=dict(made["scale"]), tolerances=dict(made["tolerances"]), counts=dict(made["counts"]), seconds=made["seconds"],
            tried=tuple(Attempt(a["model"], a["error"], a["accepted"], a["why"], a["predicted"], a["spent"]) for a in made["tried"]),
        )

    @cached_property
    def scene(self) -> dict[str, Any]:
        """The scene in the layout of a scene file; it is written out when it is first looked at."""
        return self.told()

    def of_scene(self, told: Callable[[], dict[str, Any]], off_orthonormal: float = 0) -> "Answer":
        """This answer, as that of the scene that `told` tells, whose direction cosines are so far off being orthonormal."""
        self.__dict__.pop("scene", None)
        self.__dict__["told"] = told
        if off_orthonormal > 0:
            code, text = NOT_ORTHONORMAL
            self.__dict__["warnings"] = (*self.warnings, Warning_(code, f"{text} {off_orthonormal:.2g}"))
        return self

    @property
    def greatest_error(self) -> float:
        """The greatest of the estimated errors of what is asked for."""
        accepted = next((attempt for attempt in self.tried if attempt.accepted), None)
        return math.nan if accepted is None or accepted.error is None else accepted.error

    @property
    def least_certain(self) -> str:
        """The column or scalar that was asked for and has no value, or else whose error is the greatest share of its tolerance; empty where none is known."""
        if lacking := self.without_value:
            return lacking[0]
        errors = {**self.error, **self.scalar_error}
        shares = {name: errors[name] / tolerance for name, tolerance in self.tolerances.items() if errors[name] > 0}
        return max(shares, key=lambda name: shares[name], default="")

    @property
    def without_value(self) -> tuple[str, ...]:
        """What was asked for to a tolerance and has no value, where that keeps the answer from being met."""
        if self.met:
            return ()
        first = {name: values.flat[0] for name, values in self.columns.items() if values.size} | self.scalars
        return tuple(name for name in self.tolerances if (value := first.get(name)) is None or (isinstance(value, float) and math.isnan(value)))

    @property
    def verdict(self) -> str:
        """How good the answer is, by what is least certain of what was asked for, and whether that meets its tolerance."""
        met, name = "met" if self.met else "NOT met", self.least_certain
        if name in self.without_value:
            return f"{name} has no value, tolerance {self.tolerances[name]:.3g} {met}"
        if not self.tolerances:
            return "nothing that was asked for has an error of its own"
        error = {**self.error, **self.scalar_error}.get(name, self.greatest_error)
        return f"estimated error {small(error)}{f' ({name})' if name else ''}, tolerance {self.tolerances.get(name, self.tolerance):.3g} {met}"

    def keys(self) -> KeysView[str]:
        """Names of the columns."""
        return self.columns.keys()

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self.columns)

    def __contains__(self, name: object) -> bool:
        """Whether `answer[name]` is there: a column, or "t"."""
        return name == "t" or name in self.columns

    def __getitem__(self, column: str) -> NDArray[Any]:
        """A column by name, or "t". Raises KeyError, naming those that are there."""
        if column == "t":
            return self.t
        if column not in self.columns:
            raise KeyError(self._missing(column))
        return self.columns[column]

    def _missing(self, column: str) -> str:
        """Why there is no such column."""
        facts = FACTS.get(self.scene.get("kind", ""))
        text = f'there is no column "{column}"; the columns of this answer by {self.model} are {", ".join(self.columns)}'
        if column in self.scalars:
            text += f'; {column} is a scalar: answer.scalars["{column}"]'
        elif facts and column in facts.columns:
            text += f"; {column} belongs to scenes of this kind"
            start = self.scene.get("initial", {})
            if column == "attitude" and "attitude" not in start and not form_of(start):
                text += ", where initial.attitude is given or it is asked for by name"
            elif self.scene.get("solve", {}).get("model", "auto") != "auto" and self.model != "full":
                text += ': a higher rung gives it, as model = "full" does'
            else:
                text += f': ask for it, as ask = ["{column}"]'
        return text

    def __repr__(self) -> str:
        scalars = [f"{name} {value:.6g} (error {self.scalar_error[name]:.2g})" for name, value in self.scalars.items()
                   if isinstance(value, float) and not math.isnan(self.scalar_error[name])]
        return (f"<Answer of {self.scene.get('name', 'a scene')} by {self.model}: {self.verdict}, {len(self.t)} times, "
                f"{', '.join([*self.columns, *scalars])}>")

    def __str__(self) -> str:
        """The report, as the command `gyrostat solve` prints it."""
        from gyrostat.report import report

        text = io.StringIO()
        report(self, text)
        return text.getvalue()

    def _repr_html_(self) -> str:
        from gyrostat.notebook import answer_html

        return answer_html(self)

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON: numbers that are not finite become None."""
        from gyrostat.export import to_dict

        return to_dict(self)

    def to_json(self, file: str | os.PathLike[str] | None = None) -> str:
        """One JSON object; every number reads back as the same double. Written to `file`, too, where one is named."""
        from gyrostat.export import to_json

        return to_json(self, file)

    @staticmethod
    def from_json(file: str | os.PathLike[str]) -> "Answer":
        """The answer that `to_json`, or `gyrostat solve -o answer.json`, has written. What was not finite is NaN in columns, infinite as an error and None as
        a scalar. Raises DomainError where the file holds no answer."""
        from gyrostat.export import from_json

        return from_json(file)

    def to_csv(self, file: str | os.PathLike[str] | None = None) -> str:
        """Comma-separated columns under one header line (vectors as _x, _y, _z, quaternions also _w). Written to `file`, too, where one is named."""
        from gyrostat.export import to_csv

        return to_csv(self, file)

    def to_dataframe(self) -> "pandas.DataFrame":
        """A pandas.DataFrame over t, with the column names of CSV; units, errors and scalars in its `attrs`. Needs pandas."""
        from gyrostat.export import to_dataframe

        return to_dataframe(self)

    def to_xarray(self) -> "xarray.Dataset":
        """An xarray.Dataset over t, with units, errors and scalars as attributes. Needs xarray."""
        from gyrostat.export import to_xarray

        return to_xarray(self)

    def to_netcdf(self, file: str | os.PathLike[str]) -> None:
        """Write a NetCDF file (format 3). Needs xarray and scipy."""
        from gyrostat.export import to_netcdf

        to_netcdf(self, file)

    def plot(self, file: str | os.PathLike[str] | None = None) -> "Figure":
        """A figure of the answer; written to `file` (PNG, SVG, PDF by its ending) where one is named. Needs matplotlib."""
        from gyrostat.plots import plot_answer, save

        figure = plot_answer(self)
        if file is not None:
            save(figure, Path(file))
        return figure

    def view(self, begin: float | None = None, end: float | None = None) -> "View":
        """The motion as one HTML page that needs nothing else: `.save("view.html")`, or as it stands in a notebook.

        begin, end : the window [s]; by default from 0 for some tens of turns. The scene is solved anew, for attitude, angular velocity and
        momentum at times that make a smooth picture; what was chosen for it stands in `notes` and on the page. Raises DomainError where
        nothing turns and where the window has too many turns.
        """
        from gyrostat.scenes import scene_from
        from gyrostat.view import view

        if self.own_torque:
            raise DomainError("a view solves the scene anew, which does not hold the torque of your own that acted here")
        return view(scene_from(self.scene), begin, end)
