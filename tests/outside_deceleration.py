# SPDX-License-Identifier: BSD-3-Clause
"""The true motion of a deceleration scene: Taylor series of order 30 in long double, in the body axes that the scene gives, by nothing of
the library. No principal axes are needed but for the modulus, and the data are the numbers of the scene file themselves.

    dM/dt = M x omega - drag D - diag(control) U/|U|,   omega = J^-1 (M - l),   dq/dt = q (0, omega)/2
"""
import numpy as np

Long = np.longdouble
ORDER = 30
STEP = Long(1e-20)  # the last kept term over the size of the state
STEPS = 200_000


def adjugate(m):
    """Determinant times inverse of a symmetric 3x3 matrix."""
    rows = [np.cross(m[(i + 1) % 3], m[(i + 2) % 3]) for i in range(3)]
    return np.array(rows).T


def inverse(m):
    cofactors = adjugate(m)
    return cofactors / (m[0] @ cofactors[:, 0])


def principal(J):
    """Moments, descending, and axes (columns) of a symmetric tensor, by Jacobi rotations."""
    A, axes = J.copy(), np.eye(3, dtype=Long)
    for _ in range(12):
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if A[i, j] == 0:
                continue
            theta = (A[j, j] - A[i, i]) / (2 * A[i, j])
            t = (1 if theta >= 0 else -1) / (abs(theta) + np.hypot(theta, Long(1)))
            c = 1 / np.hypot(t, Long(1))
            turn = np.eye(3, dtype=Long)
            turn[i, i] = turn[j, j] = c
            turn[i, j], turn[j, i] = t * c, -t * c
            A, axes = turn.T @ A @ turn, axes @ turn
            A[i, j] = A[j, i] = 0
    order = np.argsort(-np.diag(A))
    return np.diag(A)[order], axes[:, order]


