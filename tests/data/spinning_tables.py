#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write spinning_full.csv beside this file: the full motions of reference/spinning.json, one row for each time.

Columns: name; moments D (3); mass; torque (3); force (3); lambda3; e_H; p, q, r, psi, phi, theta, velocity (3) and position (3) at the
start; t; p, q, r; psi, phi, theta not reduced by turns; R by rows (9); momentum (3), velocity (3) and position (3), inertial.
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


def rows():
    for case in json.loads((HERE / "reference" / "spinning.json").read_text(encoding="utf-8"))["cases"]:
        given = [case["derived"]["e_H"] if name is None else case["inputs"][name] for name in GIVEN]
        for at in case["nonlinear_truth"]:
            found = [at["t"], at["p"], at["q"], at["r"], at["psi"], at["phi"], at["theta_integrated"],
                     *(entry for row in at["R"] for entry in row),
                     *(at[name] for name in "G1 G2 G3 v1 v2 v3 x1 x2 x3".split())]
            yield [case["name"], *(short(number) for number in [*given, *found])]


def main():
    with (HERE / "spinning_full.csv").open("w", encoding="utf-8", newline="") as file:
        file.write("# written by spinning_tables.py\n")
        csv.writer(file, lineterminator="\n").writerows(rows())


if __name__ == "__main__":
    main()
