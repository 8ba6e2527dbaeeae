# SPDX-License-Identifier: BSD-3-Clause
"""Which compiled core is loaded: an installation may hold one for each of several instruction levels of x86-64."""

import os
from pathlib import Path

__all__ = ["held", "highest", "level"]

HERE = Path(__file__).parent


def held() -> list[str]:
    """The levels that this installation holds, lowest first; none where it holds one core, compiled as the compiler was told."""
    return [name for name in ("v1", "v3", "v4") if (HERE / name).is_dir()]


def highest() -> int:
    """The highest level that this processor and its operating system run."""
    from gyrostat import _cpu

    return _cpu.highest_level


def level() -> str | None:
    """The level whose core is loaded: the highest that runs here, unless GYROSTAT_CPU names one."""
    there = held()
    if not there:
        return None
    runs = [name for name in there if int(name[1:]) <= highest()]
    wanted = os.environ.get("GYROSTAT_CPU")
    if wanted and wanted not in there:
        raise ImportError(f"GYROSTAT_CPU={wanted}: this installation holds {', '.join(there)}")
    if wanted and wanted not in runs:
        raise ImportError(f"GYROSTAT_CPU={wanted}: this processor runs the instructions of x86-64-v{highest()} at most")
    if not runs:
        raise ImportError(f"this installation of gyrostat was compiled for x86-64-{there[0]}, and this processor runs v{highest()} at most: "
                          "install the wheel, or compile it here by pip install --force-reinstall --no-cache-dir")
    return wanted or runs[-1]
