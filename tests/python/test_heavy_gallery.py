# SPDX-License-Identifier: BSD-3-Clause
"""The tables and formulas of the paper on heavy bodies: what their pictures are drawn from, and that they are drawn."""

import math
from pathlib import Path
from typing import Any

import gyrostat
import numpy as np
import pytest
from conftest import drawn_by_command
from gyrostat import _core, gallery, heavy
from gyrostat.families.heavy import gallery as pictures
from gyrostat.families.heavy.gallery import BODY, COSINE, FREQUENCY, angles, errors, late_errors, oscillator, printed_table, published, units_off


def test_the_figures_are_listed() -> None:
    assert "heavy" in gallery.papers()
    names = gallery.figures("heavy")
    assert names == ["table-1", "table-2", "readings", "corrections"]
    assert [name for name, _ in pictures.drawings(names)] == [f"heavy-{name}" for name in names]
    assert [name for name, _ in pictures.drawings(["readings"])] == ["heavy-readings"]


@pytest.mark.parametrize("number", [1, 2])
def test_a_table_is_met_to_its_last_digits(number: int) -> None:
    texts, printed = printed_table(number)
    assert len(texts) == 31 and printed.shape == (31, 5)
    np.testing.assert_array_equal(printed[:, 0], 10.0 * np.arange(31))
    off = np.abs(units_off(number))
    assert off[:, 0].max() == 0.0
    # single precision in the argument; E known to six digits
    limits = (2.6, 1.1, 1.0, 0.8) if number == 1 else (0.8, 1.2, 1.9, 1.2)
    assert np.all(off[:, 1:].max(axis=0) < limits)
    if number == 1:
        assert np.sum(off[:, 1:] <= 0.5) == 78
    millionths = np.abs(_core.heavy_published_table(number) - printed)[:, 1:].max(axis=0) / 1e-6
    assert np.all(millionths < ((4.6, 1.1, 4.9, 0.8) if number == 1 else (29.0, 1.2, 3.7, 1.2)))
    with pytest.raises(gyrostat.DomainError, match="number = 3"):
        _core.heavy_published_table(3)


def test_table_1_is_a_cosine_four_times() -> None:
    x = math.pi * np.arange(31) / 5
    np.testing.assert_allclose(_core.heavy_published_table(1)[:, 1:], np.column_stack([np.cos(x), np.cos(x), -np.sin(x), -np.sin(x)]), atol=1e-14)
    texts, _ = printed_table(1)
    # the printed sines of n pi are what rounding n pi to single precision leaves, to a unit in its last place
    for n in range(1, 7):
        argument = np.float32(n * math.pi)
        near = [np.nextafter(argument, np.float32(side)) for side in (0.0, 100.0)] + [argument]
        assert min(abs(-math.sin(float(x)) - float(texts[5 * n][4])) for x in near) < 1e-12


def test_table_2_is_a_runge_kutta_method_on_two_oscillators() -> None:
    ours, (_, printed) = _core.heavy_published_table(2), printed_table(2)
    np.testing.assert_allclose(oscillator(1.0, 20), ours[:, [2, 4]], atol=1e-13)
    np.testing.assert_allclose(oscillator(FREQUENCY, 20), ours[:, [1, 3]], atol=1e-13)

    def miss(frequency: float, steps: float, columns: list[int]) -> float:
        return float(np.max(np.abs(oscillator(frequency, steps) - printed[:, columns])))

    assert miss(1.0, 20, [2, 4]) < 1.2e-6
    assert miss(1.0, 19, [2, 4]) == pytest.approx(3.3e-4, rel=0.01) and miss(1.0, 21, [2, 4]) == pytest.approx(2.6e-4, rel=0.02)
    assert miss(FREQUENCY, 20, [1, 3]) < 3e-5
    assert miss(1.0, 20, [1, 3]) == pytest.approx(0.0735, abs=1e-4)
    for off in (-1e-5, 1e-5):
        assert miss(FREQUENCY + off, 20, [1, 3]) > 3 * miss(FREQUENCY, 20, [1, 3])
    period = oscillator(1.0, 20)[10]
    assert math.hypot(*period) - 1 == pytest.approx(-1.32e-4, abs=1e-6)
    assert math.atan2(period[1], period[0]) == pytest.approx(4.92e-4, abs=1e-6)  # late: y' is still positive


def test_the_tables_do_not_agree_with_each_other() -> None:
    apart = np.abs(printed_table(2)[1] - printed_table(1)[1])
    assert apart[28, 1] == apart[:, 1].max() == pytest.approx(0.0677, abs=1e-4)
    assert apart[:, 3].max() == pytest.approx(0.0750, abs=1e-4)
    assert apart[:, 2].max() == pytest.approx(1.42e-3, abs=1e-5)


