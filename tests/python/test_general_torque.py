# SPDX-License-Identifier: BSD-3-Clause
"""A torque of one's own in general scenes: Python callables, compiled functions, and what goes wrong with them."""

import ctypes
import importlib
import importlib.util
import math
import shutil
import subprocess
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from gyrostat import general
from numpy.typing import NDArray

Floats = NDArray[np.float64]
BODY: dict[str, Any] = {"inertia": [3.0, 4.0, 5.0], "angular_velocity": [0.3, -0.5, 0.8], "times": [0.0, 1.0, 5.0, 20.0]}
DAMPED: dict[str, Any] = {**BODY, "torques": [{"type": "damping", "coefficient": 0.1}]}
SCENE: dict[str, Any] = {"name": "own", "kind": "general", "body": {"inertia": [3.0, 4.0, 5.0]}, "initial": {"attitude": [0.0, 0.0, 0.0, 1.0],
                         "angular_velocity": [0.3, -0.5, 0.8]}, "solve": {"duration": 20.0, "samples": 5}}
C = "void damping(double t, const double *state, double *torque) { for (int i = 0; i < 3; ++i) torque[i] = -0.1*state[4 + i]; (void)t; }\n"


def damping(t: float, attitude: Floats, angular_velocity: Floats, angular_momentum: Floats, rotor_rate: Floats) -> Floats:
    return -0.1 * angular_velocity


def apart(a: gyrostat.Answer, b: gyrostat.Answer) -> float:
    return float(np.abs(a["angular_velocity"] - b["angular_velocity"]).max())


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-11])
@pytest.mark.parametrize("integrator", ["auto", "dop853"])
def test_a_callable_is_answered_as_the_same_torque(tolerance: float, integrator: str) -> None:
    right = general.solve(**DAMPED, tolerance=1e-13, model="full")
    answer = general.solve(**BODY, torque=damping, tolerance=tolerance, integrator=integrator)
    assert answer.model == "full" and answer.met
    assert [warning.code for warning in answer.warnings] == ["custom-smooth"]
    assert apart(answer, right) <= answer.error["angular_velocity"] + right.error["angular_velocity"]


@pytest.mark.skipif(gyrostat.build_info()["cvode"] is None, reason="this build has no CVODE")
def test_cvode_answers_as_well() -> None:
    right = general.solve(**DAMPED, tolerance=1e-13, model="full")
    for answer in (general.solve(**BODY, torque=damping, tolerance=1e-7, integrator="cvode"),
                   general.solve(**DAMPED, tolerance=1e-7, model="full", integrator="cvode")):
        assert answer.met and apart(answer, right) <= answer.error["angular_velocity"] + right.error["angular_velocity"]


def test_collocation_by_name_agrees_with_taylor_series() -> None:
    one, other = (general.solve(**DAMPED, tolerance=1e-9, model="full", integrator=name) for name in ("radau", "taylor"))
    assert one.met and "stiff" not in [warning.code for warning in one.warnings]
    assert 0 < apart(one, other) <= one.error["angular_velocity"] + other.error["angular_velocity"]


def test_dop853_of_scenes_with_no_torque_of_ones_own() -> None:
    right = general.solve(**DAMPED, tolerance=1e-13, model="full")
    answer = general.solve(**DAMPED, tolerance=1e-7, model="full", integrator="dop853")
    assert answer.met and not answer.warnings and apart(answer, right) <= answer.error["angular_velocity"] + right.error["angular_velocity"]


@pytest.mark.parametrize("integrator", ["dop853", *(["cvode"] if gyrostat.build_info()["cvode"] else [])])
def test_the_rows_of_a_sweep_go_by_the_same_integrators(integrator: str) -> None:
    scene = gyrostat.scenes.scene_from({**SCENE, "torque": [{"type": "damping", "coefficient": 0.1}]}, model="full", integrator=integrator)
    rows = gyrostat.sweep(scene, {"torque[0].coefficient": [0.1, 0.2]})
    answer = gyrostat.solve(scene)
    assert rows["attitude"].values[0].tobytes() == answer["attitude"].tobytes() and rows["attitude_error"].values[0] == answer.error["attitude"]
    assert answer.error["attitude"] != gyrostat.solve(scene, integrator="taylor").error["attitude"]


