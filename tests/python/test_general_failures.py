# SPDX-License-Identifier: BSD-3-Clause
"""Where general scenes go wrong: docs/general.md, section 4, row by row, as far as no other test has it."""

import math
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import at_length
from gyrostat import DomainError
from gyrostat.rotation import matrix_from_quaternion

BODY: dict[str, Any] = {"inertia": [3.0, 2.5, 2.0]}
START: dict[str, Any] = {"angular_velocity": [0.3, -0.5, 0.8]}


def scene(**changes: Any) -> dict[str, Any]:
    return {"name": "test", "kind": "general", "solve": {"times": [0.0, 3.0, 10.0], "tolerance": 1e-9}, "body": BODY, "initial": START, **changes}


def test_a_body_lighter_than_its_wheel_loses_digits_and_says_so() -> None:
    # I = 2 of J = 2 + left: M is told to a rounding, the rate about that axis to a rounding of M over what is left
    errors = []
    for left in (1.0, 1e-3):
        wheel = {"type": "free", "axis": [0.6, 0.0, 0.8], "axial_inertia": 2.0, "rate": 5.0}
        u = np.array(wheel["axis"])
        body = 25.0 * (np.eye(3) - np.outer(u, u)) + (2 + left) * np.outer(u, u)
        made = gyrostat.solve(scene(body={"inertia": body.tolist()}, wheel=[wheel], solve={"times": [5.0], "model": "full", "tolerance": 1e-10}), ask=["angular_velocity"])
        errors.append(made.error["angular_velocity"])
    assert errors[1] > 2.0**-52 * 25 / 1e-3
    with pytest.raises(DomainError, match="more than that of its wheels"):
        gyrostat.solve(scene(body={"inertia": [3.0, 2.5, 2.0]}, wheel=[{**wheel, "axis": [0, 0, 1]}]))


@pytest.mark.parametrize("settling", [1e2, 1e6, 1e11])
def test_wheels_that_settle_in_a_moment_cost_no_more_than_slow_ones(settling: float) -> None:
    wheels = [{"type": "friction", "axis": axis, "axial_inertia": 0.05, "rate": 0.0, "friction": 0.05 * settling} for axis in ([1, 1, 0], [0, 1, -1])]
    made = gyrostat.solve(scene(wheel=wheels, solve={"times": [0.0, 30.0], "tolerance": 1e-8}))
    assert made.met and made.counts["steps"] < 2000
    # in the limit they are part of the body
    limit = gyrostat.solve(scene(solve={"times": [0.0, 30.0], "tolerance": 1e-10}))
    assert np.allclose(made["angular_velocity"], limit["angular_velocity"], atol=30 / settling)


def test_a_wave_whose_phase_is_lost_is_refused() -> None:
    torque = {"type": "constant", "torque": [0.01, 0.0, 0.0], "factor": {"amplitude": 1.0, "rate": 1e9}}
    with pytest.raises(DomainError, match="1e8 rad"):
        gyrostat.solve(scene(torque=[torque]))


@pytest.mark.parametrize("law", ["total", "carrier"])
def test_a_body_that_a_brake_stops_against_another_torque_rests_where_that_is_known(law: str) -> None:
    torques: list[dict[str, Any]] = [{"type": "brake", "limit": [0.5, 0.5, 0.5], "law": law}, {"type": "constant", "frame": "inertial", "torque": [0.01, 0.0, 0.0]}]
    made = gyrostat.solve(scene(torque=torques, solve={"times": [1.0, 1e3], "tolerance": 1e-9}), ask=["attitude", "angular_velocity", "torque", "stop_time"])
    assert made.met and not np.any(made["angular_velocity"][1]) and not np.any(made["torque"][1])
    assert [warning.code for warning in made.warnings] == ["rest"] and 1.0 < made.scalars["stop_time"] < 1e3
    late = {"factor": {"amplitude": 1.0, "rate": 0.1}}
    with pytest.raises(DomainError, match="is not followed"):
        gyrostat.solve(scene(torque=[torques[0], {**torques[1], **late}], solve={"times": [1.0, 1e3], "tolerance": 1e-9}))
    assert gyrostat.solve(scene(torque=[torques[0], {**torques[1], **late}], solve={"times": [0.0, 1.0], "tolerance": 1e-9})).met


