"""
Compiled core of gyrostat.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
__all__: list[str] = ['HeavyBodies', 'Monitor', 'PolhodeStart', 'PublishedData', 'PublishedRun', 'SpinningProblems', 'build_info', 'csv_rows', 'deceleration_averaged', 'deceleration_integrate', 'deceleration_polhode_start', 'deceleration_regimes', 'deceleration_solve', 'deceleration_stability', 'deceleration_torque_balance', 'elliptic_complete', 'elliptic_incomplete', 'elliptic_jacobi', 'elliptic_zeta', 'euler_312_from_quaternion', 'families', 'free_flips', 'free_integrate', 'free_permanent', 'free_reduced', 'free_solve', 'general_integrate', 'general_numbers', 'general_recognise', 'general_segments', 'general_solve', 'general_table_value', 'heavy_exact', 'heavy_fast_stability', 'heavy_hanging', 'heavy_integrate', 'heavy_periodic_family', 'heavy_periodic_orbits', 'heavy_published_run', 'heavy_published_table', 'heavy_regular_precession', 'heavy_series', 'heavy_sleeping', 'heavy_solve', 'json_numbers', 'matrix_from_quaternion', 'matrix_from_vector', 'published_run', 'published_stationary_ratio', 'quaternion_from_euler_312', 'quaternion_from_matrix', 'quaternion_from_vector', 'rotor_assembly', 'rotor_capture', 'rotor_certify', 'rotor_circular_section', 'rotor_fall_time', 'rotor_integrate', 'rotor_published_data', 'rotor_published_matrix', 'rotor_published_run', 'rotor_solve', 'rotor_steady', 'spinning_design', 'spinning_integrate', 'spinning_linear', 'spinning_linear_grid', 'spinning_pointing', 'spinning_published', 'spinning_solve', 'sweep', 'vector_from_matrix', 'vector_from_quaternion']
class Monitor:
    """
    Watches and stops long work from another thread.
    """
    def __init__(self) -> None:
        ...
    def cancel(self) -> None:
        """
        Ask the work to stop: it raises Cancelled soon after.
        """
    @property
    def cancelled(self) -> bool:
        """
        Whether cancel() was called.
        """
    @property
    def progress(self) -> float:
        """
        Share of the work done, from 0 to 1.
        """
class PolhodeStart:
    """
    A scene without rotor momentum in principal axes 1, 2, 3, A > B > C.
    """
    @property
    def modulus_squared(self) -> float:
        """
        k2 at the start
        """
    @property
    def moments(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) [kg m2]
        """
    @property
    def regime(self) -> str:
        """
        A or C
        """
    @property
    def torques(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,) about the principal axes [N m]
        """
class PublishedData:
    """
    Data of a figure of the deceleration paper, principal axes, A > B > C.
    """
    def __init__(self, *, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], drag: typing.SupportsFloat | typing.SupportsIndex, sigma: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def momentum_unit(self) -> float:
        """
        |M| at the start [N m s].
        """
    @property
    def time_unit(self) -> float:
        """
        T of slow time [s].
        """
class PublishedRun:
    """
    A solution of (27), until k2 leaves [0, 1) or |M| vanishes.
    """
    @property
    def ended(self) -> bool:
        """
        whether the equations ended before the time asked for
        """
    @property
    def energy(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        H/b3
        """
    @property
    def modulus_squared(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        k2
        """
    @property
    def momentum(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        |M|/M0
        """
    @property
    def t(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        t/T
        """
class SpinningProblems:
    """
    Rows of spinning, thrusting bodies, checked.
    """
    def __init__(self, *, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], charge_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], torque: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], force: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], euler_312: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def __len__(self) -> int:
        ...
class HeavyBodies:
    """
    Rows of heavy bodies in principal axes, checked.
    """
    def __init__(self, *, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], centre_of_mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], gravity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], gravity_gradient: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def __len__(self) -> int:
        ...
def build_info() -> dict[str, str | None]:
    """
    Version of the library, of the compiler, and of each optional library (None: this installation has it not).
    """
def csv_rows(columns: list[numpy.ndarray]) -> str:
    """
    The rows of a table of columns (n,) or (n, width) of numbers, or (n,) of bytes, as CSV without a head.
    """
def deceleration_averaged(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], drag: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], law: str, drag_law: str, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, elliptic: str) -> dict[str, typing.Any]:
    """
    The rung averaged over rows of bodies.
    """
def deceleration_integrate(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], drag: typing.SupportsFloat | typing.SupportsIndex, law: str, drag_law: str, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], method: str, order: typing.SupportsInt | typing.SupportsIndex = 20, tolerance: typing.SupportsFloat | typing.SupportsIndex, precision: str = 'double', patience: typing.SupportsFloat | typing.SupportsIndex = ...) -> dict[str, typing.Any]:
    """
    The full equations under one integrator, timed.
    """
def deceleration_polhode_start(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> PolhodeStart:
    """
    Regime and k2 of a start; inertia (3,) or (3, 3), control (3,), angular_momentum (3,), body axes.
    """
def deceleration_regimes() -> list[str]:
    """
    Symbols of the regimes, in the order of their numbers.
    """
def deceleration_solve(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], drag: typing.SupportsFloat | typing.SupportsIndex, law: str, drag_law: str, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, elliptic: str, monitor: Monitor | None, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None = None) -> dict[str, typing.Any]:
    """
    Answer of the ladder as plain data.
    """
def deceleration_stability(control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], regime: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n, 6): region, tendency of the axis, of k*2 and of the separatrix, k*2, 1 - k*2.
    """
def deceleration_torque_balance(modulus_squared: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
    """
    phi(k2) = kp2 W/(k2 F): falls from 1/2 at k2 = 0 to 0 at k2 = 1.
    """
def elliptic_complete(k2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], kp2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], backend: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n, 2): K, E.
    """
def elliptic_incomplete(phi: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], n: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], k2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], kp2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], backend: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n, 3): F, E, Pi.
    """
def elliptic_jacobi(u: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], k2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], kp2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], backend: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n, 4): sn, cn, dn, am.
    """
def elliptic_zeta(u: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], k2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], kp2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], backend: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n, 1): Z.
    """
