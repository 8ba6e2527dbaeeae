# SPDX-License-Identifier: BSD-3-Clause
"""One body, any wheels, any sum of torques.

    M = J w + sum I_k Om_k u_k + l,   dM/dt = M x w + tau,   dq/dt = q (0, w)/2,   d(I_k (Om_k + u_k.w))/dt = T_k - c_k Om_k,
J the inertia of the whole, wheels locked, about the fixed point or the mass centre, Om_k the rate of wheel k about its axis u_k. Body axes and SI
units where nothing else is said. Equations, torques and the families that are found in a scene: docs/general.md.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.asking import Ask, asked
from gyrostat.broadcast import Floats, array, number, numbers, record, whole
from gyrostat.errors import DomainError
from gyrostat.families import answer_of
from gyrostat.families.general.clock import orbit_since, since
from gyrostat.fields import LIMIT
from gyrostat.orientation import axes_of

__all__ = ["PLANETS", "Monitor", "integrate", "orbit_start", "recognise", "segments", "solve"]

# The keys of a table [[wheel]], [[torque]], [orbit] or [field] of a scene file, in SI units.
Record = Mapping[str, Any]

# Gravitational parameter [m^3/s^2] and equatorial radius [m].
PLANETS: Final[dict[str, tuple[float, float]]] = {
    "earth": (3.986004415e14, 6378137.0), "moon": (4.902800066e12, 1738100.0), "mars": (4.282837362e13, 3396190.0),
    "venus": (3.24858592e14, 6051800.0), "mercury": (2.2031868551e13, 2440530.0), "jupiter": (1.26712764100000e17, 71492000.0),
    "saturn": (3.7940584841800e16, 60268000.0), "sun": (1.32712440041279419e20, 695700000.0),
}

# f(t, attitude, angular_velocity, angular_momentum, rotor_rate) -> three numbers; a function of ctypes or numba; or the address of a compiled one.
Law = Callable[..., Any] | int

_ZERO: Final = (0.0, 0.0, 0.0)
# Arguments of `solve` that say what is asked, and not of which motion.
QUESTION: Final = ("times", "tolerance", "model", "integrator", "recognise", "monitor", "ask", "euler")


# What the start may be off in, in the order of the compiled structure.
START_ERRORS: Final = ("attitude", "angular_velocity", "rotor_rate", "rotor_angle", "velocity", "position")


# What is made of a scene with numbers that vary over rows has the rows in front. Each row comes out as it would alone, to the last bit: nothing here
# is left to a library whose order of operations could hang on how many rows there are.


class OverRows(np.ndarray[Any, np.dtype[np.float64]]):
    """A number of a scene that varies: (n,)."""


def varies(value: Any) -> bool:
    """It, or a number in it, is OverRows."""
    return isinstance(value, OverRows) or (isinstance(value, tuple) and any(map(varies, value)))


def stacked(value: Any, name: str = "a number of the scene") -> Floats:
    """A number, or nested sequences of numbers, as one array (..., shape)."""
    if isinstance(value, OverRows) or not varies(value):
        return array(name, value)
    depth, inner = 1, value[0]
    while isinstance(inner, tuple):
        depth, inner = depth + 1, inner[0]
    return np.stack(np.broadcast_arrays(*map(stacked, value)), -depth)


def dot(a: Floats, b: Floats) -> Floats:
    """(..., 3), (..., 3) -> (...)."""
    made: Floats = a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]
    return made


def turned(matrix: Floats, vector: Floats) -> Floats:
    """(..., 3, 3), (..., 3) -> (..., 3)."""
    return np.stack([dot(matrix[..., i, :], vector) for i in range(3)], -1)


def diagonal(moments: Floats) -> Floats:
    """(..., 3) -> (..., 3, 3)."""
    made: Floats = np.where(np.eye(3) > 0, moments[..., None], 0.0)
    return made


def unit(vector: Floats) -> Floats:
    """A vector brought to unit length; NaN where it has none. Two divisions take a unit vector to itself."""
    for _ in range(2):
        lengths = [math.hypot(*each) for each in vector.reshape(-1, 3).tolist()]
        with np.errstate(invalid="ignore"):
            vector = vector / np.reshape(lengths, (*vector.shape[:-1], 1))
    return vector


def _unit(axis: Any, what: str) -> Floats:
    given = stacked(axis, what)
    if given.shape[-1:] != (3,):
        raise DomainError(f"{what} has the shape {given.shape}, not (3,)")
    made = unit(given)
    if made.ndim == 1 and not np.all(np.isfinite(made)):
        raise DomainError(f"{what} = {given.tolist()}: give a vector of finite length that is not 0")
    return made


def _matrix(value: Any, what: str) -> Floats:
    """A number, three of them along the diagonal, or all nine."""
    given = stacked(value, what)
    of_moments = isinstance(value, tuple) and not isinstance(value[0], tuple)
    if given.shape and given.shape[-1] != 3:
        raise DomainError(f"{what} has the shape {given.shape}: give one number, (3,) or (3, 3)")
    if given.ndim >= 2 and not of_moments:
        return given
    return diagonal(given) if given.ndim else float(given) * np.eye(3)


def _or(value: Any, default: Any) -> Any:
    return default if value is None else value


def _ratio(above: Any, below: Any) -> Any:
    """Not finite where there is nothing below."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.divide(above, below)


