# SPDX-License-Identifier: BSD-3-Clause
"""Times heyoka and our Taylor series on three general scenes in one run, and compares them at equal true error.

    python bench/rivals_heyoka_general.py [--repeat 7]

heyoka's integrator is compiled once for a scene; only propagate_until is timed. Both in thread CPU time, least of the repeats. The true error is
the angle of the attitude at the end to Taylor series of order 30 in long double. For each run of heyoka the cost of ours at the same error is read
off between our runs, on logarithmic scales; of each scene the least and the median of the ratios heyoka/ours are printed, of the runs of heyoka
that are off by less than a radian: the boom tumbles so that at loose tolerances nothing is left of its attitude.
"""

from __future__ import annotations

import argparse
import math
import statistics
import time
from typing import Any

import heyoka as hy
import numpy as np
from gyrostat.families.general.functions import integrate
from gyrostat.rotation import angle_between

ORBIT = {"mu": 3.986004415e14, "radius": 6.778e6, "eccentricity": 0.02}
# Gradient on an eccentric orbit, with damping; three wheels with friction and a wave of torque; weight and an oblique wheel.
SCENES: dict[str, dict[str, Any]] = {
    "boom in orbit": {"inertia": [4.0, 3.9, 0.3], "angular_velocity": [1e-4, -1.2e-3, 4e-4], "attitude": [0.1, 0.2, -0.3, math.sqrt(0.86)],
                      "torques": [{"type": "gravity-gradient"}, {"type": "damping", "coefficient": 1e-6}], "orbit": ORBIT, "end": 60000.0},
    "three wheels": {"inertia": [3.0, 2.5, 2.0], "angular_velocity": [0.3, -0.5, 0.8], "end": 300.0,
                     "wheels": [{"type": "friction", "axis": axis, "axial_inertia": 0.02, "rate": rate, "friction": 1e-4}
                                for axis, rate in (([1, 0, 0], 300.0), ([0, 1, 0], -200.0), ([0, 0, 1], 100.0))],
                     "torques": [{"type": "constant", "torque": [0.01, 0.0, -0.02], "factor": {"mean": 0.0, "amplitude": 1.0, "rate": 0.7, "phase": 0.3}}]},
    "weight and wheel": {"inertia": [0.03, 0.025, 0.013], "mass": 1.0, "centre_of_mass": [0.0, 0.01, 0.05], "fixed": True, "angular_velocity": [1.0, 2.0, 9.0],
                         "wheels": [{"type": "held", "axis": [0.6, 0.0, 0.8], "axial_inertia": 1e-3, "rate": 200.0}], "torques": [{"type": "weight"}],
                         "field": {"gravity": 9.80665}, "end": 60.0},
}


def cross(a: Any, b: Any) -> list[Any]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def seen(q: Any, v: Any) -> list[Any]:
    """R^T v of the quaternion (w, x, y, z)."""
    w, x, y, z = q
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]]
    return [sum(row[j] * v[j] for j in range(3)) for row in rows]


