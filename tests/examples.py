#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs an example and holds one number that it prints against what is known of it from elsewhere.

    examples.py NAME COMMAND...     exit status 1, and what was printed, where the example fails or prints another number
    examples.py --same A B          exit status 1 where the programs A and B do not print the same

The examples of one name in C++ and in Python print the same number. Needs Python 3.9 and nothing else.
"""
import math
import re
import subprocess
import sys

START = math.hypot(40, 25, 16.5)  # |M| of the despins, N m s

# Name -> the words before the number, the number, how far off it may be.
EXPECTED = {
    "01_solve_a_scene": ("t = 3600 s: wheel at", 60, 1e-3),  # the no-load rate of the motor, to which every motion tends
    "02_despin_in_a_loop": ("down to one per cent after", 5022.62, 0.05),  # the full equations: gyrostat solve, model full, tolerance 1e-6
    "03_spinner_on_a_grid": ("mean direction off by", math.hypot(9, 4) / (3 * 820 * 3), 2e-6),  # |M|/|r0 X|, docs/spinning.md, section 3.1
    "04_steady_rotations": ("wheel axis in the end", 0, 0.05),  # deg: the wheel takes up nearly all of the momentum
    "05_top": ("turns in a period at spin 400 rad/s:", 1, (8.409 / 400) ** 2),  # a fast spin: 1 but for (pendulum rate/spin)^2
    "06_free_gyrostat": ("the momentum has moved by", 0, 1e-12),  # nothing acts
    "07_your_question": ("greatest error", 0.5, 0.5),  # within what was asked
    "08_ensemble": ("stop time, 50 %:", math.log1p(2e-4 * START / 0.008) / 2e-4, 1e-3),  # equal torques: exact, and falls with the drag
    "09_chart": ("true error at most", 0.5, 0.5),  # of the stated one
}


def run(command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=60)


def differ(programs):
    """What the programs print, where it differs or one fails; None: they print the same."""
    ran = [run([program]) for program in programs]
    same = all(each.returncode == 0 and each.stdout == ran[0].stdout for each in ran)
    return None if same else "\n".join(f"{program}: exit status {each.returncode}\n{each.stdout}" for program, each in zip(programs, ran))


def wrong(name, command):
    """What is wrong with the example; None: nothing."""
    ran = run(command)
    return f"exit status {ran.returncode}\n{ran.stdout}" if ran.returncode != 0 else misprinted(name, ran.stdout)


def misprinted(name, printed):
    """What is wrong with what it printed; None: nothing."""
    words, value, tolerance = EXPECTED[name]
    found = re.search(re.escape(words) + r"\s+([-+]?[\d.]+(?:e[-+]?\d+)?)", printed)
    if not found:
        return f'"{words}" and a number are not there\n{printed}'
    if not abs(float(found[1]) - value) <= tolerance:
        return f"{words} {found[1]}: expected {value:.9g} within {tolerance:.2g}\n{printed}"
    return None


def main():
    name, *command = sys.argv[1:]
    problem = differ(command) if name == "--same" else wrong(name, command)
    print(f"{name}: {problem or 'as expected'}")
    return 1 if problem else 0


if __name__ == "__main__":
    sys.exit(main())
