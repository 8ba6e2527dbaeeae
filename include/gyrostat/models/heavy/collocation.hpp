// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/linear_solve.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/series_2.hpp"

/// Periodic motions as Fourier sums that solve the equations at equally spaced times (docs/heavy.md, section 4): without integration,
/// and so without the growth of errors along an unstable motion. Not for hot paths: dense systems of six numbers a node, on the heap.
namespace gyrostat::heavy {

/// A periodic motion at n equally spaced times, n odd.
template <Real Scalar>
struct CollocatedOrbit {
  std::vector<State<Scalar>>
      nodes;          ///< at T j/n; without attitude; the first at the section r = r0, down = (M3, 0, G0)
  Scalar period = 0;  ///< s
  /// Factors of the gradients of energy, vertical momentum and |down|^2, each of unit length, that make the equations square: zero
  /// but for rounding on a true motion.
  Vec3<Scalar> unfolding{0, 0, 0};
  Scalar residual = 0;  ///< greatest defect of the equations at the nodes, over rate_size
  Scalar tail = 0;      ///< size of the last three harmonics: what the Fourier sum leaves out is smaller
  int iterations = 0;   ///< of Newton's method, all node counts together
};

/// How a periodic motion is looked for: node counts are odd, and at least 5.
template <Real Scalar>
struct CollocationOptions {
  int first_nodes = 17;
  int most_nodes = 129;  ///< node counts go 17, 33, 65, ... until the tail is below the tolerance
  Scalar tolerance = 64 * epsilon<Scalar>;
};

/// The periodic motion near a guess with r(0) = r0, down(0) = (M3, 0, G0).
/// Errors: out_of_domain (fewer than 5 nodes or an even number, period not positive, |cos_inclination| >= 1); no_convergence (Newton's
/// method, or tail or unfolding stay above 1e-6 with most_nodes); not_finite.
/// @param guess at equally spaced times of a period, first at 0   @param period s   @param spin r0, rad/s
template <Real Scalar>
Result<CollocatedOrbit<Scalar>> collocated_orbit(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination,
                                                 std::span<const State<Scalar>> guess, Scalar period,
                                                 const CollocationOptions<Scalar>& options = {});

/// From the closed form of second order. Errors: those of Series2 too.
template <Real Scalar>
Result<CollocatedOrbit<Scalar>> collocated_orbit(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination,
                                                 const CollocationOptions<Scalar>& options = {});

namespace detail {

/// One motion at other times: the trigonometric polynomial through an odd number of nodes.
template <Real Scalar>
std::vector<State<Scalar>> resampled(std::span<const State<Scalar>> nodes, std::size_t count) {
  const std::size_t n = nodes.size();
  std::vector<State<Scalar>> made(count);
  for (std::size_t i = 0; i < count; ++i) {
    State<Scalar>& s = made[i];
    s.down.setZero();
    for (std::size_t j = 0; j < n; ++j) {
      // i/count - j/n as a fraction of a turn, by whole numbers
      const auto off = static_cast<long long>(i * n) - static_cast<long long>(j * count);
      const Scalar half = pi<Scalar> * static_cast<Scalar>(off) / static_cast<Scalar>(n * count);
      const Scalar weight =
          off == 0 ? Scalar(1) : std::sin(static_cast<Scalar>(n) * half) / (static_cast<Scalar>(n) * std::sin(half));
      s.angular_velocity += weight * nodes[j].angular_velocity;
      s.down += weight * nodes[j].down;
    }
  }
  return made;
}

/// Newton's method at one node count.
template <Real Scalar>
class Collocation {
 public:
  using Vector6 = Eigen::Matrix<Scalar, 6, 1>;

  /// @param rate of which w is measured, rad/s
  Collocation(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination, Scalar rate)
      : problem_(problem), rate_(rate), spin_(spin / rate), G0_(cos_inclination) {}

  /// Errors: no_convergence, not_finite.
  Errc solve(CollocatedOrbit<Scalar>& orbit) const {
    Unknowns now(orbit, rate_);
    Equations equations(orbit.nodes.size());
    Scalar last = infinity<Scalar>;
    for (int trip = 0; trip < 20; ++trip) {
      equations.clear();
      orbit.residual = collocate(now, equations);
      close(now, equations);
      if (!math::solve_in_place<Scalar>(equations.matrix, equations.right)) return Errc::no_convergence;
      Scalar length = 0;
      for (const Scalar x : equations.right) length = std::abs(x) > length ? std::abs(x) : length + 0 * x;
      if (!(length < infinity<Scalar>)) return Errc::not_finite;
      now.go_back(equations.right, length > Scalar(0.5L) ? Scalar(0.5L) / length : Scalar(1));
      ++orbit.iterations;
      if (!(now.turn > 0)) return Errc::no_convergence;
      const bool small = length < Scalar(1e-9L) + 1024 * epsilon<Scalar>;
      if (length <= 8 * epsilon<Scalar> || (small && length > last / 4)) {
        now.write(orbit, rate_);
        orbit.tail = tail(now.nodes);
        return Errc::ok;
      }
      last = length;
    }
    return Errc::no_convergence;
  }

