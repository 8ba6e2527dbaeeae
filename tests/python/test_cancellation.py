# SPDX-License-Identifier: BSD-3-Clause
"""Where parts of a number all but cancel, its stated error is that of the parts; where nothing is there to be wrong, it is zero."""

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import gyrostat

# moments 1, 1 and 1e-8, turned, and a spin about the slim axis
SLIM = [[0.419501139591837, 0.3990929665306121, -0.2902494302040816], [0.3990929665306121, 0.7256235855102042, 0.19954648326530613],
        [-0.2902494302040816, 0.19954648326530613, 0.8548752848979592]]
SPIN = [0.7619047619047618, -0.5238095238095237, 0.38095238095238104]
BODY = {"inertia": [1.0, 2.0, 2.5]}
TURNING = {"angular_velocity": [0.3, 0.2, -0.4]}


def scene(times: list[float], **tables: Any) -> dict[str, Any]:
    return {"name": "cancels", "solve": {"times": times}, **tables}


def exact_momentum() -> list[Fraction]:
    return [sum((Fraction(SLIM[i][j]) * Fraction(SPIN[j]) for j in range(3)), Fraction(0)) for i in range(3)]


@pytest.mark.parametrize("acting", [{}, {"torque": [{"type": "weight"}], "fixed": True}, {"wheel": [{"type": "free", "axis": [0, 0, 1], "axial_inertia": 1e-10, "rate": 1.0}]}])
@pytest.mark.parametrize("model", ["auto", "full"])
def test_the_momentum_of_a_slim_body_about_its_slim_axis(acting: dict[str, Any], model: str) -> None:
    fixed, rest = acting.get("fixed", False), {key: value for key, value in acting.items() if key != "fixed"}
    body = {"inertia": SLIM, **({"fixed": True, "mass": 1.0, "centre_of_mass": [0.0, 0.0, 0.0]} if fixed else {})}
    given = scene([1e-9, 2e-9], body=body, initial={"angular_velocity": SPIN}, **rest, **({"field": {"gravity": 9.8}} if fixed else {}))
    M = exact_momentum()
    size = math.sqrt(float(sum(x * x for x in M)))
    if "wheel" in rest:
        M[2] += Fraction(1e-10)
    for name in ("angular_momentum_norm", "angular_momentum_inertial"):
        answer = gyrostat.solve(given, ask=[name], tolerance=1e-12, model=model)
        true = abs(float(np.linalg.norm(answer[name][0])) - math.sqrt(float(sum(x * x for x in M)))) / size
        assert true <= answer.error[name], (name, true)
        assert not answer.met


@pytest.mark.parametrize("model", ["auto", "full"])
def test_the_energy_of_a_slim_body_about_its_slim_axis(model: str) -> None:
    energy = float(sum((Fraction(SPIN[i]) * m for i, m in enumerate(exact_momentum())), Fraction(0)) / 2)
    answer = gyrostat.solve(scene([1.0, 3.0], body={"inertia": SLIM}, initial={"angular_velocity": SPIN}), ask=["energy"], tolerance=1e-6, model=model)
    assert float(np.max(np.abs(answer["energy"] / energy - 1))) <= answer.error["energy"]


def test_wheels_that_take_all_momentum() -> None:
    wheels = [{"type": "free", "axis": [1, 0, 0], "axial_inertia": 0.023025704103195398, "rate": 3.9518477834807255},
              {"type": "free", "axis": [1, 0, 0], "axial_inertia": 0.015002359128850323, "rate": -5.4866187354345435}]
    given = scene([1.0, 3.0], body={"inertia": [1.3, 1.3, 1.3]}, wheel=wheels, initial={"angular_momentum": [0, 0, 0]})
    answer = gyrostat.solve(given, ask=["angular_momentum"], tolerance=1e-14)
    assert np.linalg.norm(answer["angular_momentum"][0]) / answer.scale["angular_momentum"] <= answer.error["angular_momentum"]
    assert answer.error["angular_momentum"] > 1e-14 and not answer.met


