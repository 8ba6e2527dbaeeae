# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 to 24 of the paper on the thrusting, charged spinning body, and our own: what they are drawn from, and that they are drawn."""

import math
from pathlib import Path

import numpy as np
import pytest
from conftest import drawn_by_command

import gyrostat
from gyrostat import _core, gallery, spinning
from gyrostat.families.spinning import gallery as pictures
from gyrostat.families.spinning.gallery import SWEEPS, Case, run

# nu, period, greatest p, q, psi, least and greatest phi, greatest G2, v2, x1, x2 at 50 s, slope of v2/v3, to the digits given
TABLE = {
    ("rotor", 0): (".19673", "31.94", "2.337", "4.662", "15.21", "-8.25", "7.51", "32.60", "39.74", "255.6", "1250.1", "3.411"),
    ("rotor", 1): (".23141", "27.15", "1.987", "3.969", "13.69", "-5.71", "6.72", "32.23", "41.41", "241.4", "1162.0", "3.181"),
    ("rotor", 2): (".26609", "23.61", "1.728", "3.454", "12.19", "-1.73", "2.29", "31.84", "39.24", "219.3", "1093.2", "2.980"),
    ("charge", 0): (".21916", "28.67", "2.098", "4.189", "14.24", "-6.94", "7.46", "29.64", "40.93", "246.8", "1190.1", "3.259"),
    ("charge", 2): (".17430", "36.05", "2.638", "5.257", "16.13", "-7.38", "9.35", "35.94", "41.04", "269.8", "1320.3", "3.578"),
}


def test_the_figures_are_listed() -> None:
    assert "spinning" in gallery.papers()
    names = gallery.figures("spinning")
    assert names == [*(str(n) for n in range(2, 25)), "validity", "resonance"]
    assert [name for name, _ in pictures.drawings(["3"])] == [name for name, _ in pictures.drawings(["2"])] == ["spinning-figures-2-3"]
    files = [name for name, _ in pictures.drawings(names)]
    assert len(files) == len(set(files)) == 19
    assert files[:4] == ["spinning-figures-2-3", "spinning-figures-4-5", "spinning-figures-6-7", "spinning-figure-8"]
    assert files[-2:] == ["spinning-validity", "spinning-resonance"]


@pytest.mark.parametrize(("sweep", "place"), TABLE)
def test_the_right_curves_have_the_numbers_of_the_linear_motion(sweep: str, place: int) -> None:
    case = SWEEPS[sweep].cases[place]
    given = case.given()
    _, problem = spinning.problems(given)
    exact = _core.spinning_published(problem, reading="exact", t=np.array([1.0]))
    made = run(case, "linear", 50.0, 50001)
    nu, (ratio1, ratio2) = exact["nutation"], exact["secular_velocity_ratio"]
    (p, q), (psi, phi, _) = made.rates.max(axis=0), made.angles.max(axis=0)
    numbers = (nu, 2 * math.pi / nu, p, q, psi, made.angles[:, 1].min(), phi, made.momentum[:, 1].max(), made.velocity[-1, 1],
               *made.position[-1, :2], ratio2)
    for number, printed in zip(numbers, TABLE[sweep, place], strict=True):
        digits = len(printed.split(".")[1])
        assert number == pytest.approx(float(printed), abs=0.51 * 10.0**-digits)
    assert ratio1 == 0.0
    assert made.velocity[-1, 2] == pytest.approx(15.0) and made.position[-1, 2] == pytest.approx(375.0)
    np.testing.assert_allclose(made.angles[:, 2], case.spin * made.t, rtol=1e-13)
    assert made.rates[:, 1].min() >= 0.0


def test_the_right_curves_are_proportional_to_the_torque() -> None:
    base = run(SWEEPS["torque"].cases[0], "linear")
    for case, factor, slope in zip(SWEEPS["torque"].cases, (1.0, 1.125, 1.25), (3.411, 3.837, 4.264), strict=True):
        made = run(case, "linear")
        for name in ("rates", "angles", "momentum", "velocity", "position"):
            np.testing.assert_allclose(getattr(made, name)[:, :2], factor * getattr(base, name)[:, :2], rtol=1e-11, atol=1e-11)
        given = {key: value for key, value in case.given().items() if key not in ("mass", "velocity", "position")}
        assert spinning.secular_velocity_ratio(**given) == pytest.approx([0.0, slope], abs=5e-4)


