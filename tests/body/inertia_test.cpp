// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/inertia.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

using namespace gyrostat;

namespace {

template <Real S>
bool proper(const Mat3<S>& R) {
  return (R.transpose() * R - Mat3<S>::Identity()).norm() <= 16 * epsilon<S> &&
         cross<S>(R.col(0), R.col(1)).dot(R.col(2)) > 0;
}

template <Real S>
Mat3<S> rebuilt(const Inertia<S>& inertia) {
  return inertia.R_BP() * inertia.principal().asDiagonal() * inertia.R_BP().transpose();
}

}  // namespace

TEMPLATE_TEST_CASE("moments come in any order and are answered in the caller's axes, exactly", "", float, double,
                   long double) {
  using S = TestType;
  std::array<S, 3> moments{S(16), S(22), S(35)};
  do {
    const auto inertia = Inertia<S>::from_moments(moments[0], moments[1], moments[2]);
    REQUIRE(inertia);
    CHECK(inertia->principal() == Vec3<S>(35, 22, 16));
    CHECK(inertia->inverse_principal() == Vec3<S>(1 / S(35), 1 / S(22), 1 / S(16)));
    CHECK(proper<S>(inertia->R_BP()));
    CHECK(inertia->R_BP().cwiseAbs().sum() == 3);
    CHECK(rebuilt(*inertia) == inertia->tensor());
    CHECK(inertia->tensor() == Mat3<S>(Vec3<S>(moments[0], moments[1], moments[2]).asDiagonal()));
  } while (std::next_permutation(moments.begin(), moments.end()));
  CHECK(Inertia<S>::from_moments(35, 22, 16)->R_BP() == Mat3<S>::Identity());
  CHECK(Inertia<S>::from_moments(2, 2, 2)->R_BP() == Mat3<S>::Identity());
}

TEMPLATE_TEST_CASE("a turned tensor has the same moments and gives itself back", "", float, double, long double) {
  using S = TestType;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  for (const Vec3<S>& moments :
       {Vec3<S>(35, 22, 16), Vec3<S>(3, 2, S(1.5)), Vec3<S>(2, 2, 1), Vec3<S>(2, 1, 1),
        Vec3<S>(1 + 8 * epsilon<S>, 1, 1), Vec3<S>(S(1e-9), S(8e-10), S(5e-10)), Vec3<S>(S(1e12), S(1e12), S(1e6))}) {
    for (int i = 0; i < 50; ++i) {
      const Mat3<S> R = matrix_from_vector<S>({S(coordinate(random)), S(coordinate(random)), S(coordinate(random))});
      Mat3<S> J = R * moments.asDiagonal() * R.transpose();
      J = (J + J.transpose()).eval() / 2;
      const auto inertia = Inertia<S>::from_tensor(J);
      REQUIRE(inertia);
      const Vec3<S> m = inertia->principal();
      CHECK(m[0] >= m[1]);
      CHECK(m[1] >= m[2]);
      CHECK((m - moments).cwiseAbs().maxCoeff() <= 16 * epsilon<S> * moments[0]);
      CHECK(proper<S>(inertia->R_BP()));
      CHECK((rebuilt(*inertia) - J).norm() <= 32 * epsilon<S> * moments[0]);
      CHECK(inertia->tensor() == J);
    }
  }
}

TEST_CASE("what is not a number or not positive is refused") {
  using I = Inertia<double>;
  for (int i = 0; i < 3; ++i) {
    for (const double bad : {gyrostat::nan<double>, infinity<double>, -infinity<double>}) {
      Vec3<double> m(3, 2, 2);
      m[i] = bad;
      CHECK(I::from_moments(m[0], m[1], m[2]).error() == Errc::not_finite);
    }
    for (const double bad : {0.0, -0.0, -1.0, -1e-300}) {
      Vec3<double> m(3, 3, 3);
      m[i] = bad;
      CHECK(I::from_moments(m[0], m[1], m[2]).error() == Errc::not_positive);
    }
  }
  Mat3<double> J = Mat3<double>::Identity();
  J(0, 2) = J(2, 0) = gyrostat::nan<double>;
  CHECK(I::from_tensor(J).error() == Errc::not_finite);
  CHECK(I::from_tensor(Mat3<double>::Zero()).error() == Errc::not_positive);
  CHECK(I::from_moments(1e-308, 1e-308, 1e-308));
}

