# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with units: exact, of the right dimension or refused with a remedy, wherever a scene has a number."""

import json
import math
import random
import re
import tomllib
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ASSEMBLED, GOOD, HEAVY, PERIODIC, ROTOR, SPINNING, at_length
from gyrostat.cli import main
from gyrostat.errors import Refused, SceneError
from gyrostat.families import FAMILIES
from gyrostat.fields import Field
from gyrostat.overriding import parse_override
from gyrostat.scenes import bundled, load, scene_from
from gyrostat.schema import schema
from gyrostat.toml_text import toml_text
from gyrostat.units import PATTERN, UNITS, quantity, split, to_si
from test_schema import accepts

import gyrostat

# By definition: the international yard and pound of 1959, standard gravity of 1901, the Julian year, the astronomical unit of 2012.
POUND, FOOT, GRAVITY = Fraction(45359237, 10**8), Fraction(3048, 10**4), Fraction(980665, 10**5)
SIZES: dict[str, dict[str, Any]] = {
    "m": {"m": 1, "km": 1000, "cm": "1e-2", "mm": "1e-3", "um": "1e-6", "in": FOOT / 12, "ft": FOOT, "mi": 5280 * FOOT, "nmi": 1852, "au": 149597870700},
    "kg": {"kg": 1, "g": "1e-3", "t": 1000, "mg": "1e-6", "lb": POUND, "oz": POUND / 16, "slug": POUND * GRAVITY / FOOT},
    "s": {"s": 1, "ms": "1e-3", "us": "1e-6", "min": 60, "h": 3600, "d": 86400, "yr": Fraction("365.25") * 86400},
    "rad": {"rad": 1, "mrad": "1e-3", "urad": "1e-6"},
    "kg m/s^2": {"N": 1, "mN": "1e-3", "uN": "1e-6", "kN": 1000, "lbf": POUND * GRAVITY, "ozf": POUND * GRAVITY / 16, "kgf": GRAVITY},
    "N m": {"J": 1, "mJ": "1e-3", "kJ": 1000}, "J/s": {"W": 1}, "N/A m": {"T": 1, "mT": "1e-3", "uT": "1e-6", "nT": "1e-9", "G": "1e-4"},
    "C/s": {"A": 1, "mA": "1e-3"}, "A s": {"C": 1}, "W/A": {"V": 1}, "A/V": {"S": 1},
}
TURNS = {"deg": 180, "°": 180, "arcmin": 180 * 60, "arcsec": 180 * 3600, "rev": Fraction(1, 2), "rpm": 30}  # that are pi rad, or pi rad/s


def test_every_unit_has_its_exact_size() -> None:
    for like, sizes in SIZES.items():
        for name, size in sizes.items():
            assert quantity(f"1 {name}", like) == float(Fraction(size)), name
    for name, half in TURNS.items():
        assert to_si(Fraction(half), name, "rad/s" if name == "rpm" else "rad") == math.pi, name
    assert set(UNITS) == {name for sizes in SIZES.values() for name in sizes} | set(TURNS)


