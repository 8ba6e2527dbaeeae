# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 and 3 of the paper on the motor of limited power, and our own: what they are drawn from, and that they are drawn."""

import math
from pathlib import Path

import numpy as np
import pytest
from conftest import drawn_by_command

import gyrostat
from gyrostat import _core, gallery, rotor
from gyrostat.families.rotor import gallery as pictures


def test_the_figures_are_listed() -> None:
    assert "rotor" in gallery.papers()
    names = gallery.figures("rotor")
    assert names[:2] == ["2", "3"] and "basins" in names
    assert [name for name, _ in pictures.drawings(["2"])] == [name for name, _ in pictures.drawings(["3"])] == ["rotor-figures-2-3"]


def test_the_printed_system_falls_until_six_seconds_and_grows_then() -> None:
    t = np.linspace(0.0, 20.0, 2001)
    size = np.linalg.norm(_core.rotor_published_run(reading="printed", times=t)[:, :2], axis=1)
    least = int(np.argmin(size))
    assert t[least] == pytest.approx(6.07, abs=0.05) and size[least] == pytest.approx(0.24, abs=0.01)
    assert size[-1] == pytest.approx(5.4e3, rel=0.02)
    values = np.sort(np.linalg.eigvals(_core.rotor_published_matrix("printed")).real)
    assert values == pytest.approx([-2.802, -0.729, 0.741], abs=1e-3)
    part, start, slow = pictures.growing_part()
    assert part == pytest.approx(1.33e-3, rel=0.01)
    assert start == pytest.approx(1.1) and slow == pytest.approx(1.1034, abs=1e-3)


def test_the_run_solves_its_equations() -> None:
    t = np.linspace(0.0, 5.0, 20001)
    for reading in ("printed", "corrected", "repaired", "realisable"):
        run = _core.rotor_published_run(reading=reading, times=t)
        assert run[0] == pytest.approx(pictures.START)
        slope = np.gradient(run[:, :3], t, axis=0, edge_order=2)
        wanted = run[:, :3] @ _core.rotor_published_matrix(reading).T
        np.testing.assert_allclose(slope[1:-1], wanted[1:-1], atol=2e-5)


def test_only_the_repaired_data_describe_a_steady_rotation() -> None:
    for reading, steady in (("printed", False), ("repaired", True), ("realisable", True)):
        data = _core.rotor_published_data(reading)
        h = data["axial_inertia"] * np.nan_to_num(data["no_load_rate"])
        off = data["spin_rate"] * data["inertia"] * data["direction"] - data["momentum"] * data["direction"] + h * data["axis"]
        assert (np.linalg.norm(off) < 1e-12) == steady
    found = rotor.steady_rotations(**pictures._body("repaired"), momentum=7.0)
    values = np.sort_complex(np.linalg.eigvals(_core.rotor_published_matrix("repaired")))
    np.testing.assert_allclose(np.sort_complex(found.eigenvalues[0]), values, rtol=1e-9)
    assert np.linalg.eigvals(_core.rotor_published_matrix("corrected")).real.max() == pytest.approx(0.0137, abs=1e-4)


def test_the_full_motion_of_the_repaired_data_is_the_linear_one() -> None:
    t = np.linspace(0.0, 30.0, 301)
    linear = _core.rotor_published_run(reading="repaired", times=t)
    errors = []
    for share in (1e-4, 1e-5):
        full = pictures._full(pictures._body("repaired"), 7.0, np.array([0.0, 0.0, 1.0]), 1.0, t, [share * x for x in pictures.START])
        errors.append(np.max(np.abs(full / share - linear)))
    assert errors[0] < 0.2
    assert math.log10(errors[0] / errors[1]) == pytest.approx(1.0, abs=0.15)


def test_the_linear_solution_of_the_gallery_is_of_first_order() -> None:
    body = pictures._body("realisable")
    steady = rotor.steady_rotations(**body, momentum=7.0)
    m0, psi_dot = steady.direction[0], float(steady.spin_rate[0])
    across, _ = pictures._frame(m0)
    t = np.linspace(0.0, 100.0, 201)
    errors = []
    for size in (1e-2, 1e-3):
        start = math.cos(size) * m0 + math.sin(size) * across
        Omega = (7.0 * start - body["axial_inertia"] * body["no_load_rate"] * body["axis"]) / body["inertia"]
        full = rotor.solve(**body, angular_velocity=Omega, rotor_rate=body["no_load_rate"], times=t, tolerance=1e-11, model="full")
        m, P = pictures._linear(body, 7.0, m0, psi_dot, start, t)
        errors.append((np.max(np.abs(full["angular_momentum"] / 7.0 - m)),
                       np.max(gyrostat.rotation.angle_between(full["attitude"], gyrostat.rotation.quaternion_from_matrix(P)))))
    orders = np.log10(np.array(errors[0]) / np.array(errors[1]))
    assert orders == pytest.approx([2.0, 2.0], abs=0.15)


@pytest.mark.parametrize(("figure", "name"), [("2", "rotor-figures-2-3.png"), ("spin-up", "rotor-spin-up.png"),
                                              ("rate-vs-slope", "rotor-rate-vs-slope.png"), ("circular-section", "rotor-circular-section.png")])
def test_a_figure_is_drawn(figure: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    drawn_by_command(figure, name, tmp_path, capsys, figure == "spin-up")


def test_an_unknown_reading_is_refused() -> None:
    with pytest.raises(gyrostat.DomainError, match="reading = 'mine'"):
        _core.rotor_published_data("mine")
