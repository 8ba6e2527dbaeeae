# SPDX-License-Identifier: BSD-3-Clause
"""The paper on heavy bodies in a "new domain of angular velocity": its two tables again, and what its formulas are worth. It has no figures."""

import csv
import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core, heavy, rotation
from gyrostat.drawing import COLOURS, Drawing, finish, new_figure
from gyrostat.errors import ConvergenceError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["angles", "drawings", "errors", "figures", "late_errors", "oscillator", "printed_table", "units_off"]

Vectors = NDArray[np.float64]

PAPER: Final = "heavy"
COLUMNS: Final = ("p₂", "γ₂", "dp₂/dt", "dγ₂/dt")
AMPLITUDE: Final = 1.88117e-15  # of p2; table 2 rounds it to five digits
FREQUENCY: Final = 0.996079  # of p2 in table 2

# A body with a pendulum rate c of 1 rad/s: the spin in rad/s is r0/c.
BODY: Final[dict[str, Any]] = {"inertia": (0.55, 0.8, 1.0), "mass": 1.0, "centre_of_mass": (0.6 / 128, 0.48 / 128, 0.64 / 128),
                               "gravity": 128.0, "gravity_gradient": 0.7}
COSINE: Final = 0.1  # of theta0: the paper wants it small
DATA: Final = "a = 0.55, b = 0.8, k = 0.7, mass centre along (0.6, 0.48, 0.64), cos θ₀ = 0.1"


def figures() -> list[str]:
    """The tables of the paper, and names of our own."""
    return list(DRAWN)


def drawings(wanted: Sequence[str]) -> list[Drawing]:
    """What draws these figures, a file each."""
    return [(f"{PAPER}-{name}", draw) for name, draw in DRAWN.items() if name in wanted]


# ---- the tables ----


@lru_cache(maxsize=2)
def printed_table(number: int) -> tuple[tuple[tuple[str, ...], ...], Vectors]:
    """Rows of table 1 or 2 as printed: t, p2, gamma2 and their rates; and as numbers (31, 5), p2 and its rate over AMPLITUDE."""
    with Path(__file__).with_name("published.csv").open(encoding="utf-8", newline="") as file:
        texts = tuple(tuple(row[1:]) for row in csv.reader(file) if row[0] == str(number))
    values = np.array(texts, dtype=float)
    values[:, [1, 3]] /= AMPLITUDE
    return texts, values


def oscillator(frequency: float, steps: float) -> Vectors:
    """y and y' (31, 2) of y'' = -frequency^2 y, y(0) = 1, y'(0) = 0, by the classical Runge-Kutta method, every tenth of 2 pi, that
    many steps to 2 pi; between steps by a part of the step's factor."""
    z = 1j * frequency * 2.0 * math.pi / steps
    # one step multiplies y - i y'/frequency by the first five terms of exp(z)
    made = (1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))) ** (np.arange(31) * steps / 10.0)
    return np.column_stack([made.real, -frequency * made.imag])


def units_off(number: int) -> Vectors:
    """Our numbers less the printed ones (31, 5), in units of the last digit printed; those under a tenth of the amplitude, in its millionths."""
    texts, printed = printed_table(number)
    scale = np.where(np.isin(np.arange(5), (1, 3)), AMPLITUDE, 1.0)
    values = np.array(texts, dtype=float)
    digits = np.where(np.isin(np.arange(5), 1) & (number == 2), 5, 6)
    with np.errstate(divide="ignore"):
        unit = 10.0 ** (np.floor(np.log10(np.abs(values))) + 1 - digits)
    unit = np.where(np.abs(printed) < 0.1, 1e-6 * scale, unit)
    made: Vectors = (_core.heavy_published_table(number) - printed) * scale / unit
    return made


