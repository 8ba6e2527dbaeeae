# SPDX-License-Identifier: BSD-3-Clause
"""Scene files: what is right is read, what is wrong is named with its remedy, and nothing else ever escapes."""

import math
import random
import re
import string
import tomllib
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import ASSEMBLED, GOOD, HEAVY, PERIODIC, ROTOR, SPINNING, at_length
from gyrostat.errors import DomainError, SceneError
from gyrostat.families import FAMILIES
from gyrostat.overriding import parse_override
from gyrostat.scenes import bundled, load, scene_from
from gyrostat.toml_text import toml_text
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st


def swap(old: str, new: str, text: str = GOOD) -> str:
    assert old in text
    return text.replace(old, new)


def in_rotor(old: str, new: str) -> str:
    return swap(old, new, ROTOR)


def in_spinning(old: str, new: str) -> str:
    return swap(old, new, SPINNING)


def in_heavy(old: str, new: str) -> str:
    return swap(old, new, HEAVY)


def in_periodic(old: str, new: str) -> str:
    return swap(old, new, PERIODIC)


def in_assembled(old: str, new: str) -> str:
    return swap(old, new, ASSEMBLED)


# A scene text, and what the message about it must contain: key, value, and the remedy.
MISTAKES: dict[str, tuple[str, list[str]]] = {
    "not TOML": (swap("duration = 100.0", "duration = "), [":6", "not TOML"]),
    "duplicate key": (swap("drag = 2.0e-4", "drag = 2.0e-4\ndrag = 1.0"), ["not TOML", "drag"]),
    "unknown kind": (swap('"deceleration"', '"decelaration"'), ["kind", "decelaration", 'did you mean "deceleration"']),
    "near miss of a kind": (swap('"deceleration"', '"heavvy"'), ["kind", "heavvy", 'did you mean "heavy"?', "deceleration", "rotor", "spinning"]),
    "kind missing": (swap('kind = "deceleration"\n', ""), ["kind", "missing", 'kind = "deceleration"']),
    "kind not text": (swap('"deceleration"', "3"), ["kind = 3", "deceleration"]),
    "name missing": (swap('name = "test"\n', ""), ["name", "missing"]),
    "name empty": (swap('"test"', '""'), ["name", "empty"]),
    "name not text": (swap('"test"', "7"), ["name = 7", "an integer, not text", "quotes"]),
    "unknown key": (swap("drag = 2", "dragg = 2"), ["torque.dragg", "did you mean drag?"]),
    "unknown key at the top": (swap("[solve]", "colour = 1\n[solve]"), [":5", "colour = 1", "unknown key"]),
    "unknown table": (GOOD + "\n[motor]\nslope = 1\n", ["motor", "unknown table"]),
    "misspelt table of another kind": (GOOD + "\n[motr]\nslope = 1\n", ["motr", "did you mean motor"]),
    "misspelt table": (swap("[torque]", "[torques]"), ["torques", "did you mean torque?", "[torque] is missing"]),
    "key in the wrong table": (swap("[torque]", "[torque]\ninertia = [1, 1, 1]"), ["torque.inertia", "belongs in [body]"]),
    "table missing": (GOOD.split("[initial]")[0], ["[initial] is missing", "angular_velocity or angular_momentum"]),
    "table given as a value": (GOOD.split("[body]")[0].replace("[solve]", "body = 3\n[solve]"), ["body = 3", "not a table"]),
    "array of tables": (swap("[body]", "[[body]]"), ["body", "an array, not a table"]),
    "missing key": (swap("drag = 2.0e-4\n", ""), ["torque.drag", "missing", "1/s"]),
    "text for a number": (swap("drag = 2.0e-4", 'drag = "2.0e-4"'), ["torque.drag", '"2.0e-4"', "without quotes"]),
    "truth value for a number": (swap("drag = 2.0e-4", "drag = true"), ["torque.drag = true", "a truth value", "number"]),
    "truth value in an array": (swap("[35.0, 22.0, 16.0]", "[35.0, true, 16.0]"), ["body.inertia", "element 2", "truth value"]),
    "date for a number": (swap("drag = 2.0e-4", "drag = 2020-01-01"), ["torque.drag = 2020-01-01", "date", "number"]),
    "array for a number": (swap("drag = 2.0e-4", "drag = [1.0]"), ["torque.drag = [1.0]", "an array"]),
    "number for an array": (swap("[0.005, 0.008, 0.010]", "0.005"), ["torque.control = 0.005", "3 numbers"]),
    "not a number": (swap("drag = 2.0e-4", "drag = nan"), ["torque.drag = nan", "not finite"]),
    "infinite": (swap("[40.0, 25.0, 16.5]", "[40.0, -inf, 16.5]"), ["initial.angular_momentum", "element 2 = -inf", "finite"]),
    "integer beyond double precision": (swap("2.0e-4", "1" + "0" * 400), ["torque.drag", "not finite"]),
    "integer beyond reading": (swap("2.0e-4", "1" * 5000), ["cannot be read"]),
    "absurd size": (swap("[40.0, 25.0, 16.5]", "[1e200, 0, 0]"), ["initial.angular_momentum", "out of range", "of size at most 1e+60 (N m s)"]),
    "zero moment": (swap("[35.0, 22.0, 16.0]", "[35.0, 22.0, 0.0]"), ["body.inertia", "element 3 = 0.0", "kg m^2"]),
    "negative moment": (swap("[35.0, 22.0, 16.0]", "[35.0, -22.0, 16.0]"), ["body.inertia", "element 2 = -22.0", ">="]),
    "triangle inequality": (swap("[35.0, 22.0, 16.0]", "[50.0, 22.0, 16.0]"), ["body.inertia", "50", "22", "16", "triangle"]),
    "moments of two units": (swap("[35.0, 22.0, 16.0]", "[35.0, 35.0, 1e-13]"), ["body.inertia", "1e-13", "unit"]),
    "two moments": (swap("[35.0, 22.0, 16.0]", "[35.0, 22.0]"), ["body.inertia", "2 elements", "3 numbers"]),
    "tensor not symmetric": (swap("[35.0, 22.0, 16.0]", "[[35, 1, 0], [2, 22, 0], [0, 0, 16]]"),
                             ["body.inertia", "(1, 2) = 1.0", "(2, 1) = 2.0", "symmetric"]),
    "tensor not positive": (swap("[35.0, 22.0, 16.0]", "[[1, 5, 0], [5, 1, 0], [0, 0, 1]]"), ["body.inertia", "-4", "positive"]),
    "tensor with a short row": (swap("[35.0, 22.0, 16.0]", "[[35, 1], [1, 22, 0], [0, 0, 16]]"), ["body.inertia", "row 1", "three rows"]),
    "tensor against the triangle": (swap("[35.0, 22.0, 16.0]", "[[9, 0, 0], [0, 2, 0], [0, 0, 3]]"), ["body.inertia", "9", "triangle"]),
    "rotor momentum of two numbers": (swap("[0.0, 0.0, 0.0]", "[0.0, 0.0]"), ["body.rotor_momentum", "2 elements"]),
    "negative control": (swap("[0.005, 0.008, 0.010]", "[0.005, -0.008, 0.010]"), ["torque.control", "element 2 = -0.008", ">= 0"]),
    "negative drag": (swap("2.0e-4", "-2.0e-4"), ["torque.drag = -0.0002", ">= 0"]),
    "unknown law": (swap('\nlaw = "total"', '\nlaw = "totl"'), ["torque.law", '"totl"', 'did you mean "total"?', "carrier"]),
    "unknown drag law": (swap('drag_law = "total"', 'drag_law = "both"'), ["torque.drag_law", '"both"', "total, carrier"]),
    "unknown model": (swap('model = "auto"', 'model = "averaged-3"'), ["solve.model", "averaged-3", "averaged-2"]),
    "unknown integrator": (swap('integrator = "auto"', 'integrator = "euler"'), ["solve.integrator", "euler", "taylor"]),
    "integrator of another kind": (swap('integrator = "auto"', 'integrator = "radau"'),
                                   ["solve.integrator", "radau", "this kind of scene has no such integrator", "taylor"]),
    "unknown elliptic backend": (swap('elliptic = "auto"', 'elliptic = "boost"'), ["solve.elliptic", "boost", "native"]),
    "list for a choice": (swap('model = "auto"', 'model = ["full"]'), ["solve.model", "an array, not text"]),
    "two starts": (swap("[initial]", "[initial]\nangular_velocity = [1.0, 0.0, 0.0]"), ["initial.angular_momentum", "either"]),
    "no start": (swap("angular_momentum = [40.0, 25.0, 16.5]\n", ""), ["initial.angular_velocity", "angular_momentum"]),
    "zero quaternion": (swap("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 0.0, 0.0]"), ["initial.attitude", "zero quaternion", "unit"]),
    "quaternion of another norm": (swap("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 3.0, 4.0]"),
                                   ["initial.attitude", "norm is 5", "[0, 0, 0.6, 0.8]"]),
    "quaternion of three numbers": (swap("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 1.0]"), ["initial.attitude", "4 numbers"]),
    "times beside duration": (swap("samples = 11", "samples = 11\ntimes = [1.0]"), ["solve.times", "either"]),
    "no times": (swap("duration = 100.0\nsamples = 11\n", ""), ["solve.duration", "duration and samples or times"]),
    "duration alone": (swap("samples = 11\n", ""), ["solve.samples", "missing"]),
    "empty times": (swap("duration = 100.0\nsamples = 11", "times = []"), ["solve.times", "no times"]),
    "times out of order": (swap("duration = 100.0\nsamples = 11", "times = [0, 2, 1]"), ["solve.times", "element 3 = 1.0", "increasing"]),
    "a time twice": (swap("duration = 100.0\nsamples = 11", "times = [0, 2, 2]"), ["solve.times", "element 3", "increasing"]),
    "negative time": (swap("duration = 100.0\nsamples = 11", "times = [-1, 2]"), ["solve.times", "element 1 = -1", ">= 0"]),
    "times not an array": (swap("duration = 100.0\nsamples = 11", "times = 5.0"), ["solve.times = 5.0", "an array"]),
    "zero duration": (swap("100.0", "0.0"), ["solve.duration = 0.0", "> 0"]),
    "one sample": (swap("samples = 11", "samples = 1"), ["solve.samples = 1", "from 2"]),
    "samples not an integer": (swap("samples = 11", "samples = 11.0"), ["solve.samples = 11.0", "integer", "401"]),
    "samples without end": (swap("samples = 11", "samples = 2000000000"), ["solve.samples", "1000000"]),
    "zero tolerance": (swap("tolerance = 1e-6", "tolerance = 0.0"), ["solve.tolerance = 0.0", "1e-15"]),
    "tolerance of one": (swap("tolerance = 1e-6", "tolerance = 1.0"), ["solve.tolerance = 1.0", "0.5"]),
    # rotor
    "unknown rung of a rotor": (in_rotor('model = "auto"', 'model = "averaged"'), ["solve.model", "averaged", "closed-form", "linear-tail"]),
    "no motor": (in_rotor("[motor]\nslope = 0.05\nno_load_rate = 30.0\n", ""), ["[motor] is missing", "slope, no_load_rate"]),
    "no rotor": (ROTOR.split("[rotor]")[0] + "[motor]" + ROTOR.split("[motor]")[1], ["[rotor] is missing", "axis, axial_inertia"]),
    "no body": (in_rotor("[body]\ninertia = [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]]\n", ""),
                ["body.inertia", "missing", "either body.inertia, or carrier.inertia, carrier.mass, rotor.mass"]),
    "an empty body": (in_rotor("inertia = [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]]\n", ""),
                      ["body.inertia", "missing", "carrier.inertia"]),
    "carrier beside body": (in_rotor("[rotor]", "[carrier]\ninertia = [1, 1, 1]\nmass = 2.0\n[rotor]"),
                            [":16", "carrier.inertia = [1, 1, 1]", "given beside body.inertia", "either body.inertia, or carrier.inertia"]),
    "mass of the rotor beside body": (in_rotor("[rotor]", "[rotor]\nmass = 2.0"), ["rotor.mass = 2.0", "given beside body.inertia", "offset"]),
    "carrier without the rotor's mass": (in_assembled("mass = 3.0\n", ""), ["rotor.mass", "missing", "equatorial_inertia and rotor.offset"]),
    "carrier without its mass": (in_assembled("mass = 12.0\n", ""), ["carrier.mass", "missing", "carrier.inertia"]),
    "carrier without offset": (in_assembled("offset = [0.2, -0.15, 0.3]\n", ""), ["rotor.offset", "missing"]),
    "carrier as a number": (in_assembled("[carrier]\ninertia = [2.1, 2.6, 3.2]\nmass = 12.0\n", "").replace("[solve]", "carrier = 3\n[solve]"),
                            ["carrier = 3", "an integer, not a table", "[carrier]"]),
    "mass in the body": (in_rotor("[body]", "[body]\nmass = 3.0"), ["body.mass", "unknown key", "mass belongs in [carrier] or [rotor]"]),
    "massless carrier": (in_assembled("mass = 12.0", "mass = 0.0"), ["carrier.mass = 0.0", "> 0", "kg"]),
    "impossible carrier": (in_assembled("[2.1, 2.6, 3.2]", "[2.1, 2.6, 9.2]"), ["carrier.inertia", "9.2", "triangle"]),
    "rotor against its own mass": (in_assembled("axial_inertia = 0.35", "axial_inertia = 0.61"),
                                   ["rotor.axial_inertia = 0.61", "twice rotor.equatorial_inertia = 0.3", "0.6 kg m^2"]),
    "rotor too great for the body": (in_rotor("axial_inertia = 0.35", "axial_inertia = 4.7"),
                                     ["rotor.axial_inertia = 4.7", "less than 4.5354946", "1/(e.theta^-1.e)"]),
    "body against the triangle": (in_rotor("[[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]]", "[3.2, 4.1, 8.0]"),
                                  ["body.inertia", "8", "triangle"]),
    "axis that is no unit": (in_rotor("[0.36, 0.48, 0.8]", "[3, 0, 4.0]"), ["rotor.axis = [3, 0, 4.0]", "norm is 5", "unit vector [0.6, 0, 0.8]"]),
    "axis that is nearly a unit": (in_rotor("[0.36, 0.48, 0.8]", "[0.36, 0.48, 0.80001]"), ["rotor.axis", "write the unit vector [0.35999"]),
    "axis without direction": (in_rotor("[0.36, 0.48, 0.8]", "[0.0, 0.0, 0.0]"), ["rotor.axis", "zero vector", "[0.0, 0.0, 1.0]"]),
    "axis of two numbers": (in_rotor("[0.36, 0.48, 0.8]", "[0.6, 0.8]"), ["rotor.axis", "2 elements", "3 numbers"]),
    "rotor without inertia": (in_rotor("axial_inertia = 0.35", "axial_inertia = 0.0"), ["rotor.axial_inertia = 0.0", "out of range", "kg m^2"]),
    "motor that drives itself": (in_rotor("slope = 0.05", "slope = -0.05"), ["motor.slope = -0.05", ">= 0", "N m s/rad"]),
    "endless rate": (in_rotor("no_load_rate = 30.0", "no_load_rate = inf"), ["motor.no_load_rate = inf", "finite", "rad/s"]),
    "no rotor rate": (in_rotor("rotor_rate = -1.0\n", ""), ["initial.rotor_rate", "missing", "rad/s"]),
    "momentum at the start of a rotor": (in_rotor("rotor_rate = -1.0", "rotor_rate = -1.0\nangular_momentum = [1, 2, 3]"),
                                         ["initial.angular_momentum", "unknown key", "angular_velocity"]),
    "torque on a rotor scene": (ROTOR + "[torque]\ndrag = 1.0\n", ["torque", "unknown table"]),
    # spinning
    "unknown rung of a spinner": (in_spinning('model = "auto"', 'model = "second_order"'), ["solve.model", "second_order", 'did you mean "second-order"?']),
    "implicit integrator of a spinner": (in_spinning('integrator = "auto"', 'integrator = "radau"'),
                                         ["solve.integrator", "radau", "this kind of scene has no such integrator", "taylor, cvode"]),
    "inertia off the axes": (in_spinning("[8.0, 7.0, 11.0]", "[[8, 0.1, 0], [0.1, 7, 0], [0, 0, 11]]"),
                             ["body.inertia", "(1, 2) = 0.1", "principal moments", "axis 3 the spin axis"]),
    "thin beyond a lamina": (in_spinning("[8.0, 7.0, 11.0]", "[8.0, 7.0, 15.000000001]"), ["body.inertia", "15", "triangle"]),
    "massless spinner": (in_spinning("mass = 10.0", "mass = 0"), ["body.mass = 0", "> 0", "kg"]),
    "no mass": (in_spinning("mass = 10.0\n", ""), ["body.mass", "missing", "kg"]),
    "rotor momentum as a vector": (in_spinning("rotor_momentum = 1.5", "rotor_momentum = [0, 0, 1.5]"), ["body.rotor_momentum", "an array", "N m s"]),
    "charge beside its momentum": (in_spinning("[field]", "[field]\nmomentum = 0.29"),
                                   ["field.charge = 0.002", "given beside field.momentum", "either momentum or charge"]),
    "charge without its arm": (in_spinning("arm = 1.1\n", ""), ["field.arm", "missing", "flux_density"]),
    "negative arm": (in_spinning("arm = 1.1", "arm = -1.1"), ["field.arm = -1.1", ">= 0", "m"]),
    "endless field": (in_spinning("flux_density = 50.0", "flux_density = inf"), ["field.flux_density = inf", "finite", "T"]),
    "gravity": (in_spinning("[field]", "[field]\ngravity = 9.8"), ["field.gravity", "unknown key"]),
    "no torque": (in_spinning("[torque]\nbody = [0.004, -0.002, 0.0]\nforce = [0.3, -0.2, 3.0]\n", ""), ["[torque] is missing", "body, force"]),
    "no force": (in_spinning("force = [0.3, -0.2, 3.0]\n", ""), ["torque.force", "missing", "N"]),
    "force of two numbers": (in_spinning("[0.3, -0.2, 3.0]", "[0.3, 3.0]"), ["torque.force", "2 elements", "3 numbers"]),
    "force in the body": (in_spinning("[body]", "[body]\nforce = [0, 0, 1]"), ["body.force", "belongs in [torque]"]),
    "angles of text": (in_spinning("[0.004, -0.002, 0.3]", '"zero"'), ["initial.euler_312", '"zero"']),
    "two attitudes": (in_spinning("euler_312 = ", "attitude = [0, 0, 0, 1]\neuler_312 = "), ["initial.attitude", "given beside initial.euler_312"]),
    "speed as a number": (in_spinning("velocity = [0.1, -0.2, 0.3]\npos", "velocity = 0.1\npos"), ["initial.velocity = 0.1", "3 numbers"]),
    "endless position": (in_spinning("[1.0, 2.0, 3.0]", "[1.0, nan, 3.0]"), ["initial.position", "element 2 = nan", "not finite"]),
    "no spin": (in_spinning("angular_velocity = [0.002, -0.003, 1.0]\n", ""), ["initial.angular_velocity", "missing", "rad/s"]),
    "momentum at the start of a spinner": (in_spinning("[initial]", "[initial]\nangular_momentum = [1, 2, 3]"), ["initial.angular_momentum", "unknown key"]),
    # heavy
    "unknown rung of a heavy body": (in_heavy('model = "auto"', 'model = "series-3"'), ["solve.model", "series-3", 'did you mean "series-2"?']),
    "implicit integrator of a heavy body": (in_heavy('integrator = "auto"', 'integrator = "radau"'), ["solve.integrator", "radau", "no such integrator"]),
    "massless heavy body": (in_heavy("mass = 0.8", "mass = 0.0"), ["body.mass = 0.0", "> 0", "kg"]),
    "mass as text": (in_heavy("mass = 0.8", 'mass = "0.8"'), ["body.mass", '"0.8"', "text"]),
    "no centre": (in_heavy("centre_of_mass = [0.012, 0.009, 0.010]\n", ""), ["body.centre_of_mass", "missing", "m"]),
    "centre in millimetres": (in_heavy("[0.012, 0.009, 0.010]", "[12.0, 9.0, 10.0]"), ["body.centre_of_mass", "no body", "at most", "units"]),
    "centre of two numbers": (in_heavy("[0.012, 0.009, 0.010]", "[0.012, 0.009]"), ["body.centre_of_mass", "2 elements", "3 numbers"]),
    "centre off a lamina": (in_heavy("[0.0011, 0.0016, 0.0020]", "[0.0011, 0.0009, 0.0020]"), ["body.centre_of_mass", "no body", "at most 0 m"]),
    "moments beyond a lamina": (in_heavy("[0.0011, 0.0016, 0.0020]", "[0.0011, 0.0016, 0.0028]"), ["body.inertia", "0.0028", "triangle"]),
    "just beyond a lamina": (in_heavy("[0.0011, 0.0016, 0.0020]", "[0.0011, 0.0016, 0.0027000000000001]"), ["body.inertia", "rounding"]),
    "gravity upwards": (in_heavy("gravity = 9.80665", "gravity = -9.80665"), ["field.gravity = -9.80665", ">= 0", "m/s^2"]),
    "no gravity": (in_heavy("gravity = 9.80665\n", ""), ["field.gravity", "missing"]),
    "no field": (in_heavy("[field]\ngravity = 9.80665\ngravity_gradient = 4.6e-6\n", ""), ["[field] is missing", "gravity"]),
    "gradient and distance": (in_heavy("[initial]", "centre_distance = 6.4e6\n\n[initial]"), ["field.centre_distance", "given beside field.gravity_gradient"]),
    "a centre in the body": (in_heavy("gravity_gradient = 4.6e-6", "centre_distance = 0.0"), ["field.centre_distance = 0.0", "> 0", "m"]),
    "negative gradient": (in_heavy("4.6e-6", "-4.6e-6"), ["field.gravity_gradient = -4.6e-06", ">= 0", "1/s^2"]),
    "down of length two": (in_heavy("[0.6, 0.0, 0.8]", "[1.2, 0.0, 1.6]"), ["initial.down", "norm is 2", "[0.6, 0, 0.8]"]),
    "no direction": (in_heavy("[0.6, 0.0, 0.8]", "[0, 0, 0]"), ["initial.down", "zero vector"]),
    "down and attitude": (in_heavy("down =", "attitude = [0, 0, 0, 1]\ndown ="), ["initial.attitude", "given beside initial.down"]),
    "neither down nor attitude": (in_heavy("down = [0.6, 0.0, 0.8]\n", ""), ["initial.down", "missing", "down or attitude or periodic"]),
    "no rates": (in_heavy("angular_velocity = [0.1, -0.2, 150.0]\n", ""), ["initial.angular_velocity", "missing", "angular_velocity or periodic"]),
    "periodic beside rates": (in_periodic("periodic =", "angular_velocity = [0, 0, 1]\nperiodic ="), ["initial.periodic", "given beside initial.angular_velocity"]),
    "periodic beside down": (in_periodic("periodic =", "down = [0, 0, 1]\nperiodic ="), ["initial.periodic", "given beside initial.down"]),
    "periodic as a number": (in_periodic("{ spin = 150.0, cos_inclination = 0.1 }", "150.0"), ["initial.periodic", "not a table", "spin = ..."]),
    "periodic without spin": (in_periodic("spin = 150.0, ", ""), ["initial.periodic", "spin is missing", "rad/s"]),
    "periodic with an angle": (in_periodic("cos_inclination = 0.1", "inclination = 1.47"), ["initial.periodic", '"inclination"', "cos_inclination"]),
    "periodic upright": (in_periodic("cos_inclination = 0.1", "cos_inclination = 1.0"), ["initial.periodic", "cos_inclination = 1.0", "out of range", "< 1"]),
    "periodic without number": (in_periodic("spin = 150.0", "spin = nan"), ["initial.periodic", "spin = nan", "not finite"]),
}


