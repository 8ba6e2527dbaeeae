# SPDX-License-Identifier: BSD-3-Clause
"""Many threads at once in the bindings: every kind of scene, sweeps, functions over arrays.

To look for data races, compile the module with the thread sanitizer and run these tests with its library:

    pip install . --config-settings=cmake.define.GYROSTAT_LEVELS= --config-settings=cmake.define.CMAKE_CXX_FLAGS='-fsanitize=thread -g1'
    LD_PRELOAD=$(g++ -print-file-name=libtsan.so) TSAN_OPTIONS=exitcode=66 python -m pytest -p no:xdist tests/python/test_threads.py
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

import gyrostat
from gyrostat import elliptic, rotation

SCENES = ["tiangong-1", "intelsat-v-flat-spin", "lab-gyroscope", "t-handle", "cubesat-pyramid", "pam-d-burn"]


def work(seed: int) -> list[bytes]:
    """All answers, as bytes; the threads begin at different scenes."""
    found = {}
    for name in SCENES[seed % 6:] + SCENES[:seed % 6]:
        for tolerance in (1e-2, 1e-6):
            answer = gyrostat.solve(gyrostat.load(name), tolerance=tolerance)
            found[name, tolerance] = b"".join(np.asarray(answer[column]).tobytes() for column in answer.columns)
    rows = gyrostat.sweep("tiangong-1", {"torque.control[0]": np.linspace(0.05, 0.07, 64)}, ask=["stop_time"], tolerance=1e-2, threads=3)
    k2 = np.linspace(0.01, 0.99, 1000)
    arrays = [rows["stop_time"].to_numpy(), elliptic.complete(k2).K, elliptic.jacobi(3.0, k2).sn, rotation.matrix_from_vector(np.outer(k2, [1, 2, 3]))]
    return [found[key] for key in sorted(found)] + [array.tobytes() for array in arrays]


def test_threads_do_not_disturb_each_other() -> None:
    alone = work(0)
    with ThreadPoolExecutor(8) as pool:
        assert all(made == alone for made in pool.map(work, range(8)))
