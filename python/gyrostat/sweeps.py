# SPDX-License-Identifier: BSD-3-Clause
"""Many scenes at once: a scene some of whose numbers vary from row to row, and the answers to all rows as one xarray.Dataset."""

import json
import math
import os
import re
import time
import uuid
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, Final, Protocol

import numpy as np

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.asking import asked, knows_attitude
from gyrostat.errors import DomainError
from gyrostat.facts import TIME, Facts, Quantity
from gyrostat.families import FAMILIES
from gyrostat.ladder import SceneLike, scene_of
from gyrostat.orientation import NOT_ORTHONORMAL, form_of
from gyrostat.rows import Place, integer, plan_of, request, turned
from gyrostat.scenes import Scene
from gyrostat.sweep_files import check_size, checksum, import_xarray, open_results, save, to_netcdf, writer_of
from gyrostat.vary import Plan
from gyrostat.watching import watched
from gyrostat.writing import written

if TYPE_CHECKING:
    import xarray

__all__ = ["Study", "answered", "merge", "open_results", "save", "sweep"]

MOST_THREADS: Final = 1024
MOST_BYTES: Final = 2**33  # of one Dataset
CHUNK_BYTES: Final = 2**27
MOST_CHUNK: Final = 16384
FIRST_CHUNK: Final = 128  # where chunks are kept; they grow as long as one takes less than
CHUNK_SECONDS: Final = 5.0
ENGINE_CHUNKS: Final = 256  # of an engine, which does not know beforehand what a row costs

Progress = Callable[[int, int], None]


class Engine(Protocol):
    """What does work elsewhere: a dask.distributed.Client, a concurrent.futures.Executor."""

    def submit(self, work: Callable[..., Any], /, *arguments: Any) -> Any:
        """A future of work(*arguments), with result, cancel and add_done_callback."""


