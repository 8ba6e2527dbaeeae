#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that came from outside, held against a truth that is not the library's: no error may be greater than the one stated, and what
`met` says must hold.

    outside_scenes.py [FILE ...] [--tolerance T] [--model RUNG]

FILE: scene files; none: all of tests/data/outside. For each it solves the scene, computes the truth, and prints for every column and scalar
the stated error, the true one, their ratio, and whether the answer says that its tolerance is met. A `!` marks what is wrong. Exit
status 1 if anything is. Columns without a truth are left out. Needs the installed package.
"""
import argparse
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import outside_deceleration  # noqa: E402

import gyrostat  # noqa: E402
from gyrostat.errors import ConvergenceError, DomainError  # noqa: E402
from gyrostat.facts import FACTS  # noqa: E402
from gyrostat.scenes import load  # noqa: E402

SCENES = pathlib.Path(__file__).resolve().parent / "data" / "outside"
# kind of the scene -> truth(plain data of the scene, times, names of the answer's scalars) -> (columns, scalars)
TRUTHS = {"deceleration": outside_deceleration.truth}
# The last bit of the answer's own numbers.
GRAIN = 2.0 ** -52


def angle(p, q):
    """Between attitudes [x, y, z, w], rad."""
    apart = np.minimum(np.sqrt(((p - q) ** 2).sum(-1)), np.sqrt(((p + q) ** 2).sum(-1)))
    return 4 * np.arcsin(np.minimum(apart / 2, 1))


def size_of(values):
    return np.sqrt((values ** 2).sum(-1)) if values.ndim == 2 else np.abs(values)


def column_error(measure, values, true, scale):
    """As the table of columns measures it."""
    values = np.asarray(values, dtype=np.longdouble)
    if not np.isfinite(values).all():
        return math.inf
    if measure == "angle":
        values = values / np.sqrt((values ** 2).sum(-1, keepdims=True))
        return float(angle(values, true).max())
    most = float(size_of(values - true).max())
    if measure == "absolute":
        return most
    size = max(float(size_of(true).max()), scale)
    return most / size if size > 0 else most


def honest(stated, true, met, tolerance):
    """Neither the stated error nor `met` lies."""
    return true <= max(stated, GRAIN) and (not met or true <= max(tolerance, GRAIN))


def verdicts(scene):
    """(answer, rows): a row is (name, stated, true, right)."""
    answer = gyrostat.solve(scene)
    columns, scalars = TRUTHS[scene.kind](scene.to_dict(), scene.times, answer.scalars)
    facts, rows = FACTS[scene.kind], []

    def judge(name, stated, true):
        rows.append((name, stated, true, honest(stated, true, answer.met, answer.tolerance)))

    for name, true in columns.items():
        if name in answer.columns and facts.columns[name].measure:
            judge(name, answer.error[name], column_error(facts.columns[name].measure, answer[name], true, answer.scale.get(name, 0.0)))
    for name, true in scalars.items():
        value = answer.scalars.get(name)
        if value is not None and math.isfinite(value):
            judge(name, answer.scalar_error[name], float(abs(np.longdouble(value) - true) / abs(true)) if true else abs(value))
    return answer, rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument("--tolerance", type=float)
    parser.add_argument("--model")
    given = parser.parse_args()
    overrides = {key: value for key, value in (("tolerance", given.tolerance), ("model", given.model)) if value is not None}
    wrong = 0
    for file in given.files or sorted(SCENES.glob("*.toml")):
        scene = load(file).replace(**overrides)
        try:
            answer, rows = verdicts(scene)
        except (DomainError, ConvergenceError) as error:
            print(f"  {scene.name}: refused: {error}")
            continue
        print(f"  {scene.name}: {answer.model}, tolerance {answer.tolerance:g} {'met' if answer.met else 'not met'}, {answer.seconds:.2g} s")
        for name, stated, true, right in rows:
            wrong += not right
            print(f"{' ' if right else '!'}   {name:24} stated {stated:9.2e}  true {true:9.2e}  true/stated {true / stated if stated else math.inf if true else 0:9.2e}")
    print(f"{wrong} wrong")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
