# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with units, such as "0.1 deg", "90 min" or "35 kg cm^2", in SI units and radians.

A unit is a product of names, each with an integer power (m^2, m2, m²), joined by blanks, *, . or ·; all that stands behind its one / is divided.
Numbers are taken as the decimals that they are written as: what comes back is the double next to the exact value.
"""

import difflib
import math
import re
from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from typing import Final

from gyrostat.errors import Refused

__all__ = ["PATTERN", "QUANTITIES", "SHARE_PATTERN", "UNIT_PATTERN", "UNITS", "quantity", "spelled", "split", "to_si"]

# Powers of metre, kilogram, second, ampere and radian.
Dimension = tuple[int, int, int, int, int]

_PI: Final = Fraction("3.14159265358979323846264338327950288419716939937510582")
_POUND: Final = Fraction("0.45359237")
_GRAVITY: Final = Fraction("9.80665")

_SIZES: Final[tuple[tuple[str, Dimension, dict[str, int | str | Fraction]], ...]] = (
    ("length", (1, 0, 0, 0, 0), {"m": 1, "km": 1000, "cm": "0.01", "mm": "0.001", "um": "1e-6", "in": "0.0254", "ft": "0.3048",
                                 "mi": "1609.344", "nmi": 1852, "au": 149597870700}),
    ("mass", (0, 1, 0, 0, 0), {"kg": 1, "g": "0.001", "t": 1000, "mg": "1e-6", "lb": _POUND, "oz": _POUND / 16,
                               "slug": _POUND * _GRAVITY / Fraction("0.3048")}),
    ("time", (0, 0, 1, 0, 0), {"s": 1, "ms": "0.001", "us": "1e-6", "min": 60, "h": 3600, "d": 86400, "yr": 31557600}),
    ("angle", (0, 0, 0, 0, 1), {"rad": 1, "mrad": "0.001", "urad": "1e-6", "deg": _PI / 180, "°": _PI / 180, "arcmin": _PI / 10800,
                                "arcsec": _PI / 648000, "rev": 2 * _PI}),
    ("rate of turn", (0, 0, -1, 0, 1), {"rpm": _PI / 30}),
    ("force", (1, 1, -2, 0, 0), {"N": 1, "mN": "0.001", "uN": "1e-6", "kN": 1000, "lbf": _POUND * _GRAVITY, "ozf": _POUND * _GRAVITY / 16,
                                 "kgf": _GRAVITY}),
    ("energy", (2, 1, -2, 0, 0), {"J": 1, "mJ": "0.001", "kJ": 1000}),
    ("power", (2, 1, -3, 0, 0), {"W": 1}),
    ("magnetic flux density", (0, 1, -2, -1, 0), {"T": 1, "mT": "0.001", "uT": "1e-6", "nT": "1e-9", "G": "1e-4"}),
    ("current", (0, 0, 0, 1, 0), {"A": 1, "mA": "0.001"}),
    ("charge", (0, 0, 1, 1, 0), {"C": 1}),
    ("voltage", (2, 1, -3, -1, 0), {"V": 1}),
    ("conductance", (-2, -1, 3, 2, 0), {"S": 1}),
)
# By what they measure: the dimension, and the size of each unit in SI units.
QUANTITIES: Final = {what: (dimension, {name: Fraction(str(size)) for name, size in sizes.items()}) for what, dimension, sizes in _SIZES}
UNITS: Final[dict[str, tuple[Fraction, Dimension]]] = {
    name: (size, dimension) for dimension, sizes in QUANTITIES.values() for name, size in sizes.items()}
# Units by the words for them.
_WORDS: Final = {word: name for name, words in {
    "s": "sec second", "min": "minute", "h": "hr hour", "d": "day", "yr": "year", "deg": "degree", "rad": "radian", "rev": "revolution turn", "m": "meter metre",
    "km": "kilometer kilometre", "in": "inch inche", "ft": "foot feet", "mi": "mile", "kg": "kilogram", "g": "gram", "N": "newton", "J": "joule", "W": "watt",
    "T": "tesla", "G": "gauss", "A": "amp ampere", "C": "coulomb", "V": "volt", "S": "siemen siemens"}.items() for word in words.split()}
# They stand alone.
_SHARES: Final = {"%": Fraction(1, 100), "ppm": Fraction(1, 1_000_000)}
_PREFIXES: Final = "pnuµμmcdhkMGT"  # a unit without one of them is another, by a power of ten
# What is weighed and what pulls, by the same name but for an f.
_FORCES: Final = {"lb": "lbf", "oz": "ozf", "kg": "kgf"}

# A number, a unit and both as regular expressions, which JavaScript reads, too.
_NUMBER: Final = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?"
_POWER: Final = r"(?:\^?[-+]?[1-9]|⁻?[¹²³⁴⁵⁶⁷⁸⁹])"
_FACTOR: Final = rf"(?:{'|'.join(sorted(UNITS, key=len, reverse=True))}){_POWER}?"
_JOIN: Final = r"(?: *[*.·] *| +)"
_PRODUCT: Final = rf"{_FACTOR}(?:{_JOIN}{_FACTOR})*"
_UNIT: Final = rf" *(?:{_PRODUCT}(?: */ *{_PRODUCT})?|1? */ *{_PRODUCT}) *"
UNIT_PATTERN: Final = f"^{_UNIT}$"
PATTERN: Final = f"^ *{_NUMBER}{_UNIT}$"
SHARE_PATTERN: Final = f"^ *{_NUMBER} *(?:{'|'.join(_SHARES)}) *$"

_SUPERSCRIPTS: Final = str.maketrans("⁻¹²³⁴⁵⁶⁷⁸⁹", "-123456789")
_LONGEST: Final = 200  # letters of a quantity


def split(text: str) -> tuple[Fraction, str]:
    """The number and the unit of a text; the unit is empty where there is none. Raises Refused."""
    found = re.fullmatch(rf" *({_NUMBER})(.*)", text) if len(text) <= _LONGEST else None
    if not found:
        raise Refused("this does not begin with a number", 'write a number and its unit, such as "12.5 mm"')
    number, unit = found[1], found[2].strip(" ")
    if re.match(r"[,_'][0-9]", unit):
        raise Refused("the number is written with commas or the like", "write its digits alone, with a point before decimals: 3000 or 0.5")
    return Fraction(number), "" if unit == "1" else unit


def _factors(product: str, unit: str, want: str) -> Iterator[tuple[str, int]]:
    """Names and powers of a product that is a part of the unit, where one of the dimension of `want` is wanted."""
    for token in re.split(_JOIN, product.strip(" ")):
        found = re.fullmatch(rf"([A-Za-z°]+)({_POWER})?", token)
        if found and found[1] in UNITS:
            yield found[1], int((found[2] or "1").lstrip("^").translate(_SUPERSCRIPTS))
        elif not token:
            raise Refused(f"a factor is missing in the unit {unit}", "write names of units with one *, . or · or blanks between two of them")
        elif "^" in token and not found and not re.search("[A-Za-z]-[A-Za-z]", token):
            raise Refused(f"{token} is no power", "write an integer from 1 to 9 behind ^, with - or without, such as m^2 or s^-1")
        else:
            name = found[1] if found else token
            raise Refused(f"there is no unit {name}", _meant(name, found[2] or "" if found else "", unit, want))


def _by_word(word: str) -> str:
    """The unit that a word stands for, such as h for Hours; empty where it is none."""
    small, one = word.lower(), word.removesuffix("s")
    return _WORDS.get(small) or _WORDS.get(small.removesuffix("s")) or (one if one != word and one in UNITS else "")


def spelled(unit: str) -> str:
    """A unit with names in place of the words in it: deg/s for degrees/sec."""
    return re.sub("[A-Za-z]+", lambda found: found[0] if found[0] in UNITS else _by_word(found[0]) or found[0], unit)


def _apart(word: str) -> Iterator[str]:
    """A word as names of units run together, in all ways: the longest names first."""
    if word in UNITS:
        yield word
    yield from (f"{word[:i]} {rest}" for i in range(len(word) - 1, 0, -1) if word[:i] in UNITS for rest in _apart(word[i:]))


def _in_parts(word: str, unit: str, want: str) -> str:
    """The unit with a word in it as names of units run together, where that is one of the dimension of `want`, or would be were a mass no force; empty
    where it is none."""
    if len(word) > 12:
        return ""
    made = [unit.replace(word, names) for names in _apart(word.replace("-", ""))]
    swapped = (found[2] for each in made if (found := _swapped(each, want)))
    return next((each for each in made if _measures(each, want)), "") or next(swapped, "")


def _meant(word: str, power: str, unit: str, want: str) -> str:
    """What to do about a name that is none, which has this power in a unit in whose place one of the dimension of `want` is wanted."""
    if word.lower().endswith("hz"):
        return "it may mean turns or radians: write rev/s or rad/s, for rates without an angle 1/s"
    if word in ("grad", "gon"):
        return "a gradian is 0.9 deg: give the number in deg"
    if _by_word(word):
        said = spelled(unit)
        is_rate = re.fullmatch(_PRODUCT, said) and not _measures(said, want) and _measures(f"{said}/s", want)
        return f"write {said}/s" if is_rate else f"write {said}"
    if meant := _in_parts(word, unit, want):
        return f"write {meant}, with blanks between"
    if re.search("[A-Za-z]-[A-Za-z]", word):
        return f"write {word.replace('-', ' ')}{power}, with blanks between"
    lower = {name.lower(): name for name in UNITS}
    near = lower.get(re.sub("[µμ]", "u", word).lower()) or next(iter(difflib.get_close_matches(word, UNITS, 1, 0.6)), "")
    if near and not (word[1:] in UNITS and word[0] in _PREFIXES) and _measures(unit.replace(word, near), want):
        return f"did you mean {near}?"
    return _known(want)


def _measures(unit: str, want: str) -> bool:
    """This is a unit, and of the dimension of `want`."""
    try:
        return _fits(_unit(unit)[1], _unit(want)[1])
    except Refused:
        return False


def _known(want: str) -> str:
    """What to write where a unit of the dimension of `want` is wanted, and another stands."""
    if not want:
        return "write the bare number"
    others = [name for name, (_, dimension) in UNITS.items() if dimension == _unit(want)[1] and name != want]
    return f"write it in {', '.join((want, *others))}, or in another unit of what that measures" + ("" if others else f"; the units are {', '.join(UNITS)}")


@lru_cache(maxsize=256)
def _unit(text: str, want: str = "") -> tuple[Fraction, Dimension]:
    """Size in SI units and dimension of a unit; of an empty one those of a number. Raises Refused, saying what to write where one of the dimension of
    `want` is wanted."""
    if text in _SHARES:
        return _SHARES[text], (0, 0, 0, 0, 0)
    above, slash, below = text.partition("/")
    if "**" in text:
        raise Refused(f"** stands in the unit {text}", "write powers with ^, such as m^2")
    if re.search("[()]", text):
        raise Refused(f"brackets stand in the unit {text}", "leave them out: all that stands behind the one / is divided, as in N m s/rad")
    if "/" in below:
        raise Refused(f"a second / stands in the unit {text}", "write one: all that stands behind it is divided, as in N m s/rad")
    size, powers = Fraction(1), [0] * 5
    for sign, product in ((1, "" if above.strip(" ") == "1" else above), (-1, below)):
        if product.strip(" ") or (slash and sign < 0):
            for name, power in _factors(product, text, want):
                each, dimension = UNITS[name]
                size *= each ** (sign * power)
                powers = [have + sign * power * more for have, more in zip(powers, dimension, strict=True)]
    return size, (powers[0], powers[1], powers[2], powers[3], powers[4])


def _fits(found: Dimension, wanted: Dimension) -> bool:
    """The dimensions are the same, but for an angle that is left out."""
    return found[:4] == wanted[:4] and found[4] in (0, wanted[4])


def _swapped(unit: str, want: str) -> tuple[str, str, str] | None:
    """A name of a mass that stands for a force, or the other way round: the name, what it is, and the unit as it was meant."""
    for mass, force in _FORCES.items():
        for name, what, other in ((mass, "mass", force), (force, "force", mass)):
            meant = re.sub(rf"(?<![A-Za-z]){name}(?![A-Za-z])", other, unit)
            if meant != unit and _fits(_unit(meant)[1], _unit(want)[1]):
                return name, what, meant
    return None


def to_si(number: Fraction, unit: str, want: str) -> float:
    """So many of a unit as the double next to it in SI units, where one of the dimension of `want` is wanted. An angle may be left out where
    one is wanted, but stands nowhere else. Raises Refused."""
    size, found = _unit(unit, want)
    wanted = _unit(want)[1]
    if not _fits(found, wanted):
        if swapped := _swapped(unit, want):
            remedy = f"{swapped[0]} is a {swapped[1]}: write {swapped[2]}"
        elif found[:4] == wanted[:4]:
            remedy = f"no such angle belongs here: write it in {want or 'a bare number'}"
        else:
            remedy = f"write it in {want}, or in another unit of what that measures" if want else "write the bare number"
        raise Refused(f"its unit is {want or 'that of a number'}, not {unit}", remedy)
    if wanted[4] == 1 and found[4] == 0 and size != 1:
        raise Refused(f"{unit} does not say which angle", f"write rad or rev in it, as in {want}" + (" or rpm" if found == (0, 0, -1, 0, 0) else ""))
    return _double(number * size)


def _double(number: Fraction) -> float:
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf


def quantity(text: str, want: str) -> float:
    """A number with a unit in SI units, one of the dimension of `want`; without a unit as it stands. Raises Refused."""
    number, unit = split(text)
    return to_si(number, unit, want) if unit else _double(number)
