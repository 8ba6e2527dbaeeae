# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 and 3 of the paper on the gyrostat with a motor of limited power, and figures of our own on the same questions."""

import math
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core, rotation, rotor
from gyrostat.answer import Answer
from gyrostat.drawing import COLOURS, Drawing, finish, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["drawings", "figures", "growing_part"]

Vectors = NDArray[np.float64]

PAPER: Final = "rotor"
START: Final = (10.0, 11.0, 0.01, 5.0)  # gamma1, gamma2, beta*', gamma3 of the paper
SHARE: Final = 1e-4  # of that start, for the full motion: 10 rad is no small angle

# A body with two attractors.
TWO: Final[dict[str, Any]] = {
    "inertia": [[3.2, 0.1, -0.15], [0.1, 4.1, 0.2], [-0.15, 0.2, 5.0]], "axial_inertia": 0.35, "no_load_rate": 3.0,
    "axis": (np.array([0.75, 0.35, 0.56]) / math.sqrt(0.75**2 + 0.35**2 + 0.56**2)).tolist()}


def figures() -> list[str]:
    """Numbers of the paper's figures, and names of our own."""
    return ["2", "3", *OWN]


def drawings(wanted: Sequence[str]) -> list[Drawing]:
    """What draws these figures; 2 and 3 share a file."""
    made: list[Drawing] = []
    if "2" in wanted or "3" in wanted:
        made.append((f"{PAPER}-figures-2-3", _paper))
    return made + [(f"{PAPER}-{name}", draw) for name, draw in OWN.items() if name in wanted]


# ---- the paper's example ----


def _published(reading: str, t: Vectors) -> Vectors:
    """gamma1, gamma2, beta*' and gamma3 (n, 4) of the paper's linear equations from its start."""
    made: Vectors = _core.rotor_published_run(reading=reading, times=t)
    return made


def _body(reading: str) -> dict[str, Any]:
    """The gyrostat of a reading; a no-load rate that was not given is zero."""
    data = _core.rotor_published_data(reading)
    given = {key: data[key] for key in ("inertia", "axis", "axial_inertia", "slope", "no_load_rate")}
    return {**given, "no_load_rate": np.nan_to_num(given["no_load_rate"])}


def _exponents(reading: str) -> str:
    """Those of the linear equations, for reading."""
    values = sorted(np.linalg.eigvals(_core.rotor_published_matrix(reading)), key=lambda d: (d.real, -d.imag))
    return ", ".join(f"{d.real:+.4g}" if d.imag == 0 else f"{d.real:+.4g} ± {d.imag:.4g}i" for d in values if d.imag >= 0)


def growing_part() -> tuple[float, float, float]:
    """What part of gamma1(0) belongs to the growing mode of the printed equations [rad], and gamma2/gamma1 of the start and of the slower
    decaying mode."""
    values, modes = np.linalg.eig(_core.rotor_published_matrix("printed"))
    weights = np.linalg.solve(modes, np.array(START[:3]))
    grows = int(np.argmax(values.real))
    slow = modes[:, np.argsort(values.real)[1]].real
    return float(abs(weights[grows] * modes[0, grows])), START[1] / START[0], float(slow[1] / slow[0])


