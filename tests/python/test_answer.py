# SPDX-License-Identifier: BSD-3-Clause
"""Answers and their forms: JSON, CSV, NetCDF, xarray, figure."""

import csv
import io
import json
import math
import struct
import time
from pathlib import Path

import gyrostat
import numpy as np
import pytest
from conftest import scene_names
from gyrostat._core import csv_rows, json_numbers
from gyrostat.answer import Answer
from gyrostat.console import small
from gyrostat.facts import UNITS
from gyrostat.families import FAMILIES
from gyrostat.report import report
from gyrostat.rotation import angle_between

BRAKE = {
    "name": "brake", "kind": "deceleration", "solve": {"duration": 4000.0, "samples": 41, "tolerance": 1e-3},
    "body": {"inertia": [35.0, 22.0, 16.0]}, "torque": {"control": [5e-4, 8e-4, 1e-3], "drag": 2e-5},
    "initial": {"angular_momentum": [40.0, 25.0, 16.5]},
}


@pytest.fixture(scope="module")
def full() -> Answer:
    return gyrostat.solve(BRAKE, model="full", attitude=[0.0, 0.0, 0.0, 1.0])


def test_an_answer_says_how_it_was_found(full: Answer) -> None:
    assert full.model == "full" and full.met and full.greatest_error <= full.tolerance
    assert [attempt.model for attempt in full.tried if attempt.accepted] == ["full"]
    assert full.seconds > 0 and full.counts["rhs"] > 0
    assert "brake" in repr(full) and "full" in repr(full)


def test_columns_have_the_shapes_and_names_of_the_contract(full: Answer) -> None:
    n = len(full.t)
    shapes = {name: values.shape for name, values in full.columns.items()}
    assert shapes == {"angular_momentum": (n, 3), "angular_velocity": (n, 3), "attitude": (n, 4), "angular_momentum_norm": (n,),
                      "energy": (n,), "modulus_squared": (n,), "regime": (n,)}
    averaged = gyrostat.solve(BRAKE, model="averaged")
    assert set(averaged.scalars) == {"stop_time", "final_angular_velocity", "small_parameter", "separatrix_distance"}
    assert set(full.scalars) >= set(averaged.scalars) - {"stop_time"}  # the full equations seek a stop that is not far off
    assert set(full.error) == set(full.columns) - {"regime"}
    assert set(full.columns) | set(full.scalars) <= set(UNITS)
    assert full["t"] is full.t and full["energy"] is full.columns["energy"]


def test_an_answer_is_read_like_a_mapping_of_columns(full: Answer) -> None:
    assert list(full) == list(full.keys()) == list(full.columns) and len(full) == 7
    assert "energy" in full and "t" in full and "stop_time" not in full and 3 not in full
    assert {name: values.shape for name, values in dict(full).items()} == {name: full[name].shape for name in full.columns}


def test_a_column_that_is_not_there_is_told_with_those_that_are(full: Answer) -> None:
    with pytest.raises(KeyError, match='no column "enrgy".*angular_momentum, .*energy'):
        full["enrgy"]
    averaged = gyrostat.solve(BRAKE, model="averaged")
    with pytest.raises(KeyError, match="a higher rung gives it"):
        averaged["angular_momentum"]
    with pytest.raises(KeyError, match="where initial.attitude is given or it is asked for"):
        averaged["attitude"]
    with pytest.raises(KeyError, match=r'ask for it, as ask = \["angular_momentum"\]'):
        gyrostat.solve(BRAKE)["angular_momentum"]
    with pytest.raises(KeyError, match="stop_time is a scalar"):
        averaged["stop_time"]
    with pytest.raises(KeyError, match='no scalar "stop"; the scalars of this answer are .*stop_time'):
        averaged.scalars["stop"]
    assert averaged.scalars.get("stop") is None


