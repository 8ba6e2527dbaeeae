# SPDX-License-Identifier: BSD-3-Clause
"""General scenes that are an instance of a family in so many words, as scenes of that family: what is known of it alone, such as where a motion ends."""

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat.broadcast import Floats
from gyrostat.errors import DomainError, SceneError
from gyrostat.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["as_instance"]

# What `posed` makes of a scene.
Posed = Mapping[str, Any]
Tables = dict[str, Any]


def _down(given: Posed) -> Floats:
    """The vertical as the body sees it at the start."""
    made: Floats = matrix_from_quaternion(given["initial"]["attitude"]).T @ given["field"]["down"]
    return made


def _start(given: Posed) -> Tables:
    return {name: given["initial"][name].tolist() for name in ("attitude", "angular_velocity")}


def _free(given: Posed) -> Tables:
    wheels = [{"type": each["type"], "axis": each["axis"].tolist(), "axial_inertia": each["axial_inertia"], "rate": each["rate"]} for each in given["wheels"]]
    return {"body": {"rotor_momentum": given["body"]["rotor_momentum"].tolist()}, "wheel": wheels, "initial": _start(given)}


def _deceleration(given: Posed) -> Tables:
    torque: Tables = {"control": [0.0, 0.0, 0.0], "drag": 0.0}
    laws = {"momentum": "total", "carrier-momentum": "carrier"}
    for each in given["torques"]:
        law = laws.get(each["opposed"], "total")
        torque |= {"control": each["vector"].tolist(), "law": law} if each["type"] == "brake" else {"drag": float(each["matrix"][0, 0]), "drag_law": law}
    return {"body": {"rotor_momentum": given["body"]["rotor_momentum"].tolist()}, "torque": torque, "initial": _start(given)}


def _rotor(given: Posed) -> Tables:
    wheel, = given["wheels"]
    return {"rotor": {"axis": wheel["axis"].tolist(), "axial_inertia": wheel["axial_inertia"]},
            "motor": {name: wheel[name] for name in ("slope", "no_load_rate")}, "initial": {**_start(given), "rotor_rate": wheel["rate"]}}


def _heavy(given: Posed) -> Tables:
    gradient = sum(each["gradient"] or 0.0 for each in given["torques"])
    return {"body": {"mass": float(given["body"]["mass"]), "centre_of_mass": given["body"]["centre_of_mass"].tolist()},
            "field": {"gravity": float(given["field"]["gravity"]), "gravity_gradient": float(gradient)},
            "initial": {"angular_velocity": given["initial"]["angular_velocity"].tolist(), "down": _down(given).tolist()}}


def _spinning(given: Posed) -> Tables:
    thrust = _thrust(given)
    start = given["initial"]
    made: Tables = {"body": {"rotor_momentum": float(given["body"]["rotor_momentum"][2])}, "torque": {"body": thrust["torque"].tolist(), "force": thrust["force"].tolist()},
                    "initial": {name: start[name].tolist() for name in ("attitude", "angular_velocity", "velocity", "position")}}
    if given["body"]["mass_given"]:
        made["body"]["mass"] = float(given["body"]["mass"])
    if np.any(thrust["charge"]):
        made["field"] = {"momentum": float(thrust["charge"][2])}
    return made


_INSTANCES: Final[dict[str, Callable[[Posed], Tables]]] = {"free": _free, "deceleration": _deceleration, "rotor": _rotor, "heavy": _heavy, "spinning": _spinning}


def _thrust(given: Posed) -> dict[str, Floats]:
    """What torques that are constant in the body come to: about the mass centre, as a force, and as a charge in a field."""
    made = {"torque": np.zeros(3), "force": np.zeros(3), "charge": np.zeros(3)}
    for each in given["torques"]:
        match each["type"]:
            case "constant":
                made["torque"] = made["torque"] + each["vector"]
            case "thrust":
                made["force"] = made["force"] + each["vector"]
                made["torque"] = made["torque"] + np.cross(each["point"] - given["body"]["centre_of_mass"], each["vector"])
            case "charge":
                made["charge"] = made["charge"] + each["vector"]
    return made


def _is_constant(torque: Posed) -> bool:
    """Always the same in the axes of the body."""
    return (torque["type"] in ("constant", "thrust", "charge") and torque["axes"] == "body" and torque["factor_table"] is None and torque["mean"] == 1
            and torque["amplitude"] == 0 and len(torque["on"]) == 0)


def _without_locked(given: Posed) -> Posed:
    """Locked wheels are part of the body, and the angles of the others, from which they are counted on, turn nothing."""
    return {**given, "wheels": [{**each, "angle": 0.0} for each in given["wheels"] if each["type"] != "locked"]}


def _physics(given: Posed) -> dict[str, Any]:
    """What the motion hangs on; of weight and mass where something weighs, of the orbit where something acts."""
    made = {"inertia": given["body"]["inertia"], "rotor_momentum": given["body"]["rotor_momentum"], "wheels": given["wheels"], "torques": given["torques"],
            "orbit": given["orbit"] if given["torques"] else None, "angular_velocity": given["initial"]["angular_velocity"]}
    if given["torques"] and all(_is_constant(each) for each in given["torques"]):
        return made | {"torques": _thrust(given), "mass": given["body"]["mass"], "fixed": given["body"]["fixed"],
                       **{name: given["initial"][name] for name in ("attitude", "velocity", "position")}}
    if given["torques"]:
        made |= {"fixed": given["body"]["fixed"], "down": _down(given)}
    if any(each["type"] == "weight" for each in given["torques"]):
        made |= {"mass": given["body"]["mass"], "centre_of_mass": given["body"]["centre_of_mass"], "gravity": given["field"]["gravity"]}
    return made


def _same(one: Any, other: Any) -> bool:
    """The same data, but for some roundings of numbers."""
    if isinstance(one, Mapping):
        return isinstance(other, Mapping) and one.keys() == other.keys() and all(_same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return isinstance(other, list | tuple) and len(one) == len(other) and all(map(_same, one, other))
    if one is None or isinstance(one, str | bool):
        return bool(one == other)
    a, b = np.asarray(one), np.asarray(other)
    return a.shape == b.shape and bool(np.all(np.abs(a - b) <= 4e-15 * np.max(np.abs(a), initial=0.0)))


def as_instance(scene: "Scene", kinds: Collection[str]) -> "Scene | None":
    """A general scene as one of the first of these kinds in whose words all of it can be told; None where it is none: what begins or ends, for one, even behind
    the last time."""
    from gyrostat.families.general.rewrite import as_general, recognised
    from gyrostat.families.general.rows import posed_of
    from gyrostat.scenes import scene_from

    why, given = recognised(scene), _without_locked(posed_of(scene))
    for kind, told in _INSTANCES.items():
        if kind not in kinds or why[kind]:
            continue
        try:
            made = told(given)
            body = {"inertia": given["body"]["inertia"].tolist(), **made.pop("body", {})}
            solving = {"times": (scene.times - scene.start_time).tolist(), "tolerance": scene.tolerance}
            found = scene_from({"name": scene.name, "kind": kind, "source": scene.source, "solve": solving, "body": body, **made})
        except (SceneError, DomainError, ValueError):
            continue
        if _same(_physics(given), _physics(posed_of(as_general(found)))):
            return found
    return None
