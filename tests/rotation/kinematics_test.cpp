// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/kinematics.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "samples.hpp"

using namespace gyrostat;

namespace {

using S = long double;

/// Fourth-order central difference.
template <class F>
auto derivative(F f, S h) {
  using T = decltype(f(h));
  return T((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
}

Eigen::Matrix<S, 4, 1> components(const Quat<S>& q) { return {q.w, q.x, q.y, q.z}; }

const Vec3<S> omega_B(0.4L, -0.9L, 0.5L);

}  // namespace

TEST_CASE("the rates are the derivatives of a body turning at a constant rate") {
  for (const Vec3<S>& v : sample_rotations<S>()) {
    const Quat<S> q = quaternion_from_vector(v);
    const auto turned = [&](S t) { return q * quaternion_from_vector<S>(t * omega_B); };
    const auto dq = derivative([&](S t) { return Eigen::Matrix<S, 4, 1>(components(turned(t))); }, 1e-3L);
    CHECK((components(quaternion_rate(q, omega_B)) - dq).norm() <= 1e-12L);

    const auto dR = derivative([&](S t) { return Mat3<S>(to_matrix(turned(t))); }, 1e-3L);
    CHECK((matrix_rate<S>(to_matrix(q), omega_B) - dR).norm() <= 1e-12L);

    const Vec3<S> fixed_I(0.2L, 1, -0.4L);
    const auto dv = derivative([&](S t) { return Vec3<S>(to_matrix(turned(t)).transpose() * fixed_I); }, 1e-3L);
    CHECK((fixed_vector_rate<S>(to_matrix(q).transpose() * fixed_I, omega_B) - dv).norm() <= 1e-12L);
  }
}

TEST_CASE("the tangent maps turn the rate of the rotation vector into the angular velocity") {
  for (const Vec3<S>& v : sample_rotations<S>()) {
    const Vec3<S> rate(0.3L, 0.8L, -0.5L);
    const auto moved = [&](S t) { return components(quaternion_from_vector<S>(v + t * rate)); };
    const auto dq = derivative(moved, 1e-3L);
    const Quat<S> q = quaternion_from_vector(v);
    const Quat<S> q_rate{dq[0], dq[1], dq[2], dq[3]};
    const Quat<S> body = conjugate(q) * q_rate;
    const Quat<S> space = q_rate * conjugate(q);
    CHECK((right_tangent(v) * rate - 2 * Vec3<S>(body.x, body.y, body.z)).norm() <= 1e-12L);
    CHECK((left_tangent(v) * rate - 2 * Vec3<S>(space.x, space.y, space.z)).norm() <= 1e-12L);
  }
}

TEMPLATE_TEST_CASE("the tangent maps obey their laws", "", float, double, long double) {
  using T = TestType;
  for (const Vec3<T>& v : sample_rotations<T>()) {
    const T tight = 16 * epsilon<T>;
    CHECK((left_tangent(v) - right_tangent(v).transpose()).norm() <= tight);
    CHECK((left_tangent(v) - matrix_from_vector(v) * right_tangent(v)).norm() <= tight);
    CHECK((right_tangent(v) * v - v).norm() <= tight * v.norm());
    CHECK((right_tangent(v) * right_tangent_inverse(v) - Mat3<T>::Identity()).norm() <= 2 * tight);
    CHECK((left_tangent(v) * left_tangent_inverse(v) - Mat3<T>::Identity()).norm() <= 2 * tight);
  }
}