@cache
def _known(what: str, kind: str = "") -> frozenset[str]:
    """The keys of a table of a scene file; of a wheel or a torque those of its types."""
    from gyrostat.families.general import scene

    sorts = {"wheel": scene.WHEELS, "torque": scene.TORQUES}.get(what)
    if sorts is None:
        return frozenset(field.name for field in scene.KEYS[what])
    return frozenset(field.name for table in sorts if kind in table[0].choices for field in table)


def _record(given: Any, what: str, place: str, default: str | None) -> Record:
    """A wheel or a torque whose keys are those of its type."""
    if not isinstance(given, Mapping):
        raise DomainError(f"{place} = {str(given)[:60]}: give a mapping, with the keys of [[{what}]] of a scene file")
    kind = given.get("type") or default
    known = _known(what, kind) if isinstance(kind, str) else frozenset[str]()
    if not known:
        raise DomainError(f"{place} has no type" if kind is None else f"{place}: there is no type {kind!r}")
    if not given.keys() <= known:
        record(place, given, (), sorted(known))
    return given


def _of(given: Record, key: str, place: str) -> Any:
    """What a record must have."""
    if given.get(key) is None:
        raise DomainError(f"{place} has no {key}")
    return given[key]


def _table(given: Record | None, width: int, place: str) -> dict[str, Any] | None:
    if given is None:
        return None
    if width == 1:
        record(place, given, ("times", "values"), ("interpolation", "extend", "mean", "amplitude", "rate", "phase"))
    values = stacked(_of(given, "values", place), f"{place}: values")
    return {"times": stacked(_of(given, "times", place), f"{place}: times"), "values": values if width > 1 else values[..., None],
            "interpolation": given.get("interpolation") or "linear", "extend": given.get("extend") or "zero"}


def _one_of(given: Record, keys: tuple[str, ...], place: str, wanted: bool) -> None:
    """Of keys that say the same one may be given, or is wanted."""
    there = [key for key in keys if given.get(key) is not None]
    if len(there) > 1:
        raise DomainError(f"{place}: {' and '.join(there)} are both given: give one of them")
    if wanted and not there:
        raise DomainError(f"{place} has no {' or '.join(keys)}")


def _wheel(given: Record, place: str) -> dict[str, Any]:
    _record(given, "wheel", place, "held")
    _one_of(given, ("rate", "momentum"), place, False)
    _one_of(given, ("slope", "stall_torque"), place, given.get("type") == "motor")
    if given.get("type") == "torque":
        _of(given, "torque", place)
    for key in ("mass", "position", "equatorial_inertia"):
        if given.get(key) is not None:
            raise DomainError(f"{place}: {key} is given, but its inertia is part of `inertia`, that of the whole: leave it out")
    kind, inertia = given.get("type") or "held", _or(given.get("axial_inertia"), 0.0)
    rate, torque, no_load = given.get("rate"), given.get("torque"), _or(given.get("no_load_rate"), 0.0)
    driven = torque if isinstance(torque, Mapping) else None
    tabled = rate if isinstance(rate, Mapping) else None
    if given.get("momentum") is not None:
        rate = _ratio(given["momentum"], inertia)
    slope = given.get("slope")
    if given.get("stall_torque") is not None:
        slope = _ratio(given["stall_torque"], no_load)
    return {"type": kind, "axis": _unit(_of(given, "axis", place), f"{place}.axis"), "axial_inertia": inertia, "rate": 0.0 if tabled or rate is None else rate,
            "angle": _or(given.get("angle"), 0.0), "torque": 0.0 if driven or torque is None else torque, "friction": _or(given.get("friction"), 0.0),
            "slope": _or(slope, 0.0), "no_load_rate": no_load, "table": _table(tabled or driven, 1, f"{place}: its table")}