def test_the_error_that_is_shown_is_the_one_that_was_judged() -> None:
    """The stop time is less certain than any column: the ladder judges by it, and every view shows it."""
    answer = gyrostat.solve("tiangong-1")
    assert answer.greatest_error == answer.scalar_error["stop_time"] > max(e for e in answer.error.values() if not math.isnan(e))
    assert answer.least_certain == "stop_time" and answer.met == (answer.greatest_error <= answer.tolerance)
    assert f"stop_time {answer.scalars['stop_time']:.6g} (error {answer.greatest_error:.2g})" in repr(answer)
    fine = gyrostat.solve("tiangong-1", model="full", tolerance=1e-10, duration=60000.0)
    assert abs(fine.scalars["stop_time"] / answer.scalars["stop_time"] - 1) <= answer.scalar_error["stop_time"]
    assert not gyrostat.solve("tiangong-1", model="averaged", tolerance=answer.greatest_error * 0.99).met


def test_the_verdict_pairs_an_error_with_its_own_tolerance_and_names_what_has_no_value() -> None:
    asked = gyrostat.solve("tiangong-1", ask={"stop_time": "1 h", "energy": 1e-9}, tolerance=1e-6)
    name = asked.least_certain
    assert asked.verdict == f"estimated error {small({**asked.error, **asked.scalar_error}[name])} ({name}), tolerance {asked.tolerances[name]:.3g} met"
    assert asked.verdict in repr(asked) and asked.verdict in asked.plot().get_suptitle()
    early = gyrostat.solve("tiangong-1", model="averaged", ask=["stop_time", "angular_velocity"])
    assert not early.met and early.least_certain == "angular_velocity" and early.verdict.startswith("angular_velocity has no value")
    stream = io.StringIO()
    report(early, stream)
    assert "left without a value (angular_velocity)" in " ".join(stream.getvalue().split())
    for ask in (["stable", "down"], ["stable"]):
        top = gyrostat.solve("toy-top", ask=ask)
        assert not top.met and top.verdict == f"stable has no value, tolerance {top.tolerance:.3g} NOT met"
    pointing = gyrostat.solve("pam-d-burn", ask=["pointing_error"])
    assert pointing.verdict == "nothing that was asked for has an error of its own"


@pytest.mark.parametrize("name", scene_names())
def test_every_answer_names_what_has_the_greatest_error(name: str) -> None:
    answer = gyrostat.solve(name)
    assert set(answer.scalar_error) == set(answer.scalars)
    errors = {**answer.error, **answer.scalar_error}
    assert answer.greatest_error == errors[answer.least_certain] >= max(e for e in answer.error.values() if not math.isnan(e))


def test_a_stop_that_never_comes_has_no_error() -> None:
    answer = gyrostat.solve(BRAKE, control=[0.0, 0.0, 0.0])
    assert math.isinf(answer.scalars["stop_time"]) and math.isnan(answer.scalar_error["stop_time"])


@pytest.mark.parametrize("name", scene_names())
def test_the_functions_of_a_family_answer_as_scenes_do(name: str) -> None:
    """Same type, same numbers; and what they were asked can be asked again as a scene."""
    scene = gyrostat.load(name)
    family = FAMILIES[scene.kind]
    direct, answer = family.solve(**family.arguments(scene)), gyrostat.solve(scene)
    again = gyrostat.solve(direct.scene)
    for other in (answer, again):
        assert type(direct) is type(other) is Answer and direct.model == other.model and direct.error == other.error and np.array_equal(direct.t, other.t)
        assert list(direct) == list(other) and all(np.array_equal(direct[column], other[column]) for column in direct)
        np.testing.assert_equal(direct.scalars, other.scalars)
        np.testing.assert_equal(direct.scalar_error, other.scalar_error)
    assert direct.scene["kind"] == scene.kind and direct.scene["name"] == f"gyrostat.{scene.kind}.solve" and answer.scene == scene.to_dict()


