// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/symmetric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "samples.hpp"

using namespace gyrostat;

namespace {

template <Real S>
bool proper(const Mat3<S>& R) {
  return (R.transpose() * R - Mat3<S>::Identity()).norm() <= 16 * epsilon<S> &&
         cross<S>(R.col(0), R.col(1)).dot(R.col(2)) > 0;
}

}  // namespace

TEMPLATE_TEST_CASE("values ascend, axes are a proper rotation, the tensor is given back", "", float, double,
                   long double) {
  using S = TestType;
  for (const Vec3<S>& values :
       {Vec3<S>(1, 2, 3), Vec3<S>(-5, 0, 40), Vec3<S>(2, 2, 2), Vec3<S>(1, 1, 7), Vec3<S>(1, 7, 7),
        Vec3<S>(1, 1 + 4 * epsilon<S>, 2), Vec3<S>(S(1e-6), 1, S(1e6)), Vec3<S>(S(1e-30), S(2e-30), S(4e-30))}) {
    const S scale = values.cwiseAbs().maxCoeff();
    for (const Vec3<S>& v : sample_rotations<S>()) {
      const Mat3<S> R = matrix_from_vector(v);
      Mat3<S> tensor = R * values.asDiagonal() * R.transpose();
      tensor = (tensor + tensor.transpose()).eval() / 2;
      const SymmetricEigen<S> e = symmetric_eigen(tensor);
      CHECK(e.values[0] <= e.values[1]);
      CHECK(e.values[1] <= e.values[2]);
      CHECK((e.values - values).cwiseAbs().maxCoeff() <= 16 * epsilon<S> * scale);
      CHECK(proper<S>(e.axes));
      CHECK((e.axes * e.values.asDiagonal() * e.axes.transpose() - tensor).norm() <= 32 * epsilon<S> * scale);
    }
  }
}

TEST_CASE("a diagonal tensor gives its entries and a signed permutation, exactly") {
  std::array<double, 3> d{0.1, 0.7, 1.3};
  do {
    Mat3<double> tensor = Mat3<double>::Zero();
    for (int i = 0; i < 3; ++i) tensor(i, i) = d[static_cast<std::size_t>(i)];
    const SymmetricEigen<double> e = symmetric_eigen(tensor);
    CHECK(e.values == Vec3<double>(0.1, 0.7, 1.3));
    CHECK(e.axes * e.values.asDiagonal() * e.axes.transpose() == tensor);
    CHECK(e.axes.cwiseAbs().sum() == 3);
    CHECK(proper<double>(e.axes));
  } while (std::next_permutation(d.begin(), d.end()));
}

TEST_CASE("entries that are not finite give NaN") {
  for (const double bad : {gyrostat::nan<double>, infinity<double>}) {
    Mat3<double> tensor = Mat3<double>::Identity();
    tensor(1, 0) = bad;
    CHECK(symmetric_eigen(tensor).values.array().isNaN().all());
    CHECK(symmetric_eigen(tensor).axes.array().isNaN().all());
  }
}
