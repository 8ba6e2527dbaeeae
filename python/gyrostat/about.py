# SPDX-License-Identifier: BSD-3-Clause
"""What this installation holds, under which licence it may be passed on, and what its families answer."""

import platform
from collections.abc import Iterator
from importlib import metadata

from gyrostat import cpu
from gyrostat._core import build_info
from gyrostat.facts import FACTS

__all__ = ["build_table", "family_tables"]

OPTIONAL = ("numpy", "rich", "matplotlib", "pandas", "xarray", "scipy", "heyoka")


def _instructions() -> str:
    """The instruction level of the core that is loaded, and those that this installation holds."""
    loaded = str(build_info()["level"] or platform.machine())
    held = cpu.held()
    return f"{loaded}, of {', '.join(held)} in this installation; this processor runs v{cpu.highest()}; GYROSTAT_CPU chooses" if held else loaded


def build_table() -> list[list[str]]:
    """Rows of name and value: versions, what is built in, and the licences."""
    info = build_info()
    cvode = f"{info['cvode']}, of SUNDIALS, which is under BSD-3-Clause" if info["cvode"] else "not built in"
    gsl = f"{info['gsl']}, in the extension gyrostat._gsl, which is under GPL-3.0-or-later" if info["gsl"] else "not installed (extension gyrostat._gsl)"
    rows = [["gyrostat", str(info["version"])], ["licence", "BSD-3-Clause"], ["compiler", str(info["compiler"])], ["instructions", _instructions()],
            ["Eigen", f"{info['eigen']}, which is under MPL-2.0"], ["CVODE", cvode], ["GSL", gsl], ["Python", platform.python_version()]]
    for name in OPTIONAL:
        try:
            rows.append([name, metadata.version(name)])
        except metadata.PackageNotFoundError:
            rows.append([name, "not installed"])
    return rows


def family_tables(kind: str) -> Iterator[tuple[str, list[str], list[list[str]]]]:
    """Title, heads and rows of the columns, the scalars and the rungs of a kind of scene."""
    facts = FACTS[kind]
    columns = [[q.name, str(q.width or "wheels"), q.unit, q.frame, q.measure, q.meaning] for q in facts.columns.values()]
    yield f"{kind}: columns", ["name", "width", "unit", "frame", "error", "meaning"], columns
    yield f"{kind}: scalars", ["name", "width", "unit", "meaning"], [[q.name, str(q.width or "wheels"), q.unit, q.meaning] for q in facts.scalars.values()]
    yield f"{kind}: rungs, cheapest first", ["name", "meaning"], [[name, meaning] for name, meaning in facts.rungs.items()]
