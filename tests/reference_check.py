#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""High-precision reference cases through the command line: a scene file goes in, the answer is held against the truth.

    reference_check.py [FAMILY ...] [--command COMMAND] [--case TEXT] [--quick] [-j JOBS]

Each case of tests/data/reference/FAMILY.json is solved by
  full      at tolerance 1e-11: within 1e-9 of the true motion (rotor, heavy: or a multiple of what the case says of double precision),
            stop time within 1e-7;
  averaged  (deceleration) within 1e-9 of the exact first-order averaged motion, stop time within 1e-8;
  closed-form (free) to what one rounding of the data does;
  linear    (spinning) transverse pairs within 1e-12 of the exact linear motion;
  auto      at tolerances 1e-3, 1e-6, 1e-9 (--quick: 1e-3): the true error is within the tolerance where the answer
            says `met`, and in no column more than the error that the answer itself states.
Errors are relative to the greatest value of the column over the span; of modulus_squared, absolute; of attitude, the angle.
What the truth itself is good to is allowed on top. Needs the package, or with --command only that. Exit status 1 if any check failed.
"""
import argparse
import concurrent.futures
import contextlib
import io
import json
import math
import pathlib
import shlex
import subprocess
import sys
import tempfile

CASES = pathlib.Path(__file__).resolve().parent / "data" / "reference"
LAWS = {"M": "total", "G": "carrier"}
TRUTH_FLOOR = 1e-9
PAIR = " 1, 2"  # behind the name of a column: only its first two components


def scene_text(family, case, model, tolerance):
    """The case as a scene file."""
    return f"""\
name = {json.dumps(case_name(case))}
kind = "{family.kind}"
source = "reference case"
[solve]
times = {family.times(case)!r}
tolerance = {tolerance!r}
model = "{model}"
{family.tables(case)}"""


class Deceleration:
    kind = "deceleration"
    models = ("full", "averaged")

    @staticmethod
    def times(case):
        return case["t"]

    @staticmethod
    def tables(case):
        given, slow = case["inputs"], case["inputs"]["eps"]
        return f"""\
[body]
inertia = {given["J"]!r}
rotor_momentum = {given["l"]!r}
[torque]
control = {[slow * b for b in given["b"]]!r}
drag = {slow * given["lambda"]!r}
law = "{LAWS[given["control_law"]]}"
drag_law = "{LAWS[given["drag_law"]]}"
[initial]
angular_momentum = {given["M_vec0"]!r}
"""

    @staticmethod
    def known(case, model):
        """Columns and scalars that are known of a model: {name: (values, allowed error)}."""
        values = case["direct" if model == "full" else "averaged"]
        columns = {"angular_momentum_norm": values["M"], "energy": values["h"]}
        if model == "full":
            columns["angular_momentum"] = values["M_vec"]
        elif "k2" in values:
            columns["modulus_squared"] = values["k2"]
        stop = case.get("stop_time_tau", {}).get("direct" if model == "full" else "averaged")
        scalars = {"stop_time": (stop / case["inputs"]["eps"], 1e-7 if model == "full" else 1e-8)} if stop else {}
        return {name: (value, TRUTH_FLOOR) for name, value in columns.items()}, scalars


class Rotor:
    kind = "rotor"
    models = ("full",)

    @staticmethod
    def times(case):
        return [row["t"] for row in case["outputs"]]

    @staticmethod
    def tables(case):
        given, parts = case["inputs"], case["inputs"]["component"]
        w, x, y, z = unit(given["q0"])
        body = f"[body]\ninertia = {given['theta_star_kgm2']!r}\n[rotor]\n" if not parts else f"""\
[carrier]
inertia = {parts["Theta1_c1"]!r}
mass = {parts["m1"]!r}
[rotor]
mass = {parts["m2"]!r}
equatorial_inertia = {parts["mu"]!r}
offset = {parts["d"]!r}
"""
        return f"""{body}\
