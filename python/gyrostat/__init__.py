# SPDX-License-Identifier: BSD-3-Clause
"""Attitude motion of bodies that carry rotors, by the cheapest model that meets a tolerance.

`load` reads a scene file, `solve` answers it, `sweep` answers it with many numbers, `chart` shows what accuracy costs; `gyrostat.deceleration`,
`gyrostat.rotor`, `gyrostat.spinning`, `gyrostat.heavy`, `gyrostat.free`, `gyrostat.general`, `gyrostat.elliptic` and `gyrostat.rotation` hold the
functions behind them, over arrays.
"""

import importlib
from types import ModuleType
from typing import TYPE_CHECKING, Final

from gyrostat import cpu

if (_level := cpu.level()) is not None:  # gyrostat._core is found in the folder of the level
    __path__.append(str(cpu.HERE / _level))

from gyrostat._core import Monitor, __version__, build_info
from gyrostat.answer import Answer
from gyrostat.errors import Cancelled, ConvergenceError, DomainError, SceneError
from gyrostat.ladder import chart, solve
from gyrostat.scenes import Scene, load
from gyrostat.sweeps import sweep

__all__ = [
    "Answer",
    "Cancelled",
    "ConvergenceError",
    "DomainError",
    "Monitor",
    "Scene",
    "SceneError",
    "__version__",
    "build_info",
    "chart",
    "load",
    "solve",
    "sweep",
]

if TYPE_CHECKING:
    from gyrostat import deceleration as deceleration
    from gyrostat import elliptic as elliptic
    from gyrostat import free as free
    from gyrostat import general as general
    from gyrostat import heavy as heavy
    from gyrostat import rotation as rotation
    from gyrostat import rotor as rotor
    from gyrostat import spinning as spinning
else:
    _FUNCTIONS: Final = ("deceleration", "elliptic", "free", "general", "heavy", "rotation", "rotor", "spinning")

    def __getattr__(name: str) -> ModuleType:  # the modules of functions, where they are first named
        if name in _FUNCTIONS:
            return importlib.import_module(f"gyrostat.{name}")
        raise AttributeError(f"module 'gyrostat' has no attribute {name!r}")

    def __dir__() -> list[str]:
        return sorted({*__all__, *_FUNCTIONS})
