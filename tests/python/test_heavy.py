# SPDX-License-Identifier: BSD-3-Clause
"""The heavy family from Python: functions over arrays, answers to scenes, their laws, and what is refused."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import HEAVY, PERIODIC, drawn, of_kind
from gyrostat import Answer, ConvergenceError, DomainError, heavy, rotation
from gyrostat.cli import main
from gyrostat.facts import UNITS
from gyrostat.scenes import scene_from
from numpy.typing import NDArray

SCENE = tomllib.loads(HEAVY)
ORBIT = tomllib.loads(PERIODIC)
BODY: dict[str, Any] = {"inertia": [0.0011, 0.0016, 0.0020], "mass": 0.8, "centre_of_mass": [0.012, 0.009, 0.010], "gravity": 9.80665,
                        "gravity_gradient": 4.6e-6}
TOP: dict[str, Any] = {"inertia": [0.002, 0.002, 0.001], "mass": 0.5, "centre_of_mass": [0.0, 0.0, 0.04], "gravity": 9.80665}
ATTITUDE = [0.5, -0.1, 0.1, math.sqrt(1 - 0.27)]
HAS_CVODE = gyrostat.build_info()["cvode"] is not None
SCENES = of_kind("heavy")


def distance(first: Any, second: Any) -> dict[str, float]:
    """Greatest distance of each column of the first, as answers state errors."""
    made = {}
    for name in set(first) & {"angular_velocity", "down", "attitude"}:
        if name == "attitude":
            made[name] = float(np.max(rotation.angle_between(first[name], second[name])))
        else:
            size = np.max(np.linalg.norm(second[name], axis=1))
            made[name] = float(np.max(np.linalg.norm(first[name] - second[name], axis=1)) / size)
    return made


def energy(w: NDArray[np.float64], d: NDArray[np.float64]) -> NDArray[np.float64]:
    I, m, N = np.array(BODY["inertia"]), BODY["mass"] * BODY["gravity"] * np.array(BODY["centre_of_mass"]), BODY["gravity_gradient"]
    made: NDArray[np.float64] = (w**2 @ I + N * (d**2 @ I)) / 2 - d @ m
    return made


@pytest.fixture(scope="module")
def answer() -> Answer:
    return gyrostat.solve(SCENE, attitude=ATTITUDE, tolerance=1e-11)


# ---- answers ----


def test_columns_have_the_shapes_and_names_of_the_contract(answer: Answer) -> None:
    n = len(answer.t)
    assert {name: values.shape for name, values in answer.columns.items()} == {"angular_velocity": (n, 3), "down": (n, 3), "attitude": (n, 4)}
    assert set(gyrostat.solve(SCENE).columns) == {"angular_velocity", "down"} == set(gyrostat.solve(ORBIT).columns)
    assert set(answer.error) == set(answer.columns)
    assert set(answer.scalars) == {"period", "floquet_trace", "stable", "precession_rate"}
    assert set(answer.columns) | set(answer.scalars) <= set(UNITS)
    assert answer.model == "full" and answer.met and answer.greatest_error <= 1e-11 and answer.counts["rhs"] > 0


def test_what_is_kept_is_kept_and_the_vertical_points_up(answer: Answer) -> None:
    w, d = answer["angular_velocity"], answer["down"]
    R = rotation.matrix_from_quaternion(answer["attitude"])
    assert np.max(np.abs(d + R[:, 2, :])) < 1e-14
    assert np.ptp(energy(w, d)) < 1e-12 * energy(w, d)[0]
    sigma = np.sum(np.array(BODY["inertia"]) * w * d, axis=1)
    assert np.ptp(sigma) < 1e-12 * abs(sigma[0])
    assert np.allclose(rotation.angle_between(answer["attitude"][0], ATTITUDE), 0, atol=1e-15)


def test_a_body_left_alone_falls_down() -> None:
    R = rotation.matrix_from_vector([2.0, 0.3, 0.1])
    made = gyrostat.solve(SCENE, attitude=rotation.quaternion_from_matrix(R), angular_velocity=[0, 0, 0], times=[0.0, 0.01])
    turned = rotation.matrix_from_quaternion(made["attitude"])
    height = turned @ np.array(BODY["centre_of_mass"])
    assert height[1, 2] < height[0, 2]


def test_auto_takes_the_cheapest_that_is_good_enough() -> None:
    loose, tight = (gyrostat.solve(ORBIT, tolerance=tolerance) for tolerance in (0.05, 1e-9))
    full = gyrostat.solve(ORBIT, model="full", tolerance=1e-12)
    assert loose.model == "series-2" and tight.model == "series" and loose.met and tight.met
    for made in (loose, tight):
        for name, error in distance(made.columns, full.columns).items():
            assert error <= made.error[name] + full.error[name], name
        assert made.scalars["period"] == pytest.approx(full.scalars["period"], rel=max(made.greatest_error, 1e-12))


def test_scalars_of_a_periodic_motion() -> None:
    made = gyrostat.solve(ORBIT, tolerance=1e-9)
    T, trace = made.scalars["period"], made.scalars["floquet_trace"]
    orbit = heavy.periodic_orbit(**BODY, spin=150.0, cos_inclination=0.1)
    assert orbit.period == pytest.approx(T, rel=1e-12) and orbit.trace == pytest.approx(trace, abs=1e-2)
    assert made.scalars["stable"] is True and str(orbit.verdict) == "stable"
    again = heavy.integrate(**BODY, angular_velocity=orbit.angular_velocity, down=orbit.down / np.linalg.norm(orbit.down), times=[T, 2 * T],
                            tolerance=1e-15)
    assert np.allclose(again["angular_velocity"], orbit.angular_velocity, rtol=0, atol=1e-11 * 150)
    assert np.allclose(again["down"], orbit.down, rtol=0, atol=1e-11)
    read = json.loads(gyrostat.solve(SCENE).to_json())["scalars"]
    assert read == {"period": None, "floquet_trace": None, "stable": None, "precession_rate": None}


def test_a_tongue_is_unstable(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "half-rate-tongue", "--set", "model=full"]) == 0
    out = capsys.readouterr().out
    assert "warning, unstable" in out and "stable           no" in out
    made = gyrostat.solve("half-rate-tongue", model="full")
    assert made.scalars["stable"] is False and made.scalars["floquet_trace"] < -2
    series = gyrostat.solve("half-rate-tongue")
    assert series.model == "series" and series.scalars["stable"] in (None, False)


def test_exact_is_full_where_both_answer() -> None:
    exact, full = (gyrostat.solve("toy-top", model=model, tolerance=1e-10) for model in ("exact", "full"))
    assert exact.model == "exact" and exact.met and full.met
    for name, error in distance(exact.columns, full.columns).items():
        assert error <= exact.error[name] + full.error[name], name
    with pytest.raises(DomainError, match="exact"):
        gyrostat.solve(SCENE, model="exact")
    with pytest.raises(DomainError, match="free nutation"):
        gyrostat.solve(SCENE, model="series", angular_velocity=[0, 0, 1])
    beyond = gyrostat.solve(SCENE, model="series")
    assert not beyond.met and beyond.warnings and json.loads(beyond.to_json())["error"]["down"] is None


@pytest.mark.skipif(not HAS_CVODE, reason="this build has no CVODE")
def test_cvode_can_be_chosen(answer: Answer) -> None:
    other = gyrostat.solve(SCENE, attitude=ATTITUDE, model="full", integrator="cvode", tolerance=1e-5)
    for name, error in distance(other.columns, answer.columns).items():
        assert error <= other.error[name] + answer.error[name], name


def test_cvode_is_named_where_it_is_missing() -> None:
    if not HAS_CVODE:
        with pytest.raises(DomainError, match="no CVODE"):
            gyrostat.solve(SCENE, model="full", integrator="cvode")


def test_the_body_may_be_given_in_other_axes(answer: Answer) -> None:
    Q = rotation.matrix_from_vector([0.3, -0.5, 0.4])
    turned = gyrostat.solve(SCENE, inertia=Q @ np.diag(BODY["inertia"]) @ Q.T, centre_of_mass=Q @ BODY["centre_of_mass"],
                            angular_velocity=Q @ SCENE["initial"]["angular_velocity"],
                            attitude=rotation.quaternion_from_matrix(rotation.matrix_from_quaternion(ATTITUDE) @ Q.T), tolerance=1e-11)
    assert np.allclose(turned["down"] @ Q, answer["down"], atol=1e-9)
    assert np.allclose(turned["angular_velocity"] @ Q, answer["angular_velocity"], atol=1e-7)
    R = rotation.matrix_from_quaternion(turned["attitude"]) @ Q
    assert np.allclose(R, rotation.matrix_from_quaternion(answer["attitude"]), atol=1e-9)


def test_principal_axes_are_found_and_named_as_solve_names_them() -> None:
    Q = rotation.matrix_from_vector([[0.3, -0.5, 0.4], [-0.2, 0.1, 0.7], [0.0, 0.0, 0.0]])
    moments = np.array([[1.1e-3, 1.6e-3, 2.0e-3], [2.0e-3, 1.1e-3, 1.6e-3], [2.0e-3, 1.6e-3, 1.1e-3]])
    tensor = Q @ (moments[:, :, None] * np.eye(3)) @ np.swapaxes(Q, 1, 2)
    found, axes = heavy.principal_axes((tensor + np.swapaxes(tensor, 1, 2)) / 2)
    assert found == pytest.approx(moments, rel=1e-13) and axes == pytest.approx(Q, abs=1e-12)
    assert np.array_equal(axes[2], np.eye(3)) and np.array_equal(found[2], moments[2])
    # the periodic motion of a body in other axes starts where its own axes say
    given = {**BODY, "inertia": tensor[0], "centre_of_mass": Q[0] @ BODY["centre_of_mass"]}
    orbit = heavy.periodic_orbit(**{**BODY, "inertia": found[0], "centre_of_mass": axes[0].T @ given["centre_of_mass"]}, spin=150.0,
                                 cos_inclination=0.1)
    answer = heavy.solve(**given, periodic={"spin": 150.0, "cos_inclination": 0.1}, times=[0.0], model="full", tolerance=1e-9)
    assert np.ravel(answer["angular_velocity"])[:3] == pytest.approx(axes[0] @ orbit.angular_velocity, rel=1e-9)
    # a quarter turn of axes, and a hand that eigenvectors need not have
    moments, axes = heavy.principal_axes([[2.0, 1e-3, 0.0], [1e-3, 1.5, 0.0], [0.0, 0.0, 3.0]])
    assert np.linalg.det(axes) == pytest.approx(1) and moments == pytest.approx([2.0, 1.5, 3.0], rel=1e-5)
    assert np.all(np.isfinite(heavy.principal_axes(np.diag([1.0, 0.9, 0.8]) * 1.7e308)[0]))
    for wrong in ([1.0, 2.0, 2.5], [[1.0, 0.1, 0], [0.2, 1.0, 0], [0, 0, 1.0]], [[math.nan, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]):
        with pytest.raises(DomainError, match="inertia"):
            heavy.principal_axes(wrong)


def test_the_centre_may_be_given_for_the_gradient() -> None:
    assert heavy.gravity_gradient(gravity=9.80665, distance=6.371e6) == pytest.approx(3 * 9.80665 / 6.371e6, rel=1e-15)
    with pytest.raises(DomainError, match="distance"):
        heavy.gravity_gradient(gravity=9.8, distance=[1.0, 0.0])
    near = gyrostat.solve(SCENE, centre_distance=100.0, angular_velocity=[0, 0, 1])
    same = gyrostat.solve(SCENE, gravity_gradient=3 * 9.80665 / 100, angular_velocity=[0, 0, 1])
    assert max(distance(near.columns, same.columns).values()) < 1e-12


def test_forms_of_an_answer(answer: Answer, tmp_path: Path) -> None:
    read = json.loads(answer.to_json())
    assert all(read["columns"][name] == values.tolist() for name, values in answer.columns.items())
    assert gyrostat.solve(read["scene"]).columns["down"].tolist() == read["columns"]["down"]
    assert "down_x" in answer.to_csv().splitlines()[0]
    periodic = gyrostat.solve(ORBIT)
    xarray = pytest.importorskip("xarray")
    periodic.to_netcdf(tmp_path / "answer.nc")
    with xarray.open_dataset(tmp_path / "answer.nc", engine="scipy") as dataset:
        assert dataset.attrs["period"] == periodic.scalars["period"] and dataset.attrs["stable"] == 1


@pytest.mark.parametrize("name", SCENES)
def test_bundled_scenes_are_met_and_drawn(name: str, tmp_path: Path) -> None:
    made = gyrostat.solve(name)
    assert made.met
    pytest.importorskip("matplotlib")
    figure = drawn(made, tmp_path / "answer.png", name == "slow-pendulum")
    assert "theta [deg]" in [axes.get_ylabel() for axes in figure.axes]


def test_there_are_scenes_enough() -> None:
    assert len(SCENES) >= 6


@pytest.mark.parametrize("start", [{"angular_velocity": [0, 0, 0], "down": [0, 0, 1]}, {"angular_velocity": [0, 0, 2], "down": [0, 0, -1]}])
def test_a_figure_of_what_hardly_moves(start: dict[str, Any], tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    made = gyrostat.solve(SCENE, inertia=TOP["inertia"], mass=0.5, centre_of_mass=[0, 0, 0], gravity_gradient=0.0, **start)
    assert made.met
    made.plot(tmp_path / "answer.png")


def test_the_report(heavy_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(heavy_file), "--set", "tolerance=1e-3"]) == 0
    assert "precession_rate" in capsys.readouterr().out
    assert main(["solve", str(heavy_file), "--set", "integrator=radau"]) == 2
    assert "no such integrator" in capsys.readouterr().err
    assert main(["solve", str(heavy_file), "--set", "model=exact"]) == 2
    assert "exact" in capsys.readouterr().err


# ---- functions over arrays ----


@pytest.mark.parametrize("method", ["taylor", "dop853", *(["cvode-adams", "cvode-bdf"] if HAS_CVODE else [])])
@pytest.mark.parametrize("turning", [False, True])
def test_integrators_agree(method: str, turning: bool, answer: Answer) -> None:
    start: dict[str, Any] = {"attitude": ATTITUDE} if turning else {"down": answer["down"][0]}
    made = heavy.integrate(**BODY, **start, angular_velocity=SCENE["initial"]["angular_velocity"], times=answer.t, method=method, tolerance=1e-11)
    assert made["status"] == "reached" and ("attitude" in made) == turning and made["rhs"] > 0 and made["seconds"] > 0
    assert max(distance(made, answer.columns).values()) < 1e-6


def test_long_double_and_order(answer: Answer) -> None:
    given = {**BODY, "attitude": ATTITUDE, "angular_velocity": SCENE["initial"]["angular_velocity"], "times": answer.t}
    want = heavy.integrate(**given, order=30, precision="long double", tolerance=1e-18)
    assert max(distance(answer.columns, want).values()) < 1e-11
    assert max(distance(heavy.integrate(**given, order=20, tolerance=1e-12), want).values()) < 1e-8
    for wrong in ({"order": 12}, {"method": "euler"}, {"precision": "half"}, {"precision": "long double", "order": 20}, {"tolerance": 0.0},
                  {"down": [0, 0, 1]}, {"attitude": [0, 0, 0, 2]}, {"times": [1.0, 0.5]}, {"attitude": None}):
        with pytest.raises(DomainError):
            heavy.integrate(**{**given, **wrong})


def test_the_series_converges_on_the_orbit() -> None:
    orbit = heavy.periodic_orbit(**BODY, spin=150.0, cos_inclination=0.1)
    t = np.linspace(0.0, 3 * float(orbit.period), 40)
    want = heavy.integrate(**BODY, angular_velocity=orbit.angular_velocity, down=orbit.down / np.linalg.norm(orbit.down), times=t, tolerance=1e-15)
    errors = []
    for order in (2, 4, 6, 8):
        made = heavy.series(**BODY, spin=150.0, cos_inclination=0.1, t=t, order=order)
        off = distance({"angular_velocity": made.angular_velocity, "down": made.down}, want)
        assert off["down"] <= made.error["down"] and off["angular_velocity"] * 150 <= made.error["angular_velocity"] * 1.001
        assert abs(made.period - orbit.period) <= made.period_error + orbit.period_error
        errors.append(max(off.values()))
    assert all(b < 0.05 * a for a, b in zip(errors, errors[1:], strict=False))
    best = heavy.series(**BODY, spin=150.0, cos_inclination=0.1, t=t)
    assert best.order <= 30 and max(distance({"down": best.down}, want).values()) < 1e-11
    many = heavy.series(**BODY, spin=[[150.0], [-300.0]], cos_inclination=[0.1, -0.3, 0.6], t=t, order=8)
    assert many.down.shape == (2, 3, 40, 3) and many.attitude.shape == (2, 3, 40, 4) and many.period.shape == (2, 3)
    assert np.array_equal(many.down[0, 0], heavy.series(**BODY, spin=150.0, cos_inclination=0.1, t=t, order=8).down)
    R = rotation.matrix_from_quaternion(many.attitude)
    assert np.max(np.abs(R[..., 2, :] + many.down)) < 1e-13
    for wrong, error in (({"order": 3}, DomainError), ({"order": 0}, DomainError), ({"spin": 0.0}, DomainError), ({"cos_inclination": 1.0}, DomainError),
                         ({"spin": 1.0}, ConvergenceError)):
        with pytest.raises(error):
            heavy.series(**{**BODY, "spin": 150.0, "cos_inclination": 0.1, "t": t, **wrong})


def test_many_periodic_motions_and_their_family() -> None:
    spins = np.array([150.0, 60.0, 30.0, 21.0])
    many = heavy.periodic_orbit(**BODY, spin=spins, cos_inclination=0.1)
    assert many.period.shape == (4,) and np.all(many.closure < 1e-9) and np.all(many.verdict != "none") and np.all(many.why == "")
    assert np.allclose(many.multipliers.sum(axis=-1), many.trace) and np.allclose(many.multipliers.prod(axis=-1), 1)
    fast = heavy.fast_stability(**BODY, spin=spins, cos_inclination=0.1)
    off = np.abs(fast.trace - many.trace)
    assert off[0] < 1e-2 and off[0] < 0.1 * off[-1]
    family = heavy.periodic_family(**BODY, first_spin=60.0, last_spin=21.0, cos_inclination=0.1)
    assert family.end == "spin-reached" and family.members.angular_velocity[0, 2] == pytest.approx(60.0)
    assert family.members.period[-1] == pytest.approx(many.period[-1], rel=1e-10)
    none = heavy.periodic_orbit(**BODY, spin=[150.0, 0.5], cos_inclination=0.1)
    assert none.verdict.tolist()[1] == "none" and np.isnan(none.period[1]) and none.why[1] and not none.why[0]
    with pytest.raises(DomainError):
        heavy.periodic_family(**BODY, first_spin=20.0, last_spin=60.0, cos_inclination=0.1)
    with pytest.raises(DomainError, match="leading axes"):
        heavy.periodic_family(**{**BODY, "mass": [0.8, 0.8]}, first_spin=60.0, cos_inclination=0.1)


def test_series_whose_terms_do_not_fall_state_no_error() -> None:
    # nearly symmetric about axis 2: at ten times c the terms left out are as great as the rest
    body: dict[str, Any] = {"inertia": [0.988, 0.372, 1.0], "mass": 1.0, "centre_of_mass": [0.1, 0.0, 0.0], "gravity": 9.81}
    made = heavy.series(**body, spin=np.array([10.0, 20.0]) * math.sqrt(0.981), cos_inclination=0.08, t=[0.0], order=4)
    for errors in (*made.error.values(), made.period_error, made.precession_error):
        assert np.isinf(errors[0]) and 0 < errors[1] < 0.1


def test_exact_motions_of_many() -> None:
    t = np.linspace(0.0, 2.0, 30)
    start: dict[str, Any] = {"angular_velocity": [[1.0, 2.0, 150.0], [0.0, 0.0, 0.3]], "down": [[0.6, 0.0, 0.8], [1.0, 0.0, 0.0]]}
    given = {"inertia": [TOP["inertia"], BODY["inertia"]], "mass": [0.5, 0.8], "centre_of_mass": [TOP["centre_of_mass"], [0.018, 0.0, 0.0]],
             "gravity": 9.80665}
    made = heavy.exact(**given, **start, t=t)
    assert made.case.tolist() == ["lagrange", "pendulum"]
    for i in range(2):
        one = {name: np.asarray(value)[i] if np.ndim(value) > 0 else value for name, value in {**given, **start}.items()}
        want = heavy.integrate(**one, times=t, tolerance=1e-15)
        assert np.max(np.abs(made.down[i] - want["down"])) < 1e-10
    R = rotation.matrix_from_quaternion(made.attitude)
    assert np.max(np.abs(R[..., 2, :] + made.down)) < 1e-13
    nothing = heavy.exact(**BODY, angular_velocity=[0, 0, 1], attitude=ATTITUDE, t=t)
    assert str(nothing.case) == "none" and np.all(np.isnan(nothing.down))
    spun = heavy.exact(**TOP, angular_velocity=[0, 0, 10], attitude=ATTITUDE, t=t)
    assert np.allclose(spun.attitude[0], ATTITUDE) and np.max(spun.error["down"]) < 1e-10
    for wrong in ({}, {"down": [0, 0, 1], "attitude": ATTITUDE}, {"down": [0, 0, 0]}):
        with pytest.raises(DomainError):
            heavy.exact(**TOP, angular_velocity=[0, 0, 1], t=t, **wrong)


def test_a_period_that_is_not_resolved_is_not_told() -> None:
    # nearly upright, and so beside the motion that takes for ever to get there; a gradient so small moves the period by far less than any of this
    angle = np.array([0.5, 1e-2, 1e-4])
    down = np.stack([np.sin(angle), 0 * angle, -np.cos(angle)], axis=-1)
    top = {"inertia": [1.0, 1.0, 1.01], "mass": 1.0, "centre_of_mass": [0.0, 0.0, 1e-3], "gravity": 9.81, "angular_velocity": [1e-7, 2e-7, 1e-6]}
    plain, pulled = (heavy.exact(**top, down=down, t=[0.0, 1.0], gravity_gradient=gradient) for gradient in (0.0, 1e-10))
    assert np.isnan(pulled.period).tolist() == np.isnan(pulled.precession_rate).tolist() == [False, True, True]
    assert pulled.period[0] == pytest.approx(plain.period[0], rel=1e-9)
    assert pulled.precession_rate[0] == pytest.approx(plain.precession_rate[0], rel=1e-9)


def test_down_of_an_attitude_is_known_to_rounding() -> None:
    # by its attitude this pendulum is 8.6e-17 off its unstable plane, which no double of down shows: after 8 s down is off by 7e-4
    parts = ("0x1.1fc80acf33ca8p-1", "0x1.b755d07b09ac2p-2", "0x1.d276a378efe7bp-2", "0x1.14e706f25f1cep-1")
    swing: dict[str, Any] = {"inertia": [0.0445, 0.3258, 0.2960], "mass": 3.258, "centre_of_mass": [-0.2954, 0.0, 0.0], "gravity": 9.81,
                             "angular_velocity": [0.0, 0.0, 0.9888]}
    leaving = heavy.exact(**swing, attitude=[float.fromhex(part) for part in parts], t=[1.0, 8.0])
    assert str(leaving.case) == "pendulum" and leaving.error["down"] > 7e-4
    assert heavy.exact(**swing, down=[0.6, 0.8, 0.0], t=[1.0, 8.0]).error["down"] < 1e-12
    # zeros of an attitude put it in the plane, too
    about_1: dict[str, Any] = {**swing, "inertia": [0.2960, 0.3258, 0.0445], "centre_of_mass": [0.0, 0.0, -0.2954], "angular_velocity": [0.9888, 0.0, 0.0]}
    assert heavy.exact(**about_1, attitude=[0.6, 0.0, 0.0, 0.8], t=[1.0, 8.0]).error["down"] < 1e-12
    nodding: dict[str, Any] = {"angular_velocity": [0.1, 1.0, 10.0], "attitude": ATTITUDE}
    top = heavy.exact(**TOP, **nodding, t=[-3.0, 0.5, 2.0])
    assert 0 < top.error["down"] < 1e-11
    with pytest.raises(DomainError, match="vanishes"):
        heavy.exact(**TOP, **{**nodding, "attitude": [0.0, 0.0, 0.0, 0.0]}, t=[1.0])


def test_sleeping_tops() -> None:
    threshold = math.sqrt(4 * 0.002 * 0.5 * 9.80665 * 0.04) / 0.001
    made = heavy.sleeping_top(**TOP, spin=threshold * np.array([0.98, 1.02, -2.0]))
    assert made.threshold == pytest.approx(np.full(3, threshold), rel=1e-14) and made.verdict.tolist() == ["unstable", "stable", "stable"]
    assert made.amplification[1] == pytest.approx(1 / math.sqrt(1 - 1.02**-2)) and np.isinf(made.amplification[0])
    hanging = heavy.sleeping_top(**TOP, spin=0.0, axis_down=True)
    assert hanging.threshold == 0 and str(hanging.verdict) == "stable"
    with pytest.raises(DomainError, match="axis of symmetry"):
        heavy.sleeping_top(**BODY, spin=1.0)
    with pytest.raises(DomainError, match="row 1"):
        heavy.sleeping_top(**{**TOP, "centre_of_mass": [[0, 0, 0.04], [0.01, 0, 0.02]]}, spin=1.0)


def test_regular_precession_is_a_motion() -> None:
    rates = heavy.regular_precession(**TOP, spin=100.0, cos_inclination=-0.8)
    for rate in (float(rates.slow), float(rates.fast)):
        d = np.array([0.6, 0.0, -0.8])
        w = rate * d + np.array([0.0, 0.0, 100.0 + 0.8 * rate])
        made = heavy.integrate(**TOP, angular_velocity=w, down=d, times=[0.37], tolerance=1e-15)
        assert made["down"][0, 2] == pytest.approx(-0.8, abs=1e-10)
    assert np.isnan(heavy.regular_precession(**TOP, spin=1.0, cos_inclination=-0.8).slow)
    assert np.isinf(heavy.regular_precession(**TOP, spin=1.0, cos_inclination=0.0).fast)


def test_hanging_bodies() -> None:
    made = heavy.hanging(**BODY)
    assert np.linalg.norm(made.down) == pytest.approx(1) and made.frequency[0] < made.frequency[1]
    assert np.allclose(made.down, np.array(BODY["centre_of_mass"]) / np.linalg.norm(BODY["centre_of_mass"]), atol=1e-4)
    small = 1e-6
    for frequency, swing in zip(made.frequency, made.swing, strict=True):
        period = 2 * math.pi / float(frequency)
        start = made.down + small * swing
        back = heavy.integrate(**BODY, angular_velocity=[0, 0, 0], down=start / np.linalg.norm(start), times=[period / 2, period], tolerance=1e-15)
        assert np.allclose(back["down"] - made.down, small * np.array([-swing, swing]), atol=1e-3 * small)
    with pytest.raises(DomainError, match="no torque"):
        heavy.hanging(**{**BODY, "gravity": 0.0, "gravity_gradient": 0.0})


def test_what_is_refused() -> None:
    good = {**BODY, "angular_velocity": [0, 0, 1], "down": [0, 0, 1], "times": [1.0]}
    assert heavy.solve(**good).met
    for wrong in ({"mass": -1.0}, {"mass": math.nan}, {"centre_of_mass": [1.0, 0, 0]}, {"inertia": [1.0, 1.0, 3.0]}, {"inertia": [[1, 0], [0, 1]]},
                  {"gravity": -1.0}, {"down": [0, 0, 2]}, {"down": None}, {"attitude": [0, 0, 0, 1]}, {"periodic": {"spin": 1.0, "cos_inclination": 0.0}},
                  {"model": "linear"}, {"integrator": "radau"}, {"tolerance": 2.0}, {"times": []}, {"angular_velocity": [0, 0, math.inf]}):
        with pytest.raises(DomainError):
            heavy.solve(**{**good, **wrong})
    with pytest.raises(DomainError, match="row 1: inertia"):
        heavy.hanging(**{**BODY, "mass": [0.8, 80.0]})
    with pytest.raises(DomainError, match="broadcast"):
        heavy.series(**{**BODY, "mass": [1.0, 1.0]}, spin=[1.0, 2.0, 3.0], cos_inclination=0.0, t=[0.0])


def test_arguments_of_a_scene() -> None:
    given = heavy.arguments(scene_from(SCENE))
    assert given["attitude"] is None and given["periodic"] is None and given["gravity_gradient"] == 4.6e-6
    assert heavy.arguments(scene_from(ORBIT))["periodic"] == {"spin": 150.0, "cos_inclination": 0.1}
    assert heavy.arguments(scene_from(SCENE, centre_distance=3e6))["gravity_gradient"] == pytest.approx(9.80665e-6)
