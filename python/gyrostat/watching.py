# SPDX-License-Identifier: BSD-3-Clause
"""Long work beside a thread that looks at its progress and can be interrupted."""

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from gyrostat._core import Monitor

T = TypeVar("T")


def watched(work: "Callable[[Monitor], T]", look: Callable[[float], None]) -> T:
    """What `work(monitor)` returns or raises. It runs in a thread of its own; meanwhile `look(progress)`, progress from 0 to 1, is called ten
    times a second. An exception here, Ctrl-C or one of `look`, cancels the work and is raised when that has ended, or after ten seconds."""
    from gyrostat._core import Monitor

    monitor = Monitor()
    ended = threading.Event()  # Thread.join, once interrupted, takes a running thread for a finished one
    result: list[T] = []
    failure: list[BaseException] = []

    def run() -> None:
        try:
            result.append(work(monitor))
        except BaseException as error:
            failure.append(error)
        finally:
            ended.set()

    threading.Thread(target=run, daemon=True).start()
    try:
        while not ended.wait(0.1):
            look(monitor.progress)
    except BaseException:
        monitor.cancel()
        ended.wait(10)
        raise
    if failure:
        raise failure[0]
    return result[0]