def euler_312_from_quaternion(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def families() -> list:
    """
    What each family gives: columns, scalars, rungs (cheapest first), integrators and warnings; and the numbers of a row of a sweep.
    """
def free_flips(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], wheels: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], begin: typing.SupportsFloat | typing.SupportsIndex, end: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n,) times at which M crosses the plane across a body axis [s].
    """
def free_integrate(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], wheels: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], method: str, order: typing.SupportsInt | typing.SupportsIndex = 20, tolerance: typing.SupportsFloat | typing.SupportsIndex, precision: str = 'double', patience: typing.SupportsFloat | typing.SupportsIndex = ...) -> dict[str, typing.Any]:
    """
    The full equations under one integrator, timed.
    """
def free_permanent(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], wheels: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Permanent rotations with the start's momentum, as columns.
    """
def free_reduced(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], wheels: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Body and wheels as one gyrostat: inertia, rotor momentum and angular momentum at the start.
    """
def free_solve(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], wheels: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, angular_momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], view: tuple[typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.Annotated[numpy.typing.ArrayLike, numpy.float64], typing.SupportsFloat | typing.SupportsIndex] | None, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, monitor: Monitor | None, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None = None) -> dict[str, typing.Any]:
    """
    Answer of the ladder as plain data.
    """
def general_integrate(*, scene: dict[str, typing.Any], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], method: str, order: typing.SupportsInt | typing.SupportsIndex = 20, tolerance: typing.SupportsFloat | typing.SupportsIndex, precision: str = 'double', patience: typing.SupportsFloat | typing.SupportsIndex = ...) -> dict[str, typing.Any]:
    """
    The full equations under one integrator, timed.
    """
def general_numbers(scene: dict[str, typing.Any]) -> tuple[numpy.typing.NDArray[numpy.float64], list[tuple[str, int]]]:
    """
    The numbers of a general scene (n,), and name and width of what they are, in their order.
    """
def general_recognise(*, scene: dict[str, typing.Any], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> list[tuple[str, str | None]]:
    """
    Each family, and why the scene is no instance of it; None where it is one.
    """
def general_segments(*, scene: dict[str, typing.Any], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> list[tuple[float, float, list[str]]]:
    """
    Begin, end and families of each segment that the motion can be answered in.
    """
def general_solve(*, scene: dict[str, typing.Any], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, recognise: bool, monitor: Monitor | None, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None = None, start_error: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {}, euler: typing.Annotated[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(3)"] | None = None, torque: typing.Any = None, breakpoints: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = []) -> dict[str, typing.Any]:
    """
    Answer of the ladder as plain data. torque: a callable, or the address of a compiled function.
    """
def general_table_value(table: dict[str, typing.Any], t: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    The value at t of a table of numbers: times (n,), values (n, 1), interpolation, extend.
    """
