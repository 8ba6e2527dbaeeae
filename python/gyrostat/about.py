# SPDX-License-Identifier: BSD-3-Clause
"""What this build holds, under which licence it may be passed on, and what its families answer."""

import platform
from collections.abc import Iterator
from importlib import metadata

from gyrostat._core import build_info
from gyrostat.facts import FACTS

__all__ = ["build_table", "family_tables", "licence"]

OPTIONAL = ("numpy", "rich", "matplotlib", "pandas", "xarray", "scipy", "heyoka")


def licence() -> str:
    """Licence of the binary: GSL brings the GPL with it."""
    if build_info()["gsl"]:
        return "GPL-3.0-or-later (BSD-3-Clause code linked with GSL; build with -DGYROSTAT_GSL=OFF for BSD-3-Clause)"
    return "BSD-3-Clause"


def build_table() -> list[list[str]]:
    """Rows of name and value: versions, build options, licence."""
    info = build_info()
    rows = [["gyrostat", str(info["version"])], ["licence of this build", licence()], ["compiler", str(info["compiler"])],
            ["Eigen", str(info["eigen"])], ["GSL", str(info["gsl"] or "not built in")],
            ["CVODE", str(info["cvode"] or "not built in")], ["Python", platform.python_version()]]
    for name in OPTIONAL:
        try:
            rows.append([name, metadata.version(name)])
        except metadata.PackageNotFoundError:
            rows.append([name, "not installed"])
    return rows


def family_tables(kind: str) -> Iterator[tuple[str, list[str], list[list[str]]]]:
    """Title, heads and rows of the columns, the scalars and the rungs of a kind of scene."""
    facts = FACTS[kind]
    columns = [[q.name, str(q.width), q.unit, q.frame, q.measure, q.meaning] for q in facts.columns.values()]
    yield f"{kind}: columns", ["name", "width", "unit", "frame", "error", "meaning"], columns
    yield f"{kind}: scalars", ["name", "width", "unit", "meaning"], [[q.name, str(q.width), q.unit, q.meaning] for q in facts.scalars.values()]
    yield f"{kind}: rungs, cheapest first", ["name", "meaning"], [[name, meaning] for name, meaning in facts.rungs.items()]
