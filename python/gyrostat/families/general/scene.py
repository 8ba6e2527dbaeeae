# SPDX-License-Identifier: BSD-3-Clause
"""The scene file of one body with any wheels and any torques: its keys, the checks that take more than one key, and what they come to."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat import _core
from gyrostat.broadcast import Floats
from gyrostat.errors import DomainError
from gyrostat.families.general.before import EPS, End, end_of
from gyrostat.families.general.functions import PLANETS, OverRows, diagonal, dot, orbit_start, stacked, turned, varies
from gyrostat.fields import REQUIRED, ROUNDING, UNSET, Choices, Field, Found, Table, Values
from gyrostat.rotation import matrix_from_quaternion, quaternion_from_matrix

if TYPE_CHECKING:
    from gyrostat.scenes import Scene

__all__ = ["ALTERNATIVES", "ARGUMENTS", "EXAMPLE", "KEYS", "arguments", "doubts", "mistakes"]

BETWEEN: Final = ("step", "linear", "cubic")
EXTEND: Final = ("zero", "hold")


def _law(meaning: str, unit: str) -> Table:
    """The keys of a table over time."""
    return (Field("times", "times", "times of the table", "s", low=-1e60), Field("values", "numbers", meaning, unit),
            Field("interpolation", "choice", "between the times", default="linear", choices=BETWEEN),
            Field("extend", "choice", "outside of the times", default="zero", choices=EXTEND))


def _wheel(kind: str, *own: Field, meaning: str, default: Any = REQUIRED) -> Table:
    locked = kind == "locked"
    return (
        Field("type", "choice", meaning, default=default, choices=(kind,)),
        Field("name", "text", "name of the wheel", default=""),
        Field("axis", "axis", "axis of the wheel, body axes, of any length"),
        Field("axial_inertia", "number", "inertia of the wheel about its axis; it is part of body.inertia unless body.wheels_in_inertia is false", "kg m^2", 0.0 if locked else REQUIRED,
              low=0 if locked else 1e-40),
        *own,
        Field("mass", "number", "mass of the wheel, where body.wheels_in_inertia is false", "kg", UNSET, low=0, open_low=True),
        Field("position", "vector", "its mass centre from the body's origin, there", "m", UNSET),
        Field("equatorial_inertia", "number", "its inertia about an axis across its own, there; at least half of axial_inertia", "kg m^2", UNSET, low=0),
        Field("angle", "number", "angle of the wheel at t = 0; left out it is 0, or goes on in a scene that has from", "rad", UNSET),
    )


_RATE: Final = (Field("rate", "number", "rate of the wheel at t = 0, relative to the body; left out it is 0, or goes on in a scene that has from", "rad/s", UNSET),
                Field("momentum", "number", "axial inertia times that rate, instead of it", "N m s", UNSET))
_FRICTION: Final = Field("friction", "number", "viscous friction of the bearing", "N m s/rad", 0.0, low=0)
WHEELS: Final[tuple[Table, ...]] = (
    _wheel("held", Field("rate", "number or record", "rate relative to the body, which a motor keeps, or a table of it over time; left out it is 0, or goes on in a scene that has from",
                         "rad/s", UNSET,
                         parts=_law("rates", "rad/s")),
           _RATE[1], meaning="a motor keeps the rate", default="held"),
    _wheel("free", *_RATE, meaning="the wheel turns without friction"),
    _wheel("torque", *_RATE, Field("torque", "number or record", "torque on the wheel about its axis, or a table of it over time; the body feels the "
                                   "opposite", "N m", parts=_law("torques", "N m")), _FRICTION, meaning="a given torque drives the wheel"),
    _wheel("motor", *_RATE, Field("slope", "number", "fall of the motor's torque with its rate", "N m s/rad", UNSET, low=0),
           Field("stall_torque", "number", "torque of the motor at rest, instead of the slope", "N m", UNSET),
           Field("no_load_rate", "number", "rate at which the motor gives no torque", "rad/s"), _FRICTION,
           meaning="a motor of limited power drives the wheel: torque = slope (no_load_rate - rate)"),
    _wheel("friction", *_RATE, Field("friction", "number", "viscous friction of the bearing", "N m s/rad", low=0),
           meaning="its bearing slows the wheel"),
    _wheel("locked", meaning="the wheel is part of the body"),
)

_FACTOR: Final = Field(
    "factor", "record", "the torque is multiplied with mean + amplitude sin(rate t + phase), or with a table", "", UNSET, parts=(
        Field("mean", "number", "mean of a wave", "", UNSET), Field("amplitude", "number", "amplitude of a wave", "", UNSET),
        Field("rate", "number", "rate of a wave", "rad/s", UNSET), Field("phase", "number", "phase of a wave at t = 0", "rad", UNSET),
        Field("times", "times", "times of a table", "s", UNSET, low=-1e60), Field("values", "numbers", "values of a table", "", UNSET),
        Field("interpolation", "choice", "between the times", default=UNSET, choices=BETWEEN),
        Field("extend", "choice", "outside of the times", default=UNSET, choices=EXTEND)))


def _torque(kind: str, *own: Field, meaning: str, factor: bool = True) -> Table:
    return (
        Field("type", "choice", meaning, choices=(kind,)), Field("name", "text", "name of the torque", default=""), *own,
        Field("on", "intervals", "when the torque acts, from and to; it acts always where this is left out", "s", UNSET),
        *((_FACTOR,) if factor else ()))


def _frame(*frames: str) -> Field:
    return Field("frame", "choice", "axes in which it is given" + (": orbit is radial, along, normal, other axes than those of initial.relative_to" if "orbit" in frames else ""), default=frames[0], choices=frames)


def _damping(*against: str, unit: str, default: Any) -> Table:
    meaning = "-matrix U, U the angular velocity, the total angular momentum, or that of the body with its wheels locked"
    return _torque(
        "damping", Field("against", "choice", "what it opposes", default=default, choices=against),
        Field("matrix", "matrix", "matrix of the damping", unit, UNSET), Field("coefficient", "matrix", "one number for all axes, or three, instead of "
                                                                               "the matrix", unit, UNSET), meaning=meaning)


TORQUES: Final[tuple[Table, ...]] = (
    _torque("constant", Field("torque", "vector", "torque", "N m"), _frame("body", "inertial", "orbit"), meaning="a torque constant in its axes"),
    _torque("table", _frame("body", "inertial", "orbit"), Field("times", "times", "times of the table", "s", low=-1e60),
            Field("values", "rows", "torques at these times", "N m"), Field("interpolation", "choice", "between the times", default="linear", choices=BETWEEN),
            Field("extend", "choice", "outside of the times", default="zero", choices=EXTEND), meaning="a torque over time", factor=False),
    _damping("angular-velocity", unit="N m s/rad", default="angular-velocity"),
    _damping("momentum", "carrier-momentum", unit="1/s", default=REQUIRED),
    _torque("brake", Field("limit", "vector", "greatest torques about the body axes", "N m", low=0),
            Field("law", "choice", "whether they oppose the total momentum, or that of the body alone, its wheels locked", default="total",
                  choices=("total", "carrier")), meaning="-limit U/|U| along each body axis"),
    _torque("weight", meaning="of the mass centre about the fixed point, by field.gravity along field.down"),
    _torque("gravity-gradient", Field("gradient", "number", "N = 3 g/R of a centre far along field.down, instead of the orbit's", "1/s^2", UNSET),
            meaning="N d x J d, to the centre of the orbit or along field.down"),
    _torque("magnetic", Field("dipole", "vector", "magnetic moment of the body", "A m^2"), meaning="of a dipole in the magnetic field"),
    _torque("eddy-current", Field("matrix", "matrix", "matrix K of (K (w x B)) x B, w relative to the field", "S m^4", UNSET),
            Field("coefficient", "matrix", "one number for all axes, or three, instead of the matrix", "S m^4", UNSET),
            meaning="currents that turning in the magnetic field induces"),
    _torque("thrust", Field("force", "vector", "force", "N"), Field("point", "vector", "where it acts, from the body's origin", "m", (0.0, 0.0, 0.0)),
            _frame("body", "inertial"), meaning="a force at a point of the body"),
    _torque("charge", Field("momentum", "vector", "e_H n of the torque w x e_H n", "N m s"), meaning="of a charged body in a magnetic field"),
)

_DIRECTION: Final = "of any length"
# What a wheel has that is not part of body.inertia.
APART: Final = ("mass", "position", "equatorial_inertia")
KEYS: Final[dict[str, Table]] = {
    "": (Field("from", "text or record", "the scene, a file or the name of a bundled one, at whose end this one begins: [initial] holds what is otherwise "
               "then, and the clock goes on", "", UNSET, parts=(
                   Field("file", "text", "file or name of the scene", default=UNSET),
                   Field("scene", "scene", "the scene itself, in the layout of a scene file, instead of a file; in Python also a Scene or an Answer", default=UNSET),
                   Field("keep", "choice", "what a body that has changed keeps: its angular velocity, or its angular momentum", default="rates",
                         choices=("rates", "momentum")))),
         Field("wheel", "records", "wheels on the body, a table [[wheel]] each", default=(), sorts=WHEELS, by=("type",)),
         Field("torque", "records", "what acts on the body, a table [[torque]] each", default=(), sorts=TORQUES, by=("type", "against"))),
    "solve": (Field("euler", "sequence", "sequence of the angles in the column `euler`, as 3-2-1 or ZYX: with it body to inertial is R3(a1) R2(a2) R1(a3)",
                    "", UNSET),
              Field("recognise", "flag", "whether the families are asked of which the scene is exactly an instance", default=True),),
    "body": (
        Field("inertia", "inertia", "inertia of the whole, wheels locked: three principal moments along the body axes, or a symmetric 3x3 tensor",
              "kg m^2", low=1e-40),
        Field("inertia_about", "choice", "the point that the inertia is about: where the body is held or else its mass centre, its mass centre, "
              "or the origin of its axes", default="reference", choices=("reference", "mass-centre", "origin")),
        Field("wheels_in_inertia", "flag", "the wheels are part of inertia, mass and centre_of_mass; false: these are of the body without them, and each "
              "wheel has mass, position and equatorial_inertia", default=True),
        Field("mass", "number", "mass; may be left out where no force acts and no inertia is moved from one point to another, and counts as 1 then", "kg", UNSET, low=0,
              open_low=True),
        Field("centre_of_mass", "vector", "mass centre from the body's origin, body axes", "m", (0.0, 0.0, 0.0)),
        Field("fixed", "flag", "the body's origin is held in space", default=False),
        Field("rotor_momentum", "vector", "angular momentum, relative to the body and constant, of wheels that are not listed", "N m s",
              (0.0, 0.0, 0.0)),
    ),
    "orbit": (
        Field("radius", "number", "distance of the mass centre from the centre of attraction at t = 0", "m", UNSET, low=0, open_low=True),
        Field("altitude", "number", "height above the equatorial radius of the planet at t = 0", "m", UNSET),
        Field("rate", "number", "angular rate at t = 0", "rad/s", UNSET, low=0, open_low=True),
        Field("period", "number", "period", "s", UNSET, low=0, open_low=True),
        Field("mu", "number", "gravitational parameter; by default that of the planet", "m^3/s^2", UNSET, low=0, open_low=True),
        Field("planet", "choice", "central body", default="earth", choices=tuple(PLANETS)),
        Field("eccentricity", "number", "eccentricity", "", 0.0, low=0, high=1, open_high=True),
        Field("true_anomaly", "number", "true anomaly at t = 0", "rad", 0.0),
        Field("radial", "axis", f"direction outward at t = 0, inertial axes, {_DIRECTION}", "", (1.0, 0.0, 0.0)),
        Field("along", "axis", f"direction of motion at t = 0, inertial axes, {_DIRECTION}; what of it is radial is dropped", "", (0.0, 1.0, 0.0)),
    ),
    "field": (
        Field("gravity", "number", "gravity, under which a body falls that is not held; left out there is none; that of an orbit is not meant", "m/s^2", UNSET, low=0),
        Field("down", "axis", f"direction of gravity, inertial axes, {_DIRECTION}", "", (0.0, 0.0, -1.0)),
        Field("uniform", "vector", "magnetic flux density, constant, inertial axes", "T", UNSET),
        Field("rotating", "record", "magnetic flux density that turns", "", UNSET, parts=(
            Field("axis", "axis", f"axis of the turn, inertial axes, {_DIRECTION}"), Field("rate", "number", "rate of the turn", "rad/s"),
            Field("vector", "vector", "flux density at t = 0, inertial axes", "T"))),
        Field("dipole", "record", "magnetic field of the central body of the orbit", "", UNSET, parts=(
            Field("axis", "axis", f"direction of its field on the equator (of the Earth northward, against the magnetic moment), inertial axes, {_DIRECTION}"), Field("strength", "number", "flux density on its equator", "T"),
            Field("radius", "number", "distance at which it has that strength", "m", low=0, open_low=True))),
    ),
    "initial": (
        Field("attitude", "turn", "attitude at the start, body to inertial, [x, y, z, w], of any length; by default the body axes are along the "
              "inertial ones", "", UNSET),
        Field("relative_to", "choice", "what the attitude takes the body axes to: inertial axes, or those of the orbit (x along it, y against its "
              "normal, z to the centre)", default="inertial", choices=("inertial", "orbit")),
        Field("angular_velocity", "vector or record", "angular velocity at t = 0, body axes; or its components along inertial axes, or that relative to "
              "the axes of the orbit, body axes", "rad/s", UNSET,
              parts=(Field("inertial", "vector", "inertial axes", "rad/s", UNSET),
                     Field("relative_to_orbit", "vector", "relative to the axes of the orbit, body axes", "rad/s", UNSET))),
        Field("angular_momentum", "vector", "total angular momentum at t = 0, body axes", "N m s", UNSET),
        Field("time", "number", "where the clock of times, tables, waves and the orbit stands at the start; by default 0, or the end of the scene that this one "
              "begins from", "s", UNSET),
        Field("error", "record", "by how much the start may be off, in any direction: what comes of it is part of the errors of the answer", "", UNSET, parts=(
            Field("attitude", "number", "angle", "rad", 0.0, low=0), Field("angular_velocity", "number", "length of its error", "rad/s", 0.0, low=0),
            Field("rotor_rate", "number", "length of its error over the wheels", "rad/s", 0.0, low=0),
            Field("rotor_angle", "number", "length of its error over the wheels", "rad", 0.0, low=0),
            Field("velocity", "number", "length of its error", "m/s", 0.0, low=0), Field("position", "number", "length of its error", "m", 0.0, low=0))),
        Field("velocity", "vector", "velocity of the mass centre of a free body at the start, inertial axes; by default it is at rest", "m/s", UNSET),
        Field("position", "vector", "position of the mass centre of a free body at the start, inertial axes; by default the origin", "m", UNSET),
    ),
}
ALTERNATIVES: Final[tuple[Choices, ...]] = (
    (("initial.angular_velocity",), ("initial.angular_momentum",)),
    (("orbit.radius",), ("orbit.altitude",), ("orbit.rate",), ("orbit.period",), ()),
    (("field.uniform",), ("field.rotating",), ("field.dipole",), ()),
)
# The argument of `solve` that a table is.
ARGUMENTS: Final = {"start_time": ("initial", "time"), "start_error": ("initial", "error"), "wheels": ("", "wheel"), "torques": ("", "torque"), "orbit": ("", "orbit"), "field": ("", "field")}
EXAMPLE: Final[dict[str, Any]] = {
    "solve.duration": "90 min", "solve.euler": "3-2-1", "solve.samples": 541, "body.inertia": (90.0, 120.0, 60.0), "body.mass": "45 kg", "field.gravity": 9.80665, "initial.angular_velocity": (0.0, -0.00113, 0.0002),
    "initial.angular_momentum": (0.0, -0.135, 0.012), "initial.attitude": (0.0, 0.0, 0.0, 1.0), "initial.velocity": (0.0, 0.0, 0.0),
    "initial.position": (0.0, 0.0, 0.0), "initial.time": 0.0,
    "initial.error": {"attitude": "0.1 deg", "angular_velocity": "0.01 deg/s"}, "from": "iss-drift", "orbit.radius": 6778137.0, "orbit.altitude": "400 km", "orbit.rate": 0.00113,
    "orbit.period": "92 min", "orbit.mu": 3.986004415e14, "field.uniform": (2e-5, 0.0, -3e-5),
    "field.rotating": {"axis": (0.0, 0.0, 1.0), "rate": 0.0023, "vector": (2e-5, 0.0, 1e-5)},
    "field.dipole": {"axis": (0.17, 0.1, 0.98), "strength": 3.1e-5, "radius": 6371200.0},
    "wheel": ({"type": "held", "axis": (0.0, 1.0, 0.0), "axial_inertia": 0.02, "rate": "-1400 rpm"},),
    "torque": ({"type": "constant", "torque": (0.001, 0.0, 0.0), "on": ((0.0, 600.0),)},),
}


def mistakes(tables: Values) -> Found:
    """What [orbit], [field], wheels and torques need of each other."""
    body, start, orbit, field = (tables[name] for name in ("body", "initial", "orbit", "field"))
    orbiting = any(orbit[name] is not UNSET for name in ("radius", "altitude", "rate", "period"))
    remedy = "add [orbit] with altitude, radius, rate or period"
    if not orbiting and start["relative_to"] == "orbit":
        yield "initial.relative_to", "orbit", "there is no orbit", remedy
    if not orbiting and isinstance(start["angular_velocity"], Mapping) and start["angular_velocity"]["relative_to_orbit"] is not UNSET:
        yield "initial.angular_velocity", start["angular_velocity"], "there is no orbit", remedy
    if field["dipole"] is not UNSET and not orbiting and any(torque["type"] in ("magnetic", "eddy-current") for torque in tables[""]["torque"]):
        yield "field.dipole", field["dipole"], "the field of a dipole is that along an orbit", remedy
    for name in ("eccentricity", "mu"):
        if not orbiting and orbit[name] not in (UNSET, 0.0):
            yield f"orbit.{name}", orbit[name], "there is no orbit", remedy
    names = [wheel["name"] for wheel in tables[""]["wheel"] if wheel["name"]]
    if twice := next((name for name in names if names.count(name) > 1), None):
        yield "wheel", "", f'two wheels have the name "{twice}"', "give each a name of its own, or none"
    if start["time"] is not UNSET and tables[""]["from"] is not UNSET:
        yield "initial.time", start["time"], "the clock goes on from the scene before", "leave it out"
    yield from _asked_in_vain(tables, orbiting)
    for key in ("velocity", "position"):
        if not body["fixed"] or not any(start[key] or ()):
            continue
        yield f"initial.{key}", start[key], "the body is held at its origin", f"leave out {key}, or body.fixed"
    for place, wheel in enumerate(tables[""]["wheel"]):
        yield from _wheel_mistakes(f"wheel[{place}]", wheel, body["wheels_in_inertia"])
    if not body["wheels_in_inertia"] and any(wheel[name] is UNSET for wheel in tables[""]["wheel"] for name in APART):
        return
    yield from _mass_mistakes(body, tables[""]["wheel"])
    moments = np.linalg.eigvalsh(_whole(body, tables[""]["wheel"]).inertia)
    if body["inertia_about"] == "origin" and not body["fixed"] and (moments[0] <= 0 or moments[0] + moments[1] < moments[2] * (1 - 1e-9)):
        yield ("body.inertia", body["inertia"], f"moved from the origin to the mass centre it has the moments {', '.join(f'{m:.6g}' for m in moments)}, which "
               "no body has", "check mass and centre_of_mass, or say what point the inertia is about by inertia_about")
    magnetic = any(field[name] is not UNSET for name in ("uniform", "rotating", "dipole"))
    for place, torque in enumerate(tables[""]["torque"]):
        yield from _torque_mistakes(f"torque[{place}]", torque, orbiting, body["fixed"], magnetic)
        yield from _force_mistakes(f"torque[{place}]", torque, body, field["gravity"])


def _asked_in_vain(tables: Values, orbiting: bool) -> Found:
    """Columns that are asked for by name and that the scene does not have."""
    asked, top, held = tables["solve"]["ask"], tables[""], tables["body"]["fixed"]
    vertical = any(each["type"] == "weight" or (each["type"] == "gravity-gradient" and each["gradient"] is not UNSET) for each in top["torque"])
    for columns, there, why, remedy in (
            (("euler",), tables["solve"]["euler"] is not UNSET, "the sequence of the angles is not said", 'add solve.euler, such as "3-2-1" for yaw, pitch and roll'),
            (("attitude_orbit",), orbiting, "there is no orbit", "add [orbit] with altitude, radius, rate or period"),
            (("rotor_rate", "rotor_angle"), top["wheel"], "there is no wheel", "add [[wheel]], or do not ask for it"),
            (("velocity", "position"), not held, "the body is held at its origin", "leave out body.fixed, or do not ask for it"),
            (("down",), vertical, "nothing acts along field.down", "add a torque of the type weight, or do not ask for it")):
        if isinstance(asked, tuple | Mapping) and not there:
            yield from (("solve.ask", name, why, remedy) for name in columns if name in asked)


def doubts(tables: Values) -> Found:
    """Gravity and a mass centre that nothing feels: the scene of a heavy body has just these keys."""
    field, top = tables["field"], tables[""]
    gravity, other = field["gravity"], any(field[name] is not UNSET for name in ("uniform", "rotating", "dipole"))
    if gravity and any(tables["body"]["centre_of_mass"]) and not (top["torque"] or top["wheel"] or other or top["from"] is not UNSET):
        yield ("field.gravity", gravity, "no kind is named, and nothing here has weight",
               'write kind = "heavy" for a body that is held at a point, or kind = "general" for one that falls freely')


def _wheel_mistakes(key: str, wheel: Mapping[str, Any], in_inertia: bool) -> Found:
    kind = wheel["type"]
    for name in APART:
        if in_inertia and wheel[name] is not UNSET:
            yield key, "", f"{name} is given, but its inertia is part of body.inertia", "leave it out, or set body.wheels_in_inertia = false"
        if not in_inertia and wheel[name] is UNSET:
            yield key, "", f"the key {name} is missing, and the body is without its wheels", "give it, or set body.wheels_in_inertia = true"
    if not in_inertia and wheel["equatorial_inertia"] is not UNSET and 2 * wheel["equatorial_inertia"] < wheel["axial_inertia"] * (1 - ROUNDING):
        yield (key, "", f"equatorial_inertia {wheel['equatorial_inertia']!r} is below half of axial_inertia {wheel['axial_inertia']!r}, which "
               "no body has", "a thin disc has half of it, a ring too")
    if wheel.get("rate") is not UNSET and wheel.get("momentum") is not UNSET:
        yield key, "", f"rate and momentum are both given", "give one of them"
    if kind == "motor" and (wheel["slope"] is UNSET) == (wheel["stall_torque"] is UNSET):
        yield key, "", f"of slope and stall_torque one is wanted", "give the one you know"
    if kind == "motor" and wheel["stall_torque"] is not UNSET and wheel["stall_torque"] * wheel["no_load_rate"] <= 0:
        zero = wheel["stall_torque"] * wheel["no_load_rate"] == 0
        yield (key, "", "stall_torque or no_load_rate is zero" if zero else "stall_torque and no_load_rate differ in sign",
               "give slope in the place of stall_torque" if zero else "both point the way in which the motor drives")
    for name in ("rate", "torque"):
        if isinstance(wheel.get(name), Mapping):
            yield from _lengths(f"{key}.{name}", wheel[name])


def _lengths(key: str, table: Mapping[str, Any]) -> Found:
    if len(table["times"]) != len(table["values"]):
        yield key, "", f"there are {len(table['times'])} times and {len(table['values'])} values", "give one value for each time"


def _torque_mistakes(key: str, torque: Mapping[str, Any], orbiting: bool, fixed: bool, magnetic: bool) -> Found:
    kind = torque["type"]
    if kind in ("damping", "eddy-current") and (torque["matrix"] is UNSET) == (torque["coefficient"] is UNSET):
        yield key, "", "of matrix and coefficient one is wanted", "give one number as coefficient, or nine as matrix"
    if kind == "table":
        yield from _lengths(key, torque)
    if kind == "weight" and not fixed:
        yield key, "", "the weight of a free body has no moment about its mass centre", "leave it out, or set body.fixed = true"
    if (kind == "gravity-gradient" and torque["gradient"] is UNSET or torque.get("frame") == "orbit") and not orbiting:
        yield key, "", "there is no orbit", "add [orbit] with altitude, radius, rate or period"
    if kind in ("magnetic", "eddy-current") and not magnetic:
        yield key, "", "there is no magnetic field", "add [field] with uniform, rotating or dipole"
    factor = torque.get("factor")
    if isinstance(factor, Mapping):
        wave, table = factor["rate"] is not UNSET, factor["times"] is not UNSET
        if wave == table or (wave and factor["amplitude"] is UNSET):
            yield f"{key}.factor", "", "this is neither a wave nor a table", "write { mean = 1.0, amplitude = 0.5, rate = 2.0 } or { times = [...], values = [...] }"
        elif table and any(factor[name] is not UNSET for name in ("mean", "amplitude", "phase")):
            yield f"{key}.factor", "", "this is a table, beside which mean, amplitude and phase mean nothing", "leave them out, or give a wave by its rate"
        elif table and factor["values"] is UNSET:
            yield f"{key}.factor", "", "there are times and no values", "give one value for each time"
        elif table:
            yield from _lengths(f"{key}.factor", factor)


def _mass_mistakes(body: Mapping[str, Any], wheels: Sequence[Mapping[str, Any]]) -> Found:
    """What needs the mass of the body where that is not given."""
    if body["mass"] is not UNSET:
        return
    if wheels and not body["wheels_in_inertia"]:
        yield "body.mass", "", "the key is missing, and the wheels are added to the body", "give it, or set body.wheels_in_inertia = true"
    elif np.any(np.subtract(*_points(body, stacked(body["centre_of_mass"])))):
        yield ("body.mass", "", "the key is missing, and by it the inertia is moved between the origin and the mass centre",
               "give it")


def _force_mistakes(key: str, torque: Mapping[str, Any], body: Mapping[str, Any], gravity: Any) -> Found:
    """What a force needs: what it does without a mass or gravity that were given would be what nobody meant."""
    kind, what = torque["type"], f"{key} ({torque['type']})"
    if kind == "weight" and body["fixed"] and body["mass"] is UNSET:
        yield "body.mass", "", f"the key is missing, and {what} is mass times gravity", "give it"
    if kind == "weight" and body["fixed"] and gravity is UNSET:
        yield "field.gravity", "", f"the key is missing, and {what} is mass times gravity", "give it, such as 9.80665"
    if kind == "thrust" and not body["fixed"] and body["mass"] is UNSET:
        yield "body.mass", "", f"the key is missing, and {what} moves the mass centre", 'give it, or give the torque alone, as a torque of the type "constant"'


# What is converted may cancel, and a slim body makes much of little: it is rounded once, at the end, so that it is as good as what was given.


def _wide(value: Any) -> Any:
    """With more digits, for what is on the way."""
    return np.asarray(value, dtype=np.longdouble)


def _rounded(value: Any) -> Floats:
    made: Floats = np.asarray(value, dtype=np.float64)
    return made


def _times(factor: Any, of: Any) -> Any:
    """A number times a vector or a tensor."""
    return np.reshape(_wide(factor), (*np.shape(factor), *[1] * (2 if of.shape[-2:] == (3, 3) else 1))) * of


def _product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """The product and what its rounding loses (Dekker 1971); nothing of that where a factor is too large to be split."""
    def split(x: Floats) -> tuple[Floats, Floats]:
        high = 134217729.0 * x - (134217729.0 * x - x)
        return high, x - high
    with np.errstate(over="ignore", invalid="ignore"):
        made, (a1, a2), (b1, b2) = a * b, split(a), split(b)
        lost = ((a1 * b1 - made) + a1 * b2 + a2 * b1) + a2 * b2
    return made, np.where(np.isfinite(lost), lost, 0.0)


def _sum(terms: Sequence[Floats]) -> Floats:
    """As if in twice the digits (Ogita, Rump and Oishi 2005, Sum2)."""
    total, lost = terms[0], np.zeros(())
    for term in terms[1:]:
        both = total + term
        part = both - total
        total, lost = both, lost + ((total - (both - part)) + (term - part))
    return total + lost


def _at_centre(inertia: Floats, mass: Any, arm: Floats) -> Floats:
    """An inertia about a point, moved to the mass centre: all digits of a small difference."""
    masses = _rounded(mass)

    def product(i: int, j: int) -> list[Floats]:  # m a_i a_j
        square, lost = _product(arm[..., i], arm[..., j])
        return [*_product(masses, square), masses * lost]

    def entry(i: int, j: int) -> Floats:
        if i != j:
            return _sum([inertia[..., i, j], *product(i, j)])
        return _sum([inertia[..., i, i], *(-term for k in {0, 1, 2} - {i} for term in product(k, k))])

    entries = np.stack(np.broadcast_arrays(*(entry(i, j) for i in range(3) for j in range(3))), -1)
    return entries.reshape(*entries.shape[:-1], 3, 3)


def _solved(inertia: Floats, momentum: Any) -> Any:
    """The angular velocity of a momentum, with the digits of the momentum."""
    rates = _wide(np.zeros(3))
    for _ in range(3):
        left = _rounded(momentum - turned(_wide(inertia), rates))
        rates = rates + np.linalg.solve(inertia, left[..., None])[..., 0]
    return rates


def _axis(wheel: Mapping[str, Any]) -> Any:
    """Unit, with more digits: wheels may hold a hundred times the momentum of the body. NaN where it has no length."""
    axis = _wide(stacked(wheel["axis"]))
    with np.errstate(invalid="ignore"):
        return axis / np.sqrt(dot(axis, axis))[..., None]


def _square(v: Any) -> Any:
    """v v^T"""
    return v[..., :, None] * v[..., None, :]


def _moved(mass: Any, arm: Any) -> Any:
    """What an inertia about the mass centre gains at a point that far from it."""
    return _times(mass, dot(arm, arm)[..., None, None] * np.eye(3) - _square(arm))


@dataclass(frozen=True, slots=True)
class _Whole:
    """The body and its wheels as one."""

    inertia: Floats  # about the fixed point, or the mass centre of a free body
    mass: Any
    centre_of_mass: Floats


def _points(body: Mapping[str, Any], all_centre: Any) -> tuple[Any, Any]:
    """From the body's origin: the point that the inertia is given about, and the one that it is wanted about."""
    about = body["inertia_about"] if body["inertia_about"] != "reference" else "origin" if body["fixed"] else "mass-centre"
    return np.zeros(3) if about == "origin" else _wide(stacked(body["centre_of_mass"])), np.zeros(3) if body["fixed"] else all_centre


