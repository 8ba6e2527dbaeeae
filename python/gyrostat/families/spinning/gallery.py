# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the paper on the thrusting, charged spinning body, and how far its closed forms reach."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core, spinning
from gyrostat.drawing import COLOURS, Drawing, finish, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["SWEEPS", "Case", "Run", "drawings", "figures", "late", "linear_truth"]

Vectors = NDArray[np.float64]

PAPER: Final = "spinning"
INERTIA: Final = (8.7, 8.6, 11.1)  # kg m^2
END: Final = 50.0  # s
RPM: Final = 2.0 * math.pi / 60.0  # rad/s
BASE: Final = "D = (8.7, 8.6, 11.1) kg m², m = 10 kg, f₃ = 3 N, 2.7 rpm at the start, M₂ = 0"
NEVER_SMALL: Final = ("The data are no small-angle motion: the linear tilt passes 1 rad at 2.1 s (dotted line) and reaches 12 rad "
                      "and more. What follows that line, as printed and in the linear motion, happens to no body.")


@dataclass(frozen=True)
class Case:
    """One curve: what the label says, and the data that differ from the base ones."""

    label: str = ""
    rotor_momentum: float = 1.3  # N m s
    charge: float = 0.003  # C
    torque: float = 4.0  # M1, N m
    spin: float = 2.7 * RPM  # rad/s

    def given(self) -> dict[str, Any]:
        """The body as arguments of `gyrostat.spinning`."""
        return {
            "inertia": INERTIA, "mass": 10.0, "rotor_momentum": self.rotor_momentum,
            "charge_momentum": float(spinning.charge_momentum(charge=self.charge, flux_density=100.0, arm=1.02, angle=0.37)),
            "torque": (self.torque, 0.0, 0.0), "force": (0.0, 0.0, 3.0), "angular_velocity": (0.0, 0.0, self.spin),
            "euler_312": (0.0, 0.0, 0.0), "velocity": (0.0, 0.0, 0.0), "position": (0.0, 0.0, 0.0)}


@dataclass(frozen=True)
class Sweep:
    """The three curves of a figure, and the words for its title."""

    words: str
    cases: tuple[Case, ...]


SWEEPS: Final = {
    "rotor": Sweep("rotor momentum λ₃, e = 0.003 C, M₁ = 4 N m",
                   tuple(Case(f"λ₃ = {x:g} N m s", rotor_momentum=x) for x in (1.3, 1.6, 1.9))),
    "charge": Sweep("charge e, λ₃ = 1.3 N m s, M₁ = 4 N m", tuple(Case(f"e = {x:g} C", charge=x) for x in (0.001, 0.003, 0.005))),
    "torque": Sweep("torque M₁, λ₃ = 1.3 N m s, e = 0.003 C", tuple(Case(f"M₁ = {x:g} N m", torque=x) for x in (4.0, 4.5, 5.0))),
}


@dataclass(frozen=True, eq=False)
class Run:
    """A motion over the times of the figures, by one of "printed", "linear" and "full"."""

    t: Vectors
    rates: Vectors  # (n, 2) p, q
    angles: Vectors  # (n, 3) psi, phi, theta
    momentum: Vectors  # (n, 2) G1, G2; printed: (33)
    velocity: Vectors  # (n, 3)
    position: Vectors  # (n, 3)
    circle: Vectors = field(default_factory=lambda: np.empty((0, 2)))  # (n, 2) printed: (35)


@lru_cache(maxsize=64)
def run(case: Case, how: str, end: float = END, samples: int = 1001) -> Run:
    """A curve from rest at the origin."""
    given, t = case.given(), np.linspace(0.0, end, samples)
    if how == "printed":
        _, problem = spinning.problems(given)
        made = _core.spinning_published(problem, reading="printed", t=t)
        angles = np.column_stack([made["tilt"], made["spin_angle"]])
        return Run(t, made["rates"], angles, made["momentum"], made["velocity"], made["position"], made["circle"])
    if how == "linear":
        exact = spinning.linear(**given, t=t)
        return Run(t, exact.angular_velocity[:, :2], exact.euler_312, exact.angular_momentum_inertial[:, :2], exact.velocity, exact.position)
    columns = spinning.solve(**given, times=t, tolerance=1e-8, model="full")
    return Run(t, columns["angular_velocity"][:, :2], columns["euler_312"], columns["angular_momentum_inertial"][:, :2],
               columns["velocity"], columns["position"])


