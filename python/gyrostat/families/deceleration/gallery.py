# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the paper on deceleration: as printed, right, and by the full motion."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gyrostat import _core
from gyrostat.answer import Answer
from gyrostat.drawing import COLOURS, Drawing, finish, new_figure
from gyrostat.families.deceleration.stability import draw_regions, quasi_stationary_line
from gyrostat.ladder import solve

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["drawings", "figures"]

Vector = tuple[float, float, float]

PAPER: Final = "deceleration"
INERTIA: Final = (35.0, 22.0, 16.0)  # kg m2
START: Final = (0.01, 0.02, 0.03)  # rad/s
DRAG: Final = 0.2  # lambda T: the only reading in which |M| vanishes near t = T
START_MODULUS: Final = 0.99  # k2(0) of the paper
TORQUES: Final = (5.0, 8.0, 10.0)  # N m


@dataclass(frozen=True)
class Case:
    """One curve of a group: what the label says, and the data that differ."""

    label: str
    rotor_momentum: Vector = (200.0, 150.0, 50.0)
    control: Vector = TORQUES
    sigma: float = 1.3

    def data(self) -> _core.PublishedData:
        """The published data of the curve."""
        return _core.PublishedData(inertia=INERTIA, rotor_momentum=self.rotor_momentum, angular_velocity=START,
                              control=self.control, drag=DRAG, sigma=self.sigma)


@dataclass(frozen=True)
class Group:
    """Three figures (energy, momentum, modulus) of the same runs, and one sentence on what is seen in each."""

    numbers: tuple[int, int, int]
    title: str
    cases: tuple[Case, ...]
    gyrostat: bool  # the right curves keep the rotor momentum; else they are those of the body without
    seen: tuple[str, str, str]

    @property
    def name(self) -> str:
        """Name of the file, without its ending."""
        return f"{PAPER}-figures-{self.numbers[0]}-{self.numbers[-1]}"


def _ratios(kappa1: float, kappa2: float, sigma: float) -> Case:
    return Case(f"κ = ({kappa1:g}, {kappa2:g})", control=(10 * kappa1, 10 * kappa2, 10.0), sigma=sigma)


_PRINTED_K2: Final = "Printed, k² passes 1 at once, because the denominator of (27c) is negative at |M| = M₀."
GROUPS: Final = (
    Group((5, 6, 7), "Figures 5-7: rotor momentum l = (l₁, 150, 50) N m s",
          tuple(Case(f"l₁ = {l1:g}", (l1, 150.0, 50.0)) for l1 in (100.0, 150.0, 200.0)), True,
          ("Fig. 5: the printed energy starts at 13.9, 8.97, 2.04 by (28), where H(0)/b₃ is 0.55 to 0.65; the carrier's energy does "
           "not decay but grows some 50 000-fold, as the law stops M and not the carrier.",
           "Fig. 6: |M|/M₀ falls to zero near t = T; the averaged and the full motion agree.",
           f"Fig. 7: {_PRINTED_K2} The true orbit is a small circle about an equilibrium, k² below 5e-7, not 0.99.")),
    Group((8, 9, 10), "Figures 8-10: rotor momentum l = (200, l₂, 50) N m s",
          tuple(Case(f"l₂ = {l2:g}", (200.0, l2, 50.0)) for l2 in (50.0, 100.0, 150.0)), True,
          ("Fig. 8: (28) as printed gives a negative energy at the start for l₂ = 50 and 100; the carrier's energy grows.",
           "Fig. 9: |M|/M₀ falls to zero near t = T for every l₂.",
           f"Fig. 10: {_PRINTED_K2} By (11) as printed k²(0) is 3.59, 1.54, 0.87: not a modulus at all.")),
    Group((11, 12, 13), "Figures 11-13: rotor momentum l = (200, 150, l₃) N m s",
          tuple(Case(f"l₃ = {l3:g}", (200.0, 150.0, l3)) for l3 in (50.0, 100.0, 150.0)), True,
          ("Fig. 11: the stretch (1, 10] T that the paper describes lies after the stop, where nothing is left to describe.",
           "Fig. 12: |M|/M₀ starts at 1 by (25), so that an initial value growing with l₃ contradicts the scaling.",
           f"Fig. 13: {_PRINTED_K2} The true orbit is a small circle about an equilibrium, k² below 2e-7, and shrinks.")),
    Group((14, 15, 16), "Figures 14-16: torque ratios at σ = 1.3 (right curves without rotor momentum)",
          (_ratios(0.75, 0.9, 1.3), _ratios(0.8, 1.0, 1.3), _ratios(0.89, 1.11, 1.3)), False,
          ("Fig. 14: without rotors the energy decays to zero at the stop; greater ratios curve it more.",
           "Fig. 15: the stop comes at 0.8126, 0.7532, 0.6869 T: the curves do not coincide.",
           f"Fig. 16: {_PRINTED_K2} Corrected, k² falls from 0.99, the more slowly the nearer κ lies to the bound (29).")),
    Group((17, 18, 19), "Figures 17-19: torque ratios at σ = 1.8 (right curves without rotor momentum)",
          (_ratios(0.89, 1.3, 1.8), _ratios(0.76, 1.25, 1.8)), False,
          ("Fig. 17: the energy decays to zero; the caption gives torques (15, 18, 20), that is κ = (0.75, 0.9), for (0.89, 1.3).",
           "Fig. 18: the stop comes at 0.457 and 0.498 T.",
           f"Fig. 19: {_PRINTED_K2} Corrected, k² falls below 0.05 and 0.002 before the stop.")),
    Group((20, 21, 22), "Figures 20-22: identifying number σ, κ = (0.5, 0.8) (right curves without rotor momentum)",
          tuple(Case(f"σ = {sigma:g}", sigma=sigma) for sigma in (0.7, 1.3, 1.8)), False,
          ("Fig. 20: the energy must follow |M| and hence σ; the paper sees no variation with σ.",
           "Fig. 21: the stop comes at 1.749, 1.017, 0.754 T: the greater σ, the earlier.",
           f"Fig. 22: {_PRINTED_K2} Corrected, k² falls to zero with |M|, the earlier the greater σ.")),
    Group((23, 24, 25), "Figures 23-25: torques perturbed by μ (right curves without rotor momentum)",
          (Case("μ = (0, 0)", control=(10.0, 10.0, 10.0)), Case("μ = (0.05, 0.07)", control=(10.5, 10.7, 10.0))), False,
          ("Fig. 23: as printed the energy grows, or turns negative; right, it decays, with a small difference between the two.",
           "Fig. 24: equal torques stop at 0.7155 T, (1/λ) ln(1 + λ/σ), the perturbed ones at 0.679 T.",
           "Fig. 25: with μ = 0, k² stands still; μ = (0.05, 0.07) breaks (29), so that k² reaches 1 at 0.257 T and the body goes "
           "on in regime C (dashed): the small change crosses the separatrix. As printed k² falls: the sign of (27c) is reversed.")),
)


