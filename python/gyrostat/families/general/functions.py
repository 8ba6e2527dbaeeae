# SPDX-License-Identifier: BSD-3-Clause
"""One body, any wheels, any sum of torques.

    M = J w + sum I_k Om_k u_k + l,   dM/dt = M x w + tau,   dq/dt = q (0, w)/2,   d(I_k (Om_k + u_k.w))/dt = T_k - c_k Om_k,
J the inertia of the whole, wheels locked, about the fixed point or the mass centre, Om_k the rate of wheel k about its axis u_k. Body axes and SI
units where nothing else is said. Equations, torques and the families that are found in a scene: docs/general.md.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.asking import Ask, asked
from gyrostat.broadcast import Floats
from gyrostat.errors import DomainError
from gyrostat.families import answer_of
from gyrostat.families.general.clock import orbit_since, since
from gyrostat.orientation import axes_of

__all__ = ["PLANETS", "Monitor", "orbit_start", "recognise", "solve"]

# The keys of a table [[wheel]], [[torque]], [orbit] or [field] of a scene file, in SI units.
Record = Mapping[str, Any]

# Gravitational parameter [m^3/s^2] and equatorial radius [m].
PLANETS: Final[dict[str, tuple[float, float]]] = {
    "earth": (3.986004415e14, 6378137.0), "moon": (4.902800066e12, 1738100.0), "mars": (4.282837362e13, 3396190.0),
    "venus": (3.24858592e14, 6051800.0), "mercury": (2.2031868551e13, 2440530.0), "jupiter": (1.26712764100000e17, 71492000.0),
    "saturn": (3.7940584841800e16, 60268000.0), "sun": (1.32712440041279419e20, 695700000.0),
}

_ZERO: Final = (0.0, 0.0, 0.0)


def _unit(axis: ArrayLike, what: str) -> Floats:
    made: Floats = np.asarray(axis, dtype=float)
    length = math.hypot(*made.tolist())
    if not (0 < length < math.inf):
        raise DomainError(f"{what} = {made.tolist()}: give a vector of finite length that is not 0")
    # two divisions take a unit vector to itself
    made = made / length if length != 1 else made
    again = math.hypot(*made.tolist())
    return made if again == 1 else made / again


def _matrix(value: Any) -> Floats:
    """A number, three of them along the diagonal, or all nine."""
    given = np.asarray(value, dtype=float)
    if given.ndim == 2:
        return given
    made: Floats = np.diag(given) if given.ndim == 1 else float(given) * np.eye(3)
    return made


def _table(given: Record | None, width: int) -> dict[str, Any] | None:
    if given is None:
        return None
    values = np.asarray(given["values"], dtype=float).reshape(-1, width)
    return {"times": np.asarray(given["times"], dtype=float), "values": values, "interpolation": given.get("interpolation") or "linear",
            "extend": given.get("extend") or "zero"}


def _wheel(given: Record) -> dict[str, Any]:
    kind, inertia = given.get("type") or "held", given.get("axial_inertia") or 0.0
    rate, torque, no_load = given.get("rate"), given.get("torque"), given.get("no_load_rate") or 0.0
    driven = torque if isinstance(torque, Mapping) else None
    turned = rate if isinstance(rate, Mapping) else None
    if given.get("momentum") is not None:
        rate = given["momentum"] / inertia if inertia else math.inf
    slope = given.get("slope")
    if given.get("stall_torque") is not None:
        slope = given["stall_torque"] / no_load if no_load else math.inf
    return {"type": kind, "axis": _unit(given["axis"], "wheel.axis"), "axial_inertia": inertia, "rate": 0.0 if turned or rate is None else rate,
            "angle": given.get("angle") or 0.0, "torque": 0.0 if driven or torque is None else torque, "friction": given.get("friction") or 0.0,
            "slope": slope or 0.0, "no_load_rate": no_load, "table": _table(turned or driven, 1)}


# The key that holds the vector of a torque.
_VECTOR: Final = {"constant": "torque", "thrust": "force", "magnetic": "dipole", "charge": "momentum", "brake": "limit"}
_LAWS: Final = {"total": "momentum", "carrier": "carrier-momentum"}


def _torque(given: Record) -> dict[str, Any]:
    kind, factor = given["type"], given.get("factor") or {}
    opposed = _LAWS[given.get("law") or "total"] if kind == "brake" else given.get("against") or "angular-velocity"
    matrix = given.get("matrix") if given.get("matrix") is not None else given.get("coefficient")
    vector = given[_VECTOR[kind]] if kind in _VECTOR else _ZERO
    on = np.asarray(() if given.get("on") is None else given["on"], dtype=float).reshape(-1, 2)
    wave = factor if "rate" in factor and factor["rate"] is not None else {}
    return {"type": kind, "axes": given.get("frame") or "body", "opposed": opposed,
            "vector": np.asarray([vector] * 3 if np.ndim(vector) == 0 else vector, dtype=float),
            "point": np.asarray(given.get("point") or _ZERO, dtype=float), "matrix": _matrix(0.0 if matrix is None else matrix),
            "gradient": given.get("gradient"), "table": _table(given, 3) if kind == "table" else None,
            "factor_table": _table(factor, 1) if factor.get("times") is not None else None, "mean": wave.get("mean") or 0.0 if wave else 1.0,
            "amplitude": wave.get("amplitude") or 0.0, "rate": wave.get("rate") or 0.0, "phase": wave.get("phase") or 0.0, "on": on}


def _orbit(given: Record | None) -> dict[str, Any] | None:
    if given is None:
        return None
    mu, planet = given.get("mu"), PLANETS[given.get("planet") or "earth"]
    radius, rate = given.get("radius"), given.get("rate")
    if given.get("altitude") is not None:
        radius = planet[1] + given["altitude"]
    if given.get("period") is not None:
        rate = 2 * math.pi / given["period"]
    if rate is not None:
        # the size of an orbit of given rate matters to the field of a dipole alone
        mu = planet[0] if mu is None and radius is None else mu
        radius = (mu / rate**2) ** (1 / 3) if radius is None else radius
        mu = rate**2 * radius**3
    radial = _unit(given.get("radial") or (1.0, 0.0, 0.0), "orbit.radial")
    along = np.asarray(given.get("along") or (0.0, 1.0, 0.0), dtype=float)
    return {"radius": radius, "mu": planet[0] if mu is None else mu, "eccentricity": given.get("eccentricity") or 0.0,
            "true_anomaly": given.get("true_anomaly") or 0.0, "radial": radial, "along": _unit(along - radial * float(radial @ along), "orbit.along")}


def orbit_start(orbit: Record, time: float = 0.0) -> tuple[Floats, Floats]:
    """The axes of an orbit at a time [s] as columns (3, 3), x along it, y against its normal, z to the centre, and their rate of turn (3,) [rad/s],
    inertial axes.

    orbit : the keys of the table [orbit] of a scene file, in SI units.
    """
    at_zero = _orbit(orbit)
    assert at_zero is not None
    made = orbit_since(time, at_zero)
    radial, along, radius = made["radial"], made["along"], made["radius"]
    normal = np.cross(radial, along)
    speed = math.sqrt(made["mu"] / radius * (1 + made["eccentricity"] * math.cos(made["true_anomaly"])))
    return np.stack([along, -normal, -radial], 1), speed / radius * normal


def _field(given: Record | None) -> dict[str, Any]:
    given = given or {}
    kind = next((name for name in ("uniform", "rotating", "dipole") if given.get(name) is not None), "none")
    part: Record = given[kind] if kind in ("rotating", "dipole") else {}
    flux = given["uniform"] if kind == "uniform" else part.get("vector", _ZERO)
    return {"gravity": given.get("gravity") or 0.0, "down": _unit(given.get("down") or (0.0, 0.0, -1.0), "field.down"), "magnetic": kind,
            "flux_density": np.asarray(flux, dtype=float), "axis": _unit(part.get("axis", (0.0, 0.0, 1.0)), "field.axis"),
            "rate": part.get("rate", 0.0), "strength": part.get("strength", 0.0), "radius": part.get("radius", 1.0)}


def _scene(inertia: ArrayLike, mass: float, centre_of_mass: ArrayLike, fixed: bool, rotor_momentum: ArrayLike, wheels: Sequence[Record],
           torques: Sequence[Record], orbit: Record | None, field: Record | None, attitude: ArrayLike, angular_velocity: ArrayLike,
           velocity: ArrayLike, position: ArrayLike) -> dict[str, Any]:
    def vector(value: ArrayLike) -> NDArray[np.float64]:
        return np.asarray(value, dtype=float)

    return {
        "body": {"inertia": _matrix(inertia), "mass": float(mass), "centre_of_mass": vector(centre_of_mass), "fixed": bool(fixed),
                 "rotor_momentum": vector(rotor_momentum)},
        "wheels": [_wheel(each) for each in wheels], "torques": [_torque(each) for each in torques], "orbit": _orbit(orbit), "field": _field(field),
        "initial": {"attitude": vector(attitude), "angular_velocity": vector(angular_velocity), "velocity": vector(velocity),
                    "position": vector(position)},
    }


def _with_angles(ask: Ask | None, euler: str | None) -> Ask | None:
    """A sequence of angles asks for them."""
    if euler is None or ask is None or isinstance(ask, str) or "euler" in ask:
        return ask
    return {**ask, "euler": "default"} if isinstance(ask, Mapping) else (*ask, "euler")


def solve(*, inertia: ArrayLike, times: ArrayLike, angular_velocity: ArrayLike = _ZERO, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
          wheels: Sequence[Record] = (), torques: Sequence[Record] = (), mass: float = 1.0, centre_of_mass: ArrayLike = _ZERO, fixed: bool = False,
          rotor_momentum: ArrayLike = _ZERO, orbit: Record | None = None, field: Record | None = None, velocity: ArrayLike = _ZERO,
          position: ArrayLike = _ZERO, tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto", recognise: bool = True,
          monitor: Monitor | None = None, ask: Ask | None = None, start_time: float = 0.0, start_error: Mapping[str, float] | None = None,
          euler: str | None = None) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) principal moments or (3, 3) tensor of the whole, wheels locked, about the mass centre, or where the body is fixed about its origin
    [kg m^2]; mass [kg]; centre_of_mass : (3,) from the origin [m]; fixed : the origin is held in space; rotor_momentum : (3,) of wheels that
    are not listed, constant [N m s]; wheels, torques : each with the keys of [[wheel]] and [[torque]] of a scene file, in SI units; orbit,
    field : the keys of those tables; attitude : (4,) [x, y, z, w] at t = 0, body to inertial; angular_velocity : (3,) at t = 0, body axes [rad/s];
    velocity, position : (3,) of the mass centre of a free body at t = 0, inertial axes [m/s], [m]; times : (n,) increasing, first >= 0 [s];
    tolerance : greatest relative error wanted in what is asked; recognise : whether the rungs of the families are asked of which the scene is
    exactly an instance.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: attitude, angular
    velocity, and rates and angles of the wheels.
    start_time : where the clock of times, tables, waves and orbit stands at the start [s]: attitude, rates and path are given there, and the first
    of the times may not be before it.
    start_error : by how much the start may be off, absolute: attitude [rad], angular_velocity, rotor_rate [rad/s], rotor_angle [rad], velocity,
    position; what comes of it is part of the errors of the answer.
    euler : sequence of the column `euler`, which is asked for with it, as "3-2-1" or "ZYX": R = R3(a1) R2(a2) R1(a3), body to inertial; None: there is no such column.
    Raises DomainError for an argument outside its domain, for a wheel that the body cannot hold, and for a rung that cannot compute the
    motion; ConvergenceError where a computation hits its cap; Cancelled where the monitor stopped it.
    """
    scene = _scene(inertia, mass, centre_of_mass, fixed, rotor_momentum, wheels, torques, orbit, field, attitude, angular_velocity, velocity, position)
    at = np.asarray(times, dtype=float)
    asking: dict[str, Any] = {"times": at, "tolerance": float(tolerance), "model": model, "integrator": integrator}
    made = _core.general_solve(scene=since(start_time, scene), **{**asking, "times": at - start_time}, recognise=recognise, monitor=monitor,
                               ask=asked("general", _with_angles(ask, euler)), start_error=dict(start_error or {}),
                               euler=None if euler is None else axes_of(euler))
    body = {**scene["body"], **scene["initial"]}
    records = {"wheels": [dict(each) for each in wheels] or None, "torques": [dict(each) for each in torques] or None,
               "orbit": None if orbit is None else dict(orbit), "field": None if field is None else dict(field)}
    return answer_of("general", made, {**body, **asking, **records, "recognise": None if recognise else False, "ask": ask, "euler": euler})


def recognise(*, inertia: ArrayLike, times: ArrayLike, angular_velocity: ArrayLike = _ZERO, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
              wheels: Sequence[Record] = (), torques: Sequence[Record] = (), mass: float = 1.0, centre_of_mass: ArrayLike = _ZERO,
              fixed: bool = False, rotor_momentum: ArrayLike = _ZERO, orbit: Record | None = None, field: Record | None = None,
              velocity: ArrayLike = _ZERO, position: ArrayLike = _ZERO, start_time: float = 0.0) -> dict[str, str]:
    """Name of each family, and why the scene is not exactly an instance of it; empty where it is.

    Arguments as of `solve`.
    """
    scene = _scene(inertia, mass, centre_of_mass, fixed, rotor_momentum, wheels, torques, orbit, field, attitude, angular_velocity, velocity, position)
    found = _core.general_recognise(scene=since(start_time, scene), times=np.asarray(times, dtype=float) - start_time)
    return {name: why or "" for name, why in found}
