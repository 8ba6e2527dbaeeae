# SPDX-License-Identifier: BSD-3-Clause
"""General scenes that are exactly an instance of a family, as scenes of that family: what is known of it alone, such as where a motion ends."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["as_instance"]

Given = Mapping[str, Any]
Tables = dict[str, Any]


def _listed(value: Any) -> Any:
    return np.asarray(value, dtype=float).tolist()


def _start(given: Given) -> Tables:
    return {"attitude": _listed(given["attitude"]), "angular_velocity": _listed(given["angular_velocity"])}


def _free(given: Given) -> Tables | None:
    turning = [each for each in given["wheels"] if each["type"] != "locked"]
    if not all(each["type"] in ("held", "free") and isinstance(each["rate"], float) for each in turning):
        return None
    wheels = [{"axis": _unit(each["axis"]), **{key: each[key] for key in ("axial_inertia", "rate", "type")}} for each in turning]
    return {"body": {"rotor_momentum": _listed(given["rotor_momentum"])}, "wheel": wheels, "initial": _start(given)}


def _deceleration(given: Given) -> Tables | None:
    brakes = [each for each in given["torques"] if each["type"] == "brake"]
    drags = [each for each in given["torques"] if each["type"] == "damping"]
    if len(brakes) > 1 or len(drags) > 1 or given["wheels"]:
        return None
    torque: Tables = {"control": [0.0, 0.0, 0.0], "drag": 0.0}
    for brake in brakes:
        torque.update(control=_listed(brake["limit"]), law=brake["law"])
    for drag in drags:
        law = {"momentum": "total", "carrier-momentum": "carrier"}.get(drag["against"])
        if law is None:
            return None
        torque.update(drag=float(np.asarray(drag["coefficient"]).flat[0]), drag_law=law)
    return {"body": {"rotor_momentum": _listed(given["rotor_momentum"])}, "torque": torque, "initial": _start(given)}


def _rotor(given: Given) -> Tables | None:
    if len(given["wheels"]) != 1:
        return None
    wheel = given["wheels"][0]
    motor = {"motor": ("slope", "no_load_rate"), "friction": ("friction", None)}.get(wheel["type"])
    if motor is None or (wheel["type"] == "motor" and wheel["friction"]) or wheel[motor[0]] is None:
        return None
    return {"rotor": {"axis": _unit(wheel["axis"]), "axial_inertia": wheel["axial_inertia"]},
            "motor": {"slope": wheel[motor[0]], "no_load_rate": 0.0 if motor[1] is None else wheel[motor[1]]},
            "initial": {**_start(given), "rotor_rate": wheel["rate"]}}


def _heavy(given: Given) -> Tables | None:
    if any(each["type"] not in ("weight", "gravity-gradient") for each in given["torques"]) or given["wheels"] or given["orbit"] is not None:
        return None
    weighs = any(each["type"] == "weight" for each in given["torques"])
    gradients = [each.get("gradient") for each in given["torques"] if each["type"] == "gravity-gradient"]
    if None in gradients:
        return None
    down = matrix_from_quaternion(given["attitude"]).T @ np.asarray(given["field"]["down"], dtype=float)
    return {"body": {"mass": float(given["mass"]), "centre_of_mass": _listed(given["centre_of_mass"])},
            "field": {"gravity": float(given["field"]["gravity"]) if weighs else 0.0, "gravity_gradient": float(sum(gradients))},
            "initial": {"angular_velocity": _listed(given["angular_velocity"]), "down": _listed(down)}}


def _unit(axis: Any) -> Any:
    of = np.asarray(axis, dtype=float)
    return (of / np.linalg.norm(of)).tolist()


_INSTANCES: Final[dict[str, Callable[[Given], Tables | None]]] = {"free": _free, "deceleration": _deceleration, "rotor": _rotor, "heavy": _heavy}


def as_instance(scene: "Scene") -> "Scene | None":
    """A general scene as one of the first of free, deceleration, rotor and heavy that it is exactly an instance of; None where it is none."""
    from gyrostat.families.general.rewrite import recognised
    from gyrostat.families.general.scene import arguments
    from gyrostat.scenes import scene_from

    given, why = arguments(scene), recognised(scene)
    for kind, told in _INSTANCES.items():
        made = told(given) if not why[kind] else None
        if made is not None:
            body = {"inertia": _listed(given["inertia"]), **made.pop("body", {})}
            solving = {"times": scene.times.tolist(), "tolerance": scene.tolerance}
            return scene_from({"name": scene.name, "kind": kind, "source": scene.source, "solve": solving, "body": body, **made})
    return None