def _full(body: dict[str, Any], l: float, m: Vectors, psi_dot: float, t: Vectors, start: Sequence[float]) -> Vectors:
    """gamma1, gamma2, beta*' and gamma3 (n, 4) of the full motion: H/l x m, and the phase about m ahead of psi_dot t."""
    frame = _frame(m)
    # P0 takes m to the inertial axis 3; the start is turned by gamma from it.
    P0 = np.stack([frame[0], frame[1], m])
    P = P0 @ rotation.matrix_from_vector(start[0] * frame[0] + start[1] * frame[1] + start[3] * m)
    theta = np.diag(np.asarray(body["inertia"], dtype=float))
    e, lam = np.asarray(body["axis"]), body["axial_inertia"]
    rate = body["no_load_rate"] + start[2]
    H = P.T @ np.array([0.0, 0.0, l])
    Omega = np.linalg.solve(theta, H - lam * rate * e)
    answer = rotor.solve(**body, angular_velocity=Omega, rotor_rate=rate, attitude=rotation.quaternion_from_matrix(P), times=t, tolerance=1e-10,
                         model="full")
    turned = rotation.matrix_from_quaternion(np.asarray(answer["attitude"]))
    c, s = np.cos(psi_dot * t), np.sin(psi_dot * t)
    still = np.zeros((len(t), 3, 3))
    still[:, 0, 0], still[:, 0, 1], still[:, 1, 0], still[:, 1, 1], still[:, 2, 2] = c, -s, s, c, 1.0
    off = np.einsum("ji,nkj,nkl->nil", P0, still, turned)
    across = np.cross(answer["angular_momentum"] / l, m)
    q = rotation.quaternion_from_matrix(off)
    phase = np.unwrap(2.0 * np.arctan2(q[:, :3] @ m, q[:, 3]))
    made: Vectors = np.column_stack([across @ frame[0], across @ frame[1], answer["rotor_rate"] - body["no_load_rate"],
                                     phase - phase[0] + start[3]])
    return made


def _frame(m: Vectors) -> tuple[Vectors, Vectors]:
    """Two unit vectors across m; with m right-handed. For m = e3 they are e1 and e2."""
    first = np.array([1.0, 0.0, 0.0]) - m[0] * m
    first /= np.linalg.norm(first)
    return first, np.cross(m, first)


def _paper() -> "Figure":
    columns: list[tuple[str, float, list[tuple[str, str, float, Vectors]]]] = []
    for end in (6.0, 12.0):
        t = np.linspace(0.0, end, 601)
        columns.append((f"as printed, to {end:g} s", end, [("printed", "-", 1.0, _published("printed", t))]))
    t = np.linspace(0.0, 12.0, 601)
    small = [SHARE * part for part in START]
    e3 = np.array([0.0, 0.0, 1.0])
    body = _body("printed")
    columns.append(("right algebra, printed data", 12.0, [
        ("linear", "--", 1.0, _published("corrected", t)),
        ("full motion", "-", 1 / SHARE, _full(body, 1.0, e3, 1.0 / 7.0, t, small))]))
    t = np.linspace(0.0, 60.0, 1201)
    columns.append(("repaired: L = 7 N m s, ω* = 0", 60.0, [
        ("full motion", "-", 1 / SHARE, _full(_body("repaired"), 7.0, e3, 1.0, t, small)),
        ("linear", "--", 1.0, _published("repaired", t))]))
    part, ratio, slow_ratio = growing_part()
    figure = new_figure(20.0, 9.0)
    panels = figure.subplots(2, len(columns))
    for column, (title, end, runs) in enumerate(columns):
        t = np.linspace(0.0, end, len(runs[0][3]))
        for name, dashes, scale, values in runs:
            for row, first, words in ((0, 0, ("γ₁", "γ₂")), (1, 2, ("β̇*", "γ₃"))):
                for i, word in enumerate(words):
                    panels[row, column].plot(t, scale * values[:, first + i], linestyle=dashes, color=COLOURS[i] if dashes == "-" else ("black", "#777777")[i],
                                             linewidth=1.6 if dashes == "-" else 0.9, label=f"{word}, {name}")
        panels[0, column].set_title(title, loc="left", fontsize=11)
        for row in (0, 1):
            axes = panels[row, column]
            axes.set_xlabel("time [s]")
            axes.set_xlim(0.0, end)
            axes.grid(alpha=0.25)
            axes.legend(fontsize=8)
    panels[0, 0].set_ylabel("Fig. 2: γ₁, γ₂ [rad]")
    panels[1, 0].set_ylabel("Fig. 3: β̇* [rad/s], γ₃ [rad]")
    finish(figure, "Figures 2 and 3: small deviations from a steady rotation, θ = diag(3, 5, 7) kg m², λ = 2 kg m², S = 4 N m s/rad", (
        "As printed: shown up to 6 s the curves decay, and the paper concludes that the motion is stable. But the printed system has the "
        f"exponents {_exponents('printed')} 1/s: it grows after about 6 s. The printed start lies almost on the eigenvector of the slower decay "
        f"(γ₂/γ₁ = {ratio:.3f} against {slow_ratio:.3f}): of γ₁(0) = 10 rad only {part:.1e} rad belong to the growing mode, and they take about 6 s "
        "to overtake the rest.",
        f"Right algebra: with the signs of rows 1 and 3 corrected and λ restored the exponents are {_exponents('corrected')} 1/s: the printed data "
        "describe no steady rotation for any ω*, and linearised as if they did, a growing spiral. The full motion of that body (with ω* = 0, from a "
        "ten-thousandth of the printed start, drawn ten thousand times as large) turns at L/θ₃ = 1/7 rad/s, not at 1 rad/s, and nutates slowly "
        "(γ₃ is counted from that turn).",
        "Repaired: with L = 7 N m s and ω* = 0, (0, 0, 1) at 1 rad/s is a steady rotation and the global minimum of F: the linear solution "
        f"and the full motion agree and decay, with {_exponents('repaired')} 1/s. No mass distribution has these θ, λ and e, though: λ ≤ 1.72."))
    return figure