def _whole(body: Mapping[str, Any], wheels: Sequence[Mapping[str, Any]]) -> _Whole:
    mass, centre, inertia = 1.0 if body["mass"] is UNSET else body["mass"], _wide(stacked(body["centre_of_mass"])), stacked(body["inertia"])
    inertia = inertia if isinstance(body["inertia"][0], tuple) else diagonal(inertia)
    apart = [] if body["wheels_in_inertia"] else [(each["mass"], stacked(each["position"])) for each in wheels]
    all_mass = mass + sum(m for m, _ in apart)
    all_centre = (_times(mass, centre) + sum(_times(m, r) for m, r in apart)) / _wide(all_mass)[..., None] if apart else centre
    given, reference = _points(body, all_centre)
    differs = np.any(given != reference, -1)
    if np.any(differs):
        at_centre = _at_centre(inertia, mass, _rounded(centre - given))
        inertia = np.where(differs[..., None, None], at_centre + _moved(mass, centre - reference), inertia)
    for wheel, (m, r) in zip(wheels, apart, strict=False):
        across = wheel["equatorial_inertia"]
        inertia = inertia + _times(across, np.eye(3)) + _times(wheel["axial_inertia"] - across, _square(_axis(wheel))) + _moved(m, r - reference)
    return _Whole(_rounded(inertia), all_mass, _rounded(all_centre))


