# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of functions that are none, or that no body has: each is refused by its name, and nothing is computed from it."""

import math
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import DomainError, broadcast, deceleration, design, elliptic, free, general, heavy, rotation, rotor, spinning, sweep, vary
from gyrostat.asking import knows_attitude
from gyrostat.cli import main
from gyrostat.scenes import load

FREE: dict[str, Any] = {"inertia": [1.0, 2.0, 2.5], "angular_velocity": [0.01, 1.0, 0.01], "times": [0.0, 1.0]}
WHEEL: dict[str, Any] = {"axis": [0.0, 0.0, 1.0], "axial_inertia": 0.1, "rate": 5.0}
VIEW: dict[str, Any] = {"axis": [0.0, 0.0, 1.0], "direction": [0.0, 0.0, 1.0], "half_angle": 0.4}
TOP: dict[str, Any] = {"inertia": [1.0, 1.0, 0.5], "mass": 1.0, "centre_of_mass": [0.0, 0.0, 0.3], "gravity": 9.81}
SPINNER: dict[str, Any] = {"inertia": [8.0, 7.0, 11.0], "torque": [0.1, 0.0, 0.0]}
PUSH: dict[str, Any] = {"type": "constant", "torque": [0.1, 0.0, 0.0]}
LEO: dict[str, Any] = {"radius": 7e6}