# ---- own figures ----


def _spin_up() -> "Figure":
    R, e, lam = np.diag([2.3, 2.9, 3.4]), np.array([0.36, 0.48, 0.8]), 0.45
    theta = R + lam * np.outer(e, e)
    slope, no_load = 0.05, 30.0
    m = np.array([0.3, -0.5, 0.8])
    m /= np.linalg.norm(m)
    Omega = np.linalg.solve(theta, 8.0 * m)
    t = np.linspace(0.0, 60.0, 3001)
    body: dict[str, Any] = {"inertia": theta, "axis": e, "axial_inertia": lam, "slope": slope, "no_load_rate": no_load}
    answer = rotor.solve(**body, angular_velocity=Omega, times=t, tolerance=1e-9, model="full")
    figure = new_figure(12.0, 9.0)
    panels = figure.subplots(3, 1, sharex=True)
    panels[0].plot(t, answer["rotor_rate"], color=COLOURS[0], label="rotor rate ω")
    panels[0].axhline(no_load, color="#555555", linestyle="--", linewidth=1, label="no-load rate ω*")
    panels[0].set_ylabel("rate of the rotor [rad/s]")
    H = answer["angular_momentum"]
    for i in range(3):
        panels[1].plot(t, H[:, i] / 8.0, color=COLOURS[i], linewidth=0.8, label=f"m{'₁₂₃'[i]}")
    panels[1].set_ylabel("direction of L, body axes [1]")
    steady = rotor.steady_rotations(**body, momentum=8.0)
    panels[2].semilogy(t, answer["lyapunov"] - steady.level[0], color=COLOURS[0], label="V − min F, full motion")
    for i in range(1, int(steady.count)):
        level = steady.level[i] - steady.level[0]
        panels[2].axhline(level, color="#999999", linewidth=0.8, linestyle=":")
        panels[2].annotate(f"{steady.type[i]}", (t[-1], level), fontsize=8, ha="right", va="bottom")
    panels[2].set_ylabel("V − min F [J]")
    panels[2].set_xlabel("time [s]")
    for axes in panels:
        axes.grid(alpha=0.25)
        axes.legend(fontsize=8, loc="best", ncols=3)
        axes.set_xlim(0.0, t[-1])
    finish(figure, "Spin-up of the rotor: R = diag(2.3, 2.9, 3.4) kg m², λ = 0.45 kg m², e = (0.36, 0.48, 0.8), S = 0.05 N m s/rad, "
           "ω* = 30 rad/s, L = 8 N m s", (
               "The rotor comes to its no-load rate and V never grows. The nutation that the spin-up leaves behind is felt by the motor, in the "
               f"ripple of ω, and dies with an e-fold of {1 / steady.decay_rate[0] / 3600:.2g} h.",))
    return figure