RAMP: dict[str, Any] = {"times": [0.0, 100.0], "values": [0.0, 1.0]}


@pytest.mark.parametrize("law", ["total", "carrier"])
@pytest.mark.parametrize("ramp", [{"type": "constant", "torque": [0.0, 0.0, 1.0], "factor": RAMP},
                                  {"type": "table", "times": RAMP["times"], "values": [[0.0, 0.0, v] for v in RAMP["values"]], "interpolation": "linear"}])
def test_a_body_that_a_ramp_takes_past_its_brake_leaves_where_it_does(law: str, ramp: dict[str, Any]) -> None:
    # about the third axis J w' = t/100 - 0.3 sign(w): at rest it would leave at 30 s, which is no time of the table
    brake = {"type": "brake", "limit": [0.3, 0.3, 0.3], "law": law}

    def answer(w: float, times: list[float], *torques: dict[str, Any]) -> gyrostat.Answer:
        return gyrostat.solve(scene(torque=[brake, *torques], initial={"angular_velocity": [0.0, 0.0, w]}, solve={"times": times, "tolerance": 1e-9}))

    for w in (0.0, 0.5):  # at rest from the start, or from 3.8 s on
        left = answer(w, [10.0, 30.0, 30.5, 40.0, 80.0], ramp)
        assert left.met and np.allclose(left["angular_velocity"][:, 2], [max(0.0, t - 30) ** 2 / 400 for t in left.t], rtol=1e-9, atol=1e-15)
    with pytest.raises(DomainError, match="from zero about an axis that its brake does not hold"):
        gyrostat.solve(scene(torque=[{**brake, "limit": [0.3, 0.3, 0.0]}, ramp], initial={"angular_velocity": [0.0, 0.0, 0.0]}, solve={"times": [10.0]}))
    # while it turns it goes through the limit of the brake as through any other torque
    turning = answer(3.0, [20.0, 30.0, 80.0], ramp)
    assert turning.met and np.allclose(turning["angular_velocity"][:, 2], [3 + (t * t / 200 - 0.3 * t) / 2 for t in turning.t], rtol=1e-9)
    # in steps it leaves at the one that is too much: 0.4 N m from 40 s on
    steps = {"type": "table", "times": [10.0 * i for i in range(11)], "values": [[0.0, 0.0, 0.1 * i] for i in range(11)], "interpolation": "step"}
    left = answer(0.0, [20.0, 35.0, 45.0, 60.0], steps)
    assert left.met and np.allclose(left["angular_velocity"][:, 2], [0.0, 0.0, 0.1 * 5 / 2, (0.1 * 10 + 0.2 * 10) / 2], rtol=1e-9, atol=1e-15)
    # and a ramp that ends within the limit is held to its end
    low = {**ramp, **({"factor": {**RAMP, "values": [0.0, 0.299]}} if "factor" in ramp else {"values": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.299]]})}
    held = answer(0.0, [50.0, 100.0], low)
    assert held.met and not np.any(held["angular_velocity"])


def test_a_wave_that_is_fast_against_the_motion_is_followed() -> None:
    torque = {"type": "constant", "torque": [0.0, 0.0, 0.4], "factor": {"mean": 0.0, "amplitude": 1.0, "rate": 500.0, "phase": 0.3}}
    made = gyrostat.solve(scene(torque=[torque], initial={"angular_velocity": [0.0, 0.0, 0.01]}, solve={"times": [0.0, 1.0, 7.0], "tolerance": 1e-10}))
    law = 0.01 + 0.4 / 2.0 / 500.0 * (math.cos(0.3) - np.cos(500.0 * made.t + 0.3))
    assert made.met and np.allclose(made["angular_velocity"][:, 2], law, rtol=0, atol=1e-12)


