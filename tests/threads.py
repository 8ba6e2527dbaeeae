# SPDX-License-Identifier: BSD-3-Clause
"""Many threads at once in the bindings: every kind of scene by every rung, sweeps, functions over arrays.

Run it with a module compiled with -fsanitize=thread and libtsan preloaded, and a data race ends it with an error:

    pip install . --config-settings=cmake.define.GYROSTAT_LEVELS=v1 --config-settings=cmake.define.CMAKE_CXX_FLAGS='-fsanitize=thread -g1'
    LD_PRELOAD=$(g++ -print-file-name=libtsan.so) TSAN_OPTIONS=exitcode=66 python tests/threads.py
"""
import sys
import threading

import numpy as np

import gyrostat
from gyrostat import elliptic, rotation
from gyrostat._core import Monitor, build_info

SCENES = ["tiangong-1", "intelsat-v-flat-spin", "lab-gyroscope", "t-handle", "cubesat-pyramid", "pam-d-burn"]
failures: list[BaseException] = []


def work(seed: int, monitor: Monitor) -> None:
    shift = seed % len(SCENES)
    for name in SCENES[shift:] + SCENES[:shift]:
        scene = gyrostat.load(name)
        for tolerance in (1e-2, 1e-6):
            gyrostat.solve(scene, tolerance=tolerance)
        _ = monitor.progress
    k2 = np.random.default_rng(seed).uniform(0, 1, 1000)
    elliptic.complete(k2), elliptic.jacobi(3.0, k2)
    rotation.matrix_from_vector(np.random.default_rng(seed).normal(size=(1000, 3)))
    build_info()
    gyrostat.sweep("tiangong-1", {"torque.control[0]": np.linspace(0.05, 0.07, 64)}, ask=["stop_time"], tolerance=1e-2, threads=3)


def guarded(seed: int, monitor: Monitor) -> None:
    try:
        work(seed, monitor)
    except BaseException as error:
        failures.append(error)


def main() -> int:
    monitor = Monitor()
    threads = [threading.Thread(target=guarded, args=(seed, monitor)) for seed in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for error in failures:
        print(repr(error), file=sys.stderr)
    print(f"{len(threads)} threads, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
