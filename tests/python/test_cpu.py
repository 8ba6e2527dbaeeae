# SPDX-License-Identifier: BSD-3-Clause
"""Which core is loaded on which processor, and the folders that C++ projects find."""

import os
import pathlib
import subprocess
import sys

import pytest

import gyrostat
from gyrostat import cpu
from gyrostat.cli import main


@pytest.fixture
def installed(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> pathlib.Path:
    """An installation of three levels on a processor that runs v3."""
    for name in ("v1", "v3", "v4"):
        (tmp_path / name).mkdir()
    monkeypatch.setattr(cpu, "HERE", tmp_path)
    monkeypatch.setattr(cpu, "highest", lambda: 3)
    monkeypatch.delenv("GYROSTAT_CPU", raising=False)
    return tmp_path


def test_the_highest_level_that_runs_is_taken(installed: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert cpu.level() == "v3"
    for processor, taken in [(1, "v1"), (2, "v1"), (4, "v4")]:
        monkeypatch.setattr(cpu, "highest", lambda processor=processor: processor)
        assert cpu.level() == taken


def test_the_environment_overrides(installed: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GYROSTAT_CPU", "v1")
    assert cpu.level() == "v1"
    monkeypatch.setenv("GYROSTAT_CPU", "v4")
    with pytest.raises(ImportError, match="v3 at most"):
        cpu.level()
    monkeypatch.setenv("GYROSTAT_CPU", "avx2")
    with pytest.raises(ImportError, match="holds v1, v3, v4"):
        cpu.level()


def test_what_was_compiled_elsewhere_says_so(installed: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (installed / "v1").rmdir()
    monkeypatch.setattr(cpu, "highest", lambda: 2)
    with pytest.raises(ImportError, match="compiled for x86-64-v3, and this processor runs v2 at most"):
        cpu.level()


def test_an_installation_of_one_core_has_no_levels(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cpu, "HERE", tmp_path)
    monkeypatch.setenv("GYROSTAT_CPU", "v4")
    assert cpu.level() is None


def test_each_level_that_runs_here_answers() -> None:
    program = "import gyrostat; print(gyrostat.build_info()['level'], gyrostat.solve('t-handle').met)"
    for name in cpu.held():
        if int(name[1:]) <= cpu.highest():
            run = subprocess.run([sys.executable, "-c", program], env={**os.environ, "GYROSTAT_CPU": name}, capture_output=True, text=True)
            assert run.stdout.split() == [f"x86-64-{name}", "True"], run.stderr


def test_the_folder_of_the_cmake_package(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["--cmake-dir"])
    assert stop.value.code == 0
    folder = pathlib.Path(capsys.readouterr().out.strip())
    assert (folder / "gyrostat-config.cmake").is_file() and (folder / "gyrostat-config-version.cmake").is_file()
    sources = folder.parents[2] / "cpp"
    assert (sources / "CMakeLists.txt").is_file() and (sources / "include" / "gyrostat" / "gyrostat.hpp").is_file()
    described = (folder.parents[1] / "pkgconfig" / "gyrostat.pc").read_text()
    assert f"Version: {gyrostat.__version__}" in described and (folder.parents[1] / "pkgconfig" / "../../cpp/include/gyrostat").is_dir()
