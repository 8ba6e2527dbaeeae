# SPDX-License-Identifier: BSD-3-Clause
"""The command line: gyrostat solve | recognise | view | sweep | merge | report | chart | stability | design | reproduce | scenes | show | new | schema | info | selftest."""

import argparse
import contextlib
import dataclasses
import difflib
import io
import json
import os
import shlex
import sys
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import gyrostat
from gyrostat.asking import parse_ask
from gyrostat.completion import SHELLS, PrintCompletion
from gyrostat.console import Progress, check_output, leave, say, short, show_table, small
from gyrostat.errors import Cancelled, ConvergenceError, DomainError, Refused, SceneError
from gyrostat.families import FAMILIES
from gyrostat.overriding import parse_override
from gyrostat.scenes import Scene, bundled, load
from gyrostat.sweep_commands import Command, add_commands
from gyrostat.units import quantity
from gyrostat.watching import watched
from gyrostat.writing import write_text

if TYPE_CHECKING:
    from gyrostat._core import Monitor
    from gyrostat.answer import Answer

__all__ = ["main"]

MET: Final = 0
INTERNAL: Final = 1
REFUSED: Final = 2
NOT_MET: Final = 3
INTERRUPTED: Final = 130

# The form of an answer by the ending of the file.
ENDINGS: Final = {".json": "json", ".csv": "csv", ".nc": "netcdf", ".txt": "report", "": "report"}

LADDER: Final = """\
Each kind of scene has a ladder of models, its rungs, from the cheapest to the
full equations. They are asked in this order, but for a rung that is predicted
to cost clearly less for this scene than one before it, and the first whose own
error estimate meets the tolerance answers. A rung is passed over where its
estimate is over the tolerance, where the scene leaves its domain, where it has
no answer to the scene, or where it would have cost more; the report says which
and why. Where none meets the
tolerance the most accurate answers, with exit status 3. --set model=NAME takes
one rung, which then answers wherever it can.

With -o the ending of the file gives the form: .json, .csv, .nc (NetCDF) or
.txt (the report), unless --json, --csv or --netcdf says it.
"""

T = TypeVar("T")


def _ladder() -> str:
    """The rungs, and what an answer holds, for each kind."""
    from gyrostat.about import family_tables

    text = io.StringIO()
    for kind in FAMILIES:
        for table in family_tables(kind):
            show_table(*table, text)
    return LADDER + text.getvalue()


def _seconds(text: str) -> float:
    """A time [s], with a unit or without."""
    try:
        return quantity(text, "s")
    except Refused as error:
        raise argparse.ArgumentTypeError(f"{text}: this is no time: {error}") from None


class _CMakeFolder(argparse.Action):
    """Prints the folder that holds gyrostat-config.cmake."""

    def __call__(self, *_: Any) -> None:
        say(str(Path(gyrostat.__file__).parent / "share" / "cmake" / "gyrostat"), sys.stdout)
        sys.exit(MET)


def _add_printed(parser: argparse.ArgumentParser) -> None:
    """What is printed without a command."""
    parser.add_argument("--version", action="version", version=f"gyrostat {gyrostat.__version__}")
    parser.add_argument("--cmake-dir", action=_CMakeFolder, nargs=0, help="print the folder in which CMake finds the C++ library (gyrostat_DIR), and exit")
    parser.add_argument("--print-completion", action=PrintCompletion, choices=SHELLS, metavar="SHELL",
                        help=f"print what completes commands, options and scenes in a shell ({', '.join(SHELLS)}), and exit")


def _add_solve(command: Command, takes_scene: Callable[[argparse.ArgumentParser], None]) -> None:
    solve = command("solve", _solve, "answer a scene")
    solve.formatter_class = argparse.RawDescriptionHelpFormatter
    solve.epilog = _ladder()
    takes_scene(solve)
    form = solve.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_const", const="json", dest="form", help="print one JSON object")
    form.add_argument("--csv", action="store_const", const="csv", dest="form", help="print the columns as CSV")
    form.add_argument("--netcdf", action="store_const", const="netcdf", dest="form", help="write a NetCDF file (needs -o)")
    solve.add_argument("--ask", metavar="WHAT", help="columns and scalars wanted, with tolerances of their own where they need one: "
                       "attitude=0.1deg,stop_time; or all")
    solve.add_argument("--data-error", action="store_true", help="say what one rounding of each number of the scene changes, too: the part of the errors "
                       "that no method can take away (the scene is solved twice more for each number)")
    solve.add_argument("-o", "--output", type=Path, metavar="FILE", help="write there instead of to the standard output, in the form of the ending")
    solve.add_argument("--plot", type=Path, metavar="FILE", help="write a figure (PNG, SVG or PDF by its ending)")


