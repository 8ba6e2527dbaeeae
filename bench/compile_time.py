#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What including gyrostat costs a client at compile time, beside what including Eigen alone costs.

    compile_time.py [--compiler g++] [--repeats 5] [--eigen /usr/include/eigen3] [HEADER ...]

Compiles, at -O2, a translation unit that includes one header and nothing else, and prints the median time of the
repeats and its ratio to <Eigen/Geometry>. Without HEADER: the models of each family, the ladder, and everything.
Needs Python 3.9 and nothing else.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
YARDSTICK = "Eigen/Geometry"


def compile_seconds(header, args):
    with tempfile.TemporaryDirectory() as scratch:
        source = pathlib.Path(scratch) / "client.cpp"
        source.write_text(f"#include <{header}>\n", encoding="utf-8")
        command = [args.compiler, "-std=c++20", "-O2", "-DGYROSTAT_COMPILED=1", "-I", str(ROOT / "include"),
                   "-isystem", args.eigen, "-c", str(source), "-o", os.devnull]
        begin = time.perf_counter()
        subprocess.run(command, check=True, env={**os.environ, "CCACHE_DISABLE": "1"})
        return time.perf_counter() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    parser.add_argument("--eigen", default="/usr/include/eigen3")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("headers", nargs="*", metavar="HEADER")
    args = parser.parse_args()

    include = ROOT / "include"
    found = [path.relative_to(include).as_posix() for folder in ("models", "ladder")
             for path in sorted((include / "gyrostat" / folder).rglob("*.hpp"))]
    headers = ["Eigen/Core", *(args.headers or [*found, "gyrostat/gyrostat.hpp"])]
    # one round of all, then the next: a busy moment of the machine does not fall on one header alone
    rounds = [{h: compile_seconds(h, args) for h in [YARDSTICK, *headers]} for _ in range(args.repeats)]
    median = {h: statistics.median(r[h] for r in rounds) for h in rounds[0]}
    width = max(map(len, median))
    for header, seconds in median.items():
        print(f"{header:<{width}}  {seconds:6.2f} s  {seconds / median[YARDSTICK]:5.2f} of {YARDSTICK}")


if __name__ == "__main__":
    main()