def heavy_exact(bodies: HeavyBodies, *, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], down: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    The exact motion of every row; numbers (rows, 7): period, errors of rates, down and attitude, least and greatest down along the axis of a top, and its mean precession.
    """
def heavy_fast_stability(bodies: HeavyBodies, *, spin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], cos_inclination: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Free nutations of fast spins; numbers (rows, 6): nu^2, its error, tongue, trace - 4, growth, exponent.
    """
def heavy_hanging(bodies: HeavyBodies) -> numpy.typing.NDArray[numpy.float64]:
    """
    (rows, 11): down at rest, two frequencies, two directions of the swing.
    """
def heavy_integrate(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], mass: typing.SupportsFloat | typing.SupportsIndex, centre_of_mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], gravity: typing.SupportsFloat | typing.SupportsIndex, gravity_gradient: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, down: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], method: str, order: typing.SupportsInt | typing.SupportsIndex = 20, tolerance: typing.SupportsFloat | typing.SupportsIndex, precision: str = 'double', patience: typing.SupportsFloat | typing.SupportsIndex = ...) -> dict[str, typing.Any]:
    """
    The full equations under one integrator, timed.
    """
def heavy_periodic_family(body: HeavyBodies, *, first_spin: typing.SupportsFloat | typing.SupportsIndex, cos_inclination: typing.SupportsFloat | typing.SupportsIndex, last_spin: typing.SupportsFloat | typing.SupportsIndex, most_members: typing.SupportsInt | typing.SupportsIndex) -> dict[str, typing.Any]:
    """
    The family over the spin, one row a member as in heavy_periodic_orbits.
    """
def heavy_periodic_orbits(bodies: HeavyBodies, *, spin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], cos_inclination: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Periodic motions; numbers (rows, 16): rates and down at the start, period and its error, closure, trace - 4 and its error, both multipliers (re, im), turns of the first.
    """
def heavy_published_run(body: HeavyBodies, *, spin: typing.SupportsFloat | typing.SupportsIndex, cos_inclination: typing.SupportsFloat | typing.SupportsIndex, reading: str, t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    The paper's formulas for one body, mu^-1 = spin/c (printed) or c/spin (reciprocal): rates and down (35), theta, psi, phi since the start (38), period (36).
    """
