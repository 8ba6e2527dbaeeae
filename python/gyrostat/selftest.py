# SPDX-License-Identifier: BSD-3-Clause
"""Quick checks that the installed package answers right: laws and closed forms, no stored numbers but constants."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from gyrostat import deceleration, elliptic, heavy, rotation, rotor, spinning
from gyrostat._core import build_info
from gyrostat.errors import DomainError
from gyrostat.ladder import solve
from gyrostat.scenes import bundled, load, scene_from

__all__ = ["checks"]

# A slow brake without rotors: everything from the closed form to the full equations can answer it.
SLOW = {
    "name": "selftest", "kind": "deceleration", "solve": {"duration": 4000.0, "samples": 41, "tolerance": 1e-9},
    "body": {"inertia": [35.0, 22.0, 16.0]}, "torque": {"control": [5e-4, 8e-4, 1e-3], "drag": 2e-5},
    "initial": {"angular_momentum": [40.0, 25.0, 16.5]},
}

# A tumbling body whose wheel is spun up.
DRIVEN = {
    "name": "selftest", "kind": "rotor", "solve": {"duration": 100.0, "samples": 41, "tolerance": 1e-10},
    "body": {"inertia": [3.0, 4.0, 5.0]}, "rotor": {"axis": [0.36, 0.48, 0.8], "axial_inertia": 0.4},
    "motor": {"slope": 0.2, "no_load_rate": 20.0},
    "initial": {"angular_velocity": [0.5, -0.3, 0.2], "rotor_rate": 0.0, "attitude": [0.5, -0.5, 0.5, 0.5]},
}

# A thrusting stage that spins about its axis 3, with a wheel.
THRUSTING = {
    "name": "selftest", "kind": "spinning", "solve": {"duration": 60.0, "samples": 41, "tolerance": 1e-10},
    "body": {"inertia": [8.0, 7.0, 11.0], "mass": 10.0, "rotor_momentum": 1.5},
    "torque": {"body": [4e-3, -2e-3, 0.0], "force": [0.3, -0.2, 3.0]},
    "initial": {"angular_velocity": [2e-3, -3e-3, 1.0]},
}

# A fast top without an axis of symmetry, in its periodic motion.
FORCED = {
    "name": "selftest", "kind": "heavy", "solve": {"duration": 0.1, "samples": 41, "tolerance": 1e-10},
    "body": {"inertia": [0.0011, 0.0016, 0.0020], "mass": 0.8, "centre_of_mass": [0.012, 0.009, 0.010]},
    "field": {"gravity": 9.80665}, "initial": {"periodic": {"spin": 150.0, "cos_inclination": 0.1}},
}


def _verdict(what: str, error: float, allowed: float) -> str:
    return f"{'' if error <= allowed else 'FAILED '}{what} {error:.2g} (allowed {allowed:.2g})"


def _equal_torque() -> str:
    torque, drag = 7e-4, 2e-5
    answers = [solve(SLOW, control=[torque] * 3, model=model) for model in ("equal-torque", "full")]
    start = math.sqrt(40.0**2 + 25.0**2 + 16.5**2)
    law = (start + torque / drag) * np.exp(-drag * answers[0].t) - torque / drag
    error = max(float(np.max(np.abs(a["angular_momentum_norm"] - law))) / start for a in answers)
    return _verdict("|M| of closed form and full motion, off the exponential law by", error, 1e-11)


def _second_order() -> str:
    rung, full = solve(SLOW, model="averaged-2", tolerance=1e-3), solve(SLOW, model="full")
    column = "angular_momentum_norm"
    error = float(np.max(np.abs(rung[column] - full[column]))) / float(full[column][0])
    return _verdict("averaged-2 against full motion, error over stated error", error / rung.error[column], 1.0)


def _integrators() -> str:
    given = {key: value for key, value in deceleration.arguments(load("cubesat-wheel", duration=300.0, samples=4)).items()
             if key not in ("angular_velocity", "attitude", "tolerance", "model", "integrator", "elliptic")}
    methods = ["taylor", "dop853"] + (["cvode-adams", "cvode-bdf"] if deceleration.has_cvode() else [])
    made = [np.asarray(deceleration.integrate(**given, method=method, tolerance=1e-11)["angular_momentum"]) for method in methods]
    error = max(float(np.max(np.abs(m - made[0]))) for m in made) / float(np.max(np.abs(made[0])))
    return _verdict(f"{', '.join(methods)} differ by", error, 1e-7)


def _rotor_laws() -> str:
    answer = solve(DRIVEN, model="full")
    momentum = np.einsum("nij,nj->ni", rotation.matrix_from_quaternion(answer["attitude"]), answer["angular_momentum"])
    drift = float(np.max(np.abs(momentum - momentum[0]))) / float(np.linalg.norm(momentum[0]))
    growth = float(np.max(np.diff(answer["lyapunov"]))) / float(answer["lyapunov"][0])
    return _verdict("angular momentum drifts, and V grows, by", max(drift, growth), 1e-13)


def _rotor_closed_form() -> str:
    still: dict[str, Any] = {"angular_velocity": [0.0, 0.0, 0.0], "rotor_rate": 0.0}
    closed, full = (solve(DRIVEN, model=model, **still) for model in ("closed-form", "full"))
    e = np.array([0.36, 0.48, 0.8])
    k = 1 - 0.4 * float(np.sum(e**2 / np.array([3.0, 4.0, 5.0])))
    law = 20.0 * -np.expm1(-0.2 / (0.4 * k) * closed.t)
    error = max(float(np.max(np.abs(answer["rotor_rate"] - law))) / 20.0 for answer in (closed, full))
    return _verdict("wheel of a body at rest: closed form and full motion, off the exponential law by", error, 1e-11)


def _rotor_integrators() -> str:
    given = {key: value for key, value in rotor.arguments(scene_from(DRIVEN)).items() if key not in ("tolerance", "model", "integrator")}
    methods = ["taylor", "radau", "dop853"] + (["cvode-adams", "cvode-bdf"] if deceleration.has_cvode() else [])
    made = [np.asarray(rotor.integrate(**given, method=method, tolerance=1e-12)["angular_momentum"]) for method in methods]
    error = max(float(np.max(np.abs(H - made[0]))) for H in made) / float(np.max(np.abs(made[0])))
    return _verdict(f"{', '.join(methods)} differ by", error, 1e-6)


def _spinning_rungs() -> str:
    full = solve(THRUSTING, model="full")
    off = 0.0
    for model in ("linear", "second-order"):
        rung = solve(THRUSTING, model=model, tolerance=0.1)
        for name in ("angular_velocity", "angular_momentum_inertial", "velocity", "position"):
            error = np.max(np.linalg.norm(rung[name] - full[name], axis=1)) / np.max(np.linalg.norm(full[name], axis=1))
            off = max(off, float(error) / rung.error[name])
    return _verdict("linear and second-order against full motion, error over stated error", off, 1.0)


def _spinning_resonance() -> str:
    given: dict[str, Any] = {"inertia": [8.0, 8.0, 12.0], "rotor_momentum": -12.0, "torque": [1e-3, 0.0, 0.0], "force": [0.0, 0.0, 1.0],
                             "angular_velocity": [0.0, 0.0, 1.0]}
    t = np.linspace(0.0, 50.0, 26)
    made = spinning.linear(t=t, **given)
    # nu = r0: p + i q = (M/D) (1 - e^(-i t))/i, so e^(i t) (psi + i phi) = (M/D) (e^(i t) - 1 - i t)/i^2
    law = 1e-3 / 8.0 * (1 + 1j * t - np.exp(1j * t)) * np.exp(-1j * t)
    off = float(np.max(np.abs(made.euler_312[:, 0] + 1j * made.euler_312[:, 1] - law)) / np.max(np.abs(law)))
    return _verdict("spinner at exact resonance, off the law by", off, 1e-13)


def _heavy_rungs() -> str:
    full = solve(FORCED, model="full")
    off = 0.0
    for model in ("series-2", "series"):
        rung = solve(FORCED, model=model, tolerance=0.1)
        for name in ("angular_velocity", "down"):
            error = np.max(np.linalg.norm(rung[name] - full[name], axis=1)) / np.max(np.linalg.norm(full[name], axis=1))
            off = max(off, float(error) / (rung.error[name] + full.error[name]))
    return _verdict("series against full motion, error over stated error", off, 1.0)


def _heavy_laws() -> str:
    top: dict[str, Any] = {"inertia": [0.002, 0.002, 0.001], "mass": 0.5, "centre_of_mass": [0.0, 0.0, 0.04], "gravity": 9.80665}
    start: dict[str, Any] = {"angular_velocity": [1.0, 2.0, 150.0], "down": [0.6, 0.0, 0.8]}
    t = np.linspace(0.0, 2.0, 41)
    exact = heavy.exact(**top, **start, t=t)
    full = heavy.integrate(**top, **start, times=t, tolerance=1e-14)
    return _verdict("top in closed form and integrated differ by", float(np.max(np.abs(exact.down - full["down"]))), 1e-11)


def _elliptic() -> str:
    k2 = np.array([1e-9, 0.3, 0.5, 0.9, 1 - 1e-9])
    complete, other = elliptic.complete(k2), elliptic.complete(1 - k2, kp2=k2)
    legendre = complete.E * other.K + other.E * complete.K - complete.K * other.K
    error = float(np.max(np.abs(legendre - math.pi / 2)))
    if build_info()["gsl"]:
        error = max(error, float(np.max(np.abs(elliptic.complete(k2, elliptic="gsl").K / complete.K - 1))))
    return _verdict("Legendre's relation (and GSL, if built in) off by", error, 1e-13)


def _rotations() -> str:
    vectors = np.array([[0.0, 0.0, 0.0], [1e-12, 0.0, 0.0], [0.3, -0.2, 0.9], [0.0, math.pi - 1e-9, 0.0]])
    back = rotation.vector_from_matrix(rotation.matrix_from_quaternion(rotation.quaternion_from_vector(vectors)))
    return _verdict("rotation vector, quaternion, tensor and back: off by", float(np.max(np.abs(back - vectors))), 1e-14)


def _refusals() -> str:
    try:
        deceleration.averaged(inertia=[[3.0, 2.0, 2.0], [9.0, 2.0, 2.0]], control=[1.0, 1.0, 1.0], drag=0.1,
                              angular_momentum=[1.0, 2.0, 3.0], t=[1.0])
    except DomainError as error:
        return f"{'' if 'row 1' in str(error) else 'FAILED '}an impossible body is refused"
    return "FAILED an impossible body was answered"


def _scenes() -> str:
    found = [load(name) for name, _ in bundled()]
    return f"{'' if found else 'FAILED '}{len(found)} bundled scenes load"


def checks() -> Iterator[tuple[str, Callable[[], str]]]:
    """Label and check; a check returns what it found, beginning with FAILED where it is wrong."""
    yield "scenes", _scenes
    yield "elliptic", _elliptic
    yield "rotation", _rotations
    yield "integrators", _integrators
    yield "equal torques", _equal_torque
    yield "second order", _second_order
    yield "rotor, laws", _rotor_laws
    yield "rotor, closed form", _rotor_closed_form
    yield "rotor, integrators", _rotor_integrators
    yield "spinning, rungs", _spinning_rungs
    yield "spinning, resonance", _spinning_resonance
    yield "heavy, rungs", _heavy_rungs
    yield "heavy, closed form", _heavy_laws
    yield "refusals", _refusals