@pytest.mark.parametrize(("text", "want", "value"), [
    ("3000 rpm", "rad/s", 100 * math.pi), ("10deg", "rad", math.pi / 18), ("35 kg cm^2", "kg m^2", 0.0035), ("35 kg cm2", "kg m^2", 0.0035),
    ("35 kg·cm²", "kg m^2", 0.0035), ("35kg*cm^2", "kg m^2", 0.0035), ("1.5 N.m.s", "N m s", 1.5), ("2 slug ft^2", "kg m^2", 2 * 1.3558179483314004),
    ("3 lb in^2", "kg m^2", 3 * 0.45359237 * 0.0254**2), ("1 lbf ft", "N m", 1.3558179483314004), ("1 A m^2 T", "N m", 1.0), ("2 S m^4 T^2/s", "N m", 2.0),
    ("360 deg/h", "rad/s", math.pi / 1800), ("86400 rev/d", "rad/s", 2 * math.pi), ("2 mN m s/rad", "N m s/rad", 2e-3), ("2 mN m s", "N m s/rad", 2e-3),
    ("1 mN m/rpm", "N m s/rad", 0.03 / math.pi), ("3 1/h", "1/s", 1 / 1200), ("3 /h", "1/s", 1 / 1200), ("2 s⁻¹", "1/s", 2.0), ("2 s^-1", "1/s", 2.0),
    ("-.5e1 km", "m", -5000.0), ("+5. mm", "m", 0.005), ("1 m/s s", "m/s^2", 1.0), ("4 rad", "rad", 4.0), ("0.1 1/s", "rad/s", 0.1),
    ("12", "kg", 12.0), ("5 %", "", 0.05), ("20 ppm", "1", 2e-5), ("1e999 kg", "kg", math.inf), ("-1e999 kg", "kg", -math.inf),
])
def test_units_are_read(text: str, want: str, value: float) -> None:
    assert quantity(text, want) == pytest.approx(value, rel=4e-16)


def test_a_decimal_is_taken_as_it_is_written() -> None:
    draw = random.Random(11)
    for _ in range(500):
        number = f"{draw.randrange(10**6)}.{draw.randrange(10**6):06}"
        assert quantity(f"{number} mm", "m") == float(number + "e-3") and quantity(f"{number} t", "kg") == float(number + "e3")


def test_the_pattern_is_what_is_read() -> None:
    """What the JSON Schema takes for a number with a unit is what the parser does."""
    draw = random.Random(12)
    pieces = ["1", "20", ".5", "3.", "-", "e5", " ", " ", "/", "*", ".", "·", "m", "kg", "s", "ms", "rad", "°", "^2", "^-1", "²", "⁻³", "2", "0", "x", "(", "**", "min", "N"]
    good = 0
    for _ in range(at_length(15000, 30000)):
        text = draw.choice(["", "5 ", "1.5", "-2e3 "]) + "".join(draw.choice(pieces) for _ in range(draw.randrange(1, 6)))
        try:
            _, unit = split(text)
            to_si(Fraction(1), unit, unit)
            right = unit != ""
        except Refused:
            right = False
        assert (re.search(PATTERN, text) is not None) == right, text
        good += right
    assert good > 1000


# ---- in scenes ----

