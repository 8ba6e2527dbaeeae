#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps over plans that are meant to hurt, of every family: moments that no body has, rates and torques of zero and over many powers of ten,
motions beside a separatrix. What must hold: each row has an answer or a reason, and all ways of running come to the same bits.

    million_rows.py [-n ROWS] [--threads T] [--families A,B] [--ways] [--pace]

--ways: the same rows also in chunks of an odd size, in shards that are merged, by an executor of processes, and killed and resumed.
--pace: rows a second of tame plans on 1, 2, 4, ... threads. Writes one line a result."""
import argparse
import hashlib
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import gyrostat
from gyrostat import sweeps

PLANS = {
    "deceleration": ("tiangong-1", {
        "body.inertia[0]": "lognormal(16403, 0.8)", "body.inertia[1]": "lognormal(70915, 0.4)", "body.inertia[2]": "choice(76392.38, 70915.56, 8e4)",
        "torque.control[0]": "choice(0.06, 0, 1e-9, 6, 0.05, 0.04, 0.07, 0.09)", "torque.control[1]": "lognormal(0.05, 1)", "torque.control[2]": "lognormal(0.04, 1)",
        "torque.drag": "lognormal(1e-6, 3)", "initial.angular_velocity[0]": "choice(0, 0.012, 1e-12, -0.1)",
        "initial.angular_velocity[1]": "normal(0, 0.02)", "initial.angular_velocity[2]": "choice(0, 0.032, 1e-9, 0.1)",
    }, {"ask": ["angular_momentum_norm", "modulus_squared"], "times": [1.0, 2000.0], "tolerance": 1e-3}),
    "rotor": ("intelsat-v-flat-spin", {
        "body.inertia[0]": "lognormal(3026, 0.4)", "body.inertia[1]": "choice(440, 3164, 1)", "rotor.axis[0]": "choice(0, 0.01, 1)",
        "rotor.axis[2]": "normal(0, 0.01)", "motor.slope": "lognormal(3e-5, 4)", "motor.no_load_rate": "choice(0, 574.8, -574.8, 1e5)",
        "initial.angular_velocity[0]": "choice(0, 1e-4, 1e-12)", "initial.angular_velocity[1]": "normal(0, 1e-3)",
        "initial.angular_velocity[2]": "choice(0, 0.0289, 3)", "initial.rotor_rate": "choice(0, 574.8, -1e3)",
    }, {"ask": ["angular_velocity", "rotor_rate"], "times": [10.0, 600.0], "tolerance": 1e-6}),
    "spinning": ("spinning-paper", {
        "body.inertia[0]": "lognormal(8.7, 0.3)", "body.inertia[1]": "choice(8.7, 8.6, 0)", "body.inertia[2]": "lognormal(11.1, 0.3)",
        "body.rotor_momentum": "choice(0, 1.3, -3.1, 1e3)", "torque.body[0]": "lognormal(1e-3, 4)", "torque.body[2]": "choice(0, 1e-6, 0.1)",
        "initial.angular_velocity[0]": "choice(0, 1e-9, 0.01)", "initial.angular_velocity[2]": "choice(0, 0.28, 30, 1e-6)", "field.charge": "choice(0, 0.003, 1e-12)",
    }, {"ask": ["attitude", "velocity"], "times": [1.0, 50.0], "tolerance": 1e-5}),
    "heavy": ("toy-top", {
        "body.inertia[0]": "choice(1.1e-5, 1.1125e-5, 0.6e-5)", "body.inertia[1]": "lognormal(1.1125e-5, 0.3)", "body.inertia[2]": "lognormal(0.6e-5, 0.5)",
        "body.centre_of_mass[2]": "choice(0, 0.02, -0.02, 2)", "body.centre_of_mass[0]": "choice(0, 0, 1e-9, 0.01)", "field.gravity": "choice(0, 9.80665, 1e-6)",
        "initial.angular_velocity[0]": "choice(0, 1e-9, 3)", "initial.angular_velocity[2]": "choice(0, 209.4, 1e4)", "initial.attitude[1]": "choice(0, 1, 0.13)",
    }, {"ask": ["down", "angular_velocity"], "times": [0.1, 2.0], "tolerance": 1e-6}),
    "free": ("dual-spinner", {
        "body.inertia[0]": "lognormal(30, 0.5)", "body.inertia[1]": "choice(30, 40, 1e-3)", "body.inertia[2]": "lognormal(40, 0.5)",
        "initial.angular_velocity[0]": "choice(0, 1e-12, 0.1)", "initial.angular_velocity[1]": "choice(0, 0.3, 1e-9)", "initial.angular_velocity[2]": "normal(0, 0.5)",
    }, {"ask": ["attitude"], "times": [10.0, 1000.0], "tolerance": 1e-8}),
    "general": ("cubesat-three-wheels", {
        "body.inertia[0,0]": "lognormal(0.041, 0.5)", "body.inertia[0,1]": "choice(0, -0.0012, 0.03)", "wheel[0].axial_inertia": "choice(2.4e-5, 1e-12, 1)",
        "wheel[1].rate": "choice(0, 1e3, -1e5)", "wheel[2].torque.values[1]": "lognormal(8e-5, 2)", "wheel[0].torque.values[0]": "choice(0, 3e-4, -3e-2)",
        "initial.angular_velocity[0]": "choice(0, 0.14, 10)", "initial.angular_velocity[1]": "normal(0, 0.1)", "initial.angular_velocity[2]": "choice(0, 1e-12, 0.05)",
    }, {"ask": ["attitude", "rotor_rate"], "times": [21.0, 90.0], "tolerance": 1e-6}),
}

TAME = {
    "despins": ("stage-despin-study", {}, {"ask": ["stop_time"], "tolerance": 3e-2}),
    "driven rotors": ("intelsat-v-flat-spin", {"motor.slope": "lognormal(3.2e-5, 30%)", "initial.angular_velocity[2]": "normal(0.0289, 3%)"},
                      {"ask": ["angular_velocity"], "times": [600.0], "tolerance": 1e-6}),
    "free gyrostats": ("dual-spinner", {"initial.angular_velocity[0]": "normal(0.1, 0.03)", "initial.angular_velocity[2]": "normal(0.3, 0.05)"},
                       {"ask": ["attitude"], "times": [1000.0], "tolerance": 1e-6}),
    "spinners": ("spinning-paper", {"torque.body[0]": "uniform(1e-6, 1e-5)", "body.inertia[2]": "uniform(11, 12)"},
                 {"ask": ["velocity"], "times": [50.0], "tolerance": 1e-3}),
    "tops": ("toy-top", {"initial.angular_velocity[2]": "uniform(190, 230)", "field.gravity": "uniform(9.7, 9.9)"},
             {"ask": ["down"], "times": [2.0], "tolerance": 1e-6}),
}


def swept(name, rows, plans=PLANS, **how):
    scene, vary, settings = plans[name]
    return gyrostat.sweep(scene, vary, n=rows, seed=7, **settings, **how)


def bits(dataset):
    """One hash of all numbers and words."""
    made = hashlib.sha256()
    for name in sorted(dataset.variables):
        values = np.asarray(dataset[name].values)
        made.update(name.encode())
        made.update("\0".join(values.ravel().tolist()).encode() if values.dtype.kind in "UO" else np.ascontiguousarray(values).tobytes())
    return made.hexdigest()[:16]


def unexplained(dataset):
    """How many rows have neither an answer nor a reason, or both."""
    answered = np.asarray(dataset["model"].values) != ""
    return int((answered == (np.asarray(dataset["reason"].values) != "")).sum())


def killed_and_resumed(name, rows, threads):
    """Another process is killed when some parts are there; the rows of those are taken as they are."""
    with tempfile.TemporaryDirectory() as folder:
        parts = Path(folder) / "parts"
        code = f"import million_rows as m; m.swept({name!r}, {rows}, threads={threads}, chunk={max(1, rows // 23)}, parts={str(parts)!r})"
        work = subprocess.Popen([sys.executable, "-c", code], cwd=Path(__file__).parent, start_new_session=True)
        while work.poll() is None and len(list(parts.glob("*"))) < 5:
            time.sleep(0.01)
        if work.poll() is None:
            os.killpg(work.pid, signal.SIGKILL)
        work.wait()
        kept = len(list(parts.glob("*")))
        return swept(name, rows, threads=threads, chunk=max(1, rows // 23), parts=parts), kept


def ways(name, rows, threads):
    """Yields how the rows were run, the Dataset and a word."""
    yield "chunks of an odd size", swept(name, rows, threads=threads, chunk=9973), ""
    with ProcessPoolExecutor(threads) as pool:
        shards = [pool.submit(swept, name, rows, threads=1, shard=(i + 1, threads)) for i in range(threads)]
        yield f"{threads} shards, merged", sweeps.merge([each.result() for each in shards]), ""
        yield "an executor of processes", swept(name, rows, engine=pool), ""
    dataset, kept = killed_and_resumed(name, rows, threads)
    yield "killed and resumed", dataset, f"{kept} parts kept"


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("-n", type=int, default=1_000_000)
    reader.add_argument("--threads", type=int, default=os.cpu_count())
    reader.add_argument("--families", default=",".join(PLANS))
    reader.add_argument("--ways", action="store_true")
    reader.add_argument("--pace", action="store_true")
    asked = reader.parse_args()
    if asked.pace:
        for name in TAME:
            alone = 0.0
            for threads in [t for t in (1, 2, 4, 8, 16, 32) if t <= asked.threads]:
                seconds = []
                for _ in range(3):
                    begin = time.perf_counter()
                    swept(name, asked.n, TAME, threads=threads)
                    seconds.append(time.perf_counter() - begin)
                pace = asked.n / min(seconds)
                alone = alone or pace
                print(f"{name}: {threads} threads, {pace:.4g} rows a second, {pace / alone:.2f} times one", flush=True)
        return 0
    failed = 0
    for name in asked.families.split(","):
        begin, before = time.perf_counter(), time.process_time()
        whole = swept(name, asked.n, threads=asked.threads)
        wall, cpu = time.perf_counter() - begin, time.process_time() - before
        bare = unexplained(whole)
        failed += bare > 0
        of = bits(whole)
        print(f"{name}: {asked.n} rows, {asked.threads} threads, {wall:.1f} s, {asked.n / cpu:.0f} rows a CPU second, "
              f"{100 * float((whole['model'] != '').mean()):.1f} % answered, {bare} without answer and reason, bits {of}, "
              f"peak {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024} MiB", flush=True)
        for way, dataset, word in ways(name, asked.n, asked.threads) if asked.ways else ():
            same = bits(dataset) == of
            failed += not same
            print(f"{name}: {way}{', ' + word if word else ''}: {'the same bits' if same else 'OTHER BITS'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
