# SPDX-License-Identifier: BSD-3-Clause
"""The commands gyrostat sweep, gyrostat merge and gyrostat report."""

import argparse
import json
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from gyrostat.console import Progress, check_output, say, show_table
from gyrostat.errors import DomainError
from gyrostat.scenes import Scene
from gyrostat.sweep_files import import_xarray, open_results, save, writer_of
from gyrostat.sweep_report import dependences, in_words, save_figures, shares, tables
from gyrostat.sweeps import Study, answered, merge

if TYPE_CHECKING:
    import xarray

__all__ = ["Command", "add_commands"]

MET: Final = 0
NOT_MET: Final = 3

WORDS: Final = """\
KEY is a key of the scene file; components are counted from 0: torque.control[0],
body.inertia[0,1], wheel[2].rate. HOW is one of
  normal(MEAN, DEVIATION)      the deviation may be a share of the mean: 5%
  uniform(LOW, HIGH)
  lognormal(MEDIAN, DEVIATION) the deviation is that of the logarithm: 20%
  choice(A, B, ...)            one of them at random
  [A, B, ...]                  a grid: all of them, each with all of every other
  LOW:HIGH:COUNT[log]          a grid of even steps, or of even factors
Numbers may have units: normal(3 deg/s, 5%). What the table [vary] of the scene
says is taken, too. Rows that are done are kept in FILE.parts until FILE is
written: after an interruption --resume goes on from there.
"""


Command = Callable[[str, Callable[[argparse.Namespace], int], str], argparse.ArgumentParser]


def add_commands(command: Command, takes_scene: Callable[[argparse.ArgumentParser], None], scene_of: Callable[[argparse.Namespace], Scene]) -> None:
    """The three commands and their arguments; `scene_of` reads the scene that they name."""
    sweeping = command("sweep", lambda arguments: _sweep(arguments, scene_of(arguments)),
                       "answer a scene many times over, with numbers that vary from row to row")
    takes_scene(sweeping)
    _add_arguments(sweeping)
    merging = command("merge", _merge, "put the shards of one sweep together")
    merging.add_argument("files", nargs="+", type=Path, metavar="FILE", help="results of shards: .nc or .zarr, in any order")
    merging.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="results of all: .nc, .csv, .parquet or .zarr")
    reporting = command("report", _report, "say what the results of a sweep are: percentiles, rungs, rank correlations, failures, and figures")
    reporting.add_argument("file", type=Path, metavar="FILE", help="results: .nc or .zarr")
    reporting.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder for the figures: histograms, bands, tornado, scatter (PNG)")


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = WORDS
    parser.add_argument("--vary", action="append", default=[], metavar="KEY=HOW", help="a number that varies (repeatable)")
    parser.add_argument("--cases", type=Path, metavar="FILE", help="CSV with keys in the first line and a case in every other")
    parser.add_argument("-n", type=int, metavar="N", help="rows; left out: as many as the grid and the cases have")
    parser.add_argument("--ask", metavar="WHAT", help="columns and scalars wanted, as for solve: stop_time,angular_momentum_norm")
    parser.add_argument("--seed", type=int, metavar="INTEGER", help="of the random numbers (default: 0)")
    parser.add_argument("--design", metavar="NAME", help="random (default), sobol, latin-hypercube or saltelli, which report makes Sobol indices of")
    parser.add_argument("--threads", type=int, metavar="N", help="default: all of this machine")
    parser.add_argument("--chunk", type=int, metavar="ROWS", help="rows that are done, and kept, in one go")
    parser.add_argument("--shard", metavar="I/M", help="part I of M alone, from 1; gyrostat merge puts the parts together")
    parser.add_argument("--resume", action="store_true", help="go on with what an interrupted run has left")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="results: .nc, .csv, .parquet or .zarr")


def _varied(texts: list[str]) -> dict[str, str]:
    found = {}
    for text in texts:
        key, equals, how = text.partition("=")
        if not equals or not key.strip() or not how.strip():
            raise DomainError(f"--vary {text}: write KEY=HOW, such as torque.drag=normal(1e-6, 10%)")
        if key.strip() in found:
            raise DomainError(f"--vary {text}: {key.strip()} is there twice")
        found[key.strip()] = how.strip()
    return found


