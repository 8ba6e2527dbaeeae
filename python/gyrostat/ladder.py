# SPDX-License-Identifier: BSD-3-Clause
"""From a scene to its answer and to its chart."""

import math
import os
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gyrostat._core import Monitor
from gyrostat.answer import Answer
from gyrostat.broadcast import array
from gyrostat.errors import DomainError
from gyrostat.families import FAMILIES
from gyrostat.fields import UNSET
from gyrostat.orientation import off_orthonormal
from gyrostat.rounding import data_error as error_of_data
from gyrostat.scenes import Scene, load, scene_from

if TYPE_CHECKING:
    from gyrostat.charts import Chart

__all__ = ["Monitor", "chart", "solve"]

SceneLike = Scene | Mapping[str, Any] | str | os.PathLike[str]


def scene_of(scene: SceneLike, overrides: Mapping[str, Any]) -> Scene:
    """The checked scene behind a scene, a dict, a file or the name of a bundled scene. Raises SceneError, and DomainError for what is none of these."""
    if isinstance(scene, Scene):
        return scene.replace(**overrides)
    if isinstance(scene, Mapping):
        return scene_from(scene, **overrides)
    if isinstance(scene, str | os.PathLike):
        return load(scene, **overrides)
    raise DomainError(f"scene = {str(scene)[:60]}: give a Scene, a dict in the layout of a scene file, a file, or the name of a bundled scene")


def solve(scene: SceneLike, *, monitor: Monitor | None = None, torque: Any = None, breakpoints: Any = (), data_error: bool = False, **overrides: Any) -> Answer:
    """Answer a scene by the cheapest rung whose error estimate meets the tolerance.

    scene : a `Scene`, a dict in the layout of a scene file, a file, or the name of a bundled scene.
    monitor : reports the progress of long work and can cancel it from another thread.
    torque : a torque of your own on a scene of the kind general, and breakpoints : the times at which it jumps or has kinks [s], as `gyrostat.general.solve`
        takes them; the answer's `scene` does not hold them. Of other kinds, and where it is data, the key of that name in the scene file.
    data_error : tell what one rounding of each number of the scene changes, too; the scene is solved twice more for each number that it has.
    overrides : keys of the scene file to change, such as tolerance=1e-9, model="full", or ask=["stop_time"], ask={"attitude": "0.1 deg"}:
        the columns and scalars that are wanted (docs/scenes.md, "What is asked"). Numbers may be text with a unit: no_load_rate="3000 rpm".

    Raises SceneError for a scene that cannot be used, DomainError where the rung asked for by name cannot compute it,
    ConvergenceError where a computation hits its cap. Over the tolerance it still answers, with `met` False.
    """
    if isinstance(torque, Mapping | list | tuple):
        overrides, torque = {**overrides, "torque": torque}, None
    checked = scene_of(scene, overrides)
    family = FAMILIES[checked.kind]
    own = {} if torque is None and array("breakpoints", breakpoints).size == 0 else {"torque": torque, "breakpoints": breakpoints}
    if own and family.name != "general":
        raise DomainError(f"torque: a torque of your own is for scenes of the kind general, and this one is of the kind {family.name}")
    if own and data_error:
        raise DomainError("data_error: with a torque of your own the numbers of the scene are not all of the data")
    answer = family.solve(**family.arguments(checked), **own, monitor=monitor)
    if data_error:
        answer = replace(answer, data_error=error_of_data(checked, answer, monitor=monitor))
    return _with_remedy(answer.of_scene(checked.told, off_orthonormal(checked.tables.get("initial", {}))), checked)


def _with_remedy(answer: Answer, scene: Scene) -> Answer:
    """Where the error of the start is too great, and is that of the scene before: by which tolerance of that it would not be."""
    before, excess = scene.before, answer.greatest_error / answer.tolerance
    if before is None or scene.tables["initial"]["error"] is not UNSET or not 1 < excess < math.inf or all(each.code != "start-uncertain" for each in answer.warnings):
        return answer
    from gyrostat.families.general.before import end_of

    end = end_of(before)
    off = max(end.error["attitude"], end.error["angular_velocity"] / max(float(np.linalg.norm(end.angular_velocity)), 1e-300))
    tolerance = min(float(before.tables["solve"]["tolerance"]), off) / (2 * excess)
    remedy = f"; solve.tolerance = {tolerance:.0e} in {before.path.name if before.path else before.name} should do, with as much in those before it"
    told = (replace(each, message=each.message + remedy) if each.code == "start-uncertain" else each for each in answer.warnings)
    return replace(answer, warnings=tuple(told))


def chart(scene: SceneLike, **overrides: Any) -> "Chart":
    """Error against cost of every rung and integrator on one scene; see `gyrostat.charts.Chart`."""
    from gyrostat.charts import make_chart

    return make_chart(scene_of(scene, overrides))