def _write_table(axes: "Axes", number: int) -> None:
    """The printed numbers, and in orange how many units of the last digit ours are off where rounding does not explain it."""
    texts, _ = printed_table(number)
    off = units_off(number)
    axes.axis("off")
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(len(texts) - 0.2, -1.2)
    places = (0.0, 0.07, 0.31, 0.54, 0.79)
    for x, word in zip(places, ("t", *COLUMNS), strict=True):
        axes.text(x, -0.8, word, fontsize=10, weight="bold", va="center")
    for i, row in enumerate(texts):
        for j, (x, text) in enumerate(zip(places, row, strict=True)):
            axes.text(x, i, text, fontsize=8.5, family="monospace", va="center")
            if abs(off[i, j]) > 0.5:
                axes.text(x + 0.155, i, f"{off[i, j]:+.1f}", fontsize=8, family="monospace", va="center", color="#D55E00")
    axes.set_title("as printed; orange: ours less printed, over half a unit of the last digit", loc="left", fontsize=10)


def _curves(axes: "Axes") -> None:
    _, printed = printed_table(1)
    for j, (name, colour) in enumerate(zip(COLUMNS, COLOURS, strict=False), 1):
        ring = j in (1, 3)
        axes.plot(printed[:, 0], printed[:, j], "o", color=colour, markersize=9 if ring else 4, markerfacecolor="none" if ring else colour,
                  label=f"{name}, printed")
    fine = np.linspace(0.0, 300.0, 901)
    axes.plot(fine, np.cos(math.pi * fine / 50), color="#555555", linewidth=0.8, label="cos 2πt/100, −sin 2πt/100")
    axes.plot(fine, -np.sin(math.pi * fine / 50), color="#555555", linewidth=0.8)
    axes.set_title("p₂ and dp₂/dt over 1.88117e-15", loc="left", fontsize=10)
    _furnish(axes, "t as printed, 2π of τ to 100", "[1]")
    _crown(axes, 3)


def _misses(axes: "Axes", number: int) -> None:
    _, printed = printed_table(number)
    ours = _core.heavy_published_table(number)
    for j, (name, colour) in enumerate(zip(COLUMNS, COLOURS, strict=False), 1):
        axes.plot(printed[:, 0], (ours[:, j] - printed[:, j]) / 1e-6, "o-", color=colour, markersize=3, linewidth=0.8, label=name)
    axes.set_title("ours less printed, p₂ and dp₂/dt over 1.88117e-15", loc="left", fontsize=10)
    _furnish(axes, "t as printed", "millionths of the amplitude")
    _crown(axes, 4)


def _furnish(axes: "Axes", x: str, y: str) -> None:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.25, which="both")


def _crown(axes: "Axes", columns: int) -> None:
    """A legend above the curves."""
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom, top + 0.25 * (top - bottom))
    axes.legend(fontsize=8, ncols=columns, loc="upper center")


def _table_1() -> "Figure":
    figure = new_figure(17.0, 10.5)
    panels = figure.subplot_mosaic([["table", "curves"], ["table", "misses"]], width_ratios=(1.25, 1.0))
    _write_table(panels["table"], 1)
    _curves(panels["curves"])
    _misses(panels["misses"], 1)
    finish(figure, "Table 1, “the obtained analytical solutions”, again: E cos x, cos x, −E sin x, −sin x with x = 2πt/100, E = 1.88117e-15", (
        "Four columns, one cosine: all numbers are met to 2.5 units of the last digit, and 78 of 124 to half a one; E is known to six "
        "digits, and x was rounded to single precision. p₂ and γ₂ turn at the same rate, so ω = 1, which only a lamina has and which the "
        "paper leaves out. No body and no μ is named, and by (33) p₂ should be zero.",
        "What is printed for sin nπ at t = 50 n, −1.50996e-07, 2.38498e-08, 6.75532e-07, is the rounding of nπ to single precision. The "
        "derivatives are taken over τ, not t, whose would be 16 times smaller. So the table says nothing of (14), (19) or (35)."))
    return figure


