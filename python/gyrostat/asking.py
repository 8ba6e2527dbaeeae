# SPDX-License-Identifier: BSD-3-Clause
"""What is asked of a scene: columns and scalars by name, each to the tolerance of the scene or to one of its own."""

import difflib
import math
from collections.abc import Iterable, Mapping
from typing import Any

from gyrostat.errors import Refused
from gyrostat.facts import FACTS, Facts, Quantity
from gyrostat.fields import GENERAL
from gyrostat.units import split, to_si

__all__ = ["Ask", "AskError", "Asked", "asked", "knows_attitude", "parse_ask"]

# "default", "all", names, or name -> tolerance: a number, as the column measures its errors, or a text with a unit; or all that in one text.
Ask = str | Iterable[str] | Mapping[str, float | str]

# As the compiled ladder takes it: name, tolerance (NaN: that of the scene), whether it is in the unit, whether a value has to be there.
Asked = tuple[str, float, bool, bool]


# What columns are called elsewhere.
_CALLED = {"rates": ["angular_velocity"], "rate": ["angular_velocity"], "omega": ["angular_velocity"], "body_rates": ["angular_velocity"],
           "wheel_rate": ["rotor_rate"], "wheel_rates": ["rotor_rate"], "rotor_speed": ["rotor_rate"], "wheel_speed": ["rotor_rate"],
           "wheel_angle": ["rotor_angle"], "quaternion": ["attitude"], "orientation": ["attitude"], "momentum": ["angular_momentum"],
           "kinetic_energy": ["energy"], "euler_angles": ["euler", "euler_312"], "angles": ["euler", "euler_312"]}


class AskError(Refused):
    """What is wrong with it, and what would be right."""

    def __str__(self) -> str:
        return f"ask: {super().__str__()}"


def _known(facts: Facts, name: Any) -> Quantity:
    found = facts.quantities.get(name) if isinstance(name, str) else None
    if name in ("all", "default"):
        raise AskError(f'"{name}" stands beside names', f'write "{name}" alone, or names alone')
    if found is None:
        near = [each for each in _CALLED.get(str(name), ()) if each in facts.quantities] or difflib.get_close_matches(str(name), facts.quantities, 1, 0.6)
        elsewhere = [kind for kind, each in FACTS.items() if name in each.quantities]
        of_others = f" in scenes of the kind {facts.name}; those of the kind {' or '.join(elsewhere)} have it" if elsewhere else ""
        raise AskError(f"there is no column or scalar {name}{of_others}",
                       f"did you mean {near[0]}?" if near else f"use {', '.join(facts.quantities)}, or \"all\"")
    return found


def _tolerance(of: Quantity, value: Any) -> tuple[float, bool]:
    """The tolerance, and whether it is in the unit."""
    example = f'write a number, as {of.name} = 1e-3, or one with a unit, as {of.name} = "{"0.1 deg" if of.measure == "angle" else f"0.1 {of.unit}".strip()}"'
    if value in (None, "", "default"):
        return math.nan, False
    if not of.measure:
        raise AskError(f"{of.name} has no error", "name it without a tolerance")
    number: float
    if isinstance(value, str):
        unit = "rad" if of.measure == "angle" else of.unit
        try:
            count, given = split(value)
            absolute = given != "" and not (given in ("%", "ppm") and of.measure == "relative")
            number = to_si(count, given, unit if absolute else "")
        except Refused as error:
            raise AskError(f'{of.name} = "{value}": {error.problem}', f"{error.remedy}; {example}") from None
    elif isinstance(value, int | float) and not isinstance(value, bool):
        try:
            number, absolute = float(value), False
        except OverflowError:
            number, absolute = math.inf, False
    else:
        raise AskError(f"the tolerance of {of.name} is neither a number nor a text", example)
    if not (number > 0 and math.isfinite(number)):
        raise AskError(f"the tolerance of {of.name} is {value}", "give a finite number > 0")
    if not absolute and of.measure == "relative" and number >= 1:
        raise AskError(f"the relative tolerance of {of.name} is {value}", "give a number below 1, or one with a unit")
    return number, absolute


def asked(kind: str, ask: Ask | None, knows_attitude: bool = True) -> list[Asked] | None:
    """What the compiled ladder of the kind takes; None for the default. `knows_attitude`: the start has one. Raises AskError."""
    facts = FACTS[kind]
    if isinstance(ask, str):
        ask = parse_ask(ask)
    if ask is None or (isinstance(ask, str) and ask == "default"):
        return None
    if isinstance(ask, str):  # "all"
        columns = [name for name in facts.columns if name != "attitude" or knows_attitude]
        return [*((name, math.nan, False, True) for name in columns), *((name, math.nan, False, False) for name in facts.scalars)]
    names = list(ask)
    if not names:
        raise AskError("nothing is asked for", "name a column or scalar, or leave it out")
    for name in names:
        _known(facts, name)
        if names.count(name) > 1:
            raise AskError(f"{name} is there twice", "name it once")
    if not isinstance(ask, Mapping):
        return [(name, math.nan, False, True) for name in names]
    return [(name, *_tolerance(facts.quantities[name], value), True) for name, value in ask.items()]


def knows_attitude(kind: str, tables: Mapping[str, Mapping[str, Any]]) -> bool:
    """The start of a checked scene has an attitude."""
    start = tables.get("initial", {})
    return kind == GENERAL or "euler_312" in start or "attitude" not in start or start["attitude"] is not None


def parse_ask(text: str) -> Ask:
    """What is asked in one text: "attitude", or "attitude=0.1deg,stop_time"."""
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if parts in (["all"], ["default"]):
        return parts[0]
    if not any("=" in part for part in parts):
        return parts
    pairs = [part.partition("=") for part in parts]
    names = [name.strip() for name, _, _ in pairs]
    if twice := [name for name in names if names.count(name) > 1]:
        raise AskError(f"{twice[0]} is there twice", "name it once")
    return {name.strip(): value.strip() for name, _, value in pairs}