# The key that holds the vector of a torque.
_VECTOR: Final = {"constant": "torque", "thrust": "force", "magnetic": "dipole", "charge": "momentum", "brake": "limit"}
_LAWS: Final = {"total": "momentum", "carrier": "carrier-momentum"}
_FACTOR: Final = ("mean", "amplitude", "rate", "phase", "times", "values", "interpolation", "extend")


def _torque(given: Record, place: str) -> dict[str, Any]:
    _record(given, "torque", place, None)
    kind, factor = given["type"], given.get("factor") or {}
    if factor:
        record(f"{place}: factor", factor, (), _FACTOR)
        if (factor.get("rate") is None) == (factor.get("times") is None) or (factor.get("times") is None and factor.get("amplitude") is None):
            raise DomainError(f"{place}: factor is neither a wave nor a table: give mean, amplitude, rate and phase, or times and values")
    if kind in ("damping", "eddy-current"):
        _one_of(given, ("matrix", "coefficient"), place, True)
    law = given.get("law") or "total"
    if law not in _LAWS:
        raise DomainError(f"{place}: law = {law!r}: use total or carrier")
    opposed = _LAWS[law] if kind == "brake" else given.get("against") or "angular-velocity"
    matrix = given.get("matrix") if given.get("matrix") is not None else given.get("coefficient")
    vector = _of(given, _VECTOR[kind], place) if kind in _VECTOR else _ZERO
    if not isinstance(vector, Sequence | np.ndarray):
        if kind != "brake":
            raise DomainError(f"{place}: {_VECTOR[kind]} = {vector!r}: give three numbers")
        vector = [vector] * 3  # the same about all axes
    on = np.empty((0, 2)) if given.get("on") is None else stacked(given["on"], f"{place}: on")
    wave = factor if "rate" in factor and factor["rate"] is not None else {}
    return {"type": kind, "axes": given.get("frame") or "body", "opposed": opposed,
            "vector": stacked(vector),
            "point": stacked(_or(given.get("point"), _ZERO)), "matrix": _matrix(0.0 if matrix is None else matrix, f"{place}: matrix"),
            "gradient": given.get("gradient"), "table": _table(given, 3, place) if kind == "table" else None,
            "factor_table": _table(factor, 1, f"{place}: factor") if factor.get("times") is not None else None, "mean": _or(wave.get("mean"), 0.0) if wave else 1.0,
            "amplitude": _or(wave.get("amplitude"), 0.0), "rate": _or(wave.get("rate"), 0.0), "phase": _or(wave.get("phase"), 0.0), "on": on}


def _cosine(angle: Any) -> Any:
    """One number at a time: of arrays numpy takes another cosine on some machines."""
    return np.reshape([math.cos(each) for each in np.ravel(angle).tolist()], np.shape(angle)) if np.ndim(angle) else math.cos(angle)