def late(case: Case, tilt: float) -> float:
    """When the linear tilt first passes an angle [s]."""
    made = run(case, "linear", END, 50001)
    return float(made.t[np.argmax(np.hypot(made.angles[:, 0], made.angles[:, 1]) > tilt)])


# ---- the figures of the paper ----

WAYS: Final = (("printed", "as printed"), ("linear", "right: the exact linear motion"), ("full", "full motion"))

Curve = tuple[str, str, Callable[[Run], tuple[Vectors, Vectors]]]  # label of x, label of y, both from a run


def _over_time(label: str, of: Callable[[Run], Vectors]) -> Curve:
    return "time [s]", label, lambda made: (made.t, of(made))


def _rate_plane(label: str, i: int) -> Curve:
    return f"{label} [rad/s]", f"{label}′ [rad/s²]", lambda made: (made.rates[:, i], np.gradient(made.rates[:, i], made.t, edge_order=2))


RATES: Final = (_over_time("p [rad/s]", lambda made: made.rates[:, 0]), _over_time("q [rad/s]", lambda made: made.rates[:, 1]),
                _rate_plane("p", 0), _rate_plane("q", 1))
def _broken(angle: Vectors) -> Vectors:
    """An angle in (-pi, pi] with a gap where it jumps by a turn."""
    return np.where(np.abs(np.diff(angle, append=angle[-1])) > math.pi, np.nan, angle)


ANGLES: Final = (_over_time("ψ [rad]", lambda made: made.angles[:, 0]), _over_time("φ [rad]", lambda made: _broken(made.angles[:, 1])),
                 _over_time("θ [rad]", lambda made: made.angles[:, 2]))
VELOCITY: Final = (_over_time("v₁ [m/s]", lambda made: made.velocity[:, 0]), _over_time("v₂ [m/s]", lambda made: made.velocity[:, 1]),
                   _over_time("v₃ [m/s]", lambda made: made.velocity[:, 2]))
POSITION: Final = (_over_time("x₁ [m]", lambda made: made.position[:, 0]), _over_time("x₂ [m]", lambda made: made.position[:, 1]),
                   _over_time("x₃ [m]", lambda made: made.position[:, 2]))


@dataclass(frozen=True)
class Group:
    """Figures of the same runs, which share a file, and a sentence on what is seen in each."""

    numbers: tuple[int, ...]
    sweep: str
    curves: tuple[Curve, ...]
    what: str
    seen: tuple[str, ...]

    @property
    def name(self) -> str:
        """Name of the file, without its ending."""
        return _file(self.numbers)


def _file(numbers: Sequence[int]) -> str:
    words = "-".join(str(number) for number in numbers)
    return f"{PAPER}-figures-{words}" if len(numbers) > 1 else f"{PAPER}-figure-{words}"