TEXTS = {"deceleration": GOOD, "rotor": ROTOR, "assembled": ASSEMBLED, "spinning": SPINNING, "heavy": HEAVY, "periodic": PERIODIC}
# A scene, the key and what is given for it, and what the message must contain.
MISTAKES: dict[str, tuple[str, str, Any, list[str]]] = {
    "no unit": ("deceleration", "torque.drag", "2", ['torque.drag = "2"', "without a unit", "(1/s) without quotes", '"2 1/s"']),
    "no number": ("deceleration", "torque.drag", "two 1/s", ["does not begin with a number", "12.5 mm"]),
    "not finite": ("deceleration", "torque.drag", "nan 1/s", ["does not begin with a number"]),
    "too large": ("deceleration", "torque.drag", "1e999 1/s", ["not finite"]),
    "out of range": ("deceleration", "torque.drag", "-2 1/s", ["out of range", ">= 0"]),
    "angle where none belongs": ("deceleration", "torque.drag", "2 deg/s", ["its unit is 1/s, not deg/s", "no such angle", "write it in 1/s"]),
    "angle in a momentum": ("deceleration", "body.rotor_momentum", ["1 N m s/rad", 0, 0], ["element 1", "its unit is N m s, not N m s/rad", "no such angle"]),
    "an angle for a rate": ("rotor", "initial.rotor_rate", "90 deg", ["its unit is rad/s, not deg", "rad/s"]),
    "a rate of no angle": ("rotor", "motor.no_load_rate", "3000 1/min", ["1/min does not say which angle", "rpm"]),
    "hertz": ("rotor", "motor.no_load_rate", "50 Hz", ["no unit Hz", "turns or radians", "rev/s"]),
    "kilohertz": ("rotor", "motor.no_load_rate", "5 kHz", ["no unit kHz", "rev/s"]),
    "capitals": ("rotor", "motor.no_load_rate", "50 RPM", ["no unit RPM", "did you mean rpm?"]),
    "plural": ("rotor", "motor.no_load_rate", "50 degs/s", ["no unit degs", "write deg"]),
    "commas": ("rotor", "motor.no_load_rate", "3,000 rpm", ["commas", "3000"]),
    "a comma for a point": ("rotor", "motor.no_load_rate", "0,5 rpm", ["commas", "0.5"]),
    "pounds for a torque": ("deceleration", "torque.control", [0, "1 lb ft", 0], ["element 2", "not lb ft", "lb is a mass: write lbf ft"]),
    "ounces for a torque": ("spinning", "torque.body", ["1 oz in", 0, 0], ["oz is a mass: write ozf in"]),
    "kilograms for a force": ("spinning", "torque.force", [0, 0, "40 kg"], ["kg is a mass: write kgf"]),
    "force for a mass": ("spinning", "body.mass", "22 lbf", ["lbf is a force: write lb"]),
    "names run together": ("deceleration", "torque.control", ["1 mNm", 0, 0], ["no unit mNm", "write mN m"]),
    "three run together": ("deceleration", "body.rotor_momentum", ["1 Nms", 0, 0], ["no unit Nms", "write N m s"]),
    "run together, of another dimension": ("spinning", "torque.body", ["1 lbft", 0, 0], ["no unit lbft", "write lbf ft, with blanks"]),
    "a mass for a force, run together": ("spinning", "torque.body", ["1 in-lb", 0, 0], ["no unit in-lb", "write in lbf, with blanks"]),
    "a prefix that is none, not a product": ("deceleration", "initial.angular_velocity", ["1 mdeg/s", 0, 0], ["no unit mdeg", "write it in rad/s"]),
    "gradians": ("deceleration", "initial.angular_velocity", ["1 grad/s", 0, 0], ["no unit grad", "0.9 deg"]),
    "run together with a power": ("deceleration", "body.inertia", ["35 kgm^2", 22, 16], ["no unit kgm", "write kg m^2, with blanks"]),
    "joined by hyphens": ("deceleration", "torque.control", ["1 N-m", 0, 0], ["no unit N-m", "write N m, with blanks"]),
    "seconds by another name": ("rotor", "motor.no_load_rate", "2 deg/sec", ["no unit sec", "write deg/s"]),
    "both by words": ("rotor", "motor.no_load_rate", "2 Degrees/second", ["no unit Degrees", "write deg/s"]),
    "days": ("deceleration", "solve.duration", "2 days", ["no unit days", "write d"]),
    "an hour": ("deceleration", "solve.duration", "1 hour", ["no unit hour", "write h"]),
    "minutes": ("deceleration", "solve.duration", "5 minutes", ["no unit minutes", "write min"]),
    "two slashes": ("rotor", "motor.slope", "1 N m/rad/s", ["second /", "N m s/rad"]),
    "brackets": ("rotor", "motor.slope", "1 N m/(rad/s)", ["brackets", "N m s/rad"]),
    "stars": ("assembled", "carrier.inertia", ["2 kg m**2", 2, 2], ["element 1", "**", "m^2"]),
    "a fraction for a power": ("assembled", "rotor.offset", [0, 0, "1 m^0.5"], ["element 3", "m^0 is no power", "m^2"]),
    "nothing below": ("heavy", "field.gravity", "9.8 m/", ["factor is missing"]),
    "an unknown unit": ("heavy", "body.mass", "3 stone", ["no unit stone", "write it in kg, g, t, mg, lb, oz, slug, or in another unit"]),
    "an unknown unit of a product": ("deceleration", "torque.drag", "3 ticks", ["no unit ticks", "write it in 1/s", "the units are m, km"]),
    "another power of ten": ("heavy", "body.mass", "3 Mg", ["no unit Mg", "write it in kg, g, t"]),
    "a near name of what measures something else": ("deceleration", "torque.control", ["1 kW", 0, 0], ["no unit kW", "write it in N m, J"]),
    "a longer name of what measures something else": ("deceleration", "torque.control", ["1 Wb", 0, 0], ["no unit Wb", "write it in N m, J"]),
    "share": ("heavy", "body.mass", "3 %", ["its unit is kg, not %"]),
    "unit of a direction": ("heavy", "initial.down", [0, 0, "1 m"], ["element 3", "has no unit", "without quotes"]),
    "unit of a quaternion": ("deceleration", "initial.attitude", [0, 0, 0, "1 rad"], ["element 4", "has no unit"]),
    "unit of a cosine": ("heavy", "initial.periodic", {"spin": "9 rpm", "cos_inclination": "1 rad"}, ["cos_inclination", "has no unit"]),
    "unit of a count": ("deceleration", "solve.samples", "11", ["text, not an integer"]),
    "unit of a tolerance": ("deceleration", "solve.tolerance", "1 deg", ["has no unit"]),
    "a tolerance that is no share": ("deceleration", "solve.tolerance", "1 %%", ["has no unit"]),
    "share over the greatest tolerance": ("deceleration", "solve.tolerance", "60 %", ["out of range"]),
    "times that fall": ("deceleration", "solve.times", ["1 min", 59.0], ["element 2 = 59.0", "increasing"]),
    "table without a unit": ("deceleration", "torque.control", {"value": [1, 2, 3]}, ["keys value and unit, not value", 'unit = "N m"']),
    "table with an unknown key": ("deceleration", "torque.control", {"value": [1, 2, 3], "units": "N m"}, ["not value, units", 'unit = "N m"']),
    "table of one number": ("deceleration", "torque.control", {"value": 1, "unit": "N m"}, ["value is an integer, not an array"]),
    "table of texts": ("deceleration", "torque.control", {"value": ["1 N m", 0, 0], "unit": "N m"}, ['the text "1 N m"', "numbers alone"]),
    "table with a number for a unit": ("deceleration", "torque.control", {"value": [1, 2, 3], "unit": 3}, ["unit is 3", 'unit = "N m"']),
    "table that is not finite": ("deceleration", "torque.control", {"value": [1, math.nan, 10**5000], "unit": "N m"}, ["element 2 = nan is not finite"]),
    "table in a wrong unit": ("deceleration", "body.inertia", {"value": [1, 2, 3], "unit": "kg m"}, ["element 1", "its unit is kg m^2, not kg m"]),
    "products without a sign": ("deceleration", "body.inertia", {"moments": [3, 3, 3], "products": [1, 0, 0]},
                                ["the key sign is missing", '"tensor"', '"integral"', "negatives"]),
    "products of another sign": ("deceleration", "body.inertia", {"moments": [3, 3, 3], "products": [1, 0, 0], "sign": "-"}, ["use one of tensor, integral"]),
    "products without moments": ("deceleration", "body.inertia", {"products": [1, 0, 0], "sign": "tensor"}, ["the key moments is missing"]),
    "products of a spinner": ("spinning", "body.inertia", {"moments": [8, 7, 11], "products": [1, 0, 0], "sign": "tensor"}, ["products of inertia are not zero"]),
}


