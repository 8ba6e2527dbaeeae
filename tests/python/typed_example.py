# SPDX-License-Identifier: BSD-3-Clause
"""A small program of a user; mypy --strict reads it in test_package.py."""

import gyrostat


def libraries() -> list[str]:
    """Name and version of each optional library that this build holds."""
    info = gyrostat.build_info()
    return [f"{name} {info[name]}" for name in ("gsl", "cvode") if info[name] is not None]


print(gyrostat.__version__, *libraries())