GROUPS: Final = (
    Group((2, 3), "rotor", RATES, "transverse rates", (
        "Fig. 2: right, |p| and |q| fall and the period shortens, 31.9, 27.2, 23.6 s, as λ₃ grows; the printed frequency is 1.2 % low at "
        "λ₃ = 1.3. Fig. 3: closed ellipses, q never negative: they are closed because the model is linear, and say nothing of stability.",
        "The true p and q follow for some 8 s, then the spin rate itself doubles. " + NEVER_SMALL)),
    Group((4, 5), "charge", RATES, "transverse rates", (
        "Fig. 4: right, amplitude and period grow with e: 28.7, 31.9, 36.1 s. The paper has amplitude and wavelength increase while the "
        "wavelengths decrease. Fig. 5: ellipses, wider with e.", NEVER_SMALL)),
    Group((6, 7), "torque", RATES, "transverse rates", (
        "Fig. 6: right, the amplitude is proportional to M₁ and the period, 31.94 s, does not depend on it. The paper says of this figure "
        "that the amplitude falls and the frequency grows with M₁. Fig. 7: similar ellipses, the greater the greater M₁.",
        "In the full motion the period does depend on M₁. " + NEVER_SMALL)),
    Group((8,), "rotor", ANGLES, "3-1-2 angles", (
        "Fig. 8: right, ψ reaches 15.2, 13.7, 12.2 rad, φ −8.3 … 7.5 rad at λ₃ = 1.3, where the derivation asks for small angles. The third "
        "angle, which the paper calls a constant nutation, is the spin angle r₀ t.",
        "In the full motion ψ stays within ±π/2 by its meaning; θ leaves r₀ t before 2 s. " + NEVER_SMALL)),
    Group((9,), "charge", ANGLES, "3-1-2 angles", (
        "Fig. 9: right, ψ reaches 14.2, 15.2, 16.1 rad: the charge takes from the gyroscopic stiffness X, and less stiffness is more tilt.",
        NEVER_SMALL)),
    Group((10,), "torque", ANGLES, "3-1-2 angles", (
        "Fig. 10: right, ψ and φ are proportional to M₁, no slight deviation at the peaks: 15.2, 17.1, 19.0 rad.", NEVER_SMALL)),
    Group((18,), "rotor", VELOCITY, "velocity of the mass centre", (
        "Fig. 18: right, v₁ stays bounded and v₂ grows with 0.3 t times the slope M₁/(r₀ X) = 3.41, 3.18, 2.98; (54) as printed, without λ₃ "
        "and e, has 4.51 for all. As printed the misprints of (46) bend v from the start, most at λ₃ = 1.9, where its divisor r₀ − ν is small.",
        "v₃ = 0.3 t for every λ₃ holds in the linear model alone: the full thrust turns away with the body, and v₃ grows by f₃|Γ|²/2m a second less from the "
        "start. " + NEVER_SMALL)),
    Group((19,), "charge", VELOCITY, "velocity of the mass centre", (
        "Fig. 19: right, the slope of v₂ grows with e, 3.26, 3.41, 3.58. The period of the wave in v₁ grows with e too; the paper has its "
        "frequency grow.", NEVER_SMALL)),
    Group((20,), "torque", VELOCITY, "velocity of the mass centre", (
        "Fig. 20: right, v₁ and v₂ are proportional to M₁: slopes 3.41, 3.84, 4.26.", NEVER_SMALL)),
    Group((22,), "rotor", POSITION, "position of the mass centre", (
        "Fig. 22: right, x₁(50) = 256, 241, 219 m, x₂(50) = 1250, 1162, 1093 m, x₃ = 0.15 t² = 375 m. As printed x does not start "
        "at the origin but up to 450 m away, at λ₃ = 1.9: (61) is not zero at t = 0, and it is divided by (r₀ − ν)³.",
        "The true x₁ and x₂ are a small part of that: three newtons on ten kilograms cannot do more than 375 m in 50 s, in any direction. "
        + NEVER_SMALL)),
    Group((23,), "charge", POSITION, "position of the mass centre", (
        "Fig. 23: right, x₁(50) = 247, 256, 270 m and x₂(50) = 1190, 1250, 1320 m: both grow with e.", NEVER_SMALL)),
    Group((24,), "torque", POSITION, "position of the mass centre", (
        "Fig. 24: right, x₁ and x₂ are proportional to M₁: 256, 288, 319 m and 1250, 1406, 1563 m after 50 s.", NEVER_SMALL)),
)

MOMENTA: Final[dict[tuple[int, ...], tuple[str, tuple[str, ...]]]] = {
    (12, 13): ("rotor", (
        "Fig. 12: (33). No circles, because e ≠ 0. The text gives centre M₁/(D₃ r₀²) = 4.51 and radius 4.25, of other units; the "
        "radius is M₁/r₀ = 14.15 N m s and the pointing G/L₃ has M₁/(r₀ X). Fig. 13: (35) leaves −i e_H Π out and differs from (33) by up to "
        "4.6 of 32.6 N m s; it knows no λ₃, and one circle stands for three curves.",
        "The true G follows the tumbling body and is on no circle. " + NEVER_SMALL)),
    (14, 15): ("charge", (
        "Fig. 14: right, G₂ reaches 29.6, 32.6, 35.9 N m s as e grows: the charge alone bends the circle. Fig. 15: (35) as printed does not "
        "depend on e, because the term with e was left out, not because of a small approximation.", NEVER_SMALL)),
    (16, 17): ("torque", (
        "Fig. 16: right, G is proportional to M₁; the paper's curves get closer. Fig. 17: the radius of (35) is M₁/r₀ = 14.15, 15.92, 17.68 N m "
        "s; the paper sees no change with M₁.", NEVER_SMALL)),
}

OWN: Final = ("validity", "resonance")


