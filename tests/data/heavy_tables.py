#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write heavy_*.csv beside this file from the cases of reference/heavy.json.

heavy_motion.csv    one row for each time of a motion: id; A, B, C, M, g, x0, y0, z0, N; p, q, r, down (3) at the start; t; p, q, r, down (3)
heavy_periodic.csv  one row for each fast periodic motion: id; body (9); r0, G0; p0, q0 at the start; period; trace of the monodromy - 4;
                    Omega_2, Omega_4, ... over powers of c/r0; order-2 closed form at one time: t, p, q over c, r over r0, down (3)
heavy_floquet.csv   a = 0.55, k = 0, (x', y', z') = (0.6, 0.48, 0.64), G0 = 0.1: eps, b, trace of the monodromy - 4, period x r0, p0/c, q0/c
"""

import csv
import json
from pathlib import Path

HERE = Path(__file__).parent
BODY = ("A", "B", "C", "M", "g", "x0", "y0", "z0", "N")
CASES = json.loads((HERE / "reference" / "heavy.json").read_text(encoding="utf-8"))["cases"]


def numbers(texts):
    return [float(text) for text in texts]


def head(case):
    return [case["id"], *(case["body"][name] for name in BODY)]


def motions():
    for case in CASES:
        if truth := case.get("truth"):
            for t, y in zip(truth["t"], truth["y"]):
                yield [*head(case), *numbers(truth["y0"]), float(t), *numbers(y)]


def periodic():
    for case in CASES:
        if case["kind"] == "periodic_fast":
            at, series = case["initial"], case["series"]
            orbit = case["periodic"]
            yield [*head(case), at["r0"], at["gamma3_0"], *numbers(orbit["y0"][:2]), float(orbit["T"]),
                   orbit["floquet"]["trace_minus_4"], *series["Omega_coeffs_even"][1:], float(case["truth"]["t"][1]),
                   *numbers(series["closed2"][1])]


def floquet():
    for case in CASES:
        if case["kind"] == "floquet_table_nondim":
            for row in case["rows"]:
                yield [row[name] for name in ("eps", "b", "trace_minus_4", "T_r0", "p0_over_c", "q0_over_c")]


def main():
    for name, rows in (("motion", motions()), ("periodic", periodic()), ("floquet", floquet())):
        with (HERE / f"heavy_{name}.csv").open("w", encoding="utf-8", newline="") as file:
            file.write("# written by heavy_tables.py\n")
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
