#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write rotor_motion.csv beside this file: the cases of reference/rotor.json, one row for each time.

Columns: id; theta (11, 12, 13, 22, 23, 33); lambda; e (3); S; omega*; attitude at the start (w, x, y, z); Omega (3) and omega at the
start; t; attitude (4), Omega (3), omega, beta, H (3), V at t; the attitude error that a tight double-precision run stays below.
"""

import csv
import json
from pathlib import Path

HERE = Path(__file__).parent


def rows():
    for case in json.loads((HERE / "reference" / "rotor.json").read_text(encoding="utf-8"))["cases"]:
        given = case["inputs"]
        theta = given["theta_star_kgm2"]
        start = [case["id"].split("_")[0], *theta[0], *theta[1][1:], theta[2][2], given["lambda_kgm2"], *given["e"],
                 given["S_Nms_per_rad"], given["omega_star_rad_s"], *given["q0"], *given["Omega0_rad_s"], given["omega0_rad_s"]]
        for at in case["outputs"]:
            yield [*start, at["t"], *at["q"], *at["Omega"], at["omega"], at["beta"], *at["H"], at["V"],
                   case["tolerance"]["attitude_rad"]]


def main():
    with (HERE / "rotor_motion.csv").open("w", encoding="utf-8", newline="") as file:
        file.write("# written by rotor_tables.py\n")
        csv.writer(file, lineterminator="\n").writerows(rows())


if __name__ == "__main__":
    main()
