#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write general.csv beside this file: the cases of reference/general.json as plain numbers, one row for each thing.

`case`: id; inertia (9, by rows); mass; centre of mass (3); 1 if fixed; rotor momentum (3); attitude (x, y, z, w), angular velocity (3), velocity
(3) and position (3) at the start. `orbit`: radius, mu, eccentricity, true anomaly, radial (3), along (3). `field`: gravity, down (3),
place of the magnetic field in MagneticField, flux density (3), axis (3), rate, strength, radius. `wheel`: place in WheelType, axis (3), axial
inertia, rate, torque, friction, slope, no-load rate. `torque`: places in TorqueType, Axes, Opposed; vector (3), point (3), matrix (9, by
rows), gradient or nan, mean, amplitude, rate and phase of its factor. Of the torque before: `on`, from, to; `table` and `factor`: place in Between,
1 if it holds, number of times, times, values. `ulp`: effect of one rounding of the data on attitude, angular velocity, angular momentum, rotor
rates and angles, velocity, position (0 where the case does not give them). `at`: t; attitude (4); angular velocity (3); angular momentum (3); rotor rates;
rotor angles; velocity (3) and position (3) where they are given.
"""

import csv
import json
import math
from pathlib import Path

HERE = Path(__file__).parent
UNITS = {"deg": math.pi / 180, "deg/s": math.pi / 180, "rpm": math.pi / 30, "rad/s": 1, "kg cm^2": 1e-4, "N m s/rad": 1}
WHEELS = ["locked", "held", "free", "torque", "motor", "friction"]
TORQUES = ["constant", "table", "damping", "brake", "weight", "gravity-gradient", "magnetic", "eddy-current", "thrust", "charge"]
AXES = ["body", "inertial", "orbit"]
OPPOSED = ["angular-velocity", "momentum", "carrier-momentum"]
BETWEEN = ["step", "linear", "cubic"]
COLUMNS = ["attitude", "angular_velocity", "angular_momentum", "rotor_rate", "rotor_angle", "velocity", "position"]


def si(value):
    if isinstance(value, list):
        return [si(v) for v in value]
    if isinstance(value, str):
        number, unit = value.split(" ", 1)
        return float(number) * UNITS[unit]
    return value


def cross(a, b):
    return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    size = math.sqrt(dot(v, v))
    return [x / size for x in v]


def product(p, q):
    (a, b, c, d), (x, y, z, w) = p, q
    return [d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x, d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z]


def turned_back(q, v):
    back = [-q[0], -q[1], -q[2], q[3]]
    return product(product(back, [*v, 0]), q)[:3]


def matrix(given):
    if isinstance(given, (int, float)):
        given = [given] * 3
    if isinstance(given[0], list):
        return [x for line in given for x in line]
    return [given[i] if i == j else 0 for i in range(3) for j in range(3)]


def from_columns(x, y, z):
    """The quaternion of the rotation with these columns."""
    values = [x[0] - y[1] - z[2], y[1] - x[0] - z[2], z[2] - x[0] - y[1], x[0] + y[1] + z[2]]
    most = max(range(4), key=lambda i: values[i])
    a, b, c = y[2] - z[1], z[0] - x[2], x[1] - y[0]
    d, e, f = x[1] + y[0], x[2] + z[0], y[2] + z[1]
    s = 1 + values[most]
    return unit([[s, d, e, a], [d, s, f, b], [e, f, s, c], [a, b, c, s]][most])


def orbit_of(scene):
    given = scene["orbit"]
    radial = unit(given.get("radial", [1, 0, 0]))
    along = given.get("along", [0, 1, 0])
    along = unit([a - r * dot(radial, along) for a, r in zip(along, radial)])
    return {"radius": si(given["radius"]), "mu": si(given["mu"]), "eccentricity": given.get("eccentricity", 0),
            "true_anomaly": si(given.get("true_anomaly", 0)), "radial": radial, "along": along}


def attitude_of(scene):
    given = scene["initial"]
    q = [0, 0, 0, 1]
    if "attitude" in given:
        q = unit(given["attitude"])
    elif "quaternion_scalar_first" in given:
        w, *v = given["quaternion_scalar_first"]
        q = unit([*v, w])
    elif "euler" in given:
        for axis, angle in zip(given["euler"]["sequence"].split("-"), si(given["euler"]["angles"])):
            one = [0, 0, 0, math.cos(angle / 2)]
            one[int(axis) - 1] = math.sin(angle / 2)
            q = product(q, one)
    elif "mrp" in given:
        n = dot(given["mrp"], given["mrp"])
        q = unit([*(2 * x for x in given["mrp"]), 1 - n])
    elif "rotation_vector" in given:
        angle = math.sqrt(dot(given["rotation_vector"], given["rotation_vector"]))
        q = [*(x / angle * math.sin(angle / 2) for x in given["rotation_vector"]), math.cos(angle / 2)]
    if given.get("relative_to") == "orbit":
        orbit = orbit_of(scene)
        normal = cross(orbit["radial"], orbit["along"])
        q = product(from_columns(orbit["along"], [-x for x in normal], [-x for x in orbit["radial"]]), q)
    return q


def rate_of(scene, q):
    given = scene["initial"]["angular_velocity"]
    if not isinstance(given, dict):
        return si(given)
    orbit = orbit_of(scene)
    shape = 1 + orbit["eccentricity"] * math.cos(orbit["true_anomaly"])
    rate = math.sqrt(orbit["mu"] * shape / orbit["radius"]) / orbit["radius"]
    normal = turned_back(q, cross(orbit["radial"], orbit["along"]))
    return [a + rate * b for a, b in zip(given["relative_to_orbit"], normal)]


def field_of(scene):
    field = scene.get("field", {})
    down = unit(field.get("down", [0, 0, -1]))
    kind, flux, axis, rate, strength, radius = 0, [0, 0, 0], [0, 0, 1], 0, 0, 1
    if "uniform" in field:
        kind, flux = 1, field["uniform"]
    if "dipole" in field:
        kind, axis = 3, unit(field["dipole"]["axis"])
        strength, radius = field["dipole"]["strength"], field["dipole"]["radius"]
    return [field.get("gravity", 0), *down, kind, *flux, *axis, rate, strength, radius]


def table_row(name, table, holds):
    values = table["values"]
    flat = [x for v in values for x in v] if isinstance(values[0], list) else values
    return [name, BETWEEN.index(table.get("interpolation", "linear")), int(holds), len(table["times"]), *table["times"], *flat]


def torque_rows(given):
    factor = given.get("factor", {})
    wave = [factor["mean"], factor["amplitude"], factor["rate"], factor.get("phase", 0)] if "rate" in factor else [1, 0, 0, 0]
    vector = given.get("torque", given.get("force", given.get("dipole", given.get("limit", given.get("momentum", [0, 0, 0])))))
    tensor = [0] * 9
    if given["type"] in ("damping", "eddy-current"):
        tensor = matrix(si(given.get("matrix", given.get("coefficient"))))
    against = given.get("against", {"total": "momentum", "carrier": "carrier-momentum"}.get(given.get("law"), "angular-velocity"))
    yield ["torque", TORQUES.index(given["type"]), AXES.index(given.get("frame", "body")), OPPOSED.index(against), *vector,
           *given.get("point", [0, 0, 0]), *tensor, given.get("gradient", "nan"), *wave]
    for on in given.get("on", []):
        yield ["on", *on]
    if "times" in given:
        yield table_row("table", given, given.get("extend") == "hold")
    if "times" in factor:
        yield table_row("factor", factor, factor.get("extend") == "hold")


def wheel_row(given):
    return ["wheel", WHEELS.index(given["type"]), *unit(given["axis"]), si(given["axial_inertia"]), si(given.get("rate", 0)),
            given.get("torque", 0), given.get("friction", 0), given.get("slope", 0), given.get("no_load_rate", 0)]


def rows():
    for case in json.loads((HERE / "reference" / "general.json").read_text(encoding="utf-8"))["cases"]:
        scene, truth = case["scene"], case["truth"]
        body, initial = scene["body"], scene["initial"]
        q = attitude_of(scene)
        yield ["case", case["id"], *matrix(si(body["inertia"])), body.get("mass", 1), *body.get("centre_of_mass", [0, 0, 0]),
               int(body.get("fixed", False)), *body.get("rotor_momentum", [0, 0, 0]), *q, *rate_of(scene, q),
               *initial.get("velocity", [0, 0, 0]), *initial.get("position", [0, 0, 0])]
        if "orbit" in scene:
            orbit = orbit_of(scene)
            yield ["orbit", *(orbit[k] for k in ("radius", "mu", "eccentricity", "true_anomaly")), *orbit["radial"], *orbit["along"]]
        yield ["field", *field_of(scene)]
        yield from (wheel_row(wheel) for wheel in scene.get("wheel", []))
        for torque in scene.get("torque", []):
            yield from torque_rows(torque)
        yield ["ulp", *(case["one_ulp"].get(name, 0) for name in COLUMNS)]
        for i, t in enumerate(case["t"]):
            yield ["at", t, *(x for name in COLUMNS if name in truth for x in truth[name][i])]


def main():
    with (HERE / "general.csv").open("w", encoding="utf-8", newline="") as file:
        file.write("# written by general_table.py\n")
        csv.writer(file, lineterminator="\n").writerows(rows())


if __name__ == "__main__":
    main()