class Motion:
    """The equations of one scene, from the plain data of its file."""

    def __init__(self, scene):
        body, torque, start = scene["body"], scene["torque"], scene["initial"]
        J = np.array(body["inertia"], dtype=Long)
        self.J = np.diag(J) if J.ndim == 1 else (J + J.T) / 2
        self.inverse = inverse(self.J)
        self.gaps = None
        if J.ndim == 1:
            self.inverse = np.diag(1 / J)
            # of a slender body the parts of M x omega cancel
            self.gaps = np.array([(J[j] - J[k]) / J[j] / J[k] for j, k in ((1, 2), (2, 0), (0, 1))])
        self.l = np.array(body.get("rotor_momentum", (0, 0, 0)), dtype=Long)
        self.b = np.array(torque["control"], dtype=Long)
        self.drag = Long(torque["drag"])
        self.carrier = torque.get("law", "total") == "carrier"
        self.carrier_drag = torque.get("drag_law", "total") == "carrier"
        if "angular_momentum" in start:
            self.M = np.array(start["angular_momentum"], dtype=Long)
        else:
            self.M = self.J @ np.array(start["angular_velocity"], dtype=Long) + self.l
        q = np.array(start.get("attitude", (0, 0, 0, 1)), dtype=Long)  # [x, y, z, w]
        self.q = q / np.sqrt(q @ q)
        self.offset = self.l if self.carrier else 0 * self.l
        self.fixed = self.inverse @ self.l
        self.controlled = bool(self.b.any())
        # torque at U = 0, which the control has to hold
        self.constant = self.drag * self.rest_torque()
        if not self.controlled:
            self.holds = False
        elif not self.constant.any():
            self.holds = True
        else:
            held = all(b > 0 or c == 0 for b, c in zip(self.b, self.constant))
            used = sum((c / b) ** 2 for b, c in zip(self.b, self.constant) if b > 0)
            self.holds = held and used <= 1

    def rest_torque(self):
        """-D at U = 0, over the drag."""
        if self.carrier == self.carrier_drag:
            return 0 * self.l
        return -self.l if self.carrier else self.l

    def omega(self, M):
        return self.inverse @ (M - self.l)

    def series(self, M0, q0):
        """Taylor coefficients of M and q."""
        n = ORDER + 1
        M, w, U, u = (np.zeros((n, 3), dtype=Long) for _ in range(4))
        size, q = np.zeros(n, dtype=Long), np.zeros((n, 4), dtype=Long)
        M[0], q[0] = M0, q0
        for k in range(ORDER):
            back = slice(k, None, -1)
            U[k] = M[k] - self.offset if k == 0 else M[k]
            G = M[k] - self.l if k == 0 else M[k]
            w[k] = self.inverse @ G
            P, Q = M[: k + 1].T @ w[back], q[: k + 1].T @ w[back]
            if self.gaps is None:
                rate = np.array([P[1, 2] - P[2, 1], P[2, 0] - P[0, 2], P[0, 1] - P[1, 0]])
            else:
                P = M[: k + 1].T @ M[back]
                a, b = M[k], self.fixed  # their product by hand: numpy's cross costs more than all the rest
                rate = self.gaps * np.array([P[1, 2], P[2, 0], P[0, 1]]) - np.array(
                    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
            rate -= self.drag * (G if self.carrier_drag else M[k])
            if self.controlled:
                if k == 0:
                    size[0] = np.sqrt(U[0] @ U[0])
                    u[0] = U[0] / size[0]
                else:
                    size[k] = ((U[: k + 1] * U[back]).sum() - size[1:k] @ size[k - 1:0:-1]) / (2 * size[0])
                    u[k] = (U[k] - size[1: k + 1] @ u[k - 1::-1]) / size[0]
                rate -= self.b * u[k]
            M[k + 1] = rate / (k + 1)
            x, y, z, s = 0, 1, 2, 3
            q[k + 1] = np.array([Q[s, x] + Q[y, z] - Q[z, y], Q[s, y] + Q[z, x] - Q[x, z], Q[s, z] + Q[x, y] - Q[y, x],
                                 -Q[x, x] - Q[y, y] - Q[z, z]]) / (2 * (k + 1))
        return M, q

    def step(self, M, q):
        """How far the series hold; the rates count, too, as those of a slender body are made by small parts of M."""
        h, w = np.inf, M @ self.inverse.T
        for x, size in ((M, np.abs(M[0]).max() + np.abs(self.l).max()), (w, np.abs(self.omega(M[0])).max()), (q, Long(1))):
            if size == 0:
                continue
            for k in (ORDER, ORDER - 1):
                last = np.abs(x[k]).max()
                if last > 0:
                    h = min(h, (STEP * size / last) ** (Long(1) / k))
        if self.controlled:
            U = M[0] - self.offset
            size = np.sqrt(U @ U)
            fall = np.sqrt(self.b @ self.b) + self.drag * (size + np.sqrt(self.l @ self.l))
            h = min(h, Long("0.25") * size / fall)
        return h


def at(x, s):
    total = x[-1]
    for row in x[-2::-1]:
        total = total * s + row
    return total


def turned(q, w, t):
    """q behind a rotation at the rate w through the time t."""
    rate = np.sqrt(w @ w)
    if rate == 0:
        return q
    half = rate * t / 2
    x, y, z = w / rate * np.sin(half)
    a, b, c, d = q
    s = np.cos(half)
    return np.array([d * x + a * s + b * z - c * y, d * y - a * z + b * s + c * x, d * z + a * y - b * x + c * s, d * s - a * x - b * y - c * z])


def modulus_squared(moments, R, M):
    """k2 of the polhode through M, no rotors."""
    A, B, C = moments
    gaps = ((A - B) / A / B, (B - C) / B / C, (A - C) / A / C)
    m = (R.T @ M) ** 2
    near, far = (0, 2) if gaps[0] * m[0] >= gaps[1] * m[2] else (2, 0)
    near_mid, mid_far = (gaps[0], gaps[1]) if near == 0 else (gaps[1], gaps[0])
    across = near_mid * m[1] + gaps[2] * m[far]
    along = gaps[2] * m[near] + mid_far * m[1]
    return mid_far * across / (near_mid * along) if near_mid * along > 0 else Long(0)


def states(motion, times, stop_wanted):
    """M and q at the times, and the stop time (None: not reached)."""
    M, q, t = motion.M, motion.q, Long(0)
    found, stop, next_ = [], None, 0
    scale = max(np.abs(M).max(), np.abs(motion.l).max())
    for _ in range(STEPS):
        U = M - motion.offset
        size = np.sqrt(U @ U)
        if motion.controlled and motion.holds and size <= Long(1e-19) * scale:
            fall = (U / size) @ (motion.b * U / size - motion.drag * motion.rest_torque()) if size > 0 else Long(1)
            stop = t + (size / fall if fall > 0 else 0)
            break
        if next_ == len(times) and not (stop_wanted and motion.controlled and motion.holds):
            break
        Ms, qs = motion.series(M, q)
        h = motion.step(Ms, qs)
        while next_ < len(times) and times[next_] <= t + h:
            found.append((at(Ms, times[next_] - t), at(qs, times[next_] - t)))
            next_ += 1
        M, q, t = at(Ms, h), at(qs, h), t + h
        q = q / np.sqrt(q @ q)
    else:
        raise RuntimeError("too many steps for the truth")
    rest_rate = motion.omega(motion.offset)
    for time in times[next_:]:
        found.append((motion.offset, turned(q, rest_rate, time - stop)))
    return found, stop


def truth(scene, times, scalars):
    """Columns and scalars of the scene (the plain data of its file) as (n,) or (n, k) arrays of long double; those asked for."""
    motion = Motion(scene)
    found, stop = states(motion, np.array(times, dtype=Long), "stop_time" in scalars)
    M = np.array([m for m, _ in found])
    G = M - motion.l
    omega = G @ motion.inverse.T
    columns = {
        "angular_momentum": M, "angular_velocity": omega, "angular_momentum_norm": np.sqrt((M * M).sum(1)),
        "energy": (G * omega).sum(1) / 2, "attitude": np.array([q for _, q in found]),
    }
    if not motion.l.any():
        moments, axes = principal(motion.J)
        columns["modulus_squared"] = np.array([modulus_squared(moments, axes, m) for m in M])
    return columns, {} if stop is None else {"stop_time": stop}
