#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the ladder costs over its rungs, and what rungs cost over what is foreseen, on the random scenes of rewritten.py.

    climb.py [--count 100] [--seed 1] [--general] [FAMILY ...]

Each scene is solved by every rung by name and by the ladder, at a random tolerance, several times, of which the least counts; --general: rewritten as a general scene. Prints, a rung, the
CPU time [us] and that over the prediction (10 %, median, 90 %), and, a family, all that the ladder spent over the cheapest rung that gives the same and meets
the tolerance, and who answered.
"""
from __future__ import annotations

import argparse
import collections
from typing import Any, NamedTuple

import gyrostat
import numpy as np
from gyrostat.facts import FACTS
from gyrostat.general import as_general
from gyrostat.scenes import scene_from
from rewritten import FAMILIES

REPEATS = 8


class Cost(NamedTuple):
    predicted: float  # of the rung that answers, s
    spent: float
    everything: float  # spent by all that was tried
    model: str
    met: bool
    gives: frozenset[str]


def least(scene: Any, **how: Any) -> Cost | None:
    """Of the run that took least; None where there is no answer."""
    best: Cost | None = None
    for _ in range(REPEATS):
        try:
            answer = gyrostat.solve(scene, **how)
        except (ValueError, RuntimeError):
            return None
        last = next(each for each in answer.tried if each.model == answer.model and each.accepted)
        if last.predicted is None or last.spent is None:
            return None
        if best is None or last.spent < best.spent:
            best = Cost(last.predicted, last.spent, sum(each.spent or 0.0 for each in answer.tried), answer.model, answer.met,
                        frozenset(name for name, values in answer.columns.items() if values.dtype.kind == "U" or np.all(np.isfinite(values))))
    return best


def spread(values: list[float]) -> str:
    if not values:
        return "-"
    low, middle, high = np.percentile(values, [10, 50, 90])
    return f"{low:.3g} / {middle:.3g} / {high:.3g}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("families", nargs="*", default=list(FAMILIES), metavar="FAMILY")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--general", action="store_true")
    given = parser.parse_args()
    for kind in given.families:
        random = np.random.default_rng([given.seed, list(FAMILIES).index(kind)])
        rungs = list(FACTS[kind].rungs)
        spent: dict[str, list[tuple[float, float]]] = collections.defaultdict(list)
        over: list[float] = []
        who: collections.Counter[str] = collections.Counter()
        for _ in range(given.count):
            tables = FAMILIES[kind](random)
            tolerance = float(10.0 ** random.choice([-2, -4, -6, -9]))
            try:
                scene = scene_from({"name": kind, "kind": kind, **tables})
                scene = as_general(scene) if given.general else scene
            except ValueError:
                continue
            names = [f"{kind}:{rung}" for rung in rungs] + ["full"] if given.general else rungs
            found = {name: least(scene, model=name, tolerance=tolerance) for name in names}
            for name, each in found.items():
                if each:
                    spent[name].append((each.spent, each.predicted))
            climbed = least(scene, tolerance=tolerance)
            if not climbed or not climbed.met:
                continue
            meets = [each.spent for each in found.values() if each and each.met and each.gives >= climbed.gives]
            if meets:
                over.append(climbed.everything / min(meets))
                who[climbed.model] += 1
        for name, pairs in spent.items():
            print(f"{kind} {name}: {len(pairs)} answers, us {spread([1e6 * s for s, _ in pairs])}, over predicted {spread([s / p for s, p in pairs])}")
        print(f"{kind}: the ladder over the cheapest rung that meets {spread(over)}, answered by {dict(who.most_common())}", flush=True)


if __name__ == "__main__":
    main()
