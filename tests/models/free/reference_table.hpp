// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/free/problem.hpp"

/// tests/data/free_motion.csv, written by free_tables.py.
namespace free_reference {

using Wide = gyrostat::DoubleDouble;

struct Rotor {
  gyrostat::Vec3<double> axis;
  double axial_inertia, rate;
  bool free;
};

struct Moment {
  double t;
  gyrostat::Vec3<Wide> angular_velocity, angular_momentum;
  gyrostat::Quat<Wide> attitude;
  std::vector<Wide> rotor_rate, rotor_angle;
};

struct Case {
  std::string id;
  gyrostat::free::Problem<double> problem;  ///< rotors not in it
  std::vector<Rotor> rotors;
  Wide period, turn_per_period;
  double rate_ulp, attitude_ulp;
  std::vector<Moment> at;
};

/// All digits of a decimal number.
inline Wide number(const std::string& text) {
  if (text == "nan") return gyrostat::nan<double>;
  Wide value = 0;
  int places = 0;
  bool point = false;
  std::size_t i = text[0] == '-' ? 1 : 0;
  for (; i < text.size() && text[i] != 'e'; ++i) {
    if (text[i] == '.') {
      point = true;
      continue;
    }
    value = value * 10 + (text[i] - '0');
    places += point;
  }
  const int exponent = (i < text.size() ? std::atoi(text.c_str() + i + 1) : 0) - places;
  Wide power = 1;
  for (int k = 0; k < std::abs(exponent); ++k) power *= 10;
  value = exponent < 0 ? value / power : value * power;
  return text[0] == '-' ? -value : value;
}

inline std::vector<Case> read() {
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/free_motion.csv");
  REQUIRE(file.good());
  std::vector<Case> cases;
  std::string line;
  while (std::getline(file, line)) {
    if (line[0] == '#') continue;
    std::istringstream cells(line);
    std::string kind, cell;
    std::getline(cells, kind, ',');
    const auto text = [&] { return std::getline(cells, cell, ','), cell; };
    const auto plain = [&] { return std::strtod(text().c_str(), nullptr); };
    const auto wide = [&] { return number(text()); };
    if (kind == "case") {
      Case c;
      c.id = text();
      auto& J = c.problem.inertia;
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) J(i, j) = J(j, i) = plain();
      for (int i = 0; i < 3; ++i) c.problem.rotor_momentum[i] = plain();
      for (int i = 0; i < 3; ++i) c.problem.angular_velocity[i] = plain();
      auto& q = c.problem.attitude;
      for (double* x : {&q.x, &q.y, &q.z, &q.w}) *x = plain();
      c.period = wide();
      c.turn_per_period = wide();
      c.rate_ulp = plain();
      c.attitude_ulp = plain();
      cases.push_back(c);
    } else if (kind == "rotor") {
      Rotor r;
      for (int i = 0; i < 3; ++i) r.axis[i] = plain();
      r.axial_inertia = plain();
      r.rate = plain();
      r.free = plain() == 1;
      cases.back().rotors.push_back(r);
    } else {
      Moment m;
      m.t = plain();
      for (int i = 0; i < 3; ++i) m.angular_velocity[i] = wide();
      for (Wide* x : {&m.attitude.x, &m.attitude.y, &m.attitude.z, &m.attitude.w}) *x = wide();
      for (int i = 0; i < 3; ++i) m.angular_momentum[i] = wide();
      for (std::size_t i = 0; i < cases.back().rotors.size(); ++i) m.rotor_rate.push_back(wide());
      for (std::size_t i = 0; i < cases.back().rotors.size(); ++i) m.rotor_angle.push_back(wide());
      cases.back().at.push_back(m);
    }
  }
  REQUIRE(cases.size() == 16);
  return cases;
}

}  // namespace free_reference
