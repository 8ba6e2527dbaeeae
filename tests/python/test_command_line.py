# SPDX-License-Identifier: BSD-3-Clause
"""The command line: what it prints, where it writes, its exit statuses, and that it never shows a traceback."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import gyrostat
import pytest
from conftest import scene_names
from gyrostat.cli import main
from gyrostat.facts import FACTS
from gyrostat.families import FAMILIES
from gyrostat.scenes import bundled

GYROSTAT = [sys.executable, "-m", "gyrostat"]


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    status = main(list(arguments))
    out = capsys.readouterr()
    assert "Traceback" not in out.out + out.err
    return status, out.out, out.err


def test_a_folder_that_is_not_there_is_told_before_the_work(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nowhere = tmp_path / "nowhere"
    for command in (["solve", "toy-top", "-o", f"{nowhere}/a.csv"], ["solve", "toy-top", "--plot", f"{nowhere}/a.png"], ["view", "toy-top", "-o", f"{nowhere}/a.html"],
                    ["sweep", "tiangong-1", "--vary", "torque.drag=uniform(1e-6, 2e-6)", "-n", "3", "-o", f"{nowhere}/a.csv"]):
        assert main(command) == 2
        assert "there is no folder" in capsys.readouterr().err and not nowhere.exists()


def test_a_folder_in_the_place_of_the_file_is_told_before_the_work(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gyrostat.ladder.solve", lambda *_, **__: pytest.fail("solved"))
    for option, name in (("-o", "a.csv"), ("-o", "answers"), ("--plot", "a.png")):
        (tmp_path / name).mkdir()
        status, _, err = run(capsys, "solve", "toy-top", option, str(tmp_path / name))
        assert status == 2 and f"{tmp_path / name}: this is a folder; name a file" in err


@pytest.mark.parametrize(("command", "told"), [("solve t-handle", "leave -o out"), ("new free", "leave -o out"), ("view t-handle", "name another"),
                                               ("sweep t-handle --vary inertia[0]=[1e-4]", "name another"), ("reproduce heavy", "name another")])
def test_a_file_named_as_the_standard_output_is_not_made(command: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
                                                         monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, err = run(capsys, *command.split(), "-o", "-")
    assert status == 2 and out == "" and told in err and not list(tmp_path.iterdir())


def test_solve_prints_an_answer_for_people(scene_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "solve", str(scene_file))
    assert status == 0 and err == ""
    for part in ("answered by", "tolerance 1e-06 met", "What was tried", "equal-torque", "small_parameter", "angular_momentum_norm",
                 "N m s", "estimated error"):
        assert part in out


def test_solve_json_and_csv(scene_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "solve", str(scene_file), "--json")
    answer = json.loads(out)
    assert status == 0 and answer["met"] and answer["scene"]["name"] == "test" and len(answer["t"]) == 11
    status, out, _ = run(capsys, "solve", str(scene_file), "--csv")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert status == 0 and [float(row["t"]) for row in rows] == answer["t"]


def test_csv_tells_what_it_leaves_out(scene_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "solve", str(scene_file), "--csv")[2] == ""
    status, out, err = run(capsys, "solve", str(scene_file), "--csv", "--ask", "energy,stop_time")
    assert status == 0 and out.startswith("t,energy\n") and "one number: stop_time; write JSON or NetCDF" in err


def test_solve_writes_files(scene_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    report, plot = tmp_path / "answer.txt", tmp_path / "plot.png"
    status, out, err = run(capsys, "solve", str(scene_file), "-o", str(report), "--plot", str(plot))
    assert status == 0 and out == "" and err.startswith(f"wrote {report}: answered by ") and err.endswith(f" met\nwrote {plot}\n")
    assert "answered by" in report.read_text() and plot.read_bytes()[:4] == b"\x89PNG"
    pytest.importorskip("xarray")
    netcdf = tmp_path / "answer.nc"
    assert run(capsys, "solve", str(scene_file), "--netcdf", "-o", str(netcdf))[0] == 0
    assert netcdf.read_bytes()[:3] == b"CDF"
    status, _, err = run(capsys, "solve", str(scene_file), "--netcdf")
    assert status == 2 and "-o FILE" in err


def test_the_ending_of_the_file_gives_the_form(scene_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def written(name: str, *options: str) -> bytes:
        file = tmp_path / name
        status, out, err = run(capsys, "solve", str(scene_file), "-o", str(file), *options)
        assert status == 0 and out == "" and err.startswith(f"wrote {file}: answered by")
        return file.read_bytes()

    assert json.loads(written("answer.json"))["met"] and json.loads(written("ANSWER.JSON"))["met"]
    assert written("answer.csv").startswith(b"t,angular_momentum_x,") and json.loads(written("other.csv", "--json"))["met"]
    assert b"What was tried" in written("answer.txt") and b"What was tried" in written("answer")
    pytest.importorskip("xarray")
    assert written("answer.nc")[:3] == b"CDF"


def test_an_unknown_ending_is_refused_before_any_work(tmp_path: Path, capsys: pytest.CaptureFixture[str],
                                                      monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gyrostat.ladder.solve", lambda *_, **__: pytest.fail("solved"))
    status, out, err = run(capsys, "solve", "tiangong-1", "-o", str(tmp_path / "answer.xls"))
    assert status == 2 and out == "" and "unknown ending .xls; use one of .json, .csv, .nc, .txt" in err and not list(tmp_path.iterdir())


def test_the_report_shows_the_error_that_was_judged(capsys: pytest.CaptureFixture[str]) -> None:
    """The stop time of this scene is less certain than any column."""
    status, out, _ = run(capsys, "solve", "tiangong-1")
    first = re.search(r"estimated error (\S+) \(stop_time\), tolerance 0.001 met", out)
    tried = re.search(r"averaged +(\S+) +answered", out)
    stop = re.search(r"stop_time +\S+ +s +(\S+)\n", out)
    assert status == 0 and first and tried and stop and first[1] == tried[1] == stop[1]
    assert re.search(r"small_parameter +\S+ +1 +-\n", out)


def test_set_changes_keys(scene_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(capsys, "solve", str(scene_file), "--json", "--set", "torque.control=[0.1, 0.1, 0.1]", "--set", "drag=0",
                    "--set", "attitude=[0.0, 0.0, 0.6, 0.8]", "--set", "times=[0, 1]", "--set", "model=full")
    answer = json.loads(out)
    assert answer["scene"]["torque"]["control"] == [0.1, 0.1, 0.1] and answer["t"] == [0.0, 1.0]
    assert answer["columns"]["attitude"][0] == [0.0, 0.0, 0.6, 0.8]


def test_exit_status_3_over_the_tolerance(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "solve", "tiangong-1", "--set", "model=averaged", "--set", "tolerance=1e-12")
    assert status == 3 and "NOT met" in out
    status, out, err = run(capsys, "solve", "tiangong-1", "--set", "model=averaged", "--set", "tolerance=1e-12", "-o", os.devnull)
    assert status == 3 and out == "" and "NOT met" in err


@pytest.mark.parametrize(("arguments", "text"), [
    (["solve", "absent.toml"], "no such file"),
    (["solve", "tiangong1"], "did you mean"),
    (["solve", "tiangong-1", "--set", "drag"], "--set"),
    (["solve", "tiangong-1", "--set", "drag=-1"], "torque.drag"),
    (["solve", "tiangong-1", "--set", "kind=heavvy"], "unknown kind"),
    (["solve", "tiangong-1", "--set", "model=full", "--set", "control=[1e-13, 2e-13, 3e-13]", "--set", "drag=0", "--set", "times=[1e12]"],
     "10 million steps"),
    (["solve", "tiangong-1", "--ask", "atitude"], "did you mean attitude"),
    (["solve", "tiangong-1", "--set", "model=equal-torque"], "the control torques are not equal (model = 'auto' asks the other rungs)"),
    (["solve", "tiangong-1", "--plot", "x.xyz"], "unknown ending"),
    (["solve", "tiangong-1", "-o", "/no/such/folder/x"], "there is no folder /no/such/folder"),
    (["chart", "tiangong-1", "--set", "samples=1"], "solve.samples"),
    (["stability", "cubesat-wheel"], "rotor_momentum"),
    (["reproduce", "no-such-paper"], "no-such-paper"),
    (["reproduce", "deceleration", "99"], "99"),
])
def test_exit_status_2_where_the_input_is_bad(arguments: list[str], text: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = run(capsys, *arguments)
    assert status == 2 and text in err and err.startswith("gyrostat: ")


@pytest.mark.parametrize("arguments", [[], ["sove"], ["solve"], ["solve", "a", "--json", "--csv"], ["solve", "a", "--what"]])
def test_exit_status_2_for_a_bad_command(arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2


def test_exit_status_1_for_an_internal_failure(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("broken\ninside")

    monkeypatch.setattr("gyrostat.ladder.solve", broken)
    status, _, err = run(capsys, "solve", "tiangong-1")
    assert status == 1 and err == "gyrostat: internal failure: RuntimeError: broken (GYROSTAT_DEBUG=1 shows where)\n"


@pytest.mark.parametrize("name", scene_names())
def test_every_bundled_scene_is_answered(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "solve", name)
    assert status == 0, out


def test_lists(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "scenes")
    assert status == 0 and all(name in out for name, _ in bundled())
    status, out, _ = run(capsys, "schema")
    assert status == 0 and json.loads(out)["title"] == "gyrostat scene"
    status, out, _ = run(capsys, "schema", "heavy", "--json")
    assert status == 0 and json.loads(out)["properties"]["kind"]["enum"] == ["heavy"]
    status, out, _ = run(capsys, "info", "--json")
    assert status == 0 and json.loads(out)["gyrostat"] == gyrostat.__version__
    status, out, _ = run(capsys, "info")
    assert status == 0 and re.search(r"licence +BSD-3-Clause\n", out) and "gyrostat._gsl" in out
    status, out, _ = run(capsys, "reproduce")
    assert status == 0 and "deceleration" in out


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["--version"])
    assert caught.value.code == 0 and capsys.readouterr().out == f"gyrostat {gyrostat.__version__}\n"


def test_show_prints_a_bundled_scene_as_it_stands(capsys: pytest.CaptureFixture[str]) -> None:
    for name, file in bundled():
        assert run(capsys, "show", name) == (0, file.read_text(), f"file: {file}\n")
    status, out, err = run(capsys, "show", "tiangong1")
    assert status == 2 and out == "" and "did you mean tiangong-1?" in err


@pytest.mark.parametrize("kind", list(FAMILIES))
def test_help_and_info_explain_columns_scalars_and_rungs(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["solve", "--help"])
    help_text = capsys.readouterr().out
    assert "rung is passed over where" in " ".join(help_text.split())
    status, told, _ = run(capsys, "info", "--columns", kind)
    assert status == 0
    for text in (" ".join(help_text.split()), " ".join(told.split())):
        for quantity in FACTS[kind].quantities.values():
            assert f"{quantity.name} {quantity.width or 'wheels'} {quantity.unit}".strip() in text
        assert all(rung in text for rung in FACTS[kind].rungs)
    assert told in run(capsys, "info", "--columns")[1]
    found = json.loads(run(capsys, "info", "--columns", kind, "--json")[1])[kind]
    assert {name: entry["meaning"] for name, entry in found["columns"].items()} == {q.name: q.meaning for q in FACTS[kind].columns.values()}


def test_selftest(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "selftest")
    assert status == 0 and out.count("ok    ") >= 10 and "FAILED" not in out


def test_stability(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    plot = tmp_path / "regions.png"
    status, out, _ = run(capsys, "stability", "tiangong-1", "--json", "--plot", str(plot))
    assert status == 0 and set(json.loads(out)["regimes"]) == {"A", "C"} and plot.stat().st_size > 5000


def test_a_closed_pipe_is_no_failure() -> None:
    made = subprocess.run([*GYROSTAT[:1], "-c", "import sys; from gyrostat.cli import main; sys.exit(main(['schema']))"],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60)
    assert made.returncode == 0 and not made.stderr
    reader, writer = os.pipe()
    os.close(reader)
    process = subprocess.run([*GYROSTAT, "solve", "tiangong-1", "--csv"], stdout=writer, stderr=subprocess.PIPE, timeout=60)
    os.close(writer)
    assert b"Traceback" not in process.stderr and process.returncode in (0, 3)


@pytest.mark.parametrize("command", ["--print-completion bash", "--version", "scenes", "show t-handle"])
def test_a_reader_that_goes_away_is_no_failure(command: str) -> None:
    if "completion" in command:
        pytest.importorskip("shtab")
    reader, writer = os.pipe()
    os.close(reader)
    made = subprocess.run([*GYROSTAT, *command.split()], stdout=writer, stderr=subprocess.PIPE, text=True, timeout=60)
    os.close(writer)
    assert made.returncode == 0 and made.stderr in ("", f"file: {dict(bundled())['t-handle']}\n")


@pytest.mark.parametrize(("command", "status"), [("show t-handle", 0), ("new free", 0), ("solve t-handle --json", 0), ("solve t-handle --csv", 0),
                                                 ("solve nothere", 2)])
@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-"])
def test_closed_streams_are_no_failure(command: str, status: int, closed: str) -> None:
    made = subprocess.run(["sh", "-c", f'"$0" -m gyrostat {command} {closed}', sys.executable], capture_output=True, text=True, timeout=60)
    assert made.returncode == status
    assert "failure" not in made.stderr and ("2>" not in closed or "nothere" not in made.stdout)


@pytest.mark.parametrize(("command", "status"), [("solve nothere", 2), ("new free -o {}/new.toml", 0)])
def test_a_standard_error_without_a_reader_changes_no_exit_status(command: str, status: int, tmp_path: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    made = subprocess.run([*GYROSTAT, *command.format(tmp_path).split()], stdout=subprocess.PIPE, stderr=writer, timeout=60)
    os.close(writer)
    assert made.returncode == status and not made.stdout


def test_ctrl_c_stops_long_work(tmp_path: Path) -> None:
    process = subprocess.Popen(
        [*GYROSTAT, "solve", "tiangong-1", "--set", "model=full", "--set", "control=[1e-13, 2e-13, 3e-13]", "--set", "drag=0", "--set",
         "times=[3e8]"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # a job in the background may be deaf to Ctrl-C

    def at_work() -> float:
        """CPU seconds of the process: of its start it takes less than one."""
        fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    while process.poll() is None and at_work() < 2.0:
        time.sleep(0.05)
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert process.returncode == 130 and err == "gyrostat: interrupted\n"


def test_a_scene_comes_from_the_standard_input() -> None:
    shown = subprocess.run([sys.executable, "-m", "gyrostat", "show", "t-handle"], capture_output=True, check=True, text=True).stdout
    made = subprocess.run([sys.executable, "-m", "gyrostat", "solve", "-"], input=shown, capture_output=True, check=True, text=True)
    assert made.stdout.startswith("t-handle (free)")