def _table_2() -> "Figure":
    figure = new_figure(17.0, 14.0)
    panels = figure.subplot_mosaic([["table", "misses"], ["table", "steps"], ["frequency", "apart"]], width_ratios=(1.25, 1.0),
                                   height_ratios=(1.0, 1.0, 1.0))
    _write_table(panels["table"], 2)
    _misses(panels["misses"], 2)
    _, printed = printed_table(2)
    axes = panels["steps"]
    steps = np.arange(12, 41)
    axes.semilogy(steps, [np.max(np.abs(oscillator(1.0, n) - printed[:, [2, 4]])) for n in steps.tolist()], "o-", color=COLOURS[1], markersize=4,
                  linewidth=0.8)
    axes.set_title("which steps: cos by the classical Runge-Kutta method against γ₂, dγ₂/dt", loc="left", fontsize=10)
    _furnish(axes, "steps to 2π of τ", "greatest difference [1]")
    axes = panels["frequency"]
    off = np.unique(np.concatenate([np.linspace(-0.005, 0.005, 201), FREQUENCY - 1.0 + np.linspace(-1e-4, 1e-4, 41), [0.0]]))
    for colour, name, columns in ((COLOURS[0], "p₂, dp₂/dt", [1, 3]), (COLOURS[1], "γ₂, dγ₂/dt", [2, 4])):
        axes.semilogy(1.0 + off, [np.max(np.abs(oscillator(1.0 + x, 20) - printed[:, columns])) for x in off.tolist()], color=colour,
                      linewidth=1.1, label=name)
    axes.axvline(FREQUENCY, color="#555555", linestyle=":", linewidth=1, label=f"{FREQUENCY}")
    axes.set_title("which frequency: twenty steps of the classical Runge-Kutta method to 2π", loc="left", fontsize=10)
    _furnish(axes, "frequency ω of the oscillator", "greatest difference [1]")
    axes.legend(fontsize=8)
    axes = panels["apart"]
    _, exact = printed_table(1)
    for j, (name, colour) in enumerate(zip(COLUMNS, COLOURS, strict=False), 1):
        axes.semilogy(printed[1:, 0], np.abs(printed[1:, j] - exact[1:, j]), "o-", color=colour, markersize=3, linewidth=0.8, label=name)
    axes.set_title("“full agreement”: table 2 less table 1", loc="left", fontsize=10)
    _furnish(axes, "t as printed", "[1]")
    axes.legend(fontsize=8, ncols=2)
    finish(figure, "Table 2, “the numerical solutions using fourth-order Runge-Kutta method”, again: y″ = −ω² y in steps of π/10", (
        "γ₂ is the classical Runge-Kutta method on y″ = −y with 20 steps to a period, to 1.2 in the last digit: 19 or 21 steps miss it by "
        "hundreds. p₂, printed to five digits, is the same method on another oscillator, ω = 0.996079: with the ω = 1 of table 1 it "
        "misses by 7 %.",
        "So p₂ of the tables drifts apart, 6.8 % at t = 280 and 7.5 % in its derivative, while γ₂ shows the error of the method, 5e-4 rad "
        "a period. A harmonic oscillator was integrated, twice, with two frequencies; the formulas of the paper are not in it."))
    return figure


# ---- the formulas ----

State = tuple[Vectors, Vectors]  # angular velocity (n, 3), down (n, 3)


def _printed(reading: str) -> Callable[[float, Vectors], State]:
    def made(spin: float, t: Vectors) -> State:
        values = published(spin, reading, t)
        return values["angular_velocity"], values["down"]
    return made


def _series(order: int) -> Callable[[float, Vectors], State]:
    def made(spin: float, t: Vectors) -> State:
        values = heavy.series(**BODY, spin=spin, cos_inclination=COSINE, t=t, order=order)
        return values.angular_velocity, values.down
    return made


def published(spin: float, reading: str, t: Vectors) -> dict[str, Any]:
    """The paper's formulas for BODY."""
    _, body, _ = heavy.bodies(BODY)
    made: dict[str, Any] = _core.heavy_published_run(body, spin=spin, cos_inclination=COSINE, reading=reading, t=t)
    return made


FORMS: Final[dict[str, Callable[[float, Vectors], State]]] = {
    "printed": _printed("printed"), "reciprocal": _printed("reciprocal"), "corrected": _series(2), "order 8": _series(8)}
