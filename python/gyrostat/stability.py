# SPDX-License-Identifier: BSD-3-Clause
"""Where a scene goes for large time: table, report and figure, for each kind."""

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gyrostat.console import say, show_table
from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES
from gyrostat.scenes import Scene, scene_from

__all__ = ["plot_stability", "report_stability", "stability_report"]


def _part(kind: str) -> Any:
    """What makes the `report` of a scene of the kind, and its `tables`, `sentence` and `plot`."""
    part = FAMILIES[kind].part("stability")
    if part is None:
        known = [name for name, family in FAMILIES.items() if family.part("stability")]
        raise DomainError(f"kind = {kind!r}: a stability table is known for the kinds {', '.join(known)}")
    return part


def _judged(scene: Scene | Mapping[str, Any]) -> Scene:
    """The scene; of a general one that is exactly an instance of a family, that of the family."""
    checked = scene if isinstance(scene, Scene) else scene_from(scene)
    if checked.kind != "general":
        return checked
    from gyrostat.families.general.instance import as_instance
    from gyrostat.families.general.rewrite import recognised

    known = [name for name, family in FAMILIES.items() if family.part("stability")]
    made = as_instance(checked, known)
    if made is None:
        reasons: dict[str, list[str]] = {}
        for name, reason in recognised(checked).items():
            if name in known and reason:
                reasons.setdefault(reason, []).append(name)
        why = "; ".join(f"{', '.join(names)}: {reason}" for reason, names in reasons.items())
        told = [name for name, reason in recognised(checked).items() if name in known and not reason]
        if told:
            why = f"within its times it is one of the kind {told[0]}, but not in the words of that kind: write it so, with all that it does at all times"
        raise DomainError(f"{checked.name}: a stability table is known for scenes of the kinds {', '.join(known)}, and for general ones that are exactly "
                          f"an instance of these; of this one not ({why})")
    return made


def stability_report(scene: Scene | Mapping[str, Any]) -> dict[str, Any]:
    """The stability of a scene as plain data; see `report` of families/KIND/stability.py. A general scene that is exactly an instance of a family
    is judged as one of that family, whose name is `kind`.

    Raises DomainError where the question has no meaning for the scene.
    """
    checked = _judged(scene)
    made: dict[str, Any] = {"kind": checked.kind, **_part(checked.kind).report(checked)}
    return made


def plot_stability(scene: Scene | Mapping[str, Any], report: Mapping[str, Any] | None = None) -> Any:
    """The figure of a scene, from its report where there is one already. Needs matplotlib."""
    checked = _judged(scene)
    return _part(checked.kind).plot(checked, report or stability_report(checked))


def report_stability(scene: Scene, *, as_json: bool = False, plot: Path | None = None) -> int:
    """Print the stability of a scene and write its figure; the exit status."""
    report = stability_report(scene)
    if as_json:
        say(json.dumps(report, allow_nan=False), sys.stdout)
    else:
        family = _part(report["kind"])
        for title, heads, rows in family.tables(report):
            show_table(title, heads, rows, sys.stdout)
        say(family.sentence(report), sys.stdout)
    if plot is not None:
        from gyrostat.plots import save

        save(plot_stability(scene, report), plot)
        say(f"wrote {plot}", sys.stderr if as_json else sys.stdout)
    return 0