def test_columns_agree_with_each_other(full: Answer) -> None:
    J = np.array([35.0, 22.0, 16.0])
    M, omega = full["angular_momentum"], full["angular_velocity"]
    assert np.allclose(M, J * omega, rtol=1e-13, atol=1e-12)
    assert np.allclose(np.linalg.norm(M, axis=1), full["angular_momentum_norm"], rtol=1e-13)
    assert np.allclose((M * omega).sum(axis=1) / 2, full["energy"], rtol=1e-12)
    assert np.allclose(np.linalg.norm(full["attitude"], axis=1), 1, rtol=1e-14)


def test_the_cheapest_rung_that_is_good_enough_answers() -> None:
    coarse, fine = gyrostat.solve(BRAKE, tolerance=1e-2), gyrostat.solve(BRAKE, tolerance=1e-10)
    assert coarse.model == "averaged" and fine.model == "full"
    assert gyrostat.solve(BRAKE, control=[1e-3] * 3).model == "equal-torque"
    assert np.max(np.abs(coarse["angular_momentum_norm"] - fine["angular_momentum_norm"])) / fine["angular_momentum_norm"][0] \
        <= coarse.error["angular_momentum_norm"]


def test_equal_torques_leave_the_attitude_in_closed_form() -> None:
    given = {"control": [1e-3] * 3, "attitude": [0.1, -0.7, 0.1, 0.7], "duration": 60000.0, "samples": 7}
    q = gyrostat.solve(BRAKE, **given, ask={"attitude": "0.001 deg"})
    assert q.model == "equal-torque" and q.met and list(q) == ["attitude"]
    assert np.array_equal(q["attitude"][-1], q["attitude"][-2])  # it rests after some 33000 s
    named, full = (gyrostat.solve(BRAKE, **{**given, "duration": 2000.0}, model=model, tolerance=1e-9) for model in ("equal-torque", "full"))
    assert named.met
    for name in ("attitude", "angular_momentum", "angular_velocity"):
        size = 1 if name == "attitude" else np.max(np.linalg.norm(full[name], axis=1))
        sign = np.sign(np.sum(named[name] * full[name], axis=1))[:, None] if name == "attitude" else 1
        assert np.max(np.linalg.norm(sign * named[name] - full[name], axis=1)) <= (named.error[name] + full.error[name]) * size
    angles = angle_between(named["attitude"], full["attitude"])
    assert np.max(angles) <= named.error["attitude"] + full.error["attitude"]
    momentum = gyrostat.solve(BRAKE, control=[1e-3] * 3, ask=["angular_momentum"])
    assert momentum.model == "equal-torque" and "attitude" not in momentum.columns


@pytest.mark.parametrize("law", ["total", "carrier"])
def test_the_integrator_can_be_chosen(law: str) -> None:
    given = {"model": "full", "law": law, "rotor_momentum": [1.0, 0.5, 0.0], "tolerance": 1e-5, "duration": 400.0, "samples": 5}
    taylor = gyrostat.solve(BRAKE, integrator="taylor", **given)
    if gyrostat.build_info()["cvode"] is None:
        with pytest.raises(gyrostat.DomainError, match="no CVODE"):
            gyrostat.solve(BRAKE, integrator="cvode", **given)
        return
    cvode = gyrostat.solve(BRAKE, integrator="cvode", **given)
    assert cvode.model == "full" and cvode.counts["rhs"] > 2 * taylor.counts["rhs"]
    distance = np.max(np.linalg.norm(cvode["angular_momentum"] - taylor["angular_momentum"], axis=1))
    assert distance / 50 <= cvode.error["angular_momentum"] + taylor.error["angular_momentum"]


@pytest.mark.parametrize("model", ["averaged", "averaged-2"])
def test_the_elliptic_backend_can_be_chosen(model: str) -> None:
    native = gyrostat.solve(BRAKE, model=model, elliptic="native")
    if gyrostat.build_info()["gsl"] is None:
        with pytest.raises(gyrostat.DomainError, match="no GSL"):
            gyrostat.solve(BRAKE, model=model, elliptic="gsl")
        return
    gsl = gyrostat.solve(BRAKE, model=model, elliptic="gsl")
    assert np.max(np.abs(gsl["modulus_squared"] - native["modulus_squared"])) < 1e-9