@pytest.mark.parametrize("label", MISTAKES)
def test_mistake_names_file_key_value_and_remedy(label: str, tmp_path: Path) -> None:
    text, wanted = MISTAKES[label]
    file = tmp_path / "bad.toml"
    file.write_text(text)
    with pytest.raises(SceneError) as caught:
        load(file)
    message = str(caught.value)
    assert str(file) in message
    for part in wanted:
        assert part in message
    for mistake in caught.value.mistakes:
        assert mistake.remedy
        assert len(str(mistake)) < 600


def test_enough_mistakes() -> None:
    assert len(MISTAKES) >= 40


def test_every_mistake_is_reported_at_once(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text(swap("2.0e-4", "-1.0").replace("samples = 11", "samples = 1").replace("[35.0,", '["a",'))
    with pytest.raises(SceneError) as caught:
        load(file)
    assert [mistake.key for mistake in caught.value.mistakes] == ["solve.samples", "body.inertia", "torque.drag"]


def test_the_line_is_named(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text(swap("2.0e-4", "-1.0"))
    line = GOOD.splitlines().index("drag = 2.0e-4") + 1
    with pytest.raises(SceneError, match=re.escape(f"{file}:{line}: torque.drag")):
        load(file)


def test_files_that_are_no_scenes(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="directory"):
        load(tmp_path)
    with pytest.raises(SceneError, match="no such file"):
        load(tmp_path / "absent.toml")
    with pytest.raises(SceneError, match="did you mean the bundled scene tiangong-1"):
        load("tiangong1")
    with pytest.raises(SceneError, match="cannot be read"):
        load("a\0b")
    with pytest.raises(SceneError, match="cannot be read"):
        load("x" * 5000)
    file = tmp_path / "latin.toml"
    file.write_bytes(GOOD.replace("a test", "é").encode("latin-1"))
    with pytest.raises(SceneError, match="not UTF-8"):
        load(file)
    file.write_text("a = " + "[" * 100_000)
    with pytest.raises(SceneError):
        load(file)
    file.write_text("")
    with pytest.raises(SceneError, match="kind"):
        load(file)


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    file = tmp_path / "bom.toml"
    file.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
    assert load(file).name == "test"


def test_values_are_read(scene_file: Path) -> None:
    scene = load(scene_file)
    assert scene.kind == "deceleration" and scene.path == scene_file
    assert scene.times.shape == (11,) and scene.times[-1] == 100.0
    assert scene.tables["torque"]["control"] == (0.005, 0.008, 0.01)
    assert scene.tolerance == 1e-6 and scene.model == "auto"


def test_defaults_are_filled_in() -> None:
    scene = scene_from({"name": "a", "kind": "deceleration", "solve": {"times": [1]}, "body": {"inertia": [1, 1, 1]},
                        "torque": {"control": [0, 0, 0], "drag": 0}, "initial": {"angular_velocity": [1, 0, 0]}})
    assert scene.tables["body"]["rotor_momentum"] == (0.0, 0.0, 0.0)
    assert scene.tables["torque"]["law"] == "total"
    assert scene.tables["initial"]["attitude"] is None
    assert scene.to_dict()["solve"]["integrator"] == "auto"
    assert "attitude" not in scene.to_dict()["initial"]


def test_a_scene_survives_its_dict(scene_file: Path) -> None:
    scene = load(scene_file)
    assert scene_from(scene.to_dict()).to_dict() == scene.to_dict()


def test_a_scene_is_its_own_whatever_becomes_of_what_it_was_made_of_and_of_its_dict() -> None:
    given = {"name": "x", "body": {"inertia": ["0.7 kg m^2", 0.9, 1.1]}, "initial": {"angular_velocity": {"value": [1, 2, 3], "unit": "deg/s"}},
             "torque": [{"type": "constant", "torque": ["1 N m", 0, 0]}], "solve": {"times": [30.0]}}
    scene = scene_from(given)
    told = str(scene)
    given["body"]["inertia"][0] = given["torque"][0]["torque"][0] = "5 kg m^2"
    for made in (scene.to_dict(), gyrostat.solve(scene).scene):
        made["body"]["inertia"][0], made["initial"]["angular_velocity"]["value"][0], made["torque"][0]["torque"][0] = "1 kg m^2", 55, "9 N m"
    assert str(scene) == told and "0.7 kg m^2" in told


def test_scenes_that_say_the_same_are_equal(tmp_path: Path) -> None:
    scene = load("t-handle")
    assert scene == load("t-handle") == scene_from(scene.to_dict()) and len({scene, load("t-handle")}) == 1
    assert scene != scene.replace(tolerance=1e-7) and scene != scene.to_dict()
    assert scene.replace(duration="60 s") != scene.replace(duration="1 min")  # it says so, although it means the same
    goes_on = """
kind = "general"
name = "later"
from = "first.toml"
[body]
inertia = [1.0, 2.0, 2.5]
[solve]
times = [20.0]
"""
    made = []
    for rate in (1.0, 1.0, 1.1):
        (tmp_path / "first.toml").write_text(toml_text(load("t-handle").replace(**{"initial.angular_velocity": [rate, 0.1, 0.1]}).to_dict()))
        (tmp_path / "later.toml").write_text(goes_on)
        made.append(load(tmp_path / "later.toml"))
    assert made[0] == made[1] != made[2]


@pytest.mark.parametrize("call", [gyrostat.solve, gyrostat.chart, lambda given: gyrostat.sweep(given, {})])
@pytest.mark.parametrize("given", [None, 3, b"t-handle"])
def test_what_is_no_scene_is_told_what_is_one(call: Any, given: Any) -> None:
    with pytest.raises(DomainError, match="give a Scene, a dict .* a file, or the name of a bundled scene"):
        call(given)


def test_load_takes_names_of_files_alone() -> None:
    for given in (load("t-handle").to_dict(), None, 3):
        with pytest.raises(DomainError, match="name a scene file or a bundled scene"):
            load(given)  # type: ignore[arg-type]


@pytest.mark.parametrize("text", [ROTOR, ASSEMBLED])
def test_rotor_scenes_are_read(text: str, tmp_path: Path) -> None:
    file = tmp_path / "rotor.toml"
    file.write_text(text.replace("attitude = [0.0, 0.0, 0.0, 1.0]\n", ""))
    scene = load(file)
    assert scene.kind == "rotor" and scene.tables["rotor"]["axis"] == (0.36, 0.48, 0.8)
    assert scene.tables["initial"]["attitude"] == (0.0, 0.0, 0.0, 1.0)
    assert (scene.tables["body"]["inertia"] is None) == (text is ASSEMBLED) != (scene.tables["carrier"]["mass"] is None)
    assert ("carrier" in scene.to_dict()) == (text is ASSEMBLED) != ("body" in scene.to_dict())
    assert scene_from(scene.to_dict()).to_dict() == scene.to_dict()
    assert scene.replace(integrator="radau").tables["solve"]["integrator"] == "radau"


@pytest.mark.parametrize("change", [
    {"times": [1.0, 2.0]}, {"solve.times": ["1 min", 90.0]}, {"duration": 5.0}, {"samples": 7}, {"duration": "2 min", "samples": 3}, {"ask": ["attitude"]},
    {"ask": {"attitude": "0.1 deg"}, "times": [3.0], "tolerance": 1e-3}, {"ask": "all"}, {"inertia": [36.0, 22.0, 16.0], "times": [3.0]},
])
@pytest.mark.parametrize("name", ["tumbling-brick", "tiangong-1", "pam-d-burn", "lab-gyroscope", "cubesat-wheel-spin-up", "gravity-gradient-boom", "dual-spinner"])
def test_a_changed_scene_is_the_one_that_is_read_whole(name: str, change: dict[str, Any]) -> None:
    for begin in ({}, {"times": [0.5, 4.0]}):
        scene = load(name, **begin)
        try:
            whole = scene.with_data(scene.to_dict(), change)
        except SceneError as error:
            with pytest.raises(SceneError) as refused:
                scene.replace(**change)
            assert str(refused.value) == str(error)
            continue
        changed = scene.replace(**change)
        assert changed.tables == whole.tables and changed.written == whole.written
        assert changed.times.tolist() == whole.times.tolist()


@pytest.mark.parametrize("change", [
    {"times": []}, {"times": [2.0, 1.0]}, {"times": [1.0], "duration": 3.0}, {"samples": 1}, {"ask": ["no_such"]}, {"ask": []}, {"times": None, "samples": None},
    {"duration": None},
])
def test_times_and_questions_that_make_no_sense_are_refused_with_the_words_of_a_file(change: dict[str, Any]) -> None:
    scene = load("tumbling-brick")
    with pytest.raises(SceneError) as whole:
        scene.with_data(scene.to_dict(), change)
    with pytest.raises(SceneError) as quick:
        scene.replace(**change)
    assert str(quick.value) == str(whole.value)


def test_an_axis_within_rounding_of_a_unit_is_normalised(rotor_file: Path) -> None:
    axis = np.array([0.36, 0.48, 0.8]) * (1 + 5e-9)
    scene = load(rotor_file, axis=axis)
    assert math.hypot(*scene.tables["rotor"]["axis"]) == pytest.approx(1, abs=4e-16)
    assert scene_from(scene.to_dict()).to_dict() == scene.to_dict()
    with pytest.raises(SceneError, match="norm is"):
        load(rotor_file, axis=axis * (1 + 2e-8))


def test_spinning_scenes_are_read(spinning_file: Path) -> None:
    scene = load(spinning_file)
    assert scene.kind == "spinning" and scene.tables["body"]["inertia"] == (8.0, 7.0, 11.0)
    assert scene_from(scene.to_dict()).to_dict() == scene.to_dict()
    assert scene.replace(inertia=[[8, 0, 0], [0, 7, 0], [0, 0, 11]]).tables == scene.tables
    assert load(spinning_file, inertia=[8, 7, 15]).tables["body"]["inertia"][2] == 15.0  # a lamina
    momentum = scene.replace(momentum=0.29)
    assert momentum.to_dict()["field"] == {"momentum": 0.29}
    turned = scene.replace(attitude=[0.0, 0.0, 0.6, 0.8]).to_dict()["initial"]
    assert "euler_312" not in turned and turned["attitude"] == [0.0, 0.0, 0.6, 0.8]


def test_heavy_scenes_are_read(heavy_file: Path) -> None:
    scene = load(heavy_file)
    assert scene.kind == "heavy" and scene.tables["body"]["inertia"] == (0.0011, 0.0016, 0.002)
    assert scene_from(scene.to_dict()).to_dict() == scene.to_dict()
    far = scene.replace(centre_distance=6.4e6)
    assert far.to_dict()["field"] == {"gravity": 9.80665, "centre_distance": 6.4e6}
    turned = scene.replace(attitude=[0.0, 0.0, 0.6, 0.8]).to_dict()["initial"]
    assert "down" not in turned and turned["attitude"] == [0.0, 0.0, 0.6, 0.8]
    periodic = scene.replace(periodic={"spin": 100, "cos_inclination": -0.5})
    assert periodic.to_dict()["initial"] == {"periodic": {"spin": 100.0, "cos_inclination": -0.5}}
    assert scene_from(tomllib.loads(PERIODIC)).replace(**{"initial.periodic.spin": 100.0}).tables["initial"]["periodic"]["spin"] == 100.0
    back = periodic.replace(angular_velocity=[0, 0, 1], down=[0, 0, 1])
    assert back.to_dict()["initial"] == {"angular_velocity": [0.0, 0.0, 1.0], "down": [0.0, 0.0, 1.0]}
    free = {key: value for key, value in scene.to_dict()["field"].items() if key == "gravity"}
    assert scene_from({**scene.to_dict(), "field": free}).tables["field"]["gravity_gradient"] is None


def test_a_mass_centre_as_far_out_as_can_be(heavy_file: Path) -> None:
    J = np.array([0.00125, 0.00075, 0.00035])
    far = np.array([0.012, 0.009, 0.010])
    most = far / math.sqrt(0.8 * float(np.sum(far**2 / J)))
    assert load(heavy_file, centre_of_mass=most * (1 - 1e-12))
    with pytest.raises(SceneError, match=f"at most {np.linalg.norm(most):.6g}"):
        load(heavy_file, centre_of_mass=most * (1 + 1e-12))
    assert load(heavy_file, inertia=[0.001, 0.002, 0.003], centre_of_mass=[0.01, -0.01, 0.0])  # a lamina


def test_a_spinner_may_leave_out_what_is_zero() -> None:
    least = {"name": "a", "kind": "spinning", "solve": {"times": [1]}, "body": {"inertia": [1, 1, 1], "mass": 1},
             "torque": {"body": [0, 0, 0], "force": [0, 0, 0]}, "initial": {"angular_velocity": [0, 0, 1]}}
    scene = scene_from(least)
    assert scene.tables["body"]["rotor_momentum"] == 0.0 and "field" not in scene.to_dict()
    assert scene.tables["initial"]["velocity"] == scene.tables["initial"]["position"] == (0.0, 0.0, 0.0)
    assert scene_from({**least, "field": {}}).tables == scene.tables


def test_a_rotor_as_great_as_its_body_holds(rotor_file: Path) -> None:
    theta = np.array([[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]])
    e = np.array([0.36, 0.48, 0.8])
    most = 1 / float(e @ np.linalg.inv(theta) @ e)
    assert load(rotor_file, axial_inertia=most * (1 - 1e-6))
    with pytest.raises(SceneError, match=f"{most:.9g}"):
        load(rotor_file, axial_inertia=most * (1 + 1e-12))
    disc = load(rotor_file, **{"carrier.inertia": [2, 3, 4], "carrier.mass": 5, "rotor.mass": 1, "equatorial_inertia": 0.175, "offset": [0, 0, 0.1]})
    assert disc.tables["rotor"]["axial_inertia"] == 2 * disc.tables["rotor"]["equatorial_inertia"]


def test_overrides_across_tables(rotor_file: Path, tmp_path: Path) -> None:
    apart = {"carrier.inertia": [2, 3, 4], "carrier.mass": 5, "rotor.mass": 1, "equatorial_inertia": 0.3, "offset": [0, 0, 0.1]}
    scene = load(rotor_file, **apart)
    assert "body" not in scene.to_dict() and scene.tables["carrier"]["mass"] == 5.0
    assert scene.replace(inertia=[3, 3, 3]).tables["carrier"]["inertia"] == (3.0, 3.0, 3.0)  # the one that the scene gives
    whole = scene.replace(**{"body.inertia": [3, 4, 5]}).to_dict()
    assert "carrier" not in whole and set(whole["rotor"]) == {"axis", "axial_inertia"}
    assert load(rotor_file, inertia=[3, 4, 5]).tables["body"]["inertia"] == (3.0, 4.0, 5.0)
    with pytest.raises(SceneError, match="write carrier.mass or rotor.mass"):
        load(rotor_file, mass=1.0)
    with pytest.raises(SceneError, match="write carrier.mass or rotor.mass"):
        scene.replace(mass=1.0)
    with pytest.raises(SceneError, match="carrier.inertia: the key is missing"):
        load(rotor_file, **{"rotor.mass": 1.0})


def test_a_nearly_unit_quaternion_is_normalised() -> None:
    q = np.array([0.5, 0.5, 0.5, 0.5]) * (1 + 3e-7)
    scene = load("near-separatrix", attitude=q)
    assert scene.tables["initial"]["attitude"] == tuple(q)  # the scene says what was given, and its motion begins at a unit quaternion
    assert np.linalg.norm(gyrostat.solve(scene, ask=["attitude"], times=[0.0])["attitude"][0]) == pytest.approx(1, abs=4e-16)


def test_a_flat_body_and_a_symmetric_one_are_bodies() -> None:
    for inertia in ([1.0, 2.0, 3.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [[2, 0, 0], [0, 2, 0], [0, 0, 2]]):
        assert load("near-separatrix", inertia=inertia)


def test_overrides_are_checked_and_take_the_place_of_their_alternative(scene_file: Path) -> None:
    scene = load(scene_file, **{"torque.drag": 0, "tolerance": 1e-9, "times": np.array([1.0, 2.0])})
    assert scene.tables["torque"]["drag"] == 0.0 and scene.tolerance == 1e-9
    assert list(scene.times) == [1.0, 2.0]
    assert list(scene.replace(angular_velocity=[1, 2, 3]).to_dict()["initial"]) == ["angular_velocity", "attitude"]
    assert scene.replace(duration=5.0, samples=3).times.tolist() == [0.0, 2.5, 5.0]
    assert scene.replace() is scene
    for wrong in ({"drag": -1}, {"tolernce": 1}, {"torque.dragg": 1}, {"a.b.c": 1}, {"name.x": 1}, {"duration": 5.0}):
        with pytest.raises(SceneError):
            scene.replace(**wrong)


ONE_WHEEL = """\
name = "w"
[body]
inertia = [1.0, 2.0, 2.5]
[initial]
angular_velocity = [0.1, 0.2, 0.3]
[solve]
times = [1.0]
[[wheel]]
type = "held"
axis = [1, 0, 0]
axial_inertia = 0.01
rate = 1.0
"""
GENERAL_SCENE: dict[str, Any] = {
    "name": "two wheels", "body": {"inertia": [[4.0, 0.1, 0.0], [0.1, 5.0, 0.0], [0.0, 0.0, 6.0]]}, "initial": {"angular_velocity": [0.1, 0.2, 0.3]},
    "solve": {"times": [1.0]},
    "wheel": [{"name": "roll", "type": "held", "axis": [1.0, 0.0, 0.0], "axial_inertia": 0.01, "rate": 5.0},
              {"name": "pitch", "type": "held", "axis": [0.0, 1.0, 0.0], "axial_inertia": 0.01, "rate": 6.0}]}


def test_overrides_reach_into_lists_by_place_and_by_name() -> None:
    scene = scene_from(GENERAL_SCENE)
    changed = scene.replace(**{"wheel[0].rate": 7.0, "wheel.pitch.rate": "60 rpm", "body.inertia[0,1]": 0.2, "angular_velocity[2]": 0.5})
    roll, pitch = changed.top["wheel"]
    assert roll["rate"] == 7.0 and pitch["rate"] == pytest.approx(2 * np.pi)
    assert np.array_equal(changed.tables["body"]["inertia"], [[4.0, 0.2, 0.0], [0.2, 5.0, 0.0], [0.0, 0.0, 6.0]])
    assert tuple(changed.tables["initial"]["angular_velocity"]) == (0.1, 0.2, 0.5)
    assert GENERAL_SCENE["wheel"][0]["rate"] == 5.0
    one = scene_from({**GENERAL_SCENE, "wheel": GENERAL_SCENE["wheel"][:1]})
    assert one.replace(**{"wheel.rate": 8.0}).top["wheel"][0]["rate"] == 8.0
    for key, words in (("wheel.rate", "there are 2 of these tables; write which, such as wheel[0].KEY"), ("wheel[2].rate", "there are 2, counted from 0"),
                       ("wheel.yaw.rate", "no one table named yaw"), ("angular_velocity[3]", "there is no such number"), ("body.mass[0]", "there is no such number")):
        with pytest.raises(SceneError, match=re.escape(words)):
            scene.replace(**{key: 1.0})


@pytest.mark.parametrize("key", ["wheel[x].rate", "wheel[0,1].rate", "wheel[1][0].rate", "angular_velocity[0,]", "wheel[-1].rate", "wheel[1]].rate",
                                 "wheel[" + "9" * 5000 + "].rate", "angular_velocity[1.5]", "torque[0,1]x.", "wheel[\u0661].rate", "", "."])
def test_keys_that_are_none_are_refused(key: str) -> None:
    with pytest.raises(SceneError) as caught:
        scene_from(GENERAL_SCENE).replace(**{key: 1.0})
    assert len(str(caught.value)) < 600
    if key:
        with pytest.raises(SceneError):
            parse_override(f"{key}=1")


def test_two_places_may_be_written_either_way_and_rivals_are_seen_without_them() -> None:
    scene = scene_from(GENERAL_SCENE)
    assert scene.replace(**{"inertia[0][1]": 0.3}).tables["body"]["inertia"][1][0] == 0.3
    with pytest.raises(SceneError, match="there is no such number"):
        scene.replace(**{"wheel[0].axis[0,1]": 0.3})


def test_a_mistake_set_from_outside_is_not_told_of_a_line_of_the_file(tmp_path: Path) -> None:
    file = tmp_path / "wheels.toml"
    file.write_text(ONE_WHEEL)
    with pytest.raises(SceneError) as caught:
        load(file, **{"wheel[0].rate": "foo"})
    assert "set on the command line or by keyword" in str(caught.value) and f"{file}:" not in str(caught.value)


def test_a_mistake_in_a_list_names_the_line_of_its_table(tmp_path: Path) -> None:
    file = tmp_path / "wheels.toml"
    file.write_text(ONE_WHEEL + """[[wheel]]
type = "motor"
axis = [0, 1, 0]
axial_inertia = 0.01
no_load_rate = 10.0
""")
    with pytest.raises(SceneError) as caught:
        load(file)
    assert f"{file}:13: wheel[1]: of slope and stall_torque one is wanted" in str(caught.value)


def test_a_scene_that_can_only_be_general_is_not_asked_for_its_kind() -> None:
    for wrong in ({"step": 10}, {"wheels": []}):
        with pytest.raises(SceneError) as caught:
            scene_from({**GENERAL_SCENE, **wrong})
        assert "kind" not in [mistake.key for mistake in caught.value.mistakes]
    with pytest.raises(SceneError, match="kind: the key is missing"):
        scene_from({"name": "r", "rotor": {"axis": [1, 0, 0]}, "body": {"inertia": [1.0, 1.0, 1.0]}, "solve": {"times": [1.0]}})


def test_places_are_reached_in_numbers_beside_a_unit_and_in_moments_and_products() -> None:
    scene = load("tiangong-1", inertia={"value": [35.0, 22.0, 16.0], "unit": "slug ft^2"})
    before = scene.tables["body"]["inertia"]
    for value, wanted in ((20.0, 20.0), ("15 slug ft^2", 15 / 16 * before[2])):
        changed = scene.replace(**{"body.inertia[2]": value})
        assert changed.tables["body"]["inertia"] == (*before[:2], pytest.approx(wanted, rel=1e-15))
        assert scene_from(changed.to_dict()).tables["body"]["inertia"] == changed.tables["body"]["inertia"]
    parts = load("tiangong-1", inertia={"moments": [35.0, 22.0, 16.0], "products": ["1 kg m^2", 0.0, 0.0], "sign": "integral"})
    assert parts.replace(**{"body.inertia[2,2]": 20.0}).tables["body"]["inertia"] == ((35.0, -1.0, 0.0), (-1.0, 22.0, 0.0), (0.0, 0.0, 20.0))
    with pytest.raises(SceneError, match="there is no such number"):
        parts.replace(**{"body.inertia[2]": 20.0})


@pytest.mark.parametrize("value", [{"control": [1.0, 1.0, 1.0]}, {}, 5.0])
def test_a_table_is_changed_key_by_key(value: object) -> None:
    with pytest.raises(SceneError, match=r"torque = .*: a table is not replaced as a whole; set its keys one by one, as torque\.control, in Python replace"):
        load("tiangong-1").replace(torque=value)
    assert load("tiangong-1").replace(control=[1.0, 1.0, 1.0]).tables["torque"]["control"] == (1.0, 1.0, 1.0)


@pytest.mark.parametrize(("text", "shown"), [
    ("duration=3hours", '\'duration="3 h"\''), ("torque.drag=2 /minutes", "\'torque.drag=\"2 /min\"\'"), ("duration=5e1 days", '"5e1 d"'), ("duration=5 stone", '"3 h"')])
def test_a_value_with_a_unit_stands_in_quotes(text: str, shown: str) -> None:
    with pytest.raises(SceneError, match="put a value with a unit in quotes: --set ") as told:
        parse_override(text)
    assert shown in str(told.value)


@pytest.mark.parametrize(("text", "key", "value"), [
    ("tolerance=1e-9", "tolerance", 1e-9), ("torque.control=[1, 2, 3]", "torque.control", [1, 2, 3]),
    ("model=full", "model", "full"), ('model = "averaged-2"', "model", "averaged-2"), ("model=averaged-2", "model", "averaged-2"),
    ("samples=5", "samples", 5), ("torque.control[0]=1", "torque.control[0]", 1), ("body.inertia[0][1] = 2", "body.inertia[0,1]", 2),
    ("wheel[1].axis[ 2 ]=0.5", "wheel[1].axis[2]", 0.5), ('wheel.pitch.rate="3 rpm"', "wheel.pitch.rate", "3 rpm"),
])
def test_overrides_of_the_command_line(text: str, key: str, value: object) -> None:
    assert parse_override(text) == (key, value)


@pytest.mark.parametrize("text", ["tolerance", "=1", "a b=1", "drag=", "drag=1 2", "drag=1\nkind=2", "drag=[", "a..b=1", "x=" + "[" * 9999])
def test_overrides_that_cannot_be_read(text: str) -> None:
    with pytest.raises(SceneError, match="--set"):
        parse_override(text)


def test_bundled_scenes_have_names_and_sources() -> None:
    scenes = bundled()
    assert len(scenes) >= 6
    for name, file in scenes:
        scene = load(name)
        assert scene.name == file.stem and scene.source
        assert scene.kind in FAMILIES and scene.model in ("auto", *FAMILIES[scene.kind].facts.rungs)


# ---- fuzz: only SceneError ever escapes ----


def survives(text: str | bytes, folder: Path) -> None:
    file = folder / "fuzz.toml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    try:
        load(file).times
    except SceneError as error:
        assert error.mistakes and str(error)


@pytest.mark.parametrize("good", [GOOD, ROTOR, ASSEMBLED, SPINNING, HEAVY, PERIODIC])
def test_mutated_texts(good: str, tmp_path: Path) -> None:
    draw = random.Random(20260101)
    pieces = [*string.printable, "[[", "]]", "= nan", "= -inf", "1e999", "true", '"""', "{}", "[]", "\\u0000", "é", "9" * 30,
              "[solve]", "[body]", "kind", "0x", "1979-05-27", "\0", '"1 kg m^2"', '"2 deg/s"', '{ value = [1, 2, 3], unit = "s" }', " rpm"]
    lines = good.splitlines(keepends=True)
    for _ in range(at_length(250, 1000)):
        text = "".join(lines)
        for _ in range(draw.randint(1, 4)):
            i, j = sorted((draw.randrange(len(text) + 1), draw.randrange(len(text) + 1)))
            match draw.randrange(5):
                case 0:
                    text = text[:i] + draw.choice(pieces) + text[i:]
                case 1:
                    text = text[:i] + text[i + draw.randint(1, 3):]
                case 2:
                    text = text[:i] + text[j:]
                case 3:
                    text = text[:i] + text[i:j] + text[i:j] + text[j:]
                case 4:
                    shuffled = text.splitlines(keepends=True)
                    draw.shuffle(shuffled)
                    text = "".join(shuffled)
        survives(text, tmp_path)


def test_random_bytes(tmp_path: Path) -> None:
    draw = random.Random(7)
    for _ in range(300):
        survives(draw.randbytes(draw.randrange(200)), tmp_path)


values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8) | st.binary(max_size=3)
    | st.sampled_from(["auto", "full", "total", "carrier", "taylor", "deceleration", 10**400, -0.0, 1e-300, 5e-324, [1e60] * 3,
                       [1e-40] * 3, [0.6, 0.0, 0.8], 1e60, 1e-40, "3 rpm", "1e300 kg m^2", ["1 N m", 0, "2 lb ft"], {"value": [1, 2, 3], "unit": "N m"},
                       {"value": [10**400, math.nan, [True]], "unit": "s"}, {"moments": [3, 3, 3], "products": ["1 kg m^2", 0, 0], "sign": "integral"},
                       {"sequence": "3-2-1", "angles": ["1 deg", 0, 0]}, [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[1e60] * 3] * 3]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=3), max_leaves=12)
keys = st.sampled_from(sorted({field.name for family in FAMILIES.values() for fields in family.keys.values() for field in fields}))
tables = st.dictionaries(keys | st.text(max_size=6), values, max_size=6)


@settings(max_examples=at_length(40, 400), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(kind=st.sampled_from(sorted(FAMILIES)),
       data=st.dictionaries(st.sampled_from(["name", "source", *sorted({table for family in FAMILIES.values() for table in family.keys})])
                            | st.text(max_size=5), tables | values, max_size=7))
def test_random_dicts(kind: str, data: dict[str, object]) -> None:
    try:
        scene_from({"kind": kind, **data})
    except SceneError as error:
        assert str(error)


@settings(max_examples=at_length(40, 400), deadline=None)
@given(data=st.sampled_from([GOOD, ROTOR, ASSEMBLED, SPINNING, HEAVY, PERIODIC]), key=keys, value=values,
       dotted=st.sampled_from(["", "solve.", "body.", "torque.", "initial.", "carrier.", "rotor.", "motor.", "field.", "x.y."]))
def test_random_overrides(data: str, key: str, value: object, dotted: str) -> None:
    try:
        change: dict[str, Any] = {dotted + key: value}
        scene_from(tomllib.loads(data), **change)
    except SceneError as error:
        assert str(error)


@pytest.mark.parametrize("name", ["tiangong-1", "toy-top", "t-handle", "iss-torque-pulse", "intelsat-v-flat-spin"])
def test_a_key_that_was_chosen_among_alternatives_changes_as_in_a_scene_checked_anew(name: str) -> None:
    scene = load(name)
    rates = [0.01, -0.02, 0.3]
    anew = scene.to_dict()
    anew["initial"] = {**anew["initial"], "angular_velocity": rates}
    made, wanted = scene.replace(angular_velocity=rates), scene.with_data(anew)
    assert (made.tables, made.top, made.written) == (wanted.tables, wanted.top, wanted.written)
    with pytest.raises(SceneError, match="angular_velocity"):
        scene.replace(angular_velocity=[1.0, math.nan, 0.0])


def test_another_of_the_alternatives_takes_the_place_of_the_one_before() -> None:
    scene = load("t-handle")
    other = scene.replace(angular_momentum=[1e-7, 8e-4, 0.0])
    assert other.tables["initial"]["angular_velocity"] is None
    assert other.replace(angular_momentum=[2e-7, 8e-4, 0.0]).tables["initial"]["angular_momentum"] == (2e-7, 8e-4, 0.0)
    assert other.replace(angular_velocity=[0.1, 9.0, 0.2]).tables["initial"]["angular_momentum"] is None
