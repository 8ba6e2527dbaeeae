# SPDX-License-Identifier: BSD-3-Clause
"""The rotor family from Python: functions over arrays, answers to scenes, their laws, and what is refused."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import ASSEMBLED, ROTOR, drawn, of_kind
from gyrostat import Answer, DomainError, rotation, rotor
from gyrostat.cli import main
from gyrostat.facts import UNITS
from gyrostat.scenes import load, scene_from
from numpy.typing import NDArray

SCENE = tomllib.loads(ROTOR)
THETA = np.array(SCENE["body"]["inertia"])
AXIS = np.array([0.36, 0.48, 0.8])
GOOD: dict[str, Any] = {
    "inertia": THETA, "axis": AXIS, "axial_inertia": 0.35, "slope": 0.05, "no_load_rate": 30.0, "angular_velocity": [0.1, 0.2, 0.3],
    "rotor_rate": -1.0, "attitude": [0.5, -0.5, 0.5, 0.5], "times": [0.0, 10.0, 60.0],
}
HAS_CVODE = gyrostat.build_info()["cvode"] is not None
ROTORS = of_kind("rotor")


def turn_between(p: NDArray[Any], q: NDArray[Any]) -> float:
    """Greatest angle between attitudes (n, 4), rad."""
    chord = np.minimum(np.linalg.norm(p - q, axis=1), np.linalg.norm(p + q, axis=1))
    return float(np.max(4 * np.arcsin(chord / 2)))


@pytest.fixture(scope="module")
def answer() -> Answer:
    return gyrostat.solve(SCENE, model="full", slope=0.5, tolerance=1e-9)


# ---- answers ----


def test_columns_have_the_shapes_and_names_of_the_contract(answer: Answer) -> None:
    n = len(answer.t)
    assert {name: values.shape for name, values in answer.columns.items()} == {
        "attitude": (n, 4), "angular_velocity": (n, 3), "angular_momentum": (n, 3), "rotor_rate": (n,), "rotor_angle": (n,), "lyapunov": (n,)}
    assert set(answer.error) == set(answer.columns) and set(answer.scalars) == {"attractor", "decay_rate"}
    assert set(answer.columns) | set(answer.scalars) <= set(UNITS)
    assert answer.model == "full" and answer.met and answer.greatest_error <= 1e-9 and answer.counts["rhs"] > 0


def test_columns_agree_with_each_other_and_with_the_laws(answer: Answer) -> None:
    H, omega = answer["angular_momentum"], answer["rotor_rate"]
    assert np.allclose(H, answer["angular_velocity"] @ THETA + 0.35 * omega[:, None] * AXIS, rtol=0, atol=1e-12 * np.max(np.abs(H)))
    inertial = np.einsum("nij,nj->ni", rotation.matrix_from_quaternion(answer["attitude"]), H)
    assert np.max(np.abs(inertial - inertial[0])) < 1e-11 * np.linalg.norm(H[0])  # exact where steps end, by polynomials between
    V, J = answer["lyapunov"], np.linalg.inv(THETA)
    y = H - 0.35 * 30.0 * AXIS
    k = 1 - 0.35 * AXIS @ J @ AXIS
    assert np.allclose(V, np.einsum("ni,ij,nj->n", y, J, y) / 2 + 0.35 * k * (omega - 30.0) ** 2 / 2, rtol=1e-12)
    assert np.all(np.diff(V) < 0) and answer["rotor_angle"][0] == 0.0


def test_the_start_is_that_of_the_scene(answer: Answer) -> None:
    start = load_start(answer)
    assert np.allclose(answer["angular_velocity"][0], start["angular_velocity"], rtol=1e-14)
    assert answer["rotor_rate"][0] == pytest.approx(start["rotor_rate"], rel=1e-13)
    assert np.array_equal(answer["attitude"][0], start["attitude"])


def load_start(answer: Answer) -> dict[str, Any]:
    start: dict[str, Any] = answer.scene["initial"]
    return start


def test_components_are_the_whole_that_they_make() -> None:
    parts = tomllib.loads(ASSEMBLED)
    reduced, d = 12.0 * 3.0 / 15.0, np.array([0.2, -0.15, 0.3])
    along = np.outer(AXIS, AXIS)
    theta = np.diag([2.1, 2.6, 3.2]) + 0.35 * along + 0.3 * (np.eye(3) - along) + reduced * (d @ d * np.eye(3) - np.outer(d, d))
    assert np.allclose(rotor.arguments(scene_from(parts))["inertia"], theta, rtol=1e-15)
    apart = gyrostat.solve(parts)
    whole = gyrostat.solve({**{key: value for key, value in parts.items() if key != "carrier"}, "body": {"inertia": theta.tolist()},
                            "rotor": {"axis": AXIS.tolist(), "axial_inertia": 0.35}})
    assert apart.model == whole.model
    for name in apart.columns:
        assert np.allclose(apart[name], whole[name], rtol=1e-11, atol=1e-11)


def test_at_rest_the_closed_form_answers() -> None:
    still = gyrostat.solve(SCENE, angular_velocity=[0.0, 0.0, 0.0], rotor_rate=0.0)
    assert still.model == "closed-form" and still.met
    k = 1 - 0.35 * AXIS @ np.linalg.inv(THETA) @ AXIS
    assert still["rotor_rate"] == pytest.approx(30.0 * -np.expm1(-0.05 / (0.35 * k) * still.t), rel=1e-13)
    full = gyrostat.solve(SCENE, angular_velocity=[0.0, 0.0, 0.0], rotor_rate=0.0, model="full", tolerance=1e-10)
    assert turn_between(still["attitude"], full["attitude"]) <= full.error["attitude"] + still.error["attitude"]


def test_near_its_end_the_linear_tail_answers() -> None:
    rest = gyrostat.solve("rotor-paper-repaired", angular_velocity=[0.0571356, 0.1052402, 0.9415], rotor_rate=1.0, tolerance=1e-2)
    assert rest.model == "closed-form"  # a steady rotation is near enough
    tail = gyrostat.solve("rotor-paper-repaired", angular_velocity=[0.0571356, 0.1052402, 0.9415], rotor_rate=1.0, tolerance=1e-5)
    full = gyrostat.solve(tail.scene, model="full", tolerance=1e-9)
    assert tail.model in ("linear-tail", "full")
    for answered in (rest, tail):
        for name in ("angular_velocity", "rotor_rate"):
            error = np.max(np.abs(answered[name] - full[name])) / np.max(np.abs(full[name]))
            assert error <= answered.error[name] + full.error[name]


@pytest.mark.parametrize("integrator", ["taylor", "radau", *(["cvode"] if HAS_CVODE else [])])
def test_the_integrator_can_be_chosen(answer: Answer, integrator: str) -> None:
    other = gyrostat.solve(answer.scene, integrator=integrator, tolerance=1e-5)
    assert other.model == "full" and (other.met or integrator == "cvode")
    assert turn_between(other["attitude"], answer["attitude"]) <= other.error["attitude"] + answer.error["attitude"]
    for name in ("angular_velocity", "angular_momentum", "rotor_rate", "rotor_angle", "lyapunov"):
        error = np.max(np.abs(other[name] - answer[name])) / np.max(np.abs(answer[name]))
        assert error <= other.error[name] + answer.error[name], name


def test_cvode_is_named_where_it_is_missing() -> None:
    if not HAS_CVODE:
        with pytest.raises(DomainError, match="no CVODE"):
            gyrostat.solve(SCENE, model="full", integrator="cvode")


def test_axes_may_come_in_any_order(answer: Answer) -> None:
    order = [2, 0, 1]  # a cyclic exchange is a proper rotation
    turned = gyrostat.solve(answer.scene, inertia=THETA[np.ix_(order, order)], axis=AXIS[order],
                            angular_velocity=np.array([0.1, 0.2, 0.3])[order])
    for name in ("angular_momentum", "angular_velocity"):
        assert np.max(np.abs(turned[name] - answer[name][:, order])) < 1e-9 * np.max(np.abs(answer[name]))
    assert turned["lyapunov"] == pytest.approx(answer["lyapunov"], rel=1e-9)


def test_the_attractor_is_a_place_in_a_list_or_nothing() -> None:
    long = gyrostat.solve("two-attractors")
    assert isinstance(long.scalars["attractor"], int) and long.scalars["decay_rate"] > 0
    assert isinstance(json.loads(long.to_json())["scalars"]["attractor"], int)
    early = gyrostat.solve("two-attractors", times=[0.0, 1.0])
    assert early.scalars["attractor"] is None and early.scalars["decay_rate"] is None
    assert json.loads(early.to_json())["scalars"] == {"attractor": None, "decay_rate": None}
    assert "attractor-undecided" in [warning.code for warning in early.warnings]
    free = gyrostat.solve(SCENE, slope=0.0)
    assert free.scalars["attractor"] is None and "no-motor" in [warning.code for warning in free.warnings]


def test_a_body_that_cannot_be_made_is_answered_with_a_warning() -> None:
    def codes(name: str) -> list[str]:
        return [warning.code for warning in gyrostat.solve(name).warnings]

    assert "not-realisable" in codes("rotor-paper-example")
    assert "not-realisable" not in codes("rotor-paper-repaired")


def test_a_stiff_motor_costs_no_more_than_a_slack_one() -> None:
    stiff = gyrostat.solve("stiff-wheel")
    stiffer = gyrostat.solve("stiff-wheel", slope=3.5e6)
    assert stiff.met and stiffer.met and stiffer.counts["rhs"] < 3 * stiff.counts["rhs"]


def test_forms_of_an_answer(answer: Answer, tmp_path: Path) -> None:
    read = json.loads(answer.to_json())
    assert all(read["columns"][name] == values.tolist() for name, values in answer.columns.items())
    assert gyrostat.solve(read["scene"]).columns["lyapunov"].tolist() == read["columns"]["lyapunov"]
    assert answer.to_csv().splitlines()[0].startswith("t,attitude_x,attitude_y,attitude_z,attitude_w,angular_velocity_x")
    xarray = pytest.importorskip("xarray")
    answer.to_netcdf(tmp_path / "answer.nc")
    with xarray.open_dataset(tmp_path / "answer.nc", engine="scipy") as dataset:
        assert dataset["rotor_rate"].attrs["units"] == "rad/s" and np.array_equal(dataset["lyapunov"].values, answer["lyapunov"])


@pytest.mark.parametrize("name", ROTORS)
def test_a_figure_is_written(name: str, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    figure = drawn(gyrostat.solve(name), tmp_path / "answer.png", name == "stiff-wheel")
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert ("ω [rad/s]" in labels and "V [J]" in labels) if not gyrostat.load(name).tables["solve"]["ask"] else labels


def test_a_figure_of_a_body_at_rest(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    figure = gyrostat.solve(SCENE, angular_velocity=[0.0, 0.0, 0.0], rotor_rate=0.0).plot(tmp_path / "answer.png")
    assert "q" in [axes.get_ylabel() for axes in figure.axes]


def test_the_report_says_what_is_certified(rotor_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "two-attractors"]) == 0
    out = capsys.readouterr().out
    assert "attractor" in out and "decay_rate" in out and "1/s" in out and "rotor_rate" in out
    assert main(["solve", "two-attractors", "--set", "times=[1.0]"]) == 0
    assert "not certified" in capsys.readouterr().out
    assert main(["solve", str(rotor_file), "--set", "axial_inertia=9.0"]) == 2
    assert "rotor.axial_inertia" in capsys.readouterr().err
    assert main(["solve", str(rotor_file), "--set", "model=closed-form"]) == 2
    assert "closed-form" in capsys.readouterr().err


# ---- functions ----


def test_solve_takes_what_a_scene_holds(answer: Answer) -> None:
    made = rotor.solve(**rotor.arguments(scene_from(answer.scene)))
    assert np.array_equal(made["attitude"], answer["attitude"])


def test_integrators_agree() -> None:
    truth = rotor.integrate(**GOOD, method="taylor", order=30, tolerance=1e-19, precision="long double")
    other = rotor.integrate(**GOOD, method="radau", tolerance=1e-19, precision="long double")
    assert truth["status"] == other["status"] == "reached" and turn_between(truth["attitude"], other["attitude"]) < 1e-14
    methods = ["taylor", "radau", "dop853"]
    if HAS_CVODE:
        methods += ["cvode-adams", "cvode-bdf"]
    for method in methods:
        made = rotor.integrate(**GOOD, method=method, tolerance=1e-12)
        assert made["status"] == "reached" and made["rhs"] > 0 and made["seconds"] > 0
        allowed = 1e-4 if "cvode" in method else 1e-8
        assert turn_between(made["attitude"], truth["attitude"]) < allowed, method
        for name in ("angular_velocity", "angular_momentum", "rotor_rate", "rotor_angle", "lyapunov"):
            assert np.max(np.abs(made[name] - truth[name])) < allowed * np.max(np.abs(truth[name])), (method, name)


@pytest.mark.parametrize(("change", "text"), [
    ({"inertia": [1.0, 2.0, 9.0]}, r"inertia = \[1, 2, 9\]: a principal moment exceeds"),
    ({"inertia": [[1.0, 2.0], [3.0, 4.0]]}, "inertia: the shape is"),
    ({"axis": [0.0, 0.0, 2.0]}, r"axis = \[0, 0, 2\]: the length is 2, not 1"),
    ({"axis": [0.0, 0.0, 0.0]}, "axis = .*length is 0"),
    ({"axis": [0.0, math.nan, 1.0]}, "axis = .*not finite"),
    ({"axis": [0.0, 1.0]}, "axis: the shape is"),
    ({"axial_inertia": 0.0}, "axial_inertia = 0: give a finite number > 0"),
    ({"axial_inertia": 4.6}, "axial_inertia = 4.6: the whole gyrostat holds less than 4.53549467"),
    ({"slope": -0.1}, "slope = -0.1"),
    ({"slope": math.inf}, "slope = inf"),
    ({"no_load_rate": math.nan}, "no_load_rate = nan"),
    ({"angular_velocity": [1.0, 2.0]}, "angular_velocity: the shape is"),
    ({"rotor_rate": math.inf}, "rotor_rate = inf"),
    ({"attitude": [0.0, 0.0, 0.0, 2.0]}, "attitude = .*unit"),
    ({"times": [2.0, 1.0]}, "times: element 1"),
    ({"times": []}, "times"),
])
def test_a_bad_argument_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        rotor.solve(**{**GOOD, **change})
    with pytest.raises(DomainError, match=text):
        rotor.integrate(**{**GOOD, **change})


@pytest.mark.parametrize(("change", "text"), [
    ({"tolerance": 1.0}, "tolerance = 1"), ({"model": "averaged"}, "model = 'averaged'.*linear-tail"),
    ({"integrator": "euler"}, "integrator = 'euler'.*radau"),
])
def test_a_bad_choice_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        rotor.solve(**{**GOOD, **change})


@pytest.mark.parametrize(("change", "text"), [
    ({"method": "euler"}, "method = 'euler'"), ({"order": 7}, "order = 7"), ({"precision": "half"}, "precision = 'half'"),
    ({"precision": "long double"}, "only method taylor of order 30, and radau"), ({"tolerance": -1.0}, "tolerance = -1"),
])
def test_a_bad_setting_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        rotor.integrate(**{**GOOD, **change})


PARTS: dict[str, Any] = {"carrier_inertia": [2.1, 2.6, 3.2], "carrier_mass": 12.0, "rotor_mass": 3.0, "axis": AXIS, "axial_inertia": 0.35,
                         "equatorial_inertia": 0.3, "offset": [0.2, -0.15, 0.3]}


@pytest.mark.parametrize(("change", "text"), [
    ({"carrier_inertia": [1.0, 2.0, 9.0]}, r"carrier_inertia = \[1, 2, 9\]"), ({"carrier_mass": 0.0}, "carrier_mass = 0"),
    ({"rotor_mass": -1.0}, "rotor_mass = -1"), ({"axis": [1.0, 1.0, 0.0]}, "axis = .*1.41421356"),
    ({"equatorial_inertia": 0.1}, "axial_inertia = 0.35: more than twice equatorial_inertia = 0.1"),
    ({"equatorial_inertia": math.nan}, "equatorial_inertia = nan"), ({"offset": [1.0, math.inf, 0.0]}, "offset = .*not finite"),
])
def test_a_bad_part_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        rotor.assembled_inertia(**{**PARTS, **change})


@pytest.mark.parametrize(("body", "wheel", "motor", "rates", "exact"), [
    ([0.3851670853165049, 0.7703341706330098, 0.9629177132912623], 0.010003027677950149, (0.0005001513838975074, -0.005546857995155879),
     (-0.027035922825800366, 2.6025489304127936), 1.5985928450100736582e-09)])
def test_a_momentum_that_cancels_at_the_start_is_known_as_well_as_its_parts(body: list[float], wheel: float, motor: tuple[float, float], rates: tuple[float, float],
                                                                             exact: float) -> None:
    answer = rotor.solve(inertia=body, axis=[0.0, 0.0, 1.0], axial_inertia=wheel, slope=motor[0], no_load_rate=motor[1],
                         angular_velocity=[0.0, 0.0, rates[0]], rotor_rate=rates[1], times=[2000.0], tolerance=1e-6)
    assert answer.model == "closed-form" and abs(answer["lyapunov"][0] / exact - 1) > 1e-14  # by the roundings of the start
    scale = max(answer.scale["lyapunov"], exact)
    assert abs(answer["lyapunov"][0] - exact) <= answer.error["lyapunov"] * scale