def _rate_vs_slope() -> "Figure":
    theta, lam, no_load, l = np.diag([86.0, 118.0, 141.0]), 0.28, 210.0, 90.0
    slopes = np.geomspace(1e-4, 1e2, 241)
    figure = new_figure(13.0, 6.0)
    panels = figure.subplots(1, 2)
    for colour, degrees in zip(COLOURS, (10.0, 3.7, 1.0), strict=False):
        tilt = math.radians(degrees)
        e = np.array([math.cos(tilt), math.sin(tilt) * 0.8, math.sin(tilt) * 0.6])
        found = rotor.steady_rotations(inertia=theta, axis=e, axial_inertia=lam, slope=slopes, no_load_rate=no_load, momentum=l)
        rate = found.decay_rate[:, 0]
        panels[0].loglog(slopes, rate, color=colour, label=f"rotor {degrees:g}° off the axis of least inertia")
        k3, s, kD, _ = found.cubic[:, 0].T
        coupling = kD - k3 * found.determinant[:, 0]
        weak = 0.5 * coupling * s / (s**2 + k3**2 * found.determinant[:, 0])
        panels[0].loglog(slopes, weak, color="black", linewidth=0.8, linestyle=":", label="weak coupling" if degrees == 10.0 else None)
        best = rotor.steady_rotations(inertia=theta, axis=e, axial_inertia=lam, slope=1.0, no_load_rate=no_load, momentum=l)
        panels[0].plot(best.best_slope[0], best.best_rate[0], marker="*", markersize=13, color=colour, markeredgecolor="black",
                       label=f"fastest: S = {best.best_slope[0]:.4g}, e-fold {1 / best.best_rate[0] / 86400:.3g} days")
    panels[0].set_xlabel("slope S of the motor [N m s/rad]")
    panels[0].set_ylabel("decay rate of the slowest mode [1/s]")
    tilts = np.geomspace(1e-3, 0.5, 61)
    axis = np.stack([np.cos(tilts), np.sin(tilts) * 0.8, np.sin(tilts) * 0.6], axis=-1)
    for colour, slope in zip(COLOURS, (0.004, 0.1345, 10.0), strict=False):
        found = rotor.steady_rotations(inertia=theta, axis=axis, axial_inertia=lam, slope=slope, no_load_rate=no_load, momentum=l)
        panels[1].loglog(np.degrees(tilts), found.decay_rate[:, 0], color=colour, label=f"S = {slope:g} N m s/rad")
    panels[1].loglog(np.degrees(tilts), 1e-6 * tilts**2, color="#555555", linestyle="--", linewidth=0.8, label="slope 2")
    panels[1].set_xlabel("angle of the rotor to the axis of least inertia [°]")
    panels[1].set_ylabel("decay rate of the slowest mode [1/s]")
    for axes in panels:
        axes.grid(alpha=0.25, which="both")
        axes.legend(fontsize=8, loc="best")
    finish(figure, "Decay of the nutation: θ = diag(86, 118, 141) kg m², λ = 0.28 kg m², ω* = 210 rad/s, L = 90 N m s", (
        "A motor that is too stiff damps as badly as one that is too weak: the rate grows like S, and falls like 1/S beyond "
        "S = λ k √D (stars). It goes with the square of the angle between rotor and principal axis: a well-aligned wheel can take years.",))
    return figure


