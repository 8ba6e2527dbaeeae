#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write spinning_full.csv and spinning_axial.csv beside this file: the full motions of reference/spinning.json, and the linear ones
under a torque about the spin axis, one row for each time.

Columns: name; moments D (3); mass; torque (3); force (3); lambda3; e_H; p, q, r, psi, phi, theta, velocity (3) and position (3) at the
start; t; p, q, r; psi, phi, theta not reduced by turns; R by rows (9), full motion alone; momentum (3; linear motion: 2), velocity (3)
and position (3), inertial.
"""

import csv
import json
from pathlib import Path

HERE = Path(__file__).parent
GIVEN = [*"D1 D2 D3 m M1 M2 M3 f1 f2 f3 lambda3".split(), None,
         *"p0 q0 r0 psi0 phi0 theta0 v10 v20 v30 x10 x20 x30".split()]


def short(number):
    """22 significant digits of a decimal string."""
    digits, _, power = number.partition("e")
    head = digits.lstrip("-0.")
    digits = digits[:len(digits) - max(0, len(head.replace(".", "")) - 22)] if "." in digits else digits
    return f"{digits}e{power}" if power else digits


def full(at):
    yield from (at[name] for name in "t p q r psi phi theta_integrated".split())
    yield from (entry for row in at["R"] for entry in row)
    yield from (at[name] for name in "G1 G2 G3 v1 v2 v3 x1 x2 x3".split())


def axial(at):
    yield from (at[name] for name in "t p q r psi phi theta G1 G2 v1 v2 v3 x1 x2 x3".split())


def write(name, kind, found, wanted):
    with (HERE / name).open("w", encoding="utf-8", newline="") as file:
        file.write("# written by spinning_tables.py\n")
        to = csv.writer(file, lineterminator="\n")
        for case in json.loads((HERE / "reference" / "spinning.json").read_text(encoding="utf-8"))["cases"]:
            if not wanted(case["inputs"]):
                continue
            given = [case["derived"]["e_H"] if key is None else case["inputs"][key] for key in GIVEN]
            for at in case[kind]:
                to.writerow([case["name"], *(short(number) for number in [*given, *found(at)])])


def main():
    write("spinning_full.csv", "nonlinear_truth", full, lambda given: True)
    write("spinning_axial.csv", "linear_model", axial, lambda given: float(given["M3"]) != 0)


if __name__ == "__main__":
    main()
