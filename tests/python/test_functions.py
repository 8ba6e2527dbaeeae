# SPDX-License-Identifier: BSD-3-Clause
"""The functions over arrays: values, broadcasting, errors that name what is wrong."""

import math
from collections.abc import Callable
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import DomainError, deceleration, elliptic, rotation

J, B, M0 = [35.0, 22.0, 16.0], [5e-4, 8e-4, 1e-3], [40.0, 25.0, 16.5]
BACKENDS = ["auto", "native"] + (["gsl"] if gyrostat.build_info()["gsl"] else [])


# ---- elliptic ----


@pytest.mark.parametrize("backend", BACKENDS)
def test_elliptic_values(backend: str) -> None:
    complete = elliptic.complete([0.0, 0.5], elliptic=backend)
    assert complete.K == pytest.approx([math.pi / 2, 1.8540746773013719184], rel=1e-15)
    assert complete.E == pytest.approx([math.pi / 2, 1.3506438810476755025], rel=1e-15)
    near = elliptic.complete(1.0, kp2=1e-20, elliptic=backend)
    assert near.K == pytest.approx(math.log(4 / 1e-10), rel=1e-14) and np.ndim(near.K) == 0
    u = np.linspace(-9, 9, 7)[:, None]
    k2 = np.array([0.1, 0.5, 0.99])
    f = elliptic.jacobi(u, k2, elliptic=backend)
    assert f.sn.shape == (7, 3)
    assert f.sn**2 + f.cn**2 == pytest.approx(np.ones((7, 3)), abs=1e-14)
    assert f.dn**2 + k2 * f.sn**2 == pytest.approx(np.ones((7, 3)), abs=1e-13)
    i = elliptic.incomplete(f.am, k2, elliptic=backend)
    assert i.F == pytest.approx(np.broadcast_to(u, (7, 3)), rel=1e-12, abs=1e-12)
    c = elliptic.complete(k2, elliptic=backend)
    assert elliptic.zeta(u, k2, elliptic=backend) == pytest.approx(i.E - u * c.E / c.K, abs=1e-12)
    assert elliptic.incomplete(0.7, 0.3, n=0.0, elliptic=backend).Pi == pytest.approx(elliptic.incomplete(0.7, 0.3).F, rel=1e-14)


def test_elliptic_outside_the_domain() -> None:
    assert math.isnan(elliptic.complete(1.5, kp2=-0.5).K)
    assert np.isnan(elliptic.complete([0.3, 0.3], kp2=[0.9, 0.7]).K).tolist() == [True, False]
    assert math.isnan(elliptic.jacobi(0.5, 1.0, kp2=1e-3).sn) and math.isnan(elliptic.incomplete(0.5, 0.2, kp2=0.2).F)
    assert math.isnan(elliptic.complete(math.nan).E)
    with pytest.raises(DomainError, match="elliptic = 'boost'"):
        elliptic.complete(0.5, elliptic="boost")
    with pytest.raises(DomainError, match="broadcast"):
        elliptic.jacobi([1.0, 2.0], [0.1, 0.2, 0.3])
    with pytest.raises(DomainError, match="k2 = x: not an array"):
        elliptic.complete("x", kp2=0.5)


# ---- rotation ----


def test_rotations_agree_with_scipy() -> None:
    Rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    draw = np.random.default_rng(3)
    vectors = draw.normal(size=(4, 5, 3)) * draw.choice([1e-13, 1e-3, 1.0], size=(4, 5, 1))
    truth = Rotation.from_rotvec(vectors.reshape(-1, 3))
    q = rotation.quaternion_from_vector(vectors)
    assert q.shape == (4, 5, 4)
    R = rotation.matrix_from_quaternion(q)
    assert R.shape == (4, 5, 3, 3)
    assert np.allclose(R.reshape(-1, 3, 3), truth.as_matrix(), atol=1e-15)
    assert np.allclose(rotation.matrix_from_vector(vectors), R, atol=1e-15)
    assert np.allclose(rotation.vector_from_quaternion(q).reshape(-1, 3), truth.as_rotvec(), atol=1e-14)
    assert np.allclose(rotation.vector_from_matrix(R), rotation.vector_from_quaternion(q), atol=1e-14)
    back = rotation.quaternion_from_matrix(R)
    assert np.allclose(np.abs((back * q).sum(axis=-1)), 1, atol=1e-15)


def test_scalar_first_moves_the_scalar() -> None:
    q = [0.5, 0.1, -0.7, 0.2]
    R = rotation.matrix_from_quaternion(q)
    assert np.array_equal(rotation.matrix_from_quaternion(np.roll(q, 1), scalar_first=True), R)
    assert np.array_equal(np.roll(rotation.quaternion_from_matrix(R), 1), rotation.quaternion_from_matrix(R, scalar_first=True))
    v = rotation.vector_from_quaternion(q)
    assert np.array_equal(np.roll(rotation.quaternion_from_vector(v), 1), rotation.quaternion_from_vector(v, scalar_first=True))
    assert np.array_equal(rotation.vector_from_quaternion(np.roll(q, 1), scalar_first=True), v)