axis = {unit(given["e"])!r}
axial_inertia = {given["lambda_kgm2"]!r}
[motor]
slope = {given["S_Nms_per_rad"]!r}
no_load_rate = {given["omega_star_rad_s"]!r}
[initial]
angular_velocity = {given["Omega0_rad_s"]!r}
rotor_rate = {given["omega0_rad_s"]!r}
attitude = {[x, y, z, w]!r}
"""

    @staticmethod
    def known(case, model):
        columns = {
            "attitude": ([[*row["q"][1:], row["q"][0]] for row in case["outputs"]], "attitude_rad"),
            "angular_velocity": ([row["Omega"] for row in case["outputs"]], "Omega_rel"),
            "angular_momentum": ([row["H"] for row in case["outputs"]], "Omega_rel"),
            "rotor_rate": ([row["omega"] for row in case["outputs"]], "omega_rel"),
            "rotor_angle": ([row["beta"] for row in case["outputs"]], "omega_rel"),
            "lyapunov": ([row["V"] for row in case["outputs"]], "omega_rel"),
        }
        return {name: (values, max(TRUTH_FLOOR, 10 * case["tolerance"][limit])) for name, (values, limit) in columns.items()}, {}


class Spinning:
    kind = "spinning"
    models = ("full", "linear")

    @staticmethod
    def times(case):
        return [float(t) for t in case["times"]]

    @staticmethod
    def tables(case):
        given = {name: float(value) for name, value in case["inputs"].items()}

        def vector(*names):
            return [given[name] for name in names]

        return f"""\
[body]
inertia = {vector("D1", "D2", "D3")!r}
mass = {given["m"]!r}
rotor_momentum = {given["lambda3"]!r}
[field]
charge = {given["e"]!r}
flux_density = {given["H"]!r}
arm = {given["l"]!r}
angle = {given["sigma"]!r}
[torque]
body = {vector("M1", "M2", "M3")!r}
force = {vector("f1", "f2", "f3")!r}
[initial]
angular_velocity = {vector("p0", "q0", "r0")!r}
euler_312 = {vector("psi0", "phi0", "theta0")!r}
velocity = {vector("v10", "v20", "v30")!r}
position = {vector("x10", "x20", "x30")!r}
"""

    @staticmethod
    def known(case, model):
        def column(rows, *names):
            return [[float(row[name]) for name in names] for row in rows]

        if model == "linear":
            pairs = {"angular_velocity": "p q", "euler_312": "psi phi", "angular_momentum_inertial": "G1 G2", "velocity": "v1 v2",
                     "position": "x1 x2"}
            return {f"{name}{PAIR}": (column(case["linear_model"], *pair.split()), 1e-12) for name, pair in pairs.items()}, {}
        rows = case["nonlinear_truth"]
        columns = {
            "attitude": [quaternion([[float(x) for x in line] for line in row["R"]]) for row in rows],
            "angular_velocity": column(rows, "p", "q", "r"),
            "angular_momentum_inertial": column(rows, "G1", "G2", "G3"),
            "velocity": column(rows, "v1", "v2", "v3"),
            "position": column(rows, "x1", "x2", "x3"),
        }
        return {name: (values, TRUTH_FLOOR) for name, values in columns.items()}, {}


class Heavy:
    kind = "heavy"
    models = ("full",)

    @staticmethod
    def times(case):
        return [float(t) for t in case["truth"]["t"]]

    @staticmethod
    def tables(case):
        body = case["body"]
        first = [float(x) for x in case["truth"]["y0"]]
        start = f"angular_velocity = {first[:3]!r}\ndown = {first[3:]!r}"
        if Heavy.periodic(case):
            start = f"periodic = {{ spin = {case['initial']['r0']!r}, cos_inclination = {case['initial']['gamma3_0']!r} }}"
        return f"""\
