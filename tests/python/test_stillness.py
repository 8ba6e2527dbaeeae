# SPDX-License-Identifier: BSD-3-Clause
"""Scenes in which torques, rates and slopes are zero, in every combination: each rung of each family answers or refuses, and none goes on for ever."""

import itertools
import threading
import time
from collections.abc import Iterator
from typing import Any

import gyrostat
import pytest
from gyrostat.facts import FACTS

NOTHING = [0.0, 0.0, 0.0]
# By family: a scene, and the groups of its keys that are zero or not.
SCENES: dict[str, tuple[str, list[dict[str, Any]]]] = {
    "deceleration": ("tiangong-1", [{"control": NOTHING}, {"drag": 0.0}, {"angular_velocity": NOTHING}, {"rotor_momentum": NOTHING}]),
    "rotor": ("intelsat-v-flat-spin", [{"slope": 0.0}, {"no_load_rate": 0.0}, {"rotor_rate": 0.0}, {"angular_velocity": NOTHING}]),
    "spinning": ("spinning-paper", [{"torque.body": NOTHING}, {"force": NOTHING}, {"angular_velocity": NOTHING}, {"rotor_momentum": 0.0}]),
    "heavy": ("toy-top", [{"gravity": 0.0}, {"angular_velocity": NOTHING}, {"centre_of_mass": NOTHING}]),
    "free": ("t-handle", [{"angular_velocity": NOTHING}, {"rotor_momentum": [0.01, 0.0, 0.0]}]),
    "general": ("iss-torque-pulse", [{"torque": []}, {"angular_velocity": NOTHING}, {"rotor_momentum": [1.0, 0.0, 0.0]}]),
}
PATIENCE = 20.0  # of one answer [CPU s]; all of them take some seconds together


def combinations(groups: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    for size in range(len(groups) + 1):
        for chosen in itertools.combinations(groups, size):
            yield {key: value for group in chosen for key, value in group.items()}


def cancel_late(monitor: gyrostat.Monitor, done: threading.Event) -> None:
    begin = time.process_time()
    while not done.wait(0.5):
        if time.process_time() - begin > PATIENCE:
            monitor.cancel()


@pytest.mark.parametrize("family", list(SCENES))
def test_every_rung_comes_back(family: str) -> None:
    name, groups = SCENES[family]
    for zeros in combinations(groups):
        for model in ("auto", *FACTS[family].rungs):
            monitor = gyrostat.Monitor()
            done = threading.Event()
            threading.Thread(target=cancel_late, args=(monitor, done)).start()
            try:
                answer = gyrostat.solve(name, monitor=monitor, model=model, times=[0.0, 5.0, 100.0], **zeros)
                assert len(answer.t) == 3
            except (gyrostat.DomainError, gyrostat.ConvergenceError):
                assert model != "auto", zeros
            finally:
                done.set()