def figures() -> list[str]:
    """Numbers of the figures that can be drawn again."""
    return [str(number) for number in (3, 4, *(number for group in GROUPS for number in group.numbers))]


def drawings(wanted: Sequence[str]) -> list[Drawing]:
    """What draws these figures; those of the same runs share a file."""
    made: list[Drawing] = []
    if "3" in wanted:
        made.append((f"{PAPER}-figure-3", _figure_3))
    if "4" in wanted:
        made.append((f"{PAPER}-figure-4", _figure_4))
    return made + [(group.name, partial(_draw, group)) for group in GROUPS if {str(n) for n in group.numbers} & set(wanted)]


def _polhode_start(norm: float, modulus_squared: float) -> Vector:
    """M on the polhode of a modulus around the axis of largest inertia, with M2 = 0 [N m s]."""
    a, b, c = INERTIA
    alpha = a * (b - c) + c * (a - b) * modulus_squared
    return norm * math.sqrt(a * (b - c) / alpha), 0.0, -norm * math.sqrt(modulus_squared * c * (a - b) / alpha)


def _scene(case: Case, gyrostat: bool, small: float, end: float, model: str) -> dict[str, Any]:
    """A curve as a scene in SI units: torques small b, drag small lambda, to `end` T."""
    data = case.data()
    initial: dict[str, Any] = {"angular_velocity": list(START)}
    if not gyrostat:
        initial = {"angular_momentum": list(_polhode_start(data.momentum_unit, START_MODULUS))}
    return {
        "name": f"{PAPER}-figure", "kind": "deceleration",
        "solve": {"duration": end * data.time_unit / small, "samples": 401, "tolerance": 1e-4, "model": model},
        "body": {"inertia": list(INERTIA), "rotor_momentum": list(case.rotor_momentum) if gyrostat else [0.0, 0.0, 0.0]},
        "torque": {"control": [small * b for b in case.control], "drag": small * DRAG / data.time_unit},
        "initial": initial,
    }


