#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""wheel_modules.py WHEEL: what each module in a wheel is: its size, the symbols that it shows, the newest glibc that it asks for.

Exit status 1 where one shows more than its entry, or asks for more than the wheel's tag says. Needs Python 3.9 and binutils.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile


def ran(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout


def shown(module):
    return [line.split()[-1] for line in ran("nm", "-D", "--defined-only", module).splitlines()]


def newest_glibc(module):
    asked = re.findall(r"\(GLIBC_([\d.]+)\)", ran("objdump", "-T", module))
    return max((tuple(map(int, each.split("."))) for each in asked), default=())


def main():
    wheel = pathlib.Path(sys.argv[1])
    allowed = tuple(map(int, re.search(r"manylinux_(\d+)_(\d+)", wheel.name).groups()))
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.2f} MB")
    sound = True
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel) as archive:
        for member in archive.infolist():
            if not re.search(r"\.so(\.|$)", member.filename):
                continue
            module = archive.extract(member, folder)
            names, glibc = shown(module), newest_glibc(module)
            ours = member.filename.startswith("gyrostat/")
            entry = ["PyInit_" + pathlib.Path(module).name.split(".")[0]]
            wrong = (ours and names != entry) or glibc > allowed
            sound = sound and not wrong
            told = " ".join(names) if ours else f"{len(names)} symbols"
            print(f"{member.file_size / 1e6:7.2f} MB ({member.compress_size / 1e6:.2f} MB packed), glibc {'.'.join(map(str, glibc)) or 'any'}, "
                  f"{told}: {member.filename}{'  WRONG' if wrong else ''}")
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