def test_what_a_callable_is_given() -> None:
    seen: list[Any] = []

    def looks(t: float, attitude: Floats, angular_velocity: Floats, angular_momentum: Floats, rotor_rate: Floats) -> list[float]:
        seen.append((t, attitude, angular_velocity, angular_momentum, rotor_rate))
        return [0.0, 0.0, 0.0]

    wheels = [{"axis": [0.0, 0.0, 1.0], "axial_inertia": 0.1, "rate": 20.0}, {"type": "free", "axis": [1.0, 0.0, 0.0], "axial_inertia": 0.1, "rate": -5.0}]
    q = np.array([0.1, -0.2, 0.3, 0.9])
    q /= np.linalg.norm(q)
    general.solve(**BODY, wheels=wheels, attitude=q, torque=looks)
    t, attitude, w, M, rates = seen[0]
    assert t == 0.0 and attitude == pytest.approx(q) and w == pytest.approx(BODY["angular_velocity"]) and rates == pytest.approx([20.0, -5.0])
    assert pytest.approx([3.0 * 0.3 - 0.1 * 5.0, 4.0 * -0.5, 5.0 * 0.8 + 0.1 * 20.0]) == M


def test_the_clock_is_that_of_the_times() -> None:
    def pulse(t: float, *_: Floats) -> list[float]:
        return [0.2, 0.0, 0.0] if 105.0 <= t < 110.0 else [0.0, 0.0, 0.0]

    body = {**BODY, "times": [100.0, 107.0, 120.0], "start_time": 100.0}
    on = [{"type": "constant", "torque": [0.2, 0.0, 0.0], "on": [[105.0, 110.0]]}]
    right = general.solve(**body, torques=on, tolerance=1e-12, model="full")
    named = general.solve(**body, torque=pulse, breakpoints=[110.0, 105.0], tolerance=1e-9)
    unnamed = general.solve(**body, torque=pulse, tolerance=1e-9)
    assert named.met and not named.warnings and named.counts["rejected"] < unnamed.counts["rejected"]
    for answer in (named, unnamed):
        assert apart(answer, right) <= answer.error["angular_velocity"] + right.error["angular_velocity"]


def test_a_scene_takes_it() -> None:
    answer = gyrostat.solve(SCENE, torque=damping, breakpoints=[3.0], tolerance=1e-8)
    right = gyrostat.solve(SCENE, torque=[{"type": "damping", "coefficient": 0.1}], tolerance=1e-12)
    assert apart(answer, right) <= answer.error["angular_velocity"] + right.error["angular_velocity"]
    with pytest.raises(gyrostat.DomainError, match="kind general, and this one is of the kind rotor"):
        gyrostat.solve("rotor-paper-example", torque=damping)
    with pytest.raises(gyrostat.DomainError, match="there is none"):
        gyrostat.solve(SCENE, breakpoints=[3.0])
    with pytest.raises(gyrostat.DomainError, match="there is none"):
        gyrostat.solve(SCENE, breakpoints=3.0)
    with pytest.raises(gyrostat.DomainError, match="breakpoints"):
        gyrostat.solve(SCENE, breakpoints=None)


def test_no_scene_file_names_a_function() -> None:
    for key in ("breakpoints", "torque"):
        with pytest.raises(gyrostat.SceneError):
            gyrostat.solve({**SCENE, key: "print"})


def compiled(folder: Path) -> Any:
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        pytest.skip("there is no C compiler")
    (folder / "own.c").write_text(C, encoding="utf-8")
    subprocess.run([compiler, "-O2", "-shared", "-fPIC", "-o", str(folder / "own.so"), str(folder / "own.c")], check=True)
    return ctypes.CDLL(str(folder / "own.so")).damping


def test_a_compiled_function_is_answered_to_the_last_bit_as_the_callable(tmp_path: Path) -> None:
    function = compiled(tmp_path)
    address = ctypes.cast(function, ctypes.c_void_p).value
    assert address
    for torque in (function, address):
        answer, right = general.solve(**BODY, torque=torque), general.solve(**BODY, torque=damping)
        assert np.array_equal(answer["angular_velocity"], right["angular_velocity"]) and answer.counts == right.counts


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason="numba is not installed")
def test_a_function_of_numba() -> None:
    numba: Any = importlib.import_module("numba")
    pointer = numba.types.CPointer(numba.types.float64)

    def damped(t: float, state: Any, torque: Any) -> None:
        for i in range(3):
            torque[i] = -0.1 * state[4 + i]

    own = numba.cfunc(numba.types.void(numba.types.float64, pointer, pointer))(damped)
    right = general.solve(**BODY, torque=damping)
    for torque in (own, own.address):
        assert np.array_equal(general.solve(**BODY, torque=torque)["angular_velocity"], right["angular_velocity"])