@pytest.mark.parametrize(("spin", "rates", "axial", "down"), [(0.01, 0.586, 51.9, 1.99), (0.1, 0.65, 6.41, 1.99), (1.0, 1.54, 0.693, 1.35),
                                                            (10.0, 17.1, 121.0, 1.18)])
def test_as_the_paper_reads_mu_its_formulas_hold_nowhere(spin: float, rates: float, axial: float, down: float) -> None:
    assert errors(spin, "printed")[:3] == pytest.approx((rates, axial, down), rel=0.01)


def test_with_mu_turned_over_they_hold_for_a_fast_spin() -> None:
    fast, faster = (np.array(errors(r0, "reciprocal")) for r0 in (10.0, 100.0))
    assert math.log10(fast[1] / faster[1]) == pytest.approx(2.0, abs=0.02)
    assert math.log10(fast[2] / faster[2]) == pytest.approx(2.0, abs=0.02)
    right, righter = (np.array(errors(r0, "corrected")) for r0 in (10.0, 100.0))
    for part, order in enumerate((3, 4, 4, 4)):
        assert math.log10(right[part] / righter[part]) == pytest.approx(order, abs=0.05)
    # sin(theta0) = 1 in p and q: chi (1 - M3) c/r0 and as much of q
    assert faster[0] > 30 * righter[0]
    assert all(math.isnan(x) for x in errors(0.5, "corrected"))
    np.testing.assert_allclose(errors(1.0, "printed"), errors(1.0, "reciprocal"), rtol=1e-14)  # c = 1 but for a rounding: mu and 1/mu are one


@pytest.mark.parametrize(("form", "wanted"), [("reciprocal", (9.39e-3, 9.09e-2, 0.876, 1.97)), ("corrected", (2.12e-5, 2.05e-4, 2.04e-3, 2.04e-2)),
                                              ("order 8", (3.92e-12, 3.78e-11, 3.77e-10, 3.77e-9))])
def test_the_error_grows_with_the_revolutions(form: str, wanted: tuple[float, ...]) -> None:
    assert [late_errors(20.0, form, n)[2] for n in (1, 10, 100, 1000)] == pytest.approx(list(wanted), rel=0.01)


def test_the_printed_period() -> None:
    true = heavy.periodic_orbit(**BODY, spin=20.0, cos_inclination=COSINE).period
    alpha, printed = 20.0 * float(true) - 2 * math.pi, 20.0 * published(20.0, "reciprocal", np.zeros(1))["period"] - 2 * math.pi
    assert (alpha, printed) == pytest.approx((9.122e-3, 8.905e-3), abs=1e-6)
    # as the paper reads mu a slow revolution takes 2 pi/r0: the true motions have periods of their own
    assert published(0.01, "printed", np.zeros(1))["period"] == pytest.approx(200 * math.pi, rel=1e-3)
    assert 2 * math.pi / heavy.hanging(**BODY).frequency == pytest.approx([6.0277, 4.8827], abs=2e-4)


def test_the_printed_angles() -> None:
    t = np.linspace(0.0, 0.3 * math.pi, 301)
    true, printed, corrected = angles(20.0, t), published(20.0, "reciprocal", t)["angles"], pictures._corrected_angles(20.0, t)
    assert np.all(np.max(np.abs(corrected - true), axis=0) < (1e-5, 1e-4, 1e-4))
    assert np.max(np.abs(printed - true), axis=0) == pytest.approx((2.86e-3, 6.58e-2, 3.05e-2), rel=0.01)
    assert np.max(np.abs(printed[:, 0] + true[:, 0])) < 1e-4  # theta has the wrong sign
    assert true[-1, 1] / t[-1] == pytest.approx(float(heavy.series(**BODY, spin=20.0, cos_inclination=COSINE, t=t).precession_rate), rel=2e-3)


def test_what_is_refused() -> None:
    _, body, _ = heavy.bodies(BODY)
    good: dict[str, Any] = {"spin": 20.0, "cos_inclination": 0.1, "reading": "printed", "t": np.zeros(1)}
    for changed, words in (({"reading": "mine"}, "reading = 'mine'"), ({"spin": 0.0}, "spin = 0"), ({"cos_inclination": 1.0}, "cos_inclination = 1"),
                           ({"t": np.array([math.nan])}, "t = ")):
        with pytest.raises(gyrostat.DomainError, match=words):
            _core.heavy_published_run(body, **{**good, **changed})
    _, weightless, _ = heavy.bodies({**BODY, "gravity": 0.0})
    with pytest.raises(gyrostat.DomainError, match="weight"):
        _core.heavy_published_run(weightless, **good)


@pytest.mark.usefixtures("few_members")
@pytest.mark.parametrize("figure", ["table-1", "table-2", "readings", "corrections"])
def test_a_figure_is_drawn(figure: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    drawn_by_command(figure, f"heavy-{figure}.png", tmp_path, capsys, figure == "table-1")
