# SPDX-License-Identifier: BSD-3-Clause
"""Long work of each family is cancelled from another thread."""

import threading
import time
from typing import Any

import gyrostat
import pytest

# Scenes of seconds and more, were they not cancelled.
LONG: dict[str, tuple[str, dict[str, Any]]] = {
    "deceleration": ("tiangong-1", {"control": [1e-9, 2e-9, 3e-9], "drag": 0.0, "times": [5e7], "tolerance": 0.1}),
    "rotor": ("intelsat-v-flat-spin", {"slope": 1e-12, "times": [5e7], "tolerance": 0.1}),
    "spinning": ("spinning-paper", {"torque.body": [0.0, 0.0, 0.0], "times": [1e7], "tolerance": 0.1}),
    "heavy": ("toy-top", {"times": [1e5], "tolerance": 0.1}),
    "free": ("t-handle", {"times": [1e5], "tolerance": 0.1}),
    "general": ("gravity-gradient-boom", {"times": [1e9], "tolerance": 0.1}),
}


@pytest.mark.parametrize("family", list(LONG))
def test_a_monitor_cancels_long_work(family: str) -> None:
    name, changes = LONG[family]
    monitor = gyrostat.Monitor()
    caught: list[BaseException] = []

    def work() -> None:
        try:
            gyrostat.solve(name, model="full", monitor=monitor, **changes)
        except gyrostat.Cancelled as error:
            caught.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    time.sleep(0.3)
    assert thread.is_alive() and 0 <= monitor.progress < 1
    monitor.cancel()
    thread.join(20)
    assert not thread.is_alive() and monitor.cancelled and len(caught) == 1