@dataclass(frozen=True, slots=True)
class _Start:
    """A start as `solve` takes it."""

    attitude: Floats
    angular_velocity: Floats
    velocity: Floats
    position: Floats
    wheels: list[dict[str, Any]]
    error: dict[str, float]


def _rate_at(wheel: Mapping[str, Any], time: float) -> Any:
    """The rate that a wheel is given at the start."""
    rate = wheel.get("rate")
    if wheel.get("momentum") is not UNSET:
        return wheel["momentum"] / wheel["axial_inertia"]
    if not isinstance(rate, Mapping):
        return 0.0 if rate is UNSET else rate
    times, values = rate["times"], rate["values"]
    if varies(times) or varies(values):
        rows = [each.tolist() for each in np.broadcast_arrays(*(np.atleast_2d(stacked(each)) for each in (times, values)))]
        return np.array([_rate_at({**wheel, "rate": {**rate, "times": tuple(t), "values": tuple(v)}}, time) for t, v in zip(*rows, strict=True)])
    return _core.general_table_value({**rate, "times": times, "values": np.reshape(values, (-1, 1))}, time)


def _jump_at(wheel: Mapping[str, Any], time: float, before: float | None) -> Any:
    """By how much the table of a wheel's rate steps at a time: a motor that keeps a rate needs none for it. before: the rate with which the scene before
    hands the wheel on, which is what a table that begins here departs from."""
    rate = wheel["rate"]
    if wheel["type"] != "held" or not isinstance(rate, Mapping):
        return 0.0
    times, values = rate["times"], rate["values"]
    if time not in times:
        return 0.0
    place = times.index(time)
    outside = values[0] if rate["extend"] == "hold" else 0.0 if before is None else before
    return _rate_at(wheel, time) - (outside if place == 0 else values[place - 1] if rate["interpolation"] == "step" else values[place])


