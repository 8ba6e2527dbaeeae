// SPDX-License-Identifier: BSD-3-Clause
// A flight computer looks ahead: how long until a tumbling body has lost 99 % of its momentum, by the averaged equations? No heap and no
// exceptions: this file is compiled with -fno-exceptions -fno-rtti, and its operator new counts.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "gyrostat/body/inertia.hpp"
#include "gyrostat/models/deceleration/averaged.hpp"
#include "gyrostat/ode/fixed_step.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

static int allocations = 0;
void* operator new(std::size_t size) {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using Slow = Eigen::Array2d;  // ln |M| and -ln(1 - k2): all that changes slowly; over a turn the rest averages out

/// Time until |M| has fallen to `share` of what it is, s; NaN where it does not within a bounded number of steps.
double time_to(double share, const Inertia<double>& body, const Mat3<double>& control, double drag,
               const Vec3<double>& M) noexcept {
  const Polhode<double> start = polhode_through<double>(body.inverse_principal(), body.inverse_gaps(), M);
  const auto torques = ControlTorques<double>::of(control, start.axes);
  const auto rates = [&](const Slow& y) noexcept -> Slow {
    const double norm = std::exp(y[0]), k2 = -std::expm1(-y[1]);
    const auto mean = mean_torque<>(at_modulus(start, {k2, std::exp(-y[1])}), torques);
    return {-drag - mean.deceleration / norm, 2 * mean.escape / norm};
  };
  const double end = std::log(share * M.norm());
  Slow y(std::log(M.norm()), -std::log(start.modulus.kp2));
  double t = 0;
  for (int step = 0; step < 10000; ++step) {
    const double fall = -rates(y)[0], h = 0.01 / fall;  // one per cent of |M| a step
    if (y[0] - end <= 0.01) return t + (y[0] - end) / fall;
    y = ode::classical_step(rates, y, h);
    t += h;
  }
  return gyrostat::nan<double>;
}

}  // namespace

int main() {
  const auto body =
      Inertia<double>::from_moments(35, 22, 16);  // kg m^2, about the body axes, which descend: those are principal
  const Mat3<double> control = Vec3<double>(0.005, 0.008, 0.010).asDiagonal();  // N m
  const double drag = 2e-4;                                                     // 1/s
  Vec3<double> M(40, 25, 16.5);                                                 // N m s, as it is measured
  const int before = allocations;
  double first = 0, t = 0;
  for (int cycle = 0; cycle < 5; ++cycle) {  // in flight: once a second
    t = time_to(0.01, *body, control, drag, M);
    if (cycle == 0) first = t;
    M *= 0.9;  // the next measurement
  }
  std::printf("down to one per cent after %.2f s\n", first);
  std::printf("the last of five looks ahead: %.2f s more\n", t);
  std::printf("allocations: %d\n", allocations - before);
  return allocations - before;
}
