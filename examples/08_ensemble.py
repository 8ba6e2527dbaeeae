# SPDX-License-Identifier: BSD-3-Clause
"""The drag on a tumbling body is known poorly. When does it stop: a thousand and one answers, each with an error of its own, and their
percentiles? Needs the extra gyrostat[xarray]."""

import gyrostat

scene = {
    "name": "despin", "kind": "deceleration", "solve": {"times": [1000]}, "body": {"inertia": [35, 22, 16]},  # s, kg m^2
    "torque": {"control": [0.008, 0.008, 0.008], "drag": 2e-4}, "initial": {"angular_momentum": [40, 25, 16.5]},  # N m, 1/s, N m s
}
# an even grid; "normal(2e-4, 10%)" with n=1001 draws at random
rows = gyrostat.sweep(scene, {"torque.drag": "1e-4:3e-4:1001"}, ask={"stop_time": 1e-6})
print(f"rows over the tolerance: {int((~rows['met']).sum())}, greatest error {float(rows['stop_time_error'].max()):.1e}")
for percent in (5, 50, 95):
    print(f"stop time, {percent} %: {float(rows['stop_time'].quantile(percent / 100)):.4f} s")