def test_axes_may_come_in_any_order() -> None:
    order = [2, 0, 1]  # a cyclic exchange is a proper rotation
    turned = gyrostat.solve(BRAKE, model="full", inertia=np.array([35.0, 22.0, 16.0])[order],
                            control=np.array([5e-4, 8e-4, 1e-3])[order], angular_momentum=np.array([40.0, 25.0, 16.5])[order])
    straight = gyrostat.solve(BRAKE, model="full")
    size = straight["angular_momentum_norm"][0]
    assert np.max(np.abs(turned["angular_momentum"] - straight["angular_momentum"][:, order])) / size < 1e-6


def test_json_reads_back_to_the_same_numbers(full: Answer) -> None:
    read = json.loads(full.to_json())
    assert list(read) == ["scene", "model", "tolerance", "met", "error", "warnings", "t", "columns", "scalars", "scalar_error", "counts",
                          "seconds", "tried", "units", "meanings", "scale", "tolerances"]
    assert read["t"] == full.t.tolist()
    for name, values in full.columns.items():
        assert read["columns"][name] == values.tolist()
    assert gyrostat.solve(read["scene"]).columns["energy"].tolist() == read["columns"]["energy"]
    assert full.to_json() == json.dumps(full.to_dict())
    assert set(read["units"]) == set(read["meanings"]) == {"t", *full.columns, *full.scalars}
    assert read["units"]["energy"] == "J" and read["meanings"]["energy"] == "rotational energy of the carrier"


@pytest.mark.parametrize("name", ["tiangong-1", "two-attractors", "flat-sail", "lab-gyroscope", "t-handle", "iss-torque-pulse", "envisat-eddy-decay"])
def test_an_answer_comes_back_from_json(name: str, tmp_path: Path) -> None:
    file = tmp_path / "answer.json"
    answer = gyrostat.solve(name, ask="all", data_error=name == "lab-gyroscope")
    answer.to_json(file)
    again = Answer.from_json(file)
    assert again.to_json() == answer.to_json()
    assert str(again) == str(answer) or math.inf in answer.scalars.values()
    assert again.error == answer.error
    for column, values in answer.columns.items():
        assert again[column].dtype.kind == values.dtype.kind and again[column].shape == values.shape
        np.testing.assert_array_equal(again[column][values == values], values[values == values])
    for scalar, value in answer.scalars.items():
        np.testing.assert_equal(again.scalars[scalar], None if value in (math.inf, -math.inf) else value) if np.ndim(value) == 0 else \
            np.testing.assert_array_equal(again.scalars[scalar], value)


def test_an_answer_from_json_knows_that_a_torque_of_the_callers_own_acted(tmp_path: Path) -> None:
    gyrostat.solve("iss-torque-pulse", times=[1.0], torque=lambda *_: (0.0, 0.0, 1e-3)).to_json(tmp_path / "own.json")
    with pytest.raises(gyrostat.DomainError, match="torque of your own"):
        Answer.from_json(tmp_path / "own.json").view()


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"scene": 1}', "3", '{"scene": {}, "model": "full"}'])
def test_what_is_no_answer_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "no.json").write_text(text)
    with pytest.raises(gyrostat.DomainError, match="no answer"):
        Answer.from_json(tmp_path / "no.json")


def test_json_has_the_error_of_every_scalar() -> None:
    answer = gyrostat.solve(BRAKE, model="averaged")
    read = json.loads(answer.to_json())
    assert set(read["scalar_error"]) == set(read["scalars"])
    assert read["scalar_error"]["stop_time"] == answer.scalar_error["stop_time"] > 0
    assert read["scalar_error"]["small_parameter"] is None  # by definition: it has no error


