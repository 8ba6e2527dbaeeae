# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps whose chunks are done elsewhere, by Dask or by other processes, and functions over arrays that Dask calls."""

import multiprocessing
import os
import signal
import threading
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import gyrostat.deceleration
import numpy as np
import pytest
import xarray
from gyrostat import DomainError, sweep

STUDY: dict[str, Any] = {"torque.control[0]": "normal(0.06, 5%)", "body.inertia[2]": "uniform(60000, 90000)", "torque.drag": "lognormal(1.2e-6, 20%)"}
ASKED: dict[str, Any] = {"n": 96, "seed": 5, "design": "sobol", "tolerance": 1e-2, "times": [10000.0, 40000.0], "ask": ["stop_time", "angular_momentum_norm"]}


def despins(**more: Any) -> xarray.Dataset:
    """Some of these bodies are none: their rows have a reason."""
    return sweep("tiangong-1", STUDY, **{**ASKED, **more})


def alike(one: xarray.Dataset, other: xarray.Dataset) -> bool:
    """To the last bit."""
    return bool(one.attrs == other.attrs and list(one.variables) == list(other.variables) and all(
        one[name].dims == other[name].dims and one[name].dtype == other[name].dtype
        and (one[name].values.tobytes() == other[name].values.tobytes() if one[name].dtype.kind != "O" else one[name].values.tolist() == other[name].values.tolist())
        for name in one.variables))


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """Of a Dask cluster of two processes on this machine."""
    # each worker is a fork of a process that has imported what they need
    pytest.importorskip("dask").config.set({"distributed.worker.multiprocessing-method": "forkserver"})
    distributed = pytest.importorskip("distributed")
    distributed.utils.get_mp_context().set_forkserver_preload(["distributed", "xarray", "gyrostat"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
        with cluster, distributed.Client(cluster) as made:
            yield made


class Killer:
    """For `progress`: once a quarter of the rows are there, kills one of the workers, as a machine does that is out of memory."""

    def __init__(self, client: Any) -> None:
        self.client = client
        self.killed: list[int] = []
        self.heard: list[int] = []

    def __call__(self, done: int, rows: int) -> None:
        self.heard.append(done)
        if done >= rows // 4 and not self.killed:
            self.killed += list(self.client.run(os.getpid).values())[:1]
            os.kill(self.killed[0], signal.SIGKILL)


def test_a_worker_that_is_killed_loses_nothing_and_changes_no_bit(client: Any) -> None:
    killer = Killer(client)
    found = despins(engine=client, chunk=4, progress=killer)
    assert killer.killed and killer.heard[-1] == 96
    assert killer.killed[0] not in client.run(os.getpid).values()
    alone = despins(threads=1)
    assert alike(found, alone)
    assert 0 < int((alone["reason"] == "").sum()) < 96


def test_what_is_done_is_kept_where_the_rest_is_called_off(client: Any, tmp_path: Path) -> None:
    class Stopped(Exception):
        pass

    def stop(done: int, rows: int) -> None:
        if done >= 40:
            raise Stopped

    with pytest.raises(Stopped):
        despins(engine=client, chunk=8, progress=stop, parts=tmp_path)
    assert len(list(tmp_path.glob("rows-*.nc"))) >= 5
    assert alike(despins(engine=client, chunk=24, parts=tmp_path), despins())


def test_dask_calls_functions_over_arrays_on_its_workers(client: Any) -> None:
    pytest.importorskip("dask.array")
    row, count = "row", 40
    draw = np.random.default_rng(8)
    inertia = xarray.DataArray(np.array([35.0, 22.0, 16.0]) * draw.uniform(0.97, 1.03, (count, 3)), dims=(row, "axis"))
    drag = xarray.DataArray(draw.uniform(1e-5, 1e-4, count), dims=row)
    times = np.array([100.0, 400.0])

    def momentum_norm(J: Any, drag: Any) -> Any:
        return gyrostat.deceleration.averaged(
            inertia=J, drag=drag, control=[5e-4, 8e-4, 1e-3], angular_momentum=[40.0, 25.0, 16.5], t=times).momentum_norm

    def applied(J: xarray.DataArray, drag: xarray.DataArray) -> xarray.DataArray:
        made: xarray.DataArray = xarray.apply_ufunc(
            momentum_norm, J, drag, input_core_dims=[["axis"], []], output_core_dims=[["time"]], dask="parallelized", output_dtypes=[float],
            dask_gufunc_kwargs={"output_sizes": {"time": len(times)}})
        return made

    lazy = applied(inertia.chunk({row: 7}), drag.chunk({row: 7}))
    assert lazy.chunks is not None and len(lazy.chunks[0]) == 6
    assert lazy.compute().values.tobytes() == applied(inertia, drag).values.tobytes()


class OtherWay:
    """An engine of threads that ends its work in the order opposite to that in which it was given."""

    def __init__(self) -> None:
        self.waiting: list[tuple[Future[Any], Callable[[], Any]]] = []

    def submit(self, work: Callable[..., Any], /, *arguments: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.waiting.append((future, lambda: work(*arguments)))
        if len(self.waiting) == 4:
            threading.Thread(target=self.work).start()
        return future

    def work(self) -> None:
        while self.waiting:
            future, each = self.waiting.pop()
            future.set_result(each())


def test_the_order_in_which_chunks_end_changes_nothing(tmp_path: Path) -> None:
    assert alike(despins(engine=OtherWay(), chunk=24), despins())
    with ThreadPoolExecutor(2) as pool:
        assert alike(despins(engine=pool, chunk=5, threads=2, shard="2/3"), despins(shard="2/3"))
    with pytest.raises(DomainError, match="threads = 0"):
        despins(engine=OtherWay(), threads=0)


def test_every_kind_of_random_number_goes_to_other_processes() -> None:
    study = {**STUDY, "torque.control[1]": "choice(0.05, 0.06)", "torque.control[2]": "uniform(0.03, 0.05)", "initial.angular_velocity[0]": "normal(0.012, 1e-3)"}
    alone = sweep("tiangong-1", study, **ASKED)
    # forks of a process with threads may hang
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert alike(sweep("tiangong-1", study, **ASKED, engine=pool, chunk=40), alone)