def _add_recognise(command: Command, takes_scene: Callable[[argparse.ArgumentParser], None]) -> None:
    recognise = command("recognise", _recognise, "say of which families a scene is exactly an instance, and why it is none of the others")
    takes_scene(recognise)
    recognise.add_argument("--json", action="store_const", const="json", dest="form",
                           help="print one JSON object: family and reason, null where it is one")


def _add_view(command: Command, takes_scene: Callable[[argparse.ArgumentParser], None]) -> None:
    viewing = command("view", _view, "write the motion as one HTML page to look at in a browser")
    takes_scene(viewing)
    viewing.add_argument("--from", dest="begin", type=_seconds, metavar="TIME", help="begin of the window, such as 20 or 5min (default: 0)")
    viewing.add_argument("--to", dest="end", type=_seconds, metavar="TIME", help="its end (default: after some tens of turns)")
    viewing.add_argument("-o", "--output", type=Path, default=Path("view.html"), metavar="FILE", help="the page (default: view.html)")


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gyrostat", description="Attitude motion of bodies that carry rotors, by the cheapest model that meets a tolerance.",
        epilog="Exit status: 0 answered within the tolerance, 3 answered but over it, 2 bad input or refused, 1 internal failure, 130 interrupted.")
    _add_printed(parser)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:
        made = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        made.set_defaults(run=run)
        return made

    def takes_scene(made: argparse.ArgumentParser) -> None:
        made.add_argument("scene", metavar="SCENE", help="scene file (TOML), - for the standard input, or the name of a bundled scene")
        made.add_argument("--set", dest="overrides", action="append", default=[], metavar="KEY=VALUE",
                          help="change a key of the scene, such as tolerance=1e-9 or torque.drag=0 (repeatable)")

    _add_solve(command, takes_scene)
    _add_recognise(command, takes_scene)
    _add_view(command, takes_scene)
    add_commands(command, takes_scene, _scene)

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
    for name, unit, text, other in (
            ("spin-for-pointing", "RAD", "least stable spin rate for a lean of axis 3 under the torque", "1 deg"),
            ("torque-for-direction", "RAD", "greatest transverse torque for the direction of the velocity, from axis 3", "1 deg"),
            ("burn-for-displacement", "M", "longest burn for a displacement across axis 3", "20 cm"),
            ("burn-for-velocity", "M/S", "longest burn for a change of velocity", "9 km/h")):
        goal.add_argument(f"--{name}", type=partial(_amount, unit.lower()), metavar=unit, help=f"{text}; in this unit, or with another: '{other}'")
    design.add_argument("--json", action="store_const", const="json", dest="form", help="print one JSON object")
    design.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the scene with the value in it, as TOML")

    reproduce = command("reproduce", _reproduce, "draw the published figures again: as printed, corrected, and by the full motion")
    reproduce.add_argument("paper", nargs="?", metavar="PAPER", help="such as deceleration; left out: list what there is")
    reproduce.add_argument("figure", nargs="?", metavar="FIGURE", help="number of one figure; left out: all")
    reproduce.add_argument("-o", "--output", type=Path, default=Path("."), metavar="DIR", help="folder to write into (default: here)")

    command("scenes", _scenes, "list the bundled scenes")
    show = command("show", _show, "print a bundled scene as it stands, and where its file is")
    show.add_argument("name", metavar="NAME", help="as `gyrostat scenes` lists it")

    new = command("new", _new, "write a commented scene file to start from")
    new.add_argument("kind", metavar="KIND", choices=list(FAMILIES), help=", ".join(FAMILIES))
    new.add_argument("-o", "--output", type=Path, metavar="FILE", help="write there instead of to the standard output")
    new.add_argument("--force", action="store_true", help="overwrite the file")

    schema = command("schema", _schema, "print the keys of scene files: of one kind as a table, or as JSON Schema")
    schema.add_argument("kind", nargs="?", metavar="KIND", choices=list(FAMILIES), help=f"{', '.join(FAMILIES)}; left out: the JSON Schema of all")
    schema.add_argument("--json", action="store_true", help="print the JSON Schema of the kind")

    info = command("info", _info, "print versions, what is installed and its licences, or what answers hold")
    info.add_argument("--columns", nargs="?", const="all", metavar="KIND", choices=["all", *FAMILIES],
                      help="print columns, scalars and rungs with units and meanings, of one kind or of all")
    info.add_argument("--json", action="store_true", help="print one JSON object")
    command("selftest", _selftest, "check that what is installed answers right")
    return parser