def figures() -> list[str]:
    """Numbers of the paper's figures, and names of our own."""
    return [*(str(number) for number in range(2, 25)), *OWN]


def drawings(wanted: Sequence[str]) -> list[Drawing]:
    """What draws these figures; those of the same runs share a file."""
    made: list[tuple[tuple[int, ...], Callable[[], "Figure"]]] = [(group.numbers, partial(_draw, group)) for group in GROUPS]
    made += [(numbers, partial(_momenta, numbers)) for numbers in MOMENTA]
    made += [((11,), _figure_11), ((21,), _figure_21)]
    own = {"validity": _validity, "resonance": _resonance}
    chosen = [(_file(numbers), draw) for numbers, draw in sorted(made) if {str(number) for number in numbers} & set(wanted)]
    return chosen + [(f"{PAPER}-{name}", own[name]) for name in OWN if name in wanted]


def _draw(group: Group) -> "Figure":
    sweep = SWEEPS[group.sweep]
    rows = len(group.curves)
    figure = new_figure(15.0, 3.2 * rows + 1.6)
    panels = figure.subplots(rows, len(WAYS), squeeze=False)
    for column, (how, title) in enumerate(WAYS):
        for case, colour in zip(sweep.cases, COLOURS, strict=False):
            made = run(case, how)
            for axes, (_, _, of) in zip(panels[:, column], group.curves, strict=True):
                axes.plot(*of(made), color=colour, linewidth=1.2, label=case.label)
        panels[0, column].set_title(title, loc="left", fontsize=11)
        for axes, (x, y, _) in zip(panels[:, column], group.curves, strict=True):
            _furnish(axes, x, y)
    words = f"Figures {' and '.join(map(str, group.numbers))}" if len(group.numbers) > 1 else f"Figure {group.numbers[0]}"
    finish(figure, f"{words}: {group.what}; {sweep.words}; {BASE}", group.seen)
    return figure


def _furnish(axes: "Axes", x: str, y: str) -> None:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.25)
    if x == "time [s]":
        axes.axvline(late(Case(), 1.0), color="#555555", linestyle=":", linewidth=1)
    axes.legend(fontsize=8, loc="best")


def _momenta(numbers: tuple[int, ...]) -> "Figure":
    name, seen = MOMENTA[numbers]
    sweep = SWEEPS[name]
    figure = new_figure(17.0, 11.0)
    panels = figure.subplots(3, 4)
    columns = ((f"Fig. {numbers[0]}: (33) as printed", "printed", "momentum"), (f"Fig. {numbers[1]}: (35) as printed", "printed", "circle"),
               ("right: the exact linear motion", "linear", "momentum"), ("full motion", "full", "momentum"))
    for column, (title, how, quantity) in enumerate(columns):
        for i, (case, colour) in enumerate(zip(sweep.cases, COLOURS, strict=False)):
            made = run(case, how)
            G = getattr(made, quantity)
            width = 3.6 - 1.2 * i if quantity == "circle" else 1.2  # they cover each other
            panels[0, column].plot(made.t, G[:, 0], color=colour, linewidth=width, label=case.label)
            panels[1, column].plot(made.t, G[:, 1], color=colour, linewidth=width, label=case.label)
            panels[2, column].plot(G[:, 0], G[:, 1], color=colour, linewidth=width, label=case.label)
        panels[0, column].set_title(title, loc="left", fontsize=11)
        panels[2, column].set_aspect("equal", adjustable="datalim")
        for axes, x, y in zip(panels[:, column], ("time [s]", "time [s]", "G₁ [N m s]"), ("G₁ [N m s]", "G₂ [N m s]", "G₂ [N m s]"),
                              strict=True):
            _furnish(axes, x, y)
    finish(figure, f"Figures {numbers[0]} and {numbers[1]}: angular momentum, inertial axes; {sweep.words}; {BASE}", seen)
    return figure


