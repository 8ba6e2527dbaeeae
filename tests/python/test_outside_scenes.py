# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that once were answered with too small an error, and the truth that judges them (tests/outside_scenes.py)."""

import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import at_length
from gyrostat import _core
from gyrostat.scenes import load, scene_from

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import outside_deceleration
import outside_scenes

FREE = {
    "name": "free", "kind": "deceleration", "solve": {"times": [1.0, 30.0]}, "body": {"inertia": [35.0, 22.0, 16.0], "rotor_momentum": [3.0, 1.0, 2.0]},
    "torque": {"control": [0.5, 0.8, 1.0], "drag": 0.02, "law": "carrier"}, "initial": {"angular_momentum": [40.0, 25.0, 16.5]},
}


def test_the_truth_is_that_of_the_long_double_integrator() -> None:
    columns, scalars = outside_deceleration.truth(FREE, [1.0, 30.0], ["stop_time"])
    other = _core.deceleration_integrate(
        inertia=[35.0, 22.0, 16.0], rotor_momentum=[3.0, 1.0, 2.0], control=[0.5, 0.8, 1.0], drag=0.02, law="carrier", drag_law="total",
        angular_momentum=[40.0, 25.0, 16.5], times=[1.0, 30.0], method="taylor", order=30, tolerance=1e-17, precision="long double")
    assert np.abs(columns["angular_momentum"] - other["angular_momentum"]).max() < 1e-14
    assert scalars["stop_time"] > 30


def test_the_judge_sees_a_lie() -> None:
    scene = scene_from(FREE, ask=["angular_momentum"])
    answer, rows = outside_scenes.verdicts(scene)
    assert answer.met and all(right for *_, right in rows)
    assert not outside_scenes.honest(stated=1e-9, true=2e-9, met=False, tolerance=1e-6)
    assert not outside_scenes.honest(stated=1e-3, true=1e-4, met=True, tolerance=1e-6)
    assert outside_scenes.honest(stated=1e-9, true=5e-10, met=True, tolerance=1e-6)


# Their truth takes a second or more; others are by day what they are: beside a separatrix, a tensor, an average.
LONG = ("averaged-outside-2", "exact-axis-averaged", "separatrix-sticks", "tensor-rotor-total-law")
FILES = [file for file in sorted(outside_scenes.SCENES.glob("*.toml")) if file.stem.removeprefix("deceleration-") not in at_length(LONG, ())]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_no_error_is_greater_than_stated(file: Path) -> None:
    answer, rows = outside_scenes.verdicts(load(file))
    assert rows
    assert not [row for row in rows if not row[-1]], answer