READINGS: Final = {"printed": "μ⁻¹ = r₀/c as the paper says", "reciprocal": "μ⁻¹ = c/r₀"}
WORDS: Final = {**{form: f"printed, {words}" for form, words in READINGS.items()}, "corrected": "corrected closed form",
                "order 8": "series of order 8"}
DASHES: Final = {"printed": "-", "reciprocal": "-", "corrected": "--"}
COLOUR: Final = {"printed": 1, "reciprocal": 0, "corrected": 2, "order 8": 3}  # of COLOURS
PARTS: Final = ("p, q over c", "r over r₀", "γ, γ′", "γ″")


def _motion(rates: Vectors, down: Vectors, t: Vectors) -> State:
    """The full motion that starts there at t = 0, at the times."""
    made = heavy.integrate(**BODY, angular_velocity=rates, down=down / np.linalg.norm(down), times=t, order=30, tolerance=1e-18,
                           precision="long double")
    return made["angular_velocity"], made["down"]


def _parts(spin: float, form: State, true: State) -> tuple[float, ...]:
    w, d = (np.max(np.abs(a - b), axis=0) for a, b in zip(form, true, strict=True))
    return float(max(w[0], w[1])), float(w[2] / spin), float(max(d[0], d[1])), float(d[2])


def errors(spin: float, form: str, samples: int = 401) -> tuple[float, ...]:
    """Greatest errors of the PARTS over 2 pi/spin, against the full motion from where the form itself starts; NaN where the series fails."""
    t = np.linspace(0.0, 2.0 * math.pi / spin, samples)
    try:
        made = FORMS[form](spin, t)
    except ConvergenceError:
        return (math.nan,) * len(PARTS)
    return _parts(spin, made, _motion(made[0][0], made[1][0], t))


def late_errors(spin: float, form: str, revolution: int, samples: int = 41) -> tuple[float, ...]:
    """Greatest errors of the PARTS during one revolution, counted from 1, against the periodic motion."""
    t, *true = _periodic(spin, revolution, samples)
    return _parts(spin, FORMS[form](spin, t), (true[0], true[1]))


@lru_cache(maxsize=64)
def _periodic(spin: float, revolution: int, samples: int) -> tuple[Vectors, Vectors, Vectors]:
    """Times of a revolution, and the full motion from the periodic start."""
    start = heavy.periodic_orbit(**BODY, spin=spin, cos_inclination=COSINE)
    t = (revolution - 1 + np.linspace(0.0, 1.0, samples)) * (2.0 * math.pi / spin)
    return t, *_motion(start.angular_velocity, start.down, t)


def angles(spin: float, t: Vectors) -> Vectors:
    """theta, psi and phi (n, 3) of the periodic full motion, less what they are at the start; steps of t under half a turn."""
    start = heavy.periodic_orbit(**BODY, spin=spin, cos_inclination=COSINE)
    made = heavy.integrate(**BODY, angular_velocity=start.angular_velocity, attitude=_upright(start.down), times=t, tolerance=1e-14)
    return _angles_of(made["attitude"], made["down"])


def _angles_of(attitude: Vectors, down: Vectors) -> Vectors:
    tensor = rotation.matrix_from_quaternion(attitude)
    # psi goes round down, against the inertial axis 3
    made = np.column_stack([np.arccos(down[:, 2]), -np.unwrap(np.arctan2(tensor[:, 1, 2], tensor[:, 0, 2])),
                            np.unwrap(np.arctan2(down[:, 0], down[:, 1]))])
    turned: Vectors = made - made[0]
    return turned


def _upright(down: Vectors) -> Vectors:
    """An attitude with that down."""
    across = np.cross(down, np.eye(3)[np.argmin(np.abs(down))])
    across /= np.linalg.norm(across)
    quaternion: Vectors = rotation.quaternion_from_matrix(np.array([across, np.cross(-down, across), -down]))
    return quaternion