def test_an_eccentric_orbit_drives_a_body_that_a_circle_leaves_at_rest() -> None:
    # seen from the orbit a slender body that is upright at the pericentre swings by about 2 e/(3 k - 1) sin(n t), k = (J2 - J1)/J3
    def swing(eccentricity: float) -> float:
        made = gyrostat.solve(scene(
            body={"inertia": [0.1, 1.0, 1.0]}, torque=[{"type": "gravity-gradient"}], orbit={"radius": 7e6, "mu": 3.986e14, "eccentricity": eccentricity},
            initial={"attitude": [0.0, 0.0, 0.0, 1.0], "angular_velocity": [0.0, 0.0, rate * (1 + eccentricity) ** 0.5]},
            solve={"times": np.linspace(0.0, 8000.0, 81).tolist(), "tolerance": 1e-9}), ask=["attitude"])
        angle = 2 * np.arctan2(made["attitude"][:, 2], made["attitude"][:, 3])
        return float(np.max(np.abs(np.angle(np.exp(1j * (angle - anomaly(eccentricity, made.t)))))))

    def anomaly(e: float, t: Any) -> Any:
        axis = 7e6 / (1 - e)
        mean = math.sqrt(3.986e14 / axis**3) * t
        eccentric = mean
        for _ in range(40):
            eccentric = mean + e * np.sin(eccentric)
        return 2 * np.arctan2(math.sqrt(1 + e) * np.sin(eccentric / 2), math.sqrt(1 - e) * np.cos(eccentric / 2))

    rate = math.sqrt(3.986e14 / 7e6**3)
    assert swing(0.0) < 1e-7
    assert swing(0.02) > 0.01


def test_drag_on_the_momentum_brakes_what_wheels_have_stored() -> None:
    wheel = {"type": "held", "axis": [0, 0, 1], "axial_inertia": 0.1, "rate": 50.0}
    made = gyrostat.solve(scene(wheel=[wheel], torque=[{"type": "damping", "against": "momentum", "coefficient": 0.07}]), ask=["angular_momentum_inertial"])
    law = made["angular_momentum_inertial"][0] * np.exp(-0.07 * made.t)[:, None]
    assert np.allclose(made["angular_momentum_inertial"], law, rtol=0, atol=1e-9 * np.linalg.norm(law[0]))


def test_a_field_along_the_spin_brakes_nothing() -> None:
    still = scene(initial={"angular_velocity": [0.0, 0.0, 2.0]}, field={"uniform": [0.0, 0.0, 3e-4]},
                  torque=[{"type": "eddy-current", "coefficient": 1e6}], solve={"times": [0.0, 500.0], "tolerance": 1e-9})
    energy = gyrostat.solve(still, ask=["energy"])["energy"]
    assert abs(energy[1] / energy[0] - 1) < 1e-12
    across = still | {"initial": {"angular_velocity": [0.0, 2.0, 0.0]}}
    energy = gyrostat.solve(across, ask=["energy"])["energy"]
    assert energy[1] < 0.5 * energy[0]


def test_chaos_has_no_error_after_a_while() -> None:
    top = {"inertia": [0.03, 0.02, 0.013], "mass": 1.0, "centre_of_mass": [0.02, 0.01, 0.05], "fixed": True}
    wild = scene(body=top, field={"gravity": 9.8, "uniform": [0.02, 0.0, 0.01]}, initial={"angular_velocity": [3.0, 5.0, -2.0]},
                 torque=[{"type": "weight"}, {"type": "magnetic", "dipole": [3.0, -2.0, 5.0]}])
    near, far = (gyrostat.solve(wild, times=[0.0, end], tolerance=1e-9) for end in (2.0, 400.0))
    assert near.met and not far.met
    assert far.error["attitude"] > 1e3 * near.error["attitude"]


def test_beside_a_separatrix_the_phase_is_withheld() -> None:
    on_it = math.sqrt((2.5 - 2.0) / (3.0 - 2.5) * 2.0 / 3.0)  # omega_1 over omega_3 of a separatrix
    beside = scene(initial={"angular_velocity": [on_it * 0.8, 1.0, 0.8]}, solve={"times": [0.0, 4000.0], "tolerance": 1e-3})
    made = gyrostat.solve(beside)
    assert not made.met or made.error["attitude"] < 1e-3
    far = gyrostat.solve(beside, times=[0.0, 4e6], model="free:closed-form")
    assert not far.met and far.error["attitude"] > 0.05