@dataclass(frozen=True, eq=False)
class Study:
    """A scene, what varies in it, and the rows that this makes."""

    scene: Scene
    plan: Plan
    places: Mapping[str, Place]

    @classmethod
    def of(cls, scene: Scene, vary: Mapping[str, Any] | None = None, *, n: int | None = None, cases: Any = None, seed: int | None = None,
           design: str | None = None) -> "Study":
        """The study of a scene, of what its own table [vary] says and of what is given here, which goes first. Raises DomainError."""
        plan, places = plan_of(scene, vary, n=n, cases=cases, seed=seed, design=design)
        if plan.n == 0:
            raise DomainError("n: say how many rows there are to be: -n 1000 on the command line, n=1000 in Python, n = 1000 under [vary]")
        return cls(scene, plan, places)

    @cached_property
    def told(self) -> str:
        """The study as JSON, by which two parts of it know each other."""
        scene = {key: value for key, value in self.scene.to_dict().items() if key != "vary"}
        return json.dumps({"version": _core.__version__, "scene": scene, **_before(self.scene), **self.plan.told()})

    @cached_property
    def _request(self) -> dict[str, Any]:
        """What the compiled sweep takes, apart from the rows."""
        solve = self.scene.tables["solve"]
        return {"kind": self.scene.kind, "times": self.scene.times - self.scene.start_time, "tolerance": solve["tolerance"], "model": solve["model"],
                "integrator": solve["integrator"], "elliptic": solve.get("elliptic", "auto"),
                "ask": asked(self.scene.kind, solve["ask"], knows_attitude(self.scene.kind, self.scene.tables))}

    @cached_property
    def _no_rows(self) -> dict[str, Any]:
        """The answers to none, which have the shapes of those to any."""
        return self._answered(range(0), 1, None)[1]

    @cached_property
    def row_bytes(self) -> int:
        """What the answer to a row takes."""
        none = self._no_rows
        numbers = sum(math.prod(values.shape[1:]) for values in (*none["values"].values(), *none["errors"].values()))
        return int(8 * (numbers + len(self.places) + 4))

    def sizes(self, rows: int) -> dict[str, int]:
        """Column or scalar -> what so many rows of it take in a file [bytes]."""
        words = FAMILIES[self.scene.kind].facts.quantities
        return {name: rows * math.prod(values.shape[1:]) * (max(map(len, words[name].words)) if words[name].kind == "word" else 8)
                for name, values in self._no_rows["values"].items()}

    def _answered(self, rows: range, threads: int, monitor: Monitor | None) -> tuple[dict[str, Any], dict[str, Any], np.ndarray[Any, Any]]:
        """Parameters, answers, and for each row what is wrong with its numbers, else empty."""
        columns = self.plan.columns(rows)
        wrong = np.full(len(rows), "", dtype=object)
        turn = turned(self.scene, self.places.values(), columns.values(), len(rows))
        if turn is not None:
            wrong[:] = turn[0]
        for key, values in reversed(list(columns.items())):
            for row in np.flatnonzero(self.places[key].outside(values)):
                wrong[row] = self.places[key].why(values[row])
        made = _core.sweep(**self._request, **request(self.scene, self.places.values(), columns.values(), wrong == ""), threads=threads, monitor=monitor)
        if turn is not None:
            made["warnings"] = made["warnings"] | (turn[1] & (made["rung"] >= 0)) * (1 << len(FAMILIES[self.scene.kind].facts.warnings))
        return columns, made, wrong

    def rows(self, rows: range, threads: int, monitor: Monitor | None = None) -> "xarray.Dataset":
        """The answers to some of the rows."""
        columns, made, wrong = self._answered(rows, threads, monitor)
        facts = FAMILIES[self.scene.kind].facts
        reasons = np.array([_reason(facts, why, rung) for why, rung in made["reasons"]], dtype=object)[made["reason"]]
        reasons = np.where(wrong != "", wrong, reasons)
        variables: dict[str, Any] = {}
        for key, values in columns.items():
            field = self.places[key].field
            words = {"flag_values": np.arange(len(field.choices), dtype=np.int32), "flag_meanings": " ".join(field.choices)} if field.form == "choice" else {}
            variables[key] = ("row", values, {"units": field.unit, "long_name": field.meaning, "role": "parameter",
                                              "varied": str(self.plan.vary.get(key, "case")), **words})
        for name, values in made["values"].items():
            variables |= _variables(facts.quantities[name], name in facts.columns, values, made["errors"][name])
        rungs = np.array([*facts.rungs, ""], dtype=object)
        variables["model"] = ("row", rungs[made["rung"]], {"long_name": "rung that answered"})
        variables["met"] = ("row", made["met"], {"long_name": "the tolerance is met"})
        variables["excess"] = ("row", made["excess"], {"units": "1", "long_name": "greatest error over its tolerance"})
        codes = [*facts.warnings, *([NOT_ORTHONORMAL[0]] if form_of(self.scene.tables.get("initial", {})).startswith("dcm") else [])]
        variables["warnings"] = ("row", made["warnings"].astype(np.int32), {
            "long_name": "warnings", "flag_masks": np.array([1 << i for i in range(len(codes))], dtype=np.int32), "flag_meanings": " ".join(codes)})
        variables["reason"] = ("row", reasons, {"long_name": "why there is no answer"})
        told = {"title": self.scene.name, "source": self.scene.source, "kind": self.scene.kind, "study": self.told}
        dataset: xarray.Dataset = import_xarray().Dataset(variables, self._coordinates(rows, variables), told)
        return dataset

    def _coordinates(self, rows: range, variables: Mapping[str, Any]) -> dict[str, Any]:
        used = {name for dims, *_ in variables.values() if isinstance(dims, tuple) for name in dims}
        every: dict[str, Any] = {"time": ("time", self.scene.times, {"units": "s", "long_name": TIME}), "axis": list("xyz"), "component": list("xyzw")}
        wheels = next((values.shape[dims.index("wheel")] for dims, values, *_ in variables.values() if "wheel" in dims), 0)
        every["wheel"] = np.arange(1, wheels + 1, dtype=np.int32)
        return {"row": np.arange(rows.start, rows.stop, dtype=np.int32), **{name: values for name, values in every.items() if name in used}}


def _before(scene: Scene) -> dict[str, Any]:
    """The scene at whose end this one begins, where there is one: its file may change."""
    return {} if scene.before is None else {"before": {"scene": scene.before.to_dict(), **_before(scene.before)}}


def _reason(facts: Facts, why: str, rung: int) -> str:
    return f"{list(facts.rungs)[rung]}: {why}" if rung >= 0 else why


