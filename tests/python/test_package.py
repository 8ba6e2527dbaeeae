# SPDX-License-Identifier: BSD-3-Clause
"""The package as it was built and installed: its build information, its stub and its types."""

import importlib.metadata
import importlib.resources
import pathlib
import shutil
import subprocess
import sys

import pytest

import gyrostat
from gyrostat import _core, elliptic

PROJECT = pathlib.Path(__file__).resolve().parents[2]
MYPY = PROJECT / ".pytest_cache" / "mypy"  # what mypy learned of numpy, for the next run, too


def test_versions_agree() -> None:
    assert gyrostat.__version__ == importlib.metadata.version("gyrostat") == gyrostat.build_info()["version"]


def test_build_information_names_every_library() -> None:
    info = gyrostat.build_info()
    assert set(info) == {"version", "compiler", "level", "eigen", "gsl", "cvode"}
    assert info["eigen"] is not None and info["eigen"].startswith("3.4")


@pytest.mark.skipif(gyrostat.build_info()["gsl"] is None, reason="no GSL")
def test_gsl_is_a_part_of_its_own() -> None:
    """The core is BSD: GSL, which is GPL, comes into the process when it is asked for, not before."""
    program = """
import gyrostat
from gyrostat import _core, elliptic
holds_gsl = lambda: "libgsl" in open("/proc/self/maps").read()
elliptic.complete(0.5)
assert not holds_gsl()
elliptic.complete(0.5, elliptic="gsl")
assert holds_gsl()
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_without_gsl_the_error_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gyrostat._gsl", None)  # cannot be imported
    assert gyrostat.build_info()["gsl"] is None
    with pytest.raises(gyrostat.DomainError, match="no GSL.*libgsl-dev"):
        elliptic.complete(0.5, elliptic="gsl")


@pytest.mark.skipif(shutil.which("nm") is None, reason="no nm")
def test_the_module_shows_its_entry_alone() -> None:
    """What else it showed could be taken for another module's, or another's for its own."""
    listed = subprocess.run(["nm", "-D", "--defined-only", str(_core.__file__)], capture_output=True, text=True, check=True).stdout
    assert [line.split()[-1] for line in listed.splitlines()] == ["PyInit__core"]


def test_stub_is_that_of_the_module() -> None:
    """The build writes the stub anew; the one in the source tree, which people read, must not lag behind."""
    built = importlib.resources.files("gyrostat").joinpath("_core.pyi").read_text()
    kept = (PROJECT / "python" / "gyrostat" / "_core.pyi").read_text()
    assert built == kept, "the bindings changed: run ./dev stub and commit python/gyrostat/_core.pyi"


def test_package_says_that_it_is_typed() -> None:
    assert importlib.resources.files("gyrostat").joinpath("py.typed").is_file()


def test_types_hold_in_a_users_program_and_wrong_ones_are_noticed(tmp_path: pathlib.Path) -> None:
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import gyrostat\n\nversion: int = gyrostat.__version__\n")
    programs = [str(pathlib.Path(__file__).with_name("typed_example.py")), str(wrong)]
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(MYPY), *programs], cwd=tmp_path, capture_output=True, text=True)
    errors = [line for line in run.stdout.splitlines() if ": error:" in line]
    assert run.returncode == 1 and len(errors) == 1, run.stdout + run.stderr
    assert errors[0].startswith("wrong.py:3: ") and "Incompatible types in assignment" in errors[0]