def _draw(group: Group) -> "Figure":
    # The averaged motion is the limit of a small parameter; the full one needs a number.
    small = 0.01 if group.gyrostat else 0.03
    corrected_end = [float(_corrected(case).t[-1]) for case in group.cases]
    end = 1.25 if group.gyrostat else 1.15 * max(corrected_end)

    figure = new_figure(15.0, 11.0)
    panels = figure.subplots(3, 3)
    for case, colour in zip(group.cases, COLOURS, strict=False):
        printed = _core.published_run(case.data(), reading="printed", modulus_squared=START_MODULUS, end=end, samples=201)
        for axes, values in zip(panels[:, 0], (printed.energy, printed.momentum, printed.modulus_squared), strict=True):
            axes.plot(printed.t, values, color=colour, label=f"{case.label}, ends at {printed.t[-1]:.2g} T")
        for column, model in ((1, "averaged"), (2, "full")):
            answer = solve(_scene(case, group.gyrostat, small, end, model))
            _curves(panels[:, column], case, answer, small, colour)
    for axes, title in zip(panels[0], ("as printed, (27) and (28)", "right: averaged over the true orbit",
                                       f"full motion, small parameter {small:g}"), strict=True):
        axes.set_title(title, loc="left", fontsize=11)
    for row, (quantity, printed_quantity) in enumerate((("carrier energy h/b₃ [1]", "H/b₃ [1]"), ("|M|/M₀ [1]",) * 2,
                                                        ("k² of the orbit [1]", "k² [1]"))):
        panels[row, 0].set_ylabel(f"Fig. {group.numbers[row]}: {printed_quantity}")
        panels[row, 1].set_ylabel(quantity)
        panels[row, 2].set_ylabel(quantity)
        for axes in panels[row]:
            axes.set_xlabel("t/T [1]")
            axes.grid(alpha=0.25)
            axes.legend(fontsize=8, loc="best")
        for axes in panels[row, 1:]:
            axes.set_xlim(0.0, end)
    for axes in panels[:, 0]:
        axes.ticklabel_format(axis="y", useOffset=False)
        axes.ticklabel_format(axis="x", style="sci", scilimits=(-2, 2))
    if group.gyrostat:
        for axes in (*panels[0, 1:], *panels[2, 1:]):
            axes.set_yscale("log")
    finish(figure, group.title, group.seen)
    return figure


def _corrected(case: Case) -> _core.PublishedRun:
    """The corrected equations of the curve without rotor momentum."""
    data = _core.PublishedData(inertia=INERTIA, rotor_momentum=(0.0, 0.0, 0.0), angular_velocity=START, control=case.control,
                          drag=DRAG, sigma=case.sigma)
    return _core.published_run(data, reading="corrected", modulus_squared=START_MODULUS, end=3.0, samples=3)


def _curves(panels: Sequence["Axes"], case: Case, answer: Answer, small: float, colour: str) -> None:
    """Energy, momentum and modulus of an answer in the units of the paper; regime C dashed."""
    data = case.data()
    t = answer.t * small / data.time_unit
    stop = answer.scalars.get("stop_time")
    label = case.label if stop is None else f"{case.label}, stops at {stop * small / data.time_unit:.4f} T"
    moving = t <= (math.inf if stop is None else stop * small / data.time_unit)
    panels[0].plot(t[moving], answer["energy"][moving] / case.control[2], color=colour, label=label)
    panels[1].plot(t, answer["angular_momentum_norm"] / data.momentum_unit, color=colour, label=label)
    k2 = np.where(moving, answer["modulus_squared"], np.nan)
    regime = answer["regime"]
    panels[2].plot(t, np.where(regime != "C", k2, np.nan), color=colour, label=label)
    if np.any(regime == "C"):
        panels[2].plot(t, np.where(regime == "C", k2, np.nan), color=colour, linestyle="--")


def _figure_3() -> "Figure":
    figure = new_figure(15.0, 7.2)
    panels = figure.subplots(1, 3)
    kappa2 = np.linspace(0.0, 2.0, 201)
    for axes in panels[:2]:
        axes.axhline(1.0, color=COLOURS[5], label="line 2: κ₂ = 1")
        axes.axvline(1.0, color=COLOURS[4], label="line 3: κ₁ = 1")
    f = 1.0 - _w(0.4)
    panels[0].plot(_core.published_stationary_ratio(kappa2, 0.4), kappa2, color="black", label="line 1: (22) at k*² = 0.4")
    panels[0].plot((1.0 - kappa2 * (1.0 - f)) / f, kappa2, color=COLOURS[1], label="line 4: (24)")
    panels[1].plot(0.5 * (1.0 + kappa2), kappa2, color=COLOURS[1], label="κ₁ = (1 + κ₂)/2")
    for axes in panels[1:]:
        draw_regions(axes, "A", 2.0)
        axes.plot(quasi_stationary_line("A", 0.4, kappa2), kappa2, color="black", label="k*² = 0.4")
    _full_drift(panels[2])
    for axes, title in zip(panels, ("as printed", "right, regime A", "full motion from k² = 0.4"), strict=True):
        axes.set_title(title, loc="left", fontsize=11)
        axes.set_aspect("equal")
        axes.set_xlim(0.0, 2.0)
        axes.set_ylim(0.0, 2.0)
        axes.set_xlabel("κ₁ = b₁/b₃ [1]")
        axes.set_ylabel("κ₂ = b₂/b₃ [1]")
        axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2)
    finish(figure, "Figure 3: where quasi-stationary orbits exist", (
        "(22) as printed misses the point (1, 1) of equal torques, where every k² is stationary, and line 4 bounds nothing: it is "
        "a zero of a denominator. Right, quasi-stationary orbits lie between κ₁ = 1 and κ₁ = (1 + κ₂)/2: green, they attract; "
        "pink, they repel.",
        "The full motion: a triangle pointing up (down) where the mean k² grows (falls) from 0.4; it changes sign on the line "
        "k*² = 0.4."))
    return figure


