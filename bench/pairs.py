#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every bundled scene solved by two installations of the package, in pairs: CPU time of the thread, and the ratio of the second to the first.

    pairs.py FIRST SECOND [SCENE ...]     folders in which the package is, such as build/wheel/venv/lib/python3.11/site-packages
"""
import os
import statistics
import subprocess
import sys

WORKER = """
import sys, time
import gyrostat
print(gyrostat.__file__, gyrostat.build_info()["level"], *[name for name, _ in gyrostat.scenes.bundled()], flush=True)
scenes = {}
for line in sys.stdin:
    name, count = line.split()
    scene = scenes.setdefault(name, gyrostat.load(name))
    begun = time.thread_time()
    for _ in range(int(count)):
        gyrostat.solve(scene)
    print((time.thread_time() - begun) / int(count), flush=True)
"""
PAIRS = 9
SECONDS = 0.03  # of each measurement, where one solution takes less
# Whether freed memory goes back to the system, to be cleared and mapped again for the next solution, hangs on what else lies in the heap of a
# process; of one scene of 3601 times it is half of the cost. In both processes it stays.
KEEP_MEMORY = {"MALLOC_TRIM_THRESHOLD_": "1000000000", "MALLOC_MMAP_THRESHOLD_": "1000000000"}


class Worker:
    """A process with one of the packages."""

    def __init__(self, folder: str) -> None:
        self.process = subprocess.Popen([sys.executable, "-c", WORKER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd="/",
                                        env={**os.environ, **KEEP_MEMORY, "PYTHONPATH": os.path.abspath(folder)})
        self.file, self.level, *self.scenes = self.line().split()

    def line(self) -> str:
        assert self.process.stdout
        return self.process.stdout.readline()

    def seconds(self, name: str, count: int) -> float:
        assert self.process.stdin
        print(name, count, file=self.process.stdin, flush=True)
        return float(self.line())


def main() -> int:
    if len(sys.argv) < 3:
        print(__doc__)
        return 2
    first, second = Worker(sys.argv[1]), Worker(sys.argv[2])
    print(f"{first.file}, {first.level}\n{second.file}, {second.level}")
    ratios = []
    for name in sys.argv[3:] or first.scenes:
        for worker in (first, second):
            worker.seconds(name, 1)
        count = max(1, int(SECONDS / first.seconds(name, 1)))
        pairs = [(first.seconds(name, count), second.seconds(name, count)) for _ in range(PAIRS)]
        ratios.append(statistics.median(b / a for a, b in pairs))
        print(f"{name:28s} {1e3 * min(a for a, _ in pairs):9.3f} ms {1e3 * min(b for _, b in pairs):9.3f} ms   ratio {ratios[-1]:.3f}", flush=True)
    print(f"median {statistics.median(ratios):.3f}, greatest {max(ratios):.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