def _orbit(given: Record | None) -> dict[str, Any] | None:
    if given is None:
        return None
    if not isinstance(given, Mapping) or not given.keys() <= _known("orbit"):
        record("orbit", given, (), sorted(_known("orbit")))
    if (name := given.get("planet") or "earth") not in PLANETS:
        raise DomainError(f"orbit.planet = {name!r}: use one of {', '.join(PLANETS)}")
    sizes = [key for key in ("radius", "altitude", "rate", "period") if given.get(key) is not None]
    if not sizes:
        raise DomainError("orbit: give its radius, altitude, rate or period")
    if "altitude" in sizes and len(sizes) > 1 or {"rate", "period"} <= set(sizes) or (len(sizes) > 1 and given.get("mu") is not None):
        sizes += ["mu"] if given.get("mu") is not None else []
        raise DomainError(f"orbit: {' and '.join(sizes)} say the same: give one of them")
    for key in (*sizes, "mu"):
        value = given.get(key)
        # a row of many with a wrong number has its reason
        if value is None or key == "altitude" or varies(value):
            continue
        if not 0 < number(f"orbit.{key}", value) < math.inf:
            raise DomainError(f"orbit.{key} = {value}: give a finite number > 0")
    mu, planet = given.get("mu"), PLANETS[name]
    radius, rate = given.get("radius"), given.get("rate")
    # of an orbit that is given by numbers of its own the planet is not known
    surface = planet[1] if given.get("altitude") is not None or (radius is not None and mu is None and rate is None) else 0.0
    if given.get("altitude") is not None:
        radius = planet[1] + given["altitude"]
    # mu over that of a circle of the same size and rate
    eccentricity = _or(given.get("eccentricity"), 0.0)
    if not varies(eccentricity) and not 0 <= number("orbit.eccentricity", eccentricity) < 1:
        raise DomainError(f"orbit.eccentricity = {eccentricity}: give a number in [0, 1)")
    share = 1 + eccentricity * _cosine(_or(given.get("true_anomaly"), 0.0))
    if given.get("period") is not None:  # the mean rate: at t = 0 it is that times share^2/(1 - e^2)^(3/2)
        flat = 1 - eccentricity * eccentricity
        rate = 2 * math.pi / given["period"] * (share * share / (flat * np.sqrt(flat)))
    if rate is not None:
        # the size of an orbit of given rate matters to the field of a dipole alone
        mu = planet[0] if mu is None and radius is None else mu
        radius = np.cbrt(mu * share / (rate * rate)) if radius is None else radius
        mu = rate * rate * (radius * radius * radius) / share
    told = {key: given[key] for key in ("rate", "period") if given.get(key) is not None}
    told["lengths"] = (planet[1], given["altitude"]) if given.get("altitude") is not None else (radius,)
    radial = _unit(_or(given.get("radial"), (1.0, 0.0, 0.0)), "orbit.radial")
    along = stacked(_or(given.get("along"), (0.0, 1.0, 0.0)))
    if along.shape == radial.shape == (3,) and np.any(along) and not np.any(along - radial * dot(radial, along)[..., None]):
        raise DomainError(f"orbit.along = {along.tolist()} has the direction of orbit.radial: give the direction of flight, across it")
    for _ in range(2):  # what is radial is dropped; of axes nearly along each other the first time leaves roundings of it
        along = _unit(along - radial * dot(radial, along)[..., None], "orbit.along")
    return {"radius": radius, "mu": planet[0] if mu is None else mu, "eccentricity": eccentricity,
            "true_anomaly": _or(given.get("true_anomaly"), 0.0), "radial": radial,
            "along": along, "surface": surface, "told": told}


def orbit_start(orbit: Record, time: float = 0.0) -> tuple[Floats, Floats]:
    """The axes of an orbit at a time [s] as columns (3, 3), x along it, y against its normal, z to the centre, and their rate of turn (3,) [rad/s],
    inertial axes.

    orbit : the keys of the table [orbit] of a scene file, in SI units.
    """
    at_zero = _orbit(orbit)
    if at_zero is None:
        raise DomainError("orbit: give the keys of [orbit]")
    if not abs(at := number("time", time)) <= LIMIT:
        raise DomainError(f"time = {at!r}: give a number of size at most {LIMIT:g} (s)")
    made = orbit_since(at, at_zero)
    radial, along = np.broadcast_arrays(made["radial"], made["along"])
    radius, normal = np.asarray(made["radius"]), np.cross(radial, along)
    speed = np.sqrt(made["mu"] / radius * (1 + made["eccentricity"] * _cosine(made["true_anomaly"])))
    return np.stack([along, -normal, -radial], -1), (speed / radius)[..., None] * normal


# The keys of a field that turns, and of that of a dipole.
_FIELDS: Final = {"rotating": ("axis", "rate", "vector"), "dipole": ("axis", "strength", "radius")}


def _field(given: Record | None) -> dict[str, Any]:
    given = {} if given is None else given
    if given is not None and (not isinstance(given, Mapping) or not given.keys() <= _known("field")):
        record("field", given, (), sorted(_known("field")))
    _one_of(given, ("uniform", "rotating", "dipole"), "field", False)
    kind = next((name for name in ("uniform", "rotating", "dipole") if given.get(name) is not None), "none")
    part: Record = given[kind] if kind in ("rotating", "dipole") else {}
    if part:
        record(f"field.{kind}", part, _FIELDS[kind])
    flux = given["uniform"] if kind == "uniform" else part.get("vector", _ZERO)
    down, axis = given.get("down"), part.get("axis")
    return {"gravity": _or(given.get("gravity"), 0.0), "down": np.array((0.0, 0.0, -1.0)) if down is None else _unit(down, "field.down"), "magnetic": kind,
            "flux_density": stacked(flux), "axis": np.array((0.0, 0.0, 1.0)) if axis is None else _unit(axis, "field.axis"),
            "rate": part.get("rate", 0.0), "strength": part.get("strength", 0.0), "radius": part.get("radius", 1.0)}


