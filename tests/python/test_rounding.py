# SPDX-License-Identifier: BSD-3-Clause
"""What rounding of the data makes of an answer."""

import json
import math
from typing import Any

import pytest

import gyrostat
from gyrostat.cli import main
from gyrostat.rounding import MOST, data_error

HALF = 2.0**-53


def free(**start: Any) -> dict[str, Any]:
    return {"name": "free", "kind": "free", "body": {"inertia": [3.0, 4.0, 5.0]}, "initial": {"angular_velocity": [0.0, 0.0, 2.0], **start},
            "solve": {"times": [0.0, 500.0, 1000.0], "ask": "all"}}


def test_a_steady_rotation_is_off_by_its_angle_times_the_rounding_of_its_rate() -> None:
    answer = gyrostat.solve(free(), data_error=True)
    data = answer.data_error
    assert data is not None
    assert data.effect["attitude"] == pytest.approx(2000 * HALF, rel=1e-3)
    assert data.mostly["attitude"] == "initial.angular_velocity[2]"
    assert data.effect["energy"] == pytest.approx(3 * HALF, rel=0.05)  # of the square of the rate, and the moment
    assert data.effect["angular_momentum_inertial"] == pytest.approx(2 * HALF, rel=0.05)
    assert data.effect["attitude"] <= answer.error["attitude"]
    assert gyrostat.solve(free()).data_error is None


@pytest.mark.parametrize("scene", ["toy-top", "tiangong-1", "flat-sail", "intelsat-v-flat-spin", "t-handle", "iss-torque-pulse", "wheel-seized"])
def test_what_the_data_do_is_within_the_stated_error(scene: str) -> None:
    answer = gyrostat.solve(scene, data_error=True)
    assert answer.data_error is not None
    for name, effect in answer.data_error.effect.items():
        assert effect <= {**answer.error, **answer.scalar_error}[name] or effect < 4 * HALF
    assert any(effect > 0 for effect in answer.data_error.effect.values())


def test_what_is_equal_stays_equal() -> None:
    tops = gyrostat.load("toy-top")
    answer = gyrostat.solve(tops, model="exact", data_error=True)
    assert answer.data_error is not None
    assert all(map(math.isfinite, answer.data_error.effect.values()))  # a top of three moments has no closed form


def test_a_change_that_is_not_in_proportion_is_not_told() -> None:
    far = gyrostat.solve(free(angular_velocity=[0.0, 0.0, 2.0]) | {"solve": {"times": [0.0, 1e15], "tolerance": 0.5, "ask": ["energy", "attitude"]}}, model="closed-form")
    assert data_error(gyrostat.scenes.scene_from(far.scene), far).effect["attitude"] == math.inf


def test_a_long_table_moves_some_numbers_at_once() -> None:
    times = [float(i) for i in range(300)]
    scene = {"name": "table", "kind": "general", "body": {"inertia": [3.0, 4.0, 5.0]}, "initial": {"angular_velocity": [0.1, 0.2, 0.3]},
             "torque": [{"type": "table", "times": times, "values": [[1e-3 + 1e-6 * i, 0.0, 0.0] for i in range(300)]}], "solve": {"times": [10.0]}}
    checked = gyrostat.scenes.scene_from(scene)
    shares: list[float] = []
    made = data_error(checked, gyrostat.solve(checked), told=shares.append)
    assert len(shares) == MOST
    assert shares[-1] == 1
    assert 0 < made.effect["angular_velocity"] < 1e-14


def test_a_torque_of_ones_own_is_no_number() -> None:
    scene = {"name": "own", "kind": "general", "body": {"inertia": [3.0, 4.0, 5.0]}, "initial": {"angular_velocity": [0.1, 0.2, 0.3]}, "solve": {"times": [1.0]}}
    with pytest.raises(gyrostat.DomainError, match="torque of your own"):
        gyrostat.solve(scene, torque=lambda *_: (0.0, 0.0, 0.0), data_error=True)


def test_the_command_tells_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "t-handle", "--data-error"]) == 0
    text = capsys.readouterr().out
    assert "of one rounding of the data" in text
    assert "body.inertia[0]" in text
    assert main(["solve", "t-handle", "--data-error", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["data_error"]
    assert told["attitude"]["mostly"] == "initial.angular_velocity[1]"
    assert main(["solve", "t-handle", "--json"]) == 0
    assert "data_error" not in json.loads(capsys.readouterr().out)