def test_the_turned_frame_tells_what_its_phase_loses() -> None:
    top = {"inertia": [0.02, 0.02, 0.012], "mass": 1.0, "centre_of_mass": [0.0, 0.0, 0.05], "fixed": True}
    wheel = {"type": "held", "axis": [0, 0, 1], "axial_inertia": 4e-4, "rate": 9e4}
    turned = scene(body=top, field={"gravity": 9.8}, torque=[{"type": "weight"}], wheel=[wheel])
    short, long = (gyrostat.solve(turned, times=[0.0, end], model="heavy:exact", ask=["attitude"]) for end in (1.0, 3000.0))
    assert long.error["attitude"] >= 3000 * 4e-4 * 9e4 / 0.012 * 2.0**-53
    assert short.error["attitude"] < 1e-2 * long.error["attitude"]


def test_a_table_of_many_times_is_no_burden() -> None:
    times = np.linspace(0.0, 100.0, at_length(20_001, 100_001))
    table = {"type": "table", "times": times.tolist(), "values": np.stack([0.01 * np.cos(times), 0 * times, 0 * times], 1).tolist()}
    made = gyrostat.solve(scene(torque=[table], solve={"times": [0.0, 0.5], "tolerance": 1e-6}))
    assert made.met and made.counts["steps"] < 2000
    wave = {"type": "constant", "torque": [0.01, 0.0, 0.0], "factor": {"amplitude": 1.0, "rate": 1.0, "phase": math.pi / 2}}
    assert np.allclose(made["angular_velocity"], gyrostat.solve(scene(torque=[wave], solve={"times": [0.0, 0.5]}))["angular_velocity"], atol=1e-8)


def test_a_held_rate_that_steps_makes_the_body_jump_and_leaves_the_momentum() -> None:
    wheel = {"type": "held", "axis": [0, 0, 1], "axial_inertia": 0.1, "rate": {"times": [0, 1], "values": [1.0, 9.0], "interpolation": "step", "extend": "hold"}}
    for model in ("segments", "full"):
        made = gyrostat.solve(scene(wheel=[wheel], solve={"times": [0.0, 0.999999999, 1.0, 2.0], "tolerance": 1e-9, "model": model}), ask="all")
        jump = made["angular_velocity"][2] - made["angular_velocity"][1]
        assert np.allclose(jump, [0.0, 0.0, -0.1 * 8 / 2.0], atol=1e-8)
        assert np.allclose(made["angular_momentum"][2], made["angular_momentum"][1], atol=1e-8)
        inertial = np.einsum("nij,nj->ni", matrix_from_quaternion(made["attitude"]), made["angular_momentum"])
        assert np.allclose(inertial, inertial[0], rtol=0, atol=1e-11)


def test_segments_say_that_there_are_too_many_of_them() -> None:
    times = [0.25 * i for i in range(121)]
    wheel = {"type": "held", "axis": [1.0, 0.0, 0.0], "axial_inertia": 0.01,
             "rate": {"times": times, "values": [10.0 * (i % 2) for i in range(121)], "interpolation": "step", "extend": "hold"}}
    with pytest.raises(DomainError, match="at more than 63 times"):
        gyrostat.solve(scene(wheel=[wheel], solve={"times": [30.0], "model": "segments"}))


def test_a_wave_that_is_asked_where_it_vanishes_has_a_size() -> None:
    wave = {"type": "constant", "torque": [0.1, 0.0, 0.0], "factor": {"mean": 0.0, "amplitude": 1.0, "rate": math.pi}}
    made = gyrostat.solve(scene(torque=[wave], solve={"times": [1.0, 10.0], "tolerance": 1e-6, "ask": "all"}))
    assert made.met and made.scale["torque"] == pytest.approx(1e-7) and np.max(np.abs(made["torque"])) < 1e-15