def _departs(wheel: Mapping[str, Any], time: float) -> bool:
    """Whether the table of its rate begins at a time, and so departs from the rate with which the scene before hands the wheel on."""
    rate = wheel["rate"]
    return wheel["type"] == "held" and isinstance(rate, Mapping) and time == rate["times"][0] and rate["extend"] != "hold"


def _stepped(end: End, whole: _Whole, wheels: list[dict[str, Any]], taken: list[int], time: float) -> tuple[Floats, dict[str, float]]:
    """Angular velocity behind the steps of tables at the start, which no momentum comes with; wheels that turn by themselves keep their absolute rates.
    And its error with that of the wheels' rates, which those grow by that a table departs from."""
    jump, inertia, departing = np.zeros(3), whole.inertia, []
    turning = [wheels[place] for place in taken if wheels[place]["type"] != "held"]
    for place, wheel in enumerate(wheels):
        if wheel["type"] == "held":
            before = _of_before(end, wheel, place)
            jump = jump + _times(wheel["axial_inertia"] * _jump_at(wheel, time, before and before[0]), _axis(wheel))
            if before and _departs(wheel, time):
                departing.append(_times(wheel["axial_inertia"], _axis(wheel)))
    error = {"angular_velocity": end.error["angular_velocity"], "rotor_rate": end.error.get("rotor_rate", 0.0)}
    if not np.any(jump) and not departing:
        return end.angular_velocity, error
    for wheel in turning:
        inertia = inertia - _times(wheel["axial_inertia"], _square(_axis(wheel)))
    inertia = _rounded(inertia)
    grown = error["rotor_rate"] * sum((np.max(np.linalg.norm(_rounded(_solved(inertia, each)), axis=-1)) for each in departing), 0.0)
    error["angular_velocity"] += float(grown)
    error["rotor_rate"] += math.sqrt(len(turning)) * float(grown)
    change = -_rounded(_solved(inertia, jump))
    for wheel in turning:
        wheel["rate"] = wheel["rate"] - _rounded(dot(_axis(wheel), change))
    made: Floats = end.angular_velocity + change
    return made, error


