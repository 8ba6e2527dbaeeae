# SPDX-License-Identifier: BSD-3-Clause
import errno
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from gyrostat.cli import main
from gyrostat.writing import write_text, written


def test_a_file_is_there_whole_or_as_it_was(tmp_path: Path) -> None:
    file = tmp_path / "a.txt"
    write_text(file, "one", "\n")
    assert file.read_bytes() == b"one\n"
    with pytest.raises(KeyboardInterrupt), written(file) as beside:
        beside.write_text("half of two")
        raise KeyboardInterrupt
    with pytest.raises(OSError, match="No space left on device: .*a.txt'") as told, written(file) as beside:
        beside.write_text("half of two")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert told.value.filename == str(file)
    assert file.read_bytes() == b"one\n" and [each.name for each in tmp_path.iterdir()] == ["a.txt"]


def test_what_is_no_plain_file_is_written_itself(tmp_path: Path) -> None:
    (tmp_path / "real.txt").write_text("old")
    (tmp_path / "link.txt").symlink_to(tmp_path / "real.txt")
    write_text(tmp_path / "link.txt", "new")
    assert (tmp_path / "link.txt").is_symlink() and (tmp_path / "real.txt").read_text() == "new"
    (tmp_path / "real.txt").chmod(0o600)
    write_text(tmp_path / "real.txt", "newer")
    assert (tmp_path / "real.txt").stat().st_mode & 0o777 == 0o600
    write_text("/dev/null", "gone")
    assert not Path("/dev/null").is_file()


def test_standard_output_that_is_a_file_keeps_what_it_holds(tmp_path: Path) -> None:
    log = tmp_path / "log.txt"
    log.write_text("before\n")
    program = "from gyrostat.writing import write_text; write_text('/dev/stdout', 'between\\n'); print('after')"
    with log.open("a") as stream:
        subprocess.run([sys.executable, "-c", program], stdout=stream, check=True)
    assert log.read_text() == "before\nbetween\nafter\n"
    piped = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, check=True, text=True)
    assert piped.stdout == "between\nafter\n"


def test_threads_that_write_one_file_leave_one_of_them_whole(tmp_path: Path) -> None:
    file = tmp_path / "a.txt"
    texts = [f"{i}" * 20000 for i in range(8)]

    def write(text: str) -> str:
        write_text(file, text)
        return file.read_text()

    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(write, texts * 5)) <= set(texts)
    assert [each.name for each in tmp_path.iterdir()] == ["a.txt"]


@pytest.mark.parametrize("command", [["solve", "tiangong-1", "-o"], ["solve", "tiangong-1", "--plot"], ["sweep", "stage-despin-study", "-n", "4", "-o"],
                                     ["merge", "a.nc", "-o"], ["design", "spinning-paper", "--spin-for-pointing", "0.01", "-o"]])
@pytest.mark.parametrize("name", [".", "/", ""])
def test_a_folder_is_no_name_of_a_file(command: list[str], name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*command, name]) == 2
    told = capsys.readouterr().err
    assert "internal" not in told and ("this is a folder; name a file" in told or "unknown ending" in told)