def _basins() -> "Figure":
    from gyrostat.families.rotor.sphere import Sphere, from_disc

    l, across, longest = 8.0, 61, 4000.0
    theta, e = np.array(TWO["inertia"]), np.array(TWO["axis"])
    grid = (np.arange(across) + 0.5) / across * 2 - 1
    x, y = np.meshgrid(grid, grid)
    inside = x**2 + y**2 < 1
    views = Sphere(theta, e, l, TWO["axial_inertia"] * TWO["no_load_rate"]).views()
    slopes = (0.02, 0.2, 2.0)

    def ends(job: tuple[float, Vectors]) -> dict[str, Vectors]:
        slope, view = job
        Omega = np.linalg.solve(theta, l * from_disc(view, x[inside], y[inside]).T).T  # the rotor at rest
        made: dict[str, Vectors] = _core.rotor_capture(**TWO, slope=slope, angular_velocity=Omega, rotor_rate=np.zeros(len(Omega)),
                                                       longest=longest, tolerance=1e-6)
        return made

    with ThreadPoolExecutor() as pool:
        caught = list(pool.map(ends, [(slope, view) for slope in slopes for view in views]))
    figure = new_figure(13.5, 9.6)
    panels = figure.subplots(2, 3)
    seen = []
    for column, slope in enumerate(slopes):
        steady = rotor.steady_rotations(**TWO, slope=slope, momentum=l)
        both = caught[2 * column: 2 * column + 2]
        for axes, view, made, name in zip(panels[:, column], views, both, ("e", "−e"), strict=True):
            picture = np.full(x.shape, np.nan)
            picture[inside] = made["index"]
            _basin(axes, view, picture, steady)
            axes.set_title(f"S = {slope:g} N m s/rad, around {name}", fontsize=10)
        index, time = (np.concatenate([made[key] for made in both]) for key in ("index", "time"))
        seen.append(f"S = {slope:g}: {100 * float(np.mean(index == 0)):.1f} % of the sphere goes to attractor 0; median time to the "
                    f"certificate {float(np.median(time)):.3g} s.")
    finish(figure, "Which attractor: direction of L in the body at the start, rotor at rest, L = 8 N m s", (
        f"Blue: goes to attractor 0, the global minimum; orange: to attractor 1; dark: not decided within {longest:g} s. Black: level of the "
        "lowest saddle.", *seen,
        "Inside the closed black lines V alone, were the rotor at its no-load rate, certifies the attractor at once. Outside, the basins are "
        "interleaved bands, the thinner the more turns the motion takes to its capture, with a weak and with a stiff motor."))
    return figure


