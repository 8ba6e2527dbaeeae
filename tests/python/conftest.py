# SPDX-License-Identifier: BSD-3-Clause
"""What the Python tests share."""

from pathlib import Path

import pytest

GOOD = """\
name = "test"
kind = "deceleration"
source = "a test"

[solve]
duration = 100.0
samples = 11
tolerance = 1e-6
model = "auto"
integrator = "auto"
elliptic = "auto"

[body]
inertia = [35.0, 22.0, 16.0]
rotor_momentum = [0.0, 0.0, 0.0]

[torque]
control = [0.005, 0.008, 0.010]
drag = 2.0e-4
law = "total"
drag_law = "total"

[initial]
angular_momentum = [40.0, 25.0, 16.5]
attitude = [0.0, 0.0, 0.0, 1.0]
"""


@pytest.fixture
def good() -> str:
    """Text of a scene without a mistake."""
    return GOOD


@pytest.fixture
def scene_file(tmp_path: Path) -> Path:
    """That text in a file."""
    file = tmp_path / "scene.toml"
    file.write_text(GOOD)
    return file