def _verdict(dataset: "xarray.Dataset") -> Iterator[str]:
    """Which rungs answered, and how well, in a few parts of a sentence."""
    rows = dataset.sizes["row"]
    yield f"{rows} rows"
    yield f"{100 * float(dataset['met'].mean()):.4g} % within the tolerance"
    yield from (f"{name or 'no answer'} {100 * share:.4g} %" for name, share in shares(dataset["model"]).items())


def _sweep(arguments: argparse.Namespace, scene: Scene) -> int:
    output: Path = arguments.output
    check_output(output)
    writer_of(output)
    own = scene.vary.get("cases")
    cases = arguments.cases if arguments.cases is not None or not isinstance(own, str) else (scene.path.parent if scene.path else Path()) / own
    if cases is not None and output.resolve() == cases.resolve():
        raise DomainError(f"{output}: the results would replace the table of cases")
    parts = output.with_name(output.name + ".parts")
    if parts.exists() and not arguments.resume and not (parts.is_dir() and not any(parts.iterdir())):
        raise DomainError(f"{parts}: here is what an earlier run has left: go on from it with --resume, or remove it")
    study = Study.of(scene, _varied(arguments.vary), n=arguments.n, cases=arguments.cases, seed=arguments.seed, design=arguments.design)
    import_xarray()  # which takes seconds the first time: no part of the work
    began = time.monotonic()
    with Progress(scene.name) as progress:

        def told(done: int, rows: int) -> None:
            progress.update(done / rows, f"{done} of {rows} rows")

        dataset = answered(study, threads=arguments.threads, chunk=arguments.chunk, shard=arguments.shard, parts=parts, progress=told, output=output)
    took = time.monotonic() - began
    save(dataset, output)
    _clear(parts)
    say(f"wrote {output}: {', '.join(_verdict(dataset))}; {took:.3g} s", sys.stderr)
    for reason, share in shares(dataset["reason"]).items():
        if reason:
            example = in_words(dataset, reason)
            say(f"no answer to {100 * share:.4g} % of the rows: {reason}" + (f" ({example})" if example else ""), sys.stderr)
    return MET if bool(dataset["met"].all()) else NOT_MET


def _clear(parts: Path) -> None:
    """Removes the parts of a study, and their folder if nothing else is in it."""
    for part in (*parts.glob("rows-*-*.nc"), *parts.glob(".rows-*-*.nc")):  # also what was half written
        part.unlink(missing_ok=True)
    with suppress(OSError):
        parts.rmdir()


def _merge(arguments: argparse.Namespace) -> int:
    check_output(arguments.output)
    writer_of(arguments.output)
    if any(arguments.output.resolve() == Path(file).resolve() for file in arguments.files):
        raise DomainError(f"{arguments.output}: the whole would replace one of its parts; name another file")
    dataset = merge(arguments.files)
    save(dataset, arguments.output)
    say(f"wrote {arguments.output}: {', '.join(_verdict(dataset))}", sys.stderr)
    return MET if bool(dataset["met"].all()) else NOT_MET


def _report(arguments: argparse.Namespace) -> int:
    dataset = open_results(arguments.file)
    rows, whole = dataset["row"].values, json.loads(dataset.attrs["study"])["n"]
    part = "" if len(rows) == whole else f", a part: rows {rows[0]} to {rows[-1]} of {whole}"
    say(f"{dataset.attrs['title']} ({dataset.attrs['kind']}){part}", sys.stdout)
    for key, values in dataset.data_vars.items():
        if values.attrs.get("role") == "parameter":
            say(f"{key}: {values.attrs['varied']}", sys.stdout)
    depends = dependences(dataset)
    for table in tables(dataset, depends):
        show_table(*table, sys.stdout)
    if arguments.output is not None:
        files = list(save_figures(dataset, arguments.output, depends))
        for file in files:
            say(f"wrote {file}", sys.stdout)
        if not files:
            say("nothing to draw: no number that was asked for varies from row to row", sys.stdout)
    return MET