@pytest.mark.parametrize(("call", "text"), [
    (lambda: rotation.matrix_from_quaternion([0.0, 0.0, 0.0, 0.0]), "quaternion, row 0"),
    (lambda: rotation.vector_from_quaternion([[0, 0, 0, 1], [math.nan, 0, 0, 1]]), "quaternion, row 1"),
    (lambda: rotation.matrix_from_quaternion([1.0, 2.0, 3.0]), "quaternion: the shape is"),
    (lambda: rotation.quaternion_from_matrix(np.diag([1.0, 1.0, -1.0])), "not a proper rotation"),
    (lambda: rotation.vector_from_matrix(2 * np.eye(3)), "not a proper rotation"),
])
def test_what_is_no_rotation_is_refused(call: Callable[[], Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        call()


# ---- deceleration ----


def test_averaged_over_arrays_is_averaged_one_by_one() -> None:
    controls = np.array([B, [8e-4, 8e-4, 8e-4], [1e-3, 8e-4, 5e-4]])
    drags = np.array([[1e-5], [4e-5]])
    t = np.linspace(0, 4000, 5)
    made = deceleration.averaged(inertia=J, control=controls, drag=drags, angular_momentum=M0, t=t)
    assert made.momentum_norm.shape == made.regime.shape == (2, 3, 5)
    assert made.stop_time.shape == made.error["momentum_norm"].shape == (2, 3)
    for i in range(2):
        for j in range(3):
            one = deceleration.solve(inertia=J, control=controls[j], drag=drags[i, 0], angular_momentum=M0, times=t,
                                     model="averaged", tolerance=1e-9)
            assert np.array_equal(made.momentum_norm[i, j], one["angular_momentum_norm"])
            assert np.array_equal(made.modulus_squared[i, j], one["modulus_squared"])
            assert np.array_equal(made.regime[i, j], one["regime"])
            assert made.error["energy"][i, j] == one.error["energy"]


def test_averaged_with_equal_torques_is_the_exponential_law() -> None:
    t = np.linspace(0, 4000, 9)
    made = deceleration.averaged(inertia=J, control=[7e-4] * 3, drag=2e-5, angular_momentum=M0, t=t)
    start = np.linalg.norm(M0)
    assert made.momentum_norm == pytest.approx((start + 35) * np.exp(-2e-5 * t) - 35, rel=1e-8)
    assert float(made.stop_time) == pytest.approx(math.log1p(2e-5 * float(start) / 7e-4) / 2e-5, rel=1e-7)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-12])
def test_averaged_states_what_its_integration_loses(tolerance: float) -> None:
    J, M, control, drag, t = [0.8081527620785081, 0.6559124908585063, 1.0088779805841743], [-1.1301008868754392, -0.7503960019574306, -0.4468597903930816], 0.008586703562489329, 0.000322413707639318, 59.56863861563033
    norm = math.hypot(*M)
    found = deceleration.averaged(inertia=J, control=[control] * 3, drag=drag, angular_momentum=M, t=[0.0, t], tolerance=tolerance)
    true = norm * math.exp(-drag * t) + control / drag * math.expm1(-drag * t)
    assert abs(found.momentum_norm[1] - true) <= found.error["momentum_norm"] * norm


def test_quasi_stationary_modulus_solves_its_equation() -> None:
    star = deceleration.quasi_stationary_modulus_squared(control=[[0.95, 0.8, 1.0], [2.0, 1.0, 1.0]])
    assert 0 < star[0] < 1 and math.isnan(star[1])
    c = elliptic.complete(star[0])
    w = 1 - c.E / c.K
    assert 0.95 == pytest.approx(1 + (0.8 - 1) * (1 - star[0]) * w / (star[0] * (1 - w)), rel=1e-13)
    table = deceleration.stability(control=[0.95, 0.8, 1.0])
    assert (table.region, table.axis, table.interior, table.separatrix) == ("to-interior", "repels", "attracts", "repels")
    assert table.quasi_stationary + table.quasi_stationary_complement == pytest.approx(1)
    other = deceleration.quasi_stationary_modulus_squared(control=[1.0, 0.8, 0.95], regime="C")
    assert other == pytest.approx(star[0], rel=1e-14)


