#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write free_motion.csv beside this file: the cases of reference/free.json, one row for each time.

A line that begins with `case` holds: id; inertia (11, 12, 13, 22, 23, 33); rotor momentum of what is not listed (3); angular velocity
(3) and attitude (x, y, z, w) at the start; period (nan where there is none); turn per period; effect of one rounding of the data on the
rates (relative) and the attitude (rad); number of rotors. Lines `rotor`: axis (3), axial inertia, rate, 1 where it turns freely. Lines
`at`: t; angular velocity (3); attitude (4); angular momentum (3); rotor rates; rotor angles.
"""

import csv
import json
from pathlib import Path

HERE = Path(__file__).parent


def tensor(given):
    if isinstance(given[0], list):
        return [*given[0], *given[1][1:], given[2][2]]
    return [given[0], 0, 0, given[1], 0, given[2]]


def rows():
    for case in json.loads((HERE / "reference" / "free.json").read_text(encoding="utf-8"))["cases"]:
        given, truth = case["inputs"], case["truth"]
        rotors = given.get("rotors", [])
        yield ["case", case["id"], *tensor(given["inertia"]), *given.get("rotor_momentum", [0, 0, 0]), *given["angular_velocity"],
               *given["attitude"], case.get("period", "nan"), case.get("turn_per_period", "nan"),
               case["one_ulp"]["angular_velocity"], case["one_ulp"]["attitude"], len(rotors)]
        for rotor in rotors:
            yield ["rotor", *rotor["axis"], rotor["axial_inertia"], rotor["rate"], int(rotor["mode"] == "free")]
        for i, t in enumerate(case["t"]):
            yield ["at", t, *truth["angular_velocity"][i], *truth["attitude"][i], *truth["angular_momentum"][i],
                   *(truth["rotor_rate"][i] if rotors else []), *(truth["rotor_angle"][i] if rotors else [])]


def main():
    with (HERE / "free_motion.csv").open("w", encoding="utf-8", newline="") as file:
        file.write("# written by free_tables.py\n")
        csv.writer(file, lineterminator="\n").writerows(rows())


if __name__ == "__main__":
    main()
