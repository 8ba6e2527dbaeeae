# SPDX-License-Identifier: BSD-3-Clause
"""gyrostat --print-completion: bash itself completes by what is printed."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from gyrostat.cli import main
from gyrostat.completion import SHELLS
from gyrostat.families import FAMILIES
from gyrostat.scenes import bundled

pytest.importorskip("shtab")
SCENES = [name for name, _ in bundled()]


def printed(shell: str, capsys: pytest.CaptureFixture[str]) -> str:
    with pytest.raises(SystemExit) as ended:
        main(["--print-completion", shell])
    assert ended.value.code == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("shell", SHELLS)
def test_every_shell_hears_of_all_scenes_and_kinds(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    text = printed(shell, capsys)
    assert all(word in text for word in [*SCENES, *FAMILIES, "solve", "ask"])
    if shutil.which(shell):
        options = {"tcsh": ["-f", "-c"]}.get(shell, ["-n", "-c"])
        subprocess.run([shell, *options, text], check=True, timeout=20)


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash")
@pytest.mark.parametrize("words, expected", [
    ("solve tiang", {"tiangong-1"}),
    ("stability cubesat-w", {name for name in SCENES if name.startswith("cubesat-w")}),
    ("show t-h", {"t-handle"}),
    ("show ", set(SCENES)),
    ("solve mine", {"mine.toml"}),
    ("new sp", {"spinning"}),
    ("schema ", {*FAMILIES}),
    ("recog", {"recognise"}),
    ("chart tiangong-1 --s", {"--set"}),
    ("solve tiangong-1 -o no", {"notes.txt"}),
])
def test_bash_completes(words: str, expected: set[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mine.toml").touch()
    (tmp_path / "notes.txt").touch()
    script = printed("bash", capsys) + '''
set -- gyrostat "$@"
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_shtab_gyrostat gyrostat "${!#}" "${@:$#-1:1}"
printf '%s\\n' "${COMPREPLY[@]}"
'''
    made = subprocess.run(["bash", "-c", script, "bash", *words.split(" ")], cwd=tmp_path, capture_output=True, text=True, timeout=20)
    assert made.returncode == 0, made.stderr
    assert {word.strip() for word in made.stdout.splitlines()} == expected


def test_without_shtab_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "shtab", None)  # cannot be imported
    with pytest.raises(SystemExit) as ended:
        main(["--print-completion", "bash"])
    assert ended.value.code == 2 and "pip install 'gyrostat[cli]'" in capsys.readouterr().err