def _rates_of(momentum: Floats, inertia: Floats, body: Mapping[str, Any], wheels: list[dict[str, Any]], time: float) -> Floats:
    """The angular velocity with which body and wheels have a momentum; rates of wheels are relative to the body, so with them J is that of the whole."""
    held = _wide(stacked(body["rotor_momentum"]))
    for wheel in wheels:
        held = held + _times(_wide(wheel["axial_inertia"]) * _rate_at(wheel, time), _axis(wheel))
    return _rounded(_solved(inertia, momentum - held))


def _unit_turn(turn: tuple[Any, ...]) -> tuple[Any, ...]:
    """The unit quaternion of a turn, or of a turn in each row."""
    if not any(isinstance(each, OverRows) for each in turn):
        length = math.hypot(*turn)
        return turn if not abs(length - 1) > ROUNDING else tuple(each / length for each in turn)
    rows = np.stack(np.broadcast_arrays(*turn), -1)
    lengths = np.array([math.hypot(*row) for row in rows.tolist()])
    with np.errstate(invalid="ignore"):
        made = np.where((np.abs(lengths - 1) <= ROUNDING)[:, None], rows, rows / lengths[:, None])
    return tuple(column.view(OverRows) for column in np.ascontiguousarray(made.T))


def _rotation(attitude: Floats) -> Floats:
    """That of an attitude; none where it is not known."""
    known = np.all(np.isfinite(attitude), -1, keepdims=True)
    return matrix_from_quaternion(np.where(known, attitude, (0.0, 0.0, 0.0, 1.0)))