 private:
  /// In the order of the equations' columns: omega over the rate and down at each node, turns in a unit of time, and the unfolding.
  struct Unknowns {
    std::vector<Vector6> nodes;
    Scalar turn;
    Vec3<Scalar> unfolding{0, 0, 0};

    Unknowns(const CollocatedOrbit<Scalar>& orbit, Scalar rate)
        : nodes(orbit.nodes.size()), turn(2 * pi<Scalar> / (orbit.period * rate)) {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes[i] << orbit.nodes[i].angular_velocity / rate, orbit.nodes[i].down;
    }
    void go_back(const std::vector<Scalar>& step, Scalar part) noexcept {
      const std::size_t n = nodes.size();
      for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < 6; ++k) nodes[i][k] -= part * step[6 * i + static_cast<std::size_t>(k)];
      turn -= part * step[6 * n];
      for (int k = 0; k < 3; ++k) unfolding[k] -= part * step[6 * n + 1 + static_cast<std::size_t>(k)];
    }
    void write(CollocatedOrbit<Scalar>& orbit, Scalar rate) const noexcept {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        orbit.nodes[i].angular_velocity = rate * nodes[i].template head<3>();
        orbit.nodes[i].down = nodes[i].template tail<3>();
      }
      orbit.period = 2 * pi<Scalar> / (turn * rate);
      orbit.unfolding = unfolding;
    }
  };

  /// Of one Newton step, by rows; once they are solved, `right` is the step.
  struct Equations {
    std::size_t size, stride;
    std::vector<Scalar> matrix, right;

    explicit Equations(std::size_t nodes)
        : size(6 * nodes + 4), stride(math::padded(size)), matrix(size * stride), right(size) {}
    void clear() noexcept { std::fill(matrix.begin(), matrix.end(), Scalar(0)); }
    Scalar& at(std::size_t i, std::size_t j) noexcept { return matrix[i * stride + j]; }
  };

  /// The equations of motion at each node; how far they are from holding.
  Scalar collocate(const Unknowns& now, Equations& equations) const {
    const std::size_t n = now.nodes.size();
    Scalar residual = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3<Scalar> w = now.nodes[i].template head<3>(), d = now.nodes[i].template tail<3>();
      Vector6 slope = Vector6::Zero();
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        const Scalar by = derivative(static_cast<int>(i) - static_cast<int>(j), static_cast<int>(n));
        slope += by * now.nodes[j];
        for (std::size_t k = 0; k < 6; ++k) equations.at(6 * i + k, 6 * j + k) = now.turn * by;
      }
      Eigen::Matrix<Scalar, 6, 3> gradient;
      const Vector6 f = right_side(w, d, gradient);
      const Eigen::Matrix<Scalar, 6, 6> by_state = jacobian(w, d);
      const Vector6 defect = now.turn * slope - f - gradient * now.unfolding;
      for (int k = 0; k < 6; ++k) {
        const std::size_t here = 6 * i + static_cast<std::size_t>(k);
        for (int j = 0; j < 3; ++j) equations.at(here, 6 * n + 1 + static_cast<std::size_t>(j)) = -gradient(k, j);
        for (int j = 0; j < 6; ++j) equations.at(here, 6 * i + static_cast<std::size_t>(j)) -= by_state(k, j);
        equations.at(here, 6 * n) = slope[k];
        equations.right[here] = defect[k];
      }
      residual = std::max(residual, defect.cwiseAbs().maxCoeff());
    }
    return residual;
  }

  /// The section, and the length of down.
  void close(const Unknowns& now, Equations& equations) const noexcept {
    const std::size_t last = 6 * now.nodes.size();
    const Vector6& first = now.nodes[0];
    const Vec3<Scalar> down = first.template tail<3>();
    equations.at(last, 2) = equations.at(last + 1, 4) = equations.at(last + 2, 5) = 1;
    for (int k = 0; k < 3; ++k) equations.at(last + 3, static_cast<std::size_t>(3 + k)) = down[k];
    equations.right[last] = first[2] - spin_;
    equations.right[last + 1] = down[1];
    equations.right[last + 2] = down[2] - G0_;
    equations.right[last + 3] = (down.squaredNorm() - 1) / 2;
  }

  /// Of the cardinal function of a node, k nodes away, by the phase.
  static Scalar derivative(int k, int n) noexcept {
    const Scalar half = Scalar(0.5L) / std::sin(pi<Scalar> * static_cast<Scalar>(k) / static_cast<Scalar>(n));
    return k % 2 == 0 ? half : -half;
  }

  Vector6 right_side(const Vec3<Scalar>& w, const Vec3<Scalar>& d, Eigen::Matrix<Scalar, 6, 3>& gradient) const {
    const Vec3<Scalar>& I = problem_.inertia();
    const Scalar unit = rate_ * rate_;
    Vector6 f;
    f << angular_acceleration<Scalar>(problem_, rate_ * w, d) / unit, fixed_vector_rate<Scalar>(d, w);
    gradient << I.cwiseProduct(w), I.cwiseProduct(d), Vec3<Scalar>::Zero(),
        (problem_.gradient() * I.cwiseProduct(d) - problem_.moment()) / unit, I.cwiseProduct(w), d;
    for (int k = 0; k < 3; ++k) {
      Scalar square = 0;
      for (int i = 0; i < 6; ++i) square += gradient(i, k) * gradient(i, k);
      gradient.col(k) /= std::sqrt(square);
    }
    return f;
  }
  Eigen::Matrix<Scalar, 6, 6> jacobian(const Vec3<Scalar>& w, const Vec3<Scalar>& d) const {
    Eigen::Matrix<Scalar, 6, 6> by = state_jacobian<Scalar>(problem_, rate_ * w, d) / rate_;
    by.template topRightCorner<3, 3>() /= rate_;
    by.template bottomLeftCorner<3, 3>() *= rate_;
    return by;
  }
  /// The largest of the last three harmonics.
  static Scalar tail(const std::vector<Vector6>& y) {
    const std::size_t n = y.size(), last = (n - 1) / 2;
    Scalar most = 0;
    for (std::size_t j = last; j + 3 > last; --j) {
      Vector6 c = Vector6::Zero(), s = Vector6::Zero();
      for (std::size_t i = 0; i < n; ++i) {
        const Scalar angle = 2 * pi<Scalar> * static_cast<Scalar>(i * j % n) / static_cast<Scalar>(n);
        c += std::cos(angle) * y[i];
        s += std::sin(angle) * y[i];
      }
      Scalar square = 0;
      for (int k = 0; k < 6; ++k) square += c[k] * c[k] + s[k] * s[k];
      most = std::max(most, 2 * std::sqrt(square) / static_cast<Scalar>(n));
    }
    return most;
  }

  Problem<Scalar> problem_;
  Scalar rate_, spin_, G0_;
};

}  // namespace detail

