# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the papers: what they are drawn from, and that they are drawn."""

import math
from pathlib import Path

import numpy as np
import pytest
from conftest import at_length, drawn_by_command

import gyrostat
from gyrostat import _core
from gyrostat import gallery as galleries
from gyrostat.families.deceleration import gallery


def test_all_figures_from_3_to_25_are_there() -> None:
    assert "deceleration" in galleries.papers()
    assert galleries.figures("deceleration") == [str(number) for number in range(3, 26)]


@pytest.mark.parametrize("case", [case for group in gallery.GROUPS if not group.gyrostat for case in group.cases],
                         ids=lambda case: f"{case.label}, {case.sigma}")
def test_the_corrected_equations_stop_with_the_averaged_model(case: gallery.Case) -> None:
    answer = gyrostat.solve(gallery._scene(case, False, 1e-5, 2.0, "averaged"))
    stop = answer.scalars["stop_time"] * 1e-5 / case.data().time_unit
    corrected = gallery._corrected(case)
    if corrected.modulus_squared[-1] < 0.999:  # else the separatrix ended them
        assert corrected.t[-1] == pytest.approx(stop, rel=2e-3)
    else:
        assert corrected.t[-1] == pytest.approx(0.257, abs=1e-3)
        assert stop == pytest.approx(0.679, abs=1e-3)


@pytest.mark.parametrize("case", gallery.GROUPS[0].cases, ids=lambda case: case.label)
def test_the_averaged_gyrostat_moves_as_the_full_one(case: gallery.Case) -> None:
    averaged, full = (gyrostat.solve(gallery._scene(case, True, 0.01, 1.2, model)) for model in ("averaged", "full"))
    unit = case.data().momentum_unit
    assert np.max(np.abs(averaged["angular_momentum_norm"] - full["angular_momentum_norm"])) < 1e-3 * unit
    assert full["energy"][-1] > 1e4 * full["energy"][0]


def test_as_printed_the_modulus_leaves_its_interval_at_once() -> None:
    for group in gallery.GROUPS[:3]:
        for case in group.cases:
            run = _core.published_run(case.data(), reading="printed", modulus_squared=0.99, end=1.0, samples=11)
            assert run.ended
            assert run.t[-1] < 1.5e-4
            assert run.modulus_squared[-1] > 0.9999
            assert len(run.t) == len(run.energy) == len(run.momentum) == 11


def test_the_start_lies_on_the_polhode_of_the_paper() -> None:
    start = gallery._polhode_start(100.0, 0.99)
    assert math.hypot(*start) == pytest.approx(100.0)
    made = _core.deceleration_polhode_start(inertia=gallery.INERTIA, control=(1.0, 1.0, 1.0), angular_momentum=start)
    assert (made.regime, made.modulus_squared) == ("A", pytest.approx(0.99))


@pytest.mark.parametrize(("figure", "name"), [(6, "deceleration-figures-5-7.png"), (24, "deceleration-figures-23-25.png"), *at_length([], [(4, "deceleration-figure-4.png")])])
def test_a_figure_is_drawn(figure: int, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    drawn_by_command(str(figure), name, tmp_path, capsys, figure == 24)


@pytest.mark.parametrize(("paper", "figure", "words"), [("comet", None, "paper = 'comet'"), ("deceleration", "2", "figure = '2'"),
                                                        ("deceleration", "all", "figure = 'all'")])
def test_what_is_not_there_is_refused(paper: str, figure: str | None, words: str, tmp_path: Path) -> None:
    with pytest.raises(gyrostat.DomainError, match=words):
        galleries.reproduce(paper, figure, tmp_path)


def test_bad_arguments_of_the_published_equations_are_refused() -> None:
    data = gallery.GROUPS[0].cases[0].data()
    for changes in ({"reading": "mine"}, {"modulus_squared": 1.0}, {"modulus_squared": math.nan}, {"end": 0.0}, {"samples": 1}):
        with pytest.raises(gyrostat.DomainError, match=next(iter(changes))):
            _core.published_run(data, **{"reading": "printed", "modulus_squared": 0.5, "end": 1.0, "samples": 3, **changes})
    with pytest.raises(gyrostat.DomainError, match="modulus_squared"):
        _core.published_stationary_ratio(1.0, 1.0)
    with pytest.raises(gyrostat.DomainError, match="modulus_squared"):
        _core.deceleration_torque_balance(1.5)
