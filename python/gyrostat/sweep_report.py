# SPDX-License-Identifier: BSD-3-Clause
"""What the results of a sweep say: tables, and figures that need matplotlib."""

import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat.asking import asked
from gyrostat.console import short, small
from gyrostat.drawing import COLOURS, Drawing, head, new_figure, note, save, span_text, time_unit
from gyrostat.errors import DomainError, SceneError
from gyrostat.facts import FACTS
from gyrostat.scenes import scene_from
from gyrostat.vary import Spread, read_words

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["Dependence", "Index", "Response", "dependences", "drawings", "missed_by", "rank_correlations", "responses", "save_figures", "shares", "sobol_indices", "tables", "variance_shares"]

PERCENTILES: Final = (1, 5, 25, 50, 75, 95, 99)
ROUNDINGS: Final = 1e-12  # a spread this small beside the values cannot be cut into bins
MOST_DOTS: Final = 20000  # of a scatter plot
MOST_PANELS: Final = 12
CHECKS: Final = ("energy_balance", "momentum_balance")
ENOUGH: Final = 100  # rows, to tell a share of the variance
MOST_CURVES: Final = 24  # of which a curve over a parameter is the sum
MOST_ROWS: Final = 2**17  # that a share of the variance is told by
FEW_TIMES: Final = 12  # between so few a curve would be guessed
RESAMPLED: Final = 200  # times, for a standard error

Floats = NDArray[np.float64]
Table = tuple[str, Sequence[str], Sequence[Sequence[str]]]


@dataclass(frozen=True, eq=False)
class Response:
    """A number of every row; NaN where it has none."""

    label: str
    unit: str
    values: Floats  # (n,)
    error: Floats | None  # (n,), as its family measures it
    at_end: bool = False  # of a column, at the last time


def _labels(dataset: "xarray.Dataset", name: str, dims: Sequence[str]) -> list[str]:
    """Of the components of a variable."""
    return [f"{name}_{label}" for label in dataset[dims[0]].values] if dims else [name]


def _quantities(dataset: "xarray.Dataset", over_time: bool) -> Iterator[tuple[str, Any]]:
    """The columns, or the scalars, that are numbers."""
    known = FACTS[dataset.attrs["kind"]].quantities
    for name, variable in dataset.data_vars.items():
        if name in known and variable.dtype.kind == "f" and known[str(name)].kind == "number" and ("time" in variable.dims) == over_time:
            yield str(name), variable


def parameters(dataset: "xarray.Dataset") -> "dict[str, xarray.DataArray]":
    """What varies, by key."""
    return {str(name): values for name, values in dataset.data_vars.items() if values.attrs.get("role") == "parameter"}


def responses(dataset: "xarray.Dataset") -> list[Response]:
    """The scalars, component by component, but for checks of the computation; where none has a value the columns at the last time."""
    found = []
    for over_time in (False, True):
        for name, variable in _quantities(dataset, over_time):
            if name in CHECKS:
                continue
            values = variable.isel(time=-1) if over_time else variable
            error = dataset[f"{name}_error"].values if f"{name}_error" in dataset else None
            parts = values.values.reshape(values.shape[0], -1).T
            labels = _labels(dataset, name, [str(dim) for dim in values.dims[1:]])
            made = [Response(label, values.attrs.get("units", ""), part, error, over_time) for label, part in zip(labels, parts, strict=True)]
            found += [each for each in made if np.isfinite(each.values).any()]
        if found:
            break
    return found


def endless(dataset: "xarray.Dataset") -> list[Response]:
    """The scalars that are infinite in every row that has a value, as the time of a stop that never comes."""
    found = []
    for name, variable in _quantities(dataset, False):
        values = variable.values[~np.isnan(variable.values)]
        if variable.ndim == 1 and len(values) and np.all(values == np.inf):
            found.append(Response(name, variable.attrs.get("units", ""), variable.values, None))
    return found


def _ranks(values: Floats) -> Floats:
    """Ranks from 0; of equal values the mean of theirs."""
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    first = np.cumsum(counts) - counts
    made: Floats = (first + (counts - 1) / 2)[inverse]
    return made


