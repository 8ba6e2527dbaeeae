# SPDX-License-Identifier: BSD-3-Clause
"""The spinning family from Python: functions over arrays, answers to scenes, their laws, and what is refused."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import SPINNING, drawn, of_kind
from gyrostat import Answer, DomainError, rotation, spinning
from gyrostat.cli import main
from gyrostat.facts import UNITS
from gyrostat.families.spinning.figures import _finish_map
from gyrostat.families.spinning.functions import SHAPES
from gyrostat.scenes import load, scene_from

SCENE = tomllib.loads(SPINNING)
GOOD: dict[str, Any] = {
    "inertia": [8.0, 7.0, 11.0], "mass": 10.0, "rotor_momentum": 1.5, "charge_momentum": 0.1, "torque": [0.004, -0.002, 0.0],
    "force": [0.3, -0.2, 3.0], "angular_velocity": [0.002, -0.003, 1.0], "euler_312": [0.004, -0.002, 0.3],
    "velocity": [0.1, -0.2, 0.3], "position": [1.0, 2.0, 3.0],
}
TIMES = [0.0, 10.0, 60.0]
HAS_CVODE = gyrostat.build_info()["cvode"] is not None
SPINNERS = of_kind("spinning")
RUNGS = ["linear", "second-order", "picard", "full"]


def distance(first: Answer, second: Answer) -> dict[str, float]:
    """Greatest distance of each column, as answers state errors."""
    made = {"attitude": float(np.max(rotation.angle_between(first["attitude"], second["attitude"])))}
    for name in first.columns.keys() - {"attitude"}:
        size = np.max(np.linalg.norm(second[name], axis=1))
        made[name] = float(np.max(np.linalg.norm(first[name] - second[name], axis=1)) / size)
    return made


@pytest.fixture(scope="module")
def answer() -> Answer:
    return gyrostat.solve(SCENE, model="full", tolerance=1e-11)


# ---- answers ----


def test_columns_have_the_shapes_and_names_of_the_contract(answer: Answer) -> None:
    n = len(answer.t)
    assert {name: values.shape for name, values in answer.columns.items()} == {
        "angular_velocity": (n, 3), "euler_312": (n, 3), "attitude": (n, 4), "angular_momentum_inertial": (n, 3), "velocity": (n, 3),
        "position": (n, 3)}
    assert set(answer.error) == set(answer.columns)
    assert set(answer.scalars) == {"pointing_error", "secular_velocity_ratio", "tilt_max", "nutation_frequency_squared"}
    assert set(answer.columns) | set(answer.scalars) <= set(UNITS)
    assert answer.model == "full" and answer.met and answer.greatest_error <= 1e-11 and answer.counts["rhs"] > 0


def test_columns_agree_with_each_other_and_with_the_laws(answer: Answer) -> None:
    R = rotation.matrix_from_quaternion(answer["attitude"])
    body = answer["angular_velocity"] * [8.0, 7.0, 11.0] + [0.0, 0.0, 1.5]
    assert np.allclose(np.einsum("nij,nj->ni", R, body), answer["angular_momentum_inertial"], rtol=0, atol=1e-13)
    angles = rotation.euler_312_from_quaternion(answer["attitude"])
    turns = (answer["euler_312"] - angles) / (2 * np.pi)
    assert np.allclose(turns, np.round(turns), atol=1e-12) and np.all(np.abs(turns[:, :2]) < 1e-12)
    assert np.argmax(answer["euler_312"][:, 2]) == len(answer.t) - 1 and answer["euler_312"][-1, 2] == pytest.approx(100.3, abs=0.1)
    assert answer.scalars["tilt_max"] == pytest.approx(float(np.max(np.arccos(R[:, 2, 2]))), rel=1e-6)


def test_the_start_is_that_of_the_scene(answer: Answer) -> None:
    start = answer.scene["initial"]
    for name in ("angular_velocity", "euler_312", "velocity", "position"):
        assert np.allclose(answer[name][0], start[name], rtol=1e-15)


@pytest.mark.parametrize("model", RUNGS)
def test_every_rung_is_as_good_as_it_says(model: str, answer: Answer) -> None:
    rung = gyrostat.solve(SCENE, model=model, tolerance=0.05)
    assert rung.model == model and rung.met
    for name, error in distance(rung, answer).items():
        assert error <= rung.error[name] + answer.error[name], name


def test_auto_takes_the_cheapest_that_is_good_enough(answer: Answer) -> None:
    loose, tight = (gyrostat.solve(SCENE, tolerance=tolerance) for tolerance in (0.05, 1e-10))
    assert loose.model == "linear" and loose.met and tight.model == "full" and tight.met
    assert [attempt.model for attempt in tight.tried][0] == "linear" and tight.tried[-1].accepted
    for made in (loose, tight):
        assert all(error <= made.error[name] + answer.error[name] for name, error in distance(made, answer).items())


def test_beyond_small_angles_the_linear_rung_says_so() -> None:
    climbed = gyrostat.solve("spinning-paper")
    assert climbed.model == "full" and climbed.met
    named = gyrostat.solve("spinning-paper", model="linear")
    assert not named.met and named.warnings and named["euler_312"][:, 0].max() > 10
    assert main(["solve", "spinning-paper", "--set", "model=linear", "--set", "samples=11"]) == 3


def test_a_torque_about_the_spin_axis() -> None:
    made = gyrostat.solve("despin-through-zero")
    full = gyrostat.solve("despin-through-zero", model="full", tolerance=1e-10)
    assert made.met and made["angular_velocity"][-1, 2] < -0.3
    for name, error in distance(made, full).items():
        assert error <= made.error[name] + full.error[name], name
    linear = gyrostat.solve("despin-through-zero", model="linear", tolerance=0.5)
    assert linear.model == "linear" and linear.scalars["pointing_error"] is None
    assert json.loads(linear.to_json())["scalars"]["secular_velocity_ratio"] == [None, None]


@pytest.mark.skipif(not HAS_CVODE, reason="this build has no CVODE")
def test_cvode_can_be_chosen(answer: Answer) -> None:
    other = gyrostat.solve(SCENE, model="full", integrator="cvode", tolerance=1e-5)
    assert other.model == "full"
    for name, error in distance(other, answer).items():
        assert error <= other.error[name] + answer.error[name], name


def test_cvode_is_named_where_it_is_missing() -> None:
    if not HAS_CVODE:
        with pytest.raises(DomainError, match="no CVODE"):
            gyrostat.solve(SCENE, model="full", integrator="cvode")


def test_attitude_and_charge_may_be_given_otherwise() -> None:
    q = rotation.quaternion_from_euler_312([0.004, -0.002, 0.3])
    e_H = spinning.charge_momentum(charge=0.002, flux_density=50.0, arm=1.1, angle=0.3)
    assert e_H == pytest.approx(0.002 * 50 * 1.21 * math.cos(0.3), rel=1e-15)
    first = gyrostat.solve(SCENE, model="full")
    second = gyrostat.solve(scene_from(SCENE, attitude=q, momentum=e_H), model="full")
    assert max(distance(first, second).values()) < 1e-13


def test_axes_may_be_turned_about_the_spin_axis(answer: Answer) -> None:
    turned = gyrostat.solve(answer.scene, inertia=[7.0, 8.0, 11.0], angular_velocity=[-0.003, -0.002, 1.0],
                            **{"torque.body": [-0.002, -0.004, 0.0], "force": [-0.2, -0.3, 3.0]},
                            attitude=rotation.quaternion_from_matrix(
                                rotation.matrix_from_quaternion(rotation.quaternion_from_euler_312([0.004, -0.002, 0.3]))
                                @ np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])))
    for name in ("angular_momentum_inertial", "velocity", "position"):
        assert np.allclose(turned[name], answer[name], rtol=0, atol=1e-9 * np.max(np.abs(answer[name])))


def test_forms_of_an_answer(answer: Answer, tmp_path: Path) -> None:
    read = json.loads(answer.to_json())
    assert all(read["columns"][name] == values.tolist() for name, values in answer.columns.items())
    assert gyrostat.solve(read["scene"]).columns["position"].tolist() == read["columns"]["position"]
    assert "euler_312_x" in answer.to_csv().splitlines()[0]
    xarray = pytest.importorskip("xarray")
    answer.to_netcdf(tmp_path / "answer.nc")
    with xarray.open_dataset(tmp_path / "answer.nc", engine="scipy") as dataset:
        assert dataset["velocity"].attrs["units"] == "m/s" and np.array_equal(dataset["position"].values, answer["position"])


@pytest.mark.parametrize("name", SPINNERS)
def test_bundled_scenes_are_met_and_drawn(name: str, tmp_path: Path) -> None:
    made = gyrostat.solve(name)
    assert made.met
    pytest.importorskip("matplotlib")
    figure = drawn(made, tmp_path / "answer.png", name == "pam-d-burn")
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert "theta [turns]" in labels if not gyrostat.load(name).tables["solve"]["ask"] else labels


def test_there_are_scenes_enough() -> None:
    assert len(SPINNERS) >= 6


def test_a_figure_of_a_body_at_rest(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    still = gyrostat.solve(SCENE, angular_velocity=[0.0, 0.0, 0.0], rotor_momentum=0.0,
                           **{"torque.body": [0.0, 0.0, 0.0], "force": [0.0, 0.0, 0.0]})
    assert still.met and np.ptp(still["attitude"], axis=0).max() < 1e-16
    still.plot(tmp_path / "answer.png")


def test_a_path_that_is_a_point_but_for_rounding_gets_a_frame() -> None:
    figures = pytest.importorskip("matplotlib.figure")
    for place in (0.0, 0.3):
        path = np.full((5, 3), place)
        path[2, 1] = place * (1 + 2**-52)
        axes = figures.Figure().add_subplot()
        axes.plot(path[:, 0], path[:, 1], label="axis")
        _finish_map(axes, "point", path)  # a warning is an error
        assert np.ptp(axes.get_ylim()) == pytest.approx(2e-3)


def test_the_report(spinning_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(spinning_file), "--set", "tolerance=1e-3"]) == 0
    out = capsys.readouterr().out
    assert "pointing_error" in out and "1/s2" in out and "angular_momentum_inertial" in out
    assert main(["solve", str(spinning_file), "--set", "integrator=radau"]) == 2
    assert "no such integrator" in capsys.readouterr().err


# ---- functions over arrays ----


def test_linear_is_the_linear_rung() -> None:
    rung = gyrostat.solve(SCENE, model="linear", tolerance=0.5)
    given = spinning.arguments(scene_from(SCENE))
    made = spinning.linear(t=rung.t, **{name: given[name] for name in SHAPES})
    for name in rung.columns:
        assert np.array_equal(getattr(made, name), rung[name]), name
    assert made.tilt_bound >= np.hypot(*made.euler_312[:, :2].T).max() and made.rate_bound >= np.hypot(*made.angular_velocity[:, :2].T).max()


def test_linear_broadcasts() -> None:
    torques = np.array([[0.004, -0.002, 0.0], [0.0, 0.001, 0.0]])
    spins = np.array([[[0.0, 0.0, 1.0]], [[0.0, 0.0, -2.0]], [[0.0, 0.0, 0.0]]])
    rest = {name: value for name, value in GOOD.items() if name not in ("torque", "angular_velocity")}
    many = spinning.linear(torque=torques, angular_velocity=spins, t=TIMES, **rest)
    assert many.attitude.shape == (3, 2, 3, 4) and many.error["theta"].shape == many.tilt_bound.shape == (3, 2)
    for i in range(3):
        for j in range(2):
            one = spinning.linear(torque=torques[j], angular_velocity=spins[i, 0], t=TIMES, **rest)
            assert np.array_equal(one.position, many.position[i, j]) and one.error["velocity"] == many.error["velocity"][i, j]


def test_torques_superpose_and_errors_hold() -> None:
    rest = {**GOOD, "force": [0.0, 0.0, 3.0]}
    two, four = (spinning.linear(t=TIMES, **{**rest, "torque": k * np.array([1e-3, 2e-3, 0.0])}) for k in (2, 4))
    none = spinning.linear(t=TIMES, **{**rest, "torque": [0.0, 0.0, 0.0]})
    for name in ("angular_velocity", "euler_312", "velocity", "position"):
        a, b, c = (getattr(made, name) for made in (none, two, four))
        assert np.allclose(c - a, 2 * (b - a), rtol=0, atol=1e-13 * np.max(np.abs(c)))
    full = spinning.solve(**GOOD, times=TIMES, model="full", tolerance=1e-11)
    made = spinning.linear(**GOOD, t=TIMES)
    off = np.abs(made.velocity - full["velocity"]).max(axis=0)
    assert math.hypot(*off[:2]) <= made.error["velocity"] and off[2] <= made.error["axial_velocity"]
    assert np.max(rotation.angle_between(made.attitude, full["attitude"])) <= made.error["attitude"]


@pytest.mark.parametrize("spin", [1.0, 0.0, -0.5, 1.5])
def test_linear_grid_is_linear(spin: float) -> None:
    given = {**GOOD, "angular_velocity": [[0.002, -0.003, spin], [0.0, 0.0, 2 * spin]]}
    grid = spinning.linear_grid(start=-3.0, step=0.25, samples=301, **given)
    made = spinning.linear(t=grid.t, **given)
    assert grid.p.shape == (2, 301)
    for name, column in (("p", made.angular_velocity[..., 0]), ("phi", made.euler_312[..., 1]), ("theta", made.euler_312[..., 2]),
                         ("G1", made.angular_momentum_inertial[..., 0]), ("G3", made.angular_momentum_inertial[..., 2]),
                         ("v2", made.velocity[..., 1]), ("x3", made.position[..., 2])):
        assert np.max(np.abs(getattr(grid, name) - column)) <= 1e-11 * max(np.max(np.abs(column)), 1e-3), name


def test_pointing_of_many() -> None:
    torque = np.array([4.0, -2.0, 0.0]) * np.array([0.0, 1.0, 10.0])[:, None]
    spins = np.array([0.5, 1.0, 0.0, -1.0])[:, None]
    error = spinning.pointing_error(inertia=[2985.0, 2729.0, 4183.0], torque=torque, spin_rate=spins, rotor_momentum=20.0)
    assert error.shape == (4, 3) and np.all(error[:, 0] == 0) and np.isinf(error[2, 1])
    assert error[1, 2] == pytest.approx(10 * math.hypot(4, 2) / 4203.0, rel=1e-15)
    square = spinning.nutation_frequency_squared(inertia=[[8.0, 11.0, 9.0], [9.0, 9.0, 9.0], [8.0, 7.0, 11.0]], spin_rate=1.0)
    assert square == pytest.approx([-2 / 8 * 1 / 11, 0.0, 4 / 8 * 3 / 7], rel=1e-14)
    assert square.dtype == float and np.ndim(spinning.pointing_error(inertia=[1, 1, 1], torque=[1, 0, 0], spin_rate=1.0)) == 0


def test_velocity_goes_to_its_limit() -> None:
    given = {name: value for name, value in GOOD.items() if name not in ("velocity", "position")}
    ratio = spinning.secular_velocity_ratio(**{name: value for name, value in given.items() if name != "mass"})
    far = spinning.linear(t=[2e7], **given).velocity[0]
    assert far[:2] / far[2] == pytest.approx(ratio, abs=1e-6)
    mean = spinning.pointing(**{name: value for name, value in given.items() if name not in ("mass", "force")}).mean_tilt
    grid = spinning.linear_grid(start=0.0, step=0.01, samples=2_000_000, **given)
    assert np.mean(np.exp(1j * grid.theta) * (grid.psi + 1j * grid.phi)) == pytest.approx(mean, abs=1e-6)
    still = spinning.pointing(inertia=[2.0, 2.2, 1.5], torque=[0.1, 0.0, 0.0], angular_velocity=[0.0, 0.0, 0.0], rotor_momentum=0.1)
    assert np.isnan(still.mean_tilt) and np.isinf(still.error)  # what stands leans on and on
    flags = spinning.pointing(inertia=[8.0, 7.0, 12.0], torque=[0, 0, 0], angular_velocity=[0, 0, 1], rotor_momentum=[-12.0, 0.0, -4.0])
    assert flags.compliant.tolist() == [True, False, False] and flags.resonant.tolist() == [True, False, False]
    unpushed = {**given, "force": [0.0, 0.0, 0.0]}
    unpushed.pop("mass")
    assert np.isnan(spinning.secular_velocity_ratio(**unpushed)).all()


def test_angles_of_many_attitudes() -> None:
    draw = np.random.default_rng(5)
    angles = draw.uniform([-1.5, -3.1, -3.1], [1.5, 3.1, 3.1], size=(4, 5, 3))
    q = rotation.quaternion_from_euler_312(angles)
    assert q.shape == (4, 5, 4) and np.allclose(rotation.euler_312_from_quaternion(q), angles, atol=1e-13)
    first = rotation.quaternion_from_euler_312(angles, scalar_first=True)
    assert np.array_equal(np.roll(first, -1, axis=-1), q)
    c, s = np.cos(angles), np.sin(angles)
    R = rotation.matrix_from_quaternion(q)
    assert np.allclose(R[..., 2, :], np.stack([-c[..., 0] * s[..., 1], s[..., 0], c[..., 0] * c[..., 1]], axis=-1), atol=1e-15)
    assert np.allclose(R[..., 0, 1], -s[..., 2] * c[..., 0], atol=1e-15)


def test_integrators_agree() -> None:
    truth = spinning.integrate(**GOOD, times=TIMES, method="taylor", order=30, tolerance=1e-18, precision="long double")
    methods = ["taylor", "dop853"]
    if HAS_CVODE:
        methods += ["cvode-adams", "cvode-bdf"]
    for method in methods:
        made = spinning.integrate(**GOOD, times=TIMES, method=method, tolerance=1e-12)
        assert made["status"] == "reached" and made["rhs"] > 0 and made["seconds"] > 0
        allowed = 1e-5 if "cvode" in method else 1e-9
        assert np.max(rotation.angle_between(made["attitude"], truth["attitude"])) < allowed, method
        for name in ("angular_velocity", "angular_momentum_inertial", "velocity", "position"):
            assert np.max(np.abs(made[name] - truth[name])) < allowed * np.max(np.abs(truth[name])), (method, name)


# ---- what is refused ----


@pytest.mark.parametrize(("change", "text"), [
    ({"inertia": [1.0, 2.0, 9.0]}, r"inertia = \[1, 2, 9\]: a principal moment exceeds"),
    ({"inertia": [1.0, 0.0, 1.0]}, r"inertia = \[1, 0, 1\]"),
    ({"inertia": np.eye(3)[:2, :2]}, "inertia: the shape is"),
    ({"mass": 0.0}, "mass = 0: give a finite number > 0"),
    ({"mass": math.nan}, "mass = .*not finite"),
    ({"torque": [1.0, 2.0]}, "torque: the shape is"),
    ({"force": [0.0, math.inf, 0.0]}, r"force = \[0, inf, 0\]: not finite"),
    ({"rotor_momentum": math.inf}, "rotor_momentum = .*not finite"),
    ({"charge_momentum": "x"}, "charge_momentum = x: not an array"),
    ({"angular_velocity": [math.nan, 0.0, 1.0]}, "angular_velocity = .*not finite"),
    ({"euler_312": [0.0, 0.0]}, "euler_312: the shape is"),
    ({"velocity": [0.0, 0.0, math.inf]}, "velocity = .*not finite"),
    ({"position": [0.0, 0.0, math.inf]}, "position = .*not finite"),
])
def test_a_bad_argument_is_named(change: dict[str, Any], text: str) -> None:
    given = {**GOOD, **change}
    with pytest.raises(DomainError, match=text):
        spinning.solve(**given, times=TIMES)
    with pytest.raises(DomainError, match=text):
        spinning.integrate(**given, times=TIMES)
    with pytest.raises(DomainError, match=text):
        spinning.linear(**given, t=TIMES)
    with pytest.raises(DomainError, match=text):
        spinning.linear_grid(**given, step=1.0, samples=3)


def test_a_bad_row_is_named() -> None:
    with pytest.raises(DomainError, match="row 1: mass = -1"):
        spinning.linear(**{**GOOD, "mass": [1.0, -1.0, 2.0]}, t=TIMES)
    with pytest.raises(DomainError, match="row 2: torque = .*not finite"):
        spinning.linear(**{**GOOD, "torque": [[0, 0, 0], [1, 0, 0], [math.nan, 0, 0]]}, t=TIMES)
    with pytest.raises(DomainError, match=r"row 1: torque\[2\] = 0.5: the closed form"):
        spinning.linear_grid(**{**GOOD, "torque": [[0, 0, 0], [1, 0, 0.5]]}, step=1.0, samples=2)
    with pytest.raises(DomainError, match="leading axes"):
        spinning.solve(**{**GOOD, "mass": [1.0, 2.0]}, times=TIMES)
    with pytest.raises(DomainError, match="broadcast"):
        spinning.pointing_error(inertia=[1, 1, 1], torque=np.zeros((2, 3)), spin_rate=[1.0, 2.0, 3.0])


@pytest.mark.parametrize(("change", "text"), [
    ({"times": [2.0, 1.0]}, "times: element 1"), ({"times": []}, "times"), ({"tolerance": 1.0}, "tolerance = 1"),
    ({"model": "averaged"}, "model = 'averaged'.*second-order"), ({"integrator": "radau"}, "integrator = 'radau'.*taylor or cvode"),
])
def test_a_bad_choice_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        spinning.solve(**{**GOOD, "times": TIMES, **change})


@pytest.mark.parametrize(("change", "text"), [
    ({"method": "euler"}, "method = 'euler'"), ({"order": 7}, "order = 7"), ({"precision": "half"}, "precision = 'half'"),
    ({"precision": "long double"}, "only method taylor of order 30"), ({"tolerance": -1.0}, "tolerance = -1"), ({"times": []}, "times"),
])
def test_a_bad_setting_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        spinning.integrate(**{**GOOD, "times": TIMES, **change})


@pytest.mark.parametrize(("change", "text"), [
    ({"step": 0.0}, "step = 0"), ({"step": math.nan}, "step = nan"), ({"start": math.inf}, "start = inf"), ({"samples": 0}, "samples = 0"),
    ({"samples": 2.5}, "samples = 2.5"),
])
def test_a_bad_grid_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        spinning.linear_grid(**{**GOOD, "step": 1.0, "samples": 3, **change})


def test_a_mean_that_is_too_great_for_its_formula_is_told() -> None:
    stage = {"name": "kick", "kind": "spinning", "body": {"inertia": [400.0, 380.0, 150.0], "mass": 1000.0}, "torque": {"body": [5.0, 0.0, 0.0],
             "force": [0.0, 0.0, 1e4]}, "initial": {"angular_velocity": [0.0, 0.0, 0.5]}, "solve": {"duration": 100.0, "samples": 11, "tolerance": 1e-4}}
    wide = gyrostat.solve(stage, ask=["pointing_error"])
    assert wide.scalars["pointing_error"] == pytest.approx(5 / (0.5 * 0.5 * 150))
    assert [warning.code for warning in wide.warnings].count("mean-of-small-tilt") == 1
    assert "mean-of-small-tilt" not in [warning.code for warning in gyrostat.solve(stage, ask=["tilt_max"]).warnings]
    fast = gyrostat.solve(stage, angular_velocity=[0.0, 0.0, 1.0])
    assert fast.scalars["pointing_error"] < 0.05 and "mean-of-small-tilt" not in [warning.code for warning in fast.warnings]