[body]
inertia = {[body["A"], body["B"], body["C"]]!r}
mass = {body["M"]!r}
centre_of_mass = {[body["x0"], body["y0"], body["z0"]]!r}
[field]
gravity = {body["g"]!r}
gravity_gradient = {body["N"]!r}
[initial]
{start}
"""

    @staticmethod
    def periodic(case):
        return case["kind"] == "periodic_fast"

    @staticmethod
    def known(case, model):
        allowed = max(TRUTH_FLOOR, 1e3 * case["truth"]["double_vs_longdouble"])
        rows = [[float(x) for x in row] for row in case["truth"]["y"]]
        scalars = {}
        if Heavy.periodic(case):
            motion = case["periodic"]
            scalars = {"period": (float(motion["T"]), 1e-10), "floquet_trace": (motion["floquet"]["trace_minus_4"], 1e-6)}
        return {"angular_velocity": ([row[:3] for row in rows], allowed), "down": ([row[3:] for row in rows], allowed)}, scalars


class Free:
    kind = "free"
    models = ("closed-form", "full")

    @staticmethod
    def times(case):
        return [float(t) for t in case["t"]]

    @staticmethod
    def tables(case):
        given = case["inputs"]
        wheels = [f"""\
[[wheel]]
axis = {wheel["axis"]!r}
axial_inertia = {wheel["axial_inertia"]!r}
rate = {wheel["rate"]!r}
type = "{wheel["mode"]}"
""" for wheel in given.get("rotors", [])]
        return f"""\