def _figure_11() -> "Figure":
    neutral = replace(Case(), charge=0.0)
    given = Case().given()
    pointing = float(spinning.pointing_error(spin_rate=Case().spin, **{name: given[name] for name in (
        "inertia", "torque", "rotor_momentum", "charge_momentum")}))
    figure = new_figure(15.0, 6.0)
    panels = figure.subplots(1, 3)
    for axes, (how, title) in zip(panels, WAYS, strict=True):
        for case, colour, label in ((neutral, COLOURS[0], "e = 0"), (Case(), COLOURS[1], "e = 0.003 C")):
            G = run(case, how).circle if how == "printed" else run(case, how).momentum
            axes.plot(G[:, 0], G[:, 1], color=colour, linewidth=3.0 if how == "printed" and not case.charge else 1.2, label=label)
        radius = neutral.torque / neutral.spin
        axes.plot(0.0, radius, "+", color="black", markersize=10, label=f"(0, M₁/r₀) = (0, {radius:.2f})")
        axes.set_title("as printed, (35)" if how == "printed" else title, loc="left", fontsize=11)
        axes.set_aspect("equal", adjustable="datalim")
        _furnish(axes, "G₁ [N m s]", "G₂ [N m s]")
        axes.legend(fontsize=8, loc="lower right")
    finish(figure, f"Figure 11: the circle of the angular momentum; λ₃ = 1.3 N m s, M₁ = 4 N m; {BASE}", (
        "Without charge the linear G runs on the circle of (35), radius M₁/r₀, whatever the rotor and the moments; with it (35) fails. Its mean lies "
        "on axis 2, with no part along axis 1 (M₂ = 0). The mean pointing error, which the paper assumes to be far below 1 rad, is "
        f"{pointing:.2f} rad for these data.",))
    return figure


def _figure_21() -> "Figure":
    figure = new_figure(15.0, 13.5)
    panels = figure.subplots(3, 3)
    for row, (letter, sweep) in enumerate(zip("abc", SWEEPS.values(), strict=True)):
        for column, (how, title) in enumerate(WAYS):
            axes = panels[row, column]
            for case, colour in zip(sweep.cases, COLOURS, strict=False):
                made = run(case, how)
                begun = made.t >= 2.0  # at t = 0 the ratio is 0/0
                v = made.velocity[begun]
                ratio = v[:, :2] / v[:, 2:]
                ratio[np.max(np.abs(ratio), axis=1) > 8.0] = np.nan  # where v3 passes through zero
                axes.plot(*ratio.T, color=colour, linewidth=1.2, label=case.label)
                _, problem = spinning.problems(case.given())
                if how != "full":
                    limit = _core.spinning_published(problem, reading="printed" if how == "printed" else "exact",
                                                     t=made.t[:1])["secular_velocity_ratio"]
                    axes.plot(*limit, "o", color=colour, markersize=6)
            axes.set_title(f"{title}, from t = 2 s" if row == 0 else sweep.words, loc="left", fontsize=11 if row == 0 else 9)
            if how == "full":
                axes.set_xlim(-6.0, 6.0)
                axes.set_ylim(-6.0, 6.0)
            _furnish(axes, "v₁/v₃ [1]", f"Fig. 21{letter}: v₂/v₃ [1]")
    finish(figure, f"Figure 21: where the velocity points; {BASE}", (
        "Right: spirals to (0, M₁/(r₀ X)), the dots: 3.41, 3.18, 2.98 for λ₃; 3.26, 3.41, 3.58 for e; 3.41, 3.84, 4.26 for M₁. The dots as printed, "
        "M₁/(D₃ r₀²), miss the printed curves themselves: 4.51 for every λ₃ and e. 4.51, 5.07, 5.63 for M₁.",
        "A velocity that points 3.4 : 1 across the thrust axis is no small angle. In the full motion v₃ passes through zero, and there is no limit "
        "to go to."))
    return figure


# ---- own figures ----


def _errors(case: Case, end: float) -> dict[str, float]:
    """Greatest error of the linear motion over [0, end], as a part of the greatest true value; theta [rad]."""
    samples = 2001
    linear, full = run(case, "linear", end, samples), run(case, "full", end, samples)

    def part(name: str, columns: slice) -> float:
        is_, true = getattr(linear, name)[:, columns], getattr(full, name)[:, columns]
        return float(np.max(np.linalg.norm(is_ - true, axis=1)) / np.max(np.linalg.norm(true, axis=1)))

    return {"p, q": part("rates", slice(0, 2)), "ψ, φ": part("angles", slice(0, 2)),
            "θ [rad]": float(np.max(np.abs(linear.angles[:, 2] - full.angles[:, 2]))), "G₁, G₂": part("momentum", slice(0, 2)),
            "v₁, v₂": part("velocity", slice(0, 2)), "v₃": part("velocity", slice(2, 3)), "x₁, x₂": part("position", slice(0, 2))}