def rank_correlations(dataset: "xarray.Dataset", response: Response) -> dict[str, float]:
    """Spearman's rank correlation of the response with each parameter, over the rows that have both; NaN where one of them is constant."""
    made = {}
    for key, values in parameters(dataset).items():
        known = np.isfinite(response.values) & np.isfinite(values.values)
        x, y = _ranks(values.values[known]), _ranks(response.values[known])
        x, y = x - np.mean(x) if len(x) else x, y - np.mean(y) if len(y) else y
        size = math.sqrt(float(x @ x) * float(y @ y))
        made[key] = float(x @ y) / size if size > 0 else math.nan
    return made


def _unexplained(x: Floats, y: Floats) -> float:
    """What a curve over x leaves of the sum of the squares of y: a parabola in x and slow waves in its rank, which points of low discrepancy tell from those
    of other numbers. The square of each row is divided by what its own weight in the fit leaves of it (MacKinnon and White 1985, HC2)."""
    apart, rank = x - np.mean(x), np.pi * (_ranks(x) + 0.5) / len(x)
    apart = apart / np.max(np.abs(apart), initial=1e-300)
    waves = range(1, min(MOST_CURVES, round(3 * math.sqrt(len(y)) / 4)) - 1)
    curves = [np.ones_like(x), apart, apart**2, *(np.cos(k * rank) for k in waves)][:len(np.unique(x))]
    base = np.linalg.qr(np.stack(curves, axis=1)).Q
    residual = y - base @ (base.T @ y)
    return float(np.sum(residual**2 / np.maximum(1 - np.sum(base**2, axis=1), ROUNDINGS)))


def _drawn_for_themselves(dataset: "xarray.Dataset") -> NDArray[np.bool_]:
    """Of the design saltelli the two rows of each point of which the others are mixtures; else all rows."""
    rows, study = dataset["row"].values, json.loads(dataset.attrs.get("study", "{}"))
    every: NDArray[np.bool_] = np.ones(len(rows), dtype=bool)
    if study.get("design") != "saltelli" or study["cases"] or not all(isinstance(read_words(text), Spread) for text in study["vary"].values()):
        return every
    own: NDArray[np.bool_] = rows % (len(study["vary"]) + 2) < 2
    return own if own.sum() >= ENOUGH else every


def variance_shares(dataset: "xarray.Dataset", response: Response) -> dict[str, float]:
    """Share of the response's variance that each parameter explains by itself, of any smooth shape, rising or not: by a curve over the parameter, less what
    chance makes of it, at least 0; NaN where one of them is constant, and of fewer than ENOUGH rows. Of random rows, of which the first MOST_ROWS are looked
    at, it estimates the first Sobol index: of hundreds to some hundredths, of ten thousands to some thousandths. Of the design saltelli those rows that
    are drawn for themselves count."""
    made = {}
    own = _drawn_for_themselves(dataset)
    for key, values in parameters(dataset).items():
        known = own & np.isfinite(response.values) & np.isfinite(values.values)
        x, y = values.values[known][:MOST_ROWS], response.values[known][:MOST_ROWS]
        made[key] = math.nan
        if len(y) < ENOUGH:
            continue
        y = y / np.max(np.abs(y), initial=1e-300)  # whose squares are numbers
        y = y - np.mean(y)
        whole = float(y @ y) * len(y) / (len(y) - 1)
        if whole > 0 and np.ptp(x) > 0:
            made[key] = max(0.0, 1 - _unexplained(x, y) / whole)
    return made


@dataclass(frozen=True, slots=True)
class Dependence:
    """How a response hangs on each parameter: its rank correlation, and the share of its variance; NaN where that is not known."""

    ranked: dict[str, float]
    explained: dict[str, float]

    @property
    def strength(self) -> dict[str, float]:
        """The greater of the size of the correlation and the share; known ones alone."""
        made = {key: max((size for size in (abs(self.ranked[key]), self.explained[key]) if math.isfinite(size)), default=math.nan) for key in self.ranked}
        return {key: size for key, size in made.items() if math.isfinite(size)}


def dependences(dataset: "xarray.Dataset") -> dict[str, Dependence]:
    """That of each response, by its label. Of many rows it costs more than all else of a report: tables and figures share it."""
    return {each.label: Dependence(rank_correlations(dataset, each), variance_shares(dataset, each)) for each in responses(dataset)}


