# SPDX-License-Identifier: BSD-3-Clause
"""Attitude motion of bodies that carry rotors, by the cheapest model that meets a tolerance."""

from gyrostat._core import build_info

__version__: str = build_info()["version"]

__all__ = ["__version__", "build_info"]