@pytest.mark.parametrize("label", MISTAKES)
def test_a_mistake_with_units_says_what_would_be_right(label: str) -> None:
    text, key, value, wanted = MISTAKES[label]
    with pytest.raises(SceneError) as caught:
        scene_from(tomllib.loads(TEXTS[text]), **{key: value})
    message = str(caught.value)
    for part in [key, *wanted]:
        assert part in message


def test_a_mistake_is_named_with_its_line(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(ROTOR.replace("no_load_rate = 30.0", 'no_load_rate = "30 rpm s"'))
    with pytest.raises(SceneError, match=rf'{file}:21: motor.no_load_rate = "30 rpm s": its unit is rad/s, not rpm s; write it in rad/s'):
        load(file)


# A unit for each unit of a key, and the power of ten by which its numbers are greater.
OTHERS = {"kg m^2": ("kg cm^2", 4), "N m s": ("mN m s", 3), "N m": ("N mm", 3), "1/s": ("1/ms", -3), "rad/s": ("mrad/s", 3), "kg": ("g", 3),
          "m": ("km", -3), "s": ("ms", 3), "N": ("kN", -3), "m/s": ("mm/s", 3), "N m s/rad": ("J ms/mrad", 0), "rad": ("mrad", 3),
          "m/s^2": ("cm/s^2", 2), "1/s^2": ("1/ms^2", -6), "C": ("A ms", 3), "T": ("G", 4)}


def restated(field: Field, value: Any, as_table: bool) -> Any:
    """A value in other units."""
    if field.form in ("record", "records"):
        one = field.form == "record"
        made = [{part.name: restated(part, item[part.name], as_table) for part in field.parts if part.name in item} for item in ([value] if one else value)]
        return made[0] if one else made
    if field.unit not in OTHERS:
        return value
    unit, power = OTHERS[field.unit]

    def other(item: Any, made: Callable[[Decimal], Any]) -> Any:
        return [other(each, made) for each in item] if isinstance(item, list) else made(Decimal(repr(item)).scaleb(power))

    table = {"value": other(value, float), "unit": unit}
    exact = other(table["value"], lambda number: number.scaleb(-power)) == other(value, lambda number: number)  # no digit was lost
    return table if as_table and isinstance(value, list) and exact else other(value, lambda number: f"{number} {unit}")


def in_other_units(name: str, as_table: bool) -> dict[str, Any]:
    """A bundled scene, each number that has a unit in another one."""
    given = tomllib.loads(dict(bundled())[name].read_text())
    keys = FAMILIES[given["kind"]].keys
    told = {**given, **{field.name: restated(field, given[field.name], as_table) for field in keys[""] if field.name in given}}
    for table in set(told) & set(keys) - {""}:
        told[table] = {field.name: restated(field, given[table][field.name], as_table) for field in keys[table] if field.name in given[table]}
    return told


@pytest.mark.parametrize("as_table", [False, True])
def test_every_bundled_scene_is_the_same_in_other_units_to_the_bit(as_table: bool) -> None:
    for name, _ in bundled():
        scene = load(name)
        if scene.written:
            assert scene.kind == "general" or scene.vary
            continue  # it has its units already
        told = in_other_units(name, as_table)
        other = scene_from(told)
        assert other.tables == scene.tables and other.top == scene.top and np.array_equal(other.times, scene.times), name
        assert accepts(schema(), told) and other.written
        again = scene_from(other.to_dict())
        assert again.to_dict() == other.to_dict() and again.tables == scene.tables
        assert all(other.to_dict()["body"][key] == value for key, value in told.get("body", {}).items())


@pytest.mark.usefixtures("few_members")
@pytest.mark.parametrize("name", ["near-separatrix", "intelsat-v-flat-spin", "spinning-paper", "toy-top", "tumbling-brick"])
def test_a_scene_in_other_units_is_answered_drawn_exported_and_shown(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(toml_text(in_other_units(name, True)))
    change = ["--set", 'initial.rotation_vector=["80 deg", "-0.2 rev", 0.4]']
    if name == "toy-top":
        change += ["--set", 'angular_velocity=["10 deg/s", 0, "20 rev/s"]']
    assert main(["solve", str(file), *change, "--plot", str(tmp_path / "answer.png"), "-o", str(tmp_path / "answer.csv")]) == 0
    assert main(["view", str(file), *change, "-o", str(tmp_path / "view.html")]) == 0
    if name == "tumbling-brick":
        assert main(["chart", str(file), *change, "-o", str(tmp_path / "chart")]) == 0
    if FAMILIES[load(name).kind].part("stability"):
        assert main(["stability", str(file), *change]) == 0
    shown = load(file, rotation_vector=["80 deg", 0, 0])._repr_html_()
    assert "80 deg" in shown
    capsys.readouterr()


def test_units_with_angles_agree_to_rounding() -> None:
    scene = scene_from(tomllib.loads(ROTOR), no_load_rate="3000 rpm", angular_velocity=["30 deg/s", "60 deg/min", 0.1], slope="0.5 mN m/rpm")
    assert scene.tables["motor"] == {"slope": pytest.approx(0.015 / math.pi, rel=4e-16), "no_load_rate": pytest.approx(100 * math.pi, rel=4e-16)}
    assert scene.tables["initial"]["angular_velocity"] == pytest.approx((math.pi / 6, math.pi / 180, 0.1), rel=4e-16)


def test_products_of_inertia_have_the_sign_that_is_named() -> None:
    data = tomllib.loads(GOOD)
    inertia = {"moments": ["3 kg m^2", 4, 5], "products": {"value": [1000, 2000, 3000], "unit": "kg cm^2"}}
    for sign, s in (("tensor", 1), ("integral", -1)):
        scene = scene_from(data, inertia={**inertia, "sign": sign})
        assert scene.tables["body"]["inertia"] == ((3.0, s * 0.1, s * 0.2), (s * 0.1, 4.0, s * 0.3), (s * 0.2, s * 0.3, 5.0))
        assert scene.to_dict()["body"]["inertia"] == {**inertia, "sign": sign} and accepts(schema(), scene.to_dict())
    assert not accepts(schema(), {**data, "body": {"inertia": inertia}})
    spinner = {"moments": [8, 7, 11], "products": [0, 0, 0], "sign": "tensor"}
    assert scene_from(tomllib.loads(SPINNING), inertia=spinner).tables["body"]["inertia"] == (8.0, 7.0, 11.0)


def test_an_answer_keeps_the_units_of_its_scene() -> None:
    given = {"torque.drag": "0.72 1/h", "body.inertia": {"value": [35e4, 22e4, 16e4], "unit": "kg cm^2"}, "duration": "2 min", "samples": 5}
    answer = gyrostat.solve(tomllib.loads(GOOD), **given)
    twin = gyrostat.solve(tomllib.loads(GOOD), drag=2e-4, duration=120.0, samples=5)
    for name in answer:
        assert np.array_equal(answer[name], twin[name])
    told = json.loads(answer.to_json())["scene"]
    assert told["torque"]["drag"] == "0.72 1/h" and told["body"]["inertia"] == given["body.inertia"] and told["solve"]["duration"] == "2 min"
    assert twin.scene["torque"]["drag"] == 2e-4


def test_a_changed_key_forgets_its_unit() -> None:
    scene = scene_from(tomllib.loads(GOOD), drag="0.72 1/h", duration="2 min", samples=3)
    assert scene.replace(tolerance=1e-8).to_dict()["torque"]["drag"] == "0.72 1/h"  # alone, and with the whole
    assert scene.replace(duration="60 s", samples=3).to_dict()["torque"]["drag"] == "0.72 1/h"
    assert scene.replace(drag=1e-4).to_dict()["torque"]["drag"] == 1e-4
    assert scene.replace(drag="1 1/d").tables["torque"]["drag"] == 1 / 86400
    assert scene.replace(times=[1.0]).to_dict()["solve"]["times"] == [1.0]
    with pytest.raises(SceneError, match="not kg"):
        scene.replace(drag="1 kg")


def test_wheels_have_units() -> None:
    wheels = [{"axis": [0, 0, 1], "axial_inertia": "35 kg cm^2", "rate": "3000 rpm"}, {"axis": [0, 1, 0], "axial_inertia": 0.01, "rate": 2, "type": "free"}]
    scene = load("tumbling-brick", wheel=wheels)
    assert scene.top["wheel"][0] == {"axis": (0.0, 0.0, 1.0), "axial_inertia": 0.0035, "rate": pytest.approx(100 * math.pi, rel=4e-16), "type": "held"}
    assert scene.to_dict()["wheel"] == [{**wheels[0], "type": "held"}, wheels[1]]
    assert scene_from(scene.to_dict()).top == scene.top
    with pytest.raises(SceneError, match=r'wheel\[0\]: rate = "1 Hz": there is no unit Hz'):
        load("tumbling-brick", wheel=[{**wheels[0], "rate": "1 Hz"}])


@pytest.mark.parametrize("given", ["no_load_rate=3000 rpm", 'no_load_rate="3000 rpm"', "motor.no_load_rate=3000rpm"])
def test_the_command_line_takes_units(given: str, rotor_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(rotor_file), "--set", given, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["scene"]["motor"]["no_load_rate"] in ("3000 rpm", "3000rpm")


def test_what_has_a_unit_varies() -> None:
    pytest.importorskip("scipy")
    data = {**tomllib.loads(GOOD), "vary": {"n": 4, "body.inertia[0]": "normal(35e4 kg cm^2, 1%)", "torque.drag": "[0.72 1/h, 1.44 1/h]"}}
    with_units = gyrostat.sweep(data, inertia={"value": [35e4, 22e4, 16e4], "unit": "kg cm^2"}, ask=["stop_time"])
    bare = gyrostat.sweep({**data, "vary": {"n": 4, "body.inertia[0]": "normal(35, 1%)", "torque.drag": [2e-4, 4e-4]}}, ask=["stop_time"])
    assert np.array_equal(with_units["stop_time"], bare["stop_time"]) and np.array_equal(with_units["body.inertia[0]"], bare["body.inertia[0]"])
    for how, what in (("normal(35 kg, 1%)", "its unit is kg m"), ("[1 Hz]", "no unit Hz")):
        with pytest.raises(SceneError, match=what):
            scene_from({**data, "vary": {"n": 2, "body.inertia[0]": how}})


def test_the_schema_refuses_what_no_unit_looks_like() -> None:
    data = tomllib.loads(GOOD)
    for drag, right in (("2 1/h", True), ("2", False), ("2 Hz", False), ("1/s", True), ("s", False), ("2 1/s/s", False), ("2 deg/s", True)):  # not what it measures
        assert accepts(schema(), {**data, "torque": {**data["torque"], "drag": drag}}) == right
    for start, right in ({"down": ["1 m", 0, 0]}, False), ({"attitude": [0, 0, 0, "1 rad"]}, False), ({"mrp": [0, 0, "1 rad"]}, False):
        assert accepts(schema(), {**tomllib.loads(HEAVY), "initial": {"angular_velocity": ["1 rpm", 0, 0], **start}}) == right


def test_a_tolerance_may_be_a_share() -> None:
    scene = load("tiangong-1", tolerance="0.1 %")
    assert scene.tolerance == 1e-3 and scene.to_dict()["solve"]["tolerance"] == "0.1 %"
    assert load("tiangong-1", tolerance="10 ppm").tolerance == 1e-5
    answer = gyrostat.solve(scene)
    assert answer.tolerance == 1e-3 and answer.model == gyrostat.solve("tiangong-1", tolerance=1e-3).model
    assert parse_override("tolerance=0.1%") == ("tolerance", "0.1%") and scene.replace(tolerance="0.1%").tolerance == 1e-3


def test_a_word_for_an_angle_where_a_rate_is_wanted() -> None:
    with pytest.raises(SceneError, match="there is no unit degs; write deg/s"):
        gyrostat.solve("tiangong-1", angular_velocity=["2.5 degs", 0, 0])