def _validity() -> "Figure":
    figure = new_figure(16.5, 6.6)
    panels = figure.subplots(1, 3)
    linear, full = (run(Case(), how, 6.0) for how in ("linear", "full"))
    for i, word in enumerate(("ψ", "φ")):
        panels[0].plot(full.t, full.angles[:, i], color=COLOURS[i], label=f"{word}, full motion")
        panels[0].plot(linear.t, linear.angles[:, i], color=COLOURS[i], linestyle="--", label=f"{word}, linear")
    panels[0].axvline(late(Case(), 1.0), color="#555555", linestyle=":", linewidth=1, label="linear tilt 1 rad")
    panels[0].axvline(late(Case(), 0.3), color="#AAAAAA", linestyle=":", linewidth=1, label="linear tilt 0.3 rad")
    panels[0].set_title("the paper's data, M₁ = 4 N m, 2.7 rpm", loc="left", fontsize=10)
    panels[0].set_ylabel("angle [rad]")
    panels[0].set_xlabel("time [s]")
    torques = np.geomspace(1e-3, 4.0, 13)
    by_torque = [_errors(Case(torque=x), END) for x in torques.tolist()]
    spins = np.geomspace(2.7, 600.0, 13)
    by_spin = [_errors(Case(spin=x * RPM), END) for x in spins.tolist()]
    for axes, x, errors in ((panels[1], torques, by_torque), (panels[2], spins, by_spin)):
        for colour, name in zip(COLOURS, errors[0], strict=False):
            axes.loglog(x, [e[name] for e in errors], "o-", color=colour, markersize=3.5, linewidth=1.1, label=name)
        axes.axhline(0.1, color="#555555", linestyle=":", linewidth=1)
    panels[1].loglog(torques[:8], 0.2 * (torques[:8] / torques[7])**2, color="black", linestyle="--", linewidth=0.9, label="M₁²")
    panels[1].set_title("2.7 rpm, against the torque", loc="left", fontsize=10)
    panels[1].set_xlabel("torque M₁ [N m]")
    panels[2].set_title("M₁ = 4 N m, against the spin", loc="left", fontsize=10)
    panels[2].set_xlabel("spin rate at the start [rpm]")
    for axes in panels[1:]:
        axes.set_ylabel("greatest error in 50 s, part of the greatest value [1, rad]")
    for axes in panels:
        axes.grid(alpha=0.25, which="both")
        axes.legend(fontsize=8)
    finish(figure, f"How far the linear motion reaches; λ₃ = 1.3 N m s, e = 0.003 C; {BASE}".replace("2.7 rpm at the start, ", ""), (
        "On the data of the figures the linear motion is wrong within three of the fifty seconds. This body at this spin takes a hundredth of the torque, "
        "or this torque forty times the spin; then all relative errors fall with the square of the torque. The spin angle fails first: its "
        "error adds up over the turns, and it carries that of G along.",))
    return figure


@dataclass(frozen=True)
class Resonance:
    """A way to a vanishing divisor."""

    title: str
    inertia: tuple[float, float, float]
    rotor_momentum: Callable[[float], float]  # of the detuning
    spin: Callable[[float], float]


RESONANCES: Final = (
    Resonance("X → 0: r₀ = −ν", (8.0, 7.0, 12.0), lambda x: -12.0 - x, lambda x: 1.0),
    Resonance("X → r₀(D₁ + D₂): r₀ = ν", (8.0, 7.0, 12.0), lambda x: 3.0 + x, lambda x: 1.0),
    Resonance("κ₁ → 0: ν = 0", (8.0, 7.0, 12.0), lambda x: -5.0 - x, lambda x: 1.0),
    Resonance("κ₂ → 0: ν = 0", (8.0, 7.0, 12.0), lambda x: -4.0 + x, lambda x: 1.0),
    Resonance("r₀ → 0", (8.0, 7.0, 12.0), lambda x: 2.0, lambda x: x),
    Resonance("all at once: ν, r₀ → 0", (8.0, 7.0, 12.0), lambda x: x, lambda x: x),
)