[body]
inertia = {given["inertia"]!r}
rotor_momentum = {given.get("rotor_momentum", [0.0, 0.0, 0.0])!r}
[initial]
angular_velocity = {given["angular_velocity"]!r}
attitude = {given["attitude"]!r}
{"".join(wheels)}"""

    @staticmethod
    def known(case, model):
        """Within what one rounding of the data does; of the full equations not where thousands of turns are asked."""
        ulp = case["one_ulp"]
        floor = max(1e-12, 64 * max(ulp["angular_velocity"], ulp["attitude"]))
        if model == "full" and ulp.get("estimated"):
            return {}, {}
        if model == "full":
            floor = max(1e-9, floor)
        columns = {name: ([[float(x) for x in row] for row in rows], floor) for name, rows in case["truth"].items()}
        scalars = {}
        if model == "closed-form" and "period" in case:
            scalars["period"] = (float(case["period"]), 1e-12 if ulp.get("estimated") else floor)
        return columns, scalars


FAMILIES = {family.kind: family for family in (Deceleration, Rotor, Spinning, Heavy, Free)}


def solvable(family, case):
    """Whether the case is a motion (heavy: some are tables of multipliers)."""
    return family != "heavy" or "truth" in case


def case_name(case):
    return case.get("id") or case["name"]


def unit(v):
    size = math.hypot(*v)
    return [x / size for x in v]


def quaternion(R):
    """[x, y, z, w] of a rotation tensor, by its greatest component."""
    (a, b, c), (d, e, f), (g, h, i) = R
    square = [1 + a - e - i, 1 - a + e - i, 1 - a - e + i, 1 + a + e + i]
    rows = [[square[0], b + d, c + g, h - f], [b + d, square[1], f + h, c - g], [c + g, f + h, square[2], d - b],
            [h - f, c - g, d - b, square[3]]]
    return unit(max(zip(square, rows))[1])


def turn_between(p, q):
    """Angle of the rotation between two attitudes given as unit quaternions, rad."""
    sign = math.copysign(1.0, sum(a * b for a, b in zip(p, q)))
    return 4 * math.asin(min(1.0, math.dist(p, [sign * b for b in q]) / 2))


def distance(a, b):
    return math.dist(a, b) if isinstance(a, list) else abs(a - b)


def column_error(name, got, want):
    """The greatest error of a column as an answer states it; infinite where the answer has no such column."""
    if got is None or len(got) != len(want):
        return math.inf
    if name == "attitude":
        return max(turn_between(unit(g), unit(w)) for g, w in zip(got, want))
    worst = max(distance(g, w) for g, w in zip(got, want))
    size = max(math.hypot(*w) if isinstance(w, list) else abs(w) for w in want)
    if not math.isfinite(worst):
        return math.inf
    return worst if name == "modulus_squared" or size == 0 else worst / size


class Check:
    """The checks of one case; `lines` has one (right, text) each."""

    def __init__(self, family, command):
        self.family = family
        self.command = shlex.split(command)
        self.lines = []

    def say(self, right, text):
        self.lines.append((right, text))

    def solve(self, case, model, tolerance):
        """The answer; None, after a FAIL line, where there is none."""
        with tempfile.TemporaryDirectory() as scratch:
            scene = pathlib.Path(scratch) / "scene.toml"
            scene.write_text(scene_text(self.family, case, model, tolerance), encoding="utf-8")
            status, out, wrong = self.run(["solve", str(scene), "--json"])
        if status in (0, 3):
            return json.loads(out)
        self.say(False, f"{case_name(case)} {model}: exit {status}: {(wrong or out).strip()[-300:]}")
        return None

    def run(self, arguments):
        """Exit status and what was printed, by the command or, where none is named, by its main function in this process."""
        if self.command:
            run = subprocess.run([*self.command, *arguments], capture_output=True, text=True, timeout=300)
            return run.returncode, run.stdout, run.stderr
        from gyrostat.cli import main

        out, wrong = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(wrong):
            status = main(arguments)
        return status, out.getvalue(), wrong.getvalue()

    def named(self, case, model):
        answer = self.solve(case, model, 1e-11)
        if answer is None:
            return
        columns, scalars = self.family.known(case, model)
        for name, (want, allowed) in columns.items():
            got = answer["columns"].get(name.removesuffix(PAIR))
            error = column_error(name, [row[:2] for row in got] if got and name.endswith(PAIR) else got, want)
            self.say(error <= allowed, f"{case_name(case)} {model} {name}: error {error:.1e}, allowed {allowed:.0e}")
        for name, (want, allowed) in scalars.items():
            got = answer["scalars"].get(name)
            error = math.inf if got is None else abs(got / want - 1)
            self.say(error <= allowed, f"{case_name(case)} {model} {name}: error {error:.1e}, allowed {allowed:.0e}")

    def ladder(self, case, tolerance):
        answer = self.solve(case, "auto", tolerance)
        if answer is None:
            return
        right, seen = True, []
        known = self.family.known(case, "full")[0] or self.family.known(case, self.family.models[0])[0]
        for name, (want, floor) in known.items():
            if name in answer["columns"]:
                error, stated = column_error(name, answer["columns"][name], want), answer["error"][name]
                met = not answer["met"] or error <= tolerance + floor
                honest = error <= stated + floor
                right = right and met and honest
                seen.append(f"{name} {error:.1e} of {stated:.1e}" + ("" if met else " OVER") + ("" if honest else " DISHONEST"))
        self.say(right and bool(seen), f"{case_name(case)} auto {tolerance:.0e}: {answer['model']}"
                 f"{'' if answer['met'] else ' (not met)'}, true of stated: {', '.join(seen)}")


def checked(work):
    """The lines of one case."""
    command, tolerances, family, case = work
    check = Check(FAMILIES[family], command)
    for model in check.family.models:
        check.named(case, model)
    for tolerance in tolerances:
        check.ladder(case, tolerance)
    return check.lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("families", nargs="*", metavar="FAMILY", choices=[*FAMILIES, []], help=f"of {', '.join(FAMILIES)}; left out: all")
    parser.add_argument("--command", default="", help="the command to test; left out: its main function, without starting a process for each answer")
    parser.add_argument("--case", default="", help="only cases whose name holds this text")
    parser.add_argument("--quick", action="store_true", help="auto at the loosest tolerance alone")
    parser.add_argument("-j", "--jobs", type=int, default=1, help="cases at a time")
    args = parser.parse_args()

    tolerances = [1e-3] if args.quick else [1e-3, 1e-6, 1e-9]
    cases = [(args.command, tolerances, family, case) for family in args.families or FAMILIES
             for case in json.loads((CASES / f"{family}.json").read_text(encoding="utf-8"))["cases"]
             if args.case in case_name(case) and solvable(family, case)]
    passed = failed = 0
    with concurrent.futures.ProcessPoolExecutor(args.jobs) as pool:
        for lines in pool.map(checked, cases):
            for right, text in lines:
                passed, failed = passed + right, failed + (not right)
                print(f"{'ok  ' if right else 'FAIL'} {text}", flush=True)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
