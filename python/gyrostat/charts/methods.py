# SPDX-License-Identifier: BSD-3-Clause
"""The methods of a chart: rungs, integrators and rivals, each run once at a setting and timed by the CPU time of its thread."""

import contextlib
import itertools
import math
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, Final

import numpy as np

from gyrostat._core import Monitor, build_info
from gyrostat.charts.problem import Line, Problem, Run, Unanswered, Vectors
from gyrostat.errors import Cancelled, ConvergenceError, DomainError

__all__ = ["LONGEST", "TOLERANCES", "TooLong", "lines", "timed"]

TOLERANCES: Final = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
# No solution may take longer [s of CPU time].
LONGEST: Final = 3.0
# Evaluations of the right-hand side in a step of SciPy's DOP853, and how far the time predicted from them may be over the limit, as it is rough.
STAGES: Final = 12
ROUGHLY: Final = 10.0
# Steps that heyoka may take: at least a microsecond each.
MOST_STEPS: Final = int(LONGEST / 1e-6)


class TooLong(Unanswered):
    """A solution takes longer than it may."""

    def __init__(self) -> None:
        super().__init__(f"takes over {LONGEST:g} s")


def lines(problem: Problem, rungs: tuple[str, ...]) -> list[Line]:
    """Every method on the problem; of CVODE, SciPy and heyoka what is installed."""
    return [*(_rung(problem, name) for name in rungs), *problem.lines(), *_integrators(problem), *_scipy(problem), *_heyoka(problem)]


def timed(work: Callable[[], Any]) -> tuple[Any, float]:
    """What Python work makes, and the CPU time of this thread that it takes [s]."""
    began = time.thread_time()
    made = work()
    return made, time.thread_time() - began


@contextlib.contextmanager
def _patience(monitor: Monitor) -> Iterator[None]:
    """Cancels what runs in this thread when it has taken too long."""
    clock = time.pthread_getcpuclockid(threading.get_ident())
    end = time.clock_gettime(clock) + LONGEST
    done = threading.Event()

    def watch() -> None:
        while not done.wait(0.05):
            if time.clock_gettime(clock) > end:
                monitor.cancel()

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()


# ---- rungs ----


def _rung(problem: Problem, model: str) -> Line:
    """A rung at the scene's tolerance; the full equations at all tolerances. What states an error of the whole is no answer."""

    def run(tolerance: float) -> Run:
        monitor = Monitor()
        try:
            with _patience(monitor):
                made = problem.solve(**{**problem.given, "model": model, "tolerance": tolerance}, monitor=monitor)
        except Cancelled:
            raise TooLong from None
        except (DomainError, ConvergenceError) as error:
            raise Unanswered(str(error).removeprefix(f"model {model}: ")) from None
        stated = max((e for e in made.error.values() if math.isfinite(e)), default=math.nan)
        if not stated < 1:
            raise Unanswered("states an error of the size of the answer")
        return Run(made.seconds, made.columns, made.counts["rhs"], f"stated error {stated:.2g}", made.error)

    if model.rpartition(":")[2] == "full":
        return Line("rung", f"rung {model}", tuple((f"tolerance {tolerance:g}", partial(run, tolerance)) for tolerance in TOLERANCES))
    return Line("rung", f"rung {model}", (("", partial(run, problem.given["tolerance"])),))


# ---- the full equations under one integrator ----


def _integrators(problem: Problem) -> Iterator[Line]:

    def run(method: str, tolerance: float) -> Run:
        made = problem.integrate(**problem.physics, method=method, tolerance=tolerance, patience=LONGEST)
        if made["status"] != "reached":
            raise TooLong if made["status"] == "cancelled" else Unanswered(f"ended with {made['status']}")
        return Run(float(made["seconds"]), made, made["rhs"])

    cvode = (("cvode", "CVODE Adams", "cvode-adams"), ("cvode", "CVODE BDF", "cvode-bdf")) if build_info()["cvode"] else ()
    settings = [("taylor", "Taylor, order 20", "taylor"), *problem.methods, ("dop853", "Runge-Kutta DOP853", "dop853"), *cvode]
    for group, label, method in settings:
        yield Line(group, label, tuple((f"tolerance {tolerance:g}", partial(run, method, tolerance)) for tolerance in TOLERANCES))


# ---- rivals ----


def _scipy(problem: Problem) -> Iterator[Line]:
    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        return
    right, start = problem.rival.right(), problem.rival.start
    times = np.asarray(problem.physics["times"], dtype=float) - problem.begin

    def predicted() -> float:
        return STAGES * problem.steps * min(timed(lambda: right(0.0, start))[1] for _ in range(5))

    def run(tolerance: float) -> Run:
        if predicted() > ROUGHLY * LONGEST:
            raise TooLong
        end = time.thread_time() + LONGEST
        state, rows, evaluations = start, [], 0
        seconds = 0.0
        bounds = [0.0, *(cut for cut in problem.cuts if cut < times[-1]), float(times[-1])]
        for begin, stop in itertools.pairwise(bounds):
            inside = np.nextafter(stop, begin)  # what holds from `stop` on belongs to the next

            def bounded(t: float, state: Vectors, inside: float = inside) -> Vectors:
                if time.thread_time() > end:
                    raise TooLong
                return right(min(t, inside), state)

            at = times[(times >= begin) & ((times < stop) | (stop == times[-1]))]
            grid = at if at.size and at[-1] == stop else np.append(at, stop)
            made, taken = timed(lambda bounded=bounded, begin=begin, stop=stop, state=state, grid=grid: solve_ivp(  # type: ignore[misc]
                bounded, (begin, stop), state, method="DOP853", t_eval=grid, rtol=tolerance, atol=tolerance))
            if not made.success:
                raise Unanswered(made.message)
            rows.append(made.y.T[:len(at)])
            state, seconds, evaluations = made.y[:, -1], seconds + taken, evaluations + int(made.nfev)
        return Run(seconds, problem.rival.columns(np.concatenate(rows)), evaluations)

    yield Line("rival", "SciPy DOP853 (Python right-hand side)",
               tuple((f"tolerance {tolerance:g}", partial(run, tolerance)) for tolerance in TOLERANCES))


def _heyoka(problem: Problem) -> Iterator[Line]:
    try:
        import heyoka
    except ImportError:
        return
    times = np.asarray(problem.physics["times"], dtype=float) - problem.begin
    grid = times if times[0] == 0 else np.concatenate([[0.0], times])
    made: dict[float, Any] = {}  # the integrator of a tolerance: compiling it is no part of a solution

    def run(tolerance: float) -> Run:
        start = list(problem.rival.start)
        if tolerance not in made:
            made[tolerance] = heyoka.taylor_adaptive(problem.rival.system(heyoka), start, tol=tolerance)
        integrator = made[tolerance]
        integrator.time = 0.0
        integrator.state[:] = start
        out, seconds = timed(lambda: integrator.propagate_grid(grid, max_steps=MOST_STEPS))
        outcome, steps, states = out[0], out[3], out[5]
        if outcome != heyoka.taylor_outcome.time_limit or len(states) != len(grid):
            raise TooLong if outcome == heyoka.taylor_outcome.step_limit else Unanswered(f"ended with {outcome}")
        return Run(seconds, problem.rival.columns(states[len(grid) - len(times):]), int(steps))

    yield Line("rival", "heyoka (compile time left out)",
               tuple((f"tolerance {tolerance:g}", partial(run, tolerance)) for tolerance in TOLERANCES))