def _variables(quantity: Quantity, column: bool, values: np.ndarray[Any, Any], errors: np.ndarray[Any, Any]) -> Iterator[tuple[str, Any]]:
    """A column or scalar and its error."""
    dims: tuple[str, ...] = ("row", "time") if column else ("row",)
    if values.ndim > len(dims):
        dims = (*dims, {0: "wheel", 3: "axis", 4: "component"}.get(quantity.width, "part"))
    attributes: dict[str, Any] = {"units": quantity.unit, "long_name": quantity.meaning}
    if quantity.kind == "word":
        words = np.array([*quantity.words, ""], dtype=object)
        values = words[np.where(np.isnan(values), -1, values).astype(int)]
    yield quantity.name, (dims, values, attributes)
    if quantity.measure:
        unit = {"relative": "1", "angle": "rad"}.get(quantity.measure, quantity.unit)
        yield f"{quantity.name}_error", ("row", errors, {"units": unit, "long_name": f"estimated error of {quantity.name}", "measure": quantity.measure})


# ---- doing it ----


def _shard(shard: tuple[int, int] | str | None, n: int) -> range:
    """The rows of part i of m, counted from 1."""
    given: Any = (1, 1) if shard is None else re.split(r"\s*/\s*", shard.strip()) if isinstance(shard, str) else shard
    try:
        i, m = (int(part) if isinstance(part, str) else integer("shard", part) for part in given)
    except (TypeError, ValueError):
        i, m = 0, 0
    if 1 <= i <= m and m > n:
        raise DomainError(f"shard = {shard}: {n} rows make no {m} parts: give at most as many parts as rows, or more rows")
    if not 1 <= i <= m:
        raise DomainError(f"shard = {shard}: give the number of a part and how many there are, such as 1/8; there are {n} rows")
    return range((i - 1) * n // m, i * n // m)


def _missing(rows: range, have: Iterable[range]) -> Iterator[range]:
    """What is left of the rows."""
    at = rows.start
    for each in sorted(have, key=lambda part: part.start):
        if each.start > at:
            yield range(at, min(each.start, rows.stop))
        at = max(at, each.stop)
    if at < rows.stop:
        yield range(at, rows.stop)


def _part_file(folder: Path, rows: range) -> Path:
    return folder / f"rows-{rows.start:010d}-{rows.stop:010d}.nc"


def _has_rows(part: "xarray.Dataset", rows: range) -> bool:
    """Whether a part has these rows, each once, in order."""
    return bool(np.array_equal(part["row"].values, np.arange(rows.start, rows.stop)))


def _kept(folder: Path, study: Study, rows: range) -> "dict[range, xarray.Dataset]":
    """The parts of these rows that an earlier run left behind, but for those that are damaged or hold other rows than their name says."""
    found: dict[range, xarray.Dataset] = {}
    at = rows.start
    for file in sorted(folder.glob("rows-*-*.nc")):
        named = re.fullmatch(r"rows-(\d+)-(\d+)", file.stem)
        if named is None:
            continue
        start, stop = int(named[1]), int(named[2])
        try:
            part = open_results(file)
        except DomainError:  # damaged: its rows are done again
            continue
        if part.attrs["study"] != study.told:
            raise DomainError(f"{file}: this part belongs to another study: remove {folder}, or name another output")
        named_rows = range(start, stop)
        if at <= start and stop <= rows.stop and _has_rows(part, named_rows):
            found[named_rows], at = part, stop
    return found


def sweep(scene: SceneLike, vary: Mapping[str, Any] | None = None, *, n: int | None = None, cases: Any = None, seed: int | None = None,
          design: str | None = None, threads: int | None = None, chunk: int | None = None, shard: tuple[int, int] | str | None = None,
          parts: str | os.PathLike[str] | None = None, progress: Progress | None = None, engine: Engine | None = None,
          **overrides: Any) -> "xarray.Dataset":
    """Answer a scene many times over, each row with other numbers.

    scene : a `Scene`, a dict in the layout of a scene file, a file, or the name of a bundled scene; its own table [vary] is taken, too.
    vary : key -> how the number varies: `normal`, `uniform`, `lognormal` and `choice` of gyrostat.vary, `linspace`, `logspace` or a list of values,
        each an axis of a grid of which all combinations are taken; or the same in words: "normal(0.005, 5%)", "uniform(15, 17)",
        "1e-5:1e-3:50log", "[1, 2, 5]". Keys are those of the scene file, with components counted from 0: "torque.control[0]",
        "body.inertia[0,1]", "wheel[2].rate".
    n : rows; a multiple of the combinations of the grid, which is taken as often. cases : a table, CSV or key -> values, all of one length: its
        lines are taken together, as one more axis of the grid.
    seed, design : of the random numbers: "random", "sobol", "latin-hypercube", or "saltelli" for Sobol indices, with n a multiple of their number + 2.
    threads : all of this machine where it is None; one a chunk with an engine. chunk : rows that are taken in one go; where it is None as many as suit.
    shard : (i, m) or "i/m": part i of m alone, from 1.
    parts : folder in which each chunk is kept when it is done; those that are there already are not done again.
    engine : what does the chunks instead of this process, each as a task of its own: a dask.distributed.Client, whose workers need gyrostat and may
        come and go, or a concurrent.futures.ProcessPoolExecutor.
    progress(done, rows) is called now and then. overrides : keys of the scene file to change, as in `gyrostat.solve`, among them `ask` and `times`.

    What a row comes to is a function of the study, the seed and the number of the row, to the last bit: the same for any number of threads, any
    chunks and any shards.

    Returns an xarray.Dataset over `row` (and `time`, `axis`): the parameters; the columns and scalars that are asked for, each with its
    estimated error NAME_error; `model`, the rung that answered; `met`; `excess`, greatest error over its tolerance; `warnings`, a bit each; and
    `reason`, why a row has no answer, else empty. Raises SceneError and DomainError for a study that cannot be, ImportError without xarray and scipy.
    """
    return answered(Study.of(scene_of(scene, overrides), vary, n=n, cases=cases, seed=seed, design=design), threads=threads, chunk=chunk, shard=shard,
                    parts=parts, progress=progress, engine=engine)


def answered(study: Study, *, threads: int | None = None, chunk: int | None = None, shard: tuple[int, int] | str | None = None,
             parts: str | os.PathLike[str] | None = None, progress: Progress | None = None, engine: Engine | None = None,
             output: Path | None = None) -> "xarray.Dataset":
    """The answers to the rows of a study, as `sweep` has them. output : the file that they are for; what it cannot hold is refused before the work."""
    import_xarray()  # before the work
    if parts is not None:
        writer_of(Path("part.nc"))
    rows = _shard(shard, study.plan.n)
    if len(rows) * study.row_bytes > MOST_BYTES:
        raise DomainError(f"{len(rows)} rows of {study.row_bytes} bytes: ask for less (ask = a few columns or scalars, times = a few), or take shards")
    if output is not None:
        check_size(output, study.sizes(len(rows)))
    for name, value in (("chunk", chunk), ("threads", threads)):
        if value is not None and integer(name, value) < 1:
            raise DomainError(f"{name} = {value}: give a number > 0")
    if threads is not None and threads > MOST_THREADS:
        raise DomainError(f"threads = {threads}: give at most {MOST_THREADS}, or none for as many as this machine has processors")
    folder = None if parts is None else Path(parts)
    if folder is not None:
        check_size(folder, study.sizes(min(chunk or 1, len(rows))), f"give a chunk of less than {chunk} rows")
        folder.mkdir(parents=True, exist_ok=True)
    made = {} if folder is None else _kept(folder, study, rows)
    gaps = list(_missing(rows, made))
    done = sum(map(len, made))

    def look(more: int) -> None:
        if progress is not None:
            progress(done + more, len(rows))

    with closing(_done_by(engine, study, gaps, threads, chunk) if engine is not None else
                 _done_here(study, gaps, threads, chunk, folder is None, look)) as ended:
        for part, dataset in ended:
            if folder is not None:
                _keep(dataset, folder, part)
            made[part], done = dataset, done + len(part)
            look(0)
    return _joined([made[part] for part in sorted(made, key=lambda part: part.start)])


def _most_rows(study: Study) -> int:
    """Of a chunk."""
    return min(MOST_CHUNK, max(1, CHUNK_BYTES // study.row_bytes))


def _done_here(study: Study, gaps: list[range], threads: int | None, chunk: int | None, at_once: bool,
               look: Callable[[int], None]) -> "Generator[tuple[range, xarray.Dataset]]":
    """Chunk after chunk, on threads of this process; look(rows) hears of the rows of the chunk at hand that are done. at_once: as large as they may be,
    else from small ones on, which grow while they take little time."""
    pool = threads or len(os.sched_getaffinity(0))
    most = _most_rows(study)
    size = chunk or (most if at_once else min(FIRST_CHUNK, most))
    for gap in gaps:
        at = gap.start
        while at < gap.stop:
            part, began = range(at, min(at + size, gap.stop)), time.monotonic()

            def seen(share: float, part: range = part) -> None:
                look(int(share * len(part)))

            made = watched(lambda monitor, part=part: study.rows(part, pool, monitor), seen)  # type: ignore[misc]
            if chunk is None and time.monotonic() - began < CHUNK_SECONDS:
                size = min(2 * size, most)
            at = part.stop
            yield part, made


def _done_by(engine: Engine, study: Study, gaps: list[range], threads: int | None, chunk: int | None) -> "Generator[tuple[range, xarray.Dataset]]":
    """The chunks as the engine comes to them; those that are not done are called off where something fails."""
    most = _most_rows(study)
    size = chunk or min(most, max(FIRST_CHUNK, sum(map(len, gaps)) // ENGINE_CHUNKS))
    chunks = [range(at, min(at + size, gap.stop)) for gap in gaps for at in range(gap.start, gap.stop, size)]
    ended: SimpleQueue[range] = SimpleQueue()
    futures = {}
    call = uuid.uuid4().hex
    try:
        for part in chunks:
            futures[part] = engine.submit(_rows_of_call, call, study, part, threads or 1)
            futures[part].add_done_callback(lambda _, part=part: ended.put(part))
        while futures:
            part = ended.get()
            yield part, futures.pop(part).result()
    finally:
        for left in futures.values():
            left.cancel()


def _rows_of_call(call: str, study: Study, rows: range, threads: int) -> "xarray.Dataset":
    """The work of an engine. call: names this run of the sweep, so that an engine that knows work by its arguments, as Dask does, does not take it
    for the same work of a run that was called off a moment ago."""
    return study.rows(rows, threads)


def _keep(dataset: "xarray.Dataset", folder: Path, rows: range) -> None:
    """Writes a part such that there is never half of one, and so that it shows where bits of it have turned."""
    with written(_part_file(folder, rows)) as beside:
        to_netcdf(dataset.assign_attrs(checksum=checksum(dataset)), beside)


def _joined(parts: "list[xarray.Dataset]") -> "xarray.Dataset":
    if len(parts) == 1:
        return parts[0]
    made: xarray.Dataset = import_xarray().concat(parts, dim="row", data_vars="minimal", coords="minimal", compat="override", join="override",
                                            combine_attrs="override")
    return made


def merge(files: "Iterable[str | os.PathLike[str] | xarray.Dataset]") -> "xarray.Dataset":
    """The parts of one study, from files (.nc, .zarr) or as they are, put together. Raises DomainError where they are of several studies,
    overlap or leave rows out."""
    if not isinstance(files, Iterable):
        raise DomainError(f"{files!r:.60}: parts are files, or what sweep returns")
    given = [files] if isinstance(files, str | os.PathLike) else list(files)
    named = [(str(file), open_results(file)) if isinstance(file, str | os.PathLike) else ("a part", file) for file in given]
    if wrong := [part for _, part in named if not isinstance(part, import_xarray().Dataset)]:
        raise DomainError(f"{wrong[0]!r:.60}: parts are files, or what sweep returns")
    if not named:
        raise DomainError("there is nothing to merge")
    if damaged := next((name for name, part in named if "study" not in part.attrs or not part.sizes.get("row")), None):
        raise DomainError(f"{damaged}: this holds no results of a sweep")
    named.sort(key=lambda item: int(item[1]["row"][0]))
    study = named[0][1].attrs["study"]
    at = 0
    for name, part in named:
        if part.attrs["study"] != study:
            raise DomainError(f"{name}: this belongs to another study than {named[0][0]}")
        first = int(part["row"][0])
        if first != at:
            raise DomainError(f"rows {at} to {first - 1} are missing" if first > at else f"{name}: row {first} is there twice")
        at = first + part.sizes["row"]
        if not _has_rows(part, range(first, at)):
            raise DomainError(f"{name}: rows are missing in it, or there twice, or out of their order: make this part again")
    if at != json.loads(study)["n"]:
        raise DomainError(f"rows {at} to {json.loads(study)['n'] - 1} are missing")
    return _joined([part for _, part in named])