def system(scene: dict[str, Any]) -> tuple[list[Any], list[float]]:
    """The equations for heyoka and the start: attitude, M, momenta of wheels with friction, the orbit in its plane."""
    q, M = hy.make_vars("w", "x", "y", "z"), hy.make_vars("M1", "M2", "M3")
    J, wheels = np.diag(scene["inertia"]), scene.get("wheels", [])
    turning = [wheel for wheel in wheels if wheel["type"] == "friction"]
    reduced = J - sum((wheel["axial_inertia"] * np.outer(wheel["axis"], wheel["axis"]) for wheel in turning), np.zeros((3, 3)))
    p = [hy.make_vars(f"p{i}") for i in range(len(turning))]
    held = sum((wheel["axial_inertia"] * wheel["rate"] * np.array(wheel["axis"]) for wheel in wheels if wheel["type"] == "held"), np.zeros(3))
    G = [M[i] - held[i] - sum(p[k] * wheel["axis"][i] for k, wheel in enumerate(turning)) for i in range(3)]
    inverse = np.linalg.inv(reduced)
    w = [sum(float(inverse[i, j]) * G[j] for j in range(3) if abs(inverse[i, j]) > 1e-14) for i in range(3)]
    torque = cross(M, w)
    more: list[Any] = []
    start = np.array(scene["angular_velocity"])
    momenta = [wheel["axial_inertia"] * (wheel["rate"] + float(np.dot(wheel["axis"], start))) for wheel in turning]
    begin = list(np.roll(scene.get("attitude", [0.0, 0.0, 0.0, 1.0]), 1) / np.linalg.norm(scene.get("attitude", [0, 0, 0, 1])))
    begin += list(reduced @ start + held + sum((m * np.array(wheel["axis"]) for m, wheel in zip(momenta, turning)), np.zeros(3))) + momenta
    for one in scene["torques"]:
        if one["type"] == "damping":
            torque = [torque[i] - one["coefficient"] * w[i] for i in range(3)]
        elif one["type"] == "constant":
            wave = one["factor"]["amplitude"] * hy.sin(one["factor"]["rate"] * hy.time + one["factor"]["phase"])
            torque = [torque[i] + one["torque"][i] * wave if one["torque"][i] else torque[i] for i in range(3)]
        elif one["type"] == "weight":
            down = seen(q, [0.0, 0.0, -1.0])
            arm = cross(scene["centre_of_mass"], down)
            torque = [torque[i] + scene["mass"] * scene["field"]["gravity"] * arm[i] for i in range(3)]
        else:
            a, b, va, vb = hy.make_vars("a", "b", "va", "vb")
            square = a * a + b * b
            fall = ORBIT["mu"] * square**-1.5
            r = seen(q, [a, b, 0.0])
            gradient = cross(r, [float(J[i, i]) * r[i] for i in range(3)])
            torque = [torque[i] + 3 * fall / square * gradient[i] for i in range(3)]
            more = [(a, va), (b, vb), (va, -fall * a), (vb, -fall * b)]
            speed = math.sqrt(ORBIT["mu"] * (1 + ORBIT["eccentricity"]) / ORBIT["radius"])
            begin += [ORBIT["radius"], 0.0, 0.0, speed]
    x = q
    rates = [(x[0], -0.5 * (x[1] * w[0] + x[2] * w[1] + x[3] * w[2])), (x[1], 0.5 * (x[0] * w[0] + x[2] * w[2] - x[3] * w[1])),
             (x[2], 0.5 * (x[0] * w[1] + x[3] * w[0] - x[1] * w[2])), (x[3], 0.5 * (x[0] * w[2] + x[1] * w[1] - x[2] * w[0]))]
    rates += list(zip(M, torque))
    rates += [(p[k], -wheel["friction"] * (p[k] / wheel["axial_inertia"] - sum(wheel["axis"][i] * w[i] for i in range(3) if wheel["axis"][i])))
              for k, wheel in enumerate(turning)]
    return rates + more, begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=7)
    repeat = parser.parse_args().repeat
    print(f"heyoka {hy.__version__}")
    for name, scene in SCENES.items():
        physics = {key: value for key, value in scene.items() if key != "end"}
        end = scene["end"]

        def ours(order: int, tolerance: float, precision: str = "double", physics: Any = physics, end: float = end) -> dict[str, Any]:
            return integrate(times=[end], method="taylor", order=order, tolerance=tolerance, precision=precision, **physics)

        truth = ours(30, 1e-19, "long double")["attitude"][-1]
        points = []
        for exponent in range(5, 17):
            made = [ours(20, 10.0**-exponent) for _ in range(repeat)]
            points.append((float(angle_between(made[0]["attitude"][-1], truth)), min(float(each["seconds"]) for each in made), made[0]["steps"]))
        print(name)
        for error, seconds, steps in points:
            print(f"  ours    {steps:6d} steps {seconds * 1e6:9.1f} us  error {error:.2e}")
        falling = sorted((math.log(error), math.log(seconds)) for error, seconds, _ in points if error > 0)
        ratios = []
        for exponent in range(6, 16):
            equations, start = system(scene)
            integrator = hy.taylor_adaptive(equations, start, tol=10.0**-exponent)
            seconds = []
            for _ in range(repeat):
                integrator.time = 0.0
                integrator.state[:] = start
                began = time.thread_time()
                steps = integrator.propagate_until(end)[3]
                seconds.append(time.thread_time() - began)
            w, x, y, z = integrator.state[:4]
            error = float(angle_between(np.array([x, y, z, w]), truth))
            told = f"  heyoka  {steps:6d} steps {min(seconds) * 1e6:9.1f} us  error {error:.2e}  order {integrator.order}"
            if error < 1:
                same = math.exp(np.interp(math.log(error), [e for e, _ in falling], [s for _, s in falling]))
                ratios.append(min(seconds) / same)
                told += f"  over ours {ratios[-1]:.2f}"
            print(told)
        print(f"  heyoka over ours: least {min(ratios):.2f}, median {statistics.median(ratios):.2f}, most {max(ratios):.2f}")


if __name__ == "__main__":
    main()