def _w(modulus_squared: float) -> float:
    """W = 1 - E/K from the torque balance phi = (1 - k2) W/(k2 (1 - W))."""
    phi = float(_core.deceleration_torque_balance(modulus_squared))
    return phi * modulus_squared / (1.0 - modulus_squared + phi * modulus_squared)


def _full_drift(axes: "Axes") -> None:
    """Sign of the drift of k2 in the full motion, on a grid of torque ratios."""

    norm = 100.0
    start = _polhode_start(norm, 0.4)
    kappa = np.arange(0.1, 2.0, 0.2)
    grown: list[tuple[float, float]] = []
    fallen: list[tuple[float, float]] = []
    for k1 in kappa.tolist():
        for k2 in kappa.tolist():
            answer = solve({
                "name": "drift", "kind": "deceleration",
                "solve": {"duration": 400.0, "samples": 201, "tolerance": 1e-6, "model": "full"},
                "body": {"inertia": list(INERTIA)}, "torque": {"control": [0.01 * k1, 0.01 * k2, 0.01], "drag": 0.0},
                "initial": {"angular_momentum": list(start)}})
            k2s = answer["modulus_squared"]
            (grown if float(np.mean(k2s[100:])) > float(np.mean(k2s[:100])) else fallen).append((k1, k2))
    for points, marker, colour, label in ((grown, "^", COLOURS[1], "k² grows"), (fallen, "v", COLOURS[0], "k² falls")):
        axes.plot([p[0] for p in points], [p[1] for p in points], marker, color=colour, markersize=5, label=label)


def _figure_4() -> "Figure":
    inertia, rotor, rate = (10.0, 8.0, 5.0), (40.0, 30.0, 20.0), (0.01, 0.03, 0.03)
    small = 1e-3
    norm = math.dist((0.0, 0.0, 0.0), [j * w + l for j, w, l in zip(inertia, rate, rotor, strict=True)])
    torques = np.geomspace(1.0, 50.0, 12)
    fine = np.geomspace(1.0, 50.0, 200)
    closed = np.log1p(DRAG * norm / fine) / DRAG
    full = []
    for b in torques.tolist():
        answer = solve({
            "name": "figure-4", "kind": "deceleration",
            "solve": {"duration": 1.1 * math.log1p(DRAG * norm / b) / DRAG / small, "samples": 3, "tolerance": 1e-6, "model": "full"},
            "body": {"inertia": list(inertia), "rotor_momentum": list(rotor)},
            "torque": {"control": [small * b] * 3, "drag": small * DRAG}, "initial": {"angular_velocity": list(rate)}})
        full.append(answer.scalars["stop_time"] * small)
    figure = new_figure(13.0, 5.6)
    panels = figure.subplots(1, 2)
    # The exponential that the paper reads off its curve, through the two ends of the true one.
    decay = math.log(closed[0] / closed[-1]) / (fine[-1] - fine[0])
    for axes in panels:
        axes.plot(fine, closed[0] * np.exp(-decay * (fine - fine[0])), color=COLOURS[1], linestyle=":",
                  label="as described: an exponential, through both ends")
        axes.plot(fine, closed, color=COLOURS[0], label="right: (1/λ) ln(1 + λM₀/b)")
        axes.plot(torques, full, "o", color="black", markersize=5, label=f"full motion, small parameter {small:g}")
        axes.set_xlabel("control torque b, the same about all axes [N m]")
        axes.set_ylabel("deceleration time T in slow time [s]")
        axes.grid(alpha=0.25)
        axes.legend(fontsize=8)
    panels[0].set_title("linear axes", loc="left", fontsize=11)
    panels[1].set_title("logarithmic time: an exponential would be straight", loc="left", fontsize=11)
    panels[1].set_yscale("log")
    finish(figure, "Figure 4: deceleration time against torque, A, B, C = 10, 8, 5 kg m², l = (40, 30, 20) N m s, λ = 0.2 (not printed)", (
        f"M₀ = {norm:.2f} N m s. The time follows a logarithm, like 1/b for strong torques, not the exponential of the paper; with "
        "equal torques the closed form is exact, and the full motion lies on it.",))
    return figure