def _wide_rotation(attitude: Floats) -> Any:
    """The same with more digits."""
    known = np.all(np.isfinite(attitude), -1, keepdims=True)
    q = _wide(np.where(known, attitude, (0.0, 0.0, 0.0, 1.0)))
    q = q / np.sqrt(np.sum(q * q, -1, keepdims=True))
    v, w = q[..., :3], q[..., 3, None, None]
    x, y, z = (v[..., i] for i in range(3))
    none = 0 * x
    cross = np.stack([np.stack(row, -1) for row in ((none, -z, y), (z, none, -x), (-y, x, none))], -2)
    return np.eye(3) + 2 * (w * cross + _square(v) - dot(v, v)[..., None, None] * np.eye(3))


def _from_orbit(axes: Floats, attitude: Floats) -> Floats:
    """The attitude of a body whose attitude in the axes of the orbit is given; NaN where it is not known."""
    R, known = _rotation(attitude), np.all(np.isfinite(attitude), -1, keepdims=True)
    sound = np.where(np.all(np.isfinite(axes), (-2, -1), keepdims=True), axes, np.eye(3))
    made: Floats = np.where(known, quaternion_from_matrix(np.stack([turned(sound, R[..., :, i]) for i in range(3)], -1)), np.nan)
    return made


def _of_before(end: End, wheel: Mapping[str, Any], place: int) -> tuple[float, float] | None:
    """Rate and angle of the wheel at the end of the scene before, by its name, or by its place where it has none."""
    return end.wheels.get(wheel["name"] or place + 1)