@dataclass(frozen=True, slots=True)
class Index:
    """Sobol indices of one number: its share of the variance by itself, and with all that it does together with others; each with its standard error."""

    first: float
    first_error: float
    total: float
    total_error: float


def sobol_indices(dataset: "xarray.Dataset", response: Response) -> dict[str, Index]:
    """Of each random number, by the estimators of Saltelli et al. (2010), as scipy.stats.sobol_indices has them; standard errors by resampling the points.
    Points one of whose rows has no answer are left out. Empty where the rows are not of the design saltelli, or a grid or cases stand beside it."""
    study = json.loads(dataset.attrs["study"])
    vary = {key: read_words(text) for key, text in study["vary"].items()}
    names = sorted(vary)
    if study["design"] != "saltelli" or study["cases"] or not all(isinstance(each, Spread) for each in vary.values()):
        return {}
    block = len(names) + 2
    skipped = -int(dataset["row"][0]) % block  # of a point that begins in another shard
    rows = response.values[skipped:]
    points = rows[:len(rows) // block * block].reshape(-1, block)
    points = points[np.isfinite(points).all(axis=1)]
    if len(points) < 2 or not np.ptp(points[:, :2]) > 0:
        return {}
    found = _indices(points)
    draws = np.random.default_rng(0).integers(len(points), size=(RESAMPLED, len(points)))
    error = np.std([_indices(points[draw]) for draw in draws], axis=0)
    return {name: Index(*map(float, (found[0, i], error[0, i], found[1, i], error[1, i]))) for i, name in enumerate(names)}


def _indices(points: Floats) -> Floats:
    """First-order and total indices, (2, numbers), of values at A, B and their mixtures, a line a point."""
    centred = points - np.mean(points[:, :2])
    a, b, mixed = centred[:, :1], centred[:, 1:2], centred[:, 2:]
    made: Floats = np.array([np.mean(b * (mixed - a), axis=0), np.mean((a - mixed) ** 2, axis=0) / 2]) / np.var(centred[:, :2])
    return made


def shares(values: "xarray.DataArray") -> dict[str, float]:
    """Of a variable of words: word -> share of the rows, the greatest first."""
    words, counts = np.unique(values.values.astype(str), return_counts=True)
    every = counts.sum()
    return {str(words[i]): float(counts[i] / every) for i in np.argsort(-counts, kind="stable")}


def missed_by(dataset: "xarray.Dataset") -> dict[str, float]:
    """Column or scalar -> share of the rows that are over the tolerance by its error, more than by any other; the greatest first."""
    solve = json.loads(dataset.attrs["study"])["scene"]["solve"]
    own = {name: (tolerance, absolute) for name, tolerance, absolute, *_ in asked(dataset.attrs["kind"], solve.get("ask")) or ()}
    excess = dataset["excess"].values
    found = np.full(len(excess), "", dtype=object)
    for name, error in dataset.data_vars.items():
        of = str(name).removesuffix("_error")
        if of == name:
            continue
        tolerance, absolute = own.get(of, (math.nan, False))
        limit = excess * (tolerance if tolerance > 0 else solve["tolerance"])
        found[np.isclose(error.values, limit, rtol=1e-9, atol=0)] = of
        if absolute:  # an error that is relative to the size
            size = np.abs(dataset[of].values).reshape(len(excess), -1).max(axis=1)
            found[np.isclose(error.values * size, limit, rtol=1e-9, atol=0)] = of
    found[dataset["met"].values | (dataset["reason"].values.astype(str) != "")] = ""
    names, counts = np.unique(found.astype(str), return_counts=True)
    return {str(names[i]): float(counts[i] / len(found)) for i in np.argsort(-counts, kind="stable") if names[i]}


# ---- for reading ----


def _percent(share: float) -> str:
    return f"{100 * share:.4g} %"


def tables(dataset: "xarray.Dataset", depends: Mapping[str, Dependence] | None = None) -> Iterator[Table]:
    """Title, heads and rows of each table of the report. `depends`: of these results, where it is known already."""
    depends = dependences(dataset) if depends is None else depends
    met = dataset["met"].values
    rows = []
    for name, share in shares(dataset["model"]).items():
        of = dataset["model"].values.astype(str) == name
        excess = dataset["excess"].values[of]
        worst = "-" if np.isnan(excess).all() else small(float(np.nanmax(excess)))
        rows.append([name or "no answer", _percent(share), str(int(of.sum())), _percent(float(met[of].mean())), worst])
    yield f"Rungs, {len(met)} rows, {_percent(float(met.mean()))} within the tolerance", [
        "rung", "share", "rows", "within the tolerance", "greatest error over its tolerance"], rows
    yield "Over the tolerance by what errs most", ["", "share", "rows"], [
        [name, _percent(share), str(round(share * len(met)))] for name, share in missed_by(dataset).items()]
    rows = []
    shown = responses(dataset)
    for each in shown:
        known = np.isfinite(each.values)
        numbers = [short(float(value), 5) for value in np.percentile(each.values[known], PERCENTILES)]
        errors = np.empty(0) if each.error is None else each.error[known.reshape(len(known), -1).any(axis=1) & ~np.isnan(each.error)]
        rows.append([each.label, each.unit, _percent(float(known.mean())), *numbers, small(float(np.max(errors))) if len(errors) else "-"])
    rows += [[each.label, each.unit, _percent(0), *["inf"] * len(PERCENTILES), "-"] for each in endless(dataset)]
    yield f"Percentiles{_when(dataset, shown)}, of the rows in which it is finite", ["", "unit", "finite", *(f"{p} %" for p in PERCENTILES), "greatest error"], rows
    keys = list(parameters(dataset))
    rows = [[label, *(f"{value:+.3f}" if math.isfinite(value) else "-" for value in each.ranked.values())] for label, each in depends.items()]
    yield "Rank correlations (which way it goes; blind to what rises and falls again)", ["", *keys], rows
    rows = [[label, *(_percent(round(value, 3)) if math.isfinite(value) else "-" for value in each.explained.values())] for label, each in depends.items()]
    yield f"Share of the variance that each explains by itself, of any shape ({ENOUGH} rows or more)", ["", *keys], rows
    found = {each.label: sobol_indices(dataset, each) for each in responses(dataset)}
    yield "Sobol indices: share of the variance by itself / with all others, each with its standard error", ["", *sorted(keys)], [
        [label, *(f"{index.first:.3f}({index.first_error:.3f}) / {index.total:.3f}({index.total_error:.3f})" for index in indices.values())]
        for label, indices in found.items() if indices]
    yield "No answer", ["reason", "share", "rows", "such as"], [
        [reason, _percent(share), str(round(share * len(met))), in_words(dataset, reason)] for reason, share in shares(dataset["reason"]).items() if reason]
    bits, masks = dataset["warnings"].values, np.atleast_1d(dataset["warnings"].attrs["flag_masks"])
    told = [(code, float(np.mean((bits & mask) != 0))) for code, mask in zip(dataset["warnings"].attrs["flag_meanings"].split(), masks, strict=True)]
    yield "Warnings", ["code", "share"], [[code, _percent(share)] for code, share in told if share > 0]


def in_words(dataset: "xarray.Dataset", reason: str) -> str:
    """What is wrong with the scene that the first row without an answer for this reason stands for; empty where no key of it is, and of a scene that goes on
    from another, whose file is not looked for again."""
    scene = json.loads(dataset.attrs["study"])["scene"]
    if "from" in scene:
        return ""
    row = int(np.argmax(dataset["reason"].values.astype(str) == reason))
    numbers = {key: values.values[row].item() for key, values in parameters(dataset).items()}
    try:
        scene_from(scene, **numbers)
    except SceneError as error:
        return f"row {dataset['row'].values[row]}: " + "; ".join(f"{each.key}: {each.problem}" for each in error.mistakes)
    except (DomainError, OSError):
        pass
    return ""


# ---- figures ----


def _head(figure: "Figure", dataset: "xarray.Dataset", when: str = "") -> None:
    title = f"{dataset.attrs['title']}: {dataset.sizes['row']} rows, {_percent(float(dataset['met'].values.mean()))} within the tolerance"
    head(figure, [title + when], 11)


def _when(dataset: "xarray.Dataset", shown: Sequence[Response]) -> str:
    """The time of the responses, where these are columns."""
    return f", at t = {span_text(float(dataset['time'].values[-1]))}" if any(each.at_end for each in shown) else ""


def _panels(count: int, width: float, height: float, columns: int) -> "tuple[Figure, list[Axes]]":
    columns = min(columns, count)
    rows = -(-count // columns)
    figure = new_figure(width if columns > 1 else 0.6 * width, 0.6 + height * rows)
    axes = list(figure.subplots(rows, columns, squeeze=False).ravel())
    for extra in axes[count:]:
        extra.axis("off")
    return figure, axes[:count]


def _axis_text(label: str, unit: str) -> str:
    return f"{label} [{unit}]" if unit not in ("", "1") else label


def histograms(dataset: "xarray.Dataset", shown: Sequence[Response]) -> "Figure":
    """How often each response takes which values."""
    figure, axes = _panels(len(shown), 11, 2.9, 2)
    for place, each in zip(axes, shown, strict=True):
        values = each.values[np.isfinite(each.values)]
        unit = each.unit
        if unit == "s":  # in which people tell it
            scale, unit = time_unit(float(np.median(np.abs(values))))
            values = values / scale
        low, high = float(np.min(values)), float(np.max(values))
        least = ROUNDINGS * max(abs(low), abs(high))
        wide = None if high == low or high - low > least else (low - least, high + least)
        place.hist(values, bins=min(60, max(10, round(math.sqrt(len(values))))), range=wide, color=COLOURS[0], alpha=0.75)
        for share, dashes in ((5, ":"), (50, "-"), (95, ":")):
            at = float(np.percentile(values, share))
            place.axvline(at, color=COLOURS[1], linestyle=dashes, linewidth=1.2, label=f"{share} %: {short(at, 5)}")
        place.legend(fontsize=8)
        place.set_xlabel(_axis_text(each.label, unit))
        place.set_ylabel("rows")
        place.grid(alpha=0.3)
        place.ticklabel_format(axis="x", scilimits=(-3, 6))
        if len(values) < len(each.values):
            note(place, f"finite in {_percent(len(values) / len(each.values))}")
    _head(figure, dataset, _when(dataset, shown))
    return figure


def bands(dataset: "xarray.Dataset", columns: Sequence[tuple[str, Any]]) -> "Figure":
    """Percentiles of each column over time."""
    times = dataset["time"].values
    scale, unit = time_unit(float(times[-1]))
    shown = []
    for name, variable in columns:
        parts = np.moveaxis(variable.values.reshape(*variable.shape[:2], -1), 2, 0)
        labels = _labels(dataset, name, [str(dim) for dim in variable.dims[2:]])
        shown += [(label, variable.attrs.get("units", ""), part) for label, part in zip(labels, parts, strict=True)]
    shown = shown[:MOST_PANELS]
    figure, axes = _panels(len(shown), 11, 2.6, 2)
    for place, (label, its_unit, values) in zip(axes, shown, strict=True):
        known = values[np.isfinite(values).all(axis=1)]
        levels = np.percentile(known, (5, 25, 50, 75, 95), axis=0)
        place.fill_between(times / scale, levels[0], levels[4], color=COLOURS[0], alpha=0.2, linewidth=0, label="5 to 95 %")
        place.fill_between(times / scale, levels[1], levels[3], color=COLOURS[0], alpha=0.4, linewidth=0, label="25 to 75 %")
        few = len(times) <= FEW_TIMES
        place.plot(times / scale, levels[2], "o:" if few else "-", markersize=4, color=COLOURS[0], linewidth=1.2, label="median" + few * " (nothing is known between the marks)")
        place.set_ylabel(_axis_text(label, its_unit))
        place.set_xlabel(f"time [{unit}]")
        place.ticklabel_format(axis="y", scilimits=(-3, 6))
        place.grid(alpha=0.3)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8)
    _head(figure, dataset)
    return figure


def tornado(dataset: "xarray.Dataset", shown: Sequence[Response], depends: Mapping[str, Dependence]) -> "Figure":
    """Rank correlation of each response with each parameter, and its share of the variance, the strongest on top."""
    keys = list(parameters(dataset))
    figure, axes = _panels(len(shown), 11, 1.2 + 0.3 * len(keys), 2)
    for place, each in zip(axes, shown, strict=True):
        ranked, explained, strength = depends[each.label].ranked, depends[each.label].explained, depends[each.label].strength
        names = sorted(strength, key=lambda key: strength[key])
        place.barh(names, [ranked[key] for key in names], color=[COLOURS[0] if ranked[key] > 0 else COLOURS[1] for key in names])
        place.plot([explained[key] for key in names], names, "kD", markersize=4)
        place.set_xlim(-1, 1)
        place.set_xticks((-1, -0.5, 0, 0.5, 1))
        place.axvline(0, color="black", linewidth=0.8)
        place.set_xlabel("bar: rank correlation; mark: share of the variance")
        place.set_title(each.label, loc="left", fontsize=10)
        place.grid(alpha=0.3, axis="x")
    _head(figure, dataset, _when(dataset, shown))
    return figure


def scatter(dataset: "xarray.Dataset", shown: Sequence[Response], depends: Mapping[str, Dependence]) -> "Figure":
    """Each response over the parameter that it hangs on most, coloured by the rung that answered."""
    rungs = list(FACTS[dataset.attrs["kind"]].rungs)
    models = dataset["model"].values.astype(str)
    figure, axes = _panels(len(shown), 11, 3.4, 2)
    few = np.arange(0, len(models), -(-len(models) // MOST_DOTS))
    for place, each in zip(axes, shown, strict=True):
        found = depends[each.label].strength
        key = max(found, key=lambda name: found[name]) if found else next(iter(parameters(dataset)))
        values = parameters(dataset)[key]
        answered = few[models[few] != ""]
        colours = [COLOURS[rungs.index(name) % len(COLOURS)] for name in models[answered]]
        place.scatter(values.values[answered], each.values[answered], s=4, alpha=0.6, linewidths=0, c=colours)
        for rung in sorted(set(models[answered]), key=rungs.index):
            place.plot([], [], "o", markersize=5, color=COLOURS[rungs.index(rung) % len(COLOURS)], label=rung)
        place.ticklabel_format(scilimits=(-3, 6))
        wide = values.values[values.values > 0]
        if len(wide) == len(values) and np.ptp(np.log10(wide)) > 1.5:
            place.set_xscale("log")
        place.set_xlabel(_axis_text(key, values.attrs.get("units", "")))
        place.set_ylabel(_axis_text(each.label, each.unit))
        place.legend(fontsize=8)
        place.grid(alpha=0.3)
    _head(figure, dataset, _when(dataset, shown))
    return figure


def drawings(dataset: "xarray.Dataset", depends: Mapping[str, Dependence] | None = None) -> Iterator[Drawing]:
    """Name of the file and figure of what these results can show. `depends` as in `tables`."""
    known = dependences(dataset) if depends is None else depends
    shown = [each for each in responses(dataset) if np.ptp(each.values[np.isfinite(each.values)]) > 0][:MOST_PANELS]
    columns = [(name, values) for name, values in _quantities(dataset, True) if len(dataset["time"]) > 1
               and np.isfinite(values.values).reshape(len(values), -1).all(axis=1).any()]
    made: list[tuple[str, bool, Callable[[], Figure]]] = [
        ("histograms", bool(shown), lambda: histograms(dataset, shown)), ("bands", bool(columns), lambda: bands(dataset, columns)),
        ("tornado", bool(shown), lambda: tornado(dataset, shown, known)), ("scatter", bool(shown), lambda: scatter(dataset, shown, known))]
    yield from ((name, draw) for name, there, draw in made if there)


def save_figures(dataset: "xarray.Dataset", folder: Path, depends: Mapping[str, Dependence] | None = None) -> Iterator[Path]:
    """Writes the figures as PNG; yields their files. `depends` as in `tables`."""
    for name, draw in drawings(dataset, depends):
        folder.mkdir(parents=True, exist_ok=True)
        save(draw(), folder / f"{name}.png")
        yield folder / f"{name}.png"