def test_integrators_agree() -> None:
    given: dict[str, Any] = {"inertia": J, "control": B, "drag": 2e-5, "angular_momentum": M0, "times": [0.0, 10.0, 200.0]}
    truth = deceleration.integrate(**given, method="taylor", order=30, tolerance=1e-18, precision="long double")
    assert truth["status"] == "reached"
    methods = ["taylor", "dop853"]
    if deceleration.has_cvode():
        methods += ["cvode-adams", "cvode-bdf"]
    for method in methods:
        made = deceleration.integrate(**given, method=method, tolerance=1e-12)
        assert made["status"] == "reached" and made["rhs"] > 0 and made["seconds"] > 0
        assert np.array_equal(made["angular_momentum"][0], M0)
        assert np.max(np.abs(made["angular_momentum"] - truth["angular_momentum"])) < (1e-5 if "cvode" in str(method) else 1e-8)


GOOD: dict[str, Any] = {"inertia": J, "control": B, "drag": 2e-5, "angular_momentum": M0, "times": [1.0]}


@pytest.mark.parametrize(("change", "text"), [
    ({"inertia": [1.0, 2.0, 9.0]}, r"inertia = \[1, 2, 9\]"),
    ({"inertia": [[1.0, 2.0], [3.0, 4.0]]}, "inertia: the shape is"),
    ({"inertia": [1.0, math.nan, 1.0]}, "inertia = .*not finite"),
    ({"control": [1.0, -1.0, 1.0]}, "control = .*negative"),
    ({"control": [1.0, 1.0]}, "control: the shape is"),
    ({"drag": -1.0}, "drag = -1"),
    ({"drag": math.inf}, "drag = inf"),
    ({"angular_momentum": [math.inf, 0.0, 0.0]}, "angular_momentum = .*not finite"),
    ({"attitude": [0.0, 0.0, 0.0, 2.0]}, "attitude = .*unit"),
    ({"times": []}, "times"),
    ({"times": [2.0, 1.0]}, "times: element 1"),
    ({"times": [-1.0]}, "times: element 0 = -1"),
    ({"tolerance": 0.0}, "tolerance = 0"),
    ({"law": "both"}, "law = 'both'"),
    ({"model": "best"}, "model = 'best'"),
    ({"integrator": "euler"}, "integrator = 'euler'"),
    ({"elliptic": "boost"}, "elliptic = 'boost'"),
])
def test_a_bad_argument_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(DomainError, match=text):
        deceleration.solve(**{**GOOD, **change})


def test_the_offending_row_is_named() -> None:
    with pytest.raises(DomainError, match="row 2: inertia"):
        deceleration.averaged(inertia=[J, J, [1.0, 2.0, 9.0]], control=B, drag=1e-5, angular_momentum=M0, t=[1.0])
    with pytest.raises(DomainError, match="control, row 1"):
        deceleration.stability(control=[B, [-1.0, 1.0, 1.0]])
    with pytest.raises(DomainError, match="leading axes"):
        deceleration.averaged(inertia=[J, J], control=[B, B, B], drag=1e-5, angular_momentum=M0, t=[1.0])


def test_empty_arrays_give_empty_arrays() -> None:
    assert elliptic.complete(np.empty((0, 2))).K.shape == (0, 2)
    assert rotation.matrix_from_vector(np.empty((0, 3))).shape == (0, 3, 3)
    made = deceleration.averaged(inertia=np.empty((0, 3)), control=B, drag=1e-5, angular_momentum=M0, t=[1.0])
    assert made.momentum_norm.shape == (0, 1)


def test_integrals_behind_the_quarter_period_of_the_limit_are_infinite() -> None:
    for n in (-1.0, 0.0, 0.3, 1.0):
        beyond = elliptic.incomplete([2.0, -2.0], 1.0, n=n)
        assert beyond.F.tolist() == [math.inf, -math.inf] == beyond.Pi.tolist()


def test_an_answer_tells_the_scene_that_was_solved_whatever_becomes_of_its_arrays() -> None:
    inertia, rates, times = np.array([0.7, 0.9, 1.1]), np.array([0.02, -0.3, 0.05]), np.array([30.0, 60.0])
    wheels = [{"axis": np.array([1.0, 0.0, 0.0]), "axial_inertia": 0.01, "rate": 10.0}]
    answer = gyrostat.general.solve(inertia=inertia, angular_velocity=rates, times=times, wheels=wheels)
    inertia[:], rates[:], times[:], wheels[0]["rate"] = 9.0, 8.0, 7.0, 77.0
    wheels[0]["axis"][0] = 5.0  # type: ignore[index]
    scene = answer.scene
    assert scene["initial"]["angular_velocity"] == [0.02, -0.3, 0.05] and scene["solve"]["times"] == [30.0, 60.0] == list(answer.t)
    assert scene["wheel"][0]["rate"] == 10.0 and scene["wheel"][0]["axis"] == [1.0, 0.0, 0.0] and np.trace(scene["body"]["inertia"]) == 2.7
