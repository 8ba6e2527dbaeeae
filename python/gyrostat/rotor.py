# SPDX-License-Identifier: BSD-3-Clause
"""A gyrostat whose rotor is driven by a motor of limited power, over arrays.

A carrier turns with Omega and holds a rotor, symmetric about an axis e fixed in it, that turns with the rate omega relative
to it. No torque acts from outside; the motor's moment on the rotor is -S (omega - omega*):
    H = theta Omega + lambda omega e,   dH/dt = H x Omega,   lambda d/dt(omega + e.Omega) = -S (omega - omega*).
All in body axes and SI units. Equations: docs/rotor.md.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gyrostat import _core
from gyrostat._core import Monitor
from gyrostat.broadcast import Floats
from gyrostat.scenes import Scene

__all__ = ["Monitor", "arguments", "assembled_inertia", "integrate", "solve"]


def arguments(scene: Scene) -> dict[str, Any]:
    """What `solve` takes, from a checked scene."""
    solving, body, carrier, rotor, motor, start = (
        scene.tables[name] for name in ("solve", "body", "carrier", "rotor", "motor", "initial"))
    axis = np.array(rotor["axis"], dtype=float)
    if body["inertia"] is not None:
        inertia = np.array(body["inertia"], dtype=float)
    else:
        inertia = assembled_inertia(
            carrier_inertia=carrier["inertia"], carrier_mass=carrier["mass"], rotor_mass=rotor["mass"], axis=axis,
            axial_inertia=rotor["axial_inertia"], equatorial_inertia=rotor["equatorial_inertia"], offset=rotor["offset"])
    return {
        "inertia": inertia, "axis": axis, "axial_inertia": rotor["axial_inertia"], "slope": motor["slope"],
        "no_load_rate": motor["no_load_rate"], "angular_velocity": np.array(start["angular_velocity"], dtype=float),
        "rotor_rate": start["rotor_rate"], "attitude": np.array(start["attitude"], dtype=float), "times": scene.times,
        "tolerance": solving["tolerance"], "model": solving["model"], "integrator": solving["integrator"],
    }


def assembled_inertia(*, carrier_inertia: ArrayLike, carrier_mass: float, rotor_mass: float, axis: ArrayLike, axial_inertia: float,
                      equatorial_inertia: float, offset: ArrayLike) -> Floats:
    """Inertia (3, 3) of the whole gyrostat about the common mass centre, body axes [kg m^2] (docs/rotor.md, equation 2.1).

    carrier_inertia : (3,) principal moments or (3, 3) tensor about the carrier's centroid [kg m^2]; carrier_mass, rotor_mass [kg];
    axis : (3,) unit vector of the rotor; axial_inertia, equatorial_inertia : of the rotor about its axis and across it, about its own
    centroid [kg m^2]; offset : (3,) from the carrier's centroid to the rotor's [m].
    Raises DomainError for what is not positive, and for axial_inertia > 2 equatorial_inertia, which no rotor has.
    """
    made: Floats = _core.rotor_assembly(
        carrier_inertia=np.asarray(carrier_inertia, dtype=float), carrier_mass=float(carrier_mass), rotor_mass=float(rotor_mass),
        axis=np.asarray(axis, dtype=float), axial_inertia=float(axial_inertia), equatorial_inertia=float(equatorial_inertia),
        offset=np.asarray(offset, dtype=float))
    return made


def solve(*, inertia: ArrayLike, axis: ArrayLike, axial_inertia: float, slope: float, no_load_rate: float,
          angular_velocity: ArrayLike, times: ArrayLike, rotor_rate: float = 0.0, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
          tolerance: float = 1e-6, model: str = "auto", integrator: str = "auto", monitor: Monitor | None = None) -> dict[str, Any]:
    """Answer of the ladder as plain data; `gyrostat.solve` wraps it for scenes.

    inertia : (3,) principal moments or (3, 3) tensor of the whole about its mass centre, rotor locked [kg m^2]; axis : (3,) e, unit
    within 1e-8; axial_inertia : lambda > 0, of the rotor [kg m^2]; slope : S >= 0 of the motor [N m s/rad]; no_load_rate : omega*
    [rad/s]; angular_velocity : (3,) Omega of the carrier at t = 0 [rad/s]; rotor_rate : omega at t = 0, relative to the carrier
    [rad/s]; attitude : (4,) [x, y, z, w] at t = 0, body to inertial; times : (n,) increasing, first >= 0 [s]; tolerance : greatest
    relative error wanted in any column.
    Returns model, met, error, warnings, columns, scalars, counts, seconds and tried, as the JSON of a scene answer.
    Raises DomainError for an argument outside its domain and for a rung that cannot compute the motion, ConvergenceError where
    a computation hits its cap, Cancelled where the monitor stopped it.
    """
    made: dict[str, Any] = _core.rotor_solve(
        inertia=np.asarray(inertia, dtype=float), axis=np.asarray(axis, dtype=float), axial_inertia=float(axial_inertia),
        slope=float(slope), no_load_rate=float(no_load_rate), angular_velocity=np.asarray(angular_velocity, dtype=float),
        rotor_rate=float(rotor_rate), attitude=np.asarray(attitude, dtype=float), times=np.asarray(times, dtype=float),
        tolerance=float(tolerance), model=model, integrator=integrator, monitor=monitor)
    return made


def integrate(*, inertia: ArrayLike, axis: ArrayLike, axial_inertia: float, slope: float, no_load_rate: float,
              angular_velocity: ArrayLike, times: ArrayLike, rotor_rate: float = 0.0, attitude: ArrayLike = (0.0, 0.0, 0.0, 1.0),
              method: str = "taylor", order: int = 20, tolerance: float = 1e-9, precision: str = "double") -> dict[str, Any]:
    """The full equations under one integrator at one setting, timed: no error estimate.

    Arguments as in `solve`. method : "taylor" (order 8, 12, 16, 20 or 26; 30 in precision "long double"), "radau" (in both precisions),
    "dop853", "cvode-adams", "cvode-bdf". tolerance : local, relative to the sizes of the state.
    Returns attitude (n, 4), angular_velocity (n, 3) [rad/s], angular_momentum (n, 3) [N m s], rotor_rate (n,) [rad/s],
    rotor_angle (n,) [rad], lyapunov (n,) [J], seconds, rhs, steps, status ("reached" where all went well).
    Raises DomainError for an argument outside its domain and for a method that the build lacks.
    """
    made: dict[str, Any] = _core.rotor_integrate(
        inertia=np.asarray(inertia, dtype=float), axis=np.asarray(axis, dtype=float), axial_inertia=float(axial_inertia),
        slope=float(slope), no_load_rate=float(no_load_rate), angular_velocity=np.asarray(angular_velocity, dtype=float),
        rotor_rate=float(rotor_rate), attitude=np.asarray(attitude, dtype=float), times=np.asarray(times, dtype=float),
        method=method, order=int(order), tolerance=float(tolerance), precision=precision)
    return made
