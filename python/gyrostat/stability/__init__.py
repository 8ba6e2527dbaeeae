# SPDX-License-Identifier: BSD-3-Clause
"""Where a scene goes for large time: table, report and figure, for each kind."""

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, Final

from gyrostat.console import say, show_table
from gyrostat.errors import DomainError
from gyrostat.scenes import Scene, scene_from
from gyrostat.stability import deceleration, heavy, rotor

__all__ = ["plot_stability", "report_stability", "stability_report"]

# Each module makes the `report` of a scene, and its `tables`, `sentence` and `plot`.
KINDS: Final[dict[str, ModuleType]] = {"deceleration": deceleration, "rotor": rotor, "heavy": heavy}


def stability_report(scene: Scene | Mapping[str, Any]) -> dict[str, Any]:
    """The stability of a scene as plain data; see `report` of the module of its kind.

    Raises DomainError where the question has no meaning for the scene.
    """
    checked = scene if isinstance(scene, Scene) else scene_from(scene)
    if checked.kind not in KINDS:
        raise DomainError(f"kind = {checked.kind!r}: a stability table is known for the kinds {', '.join(KINDS)}")
    made: dict[str, Any] = {"kind": checked.kind, **KINDS[checked.kind].report(checked)}
    return made


def plot_stability(scene: Scene | Mapping[str, Any], report: Mapping[str, Any] | None = None) -> Any:
    """The figure of a scene, from its report where there is one already. Needs matplotlib."""
    checked = scene if isinstance(scene, Scene) else scene_from(scene)
    return KINDS[checked.kind].plot(checked, report or stability_report(checked))


def report_stability(scene: Scene, *, as_json: bool = False, plot: Path | None = None) -> int:
    """Print the stability of a scene and write its figure; the exit status."""
    report = stability_report(scene)
    if as_json:
        say(json.dumps(report), sys.stdout)
    else:
        family = KINDS[report["kind"]]
        for title, heads, rows in family.tables(report):
            show_table(title, heads, rows, sys.stdout)
        say(family.sentence(report), sys.stdout)
    if plot is not None:
        from gyrostat.plots import save

        save(plot_stability(scene, report), plot)
        say(f"wrote {plot}", sys.stderr if as_json else sys.stdout)
    return 0