def _check_forces(torques: Sequence[Record], mass: Any, gravity: Any, fixed: bool) -> None:
    """What a force does without the mass or the gravity that it needs would be what nobody meant."""
    for place, torque in enumerate(torques):
        kind = torque.get("type")
        if kind == "weight" and fixed:
            for name, given, unit in (("mass", mass, "kg"), ("field.gravity", gravity, "m/s^2")):
                if given is None:
                    raise DomainError(f"{name}: it is missing, and torque[{place}] (weight) is mass times gravity: give it, in {unit}")
        elif kind == "thrust" and not fixed and mass is None:
            raise DomainError(f"mass: it is missing, and torque[{place}] (thrust) moves the mass centre: give it, in kg, or the torque alone, as a "
                              'torque of the type "constant"')


def posed(*, inertia: Any, angular_velocity: Any = _ZERO, attitude: Any = (0.0, 0.0, 0.0, 1.0), wheels: Sequence[Record] = (),
          torques: Sequence[Record] = (), mass: Any = None, centre_of_mass: Any = _ZERO, fixed: bool = False, rotor_momentum: Any = _ZERO,
          orbit: Record | None = None, field: Record | None = None, velocity: Any = _ZERO, position: Any = _ZERO) -> dict[str, Any]:
    """The physics of `solve` as the compiled ladder takes it."""
    if not isinstance(fixed, bool | np.bool_):
        raise DomainError(f"fixed = {fixed!r}: give True or False")
    for name, given in (("wheels", wheels), ("torques", torques)):
        if not isinstance(given, Sequence) or isinstance(given, str):
            raise DomainError(f"{name} = {given!r}: give a list of records")
    acting = [_torque(each, f"torque[{place}]") for place, each in enumerate(torques)]
    around = _field(field)
    _check_forces(torques, mass, (field or {}).get("gravity"), fixed)
    return {
        "body": {"inertia": _matrix(inertia, "inertia"), "mass": stacked(1.0 if mass is None else mass)[()], "mass_given": mass is not None, "centre_of_mass": stacked(centre_of_mass), "fixed": fixed,
                 "rotor_momentum": stacked(rotor_momentum)},
        "wheels": [_wheel(each, f"wheel[{place}]") for place, each in enumerate(wheels)],
        "torques": acting, "orbit": _orbit(orbit), "field": around,
        "initial": {"attitude": stacked(attitude), "angular_velocity": stacked(angular_velocity), "velocity": stacked(velocity),
                    "position": stacked(position)},
    }


def _with_angles(ask: Ask | None, euler: str | None) -> Ask | None:
    """A sequence of angles asks for them."""
    if euler is None or ask is None or isinstance(ask, str) or "euler" in ask:
        return ask
    return {**ask, "euler": "default"} if isinstance(ask, Mapping) else (*ask, "euler")


# No system maps memory below.
_PAGES: Final = 65536


def law_of(torque: Any) -> Any:
    """A torque of the caller's own as the compiled ladder takes it: a callable, or an address."""
    compiled: type[Any] = ctypes.CFUNCTYPE(None).__mro__[1]
    if isinstance(torque, compiled):
        torque = ctypes.cast(torque, ctypes.c_void_p).value or 0
    address = getattr(torque, "address", torque)
    if isinstance(address, int) and not isinstance(address, bool):
        if address < _PAGES:
            raise DomainError(f"torque = {address}: there is no function at this address; a torque that is constant stands in `torques`")
        return address
    if not callable(torque):
        raise DomainError(f"torque = {torque!r}: give a function of t, attitude, angular_velocity, angular_momentum and rotor_rate, or a compiled one")
    return torque


