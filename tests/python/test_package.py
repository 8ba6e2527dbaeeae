# SPDX-License-Identifier: BSD-3-Clause
"""The package as it was built and installed: its build information, its stub and its types."""

import importlib.metadata
import importlib.resources
import pathlib
import subprocess
import sys

import gyrostat

PROJECT = pathlib.Path(__file__).resolve().parents[2]


def test_versions_agree() -> None:
    assert gyrostat.__version__ == importlib.metadata.version("gyrostat") == gyrostat.build_info()["version"]


def test_build_information_names_every_library() -> None:
    info = gyrostat.build_info()
    assert set(info) == {"version", "compiler", "eigen", "gsl", "cvode"}
    assert info["eigen"] is not None and info["eigen"].startswith("3.4")


def test_stub_is_that_of_the_module() -> None:
    """The build writes the stub anew; the one in the source tree, which people read, must not lag behind."""
    built = importlib.resources.files("gyrostat").joinpath("_core.pyi").read_text()
    kept = (PROJECT / "python" / "gyrostat" / "_core.pyi").read_text()
    assert built == kept, "the bindings changed: run ./dev stub and commit python/gyrostat/_core.pyi"


def test_package_says_that_it_is_typed() -> None:
    assert importlib.resources.files("gyrostat").joinpath("py.typed").is_file()


def test_types_hold_in_a_users_program(tmp_path: pathlib.Path) -> None:
    example = pathlib.Path(__file__).with_name("typed_example.py")
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(example)],
        cwd=tmp_path, capture_output=True, text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr


def test_wrong_types_are_noticed(tmp_path: pathlib.Path) -> None:
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import gyrostat\n\nversion: int = gyrostat.__version__\n")
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(wrong)],
        cwd=tmp_path, capture_output=True, text=True,
    )
    assert run.returncode == 1 and "Incompatible types in assignment" in run.stdout, run.stdout + run.stderr