@pytest.fixture(autouse=True)
def _nothing_leaks() -> Any:
    """No warning of NumPy reaches the caller."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


# ---- what is no number ----


def test_masked_elements_are_no_numbers() -> None:
    masked = np.ma.masked_array([0.0, 1.0, 2.0], [False, False, True])
    with pytest.raises(DomainError, match="times: elements are masked"):
        free.solve(**{**FREE, "times": masked})
    assert list(free.solve(**{**FREE, "times": np.ma.masked_array([0.0, 1.0], False)}).t) == [0.0, 1.0]


@pytest.mark.parametrize("value", [1j, [1 + 5j], np.array([1 + 0j]), None, [None, 1.0], "a", ["1", "2"], np.datetime64("2020-01-01"), [[1.0], [1.0, 2.0]], 10**400, [object()]])
def test_what_is_no_array_of_numbers_is_refused(value: Any) -> None:
    with pytest.raises(DomainError, match="x = .*: not an array of numbers"):
        broadcast.array("x", value)


def test_what_is_an_array_of_numbers_is_taken() -> None:
    given = np.array([1.0, 2.0])
    assert broadcast.array("x", given) is given
    for value in ([1, 2], (1.0, 2), np.array([1, 2], dtype=np.int8), np.array([1, 2], dtype=np.float32), np.array([1.0, 0.0, 2.0, 0.0])[::2], [np.float64(1), 2]):
        assert broadcast.array("x", value).tolist() == [1.0, 2.0]
    assert broadcast.number("x", np.int64(3)) == 3.0 and broadcast.whole("x", 3.0) == 3
    with pytest.raises(DomainError, match="x: one number is wanted"):
        broadcast.number("x", [1.0])
    for part in (2.5, math.nan, math.inf):
        with pytest.raises(DomainError, match="give a whole number"):
            broadcast.whole("x", part)


REFUSED: list[tuple[str, Callable[[], Any], str]] = [
    ("complex", lambda: heavy.gravity_gradient(gravity=[1 + 5j], distance=1.0), "gravity = "),
    ("text", lambda: heavy.principal_axes("abc"), "inertia = abc"),
    ("text of k2", lambda: elliptic.complete("a"), "k2 = a"),
    ("text of t", lambda: heavy.series(**TOP, spin=100.0, cos_inclination=0.3, t=["a"]), "t = "),
    ("moments", lambda: rotor.steady_rotations(inertia=[1, "a", 2], axis=[0, 0, 1], axial_inertia=0.1, slope=0.1, no_load_rate=1, momentum=1), "inertia = "),
    ("end", lambda: free.flips(inertia=[1, 2, 2.5], angular_velocity=[0.01, 1, 0.01], axis=[0, 1, 0], begin=0, end="a"), "end = a"),
    ("order of terms", lambda: heavy.series(**TOP, spin=200.0, cos_inclination=0.3, t=[0.0], order=3), "order = 3: give an even number from 2 to 30"),
    ("tolerance", lambda: heavy.series(**TOP, spin=200.0, cos_inclination=0.3, t=[0.0], tolerance=math.nan), "tolerance = nan"),
    ("order of a method", lambda: deceleration.integrate(inertia=[3, 4, 5], control=[0.01] * 3, drag=0, angular_momentum=[1, 2, 1], times=[1.0], order=20.7), "order = 20.7"),
    ("members", lambda: heavy.periodic_family(**TOP, first_spin=20.0, cos_inclination=0.3, most_members=2.5), "most_members = 2.5"),
    ("members beyond", lambda: heavy.periodic_family(**TOP, first_spin=20.0, cos_inclination=0.3, most_members=math.inf), "most_members = inf"),
    ("periodic", lambda: heavy.solve(**TOP, times=[1.0], periodic={"spin": 1.0}), "periodic = "),
    ("sense", lambda: design.spin_for_pointing(**SPINNER, budget=0.1, sense=math.nan), "sense, row 0"),
    ("samples", lambda: spinning.linear_grid(**SPINNER, force=[0, 0, 0], angular_velocity=[0, 0, 1], step=0.1, samples=math.nan), "samples = nan"),
    ("step", lambda: spinning.linear_grid(**SPINNER, force=[0, 0, 0], angular_velocity=[0, 0, 1], step=[0.1, 0.2], samples=3), "step: one number"),
    ("step of text", lambda: spinning.linear_grid(**SPINNER, force=[0, 0, 0], angular_velocity=[0, 0, 1], step="a", samples=3), "step = a"),
    ("charge overflow", lambda: spinning.charge_momentum(charge=1e308, flux_density=1e9, arm=1.0, angle=0.0), "greatest double"),
    ("gradient overflow", lambda: heavy.gravity_gradient(gravity=9.8, distance=1e-308), "greatest double"),
    ("charge", lambda: spinning.charge_momentum(charge=1.0, flux_density=1.0, arm=1.0, angle=math.inf), "angle, row 0"),
    ("gravity", lambda: heavy.gravity_gradient(gravity=math.nan, distance=1.0), "gravity, row 0"),
    ("rotor far out", lambda: rotor.assembled_inertia(carrier_inertia=[1, 1, 1], carrier_mass=1, rotor_mass=1, axis=[0, 0, 1], axial_inertia=0.1,
                                                      equatorial_inertia=0.1, offset=[1e200, 0, 0]), "larger than a double"),
    ("rotation vector", lambda: rotation.quaternion_from_vector([math.inf, 0, 0]), "vector, row 0"),
    ("long vector", lambda: rotation.matrix_from_vector([1e155, 0, 0]), "vector, row 0"),
    ("quaternion", lambda: rotation.matrix_from_quaternion([math.inf, 0, 0, 1]), "quaternion, row 0"),
    ("no quaternion", lambda: rotation.angle_between([0, 0, 0, 0], [0, 0, 0, 1]), "first, row 0"),
    ("matrix", lambda: rotation.quaternion_from_matrix(np.full((3, 3), np.inf)), "matrix, row 0"),
    ("large matrix", lambda: rotation.quaternion_from_matrix(np.eye(3) * 1e200), "matrix, row 0"),
]


@pytest.mark.parametrize(("call", "why"), [case[1:] for case in REFUSED], ids=[case[0] for case in REFUSED])
def test_a_wrong_argument_is_named(call: Callable[[], Any], why: str) -> None:
    with pytest.raises(DomainError) as caught:
        call()
    assert why in str(caught.value)


# ---- sizes ----


def test_very_large_and_small_numbers_are_those_of_their_size() -> None:
    assert rotation.matrix_from_quaternion([1e200, 0, 0, 1e200]) == pytest.approx(rotation.matrix_from_quaternion([1.0, 0, 0, 1.0]), abs=1e-15)
    assert rotation.matrix_from_quaternion([1e-200, 0, 0, 1e-200]) == pytest.approx(rotation.matrix_from_quaternion([1.0, 0, 0, 1.0]), abs=1e-15)
    assert rotation.angle_between([0, 0, 0, 1e200], [0, 0, 0, -1.0]) == 0
    assert heavy.regular_precession(**TOP, spin=1e200, cos_inclination=0.3).fast == pytest.approx(0.5e200 / 0.3, rel=1e-14)
    tiny = heavy.hanging(inertia=[1e-200, 1e-200, 0.5e-200], mass=1e-200, centre_of_mass=[0, 0, 0.3], gravity=9.81)
    assert tiny.frequency == pytest.approx(heavy.hanging(**TOP).frequency, rel=1e-14)
    many = rotor.steady_rotations(inertia=[3.0, 4.0, 5.0], axis=[0, 0, 1], axial_inertia=0.1, slope=0.1, no_load_rate=1, momentum=1e200)
    assert not np.any(np.isnan(many.eigenvalues.real[: many.count]) & np.isinf(many.eigenvalues.imag[: many.count]))


def test_jacobi_of_an_argument_without_digits_is_that_of_one_nearby() -> None:
    for k2 in (1e-9, 0.3, 0.9, 1 - 1e-9):
        f = elliptic.jacobi([1e17, 1e18, 1e20, 1e25, 1e300], k2)
        assert np.all(np.abs(f.sn) <= 1) and np.all(np.abs(f.cn) <= 1) and np.allclose(f.sn**2 + f.cn**2, 1)
        assert np.all(np.abs(elliptic.zeta([1e17, 1e20, 1e300], k2)) <= 1)


def test_a_motion_of_which_no_clock_tells_the_turns_has_no_error(tmp_path: Path) -> None:
    for inertia in ([1.0, 2.0, 2.5], [1.0, 1.0, 2.0]):
        for time in (1e16, 1e20, 1e30, 1e35, 1e300):
            for rate in (1e1, 1e3, 1e5):
                answer = free.solve(inertia=inertia, angular_velocity=[0.1 * rate, 0.2 * rate, 0.3 * rate], times=[time], ask=["attitude", "angular_velocity"], model="closed-form")
                assert not answer.met and answer.error["attitude"] == math.inf
    for rate in (1e19, 1e24, 1e29):
        answer = free.solve(inertia=[1.0, 2.0, 2.5], angular_velocity=[0.1 * rate, 0.2 * rate, 0.3 * rate], times=[10.0], ask=["attitude"], model="closed-form")
        assert not answer.met and answer.error["attitude"] == math.inf
    # and one that turns steadily has its direction however late
    still = free.solve(inertia=[1.0, 2.0, 2.5], angular_velocity=[0.0, 0.0, 1.0], times=[1e30], ask=["angular_velocity"])
    assert still["angular_velocity"][0].tolist() == [0.0, 0.0, 1.0]


# ---- what there is none of ----


def test_tops_and_spins_without_what_is_asked() -> None:
    assert heavy.sleeping_top(**TOP, spin=[0.0, 1e-10, 5.0], axis_down=True).amplification.tolist() == [1.0, 1.0, 1.0]
    level = heavy.regular_precession(**TOP, spin=0.0, cos_inclination=0.0)
    assert math.isnan(level.slow) and math.isnan(level.fast)
    unstable: dict[str, Any] = {"inertia": [1.0, 2.0, 1.5], "torque": [0.1, 0.0, 0.0]}
    spin = {"angular_velocity": [0.0, 0.0, 2.0]}
    made = spinning.pointing(**unstable, **spin)
    assert made.unstable and made.error == math.inf and np.isnan(made.mean_tilt) and np.all(np.isnan(made.secular_velocity_ratio))
    assert spinning.pointing_error(**unstable, spin_rate=2.0) == math.inf
    assert np.all(np.isnan(spinning.secular_velocity_ratio(**unstable, **spin, force=[0.0, 0.0, 1.0])))


def test_flips_are_told_until_the_end_or_not_at_all() -> None:
    given: dict[str, Any] = {"inertia": [1.0, 2.0, 2.5], "angular_velocity": [0.01, 1.0, 0.01], "axis": [0.0, 1.0, 0.0]}
    assert len(free.flips(**given, begin=0.0, end=1e3)) == 34
    with pytest.raises(DomainError, match="more than a million"):
        free.flips(**given, begin=0.0, end=1e9)
    with pytest.raises(DomainError, match="the end not before the begin"):
        free.flips(**given, begin=2.0, end=1.0)


# ---- records ----


@pytest.mark.parametrize("change", [{"axis": [0, 0, 2]}, {"axis": [0, 0, 0]}, {"direction": [0, 1, 1]}, {"half_angle": 4.0}, {"half_angle": -0.4}, {"half_angle": math.nan}, {"angle": 1.0}])
def test_a_view_that_none_has_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(DomainError):
        free.solve(**FREE, view=VIEW | change, ask=["view_fraction"])
    for view in ({}, 3):
        with pytest.raises(DomainError, match="view"):
            free.solve(**FREE, view=view)
    rows = sweep("toutatis", {"view.axis[2]": [0.0, 1.0]}, times=[0.0, 10.0], threads=1)
    assert rows.reason.values[0] and not rows.reason.values[1]


@pytest.mark.parametrize("wheel", [
    {"rate": list(range(1000000))}, {"rate": [1, 2]}, {"axis": [1, 0, 0, 0, 1, 0]}, {"axis": [0, 1]}, {"axial_inertia": None}, {"typ": "free"}, {"type": "locked"}, {"rate": "a"}])
def test_a_wheel_of_another_shape_is_refused(wheel: dict[str, Any]) -> None:
    with pytest.raises(DomainError, match=r"wheel\[0\]|type"):
        free.solve(**FREE, wheels=[WHEEL | wheel])
    with pytest.raises(DomainError, match="wheels"):
        free.solve(**FREE, wheels=None)  # type: ignore[arg-type]


TORQUES: list[tuple[Any, str]] = [
    ({"type": "table", "times": [0, 1], "values": [[1, 1], [0, 0], [0, 0]]}, "values"),
    ({"type": "table", "times": [[0, 1]], "values": [[1, 1, 1], [0, 0, 0]]}, "times"),
    ({"type": "table", "times": [0, 1]}, r"torque\[0\] has no values"),
    (PUSH | {"on": [0.1, 0.2, 0.5]}, "on"), (PUSH | {"on": 5}, "on"), (PUSH | {"on": [[0.1], [0.5]]}, "on"),
    ({"type": "damping", "coeficient": 5}, "did you mean coefficient"), (PUSH | {"factor": {"amplitud": 1.0, "rate": 1.0}}, "did you mean amplitude"),
    ({"type": "constant"}, r"torque\[0\] has no torque"), ({}, r"torque\[0\] has no type"), ({"type": "pull"}, "there is no type 'pull'"), (5, r"torque\[0\] = 5"),
    ({"type": "brake", "limit": [1, 1, 1], "law": "x"}, "law = 'x'"), (PUSH | {"torque": ["a", 0, 0]}, "not an array of numbers"), (PUSH | {"torque": 0.1}, "torque = 0.1: give three numbers"),
    (PUSH | {"factor": {"mean": 0.5}}, "neither a wave nor a table"), (PUSH | {"factor": {"amplitude": 0.5, "phase": 1.0}}, "neither a wave nor a table"),
    ({"type": "damping"}, "no matrix or coefficient"), ({"type": "damping", "coefficient": 1.0, "matrix": np.eye(3)}, "both given"),
]


@pytest.mark.parametrize(("torque", "why"), TORQUES)
def test_a_torque_of_another_form_is_refused(torque: Any, why: str) -> None:
    with pytest.raises(DomainError, match=why):
        general.solve(**FREE, torques=[torque])


@pytest.mark.parametrize(("wheel", "why"), [
    (WHEEL | {"tpye": "free"}, "did you mean type"), ({}, r"wheel\[0\] has no axis"), (5, r"wheel\[0\] = 5"), (WHEEL | {"type": "x"}, "there is no type 'x'"),
    (WHEEL | {"axis": [0, 1]}, "shape"), (WHEEL | {"axial_inertia": "a"}, "not an? "), (WHEEL | {"rate": {"times": [0, 1]}}, "no values"), (WHEEL | {"momentum": 1.0}, "rate and momentum are both given"), (WHEEL | {"mass": 1.0}, "leave it out"),
    (WHEEL | {"type": "motor", "no_load_rate": 1.0}, "no slope or stall_torque"), ({"type": "torque", "axis": [0, 0, 1], "axial_inertia": 0.01}, r"wheel\[0\] has no torque"),
    (WHEEL | {"type": "motor", "no_load_rate": 1.0, "slope": 1.0, "stall_torque": 1.0}, "both given")])
def test_a_wheel_of_another_form_is_refused(wheel: Any, why: str) -> None:
    with pytest.raises(DomainError, match=why):
        general.solve(**FREE, wheels=[wheel])


@pytest.mark.parametrize(("orbit", "why"), [
    ({}, "give its radius"), ({"period": 0.0}, "orbit.period = 0"), ({"planet": "pluto", "altitude": 5e5}, "orbit.planet"), (LEO | {"radius": -7e6}, "orbit.radius"),
    ({"rate": 0.0}, "orbit.rate"), (LEO | {"eccentricity": 1.1}, "orbit.eccentricity"), (LEO | {"eccentricity": -0.1}, "orbit.eccentricity"),
    (LEO | {"altitude": 5e5}, "give one of them"), (LEO | {"mu": math.inf}, "orbit.mu"), (LEO | {"radius": "a"}, "orbit.radius = a"), (3, "orbit = 3")])
def test_an_orbit_that_is_none_is_refused(orbit: Any, why: str) -> None:
    with pytest.raises(DomainError, match=why):
        general.orbit_start(orbit)
    with pytest.raises(DomainError, match=why):
        general.solve(**FREE, orbit=orbit)


@pytest.mark.parametrize(("torque", "given", "why"), [
    ({"type": "weight"}, {"fixed": True, "field": {"gravity": 9.8}}, "mass: it is missing"),
    ({"type": "weight"}, {"fixed": True, "mass": 2.0}, "field.gravity: it is missing"),
    ({"type": "thrust", "force": [0, 0, 1.0], "point": [0.1, 0, 0]}, {}, "mass: it is missing")])
def test_a_force_without_what_it_needs_is_refused(torque: Any, given: dict[str, Any], why: str) -> None:
    with pytest.raises(DomainError, match=why):
        general.solve(**FREE | given, torques=[torque])


def test_a_deceleration_starts_in_one_way() -> None:
    given: dict[str, Any] = {"inertia": [3.0, 2.0, 1.0], "control": [0.1] * 3, "drag": 0.0, "times": [0.0, 1.0]}
    assert deceleration.solve(**given, angular_momentum=[3.0, 2.0, 1.0], angular_velocity=[1.0, 1.0, 1.0]).met
    with pytest.raises(DomainError, match="give one of the two"):
        deceleration.solve(**given, angular_momentum=[1.0, 2.0, 3.0], angular_velocity=[9.0, 9.0, 9.0])


def test_other_records_of_general_scenes_are_refused() -> None:
    for given, why in (({"torque": 3}, "there is no function at this address"), ({"start_error": {"x": 1.0}}, "start_error: there is no key x"), ({"start_error": 3}, "start_error = 3"),
                       ({"start_error": {"attitude": "a"}}, "attitude = a"), ({"start_time": "a"}, "start_time"), ({"start_time": 2e5}, "is before start_time"), ({"start_time": math.nan}, "start_time"),
                       ({"wheels": 1j}, "wheels"), ({"torques": {}}, "torques"), ({"euler": {}}, "euler"), ({"fixed": "no"}, "fixed"), ({"field": np.ones((2, 0, 3))}, "field"),
                       ({"field": {"uniform": [0, 0, 1e-5], "dipole": {}}}, "both given"), ({"orbit": {"radius": 7e6, "rate": 1e-3, "mu": 4e14}}, "say the same"), ({"inertia": [1, 2]}, "inertia has the shape"),
                       ({"field": {"rotating": 3}}, "field.rotating = 3"), ({"field": {"magnetc": 3}}, "there is no key magnetc")):
        with pytest.raises(DomainError, match=why):
            general.solve(**FREE | given)
    with pytest.raises(DomainError, match="give the keys of"):
        general.orbit_start(None)  # type: ignore[arg-type]
    for late in (math.nan, 1e300):
        with pytest.raises(DomainError, match="size at most"):
            general.orbit_start(LEO, late)


# ---- studies ----


@pytest.mark.parametrize(("study", "why"), [
    (lambda: vary.grid([]), "at least one value"), (lambda: vary.linspace(1, 2, 2.5), "no whole number"),  # type: ignore[arg-type]
    (lambda: vary.uniform(None, 2), "None is neither a number"), (lambda: vary.grid([True, False]), "True is neither a number"),  # type: ignore[arg-type]
    (lambda: vary.read_words("[1e-4,,2e-4]"), "does not say how"), (lambda: sweep("tiangong-1", {"torque.drag": [True, False]}), "neither a number"),
    (lambda: sweep("tiangong-1", [1]), "vary = "), (lambda: sweep("tiangong-1", {3: [1.0]}), "vary = "),  # type: ignore[arg-type,dict-item]
    (lambda: sweep("tiangong-1", {"torque.drag": [1e-4]}, n=True), "n = True"), (lambda: sweep("tiangong-1", {"torque.drag": [1e-4]}, threads=1.5), "threads = 1.5"),  # type: ignore[arg-type]
    (lambda: sweep("tiangong-1", {"torque.drag": [1e-4]}, shard=(1,)), "shard = "), (lambda: sweep("tiangong-1", {"torque.drag": [1e-4]}, shard=(1.0, 1)), "shard = "),  # type: ignore[arg-type]
    (lambda: sweep("tiangong-1", {"torque.drag": [1e-4]}, shard="x"), "shard = x"), (lambda: sweep("tiangong-1", {"torque.drag": "0:inf:3"}), "two ends"),
    (lambda: sweep("tiangong-1", {"torque.law": "uniform(total, carrier)"}, n=2), "this is a word"), (lambda: sweep("tiangong-1", {"torque.law": "total:carrier:2"}), "this is a word"),
    (lambda: sweep("wheel-seized", {"orbit.eccentricity": [0.0, 0.5]}, ask=["attitude"], times=[90.0, 93.0]), "the scene has no orbit"),
    (lambda: sweep("tiangong-1", {"torque.drag": "0:1e-3:2000000000"}), "take shards")])
def test_a_study_that_is_none_is_refused(study: Callable[[], Any], why: str) -> None:
    with pytest.raises(DomainError, match=why):
        study()


def test_a_value_over_the_bound_is_told_so() -> None:
    rows = sweep("tiangong-1", {"torque.drag": [1e70, -1.0]}, times=[0.0, 10.0], threads=1)
    assert rows.reason.values.tolist() == ["torque.drag is over 1e+60", "torque.drag is not >= 0"]
    rows = sweep("two-attractors", {"motor.no_load_rate": [-1e70]}, times=[0.0, 10.0], threads=1)
    assert rows.reason.values.tolist() == ["motor.no_load_rate is not >= -1e+60"]


def test_a_shard_of_a_huge_grid_is_made_of_its_own_values() -> None:
    rows = sweep("tiangong-1", {"torque.drag": "0:1e-3:2000000000"}, shard="2000000/2000000", times=[0.0, 10.0], threads=1)
    assert rows.sizes["row"] == 1000 and float(rows["torque.drag"][-1]) == 1e-3


def test_all_of_a_spinner_has_its_attitude() -> None:
    assert knows_attitude("spinning", load("no-stiffness").tables)
    rows = sweep("no-stiffness", {"body.inertia[0]": [8.0]}, ask="all", times=[1.0], threads=1)
    assert set(gyrostat.solve("no-stiffness", ask="all", times=[1.0])) <= set(rows.data_vars)


def test_results_do_not_replace_the_table_that_the_scene_names(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = load("tiangong-1")
    assert scene.path is not None
    (tmp_path / "cc.csv").write_text("torque.drag\n1e-6\n2e-6\n")
    (tmp_path / "v.toml").write_text(scene.path.read_text() + '\n[vary]\ncases = "cc.csv"\n')
    assert main(["sweep", str(tmp_path / "v.toml"), "--ask", "stop_time", "--threads", "1", "-o", str(tmp_path / "cc.csv")]) == 2
    assert "would replace the table of cases" in capsys.readouterr().err
    assert (tmp_path / "cc.csv").read_text() == "torque.drag\n1e-6\n2e-6\n"
