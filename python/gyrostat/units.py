# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with units, such as "0.1 deg", "60 s" or "35 kg cm^2", in SI units and radians."""

import math
import re
from typing import Final

__all__ = ["UNITS_KNOWN", "Dimension", "dimension_of", "quantity"]

# Powers of metre, kilogram, second and ampere; angles are numbers.
Dimension = tuple[int, int, int, int]

_NUMBER: Final[Dimension] = (0, 0, 0, 0)
_LENGTH: Final[Dimension] = (1, 0, 0, 0)
_MASS: Final[Dimension] = (0, 1, 0, 0)
_TIME: Final[Dimension] = (0, 0, 1, 0)
_FORCE: Final[Dimension] = (1, 1, -2, 0)
_ENERGY: Final[Dimension] = (2, 1, -2, 0)

UNITS_KNOWN: Final[dict[str, tuple[float, Dimension]]] = {
    "1": (1.0, _NUMBER), "%": (0.01, _NUMBER), "ppm": (1e-6, _NUMBER),
    "rad": (1.0, _NUMBER), "mrad": (1e-3, _NUMBER), "deg": (math.pi / 180, _NUMBER), "°": (math.pi / 180, _NUMBER),
    "arcmin": (math.pi / 10800, _NUMBER), "arcsec": (math.pi / 648000, _NUMBER), "rev": (2 * math.pi, _NUMBER),
    "rpm": (math.pi / 30, (0, 0, -1, 0)), "Hz": (2 * math.pi, (0, 0, -1, 0)),
    "m": (1.0, _LENGTH), "mm": (1e-3, _LENGTH), "cm": (1e-2, _LENGTH), "km": (1e3, _LENGTH), "in": (0.0254, _LENGTH), "ft": (0.3048, _LENGTH),
    "kg": (1.0, _MASS), "g": (1e-3, _MASS), "t": (1e3, _MASS), "lb": (0.45359237, _MASS),
    "s": (1.0, _TIME), "ms": (1e-3, _TIME), "us": (1e-6, _TIME), "min": (60.0, _TIME), "h": (3600.0, _TIME), "d": (86400.0, _TIME),
    "N": (1.0, _FORCE), "mN": (1e-3, _FORCE), "uN": (1e-6, _FORCE), "kN": (1e3, _FORCE),
    "J": (1.0, _ENERGY), "mJ": (1e-3, _ENERGY), "kJ": (1e3, _ENERGY),
    "A": (1.0, (0, 0, 0, 1)), "T": (1.0, (0, 1, -2, -1)), "mT": (1e-3, (0, 1, -2, -1)), "uT": (1e-6, (0, 1, -2, -1)),
    "nT": (1e-9, (0, 1, -2, -1)),
}
# Sign before it, name, power.
_FACTOR: Final = re.compile(r"\s*([*/]?)\s*([A-Za-z%°]+|1(?![\d.]))(?:\^?(-?\d+))?")


def _unit(text: str) -> tuple[float, Dimension]:
    """Factor to SI and dimension of a unit, such as "N m s" or "deg/s^2". Raises ValueError, saying what is not known."""
    factor, powers, below = 1.0, [0, 0, 0, 0], False
    for sign, name, power in _FACTOR.findall(text):
        if name not in UNITS_KNOWN:
            raise ValueError(f"there is no unit {name}")
        below = below or sign == "/"
        exponent = int(power or 1) * (-1 if below and sign != "*" else 1)
        below = below and sign != "*"
        size, dimension = UNITS_KNOWN[name]
        factor *= size**exponent
        powers = [have + exponent * each for have, each in zip(powers, dimension, strict=True)]
    if _FACTOR.sub("", text).strip():
        raise ValueError(f'"{text.strip()}" is no unit')
    return factor, (powers[0], powers[1], powers[2], powers[3])


def dimension_of(unit: str) -> Dimension:
    """Dimension of a unit; of an empty one that of a number."""
    return _unit(unit)[1]


def quantity(text: str) -> tuple[float, Dimension | None]:
    """Value in SI units and dimension of a number with a unit; the dimension is None where there is no unit. Raises ValueError."""
    found = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*", text)
    if not found:
        raise ValueError("this does not begin with a number")
    number, unit = float(found[1]), found[2]
    if not unit:
        return number, None
    factor, dimension = _unit(unit)
    return number * factor, dimension