def _basin(axes: "Axes", view: Vectors, picture: Vectors, steady: rotor.SteadyRotations) -> None:
    """A hemisphere with the attractor of each start, the level of the lowest saddle, minima and saddles."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Circle

    from gyrostat.families.rotor.sphere import Sphere, from_disc, onto_disc

    sphere = Sphere(np.array(TWO["inertia"]), np.array(TWO["axis"]), 8.0, TWO["axial_inertia"] * TWO["no_load_rate"])
    drawn = axes.imshow(picture, origin="lower", extent=(-1, 1, -1, 1), interpolation="nearest", vmin=-1.5, vmax=1.5,
                        cmap=ListedColormap(["#444444", COLOURS[5], COLOURS[4]]))
    rim = Circle((0, 0), 1.0, facecolor="none", edgecolor="black")
    axes.add_patch(rim)
    drawn.set_clip_path(rim)
    fine = np.linspace(-1, 1, 301)
    X, Y = np.meshgrid(fine, fine)
    shrunk = np.maximum(np.hypot(X, Y), 1.0) * (1 + 1e-9)
    saddle = float(steady.level[list(steady.type).index("saddle")])
    axes.contour(X, Y, sphere.level(from_disc(view, X / shrunk, Y / shrunk)), levels=[saddle], colors="black",
                 linewidths=0.9).set_clip_path(rim)
    for i in range(int(steady.count)):
        px, py, front = onto_disc(view, steady.direction[i])
        if front and steady.type[i] in ("min", "saddle"):
            axes.plot(px, py, "o" if steady.type[i] == "min" else "X", color="white", markeredgecolor="black", markersize=8)
            axes.annotate(str(i), (px, py), xytext=(6, 4), textcoords="offset points", fontsize=9, fontweight="bold")
    axes.set_aspect("equal")
    axes.axis("off")


def _circular_section() -> "Figure":
    theta = np.array([3.0, 4.0, 5.5])
    j1, j2, j3 = 1 / theta
    e = np.array([theta[0] * math.sqrt(j1 - j2), 0.0, theta[2] * math.sqrt(j2 - j3)])
    e /= np.linalg.norm(e)
    lam, slope, l = 0.5, 0.5, 6.0
    n = e / theta
    nhat, u = n / np.linalg.norm(n), np.array([0.0, 1.0, 0.0])
    v = np.cross(nhat, u)
    hold = l * float(nhat @ (v / theta))
    no_load = 2.0 * abs(hold) / float(np.linalg.norm(n)) / lam
    drive = lam * no_load * float(np.linalg.norm(n))
    body: dict[str, Any] = {"inertia": theta, "axis": e, "axial_inertia": lam, "slope": slope, "no_load_rate": no_load}
    section = _core.rotor_circular_section(**body, momentum=l)

    def run(off: float, t: Vectors) -> Answer:
        m = math.cos(off) * u + math.sin(off) * nhat
        Omega = (l * m - lam * no_load * e) / theta
        return rotor.solve(**body, angular_velocity=Omega, rotor_rate=no_load, times=t, tolerance=1e-9, model="full")

    figure = new_figure(14.0, 5.4)
    panels = figure.subplots(1, 3)
    t = np.linspace(0.0, 60.0, 1201)
    answer = run(0.0, t)
    m = answer["angular_momentum"] / l
    phi = np.unwrap(np.arctan2(m @ v, m @ u))
    rate = math.sqrt(drive**2 - hold**2)
    # phi' = drive - hold sin(phi), by the half angle
    half = 0.5 * rate * t
    first = math.atan2(-hold, rate)
    closed = 2 * np.arctan2(hold * np.cos(half + first) + rate * np.sin(half + first), drive * np.cos(half + first))
    panels[0].plot(t, np.degrees(phi - phi[0]), color=COLOURS[0], linewidth=2.5, alpha=0.5, label="full motion")
    panels[0].plot(t, np.degrees(np.unwrap(closed) - closed[0]), color="black", linestyle="--", linewidth=0.9, label="closed form")
    difference = np.max(np.abs(np.angle(np.exp(1j * (phi - closed)))))
    panels[0].set_title(f"on the circle; greatest difference {difference:.1e} rad", loc="left", fontsize=10)
    panels[0].set_ylabel("angle φ run on the circle [°]")
    for panel, offs in ((panels[1], (-0.02, -0.1, -0.4)), (panels[2], (0.01, 0.1, 0.4))):
        for colour, off in zip(COLOURS, offs, strict=False):
            t = np.linspace(0.0, 4000.0, 8001)
            V = run(off, t)["lyapunov"] - section["level"]
            panel.plot(t, 1 / V if off < 0 else V, color=colour, linewidth=1, label=f"start {abs(off):g} rad off the circle")
    panels[1].set_ylabel("1/(V − V of the circle) [1/J]")
    panels[1].set_title("from above: comes to the circle like 1/t", loc="left", fontsize=10)
    panels[2].set_ylabel("V − V of the circle [J]")
    panels[2].set_title("from below: leaves it", loc="left", fontsize=10)
    for axes in panels:
        axes.set_xlabel("time [s]")
        axes.grid(alpha=0.25)
        axes.legend(fontsize=8)
    finish(figure, "A triaxial body that never settles: n = J e normal to a circular section", (
        "The great circle n.m = 0 is invariant with ω = ω*; here the drive h|n| is twice the hold l|b|, so that H runs round the body "
        "for ever, although the motor dissipates all other motions. An open set of starts ends there.",))
    return figure


def _principal_axis() -> "Figure":
    theta, lam, slope, no_load, l = np.array([3.0, 4.0, 5.0]), 0.5, 0.4, 4.0, 6.0
    e = np.array([0.0, 0.0, 1.0])
    body: dict[str, Any] = {"inertia": theta, "axis": e, "axial_inertia": lam, "slope": slope, "no_load_rate": no_load}
    steady = rotor.steady_rotations(**body, momentum=l)
    c, level = float(steady.algebraic_rate[0]), float(steady.level[0])
    figure = new_figure(12.5, 5.6)
    panels = figure.subplots(1, 2)
    t = np.geomspace(1.0, 1e5, 2001)
    t = np.concatenate([[0.0], t])
    for colour, tilt in zip(COLOURS, (0.1, 0.3, 0.8), strict=False):
        m = np.array([math.sin(tilt), 0.0, math.cos(tilt)])
        answer = rotor.solve(**body, angular_velocity=(l * m - lam * no_load * e) / theta, rotor_rate=no_load, times=t, tolerance=1e-8,
                             model="full")
        W = answer["lyapunov"] - level
        angle = np.linalg.norm(np.cross(answer["angular_momentum"] / l, e), axis=1)
        panels[0].loglog(t[1:], W[1:], color=colour, label=f"full motion, start {tilt:g} rad off")
        panels[0].loglog(t[1:], 1 / (1 / W[0] + c * t[1:]), color="black", linestyle="--", linewidth=0.8,
                         label="1/W = 1/W₀ + c t" if tilt == 0.1 else None)
        panels[1].loglog(t[1:], angle[1:], color=colour, linewidth=0.6, label=f"start {tilt:g} rad off")
    late = t > 1e3
    panels[1].loglog(t[late], 12 / np.sqrt(t[late]), color="#555555", linestyle="--", linewidth=0.9, label="t^(−1/2)")
    panels[0].set_ylabel("W = V − F(e) [J]")
    panels[1].set_ylabel("sine of the angle of e to L [1]")
    for axes in panels:
        axes.set_xlabel("time [s]")
        axes.grid(alpha=0.25, which="both")
        axes.legend(fontsize=8)
    finish(figure, "A rotor on a principal axis: θ = diag(3, 4, 5) kg m², e = axis 3, λ = 0.5 kg m², S = 0.4 N m s/rad, "
           "ω* = 4 rad/s, L = 6 N m s", (
               f"Beside that of the motor, the exponents of m = e are ±i√D: the nutation dies algebraically, 1/W = 1/W₀ + c t with c = {c:.4g} 1/(J s) from the closed form (dashed), and its angle like t^(−1/2).",))
    return figure


def _linear(body: dict[str, Any], l: float, m0: Vectors, psi_dot: float, start: Vectors, t: Vectors) -> tuple[Vectors, Vectors]:
    """Directions m (n, 3) and attitudes (n, 3, 3) of the linear solution (4.3) from the direction `start`, the rotor at its no-load rate and
    the attitude that is the identity at first."""
    frame = np.stack(_frame(m0))
    J = np.linalg.inv(np.diag(body["inertia"]))
    n, lam = J @ body["axis"], body["axial_inertia"]
    k = 1 - lam * float(n @ body["axis"])
    B = l * J - psi_dot * np.eye(3)
    turn = np.cross(np.broadcast_to(m0, (2, 3)), frame @ B).T  # of dm' by the components of dm across m0
    A = np.zeros((3, 3))
    A[:2, :2] = frame @ turn
    A[:2, 2] = frame @ np.cross(m0, -lam * n)
    A[2] = -l / k * (n @ frame.T) @ A[:2]
    A[2, 2] -= body["slope"] / (lam * k)
    values, modes = np.linalg.eig(A)
    weights = np.linalg.solve(modes, np.append(frame @ (start - m0), 0.0).astype(complex))
    course = np.exp(values * t[:, None])
    y = np.real((course * weights) @ modes.T)
    # gamma3' = m0.J (l dm - lambda x e)
    pull = np.append(l * (J @ m0) @ frame.T, -lam * float(m0 @ n))
    gamma3 = np.real(((course - 1.0) / values * weights) @ modes.T @ pull)
    dm = y[:, :2] @ frame
    gamma = np.cross(dm, m0) + gamma3[:, None] * m0
    P = rotation.matrix_from_vector(psi_dot * t[:, None] * m0) @ rotation.matrix_from_vector(gamma)
    return m0 + dm, np.swapaxes(P[:1], 1, 2) @ P


def _linear_vs_nonlinear() -> "Figure":
    body, l = _body("realisable"), 7.0
    steady = rotor.steady_rotations(**body, momentum=l)
    m0, psi_dot, rate = steady.direction[0], float(steady.spin_rate[0]), float(steady.decay_rate[0])
    across, _ = _frame(m0)
    theta, e = np.array(body["inertia"]), np.array(body["axis"])
    t = np.linspace(0.0, 1000.0, 4001)
    sizes = np.geomspace(1e-4, 0.3, 9)
    errors = []
    figure = new_figure(14.0, 5.4)
    panels = figure.subplots(1, 3)
    for size in sizes:
        start = math.cos(size) * m0 + math.sin(size) * across
        given: dict[str, Any] = {"angular_velocity": (l * start - body["axial_inertia"] * body["no_load_rate"] * e) / theta,
                                 "rotor_rate": body["no_load_rate"], "times": t, "tolerance": 1e-12}
        full, tail = (rotor.solve(**body, **given, model=model) for model in ("full", "linear-tail"))
        m, P = _linear(body, l, m0, psi_dot, start, t)
        turn = rotation.angle_between(full["attitude"], rotation.quaternion_from_matrix(P))
        off = np.linalg.norm(full["angular_momentum"] / l - m, axis=1)
        errors.append((np.max(off), np.max(turn), np.max(rotation.angle_between(full["attitude"], tail["attitude"]))))
        if size == sizes[-1]:
            panels[0].plot(t, full["angular_momentum"] @ across / l, color=COLOURS[0], label="full motion")
            panels[0].plot(t, m @ across, color=COLOURS[1], linestyle="--", linewidth=0.9, label="linear")
            panels[0].set_title(f"start {size:g} rad off the steady rotation", loc="left", fontsize=10)
        if size in sizes[[2, 5, 8]]:
            panels[1].semilogy(t[1:], turn[1:], linewidth=0.9, label=f"start {size:.2g} rad off")
    made = np.array(errors)
    panels[1].set_title("attitude, linear", loc="left", fontsize=10)
    for i, (marker, label) in enumerate((("o", "direction of L in the body, linear"), ("s", "attitude, linear"),
                                         ("^", "attitude, tail of second order"))):
        panels[2].loglog(sizes, made[:, i], marker + "-", color=COLOURS[i], label=label)
    panels[2].loglog(sizes, sizes**2 * abs(psi_dot) / rate * 0.3, color="#555555", linestyle="--", linewidth=0.9, label="0.3 ε² |ψ̇|/rate")
    panels[0].set_xlim(0.0, 60.0)
    panels[0].set_ylabel("component of m across the steady direction [1]")
    panels[1].set_ylabel("difference from the full motion [rad]")
    panels[2].set_ylabel("greatest difference [1, rad]")
    for axes in panels[:2]:
        axes.set_xlabel("time [s]")
    panels[2].set_xlabel("distance ε of the start [rad]")
    for axes in panels:
        axes.grid(alpha=0.25, which="both")
        axes.legend(fontsize=8)
    finish(figure, "The linear solution against the full motion: the paper's body with λ = 0.5 kg m², L = 7 N m s, ω* = 1 rad/s", (
        "Both differences of the linear solution fall with the square of the distance. That of the attitude is greater by |ψ̇|/rate: the spin "
        "about L depends on the square of the nutation, and the phase keeps what it gained while the nutation died. The rung linear-tail goes "
        "to second order and errs with the third power.",))
    return figure


OWN: Final = {
    "spin-up": _spin_up, "rate-vs-slope": _rate_vs_slope, "basins": _basins, "circular-section": _circular_section,
    "principal-axis": _principal_axis, "linear-vs-nonlinear": _linear_vs_nonlinear,
}
