#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes rotor_equilibria.csv, the steady rotations of the reference data of the rotor family, for the unit tests.

    rotor_equilibria.py reference/rotor.json

The reference numbers are roots of the secular equation refined in 50 digits. A line "set" has: name, theta 11, 22, 33, 12, 13, 23,
lambda, e1, e2, e3 (unit), S, omega*, l, k, how many steady rotations follow. A line of one has: type (min, saddle, max, circle),
m1, m2, m3, psi_dot, F, D, q, then real and imaginary parts of the three eigenvalues, then what is said of its stability.
"""
import json
import math
import pathlib
import sys


def main():
    data = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    lines = ["# Written by rotor_equilibria.py from the reference data; columns there"]
    for entry in data["equilibria_sets"] + data["cases"]:
        given, derived = entry["inputs"], entry["derived"]
        if not entry["equilibria"]:
            continue
        theta, e = given["theta_star_kgm2"], given["e"]
        norm = math.sqrt(sum(x * x for x in e))
        l = given["l_Nms"] if "l_Nms" in given else derived["l"]
        numbers = [theta[0][0], theta[1][1], theta[2][2], theta[0][1], theta[0][2], theta[1][2]]
        numbers += [given["lambda_kgm2"], *(x / norm for x in e), given["S_Nms_per_rad"]]
        numbers += [given["omega_star_rad_s"], l, derived["k"]]
        lines.append(",".join(["set", entry["id"], *map(repr, numbers), str(len(entry["equilibria"]))]))
        for point in entry["equilibria"]:
            numbers = [*point["m"], point["psi_dot"], point["F"], point["D"], point["q"]]
            numbers += [x for root in point["delta"] for x in root]
            kind = point["type"] if len(point["type"]) < 8 else "circle"
            verdict = point["linear_stability"].split(":")[0].split(",")[0].split(" (")[0]
            lines.append(",".join([kind, *map(repr, numbers), verdict]))
    pathlib.Path(__file__).with_name("rotor_equilibria.csv").write_text("\n".join(lines) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