def _by_clock(start_time: Any, times: ArrayLike) -> tuple[float, Floats, Floats]:
    """The clock's time at the start, the asked times by it, and those since the start."""
    start, at = number("start_time", start_time), array("times", times)
    if not abs(start) <= LIMIT:
        raise DomainError(f"start_time = {start!r}: give a number of size at most {LIMIT:g} (s)")
    if at.size and at.flat[0] < start:
        raise DomainError(f"times: the first, {at.flat[0]:g} s, is before start_time = {start:g} s")
    return start, at, at - start


def _own(torque: Law | None, breakpoints: ArrayLike, start_time: float) -> dict[str, Any]:
    """The arguments of the compiled ladder that are of a torque of the caller's own."""
    if torque is None and isinstance(breakpoints, tuple) and not breakpoints:
        return {}
    times = np.atleast_1d(array("breakpoints", breakpoints))
    if times.ndim != 1 or not np.all(np.isfinite(times)):
        raise DomainError("breakpoints: give finite times [s]")
    if torque is None:
        if times.size:
            raise DomainError("breakpoints: they are of a torque of your own, and there is none")
        return {}
    return {"torque": law_of(torque), "breakpoints": (times - start_time).tolist()}


def solve(*, inertia: ArrayLike, times: ArrayLike, angular_velocity: ArrayLike = _ZERO, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
          wheels: Sequence[Record] = (), torques: Sequence[Record] = (), mass: float | None = None, centre_of_mass: ArrayLike = _ZERO, fixed: bool = False,
          rotor_momentum: ArrayLike = _ZERO, orbit: Record | None = None, field: Record | None = None, velocity: ArrayLike = _ZERO,
          position: ArrayLike = _ZERO, tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto", recognise: bool = True,
          monitor: Monitor | None = None, ask: Ask | None = None, start_time: float = 0.0, start_error: Mapping[str, float] | None = None,
          euler: str | None = None, torque: Law | None = None, breakpoints: ArrayLike = ()) -> Answer:
    """Answer of the ladder, as `gyrostat.solve` gives it for scenes.

    inertia : (3,) principal moments or (3, 3) tensor of the whole, wheels locked, about the mass centre, or where the body is fixed about its origin
    [kg m^2]; mass [kg] : needed where a weight acts, as is field.gravity, and where a thrust acts on a free body;
    centre_of_mass : (3,) from the origin [m]; fixed : the origin is held in space; rotor_momentum : (3,) of wheels that
    are not listed, constant [N m s]; wheels, torques : each with the keys of [[wheel]] and [[torque]] of a scene file, in SI units; orbit,
    field : the keys of those tables; attitude : (4,) [x, y, z, w] at t = 0, body to inertial; angular_velocity : (3,) at t = 0, body axes [rad/s];
    velocity, position : (3,) of the mass centre of a free body at t = 0, inertial axes [m/s], [m]; times : (n,) increasing, first >= 0 [s];
    tolerance : greatest relative error wanted in what is asked; recognise : whether the rungs of the families are asked of which the scene is
    exactly an instance.
    ask : columns and scalars wanted: names, "all", or name -> tolerance, relative or with a unit ("0.1 deg"); None: attitude, angular
    velocity, rates and angles of the wheels, and the angles of `euler`.
    start_time : where the clock of times, tables, waves and orbit stands at the start [s]: attitude, rates and path are given there, and the first
    of the times may not be before it.
    start_error : by how much the start may be off, absolute: attitude [rad], angular_velocity, rotor_rate [rad/s], rotor_angle [rad], velocity,
    position, each the length of its error (of rates and angles over the wheels); what comes of it is part of the errors of the answer.
    euler : sequence of the column `euler`, which is asked for with it, as "3-2-1" or "ZYX": R = R3(a1) R2(a2) R1(a3), body to inertial; None: there is no such column.
    torque : of your own, beside `torques` (docs/general.md, section 7): f(t, attitude (4,), angular_velocity (3,), angular_momentum (3,), rotor_rate (n,))
    -> (3,) about the reference point, body axes [N m], with t on the clock of times; or a compiled void(double t, const double *state, double *torque),
    as a function of ctypes, a cfunc of numba or its address, the state being these arrays one behind the other. No family is looked for.
    breakpoints : (n,) times at which that torque jumps or has kinks [s].
    Raises DomainError for an argument outside its domain, for a wheel that the body cannot hold, for a rung that cannot compute the
    motion, and for a torque without a finite value; what `torque` raises; ConvergenceError where a computation hits its cap; Cancelled where the monitor stopped it.
    """
    scene = posed(inertia=inertia, angular_velocity=angular_velocity, attitude=attitude, wheels=wheels, torques=torques, mass=mass,
                  centre_of_mass=centre_of_mass, fixed=fixed, rotor_momentum=rotor_momentum, orbit=orbit, field=field, velocity=velocity, position=position)
    start_time, at, since_start = _by_clock(start_time, times)
    if euler is not None and not isinstance(euler, str):
        raise DomainError(f'euler = {euler!r}: give a sequence of axes, as "3-2-1"')
    if start_error:
        record("start_error", start_error, (), START_ERRORS)
        start_error = numbers(**{name: value for name, value in start_error.items() if value is not None})
    asking: dict[str, Any] = {"times": at, **numbers(tolerance=tolerance), "model": model, "integrator": integrator}
    made = _core.general_solve(scene=since(start_time, scene), **{**asking, "times": since_start}, recognise=recognise, monitor=monitor,
                               ask=asked("general", _with_angles(ask, euler)), start_error=dict(start_error or {}),
                               euler=None if euler is None else axes_of(euler), **_own(torque, breakpoints, start_time))
    body = {**scene["body"], **scene["initial"]}
    if not body.pop("mass_given"):
        body["mass"] = None
    going_on = {"start_time": start_time or None, "start_error": dict(start_error) if start_error else None}
    records = {"wheels": [dict(each) for each in wheels] or None, "torques": [dict(each) for each in torques] or None,
               "orbit": None if orbit is None else dict(orbit), "field": None if field is None else dict(field)}
    answer = answer_of("general", made, {**body, **asking, **records, "recognise": None if recognise else False, "ask": ask, "euler": euler, **going_on})
    return answer if torque is None else replace(answer, own_torque=True)


