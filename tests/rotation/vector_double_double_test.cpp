// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/vector_double_double.hpp"

#include "catch.hpp"
#include "gyrostat/math/carlson.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/symmetric.hpp"

using namespace gyrostat;

namespace {
using Wide = DoubleDouble;
double in_epsilons(const Wide& x) { return static_cast<double>(x) / epsilon<Wide>.high; }
}  // namespace

TEST_CASE("vectors, tensors and quaternions work in double-double", "[rotation]") {
  const Vec3<Wide> v(Wide(1) / 3, Wide(2) / 7, Wide(-5) / 11), w(2, Wide(1) / 13, -1);
  CHECK(in_epsilons(abs(v.dot(w) - (v[0] * w[0] + v[1] * w[1] + v[2] * w[2]))) < 4);
  CHECK(in_epsilons(abs(cross<Wide>(v, w).dot(v))) < 4);
  CHECK(in_epsilons(abs(v.norm() * v.norm() - v.squaredNorm())) < 4);
  CHECK(v.allFinite());
  CHECK_FALSE((v * (Wide(1) / 0)).allFinite());
  const Quat<Wide> q = normalised(Quat<Wide>{1, Wide(1) / 3, Wide(-1) / 5, Wide(1) / 7});
  CHECK(in_epsilons(abs(norm(q) - 1)) < 4);
  const Quat<Wide> back = from_matrix(to_matrix(q));
  CHECK(in_epsilons(abs(back.x - q.x) + abs(back.y - q.y) + abs(back.z - q.z) + abs(back.w - q.w)) < 16);
  CHECK(in_epsilons((rotate<Wide>(conjugate(q), rotate<Wide>(q, v)) - v).norm()) < 16);
  CHECK(vector_cast<double>(v) == Vec3<double>(1. / 3, 2. / 7, -5. / 11));
}

TEST_CASE("eigenvectors of a symmetric tensor in double-double", "[rotation]") {
  Mat3<Wide> S;
  S << Wide(41) / 10, Wide(-3) / 7, Wide(1) / 9, Wide(-3) / 7, Wide(39) / 10, Wide(2) / 11, Wide(1) / 9, Wide(2) / 11,
      1;
  const auto e = symmetric_eigen<Wide>(S);
  CHECK(in_epsilons((S * e.axes - e.axes * e.values.asDiagonal()).cwiseAbs().maxCoeff()) < 100);
  CHECK(in_epsilons((e.axes.transpose() * e.axes - Mat3<Wide>::Identity()).cwiseAbs().maxCoeff()) < 100);
  CHECK(e.values[0] < e.values[1]);
  CHECK(matrix_cast<double>(matrix_cast<Wide>(Mat3<double>(matrix_cast<double>(S)))) == matrix_cast<double>(S));
}

TEST_CASE("elliptic integrals follow the precision of their argument", "[rotation]") {
  const math::Modulus<Wide> m{Wide(1) / 3, Wide(2) / 3};
  const Wide K = math::complete(m).K, Kc = math::complete(m.complement()).K;
  CHECK(in_epsilons(abs(K - math::carlson_RF<Wide>(0, Wide(2) / 3, 1))) < 64);
  CHECK(in_epsilons(abs(Kc - math::carlson_RF<Wide>(0, Wide(1) / 3, 1))) < 64);
}
