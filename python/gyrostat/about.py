# SPDX-License-Identifier: BSD-3-Clause
"""What this build holds, and under which licence it may be passed on."""

import platform
from importlib import metadata

from gyrostat._core import build_info

__all__ = ["build_table", "licence"]

OPTIONAL = ("numpy", "rich", "matplotlib", "xarray", "scipy", "heyoka")


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