TEST_CASE("the triangle inequality is met to 8 eps, a lamina is a body") {
  using I = Inertia<double>;
  CHECK(I::from_moments(3, 1, 2));
  CHECK(I::from_moments(0.1 + 0.2, 0.1, 0.2));
  CHECK(I::from_moments(3 * (1 + 6e-16), 1, 2));
  CHECK(I::from_moments(3 * (1 + 4e-15), 1, 2).error() == Errc::triangle_inequality);
  CHECK(I::from_moments(1, 2, 3.001).error() == Errc::triangle_inequality);
  CHECK(I::from_moments(1e-9, 1, 2).error() == Errc::triangle_inequality);
  CHECK(I::from_moments(10, 10, 1e-9));

  const Mat3<double> R = matrix_from_vector<double>({0.3, -0.8, 1.9});
  Mat3<double> J = R * Vec3<double>(3.01, 1, 2).asDiagonal() * R.transpose();
  J = (J + J.transpose()).eval() / 2;
  CHECK(I::from_tensor(J).error() == Errc::triangle_inequality);
}

TEST_CASE("a tensor is symmetric to 8 eps of its largest entry") {
  Mat3<double> J;
  J << 3, 0.1, 0.2, 0.1, 2.5, 0.3, 0.2, 0.3, 2;
  CHECK(Inertia<double>::from_tensor(J));
  J(0, 1) += 3e-15;
  const auto close = Inertia<double>::from_tensor(J);
  REQUIRE(close);
  CHECK(close->tensor() == close->tensor().transpose());
  J(0, 1) += 1e-13;
  CHECK(Inertia<double>::from_tensor(J).error() == Errc::not_symmetric);
  J = 1e-20 * Mat3<double>::Identity();
  J(2, 1) = 1e-25;
  CHECK(Inertia<double>::from_tensor(J).error() == Errc::not_symmetric);
}

TEST_CASE("differences of the inverse moments are right to rounding, however near these are") {
  for (const double gap : {0.5, 1e-6, 1e-12, 1e-15}) {
    const auto inertia = Inertia<double>::from_moments(1.7, 1.7 * (1 + gap), 1.1);
    REQUIRE(inertia);
    const Vec3<long double> m = inertia->principal().cast<long double>();
    const Vec3<double> found = inertia->inverse_gaps();
    CHECK(found[0] == Approx(double((m[0] - m[1]) / (m[0] * m[1]))).epsilon(1e-15).margin(0));
    CHECK(found[1] == Approx(double((m[1] - m[2]) / (m[1] * m[2]))).epsilon(1e-15).margin(0));
    CHECK(found[2] == Approx(double((m[0] - m[2]) / (m[0] * m[2]))).epsilon(1e-15).margin(0));
  }
  CHECK(Inertia<double>::from_moments(2, 2, 1)->inverse_gaps()[0] == 0);
}

TEST_CASE("moments are exact where the body axes are principal") {
  CHECK(Inertia<double>::from_moments(3, 1, 2.5)->has_exact_moments());
  Mat3<double> J = Vec3<double>(3, 2, 2.5).asDiagonal();
  CHECK(Inertia<double>::from_tensor(J)->has_exact_moments());
  J(0, 1) = J(1, 0) = 1e-9;
  CHECK(!Inertia<double>::from_tensor(J)->has_exact_moments());
}

TEST_CASE("axes and differences of nearly equal moments are right to their own rounding") {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> turn(-3, 3), part(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double slight = std::pow(10, -5 * part(random)), gap = slight * std::pow(10, -1 - 7 * part(random));
    const Mat3<double> R = matrix_from_vector<double>({turn(random), turn(random), turn(random)});
    Mat3<double> J = R * Vec3<double>(2, 2 - gap, slight).asDiagonal() * R.transpose();
    J = (J + J.transpose()).eval() / 2;
    const auto inertia = Inertia<double>::from_tensor(J);
    REQUIRE(inertia);
    // what axes that are not quite at right angles leave off the diagonal taken away: by how much they are turned
    const Mat3<DoubleDouble> axes = matrix_cast<DoubleDouble>(inertia->R_BP());
    const Mat3<DoubleDouble> left = axes.transpose() * matrix_cast<DoubleDouble>(J) * axes;
    const DoubleDouble skew = axes.col(0).dot(axes.col(1)), apart = left(0, 0) - left(1, 1);
    const double turned = static_cast<double>((left(0, 1) - (left(0, 0) + left(1, 1)) / 2 * skew) / apart);
    CAPTURE(gap, slight);
    CHECK(std::abs(turned) <= 2 * epsilon<double> + 1e-30 / gap);
    const Vec3<double>& m = inertia->principal();
    const Vec3<DoubleDouble> truth = -symmetric_eigen<DoubleDouble>(-matrix_cast<DoubleDouble>(J)).values;
    CHECK(m == vector_cast<double>(truth));
    const double difference = static_cast<double>(truth[0] - truth[1]);
    CHECK(inertia->inverse_gaps()[0] * m[0] * m[1] == Approx(difference).epsilon(4 * epsilon<double>));
    CHECK(difference == Approx(gap).epsilon(1e-14 / gap));
  }
}
