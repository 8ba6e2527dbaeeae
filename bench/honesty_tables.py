#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How honest and how sharp stated errors are: the honesty benches of all families, by rung and column, as tables for docs/errors.md.

    bench/honesty_tables.py [--bin build/release/bench] [--scenes N] [--only rotor,heavy] [--write] SEED SEED
    bench/honesty_tables.py --fit [--scenes N] SEED SEED SEED

With --fit the first seed says by how much the margin of each rung could be narrowed, and the others whether that would hold. The seeds of the
tables must be others than those that margins were fitted on. --write puts the tables into docs/errors.md.
"""

import argparse
import pathlib
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "errors.md"
BEGIN, END = "<!-- honesty -->\n", "<!-- honesty end -->\n"
PROGRAMS = {  # scenes, and the tolerance of the table by rung and column
    "honesty": (300, "1e-04"),
    "rotor_honesty": (1000, "1e-05"),
    "spinning_honesty": (1000, "1e-05"),
    "heavy_honesty": (600, "1e-05"),
    "general_honesty": (600, "1e-05"),
}
NAMED = {"general_honesty": ["segments"]}  # rungs that the ladder seldom takes in these scenes, asked by name
FEW = 20  # of so few errors the tables tell nothing
RATIO = re.compile(
    r"  stated/true (\S+) +(\S+) +n +(\d+)  below 1: +(\d+)  least +(\S+)  1 % +(\S+)  median +(\S+)  90 % +(\S+)")


class Tolerance:
    """What one run of a bench saw at one tolerance."""

    def __init__(self, head):
        self.tolerance, self.answered = re.match(r"tolerance (\S+): (\d+) answered", head).groups()
        self.rungs, self.columns, self.lines = {}, {}, []

    def take(self, line):
        if found := RATIO.match(line):
            rung, column, n, below, *rest = found.groups()
            self.columns[rung, column] = (int(n), int(below), *map(float, rest))
        elif found := re.match(r" +(\d+) ([a-z][\w:-]*)$", line):
            self.rungs[found[2]] = int(found[1])
        else:
            self.lines.append(line)

    def number(self, pattern):
        """The groups of the one line that has it."""
        return next(m.groups() for line in self.lines if (m := re.search(pattern, line)))


def seen(program, scenes, seed):
    """What the bench sees at each tolerance; of rungs that are asked by name the columns alone."""
    found = seen_of(program, scenes, seed)
    for rung in NAMED.get(pathlib.Path(program).name, []):
        for tolerance, named in zip(found, seen_of(program, scenes, seed, rung), strict=True):
            tolerance.columns.update(named.columns)
    return found


def seen_of(program, scenes, seed, *rung):
    done = subprocess.run([program, str(scenes), str(seed), *rung], capture_output=True, text=True, check=True)
    found = []
    for line in done.stdout.splitlines():
        if line.startswith("tolerance "):
            found.append(Tolerance(line))
        elif found:
            found[-1].take(line)
    return found


def row(name, cells):
    return "| " + " | ".join([name, *cells]) + " |\n"


def brief(number):
    """Three digits; of a power of ten that alone."""
    power = f"{float(number):.0e}"
    text = power if power.startswith("1e-") and float(power) == float(number) else f"{float(number):.3g}"
    return text.replace("e+0", "e+").replace("e-0", "e-")


def tables(name, runs, detailed):
    """The tables of one bench: `runs` are of one seed each."""
    both = list(zip(*runs))  # by tolerance
    text = row("", [brief(each[0].tolerance) for each in both]) + "|---" * (len(both) + 1) + "|\n"
    text += row("answers", [str(sum(int(run.answered) for run in each)) for each in both])
    rungs = sorted({rung for each in both for run in each for rung in run.rungs if ":" not in rung})
    if name != "general_honesty":
        counts = [" / ".join(str(sum(run.rungs.get(rung, 0) for run in each)) for rung in rungs) for each in both]
        text += row("by " + " / ".join(rungs), counts)

    def each_seed(pattern, form):
        return [", ".join(form(*run.number(pattern)) for run in each) for each in both]

    text += row("true error <= stated, every column and scalar",
                each_seed(r"true <= stated in (\S+) %", lambda share: f"{float(share):.2f} %"))
    text += row("met although over the tolerance", each_seed(r"over the tolerance (\d+)", str))
    text += row("a cheaper rung would have done",
                each_seed(r"of the ladder \((\S+) %\)", lambda share: f"{share} %"))
    text += row("stated/true of all: least, median, 90 %",
                ["; ".join(", ".join(map(brief, run.number(r"of all: least (\S+), median (\S+), 90 % (\S+)")))
                           for run in each) for each in both])
    text += row("longest answer, s", [brief(max(float(run.number(r"slowest (\S+) s")[0]) for run in each))
                                      for each in both])
    text += f"\nBy rung and column, at {brief(detailed)}, both seeds: n, how many below 1, least, and of the first seed 1 %, median, 90 %\n\n"
    text += row("rung", ["column", "n", "below 1", "least", "1 %", "median", "90 %"]) + "|---" * 8 + "|\n"
    chosen = next(each for each in both if float(each[0].tolerance) == float(detailed))
    keys = sorted({key for run in chosen for key in run.columns})
    for rung, column in keys:
        if ":" in rung:
            continue
        parts = [run.columns[rung, column] for run in chosen if (rung, column) in run.columns]
        n, below = sum(p[0] for p in parts), sum(p[1] for p in parts)
        if n < FEW:
            continue
        text += row(rung, [column, str(n), str(below), brief(min(p[2] for p in parts)), *map(brief, parts[0][3:])])
    return text


def narrowed(name, runs):
    """By how much the margins of the rungs could be narrowed by the first of `runs`, and what the others say to that."""
    text = f"{name}: rung, stated/true at least: of the seed that fits, of the others\n"
    rungs = sorted({rung for run in runs for each in run for rung, _ in each.columns})
    for rung in rungs:
        least = [min((c[2] for each in run for (r, _), c in each.columns.items() if r == rung), default=float("nan"))
                 for run in runs]
        text += f"  {rung:28s} {least[0]:9.3g} | " + " ".join(f"{x:9.3g}" for x in least[1:]) + "\n"
    return text


def by_program(text):
    """The tables of each bench."""
    parts = re.split(r"(?m)^(?=`\w+`, seeds )", text)
    return {part.split("`")[1]: part for part in parts if part.startswith("`")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seeds", nargs="+", type=int)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bench")
    parser.add_argument("--scenes", type=int, help="of each family, in place of some hundred")
    parser.add_argument("--only", help="benches, by comma; with --write the tables of the others stay")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--fit", action="store_true")
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    names = given.only.split(",") if given.only else list(PROGRAMS)
    with ThreadPoolExecutor(given.jobs) as pool:
        work = {name: [pool.submit(seen, given.bin / name, given.scenes or PROGRAMS[name][0], seed)
                       for seed in given.seeds] for name in names}
        text = ""
        for name, runs in work.items():
            runs = [run.result() for run in runs]
            print(f"{name}: done", file=sys.stderr)
            if given.fit:
                text += narrowed(name, runs)
            else:
                seeds = " and ".join(map(str, given.seeds))
                scenes = given.scenes or PROGRAMS[name][0]
                text += f"`{name}`, seeds {seeds}, {scenes} scenes each\n\n{tables(name, runs, PROGRAMS[name][1])}\n"
    if given.write:
        page = PAGE.read_text()
        head, rest = page.split(BEGIN)
        old, rest = rest.split(END)
        made = {**by_program(old), **by_program(text)}
        PAGE.write_text(head + BEGIN + "".join(made[name] for name in PROGRAMS if name in made) + END + rest)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