def _readings() -> "Figure":
    figure = new_figure(17.0, 10.5)
    panels = figure.subplots(2, 3)
    spins = np.geomspace(0.01, 100.0, 61)
    for form, least in (("printed", 0.0), ("reciprocal", 0.1), ("corrected", 1.0)):
        made = np.array([errors(r0, form) if r0 >= least else (math.nan,) * len(PARTS) for r0 in spins.tolist()])
        for axes, parts in zip(panels[0], ((0,), (1,), (2, 3)), strict=True):
            axes.loglog(spins, np.max(made[:, list(parts)], axis=1), color=COLOURS[COLOUR[form]], linestyle=DASHES[form], linewidth=1.4,
                        label=WORDS[form])
    for axes, title in zip(panels[0], ("p, q [c]", "r [r₀]", "γ, γ′, γ″"), strict=True):
        axes.axhline(1.0, color="#555555", linestyle=":", linewidth=1)
        axes.set_ylim(1e-9, 1e5)
        axes.set_title(f"{title}: greatest error over 2π/r₀", loc="left", fontsize=10)
        _furnish(axes, "spin r₀/c", "error [1]")
        axes.legend(fontsize=8)
    for axes, r0, form in ((panels[1, 0], 0.1, "printed"), (panels[1, 1], 5.0, "reciprocal")):
        t = np.linspace(0.0, 2.0 * math.pi / r0, 1001)
        formula = FORMS[form](r0, t)
        true = _motion(formula[0][0], formula[1][0], t)
        for i, name in ((0, "γ"), (2, "γ″")):
            axes.plot(t, true[1][:, i], color=COLOURS[i], linewidth=1.0, label=f"{name}, full motion")
            axes.plot(t, formula[1][:, i], color=COLOURS[i], linestyle="--", linewidth=1.6, label=f"{name}, (35)")
        axes.set_title(f"r₀ = {r0:g} c, {READINGS[form]}", loc="left", fontsize=10)
        _furnish(axes, "c t", "[1]")
        _crown(axes, 2)
    _periods(panels[1, 2])
    finish(figure, f"Both readings of μ against the full motion; {DATA}", (
        "The paper has μ = c/r₀ large and r₀ → 0. So read (top, orange) the formulas hold nowhere: the torque M g l does not vanish with "
        "the spin, r changes by its own size within r₀/c², and the direction is lost altogether: an error of 2 means opposite. At r₀ = c, "
        "where both readings meet, the errors are still as large as the motion.",
        "With μ⁻¹ = c/r₀ (blue) they hold for a fast spin, the classical case: r and γ err by the second power of c/r₀, put right (green) "
        "by the fourth; p and q by the third, until their sin θ₀ = 1 shows. Below, left, the printed γ against what the body does at r₀ "
        "= c/10; middle, the other reading at r₀ = 5 c.",
        "Right: a periodic motion of a slow spin does not take 2π/r₀. The fast family ends near r₀ = 0.59 c with periods that grow "
        "without bound; small swings about rest keep their two periods, 6.03/c and 4.88/c, however small r₀ is."))
    return figure


def _periods(axes: "Axes") -> None:
    family = heavy.periodic_family(**BODY, first_spin=20.0, cos_inclination=COSINE).members
    axes.loglog(family.angular_velocity[:, 2], family.period, color="black", linewidth=1.6, label="true, of the fast family")
    swings = 2.0 * math.pi / heavy.hanging(**BODY).frequency
    for i, period in enumerate(swings.tolist()):
        axes.axhline(period, color=COLOURS[2], linestyle=":", linewidth=1.2, label="" if i else "true, small swings about rest")
    spins = np.geomspace(0.01, 20.0, 200)
    for form in ("printed", "reciprocal"):
        made = np.array([published(r0, form, np.zeros(1))["period"] for r0 in spins.tolist()])
        axes.loglog(spins, made, color=COLOURS[COLOUR[form]], linewidth=1.2, label=f"(36), {READINGS[form]}")
    axes.set_ylim(0.2, 2e3)
    axes.set_title("period", loc="left", fontsize=10)
    _furnish(axes, "spin r₀/c", "c T")
    axes.legend(fontsize=8)