def recognise(*, inertia: ArrayLike, times: ArrayLike, angular_velocity: ArrayLike = _ZERO, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
              wheels: Sequence[Record] = (), torques: Sequence[Record] = (), mass: float | None = None, centre_of_mass: ArrayLike = _ZERO,
              fixed: bool = False, rotor_momentum: ArrayLike = _ZERO, orbit: Record | None = None, field: Record | None = None,
              velocity: ArrayLike = _ZERO, position: ArrayLike = _ZERO, start_time: float = 0.0) -> dict[str, str]:
    """Name of each family, and why the scene is not exactly an instance of it; empty where it is.

    Arguments as of `solve`.
    """
    scene = posed(inertia=inertia, angular_velocity=angular_velocity, attitude=attitude, wheels=wheels, torques=torques, mass=mass,
                  centre_of_mass=centre_of_mass, fixed=fixed, rotor_momentum=rotor_momentum, orbit=orbit, field=field, velocity=velocity, position=position)
    start_time, _, since_start = _by_clock(start_time, times)
    found = _core.general_recognise(scene=since(start_time, scene), times=since_start)
    return {name: why or "" for name, why in found}


def segments(*, times: ArrayLike, start_time: float = 0.0, **physics: Any) -> list[tuple[float, float, tuple[str, ...]]]:
    """Begin, end [s] and families of each segment between times at which torques or wheels change, where each is an instance of a family; empty where
    the motion cannot be answered so.

    physics : arguments of `solve` that are no question.
    """
    start_time, _, since_start = _by_clock(start_time, times)
    found = _core.general_segments(scene=since(start_time, posed(**physics)), times=since_start)
    return [(begin + start_time, end + start_time, tuple(families)) for begin, end, families in found]


def integrate(*, times: ArrayLike, method: str, tolerance: float, order: int = 20, precision: str = "double", patience: float = math.inf,
              start_time: float = 0.0, **physics: Any) -> dict[str, Any]:
    """The full equations under one integrator, timed, anew from each time at which a torque or a wheel changes its law.

    physics : arguments of `solve` that are no question; times and start_time as there; method : taylor (of order 20; in long double 30), dop853, and where
    the build has them cvode-adams and cvode-bdf; patience : CPU time after which it gives up [s].
    Returns columns attitude and angular_velocity, seconds, rhs, steps and status. Raises DomainError.
    """
    start_time, _, since_start = _by_clock(start_time, times)
    made: dict[str, Any] = _core.general_integrate(scene=since(start_time, posed(**physics)), times=since_start,
                                                   method=method, order=whole("order", order), precision=precision, **numbers(tolerance=tolerance, patience=patience))
    return made