def heavy_published_table(number: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
    """
    (31, 5) of table 1 or 2 again: t, p2, gamma2 and their rates, those of p2 over its first value.
    """
def heavy_regular_precession(bodies: HeavyBodies, *, cos_inclination: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], spin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    (rows, 2): slow and fast rate about down.
    """
def heavy_series(bodies: HeavyBodies, *, spin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], cos_inclination: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], order: typing.SupportsInt | typing.SupportsIndex, tolerance: typing.SupportsFloat | typing.SupportsIndex) -> dict[str, typing.Any]:
    """
    The fast periodic motion of every row; numbers (rows, 8): order, period and its error, precession rate and its error, errors of rates, down and attitude.
    """
def heavy_sleeping(bodies: HeavyBodies, *, spin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis_down: typing.Annotated[numpy.typing.ArrayLike, numpy.bool]) -> dict[str, typing.Any]:
    """
    Sleeping tops; numbers (rows, 3): threshold, frequency squared, amplification.
    """
def heavy_solve(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], mass: typing.SupportsFloat | typing.SupportsIndex, centre_of_mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], gravity: typing.SupportsFloat | typing.SupportsIndex, gravity_gradient: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, down: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, periodic: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] | None, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, monitor: Monitor | None, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None = None) -> dict[str, typing.Any]:
    """
    Answer of the ladder as plain data.
    """
def json_numbers(values: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> str:
    """
    An array (n,) or (n, width) as JSON; every number reads back as the same double, what is not finite is null.
    """
def matrix_from_quaternion(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def matrix_from_vector(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def published_run(data: PublishedData, *, reading: str, modulus_squared: typing.SupportsFloat | typing.SupportsIndex, end: typing.SupportsFloat | typing.SupportsIndex, samples: typing.SupportsInt | typing.SupportsIndex) -> PublishedRun:
    """
    The system (27) from (28), printed or corrected.
    """
def published_stationary_ratio(kappa2: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], modulus_squared: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
    """
    b1/b3 of (22) as printed, for b2/b3 and k2.
    """
def quaternion_from_euler_312(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def quaternion_from_matrix(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def quaternion_from_vector(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def rotor_assembly(*, carrier_inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], carrier_mass: typing.SupportsFloat | typing.SupportsIndex, rotor_mass: typing.SupportsFloat | typing.SupportsIndex, axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, equatorial_inertia: typing.SupportsFloat | typing.SupportsIndex, offset: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    (3, 3): inertia of the whole about the common mass centre.
    """
def rotor_capture(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, slope: typing.SupportsFloat | typing.SupportsIndex, no_load_rate: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], longest: typing.SupportsFloat | typing.SupportsIndex, tolerance: typing.SupportsFloat | typing.SupportsIndex) -> dict[str, typing.Any]:
    """
    When the attractors of motions are certified, by integration.
    """
