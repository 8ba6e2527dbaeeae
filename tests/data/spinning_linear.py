#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write spinning_linear.csv beside this file: the linear motion of the cases of reference/spinning.json at constant spin, and of
cases near and at every resonance, to 25 digits.

From the exponential of the augmented linear system at 60 digits, compared with the reference where it has the case. Needs mpmath.

Columns: name; D (3); mass; lambda3; e_H; M (2); f (3); p, q, r; psi, phi, theta; v (3); x (3); t; then p, q, psi, phi, theta,
G (2), v (3), x (3). The inputs are exact doubles.
"""

import json
from pathlib import Path

import mpmath as mp

HERE = Path(__file__).parent
mp.mp.dps = 60
NAMES = ["p", "q", "psi", "phi", "theta", "G1", "G2", "v1", "v2", "v3", "x1", "x2", "x3"]


class Body:
    def __init__(self, name, D, m, lambda3, e_H, M, f, rates, angles, v=(0, 0, 0), x=(0, 0, 0)):
        self.name = name
        self.inputs = [float(u) for u in (*D, m, lambda3, e_H, *M, *f, *rates, *angles, *v, *x)]

    def motion(self, times):
        """The 13 outputs at the times, by the exponential of the augmented system."""
        u = [mp.mpf(c) for c in self.inputs]
        D1, D2, D3, m, lambda3, e_H, M1, M2, f1, f2, f3, p, q, r, psi, phi, theta, v1, v2, v3, x1, x2, x3 = u
        Lambda = lambda3 - e_H
        k1, k2 = ((D3 - D2) * r + Lambda) / D1, ((D3 - D1) * r + Lambda) / D2
        # 1; p, q; e^(i theta) times 1, p, q, Gamma; Gamma; conj Gamma; v; x; G; v3; x3
        one, P, Q, chi, chi_p, chi_q, chi_tilt, tilt, tilt_c, v, x, G, v3_, x3_ = range(14)
        A = mp.zeros(14)

        def rate(row, **terms):
            for name, factor in terms.items():
                A[row, index[name]] += factor

        index = dict(one=one, p=P, q=Q, chi=chi, chi_p=chi_p, chi_q=chi_q, chi_tilt=chi_tilt, tilt=tilt, tilt_c=tilt_c, v=v, v3=v3_)
        j = mp.mpc(0, 1)
        rate(P, one=M1 / D1, q=-k1)
        rate(Q, one=M2 / D2, p=k2)
        rate(chi, chi=j * r)
        rate(chi_p, chi_p=j * r, chi=M1 / D1, chi_q=-k1)
        rate(chi_q, chi_q=j * r, chi=M2 / D2, chi_p=k2)
        rate(chi_tilt, chi_p=1, chi_q=j)
        rate(tilt, tilt=-j * r, p=1, q=j)
        rate(tilt_c, tilt_c=j * r, p=1, q=-j)
        rate(v, chi=mp.mpc(f1, f2) / m, chi_tilt=-j * f3 / m)
        rate(x, v=1)
        rate(G, chi=mp.mpc(M1, M2), chi_p=-j * e_H, chi_q=e_H)
        rate(v3_, one=f3 / m, tilt=(j * f1 + f2) / (2 * m), tilt_c=(f2 - j * f1) / (2 * m))
        rate(x3_, v3=1)
        turn, Gamma = mp.expj(theta), mp.mpc(psi, phi)
        start = mp.matrix([1, p, q, turn, turn * p, turn * q, turn * Gamma, Gamma, mp.conj(Gamma), mp.mpc(v1, v2),
                           mp.mpc(x1, x2), turn * (D1 * p + j * D2 * q - j * (D3 * r + lambda3) * Gamma), v3, x3])
        for t in times:
            y = exponential(A * t) * start
            yield [y[P].real, y[Q].real, y[tilt].real, y[tilt].imag, theta + r * t, y[G].real, y[G].imag, y[v].real, y[v].imag,
                   y[v3_].real, y[x].real, y[x].imag, y[x3_].real]


def exponential(A):
    scale = max(0, int(mp.log(mp.norm(A, 1) + 1, 2)) + 2)
    small = A * mp.mpf(2) ** -scale
    total = term = mp.eye(A.rows)
    for k in range(1, 45):
        term = term * small / k
        total = total + term
    for _ in range(scale):
        total = total * total
    return total


def reference():
    for case in json.loads((HERE / "reference" / "spinning.json").read_text(encoding="utf-8"))["cases"]:
        i = {k: float(v) for k, v in case["inputs"].items()}
        if i["M3"] != 0:
            continue
        e_H = float(case["derived"]["e_H"])
        body = Body(case["name"], (i["D1"], i["D2"], i["D3"]), i["m"], i["lambda3"], e_H, (i["M1"], i["M2"]),
                    (i["f1"], i["f2"], i["f3"]), (i["p0"], i["q0"], i["r0"]), (i["psi0"], i["phi0"], i["theta0"]),
                    (i["v10"], i["v20"], i["v30"]), (i["x10"], i["x20"], i["x30"]))
        # e_H rounded to a double moves the motion by a few eps
        yield body, [float(t) for t in case["times"]], case["linear_model"]


def resonances():
    for detuning in (1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 0.0):
        def body(name, D=(8, 7, 12), lambda3=0.0, r=1.0, e_H=0.0, angles=(0.004, -0.002, 0.3)):
            return Body(f"{name}_{detuning:g}", D, 10, lambda3, e_H, (0.4, -0.2), (0.3, -0.2, 3.0), (0.002, -0.003, r), angles,
                        (0.1, -0.2, 0.3), (1, 2, 3))
        yield body("X", lambda3=detuning - 12)
        yield body("X_sum", lambda3=3 + detuning)
        yield body("X_sum_equal", D=(7, 7, 12), lambda3=2 + detuning)
        yield body("kappa1", lambda3=detuning - 5)
        yield body("kappa2", lambda3=detuning - 4, e_H=0.25)
        yield body("spin", lambda3=2.0, r=detuning)
        yield body("all", D=(7, 7, 7), r=detuning)
        yield body("sphere", D=(7, 7, 7), lambda3=detuning)
        yield body("backwards", lambda3=12 - detuning, r=-1.0, e_H=0.5)


def main():
    worst = 0
    with (HERE / "spinning_linear.csv").open("w", encoding="utf-8") as file:
        file.write("# written by spinning_linear.py\n")

        def write(body, times):
            for t, values in zip(times, body.motion(times)):
                cells = [body.name, *(repr(u) for u in body.inputs), repr(t), *(mp.nstr(u, 25) for u in values)]
                file.write(",".join(cells) + "\n")
                yield values

        for body, times, rows in reference():
            for values, row in zip(write(body, times), rows):
                for pair in (["p", "q"], ["psi", "phi"], ["G1", "G2"], ["v1", "v2"], ["x1", "x2"], ["v3"], ["x3"]):
                    size = mp.norm([mp.mpf(row[n]) for n in pair])
                    apart = mp.norm([values[NAMES.index(n)] - mp.mpf(row[n]) for n in pair])
                    worst = max(worst, apart / (size + mp.mpf("1e-30")))
        for body in resonances():
            for _ in write(body, [0.01, 3.0, 300.0]):
                pass
    print(f"from the reference at most {mp.nstr(worst, 3)} relative")


if __name__ == "__main__":
    main()
