# SPDX-License-Identifier: BSD-3-Clause
"""The Python examples run and print the number that is known of each; every example is there in both languages and on its page."""

import runpy
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
from examples import EXPECTED, misprinted, wrong  # noqa: E402


@pytest.mark.parametrize("name", EXPECTED)
def test_it_prints_what_is_known(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(ROOT / "examples" / f"{name}.py"), run_name="__main__")
    assert misprinted(name, capsys.readouterr().out) is None


def test_a_wrong_number_is_noticed() -> None:
    echo = [sys.executable, "-c", "import sys; print(sys.argv[1]); sys.exit(int(sys.argv[2]))"]
    assert wrong("07_your_question", [*echo, "greatest error 0.25 of it", "0"]) is None
    assert "expected 0.5" in wrong("07_your_question", [*echo, "greatest error 1.25 of it", "0"])
    assert "exit status 3" in wrong("07_your_question", [*echo, "greatest error 0.25 of it", "3"])
    assert "are not there" in wrong("07_your_question", [*echo, "greatest", "0"])


def test_every_example_has_both_languages_a_test_and_a_line() -> None:
    page, build = (ROOT / "docs" / "examples.md").read_text(), (ROOT / "examples" / "CMakeLists.txt").read_text()
    assert {file.stem for suffix in ("cpp", "py") for file in (ROOT / "examples").glob(f"*.{suffix}")} == set(EXPECTED)
    for name in EXPECTED:
        assert all((ROOT / "examples" / f"{name}.{suffix}").is_file() and f"(../examples/{name}.{suffix})" in page for suffix in ("cpp", "py"))
        assert f"gyrostat_example({name})" in build