class Broken(Exception):
    """What a callable raises in these tests."""


def test_what_a_callable_raises_reaches_the_caller() -> None:
    error = Broken("at 3 s")

    def breaks(t: float, *_: Floats) -> list[float]:
        if t > 3.0:
            raise error
        return [0.1, 0.0, 0.0]

    with pytest.raises(Broken) as caught:
        general.solve(**BODY, torque=breaks)
    assert caught.value is error


@pytest.mark.parametrize("made", [[0.0, 0.0], 1.0, "north", None, [[0.0, 0.0, 0.0]], [0.0, 1.0, "x"]])
def test_what_is_no_torque(made: Any) -> None:
    with pytest.raises(gyrostat.DomainError, match="give three numbers"):
        general.solve(**BODY, torque=lambda *_: made)


def test_a_torque_without_a_value_is_refused_with_its_time() -> None:
    for integrator in ("auto", *(["cvode"] if gyrostat.build_info()["cvode"] else [])):
        with pytest.raises(gyrostat.DomainError, match=r"no finite value at t = (7|6\.99999|7\.00000)"):
            general.solve(**BODY, torque=lambda t, *_: [math.nan if t > 7.0 else 0.1, 0.0, 0.0], integrator=integrator)
    with pytest.raises(gyrostat.DomainError, match="no finite value at t = 0"):
        general.solve(**BODY, torque=lambda *_: [math.inf, 0.0, 0.0])


def test_a_torque_that_is_no_function_is_refused() -> None:
    random = np.random.default_rng(1)
    with pytest.raises(gyrostat.DomainError, match="not a function of time and state"):
        general.solve(**BODY, torque=lambda *_: random.normal(size=3))


def test_a_switch_that_holds_the_body_at_its_own_jump_is_given_up() -> None:
    def bang(t: float, attitude: Floats, w: Floats, *_: Floats) -> Floats:
        return -0.01 * np.sign(w)

    for integrator in ("auto", *(["cvode"] if gyrostat.build_info()["cvode"] else [])):
        with pytest.raises(gyrostat.ConvergenceError, match="give a jump with the state.* a width"):
            general.solve(inertia=[1.0, 2.0, 2.5], angular_velocity=[0.1, 0.0, 0.2], times=[10.0, 50.0], torque=bang, integrator=integrator)


@pytest.mark.parametrize(("given", "why"), [({"torque": 5.5}, "give a function"), ({"torque": True}, "give a function"), ({"torque": 0}, "no function at"),
                                            ({"torque": damping, "integrator": "taylor"}, "no Taylor series"),
                                            ({"torque": damping, "breakpoints": [math.nan]}, "finite times"), ({"breakpoints": [1.0]}, "there is none"),
                                            ({"torque": damping, "model": "free:closed-form"}, "free")])
def test_what_cannot_be_asked(given: dict[str, Any], why: str) -> None:
    with pytest.raises(gyrostat.DomainError, match=why):
        general.solve(**BODY, **given)


def watched(torque: Callable[..., Any], monitor: gyrostat.Monitor, caught: list[BaseException]) -> None:
    try:
        general.solve(**{**BODY, "times": [1e5]}, torque=torque, tolerance=1e-9, monitor=monitor)
    except BaseException as error:
        caught.append(error)


def test_a_monitor_stops_it_from_another_thread() -> None:
    monitor, caught, begun = gyrostat.Monitor(), list[BaseException](), threading.Event()

    def slow(t: float, *_: Floats) -> list[float]:
        begun.set()
        return [1e-6 * math.sin(t), 0.0, 0.0]

    worker = threading.Thread(target=watched, args=(slow, monitor, caught))
    worker.start()
    assert begun.wait(20)
    monitor.cancel()
    worker.join(60)
    assert not worker.is_alive() and len(caught) == 1 and isinstance(caught[0], gyrostat.Cancelled)
