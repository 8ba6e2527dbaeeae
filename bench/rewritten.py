#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes of the families, rewritten as general ones: the full equations of the family against those of general scenes.

    rewritten.py [--count 2000] [--seed 1] [--cost] [FAMILY ...]

Both are solved by `full`, the general scene without looking for a family in it, and every column that both have is compared at all times: the two answers may differ by the sum
of their stated errors. What the general scene is recognised as must be the family. Prints, a family, how many answers were compared, the greatest and the median difference
over what is allowed, those over it, refusals by reason, and how often the family was not found again. With --cost: what the full equations of general scenes cost, rates and
attitude (or down) asked for, over the family's, each the least of five; the same of the family's full equations reached through the general scene.
"""
from __future__ import annotations

import argparse
import collections
import sys
from typing import Any

import gyrostat
import numpy as np
from gyrostat.general import as_general, recognised
from gyrostat.rotation import angle_between
from gyrostat.scenes import scene_from
from numpy.random import Generator

Tables = dict[str, Any]


def moments(random: Generator) -> np.ndarray:
    """Principal moments of a body: of any shape, slim, flat, nearly or exactly symmetric."""
    extent = random.choice([1e-3, 1, 1e3]) * random.uniform(0.05, 1, 3) ** random.choice([1, 2, 4])
    if random.random() < 0.2:
        extent[1] = extent[0] * (1 if random.random() < 0.5 else 1 + 10 ** random.uniform(-9, -3))
    return np.asarray(random.permutation([extent[1] + extent[2], extent[2] + extent[0], extent[0] + extent[1]]))


def rotation(random: Generator) -> np.ndarray:
    q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    return np.asarray(q * np.linalg.det(q))


def turned(random: Generator, inertia: np.ndarray) -> list[Any]:
    """The moments, or as often a tensor about other axes."""
    if random.random() < 0.5:
        return list(inertia.tolist())
    R = rotation(random)
    J = R @ np.diag(inertia) @ R.T
    return list(((J + J.T) / 2).tolist())


def unit(random: Generator) -> np.ndarray:
    v = random.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))


def rates(random: Generator, size: float = 1.0) -> list[float]:
    return list((size * random.uniform(0.1, 2) * unit(random)).tolist())


def attitude(random: Generator) -> list[float]:
    q = random.normal(size=4)
    return list((q / np.linalg.norm(q)).tolist())


def times(random: Generator, span: float) -> list[float]:
    return list(np.sort(span * random.uniform(0.02, 1, random.integers(1, 6))).tolist())


def deceleration(random: Generator) -> Tables:
    J = moments(random)
    start = rates(random)
    size = float(np.min(J))
    brake = (10 ** random.uniform(-4, -1.5)) * size * random.uniform(0.2, 1, 3) * (random.random() < 0.8)
    body: Tables = {"inertia": turned(random, J)}
    if random.random() < 0.3:
        body["rotor_momentum"] = (random.uniform(0, 2) * size * unit(random)).tolist()
    law = str(random.choice(["total", "carrier"]))
    torque = {"control": brake.tolist(), "drag": 10 ** random.uniform(-4, -1.5), "law": law, "drag_law": law}
    least = float(np.linalg.norm(start)) * size / max(float(np.max(brake)), 1e-9 * size)
    return {"body": body, "torque": torque, "initial": {"angular_velocity": start, "attitude": attitude(random)},
            "solve": {"times": times(random, min(100.0, 0.2 * least))}}


def rotor(random: Generator) -> Tables:
    J = moments(random)
    axial = float(np.min(J)) * random.uniform(0.01, 0.3)
    axis = unit(random) if random.random() < 0.7 else np.eye(3)[random.integers(3)]
    inertia = np.diag(J) + axial * np.outer(axis, axis)
    return {"body": {"inertia": inertia.tolist()}, "rotor": {"axis": axis.tolist(), "axial_inertia": axial},
            "motor": {"slope": axial * 10 ** random.uniform(-3, 1), "no_load_rate": random.uniform(-30, 30)},
            "initial": {"angular_velocity": rates(random), "rotor_rate": random.uniform(-20, 20), "attitude": attitude(random)},
            "solve": {"times": times(random, 60.0)}}


def spinning(random: Generator) -> Tables:
    J = moments(random)
    spin = random.uniform(0.5, 5)
    body: Tables = {"inertia": J.tolist(), "mass": random.uniform(1, 100)}
    if random.random() < 0.3:
        body["rotor_momentum"] = random.uniform(-1, 1) * float(np.max(J)) * spin
    torque = 10 ** random.uniform(-5, -2) * float(np.max(J)) * spin**2 * random.normal(size=3)
    made: Tables = {"body": body, "torque": {"body": torque.tolist(), "force": (random.uniform(0, 10) * random.normal(size=3)).tolist()},
                    "initial": {"angular_velocity": [*(0.1 * spin * random.normal(size=2)).tolist(), spin], "attitude": attitude(random)},
                    "solve": {"times": times(random, 60.0 / spin)}}
    if random.random() < 0.2:
        made["field"] = {"momentum": 0.1 * float(np.min(J)) * spin * random.normal()}
    return made


def heavy(random: Generator) -> Tables:
    J = moments(random)
    mass = random.uniform(0.5, 2) * float(np.max(J))
    arm = np.sqrt(float(np.min(J)) / mass) * random.uniform(0, 0.3) * unit(random)
    # moments about the mass centre, moved to the fixed point
    about = np.diag(J) + mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    start: Tables = {"angular_velocity": rates(random, 3.0)}
    start.update({"attitude": attitude(random)} if random.random() < 0.7 else {"down": unit(random).tolist()})
    field: Tables = {"gravity": random.uniform(0, 10)}
    if random.random() < 0.3:
        field["gravity_gradient"] = random.uniform(0, 1)
    return {"body": {"inertia": about.tolist(), "mass": mass, "centre_of_mass": arm.tolist()}, "field": field, "initial": start,
            "solve": {"times": times(random, 20.0)}}


def free(random: Generator) -> Tables:
    J = moments(random)
    wheels = []
    inertia = np.array(np.diag(J))
    for _ in range(random.integers(0, 4)):
        axis, axial = unit(random), float(np.min(J)) * random.uniform(0.01, 0.2)
        inertia += axial * np.outer(axis, axis)
        wheels.append({"axis": axis.tolist(), "axial_inertia": axial, "rate": random.uniform(-50, 50), "type": str(random.choice(["held", "free"]))})
    given: Tables = {"inertia": inertia.tolist() if wheels else turned(random, J)}
    if random.random() < 0.3:
        given["rotor_momentum"] = (random.uniform(0, 2) * float(np.max(J)) * unit(random)).tolist()
    return {"body": given, "wheel": wheels, "initial": {"angular_velocity": rates(random), "attitude": attitude(random)},
            "solve": {"times": times(random, 100.0)}}


FAMILIES = {each.__name__: each for each in (deceleration, rotor, spinning, heavy, free)}
SHARED = ("attitude", "angular_velocity", "angular_momentum", "rotor_rate", "rotor_angle", "velocity", "position", "down")


def share(name: str, answers: tuple[gyrostat.Answer, gyrostat.Answer]) -> float:
    """The difference of a column over the sum of what the two answers state of it."""
    one, other = (np.reshape(answer[name], (len(answer.t), -1)) for answer in answers)
    if name == "attitude":
        apart, units = float(np.max(angle_between(one, other))), [1.0, 1.0]
    else:
        apart = float(np.max(np.linalg.norm(one - other, axis=1)))
        units = [max(answer.scale.get(name, 0.0), float(np.max(np.linalg.norm(one, axis=1)))) for answer in answers]
    allowed = 1.01 * sum(answer.error[name] * unit for answer, unit in zip(answers, units)) + 4e-16 * max(units)
    return apart / allowed if allowed > 0 else (0.0 if apart == 0 else np.inf)


def spent(scene: gyrostat.Scene, ask: list[str], model: str) -> float:
    """The least of five solutions, s in the compiled part."""
    answers = [gyrostat.solve(scene, model=model, ask=ask) for _ in range(5)]
    return min(each.spent for answer in answers for each in answer.tried if each.accepted)


def costs(own: gyrostat.Scene, general: gyrostat.Scene, kind: str) -> tuple[float, float]:
    """Of the full equations of the general scene, and of the family's by way of it, over those of the family."""
    oriented = kind != "heavy" or "down" not in own.tables["initial"]
    ask = ["angular_velocity", "attitude" if oriented else "down"]
    family = spent(own, ask, "full")
    return spent(general.replace(recognise=False), ask, "full") / family, spent(general, ask, f"{kind}:full") / family


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("families", nargs="*", default=list(FAMILIES), metavar="FAMILY")
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cost", action="store_true")
    given = parser.parse_args()
    bad = 0
    for kind in given.families:
        random = np.random.default_rng([given.seed, list(FAMILIES).index(kind)])
        shares: list[float] = []
        refused: collections.Counter[str] = collections.Counter()
        over, lost = [], 0
        ratios: list[tuple[float, float]] = []
        for i in range(given.count):
            tables = FAMILIES[kind](random)
            tables["solve"]["tolerance"] = float(10.0 ** random.choice([-4, -6, -8, -10]))
            try:
                own = scene_from({"name": f"{kind}-{i}", "kind": kind, **tables})
                general = as_general(own)
                answers = gyrostat.solve(own, model="full", ask="all"), gyrostat.solve(general.replace(recognise=False), model="full", ask="all")
            except (ValueError, RuntimeError) as why:
                refused[str(why)[:80]] += 1
                continue
            lost += bool(recognised(general)[kind])
            if given.cost and not recognised(general)[kind]:
                ratios.append(costs(own, general, kind))
            both = [name for name in SHARED if all(name in answer and np.all(np.isfinite(answer[name])) for answer in answers)]
            worst = max(share(name, answers) for name in both)
            shares.append(worst)
            if not worst <= 1:
                over.append((i, worst))
        bad += len(over)
        print(f"{kind}: {len(shares)} compared, difference over the sum of the stated errors: greatest {max(shares, default=0):.2f}, median {np.median(shares or [0]):.2f}; over it {len(over)}"
              f"{' ' + str(over[:8]) if over else ''}; not found again {lost}; refused {sum(refused.values())} {dict(refused.most_common(4))}", flush=True)
        for name, most, of in zip(("the general full equations", "the family's, by way of the general scene"), (4, 1.5), np.array(ratios).T):
            print(f"  {name} cost {np.median(of):.2f} times the family's own in the median, {np.percentile(of, 90):.2f} in nine tenths, {of.max():.1f} at most; over {most} in {(of > most).mean():.1%}", flush=True)
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
