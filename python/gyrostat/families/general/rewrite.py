# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the other families as general scenes: the same motion, told by body, wheels and torques."""

from typing import TYPE_CHECKING, Any

import numpy as np

from gyrostat.broadcast import Floats
from gyrostat.errors import DomainError
from gyrostat.rotation import quaternion_from_vector

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["as_general", "recognised", "segments_of"]

Tables = dict[str, Any]


def _spun(given: Tables) -> Tables:
    """Attitude and rates, or momentum, at t = 0."""
    names = ("attitude", "angular_velocity", "angular_momentum", "velocity", "position")
    made = {name: np.asarray(given[name]).tolist() for name in names if given.get(name) is not None}
    if "angular_velocity" in made:
        made.pop("angular_momentum", None)  # which follows from it
    return made


def _deceleration(given: Tables) -> Tables:
    against = {"total": "momentum", "carrier": "carrier-momentum"}[given["drag_law"]]
    torques = [{"type": "brake", "limit": np.asarray(given["control"]).tolist(), "law": given["law"]},
               {"type": "damping", "coefficient": given["drag"], "against": against}]
    return {"body": {"rotor_momentum": np.asarray(given["rotor_momentum"]).tolist()}, "initial": _spun(given),
            "torque": [each for each in torques if np.any(each.get("limit", each.get("coefficient")))]}


def _rotor(given: Tables) -> Tables:
    wheel = {"type": "motor", "axis": np.asarray(given["axis"]).tolist(), "axial_inertia": given["axial_inertia"], "rate": given["rotor_rate"],
             "slope": given["slope"], "no_load_rate": given["no_load_rate"]}
    return {"wheel": [wheel], "initial": _spun(given)}


def _spinning(given: Tables) -> Tables:
    torques: list[Tables] = []
    if np.any(given["torque"]):
        torques.append({"type": "constant", "torque": np.asarray(given["torque"]).tolist()})
    if np.any(given["force"]):
        torques.append({"type": "thrust", "force": np.asarray(given["force"]).tolist()})
    if given["charge_momentum"]:
        torques.append({"type": "charge", "momentum": [0.0, 0.0, given["charge_momentum"]]})
    psi, phi, theta = np.asarray(given["euler_312"]).tolist()
    return {"body": {"mass": given["mass"], "rotor_momentum": [0.0, 0.0, given["rotor_momentum"]]}, "torque": torques,
            "initial": {**_spun(given), "euler": {"sequence": "3-1-2", "angles": [theta, psi, phi]}}}


def _standing(down: Floats) -> list[float]:
    """An attitude in which the body sees the inertial axis -3 along `down`."""
    target = np.array([0.0, 0.0, -1.0])
    axis = np.cross(down, target)
    size = float(np.linalg.norm(axis))
    angle = float(np.arctan2(size, down @ target))
    vector = axis / size * angle if size > 0 else np.array([angle, 0.0, 0.0])
    made: list[float] = np.asarray(quaternion_from_vector(vector)).tolist()
    return made


def _heavy(given: Tables) -> Tables:
    if given["periodic"] is not None:
        raise DomainError("initial.periodic: a general scene starts from rates and an attitude: give initial.angular_velocity and initial.attitude")
    torques: list[Tables] = [{"type": "weight"}] if given["gravity"] and np.any(given["centre_of_mass"]) else []
    if given["gravity_gradient"]:
        torques.append({"type": "gravity-gradient", "gradient": given["gravity_gradient"]})
    start = _spun(given)
    if "attitude" not in start:
        start["attitude"] = _standing(np.asarray(given["down"], dtype=float))
    return {"body": {"mass": given["mass"], "centre_of_mass": np.asarray(given["centre_of_mass"]).tolist(), "fixed": True},
            "field": {"gravity": given["gravity"]}, "torque": torques, "initial": start}


def _free(given: Tables) -> Tables:
    wheels = [{key: list(value) if isinstance(value, tuple) else value for key, value in wheel.items()} for wheel in given["wheels"]]
    return {"body": {"rotor_momentum": np.asarray(given["rotor_momentum"]).tolist()}, "wheel": wheels, "initial": _spun(given)}


_OF = {"deceleration": _deceleration, "rotor": _rotor, "spinning": _spinning, "heavy": _heavy, "free": _free}


def as_general(scene: "Scene") -> "Scene":
    """The scene as one of the kind general; itself where it is one. What a family asks beside the motion, such as `view`, is left out.

    Raises DomainError for a periodic motion that is to be found.
    """
    from gyrostat.families import FAMILIES
    from gyrostat.scenes import scene_from

    if scene.kind == "general":
        return scene
    given = FAMILIES[scene.kind].arguments(scene)
    made = _OF[scene.kind](given)
    body = {"inertia": np.asarray(given["inertia"]).tolist(), **made.pop("body", {})}
    solving = {"times": scene.times.tolist(), "tolerance": scene.tolerance}
    return scene_from({"name": scene.name, "kind": "general", "source": scene.source, "solve": solving, "body": body, **made})


def _physics(scene: "Scene") -> dict[str, Any]:
    """The arguments of `recognise` and `segments`."""
    from gyrostat.families.general.functions import QUESTION
    from gyrostat.families.general.scene import arguments

    given = arguments(as_general(scene))
    return {name: value for name, value in given.items() if name == "times" or name not in (*QUESTION, "start_error")}


def recognised(scene: "Scene") -> dict[str, str]:
    """Name of each family, and why the scene is not exactly an instance of it; empty where it is."""
    from gyrostat.families.general.functions import recognise

    return recognise(**_physics(scene))


def segments_of(scene: "Scene") -> list[tuple[float, float, tuple[str, ...]]]:
    """Begin, end [s] and families of each segment that the scene can be answered in; none where it cannot."""
    from gyrostat.families.general.functions import segments

    return segments(**_physics(scene))