def test_a_torque_whose_factor_all_but_cancels() -> None:
    vector = np.array([0.1, 0.02, 0.3])

    def pushed(factor: dict[str, Any], times: list[float]) -> gyrostat.Answer:
        return gyrostat.solve(scene(times, body=BODY, initial=TURNING, torque=[{"type": "constant", "torque": vector.tolist(), "factor": factor}]),
                              ask=["torque"], tolerance=1e-10)

    def off(answer: gyrostat.Answer, factors: list[float]) -> float:
        right = np.outer(factors, vector)
        away = np.max(np.linalg.norm(answer["torque"] - right, axis=1))
        return float(away / max(answer.scale["torque"], np.max(np.linalg.norm(right, axis=1))))

    times = [1.0, 3.0]
    slow = pushed({"mean": -1e4, "amplitude": 1e4, "rate": 1e-4, "phase": math.pi / 2}, times)
    assert off(slow, [-2e4 * math.sin(0.5e-4 * t) ** 2 for t in times]) <= slow.error["torque"]
    last = [0.7 - 1e-13, 0.9]
    falling = pushed({"times": [0.0, 0.7, 0.9], "values": [1.0, 0.0, 0.0], "interpolation": "linear"}, last)
    assert off(falling, [float((Fraction(0.7) - Fraction(last[0])) / Fraction(0.7)), 0.0]) <= falling.error["torque"]


def test_what_has_not_begun_is_exactly_zero() -> None:
    later = {"times": [5.0, 6.0], "values": [1.0, 2.0], "interpolation": "linear", "extend": "zero"}
    torques = [{"type": "damping", "coefficient": [0.1, 0.2, 0.3]}, {"type": "thrust", "force": [1.0, 0.5, 0.2], "point": [0, 1.0, 0], "factor": later}]
    answer = gyrostat.solve(scene([1.0, 4.0], body={**BODY, "mass": 1.0}, initial=TURNING, torque=torques), ask=["velocity", "position"])
    assert answer.met and answer.error["velocity"] == answer.error["position"] == 0
    assert not answer["velocity"].any() and not answer["position"].any()


@pytest.mark.parametrize("wheel", [{"type": "friction", "friction": 1e-3}, {"type": "motor", "slope": 1e-3, "no_load_rate": 0.0}, {"type": "free"},
                                   {"type": "torque", "torque": 0.0}])
def test_a_wheel_at_rest_in_a_body_at_rest(wheel: dict[str, Any]) -> None:
    body = {**BODY, "rotor_momentum": [0.5, -0.4, -0.5]}
    given = scene([1.0, 4.0], body=body, wheel=[{"axis": [1, 0, 0], "axial_inertia": 0.1, "rate": 0.0, **wheel}], initial={"angular_velocity": [0.0, 0, 0]})
    answer = gyrostat.solve(given, model="full")
    assert answer.met and not answer["rotor_rate"].any()
    assert gyrostat.solve(given, model="full", ask=["energy"]).met


def test_a_brake_that_would_drive_is_refused() -> None:
    pulse = scene([0.0, 1.0], body=BODY, initial=TURNING, torque=[{"type": "brake", "limit": [0.02] * 3, "factor": {"mean": 0.0, "amplitude": 1.0, "rate": 1.0},
                                                                   "on": [[0.0, 3.0]]}])
    assert gyrostat.solve(pulse).met  # half a wave, while it is above zero
    for factor in ({"times": [0.0, 1.0, 2.0, 3.0], "values": [1.0, 0.0, 0.0, 1.0], "interpolation": "cubic"}, {"mean": -1.0, "amplitude": 0.0, "rate": 1.0, "phase": 0.0}, {"mean": 0.5, "amplitude": 0.6, "rate": 1.0, "phase": 0.0},
                   {"times": [0.0, 1.0], "values": [1.0, -1.0], "interpolation": "linear"}):
        given = scene([0.0, 1.0], body=BODY, initial=TURNING, torque=[{"type": "brake", "limit": [0.2] * 3, "factor": factor}])
        with pytest.raises((gyrostat.DomainError, gyrostat.SceneError), match="factor of a brake must not be negative"):
            gyrostat.solve(given)
