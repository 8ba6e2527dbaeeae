# SPDX-License-Identifier: BSD-3-Clause
"""What is asked is what is answered, whichever rung answers."""

import json
import math
from typing import Any

import numpy as np
import pytest

import gyrostat
from gyrostat.asking import AskError, parse_ask
from gyrostat.errors import DomainError, SceneError
from gyrostat.units import quantity

DEFAULT = ["angular_momentum_norm", "energy", "modulus_squared", "regime"]


def test_the_default_of_a_deceleration_is_slow_and_the_same_from_every_rung() -> None:
    for tolerance in (1e-2, 1e-3, 1e-6, 1e-9):
        answer = gyrostat.solve("tiangong-1", tolerance=tolerance)
        assert list(answer) == DEFAULT and answer.met and "stop_time" in answer.scalars


def test_a_named_rung_gives_all_it_has() -> None:
    assert list(gyrostat.solve("tiangong-1", model="averaged")) == DEFAULT
    assert list(gyrostat.solve("tiangong-1", model="full"))[:2] == ["angular_momentum", "angular_velocity"]


def test_only_what_is_asked_is_answered_and_judged() -> None:
    answer = gyrostat.solve("tiangong-1", ask=["stop_time"])
    assert list(answer) == [] and list(answer.scalars) == ["stop_time"] and answer.tolerances == {"stop_time": answer.tolerance}
    turning = gyrostat.solve("tiangong-1", ask=["angular_velocity"])
    assert list(turning) == ["angular_velocity"] and turning.met and turning.scalars == {}


def test_all_is_every_column_and_scalar() -> None:
    answer = gyrostat.solve("tiangong-1", ask="all")
    facts = gyrostat.facts.FACTS["deceleration"]
    assert list(answer) == [name for name in facts.columns if name != "attitude"]
    assert list(answer.scalars) == list(facts.scalars)
    assert "attitude" in gyrostat.solve("tiangong-1", ask="all", attitude=[0.0, 0.0, 0.0, 1.0])


def test_an_asked_quantity_stands_though_the_named_rung_lacks_it() -> None:
    answer = gyrostat.solve("tiangong-1", ask=["attitude", "energy"], model="averaged")
    assert list(answer) == ["energy", "attitude"] and np.all(np.isnan(answer["attitude"])) and np.all(np.isfinite(answer["energy"]))
    assert not answer.met and "no-value" in [warning.code for warning in answer.warnings]
    assert json.loads(answer.to_json())["columns"]["attitude"][0] == [None] * 4


def test_tolerances_of_their_own() -> None:
    degrees = gyrostat.solve("tiangong-1", ask={"attitude": "1 deg"}, tolerance=1e-9)
    assert degrees.met and degrees.tolerances == {"attitude": pytest.approx(math.pi / 180)}
    assert 1e-9 < degrees.error["attitude"] <= math.pi / 180
    seconds = gyrostat.solve("tiangong-1", ask={"stop_time": "60 s"})
    stop = seconds.scalars["stop_time"]
    assert seconds.met and seconds.tolerances["stop_time"] == pytest.approx(60 / stop)
    assert seconds.scalar_error["stop_time"] * stop <= 60
    fine = gyrostat.solve("tiangong-1", ask={"stop_time": "1 ms"})
    assert fine.met and fine.scalar_error["stop_time"] * stop <= 1e-3


def test_a_tolerance_in_the_unit_is_held_against_what_the_column_grows_to() -> None:
    for rate in ("1 deg/s", "1e-3 deg/s", "1e-6 deg/s"):
        answer = gyrostat.solve("intelsat-v-flat-spin", ask={"rotor_rate": rate})
        wanted = quantity(rate, "rad/s")
        size = max(float(np.max(np.abs(answer["rotor_rate"]))), answer.scale["rotor_rate"])
        assert answer.met == (answer.error["rotor_rate"] * size <= wanted)


def test_cheaper_for_less() -> None:
    """The slow columns alone need no phase."""
    slow, fast = gyrostat.solve("tiangong-1", tolerance=1e-3), gyrostat.solve("tiangong-1", tolerance=1e-3, ask="all")
    assert slow.model == "averaged" and fast.model == "full" and slow.counts["rhs"] < fast.counts["rhs"]


def test_a_sweep_meets_no_missing_name() -> None:
    for i in range(60):
        made = gyrostat.solve("tiangong-1", samples=3, **{"torque.drag": 1e-5 * 1.3**i % 1e-3, "body.inertia": [80000.0 + 3 * i, 78000.0, 20000.0 + 900 * i]})
        assert list(made) == DEFAULT and {"stop_time"} <= set(made.scalars)


@pytest.mark.parametrize(("ask", "text"), [
    (["atitude"], "did you mean attitude"), (["all", "attitude"], 'write "all" alone'),
    ([], "nothing is asked"),
    ({"attitude": "1 kg"}, "its unit is rad"),
    ({"attitude": -1.0}, "> 0"),
    ({"stop_time": "soon"}, "number"),
    ({"stop_time": "1 parsec"}, "no unit parsec"),
    ({"angular_momentum": 2.0}, "below 1"),
    ({"regime": 0.1}, "no error"),
    ("attitude=1kg", "its unit is rad"), ("atitude", "did you mean attitude"), (" , ", "nothing is asked"), ("all, attitude", 'write "all" alone'), (3, "array of names"),
    (["energy", "energy"], "twice"),
])
def test_a_wrong_question_says_what_would_be_right(ask: Any, text: str) -> None:
    with pytest.raises(SceneError, match="solve.ask") as caught:
        gyrostat.solve("tiangong-1", ask=ask)
    assert text in str(caught.value)


@pytest.mark.parametrize(("text", "ask"), [
    ("stop_time", ["stop_time"]), ("stop_time, energy", ["stop_time", "energy"]), ("stop_time=60 s, energy", {"stop_time": "60 s", "energy": "default"}),
])
def test_one_text_asks_as_names_and_tolerances_do(text: str, ask: Any) -> None:
    one, other = gyrostat.solve("tiangong-1", ask=text), gyrostat.solve("tiangong-1", ask=ask)
    assert list(one) == list(other) and one.scalars == other.scalars and one.error == other.error and one.model == other.model


def test_the_attitude_of_a_heavy_body_needs_that_of_the_start() -> None:
    with pytest.raises((DomainError, SceneError), match="attitude"):
        gyrostat.solve("toy-top", ask=["attitude"], **{"initial.down": [0.0, 0.6, 0.8]})


def test_what_is_asked_twice_on_the_command_line_is_refused() -> None:
    with pytest.raises(AskError, match="attitude is there twice"):
        parse_ask("attitude=0.1deg, attitude=1deg")


@pytest.mark.parametrize(("text", "ask"), [
    ("all", "all"), ("stop_time", ["stop_time"]), ("attitude=0.1deg, stop_time", {"attitude": "0.1deg", "stop_time": ""})])
def test_the_command_line_reads_what_is_asked(text: str, ask: Any) -> None:
    assert parse_ask(text) == ask


def test_what_only_scenes_of_another_kind_have() -> None:
    with pytest.raises(SceneError, match="tilt_max in scenes of the kind general; those of the kind spinning have it"):
        gyrostat.solve("iss-drift", ask="tilt_max")
