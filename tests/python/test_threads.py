# SPDX-License-Identifier: BSD-3-Clause
"""Many threads at once in the bindings: every kind of scene, sweeps, charts, own torques, what is cancelled, functions over arrays.

`./dev sanitize threads` runs this file in a module that is compiled with the thread sanitizer.
"""

import ctypes
import itertools
import math
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import elliptic, rotation
from gyrostat.charts import make_chart
from gyrostat.scenes import load

# A scene of each kind: a duration that can be charted in no time [s], and what is varied between which numbers.
SCENES = {
    "tiangong-1": (100.0, "torque.control[0]", 0.05, 0.07), "intelsat-v-flat-spin": (200.0, "rotor.axial_inertia", 0.15, 0.16),
    "lab-gyroscope": (0.2, "initial.angular_velocity[2]", 33.0, 34.0), "t-handle": (5.0, "initial.angular_velocity[0]", 0.001, 0.1),
    "pam-d-burn": (5.0, "torque.force[2]", 6e4, 7e4), "momentum-dump": (100.0, "wheel[0].axial_inertia", 0.15, 0.17)}
TUMBLING: dict[str, Any] = {"name": "own", "kind": "general", "body": {"inertia": [3.0, 4.0, 5.0]},
                            "initial": {"attitude": [0.0, 0.0, 0.0, 1.0], "angular_velocity": [0.3, -0.5, 0.8]}, "solve": {"duration": 5.0, "samples": 5}}
Made = list[bytes]


def numbers(answer: gyrostat.Answer) -> Made:
    return [np.asarray(answer[column]).tobytes() for column in answer.columns]


def solved(name: str) -> Made:
    return [part for tolerance in (1e-2, 1e-6) for part in numbers(gyrostat.solve(load(name), tolerance=tolerance))]


def swept(name: str) -> Made:
    _, key, low, high = SCENES[name]
    rows = gyrostat.sweep(name, {key: np.linspace(low, high, 16)}, tolerance=1e-2, threads=4)
    return [rows[each].to_numpy().tobytes() for each in sorted(map(str, rows.data_vars)) if rows[each].dtype.kind == "f"]


def charted(name: str) -> Made:
    points = make_chart(load(name, duration=SCENES[name][0], samples=5), repeats=1).points
    return [np.array([*point.error.values(), point.rhs]).tobytes() for point in points]


def by_callable(_: str) -> Made:
    return numbers(gyrostat.solve(TUMBLING, torque=lambda t, q, omega, H, rates: -0.1 * omega, tolerance=1e-6))


def damping(t: float, state: Any, torque: Any) -> None:
    for i in range(3):
        torque[i] = -0.1 * state[4 + i]


COMPILED = ctypes.CFUNCTYPE(None, ctypes.c_double, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_double))(damping)


def by_address(_: str) -> Made:
    return numbers(gyrostat.solve(TUMBLING, torque=ctypes.cast(COMPILED, ctypes.c_void_p).value, tolerance=1e-6))


def cancelled(_: str) -> Made:
    """A motion that would take minutes, stopped from another thread."""
    monitor, begun = gyrostat.Monitor(), threading.Event()

    def pulling(t: float, *_: Any) -> list[float]:
        begun.set()
        return [1e-6 * math.sin(t), 0.0, 0.0]

    def stop() -> None:
        begun.wait(20)
        assert 0 <= monitor.progress < 1
        monitor.cancel()

    watcher = threading.Thread(target=stop)
    watcher.start()
    try:
        gyrostat.solve({**TUMBLING, "solve": {"duration": 1e5, "samples": 5}}, torque=pulling, tolerance=1e-9, monitor=monitor)
    except gyrostat.Cancelled:
        return [b"cancelled"]
    finally:
        watcher.join()
    return []


def arrays(_: str) -> Made:
    k2 = np.linspace(0.01, 0.99, 1000)
    return [made.tobytes() for made in (elliptic.complete(k2).K, elliptic.jacobi(3.0, k2).sn, rotation.matrix_from_vector(np.outer(k2, [1, 2, 3])))]


def test_threads_do_not_disturb_each_other() -> None:
    kinds: list[Callable[[str], Made]] = [solved, swept, charted, by_callable, by_address, cancelled, arrays]
    work = list(itertools.product(kinds, SCENES))
    alone = [job(name) for job, name in work]
    assert all(alone)
    order = np.random.default_rng(1).permutation(2 * len(work)) % len(work)
    with ThreadPoolExecutor(8) as pool:
        together = pool.map(lambda i: work[i][0](work[i][1]), order)
        for i, made in zip(order, together, strict=True):
            assert made == alone[i], (work[i][0].__name__, work[i][1])


def test_a_signal_stops_long_work_in_a_program() -> None:
    """As Ctrl-C does in a notebook: what its handler raises comes out of `solve`."""
    class Enough(Exception):
        pass

    def enough(*_: object) -> None:
        raise Enough

    before = signal.signal(signal.SIGALRM, enough)
    try:
        for scene, changes in (("tiangong-1", {"control": [1e-13, 2e-13, 3e-13], "drag": 0.0, "times": [3e8]}), ("lab-gyroscope", {"times": [3e5], "tolerance": 1e-2})):
            signal.setitimer(signal.ITIMER_REAL, 0.4)
            began = time.monotonic()
            with pytest.raises(Enough):
                gyrostat.solve(scene, model="full", **changes)
            assert time.monotonic() - began < 20
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("torque", ["", ", torque=lambda t, *_: (1e-6, 0.0, 0.0)"])
def test_a_program_ends_while_a_daemon_works(torque: str) -> None:
    scene = {**TUMBLING, "solve": {"duration": 1e3, "samples": 5}}
    program = f"""
import gyrostat, threading, time
def work():
    while True:
        gyrostat.solve({scene!r}, tolerance=1e-9{torque})
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=60, check=False)
    assert ended.returncode == 0 and ended.stderr == b""