def _corrections() -> "Figure":
    figure = new_figure(17.0, 14.5)
    panels = figure.subplots(3, 3)
    forms = ("reciprocal", "corrected", "order 8")
    revolutions, spins = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000), np.geomspace(2.0, 100.0, 25)
    for form in forms:
        colour = COLOURS[COLOUR[form]]
        late = np.array([late_errors(20.0, form, n) for n in revolutions])
        by_spin = np.array([_once(r0, form) for r0 in spins.tolist()])
        for column in range(3):
            panels[0, column].loglog(revolutions, late[:, column], "o-", color=colour, markersize=3.5, linewidth=1.1, label=WORDS[form])
            panels[1, column].loglog(spins, by_spin[:, column], "o-", color=colour, markersize=3, linewidth=1.1, label=WORDS[form])
    for column, part in enumerate(PARTS[:3]):
        panels[0, column].set_title(f"{part}: error in the n-th revolution, r₀ = 20 c", loc="left", fontsize=10)
        panels[1, column].set_title(f"{part}: error in the first revolution", loc="left", fontsize=10)
        _furnish(panels[0, column], "revolution n", "error [1]")
        _furnish(panels[1, column], "spin r₀/c", "error [1]")
        panels[1, column].set_ylim(bottom=1e-16)
        for axes in panels[:2, column]:
            axes.legend(fontsize=8)
    spin = 20.0
    t = np.linspace(0.0, 3.0 * 2.0 * math.pi / spin, 601)
    true, printed = angles(spin, t), published(spin, "reciprocal", t)["angles"]
    corrected = _corrected_angles(spin, t)
    for column, (name, less) in enumerate((("θ − θ₀", 0.0), ("ψ − ψ₀", 0.0), ("φ − φ₀ − r₀ t", spin))):
        axes = panels[2, column]
        turns = spin * t / (2.0 * math.pi)
        axes.plot(turns, true[:, column] - less * t, color="black", linewidth=2.2, alpha=0.5, label="full motion")
        axes.plot(turns, corrected[:, column] - less * t, color=COLOURS[COLOUR["corrected"]], linestyle="--", linewidth=1.2, label="corrected")
        axes.plot(turns, printed[:, column] - less * t, color=COLOURS[COLOUR["reciprocal"]], linewidth=1.2, label="(38), (39) as printed")
        axes.set_title(f"{name}, r₀ = 20 c", loc="left", fontsize=10)
        _furnish(axes, "revolutions r₀ t/2π", "[rad]")
        _crown(axes, 3)
    finish(figure, f"The printed formulas with μ⁻¹ = c/r₀, put right, and carried on, against the full motion; {DATA}", (
        "Top: the printed γ has the frequency r₀ without its correction of second order, so that its error grows with time, 0.0094, "
        "0.091, 0.88, 2.0 in revolutions 1, 10, 100, 1000. With the correction 2.1e-5, 2.0e-4, 2.0e-3, 2.0e-2; by the series of order 8 "
        "from 4e-12 to 3.8e-9.",
        "Middle: printed, r and γ err by (c/r₀)² even in the first revolution: r has y₀′ where it needs 4 y₀′, and γ lacks a term beside "
        "the shift of frequency. Put right both err by (c/r₀)⁴. In the first revolution the printed p and q are as good, until their sin "
        "θ₀ = 1 shows at fast spin.",
        "Bottom: printed, θ swings the wrong way and with 0.667 k for 0.5 k; the swing of ψ has the factor μ⁻¹c, which is no angle, for "
        "μ⁻², and + for a product; φ lacks the mean of r and its swing."))
    return figure


def _once(spin: float, form: str) -> tuple[float, ...]:
    try:
        return late_errors(spin, form, 1)
    except ConvergenceError:
        return (math.nan,) * len(PARTS)


def _corrected_angles(spin: float, t: Vectors) -> Vectors:
    """theta, psi, phi (n, 3) of the corrected closed form, less what they are at the start."""
    made = heavy.series(**BODY, spin=spin, cos_inclination=COSINE, t=t, order=2)
    return _angles_of(made.attitude, made.down)


DRAWN: Final[dict[str, Callable[[], "Figure"]]] = {
    "table-1": _table_1, "table-2": _table_2, "readings": _readings, "corrections": _corrections}