def _prepare_streams() -> None:
    """Neither a stream that is closed, as by `>&-`, nor a letter that the terminal has not is a reason to fail."""
    sys.stdout = sys.stdout or Path(os.devnull).open("w", encoding="utf-8")
    sys.stderr = sys.stderr or Path(os.devnull).open("w", encoding="utf-8")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _run(argv: Sequence[str] | None) -> int:
    """Run one command and hand on all that it printed."""
    try:
        arguments = _arguments().parse_args(argv)
        if getattr(arguments, "output", None) == Path("-"):
            raise DomainError("-o -: this would be a file or folder named -; name another" +
                              (", or leave -o out for the standard output" if arguments.command in ("solve", "design", "new") else ""))
        return int(arguments.run(arguments))
    finally:
        sys.stdout.flush()


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status."""
    _prepare_streams()
    try:
        return _run(argv)
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
        leave(sys.stdout)
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


def _amount(unit: str, text: str) -> float:
    """A number on the command line, in SI units."""
    try:
        return quantity(text, unit)
    except Refused as error:
        raise argparse.ArgumentTypeError(f'"{text}": {error}') from None


def _scene(arguments: argparse.Namespace) -> Scene:
    overrides = dict(parse_override(text) for text in arguments.overrides)
    if getattr(arguments, "ask", None) is not None:
        overrides["solve.ask"] = parse_ask(arguments.ask)
    return load("/dev/stdin" if arguments.scene == "-" else arguments.scene, **overrides)


def _in_thread(work: "Callable[[Monitor], T]", title: str, share: Callable[[], float] | None = None) -> T:
    """Run `work(monitor)`, beside a progress bar where it takes long, so that Ctrl-C reaches us and cancels it; `share` is done of it, or what the monitor
    says."""
    begun = time.monotonic()
    with contextlib.ExitStack() as stack:
        bars: list[Progress] = []

        def look(progress: float) -> None:
            if not bars and time.monotonic() - begun > 0.4:
                bars.append(stack.enter_context(Progress(title)))
            for bar in bars:
                bar.update(progress if share is None else share())

        return watched(work, look)


def _form(arguments: argparse.Namespace) -> str:
    """How the answer is written: as the option says, else by the ending of the file."""
    output: Path | None = arguments.output
    if arguments.form is not None:
        if arguments.form == "netcdf" and output is None:
            raise DomainError("--netcdf writes a binary file: name it with -o FILE")
        return str(arguments.form)
    ending = "" if output is None else output.suffix.lower()
    if ending not in ENDINGS:
        known = ", ".join(filter(None, ENDINGS))
        raise DomainError(f"{output}: unknown ending {ending}; use one of {known}, or say --json, --csv or --netcdf")
    return ENDINGS[ending]


def _check_plot(arguments: argparse.Namespace) -> None:
    """A figure that cannot be written is refused before its numbers are computed."""
    if arguments.plot is not None:
        from gyrostat.drawing import check_ending

        check_output(arguments.plot)
        check_ending(arguments.plot)


def _solve(arguments: argparse.Namespace) -> int:
    from gyrostat.ladder import solve
    from gyrostat.report import report, summary

    scene, form = _scene(arguments), _form(arguments)
    check_output(arguments.output)
    _check_plot(arguments)
    try:
        answer = _in_thread(lambda monitor: solve(scene, monitor=monitor), scene.name)
    except (DomainError, ConvergenceError) as error:
        model = scene.tables["solve"].get("model", "auto")
        others = " (model = 'auto' asks the other rungs)" if str(error).startswith(f"model {model}: ") else ""
        raise type(error)(f"{error}{others}") from None
    if arguments.data_error:
        answer = _with_data_error(scene, answer)
    match form:
        case "json":
            _write(answer.to_json(), arguments.output, "\n")
        case "csv":
            _write(answer.to_csv(), arguments.output)
            if lacking := _asked_scalars(scene, answer):
                say(f"CSV has columns alone, and not what was asked for that is one number: {', '.join(lacking)}; write JSON or NetCDF (.json, .nc)", sys.stderr)
        case "netcdf":
            answer.to_netcdf(arguments.output)
        case _ if arguments.output is not None:
            write_text(arguments.output, str(answer))
        case _:
            report(answer, sys.stdout)
    if arguments.output is not None:
        say(f"wrote {arguments.output}: {summary(answer)}", sys.stderr)
    if arguments.plot is not None:
        answer.plot(arguments.plot)
        say(f"wrote {arguments.plot}", sys.stderr)
    return MET if answer.met else NOT_MET


def _asked_scalars(scene: Scene, answer: "Answer") -> list[str]:
    """Those that the scene asks for by name."""
    ask = scene.tables["solve"].get("ask") or "all"
    return [name for name in answer.scalars if name in ([ask] if isinstance(ask, str) else ask)]


def _with_data_error(scene: Scene, answer: "Answer") -> "Answer":
    from gyrostat.rounding import data_error

    done = [0.0]
    made = _in_thread(lambda monitor: data_error(scene, answer, monitor=monitor, told=done.append), f"{scene.name}, its data moved", lambda: done[-1])
    return dataclasses.replace(answer, data_error=made)


def _view(arguments: argparse.Namespace) -> int:
    from gyrostat.report import summary
    from gyrostat.view import view

    scene = _scene(arguments)
    if arguments.output.suffix.lower() not in (".html", ".htm"):
        raise DomainError(f"{arguments.output}: a view is written as .html")
    check_output(arguments.output)
    made = _in_thread(lambda monitor: view(scene, arguments.begin, arguments.end, monitor), scene.name)
    made.save(arguments.output)
    say(f"wrote {arguments.output}: {summary(made.answer)}", sys.stderr)
    for note in made.notes:
        say(note, sys.stderr)
    return MET if made.answer.met else NOT_MET


def _write(text: str, file: Path | None, end: str = "") -> None:
    """Writes text that may be long, so that it is not copied."""
    if file is not None:
        write_text(file, text, end)
        return
    sys.stdout.write(text)
    sys.stdout.write(end)


def _recognise(arguments: argparse.Namespace) -> int:
    from gyrostat.families.general.rewrite import recognised, segments_of

    scene = _scene(arguments)
    found, segments = recognised(scene), segments_of(scene)
    if arguments.form == "json":
        say(json.dumps({family: why or None for family, why in found.items()}), sys.stdout)
        return MET
    rows = [[family, "-" if why else "yes", why] for family, why in found.items()]
    show_table("Families", ["family", "an instance", "why not"], rows, sys.stdout)
    names = [family for family, why in found.items() if not why]
    if segments:
        rows = [[f"{begin:g}", f"{end:g}", ", ".join(families)] for begin, end, families in segments]
        show_table("Segments between changes", ["from [s]", "to [s]", "an instance of"], rows, sys.stdout)
    first = [*([f"rungs of {' and '.join(names)}"] if names else []), *(["rung segments"] if segments else [])]
    say(f"The {' and the '.join(first)} {'are' if names else 'is'} asked before the full equations." if first else "The full equations answer.", sys.stdout)
    return MET


def _chart(arguments: argparse.Namespace) -> int:
    from gyrostat.charts import make_chart

    scene = _scene(arguments)
    with Progress(f"chart of {scene.name}") as progress:

        def told(done: int, every: int, what: str) -> None:
            progress.update(done / every, what)

        chart = make_chart(scene, progress=told)
    files = chart.save(arguments.output)
    rows = [[p.label, p.setting, *(small(p.error.get(m.key)) for m in chart.measures), f"{p.seconds:.3g}", str(p.rhs), p.note]
            for p in chart.points]
    heads = ["method", "setting", *(m.head for m in chart.measures), "CPU seconds", "rhs", ""]
    show_table(f"{chart.name}: {chart.title}", heads, rows, sys.stdout)
    for left_out in chart.left_out:
        say(f"left out: {left_out}", sys.stdout)
    for file in files:
        say(f"wrote {file}", sys.stdout)
    return MET


def _stability(arguments: argparse.Namespace) -> int:
    from gyrostat.stability import report_stability

    _check_plot(arguments)
    return report_stability(_scene(arguments), as_json=arguments.form == "json", plot=arguments.plot)


def _design(arguments: argparse.Namespace) -> int:
    from gyrostat.design import GOALS, design_scene
    from gyrostat.toml_text import toml_text

    scene = _scene(arguments)
    check_output(arguments.output)
    goal, budget = next((name, value) for name in GOALS if (value := getattr(arguments, name.replace("-", "_"))) is not None)
    made = _in_thread(lambda monitor: design_scene(scene, goal, budget, monitor=monitor), scene.name)
    text = toml_text(made.scene.to_dict())
    if arguments.output is not None:
        write_text(arguments.output, text)
    if arguments.form == "json":
        say(json.dumps(made.to_dict(), allow_nan=False), sys.stdout)
    else:
        words = GOALS[goal]
        say(f"{scene.name}: {words.quantity} for {short(budget)} {words.budget_unit} of {words.measure}: {short(made.value)} {words.unit}", sys.stdout)
        for warning in made.warnings:
            say(f"warning, {warning}", sys.stdout)
        verdict = "confirmed" if made.confirmed else "NOT confirmed"
        rows = [[words.measure, words.budget_unit, short(budget), short(made.found), f"{(made.found - budget) / budget:+.2g}", verdict]]
        show_table(f"The scene with it, by the full motion over {short(made.span, 6)} s", ["", "unit", "asked", "found", "off by, share", ""], rows, sys.stdout)
        met = "met" if made.met else "NOT met"
        say(f"The scene as it now stands: answered by {made.model}, estimated error {small(made.error)}, tolerance {made.tolerance:g} {met}", sys.stdout)
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


def _show(arguments: argparse.Namespace) -> int:
    known = dict(bundled())
    if arguments.name not in known:
        near = difflib.get_close_matches(arguments.name, known, 1)
        raise DomainError(f"{arguments.name}: there is no bundled scene of this name; "
                          + (f"did you mean {near[0]}?" if near else "gyrostat scenes lists them"))
    sys.stdout.write(known[arguments.name].read_text(encoding="utf-8"))
    say(f"file: {known[arguments.name]}", sys.stderr)
    return MET


def _new(arguments: argparse.Namespace) -> int:
    from gyrostat.template import template

    text = template(arguments.kind)
    if arguments.output is None:
        sys.stdout.write(text)
        return MET
    try:
        with arguments.output.open("w" if arguments.force else "x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        raise DomainError(f"{arguments.output}: the file exists; name another, or overwrite it with --force") from None
    say(f"wrote {arguments.output}: next, gyrostat solve {shlex.quote(str(arguments.output))}", sys.stderr)
    return MET


def _schema(arguments: argparse.Namespace) -> int:
    from gyrostat.schema import key_tables, schema, ways

    if arguments.json or arguments.kind is None:
        say(json.dumps(schema(arguments.kind), indent=2), sys.stdout)
        return MET
    for table in key_tables(arguments.kind):
        show_table(*table, sys.stdout)
    say("", sys.stdout)
    for choices in FAMILIES[arguments.kind].alternatives:
        say(ways(choices), sys.stdout)
    return MET


def _info(arguments: argparse.Namespace) -> int:
    from gyrostat.about import build_table, family_tables
    from gyrostat.facts import FACTS

    kinds = {None: [], "all": list(FAMILIES)}.get(arguments.columns, [arguments.columns])
    if arguments.json:
        found = {kind: dataclasses.asdict(FACTS[kind]) for kind in kinds} if kinds else dict(build_table())
        say(json.dumps(found), sys.stdout)
    elif kinds:
        for kind in kinds:
            for table in family_tables(kind):
                show_table(*table, sys.stdout)
    else:
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
