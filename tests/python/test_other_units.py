# SPDX-License-Identifier: BSD-3-Clause
"""A scene told in other units, by powers of two, has the same answer in these units: within what both state, where a threshold is compared with a
number that has a unit."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import scene_names
from gyrostat.facts import FACTS
from gyrostat.families import FAMILIES
from gyrostat.fields import Field, parts_of
from gyrostat.rotation import angle_between
from gyrostat.scenes import load
from gyrostat.units import _unit

# Exponents of two of the units of mass, length and time.
UNITS = ((41, -20, 7), (-33, 17, -28))
# Scenes whose numbers are not all their own: a planet, or another scene.
OTHERS = {name for name in scene_names() if load(name).kind == "general" and ("orbit" in load(name).to_dict() or load(name).top.get("from"))}


def factor(unit: str, powers: tuple[int, int, int]) -> float:
    """Of a number in this unit where those of mass, length and time are 2^powers times as small."""
    mass, length, time = powers
    in_length, in_mass, in_time, _, _ = _unit(unit or "1")[1]
    return 2.0 ** (mass * in_mass + length * in_length + time * in_time)


def told(field: Field, value: Any, powers: tuple[int, int, int]) -> Any:
    if isinstance(value, Mapping):
        parts = {part.name: part for part in parts_of(field, value) or ()}
        return {key: told(parts[key], each, powers) if key in parts else each for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [told(field, each, powers) for each in value]
    if isinstance(value, bool | str) or value is None:
        return value
    return value * factor(field.unit, powers) if field.unit else value


def answered(scene: dict[str, Any], model: str) -> gyrostat.Answer | None:
    """By a rung that is named; None where it cannot."""
    try:
        return gyrostat.solve(scene, ask="all", model=model)
    except (gyrostat.DomainError, gyrostat.ConvergenceError):
        if model == "auto":
            raise
        return None


def compare(plain: dict[str, Any], made: dict[str, Any], powers: tuple[int, int, int], model: str) -> None:
    kind = plain["kind"]
    one, other = answered(plain, model), answered(made, model)
    assert (one is None) == (other is None), model
    if one is None or other is None:
        return
    assert one.model == other.model or one.met == other.met
    for column, quantity in FACTS[kind].quantities.items():
        if column not in one.error or quantity.kind != "number":
            continue
        stated = one.error[column] + other.error[column]
        if not stated < 1:
            continue
        if column.startswith("attitude"):
            away = float(np.max(angle_between(one[column], other[column])))
        elif quantity.measure == "relative":
            a, b = np.asarray(one[column]), np.asarray(other[column]) / factor(quantity.unit, powers)
            size = float(np.max(np.linalg.norm(a.reshape(len(a), -1), axis=1)))
            away = float(np.max(np.linalg.norm((a - b).reshape(len(a), -1), axis=1))) / max(size, one.scale.get(column, 0.0), 1e-300)
        else:
            continue
        assert away <= stated + 1e-14, (model, column)


@pytest.mark.parametrize("powers", UNITS)
@pytest.mark.parametrize("name", sorted(set(scene_names()) - OTHERS))
def test_a_scene_in_other_units(name: str, powers: tuple[int, int, int]) -> None:
    scene = load(name)
    last = float(scene.times[-1])
    plain = dataclasses.replace(scene, written={}).to_dict()
    plain["solve"] = {"times": [last / 3, last], "tolerance": scene.tolerance}
    layout, made = FAMILIES[scene.kind].keys, dict(plain)
    for table, fields in layout.items():
        given = plain if not table else plain.get(table, {})
        home = {field.name: told(field, given[field.name], powers) for field in fields if field.name in given}
        made |= home if not table else ({table: {**given, **home}} if given else {})
    for model in ("auto", *(rung for rung in FACTS[scene.kind].rungs if not rung.endswith("full"))):
        compare(plain, made, powers, model)


def in_unit_of_mass(kind: str, unit: float) -> gyrostat.Answer:
    """A body that turns, told in a unit of mass that is so many times less, by the function of the family, which takes any numbers."""
    moments = np.array([1.0, 2.0, 2.5]) * unit
    common: dict[str, Any] = {"inertia": moments, "times": [0.0, 1.0], "ask": ["angular_velocity"], "tolerance": 1e-6}
    turning = {"angular_velocity": [1.0, 1.0, 1.0]}
    if kind == "free":
        return gyrostat.free.solve(**common, **turning)
    if kind == "rotor":
        motor = {"axis": [0, 0, 1], "axial_inertia": 0.1 * unit, "slope": 0.01 * unit, "no_load_rate": 10.0}
        return gyrostat.rotor.solve(**common, **turning, **motor)
    if kind == "deceleration":
        return gyrostat.deceleration.solve(**common, control=0.1 * moments, drag=0.01, angular_momentum=moments)
    return gyrostat.general.solve(**common, **turning, torques=[{"type": "damping", "matrix": np.diag(0.1 * moments)}])


@pytest.mark.parametrize("exponent", [-300, -250, -200, -170, -160, -155, -150, -140, 140, 150, 153, 155, 160, 170, 200, 250, 300])
@pytest.mark.parametrize("kind", ["free", "rotor", "deceleration", "general"])
def test_units_in_which_squares_overflow_or_vanish(kind: str, exponent: int) -> None:
    truth = in_unit_of_mass(kind, 1.0)["angular_velocity"]
    try:
        answer = in_unit_of_mass(kind, 10.0**exponent)
    except (gyrostat.DomainError, gyrostat.ConvergenceError) as error:
        assert "give them in other units" in str(error)
        assert not -140 <= exponent <= 140
        return
    off = np.max(np.linalg.norm(answer["angular_velocity"] - truth, axis=1)) / np.linalg.norm(truth[0])
    assert off <= answer.error["angular_velocity"] + 1e-6
