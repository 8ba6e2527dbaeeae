// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "gyrostat/rotation/vector.hpp"

/// Rotation vectors on which every law is tested: the identity, next to it, random ones, next to half a turn and at it.
template <gyrostat::Real S>
std::vector<gyrostat::Vec3<S>> sample_rotations() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto direction = [&] {
    for (;;) {
      const gyrostat::Vec3<S> v(S(coordinate(random)), S(coordinate(random)), S(coordinate(random)));
      if (v.norm() > S(0.1) && v.norm() < 1) return gyrostat::Vec3<S>(v / v.norm());
    }
  };
  constexpr S pi = gyrostat::pi<S>;
  std::vector<gyrostat::Vec3<S>> all{{0, 0, 0}, {pi, 0, 0}, {0, pi, 0}, {0, 0, pi}};
  for (const double angle : {1e-30, 1e-8, 1e-7, 1e-4, 1e-3, 1e-1})
    for (int i = 0; i < 4; ++i) all.push_back(S(angle) * direction());
  for (int i = 0; i < 200; ++i) all.push_back(pi * S(std::abs(coordinate(random))) * direction());
  for (const double gap : {1e-1, 1e-4, 1e-8, 1e-12, 0.0})
    for (int i = 0; i < 8; ++i) all.push_back((pi - S(gap)) * direction());
  return all;
}