def _handed_on(wheels: list[dict[str, Any]], end: End) -> tuple[list[dict[str, Any]], list[int]]:
    """The wheels, with rates and angles of those of the same name in the scene before, or of the same place where they have no name, unless they
    have their own; and the places of those whose rate is handed on."""
    made, taken = [], []
    for place, wheel in enumerate(wheels):
        found = _of_before(end, wheel, place)
        if found and wheel["angle"] is UNSET:
            wheel = {**wheel, "angle": found[1]}
        if found and wheel["type"] != "locked" and wheel["rate"] is UNSET and wheel["momentum"] is UNSET:
            wheel = {**wheel, "rate": found[0]}
            taken.append(place)
        made.append(wheel)
    _check_names(wheels, end)
    return made, taken


def _check_names(wheels: Sequence[Mapping[str, Any]], end: End) -> None:
    """Against a wheel that the scene before calls otherwise: it would begin at rest, and what it had be lost."""
    called = [wheel["name"] or place for place, wheel in enumerate(wheels, 1)]
    left = [name for name in end.wheels if name not in called]
    for name, wheel in zip(called, wheels, strict=True):
        if left and name not in end.wheels and wheel["type"] != "locked" and wheel["rate"] is UNSET and wheel["momentum"] is UNSET:
            raise DomainError(f"from: the scene before has no wheel {name}, and {', '.join(map(str, left))} would go on nowhere: give the wheel the name that it has "
                              "there, or a rate of its own")


def _caught(end: End, whole: _Whole, body: Mapping[str, Any], wheels: list[dict[str, Any]], taken: list[int], time: float) -> tuple[Floats, float]:
    """Angular velocity of a body that keeps its angular momentum while it changes, and by how much it may be off. No bearing gives a wheel that turns by
    itself a torque about its axis, so it keeps its absolute rate: its relative one is set anew."""
    momentum, momentum_off = end.momentum(released=end.fixed and not body["fixed"])
    inertia, rest = whole.inertia, momentum - np.array(body["rotor_momentum"], dtype=float)
    stored, turning = 0.0, []
    for place, wheel in enumerate(wheels):
        if wheel["type"] == "locked":
            continue
        axis, axial = np.array(wheel["axis"], dtype=float) / math.hypot(*wheel["axis"]), wheel["axial_inertia"]
        rate = _rate_at(wheel, time)
        if place in taken and wheel["type"] != "held":
            rate += float(axis @ end.angular_velocity)
            inertia = inertia - axial * np.outer(axis, axis)
            turning.append((wheel, axis, rate))
        rest = rest - axial * rate * axis
        stored += axial
    made = _rounded(_solved(inertia, rest))
    for wheel, axis, rate in turning:
        wheel["rate"] = rate - float(axis @ made)
    off = momentum_off + stored * (end.error.get("rotor_rate", 0.0) + end.error["angular_velocity"])
    return made, off / float(np.linalg.eigvalsh(inertia)[0])


