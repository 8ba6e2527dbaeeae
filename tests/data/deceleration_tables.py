#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write deceleration.csv beside this file: the cases of reference/deceleration.json, one row for each time.

Columns: id; moments J (3); rotor momentum l (3); control eps b (3); drag eps lambda; law and drag law (0: total, 1: carrier);
M at the start (3); t; |M|, energy and k2 (nan where the reference has none) averaged to first order; M (3), |M| and energy of the
full motion; stop time averaged and full, in seconds (nan where the reference has none).
"""

import csv
import json
from pathlib import Path

HERE = Path(__file__).parent


def rows():
    cases = json.loads((HERE / "reference" / "deceleration.json").read_text(encoding="utf-8"))["cases"]
    for case in cases:
        given, averaged, direct = case["inputs"], case["averaged"], case["direct"]
        eps = given["eps"]
        stop = case.get("stop_time_tau", {})
        start = [case["id"].split("_")[0], *given["J"], *given["l"], *(eps * b for b in given["b"]), eps * given["lambda"],
                 int(given["control_law"] == "G"), int(given["drag_law"] == "G"), *given["M_vec0"]]
        end = [stop.get("averaged", float("nan")) / eps, stop.get("direct", float("nan")) / eps]
        k2 = averaged.get("k2", [float("nan")] * len(case["t"]))
        for i, t in enumerate(case["t"]):
            yield [*start, t, averaged["M"][i], averaged["h"][i], k2[i], *direct["M_vec"][i], direct["M"][i], direct["h"][i],
                   *end]


def main():
    with (HERE / "deceleration.csv").open("w", encoding="utf-8", newline="") as file:
        file.write("# written by deceleration_tables.py\n")
        csv.writer(file, lineterminator="\n").writerows(rows())


if __name__ == "__main__":
    main()