def numbers() -> np.ndarray:
    """Doubles of every size and sign, short and long ones, and what is special."""
    rng = np.random.default_rng(11)
    special = [0.0, -0.0, 1e16, 9999999999999998.0, 1e-4, 9.999999999999999e-05, 123456789012345678.0, 2.0**53, 2.0**53 + 2, 5e-324, 2.2250738585072014e-308,
               1.7976931348623157e308, 0.1, 1e22, 1e23, math.nan, math.inf, -math.inf, struct.unpack("d", b"\xff" * 8)[0]]
    return np.concatenate([special, np.frombuffer(rng.bytes(8 * 20000), dtype=float), rng.integers(-2**55, 2**55, 5000).astype(float),
                           10.0 ** rng.uniform(-20, 20, 5000), np.round(rng.normal(size=5000), 3)])


def test_the_core_writes_numbers_as_python_does() -> None:
    values = numbers()
    finite = [x if math.isfinite(x) else None for x in values.tolist()]
    assert json_numbers(values) == json.dumps(finite)
    assert json_numbers(values[:12].reshape(4, 3)) == json.dumps([finite[i:i + 3] for i in (0, 3, 6, 9)])
    assert json_numbers(np.empty(0)) == "[]" and json_numbers(np.empty((0, 3))) == "[]"
    assert csv_rows([values, -values]) == "".join(f"{x!r},{-x!r}\n" for x in values.tolist())
    assert csv_rows([np.array([1.0, 2.0]), np.array([b"A", b"CC"]), np.arange(4.0).reshape(2, 2)]) == "1.0,A,0.0,1.0\n2.0,CC,2.0,3.0\n"
    with pytest.raises(gyrostat.DomainError, match="different numbers of rows"):
        csv_rows([values, values[1:]])
    with pytest.raises(gyrostat.DomainError, match="shape"):
        json_numbers(np.zeros((2, 2, 2)))
    for bad in (np.zeros((2, 2, 2)), np.array(["A"]), np.array([[b"A"]])):
        with pytest.raises(gyrostat.DomainError, match="columns"):
            csv_rows([bad])


def test_text_of_many_times_costs_less_than_that_of_their_lists() -> None:
    answer = gyrostat.solve(BRAKE, model="averaged", samples=200_000)
    began = time.process_time()
    for values in answer.columns.values():
        json.dumps(values.tolist())
    lists = time.process_time() - began
    for write in (answer.to_json, answer.to_csv):
        began = time.process_time()
        write()
        assert time.process_time() - began < lists


def test_text_goes_into_a_file_where_one_is_named(tmp_path: Path) -> None:
    answer = gyrostat.solve(BRAKE)
    assert answer.to_json(tmp_path / "a.json") + "\n" == (tmp_path / "a.json").read_text() and answer.to_json() == answer.to_json(None)
    assert answer.to_csv(str(tmp_path / "a.csv")) == (tmp_path / "a.csv").read_text() == answer.to_csv()


def test_numbers_that_are_not_finite_become_null() -> None:
    answer = gyrostat.solve(BRAKE, control=[0.0, 0.0, 0.0])
    assert math.isinf(answer.scalars["stop_time"])
    assert json.loads(answer.to_json())["scalars"]["stop_time"] is None
    assert [warning.code for warning in answer.warnings] == ["no-control"]


def test_csv_reads_back_to_the_same_numbers(full: Answer) -> None:
    rows = list(csv.DictReader(io.StringIO(full.to_csv())))
    assert len(rows) == len(full.t)
    assert [float(row["angular_momentum_y"]) for row in rows] == full["angular_momentum"][:, 1].tolist()
    assert [float(row["attitude_w"]) for row in rows] == full["attitude"][:, 3].tolist()
    assert [row["regime"] for row in rows] == full["regime"].tolist()


def test_a_dataframe_keeps_values_names_and_units(full: Answer) -> None:
    pandas = pytest.importorskip("pandas")
    frame = full.to_dataframe()
    assert frame.index.name == "t" and np.array_equal(frame.index, full.t)
    assert ["t", *frame.columns] == full.to_csv().partition("\n")[0].split(",")
    assert np.array_equal(frame["angular_momentum_y"], full["angular_momentum"][:, 1]) and list(frame["regime"]) == full["regime"].tolist()
    assert len(pandas.concat([frame, frame])) == 2 * len(full.t)
    assert frame.attrs["units"]["energy"] == "J" and frame.attrs["error"] == full.error and frame.attrs["model"] == "full"