def rotor_certify(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, slope: typing.SupportsFloat | typing.SupportsIndex, no_load_rate: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Attractors of states of one gyrostat as far as the algebra decides them.
    """
def rotor_circular_section(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, slope: typing.SupportsFloat | typing.SupportsIndex, no_load_rate: typing.SupportsFloat | typing.SupportsIndex, momentum: typing.SupportsFloat | typing.SupportsIndex) -> dict[str, typing.Any]:
    """
    Level, drive and hold of the invariant circle, and whether it is run through for ever.
    """
def rotor_fall_time(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, slope: typing.SupportsFloat | typing.SupportsIndex, no_load_rate: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_rate: typing.SupportsFloat | typing.SupportsIndex, valley: typing.SupportsInt | typing.SupportsIndex, end: typing.SupportsFloat | typing.SupportsIndex) -> typing.Annotated[list[float], "FixedSize(2)"]:
    """
    Time of a fall of V from a state to a level and its relative error; NaN where it is not known.
    """
def rotor_integrate(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, slope: typing.SupportsFloat | typing.SupportsIndex, no_load_rate: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_rate: typing.SupportsFloat | typing.SupportsIndex, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], method: str, order: typing.SupportsInt | typing.SupportsIndex = 20, tolerance: typing.SupportsFloat | typing.SupportsIndex, precision: str = 'double', patience: typing.SupportsFloat | typing.SupportsIndex = ...) -> dict[str, typing.Any]:
    """
    The full equations under one integrator, timed.
    """
def rotor_published_data(reading: str) -> dict[str, typing.Any]:
    """
    The data of a reading; the no-load rate NaN where it was not given.
    """
def rotor_published_matrix(reading: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rates (3, 3) of gamma1, gamma2, beta*' by themselves [1/s].
    """
def rotor_published_run(*, reading: str, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    gamma1, gamma2, beta*' and gamma3 (n, 4) of the paper's linear equations, printed, corrected, repaired or realisable.
    """
def rotor_solve(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.SupportsFloat | typing.SupportsIndex, slope: typing.SupportsFloat | typing.SupportsIndex, no_load_rate: typing.SupportsFloat | typing.SupportsIndex, angular_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rotor_rate: typing.SupportsFloat | typing.SupportsIndex, attitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, monitor: Monitor | None, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None = None) -> dict[str, typing.Any]:
    """
    Answer of the ladder as plain data.
    """
def rotor_steady(*, inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], axial_inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], slope: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], no_load_rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], momentum: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Steady rotations of rows of gyrostats, (n, 8), padded with -1 and NaN.
    """
def spinning_design(problems: SpinningProblems, *, goal: str, budget: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    Value, bound of the tilt, unstable, resonant, compliant, and why there is no design, a row each.
    """
def spinning_integrate(problem: SpinningProblems, *, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], method: str, order: typing.SupportsInt | typing.SupportsIndex = 20, tolerance: typing.SupportsFloat | typing.SupportsIndex, precision: str = 'double', patience: typing.SupportsFloat | typing.SupportsIndex = ...) -> dict[str, typing.Any]:
    """
    The full equations under one integrator, timed.
    """
def spinning_linear(problems: SpinningProblems, t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    The linear motion of every row at the times.
    """
def spinning_linear_grid(problems: SpinningProblems, start: typing.SupportsFloat | typing.SupportsIndex, step: typing.SupportsFloat | typing.SupportsIndex, points: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
    """
    (14, rows, points): p, q, psi, phi, theta, G1, G2, G3, v1, v2, v3, x1, x2, x3.
    """
def spinning_pointing(problems: SpinningProblems) -> numpy.typing.NDArray[numpy.float64]:
    """
    (rows, 9): pointing error, secular velocity ratio (2), mean tilt (2), nu^2, unstable, resonant, compliant.
    """
def spinning_published(problem: SpinningProblems, *, reading: str, t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict[str, typing.Any]:
    """
    The paper's closed forms for one body, printed, corrected or exact: rates p, q (22), tilt psi, phi (20), spin angle (16), momentum G (33), circle G (35), velocity (43), (47), position (58), (63); nutation [rad/s], secular_velocity_ratio (53), (54), and centre and radius of the circle of G [N m s].
    """
def spinning_solve(problem: SpinningProblems, *, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, monitor: Monitor | None, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None = None) -> dict[str, typing.Any]:
    """
    Answer of the ladder as plain data.
    """
def sweep(*, kind: str, numbers: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], places: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], values: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], tolerance: typing.SupportsFloat | typing.SupportsIndex, model: str, integrator: str, elliptic: str, ask: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, bool, bool]] | None, threads: typing.SupportsInt | typing.SupportsIndex, monitor: Monitor | None, scene: dict[str, typing.Any] | None = None, recognise: bool = True, euler: typing.Annotated[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(3)"] | None = None) -> dict[str, typing.Any]:
    """
    Answers of the ladder to rows of scenes: `numbers` in the order of the family's inputs, those at `places` from `values` (k, n); of a general `scene` in that of general_numbers, and behind them, where there are more, the errors of the start: attitude, angular_velocity, rotor_rate, rotor_angle, velocity, position.
    """
def vector_from_matrix(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
def vector_from_quaternion(rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    ...
__version__: str = '0.2.0'