def test_the_exact_reading_is_the_linear_motion_and_the_printed_one_is_not() -> None:
    t = np.linspace(0.5, 50.0, 100)
    _, problem = spinning.problems(Case().given())
    exact, printed = (_core.spinning_published(problem, reading=reading, t=t) for reading in ("exact", "printed"))
    linear = spinning.linear(**Case().given(), t=t)
    for name, wanted in (("rates", linear.angular_velocity[:, :2]), ("tilt", linear.euler_312[:, :2]), ("velocity", linear.velocity),
                         ("momentum", linear.angular_momentum_inertial[:, :2]), ("position", linear.position)):
        np.testing.assert_allclose(exact[name], wanted, rtol=1e-9, atol=1e-9)
    assert printed["nutation"] / exact["nutation"] - 1 == pytest.approx(-0.0120, abs=1e-4)
    assert np.max(np.linalg.norm(exact["momentum"] - printed["circle"], axis=1)) == pytest.approx(4.6, abs=0.05)
    assert printed["secular_velocity_ratio"][1] == pytest.approx(4.508, abs=1e-3)
    assert (printed["circle_radius"], exact["circle_radius"]) == pytest.approx((4.25, 14.15), abs=5e-3)
    for case, radius in zip(SWEEPS["torque"].cases, (14.15, 15.92, 17.68), strict=True):
        G = run(case, "printed").circle
        np.testing.assert_allclose(np.hypot(G[:, 0], G[:, 1] - case.torque / case.spin), radius, atol=0.01)
    # (61) is not zero at t = 0, and explodes where r0 - nu is small
    assert run(SWEEPS["rotor"].cases[0], "printed").position[0, 1] == pytest.approx(-7.46, abs=0.01)
    assert run(SWEEPS["rotor"].cases[2], "printed").position[0, 1] == pytest.approx(-448.5, abs=0.5)
    with pytest.raises(gyrostat.DomainError, match="reading = 'mine'"):
        _core.spinning_published(problem, reading="mine", t=t)


def test_the_data_of_the_paper_are_no_small_angles() -> None:
    assert pictures.late(Case(), 0.3) == pytest.approx(1.15, abs=0.01)
    assert pictures.late(Case(), 1.0) == pytest.approx(2.11, abs=0.01)
    linear, full = run(Case(), "linear"), run(Case(), "full")

    def part(name: str, i: int) -> float:
        is_, true = getattr(linear, name)[:, i], getattr(full, name)[:, i]
        return float(np.max(np.abs(is_ - true)) / np.max(np.abs(true)))

    for name, i, wanted, margin in (("rates", 0, 1.9, 0.1), ("angles", 0, 10.0, 0.6), ("momentum", 0, 1.5, 0.1), ("velocity", 1, 42.0, 1.0),
                                    ("position", 1, 67.0, 1.0), ("velocity", 2, 11.5, 0.2)):
        assert part(name, i) == pytest.approx(wanted, abs=margin), name
    small = pictures._errors(Case(torque=0.01), 50.0)
    smaller = pictures._errors(Case(torque=0.005), 50.0)
    for name in small:
        assert math.log2(small[name] / smaller[name]) == pytest.approx(2.0, abs=0.1), name
    fast = pictures._errors(Case(spin=120.0 * pictures.RPM), 50.0)
    assert fast["ψ, φ"] == pytest.approx(0.0065, rel=0.1) and fast["G₁, G₂"] == pytest.approx(0.028, rel=0.1)


@pytest.mark.parametrize("resonance", pictures.RESONANCES, ids=lambda resonance: resonance.title)
def test_the_resonance_figure_keeps_all_digits_of_ours(resonance: pictures.Resonance) -> None:
    for detuning in (0.1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-12, 0.0):
        for _, ours in pictures.losses(resonance, detuning, 10.0).values():
            assert ours <= 2e-13
    theirs = {name: loss[0] for name, loss in pictures.losses(resonance, 1e-7, 10.0).items()}
    assert theirs["position"] > 1e-9
    assert not all(math.isfinite(loss[0]) for loss in pictures.losses(resonance, 0.0, 10.0).values())


@pytest.mark.parametrize(("figure", "name"), [("2", "spinning-figures-2-3.png"), ("13", "spinning-figures-12-13.png"),
                                              ("11", "spinning-figure-11.png"), ("21", "spinning-figure-21.png")])
def test_a_figure_is_drawn(figure: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    drawn_by_command(figure, name, tmp_path, capsys, figure == "11")


def test_every_figure_says_what_is_seen() -> None:
    for group in pictures.GROUPS:
        for number in group.numbers:
            assert any(f"Fig. {number}:" in text for text in group.seen)
    for numbers, (_, seen) in pictures.MOMENTA.items():
        assert all(any(f"Fig. {number}:" in text for text in seen) for number in numbers)
