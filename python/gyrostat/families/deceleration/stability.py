# SPDX-License-Identifier: BSD-3-Clause
"""Where unequal control torques drive the orbit of a body without rotor momentum: table, report and figure."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gyrostat import _core, deceleration
from gyrostat.drawing import COLOURS, new_figure
from gyrostat.errors import DomainError
from gyrostat.scenes import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_regions", "plot", "quasi_stationary_line", "report", "sentence", "tables"]

REGIONS: Final = {
    "to-axis": ("#56B4E9", "to the axis (k² = 0)"),
    "to-separatrix": ("#E69F00", "to the separatrix (k² = 1)"),
    "to-interior": ("#009E73", "to k*²"),
    "from-interior": ("#CC79A7", "away from k*²"),
    "neutral": ("#999999", "k² stands still"),
}
AXES: Final = {"A": "the axis of largest inertia", "C": "the axis of smallest inertia"}


def report(scene: Scene) -> dict[str, Any]:
    """Stability table of a deceleration scene without rotor momentum, as plain data.

    principal_moments : A > B > C [kg m2]; control : torques about these axes [N m]; torque_ratios : b1/b3 and b2/b3
    (None where b3 is 0); start : regime and k2 of the start and the regime and k2 that it tends to; regimes : for A and C
    the region, what k2 = 0, the quasi-stationary k2 and the separatrix do, and that k2 (None where there is none).
    Drag moves no k2. Raises DomainError with rotor momentum, with two equal moments, or at rest.
    """
    given = deceleration.arguments(scene)
    if np.any(given["rotor_momentum"] != 0):
        raise DomainError(f"body.rotor_momentum = {given['rotor_momentum'].tolist()}: the stability table holds without "
                          "rotor momentum only; set it to zero, or solve the scene")
    start = _core.deceleration_polhode_start(inertia=given["inertia"], control=given["control"],
                                             angular_momentum=given["angular_momentum"])
    tables = {regime: _tendencies(start.torques, regime) for regime in AXES}
    b1, b2, b3 = start.torques.tolist()
    regime, k2 = _attractor(start.regime, start.modulus_squared, tables)
    return {
        "scene": scene.name,
        "principal_moments": start.moments.tolist(),
        "control": [b1, b2, b3],
        "torque_ratios": [b1 / b3, b2 / b3] if b3 > 0 else None,
        "start": {"regime": start.regime, "modulus_squared": start.modulus_squared,
                  "tends_to": {"regime": regime, "modulus_squared": k2}},
        "regimes": tables,
    }


def _tendencies(torques: NDArray[np.float64], regime: str) -> dict[str, Any]:
    made = deceleration.stability(control=torques[None, :], regime=regime)
    star = float(made.quasi_stationary[0])
    return {"region": str(made.region[0]), "axis": str(made.axis[0]), "interior": str(made.interior[0]),
            "separatrix": str(made.separatrix[0]),
            "quasi_stationary": None if math.isnan(star) else star}


def _attractor(regime: str, k2: float, tables: Mapping[str, Mapping[str, Any]]) -> tuple[str, float]:
    """Regime and k2 that a start tends to, through the separatrix at most once."""
    for _ in AXES:
        table = tables[regime]
        region, star = table["region"], table["quasi_stationary"]
        if region == "neutral" or k2 == star:
            return regime, k2
        if region == "to-interior":
            return regime, star
        if region == "to-axis" or (region == "from-interior" and k2 < star):
            return regime, 0.0
        other = "C" if regime == "A" else "A"
        if tables[other]["separatrix"] == "attracts":
            break
        regime, k2 = other, 1.0
    return "separatrix", 1.0


def sentence(report: Mapping[str, Any]) -> str:
    """Where the start is and where the torques drive it."""
    start = report["start"]
    end = start["tends_to"]
    where = f"The start has k² = {start['modulus_squared']:.6g} in regime {start['regime']} (about {AXES[start['regime']]}); "
    if end["regime"] == "separatrix":
        return where + "the torques drive it to the separatrix, which attracts from both sides: averaging is poor there."
    crosses = "" if end["regime"] == start["regime"] else "through the separatrix "
    if end["modulus_squared"] == start["modulus_squared"]:
        return where + "the torques leave it there."
    if end["modulus_squared"] == 0:
        return where + f"the torques drive it {crosses}to rotation about {AXES[end['regime']]}."
    return where + f"the torques drive it {crosses}to the quasi-stationary k² = {end['modulus_squared']:.6g} of regime {end['regime']}."


def tables(report: Mapping[str, Any]) -> list[tuple[str, list[str], list[list[str]]]]:
    """Titles, heads and rows for reading."""
    rows = [[name, AXES[name], t["region"].replace("-", " "), t["axis"],
             "none" if t["quasi_stationary"] is None else f"{t['quasi_stationary']:.9g} {t['interior']}", t["separatrix"]]
            for name, t in report["regimes"].items()]
    return [(f"{report['scene']}: what k² of the orbit does",
             ["regime", "about", "flow", "k² = 0", "quasi-stationary k²", "separatrix"], rows)]


def draw_regions(axes: "Axes", regime: str, extent: float) -> None:
    """Shade the regions of a regime in the plane of b1/b3 and b2/b3, from 0 to `extent`."""
    from matplotlib.colors import ListedColormap

    kappa = np.linspace(0.0, extent, 601)
    k1, k2 = np.meshgrid(kappa, kappa)
    near, far = (k1, np.ones_like(k1)) if regime == "A" else (np.ones_like(k1), k1)
    grows_at_axis, grows_at_separatrix = 2 * near > k2 + far, near > far
    names = ("to-axis", "to-separatrix", "to-interior", "from-interior")
    index = np.select([~grows_at_axis & ~grows_at_separatrix, grows_at_axis & grows_at_separatrix,
                       grows_at_axis & ~grows_at_separatrix], [0, 1, 2], 3)
    axes.imshow(index, origin="lower", extent=(0.0, extent, 0.0, extent), aspect="equal", interpolation="nearest", vmin=-0.5,
                vmax=3.5, cmap=ListedColormap([REGIONS[name][0] for name in names]), alpha=0.4)
    for name in names:
        axes.fill_between([], [], color=REGIONS[name][0], alpha=0.4, linewidth=0, label=REGIONS[name][1])
    axes.set_xlim(0.0, extent)
    axes.set_ylim(0.0, extent)
    axes.set_xlabel("κ₁ = b₁/b₃ [1]")
    axes.set_ylabel("κ₂ = b₂/b₃ [1]")


def quasi_stationary_line(regime: str, modulus_squared: float, kappa2: NDArray[np.float64]) -> NDArray[np.float64]:
    """b1/b3 on the line of a quasi-stationary k2."""
    phi = float(_core.deceleration_torque_balance(modulus_squared))
    if regime == "A":
        return 1.0 + (kappa2 - 1.0) * phi
    return (1.0 - kappa2 * phi) / (1.0 - phi)


def plot(_: Scene, report: Mapping[str, Any]) -> "Figure":
    """Regions of both regimes with the scene's point, and the torque balance that gives the quasi-stationary k2."""
    figure = new_figure(14.5, 5.6)
    panels = figure.subplots(1, 3)
    ratios = report["torque_ratios"]
    extent = 2.0 if ratios is None else max(2.0, 1.25 * max(ratios))
    for axes, (regime, table) in zip(panels, report["regimes"].items(), strict=False):
        draw_regions(axes, regime, extent)
        kappa2 = np.linspace(0.0, extent, 201)
        for k2 in (0.5, 0.8, 0.95):
            line = quasi_stationary_line(regime, k2, kappa2)
            axes.plot(line, kappa2, color="#555555", linewidth=0.6)
            axes.annotate(f"{k2:g}", (line[-1], extent), fontsize=7, color="#555555", ha="center", va="bottom")
        if ratios is not None:
            axes.plot(*ratios, "o", color="black", markersize=7, label=f"scene ({ratios[0]:.3g}, {ratios[1]:.3g})")
        star = table["quasi_stationary"]
        if star is not None:
            axes.plot(quasi_stationary_line(regime, star, kappa2), kappa2, color="black", linewidth=1.5, label=f"regime {regime}: k*² = {star:.4g}")
        axes.set_title(f"regime {regime}: about {AXES[regime]}", loc="left", fontsize=10, pad=14)
    marked = {label: handle for axes in panels[:2] for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)}
    figure.legend(marked.values(), marked.keys(), loc="outside lower center", ncols=len(marked), fontsize=8)

    moduli = np.linspace(0.0, 1.0, 401)
    panels[2].plot(moduli, _core.deceleration_torque_balance(moduli), color="black", label="φ(k²) = (1 - k²) W/(k² F)")
    b1, b2, b3 = report["control"]
    for colour, (regime, near, far) in zip(COLOURS, (("A", b1, b3), ("C", b3, b1)), strict=False):
        if b2 != far:
            level = (near - far) / (b2 - far)
            inside = -0.1 < level < 0.65
            label = f"regime {regime}: (b_near - b_far)/(b_mid - b_far) = {level:.4g}"
            panels[2].axhline(level if inside else np.nan, color=colour, linestyle="--", label=label + ("" if inside else " (off)"))
    k2_start = report["start"]["modulus_squared"]
    panels[2].axvline(k2_start, color="#999999", linestyle=":", label=f"start: k² = {k2_start:.4g}, regime {report['start']['regime']}")
    panels[2].set_xlim(0.0, 1.0)
    panels[2].set_ylim(-0.1, 0.65)
    panels[2].set_box_aspect(1.0)
    panels[2].set_xlabel("k² [1]")
    panels[2].set_ylabel("φ [1]")
    panels[2].set_title("torque balance: k*² where φ meets the level", loc="left", fontsize=10, pad=14)
    panels[2].legend(loc="upper right", fontsize=7)
    figure.suptitle(f"{report['scene']}: {sentence(report)}", fontsize=9)
    return figure