def test_xarray_and_netcdf_keep_values_and_units(full: Answer, tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    dataset = full.to_xarray()
    assert dataset["angular_momentum"].dims == ("t", "axis") and dataset["energy"].attrs["units"] == "J"
    assert dataset.attrs["model"] == "full"
    stop = gyrostat.solve("tiangong-1")
    attributes = stop.to_xarray().attrs
    assert attributes["stop_time_units"] == "s" and attributes["stop_time_estimated_error"] == stop.scalar_error["stop_time"]
    file = tmp_path / "answer.nc"
    full.to_netcdf(file)
    with xarray.open_dataset(file, engine="scipy") as read:
        assert np.array_equal(read["angular_velocity"].values, full["angular_velocity"])
        assert read["attitude"].attrs["estimated_error"] == full.error["attitude"]
        assert [str(name) for name in np.char.decode(read["regime"].values.astype("S"))] == full["regime"].tolist()


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_a_figure_is_written(full: Answer, tmp_path: Path, ending: str) -> None:
    pytest.importorskip("matplotlib")
    file = tmp_path / f"answer.{ending}"
    figure = full.plot(file)
    assert file.stat().st_size > 5000
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert any("N m s" in label for label in labels) and any("rad/s" in label for label in labels)
    assert "full" in figure.get_suptitle() and "time [" in figure.axes[4].get_xlabel()


def test_a_figure_of_averages_and_of_one_time(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    gyrostat.solve(BRAKE, model="averaged").plot(tmp_path / "a.png")
    gyrostat.solve(BRAKE, times=[5.0]).plot(tmp_path / "b.png")
    with pytest.raises(gyrostat.DomainError, match="unknown ending"):
        gyrostat.solve(BRAKE).plot(tmp_path / "c.xyz")


def test_what_a_rung_cannot_compute_is_refused() -> None:
    with pytest.raises(gyrostat.DomainError, match="equal-torque"):
        gyrostat.solve(BRAKE, model="equal-torque")


def test_over_the_tolerance_it_answers_with_met_false() -> None:
    answer = gyrostat.solve(BRAKE, model="averaged", tolerance=1e-12)
    assert not answer.met and answer.model == "averaged" and answer.greatest_error > 1e-12


@pytest.mark.skipif(gyrostat.build_info()["cvode"] is None, reason="CVODE is not built in")
def test_two_runs_of_cvode_that_take_few_steps_do_not_err_alike() -> None:
    braked = {
        "name": "braked", "kind": "deceleration", "body": {"inertia": [33474878.579353657, 22791510.39975971, 17838443.942656543]},
        "torque": {"control": [3279030.006157543] * 3, "drag": 0.0, "law": "carrier"},
        "initial": {"angular_velocity": [0.15289573771679002, -5.899442072838917e-10, -8.725488402725852e-17],
                    "attitude": [-0.20172224072202782, 0.7445030553193919, -0.32333404093591006, 0.5481591340023716]},
        "solve": {"times": [0.0, 0.78, 1.4, 1.545, 1.5593, 1.56087, 1.56243, 2.34], "ask": ["attitude"], "model": "full"}}
    truth = gyrostat.solve(braked, tolerance=1e-11)
    for tolerance in (1e-2, 7.7e-4, 1e-4, 1e-6):
        answer = gyrostat.solve(braked, tolerance=tolerance, integrator="cvode")
        off = np.max(angle_between(answer["attitude"], truth["attitude"]))
        assert off <= answer.error["attitude"], tolerance


def test_printing_an_answer_prints_its_report() -> None:
    text = str(gyrostat.solve("tiangong-1"))
    assert "What was tried" in text and "stop_time" in text