def _start(scene: "Scene", whole: _Whole, orbit: Mapping[str, Any] | None) -> _Start:
    """The start that a scene gives, or finds at the end of the one before."""
    body, start, time = scene.tables["body"], scene.tables["initial"], scene.start_time
    end = None if scene.before is None else end_of(scene.before)
    wheels, taken = [dict(each) for each in scene.top["wheel"]], list[int]()
    if end:
        wheels, taken = _handed_on(wheels, end)
    error = dict.fromkeys(("attitude", "angular_velocity", "rotor_rate", "rotor_angle", "velocity", "position"), 0.0)
    attitude = stacked(_unit_turn(start["attitude"]) if start["attitude"] is not UNSET else (0.0, 0.0, 0.0, 1.0) if end is None else end.attitude)
    axes, normal_rate = (np.eye(3), np.zeros(3)) if orbit is None else orbit_start(orbit, time)
    if start["relative_to"] == "orbit" and (end is None or start["attitude"] is not UNSET):
        attitude = _from_orbit(axes, attitude)
    given, momentum = start["angular_velocity"], start["angular_momentum"]
    kept = scene.top["from"]["keep"] if isinstance(scene.top["from"], Mapping) else "rates"
    if end and body["fixed"] and not end.fixed and given is UNSET and momentum is UNSET:
        raise DomainError("from: a body that was free is held at a point from now on, and what it turns with after such a blow is not in the scene before: "
                          "give initial.angular_velocity")
    if momentum is not UNSET:
        rates = _rates_of(stacked(momentum), whole.inertia, body, wheels, time)
        if end:  # what the momentum leaves to the body hangs on what the wheels have
            for place in taken:
                faster = [each | {"rate": each["rate"] + 1.0} if index == place else each for index, each in enumerate(wheels)]
                change = _rates_of(stacked(momentum), whole.inertia, body, faster, time) - rates
                error["angular_velocity"] += float(np.linalg.norm(change)) * end.error.get("rotor_rate", 0.0)
    elif end and given is UNSET and kept == "momentum":
        rates, error["angular_velocity"] = _caught(end, whole, body, wheels, taken, time)
    elif end and given is UNSET:
        rates, stepped = _stepped(end, whole, wheels, taken, time)
        error |= stepped
    elif not isinstance(given, Mapping):
        rates = stacked(given)
    else:
        back = np.swapaxes(_wide_rotation(attitude), -1, -2)
        rates = _rounded(turned(back, stacked(given["inertial"])) if given["inertial"] is not UNSET
                 else stacked(given["relative_to_orbit"]) + turned(back, normal_rate))
        if end and start["attitude"] is UNSET:  # which axes of the body these rates are about is known as well as the attitude
            about = stacked(given["inertial"]) if given["inertial"] is not UNSET else normal_rate
            error["angular_velocity"] = float(np.linalg.norm(about)) * end.error["attitude"]
    velocity, position = np.zeros(3), np.zeros(3)
    if end:
        error |= {name: max(error[name], end.error.get(name, 0.0)) for name in ("rotor_rate", "rotor_angle") if wheels}
        if kept == "momentum" and given is UNSET and momentum is UNSET:  # wheels that turn by themselves keep their absolute rates
            freely = sum(wheels[place]["type"] != "held" for place in taken)
            error["rotor_rate"] += math.sqrt(freely) * (end.error["angular_velocity"] + error["angular_velocity"])
        # the clock is told to a rounding
        clock = EPS * time * float(np.linalg.norm(rates))
        error["attitude"] = (end.error["attitude"] if start["attitude"] is UNSET else 0.0) + clock
        if not body["fixed"]:
            # what is kept beside rates is a point of the body, and beside the momentum the path of the mass centre
            centre = end.centre_of_mass if kept == "momentum" else whole.centre_of_mass
            velocity, position = end.moved(centre)
            error |= end.off_path(centre)
    for name, value in (("velocity", start["velocity"]), ("position", start["position"])):
        if value is not UNSET:
            error[name] = 0.0
    if start["error"] is not UNSET:
        error = {name: error[name] + more for name, more in start["error"].items()}
    return _Start(attitude, rates, velocity if start["velocity"] is UNSET else stacked(start["velocity"]),
                  position if start["position"] is UNSET else stacked(start["position"]), wheels, error)


def arguments(scene: "Scene") -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body = scene.tables["solve"], scene.tables["body"]
    orbit: Mapping[str, Any] | None = scene.tables["orbit"]
    field = dict(scene.tables["field"])
    if all(scene.tables["orbit"][name] is UNSET for name in ("radius", "altitude", "rate", "period")):
        orbit, field["dipole"] = None, UNSET  # which nothing feels
    whole = _whole(body, scene.top["wheel"])
    start = _start(scene, whole, orbit)
    going_on = {**({"start_time": scene.start_time} if scene.start_time else {}), **({"start_error": start.error} if any(start.error.values()) else {})}
    return {
        "inertia": whole.inertia, "mass": None if body["mass"] is UNSET else whole.mass, "centre_of_mass": whole.centre_of_mass, "fixed": body["fixed"],
        "rotor_momentum": stacked(body["rotor_momentum"]), "wheels": [{key: value for key, value in each.items() if key not in APART} for each in start.wheels],
        "torques": [dict(each) for each in scene.top["torque"]], "orbit": None if orbit is None else dict(orbit), "field": field,
        "attitude": start.attitude, "angular_velocity": start.angular_velocity, "velocity": start.velocity, "position": start.position,
        "times": scene.times, "tolerance": solving["tolerance"], "model": solving["model"],
        "integrator": solving["integrator"], "recognise": solving["recognise"], "euler": solving["euler"], **going_on,
    }
