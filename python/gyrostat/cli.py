# SPDX-License-Identifier: BSD-3-Clause
"""The command line: gyrostat solve | chart | stability | design | reproduce | scenes | schema | info | selftest."""

import argparse
import json
import math
import os
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

from gyrostat.console import Progress, say, show_table
from gyrostat.errors import Cancelled, ConvergenceError, DomainError, SceneError
from gyrostat.scenes import Scene, bundled, load, parse_override

if TYPE_CHECKING:
    from gyrostat.answer import Answer

__all__ = ["main"]

MET: Final = 0
INTERNAL: Final = 1
REFUSED: Final = 2
NOT_MET: Final = 3
INTERRUPTED: Final = 130

T = TypeVar("T")


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gyrostat", description="Attitude motion of bodies that carry rotors, by the cheapest model that meets a tolerance.",
        epilog="Exit status: 0 answered within the tolerance, 3 answered but over it, 2 bad input or refused, "
               "1 internal failure, 130 interrupted.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:
        made = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        made.set_defaults(run=run)
        return made

    def takes_scene(made: argparse.ArgumentParser) -> None:
        made.add_argument("scene", metavar="SCENE", help="scene file (TOML), or the name of a bundled scene")
        made.add_argument("--set", dest="overrides", action="append", default=[], metavar="KEY=VALUE",
                          help="change a key of the scene, such as tolerance=1e-9 or torque.drag=0 (repeatable)")

    solve = command("solve", _solve, "answer a scene")
    takes_scene(solve)
    form = solve.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_const", const="json", dest="form", help="print one JSON object")
    form.add_argument("--csv", action="store_const", const="csv", dest="form", help="print the columns as CSV")
    form.add_argument("--netcdf", action="store_const", const="netcdf", dest="form", help="write a NetCDF file (needs -o)")
    solve.add_argument("-o", "--output", type=Path, metavar="FILE", help="write there instead of to the standard output")
    solve.add_argument("--plot", type=Path, metavar="FILE", help="write a figure (PNG, SVG or PDF by its ending)")

    chart = command("chart", _chart, "chart error against cost of every rung and integrator: PNG, SVG and CSV")
    takes_scene(chart)
    chart.add_argument("-o", "--output", type=Path, default=Path("."), metavar="DIR", help="folder to write into (default: here)")

    stability = command("stability", _stability, "list the steady motions of a scene, their stability, and where it goes")
    takes_scene(stability)
    stability.add_argument("--json", action="store_const", const="json", dest="form", help="print one JSON object")
    stability.add_argument("--plot", type=Path, metavar="FILE", help="write a figure (PNG, SVG or PDF)")

    design = command("design", _design, "find the spin, torque or burn of a thrusting spinner that keeps within a budget")
    takes_scene(design)
    goal = design.add_mutually_exclusive_group(required=True)
    for name, unit, text in (
            ("spin-for-pointing", "RAD", "least stable spin rate for a mean pointing error"),
            ("torque-for-direction", "RAD", "greatest transverse torque for the direction of the velocity, from axis 3"),
            ("burn-for-displacement", "M", "longest burn for a displacement across axis 3"),
            ("burn-for-velocity", "M/S", "longest burn for a change of velocity")):
        goal.add_argument(f"--{name}", type=float, metavar=unit, help=text)
    design.add_argument("--json", action="store_const", const="json", dest="form", help="print one JSON object")
    design.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the scene with the value in it, as TOML")

    reproduce = command("reproduce", _reproduce, "draw the published figures again: as printed, right, and the full motion")
    reproduce.add_argument("paper", nargs="?", metavar="PAPER", help="such as deceleration; left out: list what there is")
    reproduce.add_argument("figure", nargs="?", metavar="FIGURE", help="number of one figure; left out: all")
    reproduce.add_argument("-o", "--output", type=Path, default=Path("."), metavar="DIR", help="folder to write into (default: here)")

    command("scenes", _scenes, "list the bundled scenes")
    command("schema", _schema, "print the JSON Schema of scene files")
    command("info", _info, "print versions, build options and the licence of this build")
    command("selftest", _selftest, "check that what is installed answers right")
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status."""
    arguments = _arguments().parse_args(argv)
    try:
        return int(arguments.run(arguments))
    except (SceneError, DomainError, ConvergenceError) as error:
        say(f"gyrostat: {error}", sys.stderr)
        return REFUSED
    except ImportError as error:
        if "not installed" not in str(error):
            raise
        say(f"gyrostat: {error}", sys.stderr)
        return REFUSED
    except (KeyboardInterrupt, Cancelled):
        say("gyrostat: interrupted", sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        # The reader went away, as `| head` does: close quietly.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return MET
    except OSError as error:
        say(f"gyrostat: {error.filename or 'output'}: {error.strerror or error}", sys.stderr)
        return REFUSED
    except Exception as error:
        if os.environ.get("GYROSTAT_DEBUG"):
            raise
        text = (str(error).splitlines() or [""])[0][:300]
        say(f"gyrostat: internal failure: {type(error).__name__}: {text} (GYROSTAT_DEBUG=1 shows where)", sys.stderr)
        return INTERNAL


def _scene(arguments: argparse.Namespace) -> Scene:
    return load(arguments.scene, **dict(parse_override(text) for text in arguments.overrides))


def _in_thread(work: Callable[[Any], T], title: str) -> T:
    """Run `work(monitor)` beside a progress bar, so that Ctrl-C reaches us and cancels it."""
    from gyrostat._core import Monitor

    monitor = Monitor()
    done = threading.Event()  # Thread.join, once interrupted, takes a running thread for a finished one
    result: list[T] = []
    failure: list[BaseException] = []

    def run() -> None:
        try:
            result.append(work(monitor))
        except BaseException as error:
            failure.append(error)
        finally:
            done.set()

    threading.Thread(target=run, daemon=True).start()
    try:
        if not done.wait(0.4):
            with Progress(title) as progress:
                while not done.wait(0.1):
                    progress.update(monitor.progress)
    except KeyboardInterrupt:
        monitor.cancel()
        done.wait(10)
        raise
    if failure:
        raise failure[0]
    return result[0]


def _solve(arguments: argparse.Namespace) -> int:
    from gyrostat.ladder import solve

    scene = _scene(arguments)
    if arguments.form == "netcdf" and arguments.output is None:
        raise DomainError("--netcdf writes a binary file: name it with -o FILE")
    answer = _in_thread(lambda monitor: solve(scene, monitor=monitor), scene.name)
    match arguments.form:
        case "json":
            _write(answer.to_json() + "\n", arguments.output)
        case "csv":
            _write(answer.to_csv(), arguments.output)
        case "netcdf":
            answer.to_netcdf(arguments.output)
        case _ if arguments.output is not None:
            with arguments.output.open("w") as stream:
                _report(answer, stream)
        case _:
            _report(answer, sys.stdout)
    if arguments.plot is not None:
        answer.plot(arguments.plot)
    return MET if answer.met else NOT_MET


def _write(text: str, file: Path | None) -> None:
    if file is None:
        sys.stdout.write(text)
    else:
        file.write_text(text)


def _short(value: Any, digits: int = 9) -> str:
    """A number or vector for reading."""
    if value is None:
        return "-"
    if hasattr(value, "__len__"):
        return "(" + ", ".join(_short(float(v), 6) for v in value) + ")"
    if math.isnan(value):
        return "-"
    return "infinite" if math.isinf(value) else f"{value:.{digits}g}"


def _word(scalar: str, value: Any) -> str:
    """What a scalar without a number means; empty where it has one."""
    if scalar == "stop_time" and value == math.inf:
        return "never"
    if scalar == "stable" and value is not None:
        return "yes" if value else "no"
    return "not certified" if scalar == "attractor" and value is None else ""


def _small(error: float | None) -> str:
    return "-" if error is None or math.isnan(error) else f"{error:.2g}"


def _report(answer: "Answer", out: Any) -> None:
    """The answer for reading."""
    from gyrostat.answer import UNITS

    name = answer.scene.get("name", "")
    met = "met" if answer.met else "NOT met"
    say(f"{name} ({answer.scene['kind']})", out)
    say(f"answered by {answer.model}: estimated error {_small(answer.greatest_error)}, tolerance {answer.tolerance:g} {met}", out)
    for warning in answer.warnings:
        say(f"warning, {warning.code}: {warning.message}", out)
    rows = [[a.model, _small(a.error), "answered" if a.accepted else "passed over", a.why or ""] for a in answer.tried]
    show_table("What was tried", ["rung", "estimated error", "", "why"], rows, out)
    show_table("Scalars", ["name", "value", "unit"],
               [[key, _word(key, value) or _short(value), UNITS.get(key, "")] for key, value in answer.scalars.items()], out)
    rows = []
    for column, values in answer.columns.items():
        first, last = values[0], values[-1]
        shown = [str(first), str(last)] if values.dtype.kind in "UO" else [_short(first), _short(last)]
        rows.append([column, UNITS.get(column, ""), *shown, _small(answer.error.get(column))])
    show_table(f"Columns, {len(answer.t)} times", ["name", "unit", f"t = {answer.t[0]:g} s", f"t = {answer.t[-1]:g} s", "estimated error"], rows, out)
    counts = ", ".join(f"{value} {key}" for key, value in answer.counts.items())
    say(f"{answer.seconds:.3g} s; {counts}", out)


def _chart(arguments: argparse.Namespace) -> int:
    from gyrostat.charts import make_chart

    scene = _scene(arguments)
    with Progress(f"chart of {scene.name}") as progress:

        def told(done: int, every: int, what: str) -> None:
            progress.update(done / every, what)

        chart = make_chart(scene, progress=told)
    files = chart.save(arguments.output)
    rows = [[p.label, p.setting, *(_small(p.error.get(m.key)) for m in chart.measures), f"{p.seconds:.3g}", str(p.rhs), p.note]
            for p in chart.points]
    show_table(f"{chart.name}: {chart.title}", ["method", "setting", *(m.head for m in chart.measures), "seconds", "rhs", ""], rows, sys.stdout)
    for file in files:
        say(f"wrote {file}", sys.stdout)
    return MET


def _stability(arguments: argparse.Namespace) -> int:
    from gyrostat.stability import report_stability

    return report_stability(_scene(arguments), as_json=arguments.form == "json", plot=arguments.plot)


def _design(arguments: argparse.Namespace) -> int:
    from gyrostat.design import GOALS, design_scene
    from gyrostat.toml_text import toml_text

    scene = _scene(arguments)
    goal, budget = next((name, value) for name in GOALS if (value := getattr(arguments, name.replace("-", "_"))) is not None)
    made = _in_thread(lambda monitor: design_scene(scene, goal, budget, monitor=monitor), scene.name)
    text = toml_text(made.scene.to_dict())
    if arguments.output is not None:
        arguments.output.write_text(text)
    if arguments.form == "json":
        say(json.dumps(made.to_dict(), allow_nan=False), sys.stdout)
    else:
        words = GOALS[goal]
        say(f"{scene.name}: {words.quantity} for {_short(budget)} {words.budget_unit} of {words.measure}: {_short(made.value)} {words.unit}", sys.stdout)
        for warning in made.warnings:
            say(f"warning, {warning}", sys.stdout)
        verdict = "confirmed" if made.confirmed else "NOT confirmed"
        rows = [[words.measure, words.budget_unit, _short(budget), _short(made.found), f"{(made.found - budget) / budget:+.2g}", verdict]]
        show_table(f"The scene with it, by the full motion over {_short(made.span, 6)} s", ["", "unit", "asked", "found", "off by", ""], rows, sys.stdout)
        met = "met" if made.met else "NOT met"
        say(f"answered by {made.model}: estimated error {_small(made.error)}, tolerance {made.tolerance:g} {met}", sys.stdout)
        say(f"wrote {arguments.output}" if arguments.output is not None else f"\n{text}", sys.stdout)
    return MET if made.confirmed and made.met else NOT_MET


def _reproduce(arguments: argparse.Namespace) -> int:
    from gyrostat.gallery import figures, papers, reproduce

    if arguments.paper is None:
        rows = [[paper, ", ".join(figures(paper))] for paper in papers()]
        show_table("Papers", ["paper", "figures"], rows, sys.stdout)
        return MET
    with Progress(f"figures of {arguments.paper}") as progress:
        for file in reproduce(arguments.paper, arguments.figure, arguments.output, progress.update):
            say(f"wrote {file}", sys.stdout)
    return MET


def _scenes(_: argparse.Namespace) -> int:
    rows = []
    for name, file in bundled():
        scene = load(file)
        rows.append([name, scene.kind, " ".join(scene.source.split())])
    if not rows:
        raise DomainError("no bundled scenes were found: the package was installed without its scenes")
    show_table("Bundled scenes", ["name", "kind", "source"], rows, sys.stdout)
    return MET


def _schema(_: argparse.Namespace) -> int:
    from gyrostat.schema import schema

    print(json.dumps(schema(), indent=2))
    return MET


def _info(_: argparse.Namespace) -> int:
    from gyrostat.about import build_table

    show_table("", ["", ""], build_table(), sys.stdout)
    return MET


def _selftest(_: argparse.Namespace) -> int:
    from gyrostat.selftest import checks

    failed = 0
    for label, run in checks():
        try:
            text = run()
            ok = not text.startswith("FAILED")
        except Exception as error:
            ok, text = False, f"{type(error).__name__}: {error}"
        failed += not ok
        say(f"{'ok    ' if ok else 'FAILED'} {label}: {text.removeprefix('FAILED ')}", sys.stdout)
    return INTERNAL if failed else MET


if __name__ == "__main__":
    sys.exit(main())