template <Real Scalar>
Result<CollocatedOrbit<Scalar>> collocated_orbit(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination,
                                                 std::span<const State<Scalar>> guess, Scalar period,
                                                 const CollocationOptions<Scalar>& options) {
  if (guess.size() < 5 || guess.size() % 2 == 0 || options.first_nodes < 5 || options.most_nodes < options.first_nodes)
    return Errc::out_of_domain;
  if (!(period > 0) || !(std::abs(cos_inclination) < 1)) return Errc::out_of_domain;
  const Scalar rate = rate_size(problem, guess[0]);
  if (!(rate > 0) || !(rate < infinity<Scalar>)) return Errc::not_finite;
  const detail::Collocation<Scalar> method(problem, spin, cos_inclination, rate);
  CollocatedOrbit<Scalar> orbit, finer;
  orbit.period = period;
  Errc error = Errc::no_convergence;
  bool found = false;
  for (int nodes = options.first_nodes | 1; nodes <= options.most_nodes; nodes = 2 * nodes - 1) {
    finer = orbit;
    finer.nodes =
        detail::resampled(found ? std::span<const State<Scalar>>(orbit.nodes) : guess, static_cast<std::size_t>(nodes));
    error = method.solve(finer);
    orbit.iterations = finer.iterations;
    if (error != Errc::ok) continue;
    found = true;
    orbit = finer;
    if (orbit.tail <= options.tolerance) break;
  }
  if (!found) return error;
  constexpr Scalar loose = Scalar(1e-6L) + 64 * epsilon<Scalar>;
  if (!(orbit.tail < loose) || !(orbit.unfolding.norm() < loose)) return Errc::no_convergence;
  return orbit;
}

template <Real Scalar>
Result<CollocatedOrbit<Scalar>> collocated_orbit(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination,
                                                 const CollocationOptions<Scalar>& options) {
  const auto series = Series2<Scalar>::make(problem, spin, cos_inclination);
  if (!series) return series.error();
  std::vector<State<Scalar>> guess(static_cast<std::size_t>(std::max(options.first_nodes, 5) | 1));
  for (std::size_t i = 0; i < guess.size(); ++i)
    guess[i] = series->at(series->period() * static_cast<Scalar>(i) / static_cast<Scalar>(guess.size()));
  return collocated_orbit<Scalar>(problem, spin, cos_inclination, guess, series->period(), options);
}

}  // namespace gyrostat::heavy
