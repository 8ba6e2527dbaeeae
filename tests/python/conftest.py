# SPDX-License-Identifier: BSD-3-Clause
"""What the Python tests share."""

import functools
import os
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeVar

import pytest

# Tests run side by side: threads of the linear algebra would only wait for each other. To be set before numpy is imported.
for threads in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(threads, "1")

if sys.dont_write_bytecode:
    # Beside the sources none is wanted; without any, each worker and each command that a test starts compiles all that it imports.
    sys.dont_write_bytecode = False
    sys.pycache_prefix = str(Path(__file__).resolve().parents[2] / ".pytest_cache" / "bytecode")
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix

import gyrostat  # noqa: E402
from gyrostat import charts, drawing, heavy  # noqa: E402
from gyrostat.cli import main  # noqa: E402
from gyrostat.families import FAMILIES  # noqa: E402
from gyrostat.scenes import bundled, load  # noqa: E402

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

ROTOR = """\
name = "test"
kind = "rotor"
source = "a test"

[solve]
duration = 100.0
samples = 11
tolerance = 1e-6
model = "auto"
integrator = "auto"

[body]
inertia = [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]]

[rotor]
axis = [0.36, 0.48, 0.8]
axial_inertia = 0.35

[motor]
slope = 0.05
no_load_rate = 30.0

[initial]
angular_velocity = [0.1, 0.2, 0.3]
rotor_rate = -1.0
attitude = [0.0, 0.0, 0.0, 1.0]
"""

# The same kind with carrier and rotor given apart.
ASSEMBLED = ROTOR.replace("[body]\ninertia = [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]]", """\
[carrier]
inertia = [2.1, 2.6, 3.2]
mass = 12.0""").replace("axial_inertia = 0.35", """\
axial_inertia = 0.35
mass = 3.0
equatorial_inertia = 0.3
offset = [0.2, -0.15, 0.3]""")

SPINNING = """\
name = "test"
kind = "spinning"
source = "a test"

[solve]
duration = 100.0
samples = 11
tolerance = 1e-6
model = "auto"
integrator = "auto"

[body]
inertia = [8.0, 7.0, 11.0]
mass = 10.0
rotor_momentum = 1.5

[field]
charge = 0.002
flux_density = 50.0
arm = 1.1
angle = 0.3

[torque]
body = [0.004, -0.002, 0.0]
force = [0.3, -0.2, 3.0]

[initial]
angular_velocity = [0.002, -0.003, 1.0]
euler_312 = [0.004, -0.002, 0.3]
velocity = [0.1, -0.2, 0.3]
position = [1.0, 2.0, 3.0]
"""

HEAVY = """\
name = "test"
kind = "heavy"
source = "a test"

[solve]
duration = 1.0
samples = 11
tolerance = 1e-6
model = "auto"
integrator = "auto"

[body]
inertia = [0.0011, 0.0016, 0.0020]
mass = 0.8
centre_of_mass = [0.012, 0.009, 0.010]

[field]
gravity = 9.80665
gravity_gradient = 4.6e-6

[initial]
angular_velocity = [0.1, -0.2, 150.0]
down = [0.6, 0.0, 0.8]
"""

# The same body in a periodic motion.
PERIODIC = HEAVY.replace("""angular_velocity = [0.1, -0.2, 150.0]
down = [0.6, 0.0, 0.8]
""", "periodic = { spin = 150.0, cos_inclination = 0.1 }\n")


Cases = TypeVar("Cases")


def at_length(few: Cases, all_of_them: Cases) -> Cases:
    """Which or how many cases a test takes: all by night, when GYROSTAT_TESTS_AT_LENGTH is in the environment."""
    return all_of_them if "GYROSTAT_TESTS_AT_LENGTH" in os.environ else few


@functools.cache
def kinds() -> dict[str, str]:
    """Of the bundled scenes."""
    return {name: load(name).kind for name, _ in bundled()}


def of_kind(kind: str) -> list[str]:
    """The bundled scenes of a kind."""
    return [name for name, its in kinds().items() if its == kind]


def scene_names() -> list[str]:
    """The bundled scenes; by day without the one that takes half a second."""
    return [name for name in kinds() if name != at_length("upper-stage-eddy-currents", "")]


def drawn(answer: gyrostat.Answer, file: Path, by_day: bool, least: int = 5000) -> Any:
    """The figure of an answer, written into a file of more than the least size [bytes]; by day only where it is to be."""
    written = at_length(by_day, True)
    figure = answer.plot(file if written else None)
    assert not written or file.stat().st_size > least
    return figure


def drawn_by_command(figure: str, name: str, folder: Path, capsys: pytest.CaptureFixture[str], by_day: bool) -> None:
    """A figure of a paper, deceleration-figure-4.png say, drawn by the command; by day only where it is to be, else it is composed and not written."""
    paper = name.partition("-")[0]
    if not at_length(by_day, True):
        ((stem, draw),) = FAMILIES[paper].part("gallery").drawings([figure])
        assert f"{stem}.png" == name and draw().axes
        return
    assert main(["reproduce", paper, figure, "-o", str(folder / "figures")]) == 0
    file = folder / "figures" / name
    assert file.read_bytes().startswith(b"\x89PNG")
    assert str(file) in capsys.readouterr().out


@pytest.fixture(autouse=True)
def coarse_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures of few dots: their files are looked for, not at."""
    monkeypatch.setattr(drawing, "DENSITY", 40)


@pytest.fixture(autouse=True)
def room_for_labels(monkeypatch: pytest.MonkeyPatch) -> None:
    """By day none is made in pictures, as that is half of the work; in those of test_figures.py it is."""
    if at_length(True, False) and find_spec("matplotlib"):
        monkeypatch.setattr("matplotlib.layout_engine.ConstrainedLayoutEngine.execute", lambda *_: None)


@pytest.fixture(autouse=True, scope="session")
def charts_of_single_runs() -> Iterator[None]:
    """By day a chart times each solution once: the least of several is test_chart.py's."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(charts, "LONG", at_length(0.0, charts.LONG))
        yield


@pytest.fixture
def few_members(monkeypatch: pytest.MonkeyPatch) -> None:
    """By day families of periodic motions are followed over a few members, where the test is not about where they end."""
    if at_length(True, False):
        monkeypatch.setattr(heavy, "periodic_family", functools.partial(heavy.periodic_family, most_members=12))


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


@pytest.fixture
def rotor_file(tmp_path: Path) -> Path:
    """A rotor scene in a file."""
    file = tmp_path / "rotor.toml"
    file.write_text(ROTOR)
    return file


@pytest.fixture
def spinning_file(tmp_path: Path) -> Path:
    """A spinning scene in a file."""
    file = tmp_path / "spinning.toml"
    file.write_text(SPINNING)
    return file


@pytest.fixture
def heavy_file(tmp_path: Path) -> Path:
    """A heavy scene in a file."""
    file = tmp_path / "heavy.toml"
    file.write_text(HEAVY)
    return file
