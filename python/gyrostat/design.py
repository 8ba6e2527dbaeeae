# SPDX-License-Identifier: BSD-3-Clause
"""Designs of a thrusting spinner: the least spin, the greatest torque or the longest burn that keeps within a budget.

The linear motion is solved backwards (docs/spinning.md, section 3.1). `design_scene` puts what was found into a scene and checks it
there by the full equations of motion; the functions over arrays do not.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core, spinning
from gyrostat._core import Monitor
from gyrostat.broadcast import Floats, finite_rows, rows, shaped
from gyrostat.errors import DomainError
from gyrostat.families.spinning.functions import ORIGIN, SHAPES, start_lean
from gyrostat.fields import MOST_SAMPLES
from gyrostat.ladder import solve
from gyrostat.rotation import matrix_from_quaternion
from gyrostat.scenes import Scene

__all__ = ["GOALS", "Design", "Goal", "SceneDesign", "burn_for_displacement", "burn_for_velocity", "design_scene", "spin_for_pointing",
           "torque_for_direction"]

# Beyond this bound of the tilt the linear motion is not to be trusted [rad].
SMALL_TILT: Final = 0.3
# Beyond this one it says nothing, and its full motion tumbles at rates that no budget meant: such a design is refused [rad].
MOST_TILT: Final = 2 * math.pi
# A design is confirmed where the full motion finds the budget within this share.
AGREEMENT: Final = 0.01
# Means are taken over so many periods of the slowest oscillation, by so many samples in a period of the fastest, and never over more
# turns than this.
PERIODS: Final = 30.0
SAMPLES: Final = 12.0
MOST_TURNS: Final = 10_000.0
# Tolerance of the full motion that checks a design.
CHECK: Final = 1e-8

Vectors = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Goal:
    """What can be designed: the quantity sought, with the key of the scene that it changes, and the one that the budget limits, with their units."""

    quantity: str
    key: str
    unit: str
    measure: str
    budget_unit: str


GOALS: Final[dict[str, Goal]] = {
    "spin-for-pointing": Goal("least spin rate", "initial.angular_velocity", "rad/s", "lean under the torque", "rad"),
    "torque-for-direction": Goal("greatest transverse torque", "torque.body", "N m", "direction of the velocity from axis 3", "rad"),
    "burn-for-displacement": Goal("longest burn", "solve.duration", "s", "displacement across axis 3", "m"),
    "burn-for-velocity": Goal("longest burn", "solve.duration", "s", "change of velocity", "m/s"),
}
WHY: Final = {
    "no-torque": "no torque acts across axis 3: there is nothing to design against",
    "never-reached": "the motion grows beyond all numbers before it reaches the budget",
    "too-long": "the motion stays below the budget for a million steps of the search, and nothing is known of what comes then",
}


@dataclass(frozen=True, eq=False)
class Design:
    """Designs as arrays over the leading axes; NaN where there is none, and `why`."""

    value: Floats  # (...) in the unit of the goal; infinite where nothing limits it
    tilt_bound: Floats  # (...) |psi + i phi| of the linear motion stays below it: to the end of the burn, else for all time, rad
    unstable: NDArray[np.bool_]  # (...) nu^2 <= 0; of a spin: value is the limit of stability, which faster spins are within
    resonant: NDArray[np.bool_]  # (...) the tilt grows over many turns
    compliant: NDArray[np.bool_]  # (...) next to no gyroscopic stiffness
    why: NDArray[np.str_]  # (...) "", "no-torque", "not-covered", "never-reached" or "too-long"


def _design(goal: str, budget: ArrayLike, given: Mapping[str, ArrayLike]) -> Design:
    names = ["budget", *SHAPES]
    lead, made = rows([("budget", budget, ()), *((name, given[name], shape) for name, shape in SHAPES.items())])
    by_name = dict(zip(names, made, strict=True))
    limit = by_name.pop("budget")
    found = _core.spinning_design(_core.SpinningProblems(**by_name), goal=goal, budget=limit)
    flags = {name: shaped(found[name] == 1, lead) for name in ("unstable", "resonant", "compliant")}
    return Design(value=shaped(found["value"], lead), tilt_bound=shaped(found["tilt"], lead),
                  why=shaped(np.array(found["why"], dtype=str), lead), **flags)


def _body(**given: ArrayLike) -> dict[str, ArrayLike]:
    return {"mass": 1.0, "velocity": ORIGIN, "position": ORIGIN, **given}


def spin_for_pointing(*, inertia: ArrayLike, torque: ArrayLike, budget: ArrayLike, sense: ArrayLike = 1.0, rotor_momentum: ArrayLike = 0.0,
                      charge_momentum: ArrayLike = 0.0) -> Design:
    """Least stable spin rate [rad/s], signed, at which the torque turns the mean direction of axis 3 by at most the budget.

    |M|/|r (D3 r + lambda3 - e_H)| <= budget; what a start with tilt or rates across the axis leans it by is not in it. A rotor against the spin
    leaves a slow range of spins and a fast one; where stability ends a range before the budget does, the value is that limit and `unstable` is set.

    inertia, torque : (..., 3), none about axis 3 [kg m^2, N m]; budget : (...) > 0 [rad]; sense : (...) negative for a negative spin;
    rotor_momentum, charge_momentum : (...) [N m s]. Leading axes broadcast.
    Raises DomainError for what is not physical and for a budget that is not positive, naming the row.
    """
    lead, (sign,) = finite_rows([("sense", sense, ())])
    spin = np.zeros((*lead, 3))
    spin[..., 2] = np.where(sign < 0, -1.0, 1.0).reshape(lead)
    return _design("spin-for-pointing", budget, _body(
        inertia=inertia, torque=torque, rotor_momentum=rotor_momentum, charge_momentum=charge_momentum, angular_velocity=spin,
        force=ORIGIN, euler_312=ORIGIN))


def torque_for_direction(*, inertia: ArrayLike, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike, budget: ArrayLike,
                         rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0,
                         euler_312: ArrayLike = ORIGIN) -> Design:
    """Greatest |M| [N m] up to which the velocity gained points, in the mean over many turns, within the budget of inertial axis 3.

    |v/v3| <= tan(budget) for the secular ratio, with the transverse force and the start counted. torque : (..., 3), its direction is kept [N m];
    force : (..., 3) [N]; budget : (...) in (0, pi/2) [rad]; the others as in `spinning.linear`. Leading axes broadcast. Infinite where
    every torque of the direction meets the budget. Raises DomainError for what is not physical and for a budget out of range, naming the row.
    """
    return _design("torque-for-direction", budget, _body(
        inertia=inertia, torque=torque, force=force, angular_velocity=angular_velocity, rotor_momentum=rotor_momentum,
        charge_momentum=charge_momentum, euler_312=euler_312))


def burn_for_displacement(*, inertia: ArrayLike, mass: ArrayLike, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike,
                          budget: ArrayLike, rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0,
                          euler_312: ArrayLike = ORIGIN) -> Design:
    """Longest burn [s] during which the loads displace the mass centre by at most the budget [m] across inertial axis 3.

    The first time at which |x1 + i x2| of x - x(0) - v(0) t is the budget. budget : (...) > 0 [m]; the others as in `spinning.linear`. Leading
    axes broadcast. Infinite without force; unstable spins are answered and flagged. Raises DomainError for what is not physical and for
    a budget that is not positive, naming the row.
    """
    return _design("burn-for-displacement", budget, _body(
        inertia=inertia, mass=mass, torque=torque, force=force, angular_velocity=angular_velocity, rotor_momentum=rotor_momentum,
        charge_momentum=charge_momentum, euler_312=euler_312))


def burn_for_velocity(*, inertia: ArrayLike, mass: ArrayLike, torque: ArrayLike, force: ArrayLike, angular_velocity: ArrayLike,
                      budget: ArrayLike, rotor_momentum: ArrayLike = 0.0, charge_momentum: ArrayLike = 0.0,
                      euler_312: ArrayLike = ORIGIN) -> Design:
    """Longest burn [s] that changes the velocity of the mass centre by at most the budget [m/s], in size: first |v - v(0)| = budget.

    All else as in `burn_for_displacement`.
    """
    return _design("burn-for-velocity", budget, _body(
        inertia=inertia, mass=mass, torque=torque, force=force, angular_velocity=angular_velocity, rotor_momentum=rotor_momentum,
        charge_momentum=charge_momentum, euler_312=euler_312))


# ---- a scene ----


@dataclass(frozen=True, eq=False)
class SceneDesign:
    """A design put into a scene, and what the full motion of that scene says of it."""

    goal: str
    budget: float
    value: float
    tilt_bound: float  # rad
    scene: Scene  # with the value in it
    found: float  # of the full motion, in the unit of the budget
    span: float  # the full motion was followed for so long, s
    model: str  # the rung that answers the scene
    error: float  # its estimate
    tolerance: float
    met: bool  # that answer's
    warnings: tuple[str, ...]

    @property
    def confirmed(self) -> bool:
        """The full motion finds the budget within AGREEMENT."""
        return abs(self.found - self.budget) <= AGREEMENT * self.budget

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        goal = GOALS[self.goal]
        finite = math.isfinite(self.tilt_bound)
        return {
            "goal": self.goal, "quantity": goal.quantity, "value": self.value, "unit": goal.unit, "measure": goal.measure,
            "asked": self.budget, "found": self.found, "budget_unit": goal.budget_unit, "span": self.span, "confirmed": self.confirmed,
            "tilt_bound": self.tilt_bound if finite else None, "warnings": list(self.warnings),
            "answer": {"model": self.model, "error": self.error if math.isfinite(self.error) else None, "tolerance": self.tolerance,
                       "met": self.met},
            "scene": self.scene.to_dict(),
        }


def design_scene(scene: Scene, goal: str, budget: float, *, monitor: Monitor | None = None) -> SceneDesign:
    """Design a scene of a spinning body for a budget, put the value into it, solve it, and measure the budget on its full motion.

    goal : one of GOALS; budget : in its unit, angles in rad. Held: everything but the spin rate, the size of the transverse torque, or
    the duration. The mean direction of axis 3 with the torque is measured from the one without it; means are over many turns with a
    smooth window. A general scene that is exactly one of a spinning body is designed as that. Raises DomainError for a scene of another kind and where
    there is no design, saying why.
    """
    left_out = [key for key in scene.vary if "." in key] if scene.kind == "general" else []
    if scene.kind == "general":
        from gyrostat.families.general.instance import as_instance

        scene = as_instance(scene, ("spinning",)) or scene
    if scene.kind != "spinning":
        raise DomainError(f"kind = {scene.kind!r}: designs are known for the kind spinning" + (
            ", and for general scenes that are exactly of it (gyrostat recognise tells why one is not)" if scene.kind == "general" else ""))
    if goal not in GOALS:
        raise DomainError(f"goal = {goal!r}: use one of {', '.join(GOALS)}")
    given = spinning.arguments(scene)
    found = _design(goal, budget, {name: given[name] for name in SHAPES})
    value, why = float(found.value), str(found.why)
    if why:
        raise DomainError(f"{scene.name}: {WHY.get(why) or _not_covered(goal, given)}")
    if not math.isfinite(value):
        raise DomainError(f"{scene.name}: " + ("every torque of this direction meets the budget in the linear motion"
                                               if goal == "torque-for-direction" else "no force acts: the budget is never reached"))
    if goal == "spin-for-pointing" and bool(found.unstable):
        raise DomainError(f"{scene.name}: stability, not pointing, limits the spin: beyond {value:.9g} rad/s it is stable and within the budget, "
                          "at that rate it is not; choose a margin")
    tilt = float(found.tilt_bound)
    if math.isfinite(tilt) and tilt > MOST_TILT:
        raise DomainError(f"{scene.name}: {budget:.6g} {GOALS[goal].budget_unit} of {GOALS[goal].measure} takes a {GOALS[goal].quantity.split()[-1]} of {value:.6g} "
                          f"{GOALS[goal].unit}, at which the linear motion, by which designs are made, would tilt axis 3 by up to {tilt:.3g} rad: it says "
                          "nothing there; give a smaller budget")
    designed = _designed(scene, given, goal, value)
    answer = solve(designed, monitor=monitor)
    warnings = [f"{w.code}: {w.message}" for w in answer.warnings]
    if not tilt <= SMALL_TILT:
        much = f"the tilt may reach {tilt:.3g} rad" if math.isfinite(tilt) else "the tilt grows for ever"
        warnings.insert(0, f"beyond-small-tilt: {much}, and the design is by the linear motion, which holds for small tilt")
    if left_out:
        warnings.append(f"vary-left-out: the keys that the table [vary] names ({', '.join(left_out)}) are those of a general scene, and the designed one has none of them: "
                        "vary its own")
    if varied := [key for key in scene.vary if key.split("[")[0].split(".")[-1] == GOALS[goal].key.split(".")[-1]]:
        warnings.append(f"varies-as-before: the table [vary] still says {', '.join(f'{key} = {scene.vary[key]}' for key in varied)}, and a sweep of the designed scene "
                        "goes by that: change it")
    checked = spinning.arguments(designed)
    if goal == "spin-for-pointing" and (start := start_lean(checked)) > budget:
        warnings.append(f"start-leans-more: tilt and rates of the start alone put the mean direction of axis 3 {start:.3g} rad off inertial axis 3, which is not in "
                        "the budget")
    measured, span = _found(checked, goal, monitor)
    return SceneDesign(goal=goal, budget=float(budget), value=value, tilt_bound=tilt, scene=designed, found=measured, span=span,
                       model=answer.model, error=answer.greatest_error, tolerance=answer.tolerance, met=answer.met, warnings=tuple(warnings))


def _not_covered(goal: str, given: Mapping[str, Any]) -> str:
    """Why a scene has no design of the linear motion."""
    if given["torque"][2] != 0:
        return "a torque acts about axis 3: the spin is not constant"
    if goal == "spin-for-pointing":
        return "no stable spin of this sense meets the budget"
    if given["force"][2] == 0:
        return "no force acts along axis 3"
    if given["angular_velocity"][2] == 0:
        return "it does not spin about axis 3"
    start = start_lean(given)
    if math.isfinite(start):
        return f"tilt and rates of the start alone lean the mean direction of axis 3 by {start:.3g} rad, which is over the budget"
    body = {name: given[name] for name in ("inertia", "rotor_momentum", "charge_momentum")}
    stable = spinning.nutation_frequency_squared(spin_rate=given["angular_velocity"][2], **body) > 0
    return "the spin has no gyroscopic stiffness" if stable else "the spin is unstable"


def _designed(scene: Scene, given: Mapping[str, Any], goal: str, value: float) -> Scene:
    made: Any = value
    if goal == "spin-for-pointing":
        made = [*given["angular_velocity"][:2].tolist(), value]
    elif goal == "torque-for-direction":
        M = given["torque"]
        made = [*(value * M[:2] / math.hypot(M[0], M[1])).tolist(), 0.0]
    quantity = GOALS[goal]
    changes = {quantity.key: made}
    if quantity.key == "solve.duration":
        changes["solve.samples"] = max(2, len(given["times"]))
    note = f"{quantity.quantity} {value!r} {quantity.unit} by gyrostat design --{goal}"
    return scene.replace(source=f"{scene.source}; {note}" if scene.source else note, **changes)


def _found(given: dict[str, Any], goal: str, monitor: Monitor | None) -> tuple[float, float]:
    """What the budget limits, measured on the full motion, and how long that was followed."""
    full = {**given, "model": "full", "tolerance": min(CHECK, given["tolerance"]), "integrator": "auto", "monitor": monitor}
    if goal.startswith("burn"):
        columns = spinning.solve(**full)
        end = float(given["times"][-1])
        if goal == "burn-for-velocity":
            return float(np.linalg.norm(columns["velocity"][-1] - given["velocity"])), end
        moved = columns["position"][-1] - given["position"] - given["velocity"] * end
        return float(math.hypot(moved[0], moved[1])), end
    times = _many_turns(given)
    full["times"] = times
    if goal == "torque-for-direction":
        pushed = _mean_direction(full, given["force"]) * math.copysign(1.0, given["force"][2])
        return math.atan2(math.hypot(pushed[0], pushed[1]), pushed[2]), float(times[-1])
    axis = np.array([0.0, 0.0, 1.0])
    pushed, free = _mean_direction(full, axis), _mean_direction({**full, "torque": np.zeros(3)}, axis)
    return math.atan2(float(np.linalg.norm(np.cross(pushed, free))), float(pushed @ free)), float(times[-1])


def _many_turns(given: Mapping[str, Any]) -> Vectors:
    """Times that resolve the fastest oscillation of the linear motion and see many periods of the slowest."""
    spin = abs(float(given["angular_velocity"][2]))
    nu2 = float(spinning.nutation_frequency_squared(inertia=given["inertia"], spin_rate=spin * math.copysign(1.0, given["angular_velocity"][2]),
                                                    rotor_momentum=given["rotor_momentum"], charge_momentum=given["charge_momentum"]))
    nu = math.sqrt(nu2)
    fastest = (spin + nu) / (2 * math.pi)
    slowest = min(spin, nu, abs(spin - nu)) / (2 * math.pi)
    turns = min(PERIODS * fastest / max(slowest, 1e-300), MOST_TURNS)
    return np.linspace(0.0, turns / fastest, min(int(SAMPLES * turns) + 64, MOST_SAMPLES))


def _mean_direction(given: dict[str, Any], body_vector: Vectors) -> Vectors:
    """Mean over the times of R body_vector, by a window so smooth that oscillations leave nothing."""
    turned = matrix_from_quaternion(spinning.solve(**given)["attitude"]) @ body_vector
    s = np.linspace(0.0, 1.0, len(turned))[1:-1]
    window = np.exp(-1.0 / (s * (1.0 - s)))
    mean: Vectors = window @ turned[1:-1] / window.sum()
    return mean