def linear_truth(given: dict[str, Any], t: float) -> dict[str, complex]:
    """Tilt, velocity and position across the axis of the linear motion from rest in long double, by Taylor series of its equations;
    the force along axis 3."""
    (D1, D2, D3), (_, _, r0) = given["inertia"], given["angular_velocity"]
    r = np.longdouble(r0)
    Lambda = np.longdouble(given["rotor_momentum"]) - np.longdouble(given["charge_momentum"])
    k1, k2 = ((D3 - D2) * r + Lambda) / D1, ((D3 - D1) * r + Lambda) / D2
    mean, half = (k1 + k2) / 2, (k2 - k1) / 2
    mu = np.longdouble(given["torque"][0]) / D1 + 1j * np.longdouble(given["torque"][1]) / D2
    pull = -1j * np.longdouble(given["force"][2]) / np.longdouble(given["mass"])
    # chi = e^(i r0 t), chi Pi, chi Pi~, chi Gamma, v, x
    A = np.zeros((6, 6), dtype=np.clongdouble)
    A[0, 0] = 1j * r
    A[1, 0], A[1, 1], A[1, 2] = mu, 1j * (r + mean), 1j * half
    A[2, 0], A[2, 1], A[2, 2] = np.conj(mu), -1j * half, 1j * (r - mean)
    A[3, 1] = A[5, 4] = 1.0
    A[4, 3] = pull
    y = np.array([1, 0, 0, 0, 0, 0], dtype=np.clongdouble)
    steps = max(1, math.ceil(4.0 * t * (abs(r0) + abs(float(k1)) + abs(float(k2)))))
    h = np.longdouble(t) / steps
    for _ in range(steps):
        term = y
        for k in range(1, 25):
            term = (A @ term) * (h / k)
            y = y + term
    return {"tilt": complex(y[3] / y[0]), "velocity": complex(y[4]), "position": complex(y[5])}


def losses(resonance: Resonance, detuning: float, t: float) -> dict[str, tuple[float, float]]:
    """Relative errors of the linear motion by the published forms (exact but for their divisors) and by ours, by quantity."""
    given = {**Case().given(), "inertia": resonance.inertia, "rotor_momentum": resonance.rotor_momentum(detuning), "charge_momentum": 0.0,
             "angular_velocity": (0.0, 0.0, resonance.spin(detuning)), "torque": (0.4, -0.2, 0.0)}
    _, problem = spinning.problems(given)
    published = _core.spinning_published(problem, reading="exact", t=np.array([t]))
    ours = spinning.linear(**given, t=np.array([t]))
    made = {}
    for (name, true), mine in zip(linear_truth(given, t).items(), (ours.euler_312, ours.velocity, ours.position), strict=True):
        values = (complex(*rows[0, :2]) for rows in (published[name], mine))
        theirs, own = (abs(value - true) / abs(true) for value in values)
        made[name] = (theirs, own)
    return made


def _resonance() -> "Figure":
    figure = new_figure(15.0, 9.4)
    panels = figure.subplots(2, 3)
    detunings, t = np.geomspace(1e-12, 0.1, 45), 10.0
    least = 1e-17
    for axes, resonance in zip(panels.flat, RESONANCES, strict=True):
        made = [losses(resonance, x, t) for x in detunings.tolist()]
        for colour, name in zip(COLOURS, made[0], strict=False):
            theirs, ours = np.array([loss[name] for loss in made]).T
            axes.loglog(detunings, np.clip(np.where(np.isfinite(theirs), theirs, np.nan), least, 1e3), color=colour, linewidth=1.1,
                        label=f"{name}, published form")
            axes.loglog(detunings, np.maximum(ours, least), "o", color=colour, markersize=3, label=f"{name}, divided differences")
        axes.axhline(2e-13, color="#555555", linestyle=":", linewidth=1)
        axes.set_title(resonance.title, loc="left", fontsize=10)
        axes.set_xlabel("detuning [N m s or rad/s]")
        axes.set_ylabel("relative error at t = 10 s [1]")
        axes.set_ylim(least, 1e4)
        axes.grid(alpha=0.25)
        axes.legend(fontsize=7)
    finish(figure, "What a vanishing divisor costs: D = (8, 7, 12) kg m², r₀ = 1 rad/s unless said, M = (0.4, −0.2) N m, f₃ = 3 N", (
        "The published forms, with κ for ζ so that only rounding is left, divide by ν, r₀ and r₀ ± ν: Γ loses ε/δ, v ε/δ², x ε/δ³: of x no digit "
        "is left where the divisor is a millionth. Divided differences of the exponential have no divisors: below 2e-13 (dotted) at every detuning, and at zero.",))
    return figure
