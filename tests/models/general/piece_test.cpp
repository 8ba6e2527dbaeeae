// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/piece.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "scenes.hpp"

namespace general_piece_test {

using namespace gyrostat;
using namespace gyrostat::general;

/// action(piece) for all pieces.
template <class Action>
void for_pieces(const Problem<double>& p, double span, const Action& action) {
  const auto wheels = Wheels<double>::of(p);
  const auto torques = Collected<double>::of(p, span);
  auto cuts = breakpoints(p, span);
  cuts.push_back(span);
  auto here = Piece<double>::first(p, wheels, torques, cuts[0]);
  action(here, wheels);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    here = Piece<double>::behind(here, p, wheels, torques, cuts[i]);
    action(here, wheels);
  }
}

TEST_CASE("powers of time and waves of a piece are the torques", "[general]") {
  general_scenes::Scenes source(41);
  for (int i = 0; i < 100; ++i) {
    auto made = source.next(2);
    auto& p = made.problem;
    // of each torque what is constant in the body
    for (auto& torque : p.torques)
      if (torque.type != TorqueType::table) torque.type = TorqueType::constant, torque.axes = Axes::body;
      else torque.axes = Axes::body;
    for_pieces(p, made.span, [&](const Piece<double>& piece, const Wheels<double>&) {
      for (const double share : {0.1, 0.9}) {
        const double t = piece.from + share * (piece.to - piece.from), s = t - piece.from;
        Vec3<double> sum(0, 0, 0);
        double size = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          sum += std::pow(s, double(k)) * piece.power[k].body;
          size += (std::pow(s, double(k)) * piece.power[k].body).norm();
        }
        for (const auto& wave : piece.waves) {
          const Vec3<double> one = wave.cubic(t) * std::sin(wave.rate * t + wave.phase) * wave.terms.body;
          sum += one, size += one.norm();
        }
        const Vec3<double> wanted = load_at(p, Pose<double>{}, t, t).torque;
        CAPTURE(i, t);
        CHECK((sum - wanted).norm() <= 1e-12 * size);
      }
    });
  }
}

TEST_CASE("what is known of wheels goes on from piece to piece", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 2.5).asDiagonal();
  p.wheels.resize(2);
  p.wheels[0].type = WheelType::torque, p.wheels[0].axial_inertia = 0.1, p.wheels[0].torque = 0.3;
  p.wheels[0].table = {{1, 2, 4}, {1, -1, 3}, Between::cubic, false};
  p.wheels[1].type = WheelType::held, p.wheels[1].axial_inertia = 0.2, p.wheels[1].axis = {1, 0, 0};
  p.wheels[1].table = {{0, 3, 5}, {10, 20, 0}, Between::linear, true};
  double momentum = 0, angle = 0, held = 0, last = 0;
  for_pieces(p, 7., [&](const Piece<double>& piece, const Wheels<double>& wheels) {
    CHECK(piece.from == last);
    last = piece.to;
    CHECK(piece.wheels[0].at(0) == Approx(momentum).margin(1e-15));
    CHECK(piece.wheels[0].integral == Approx(angle).margin(1e-15));
    CHECK(piece.wheels[1].integral == Approx(held).margin(1e-15));
    const Vec3<double> all = piece.momentum_at(piece.from);
    CHECK(all[2] == Approx(momentum).margin(1e-15));
    CHECK(all[0] == Approx(0.2 * general::piece(p.wheels[1].table, 1, 0, piece.from)(piece.from)));
    // by the midpoint rule
    const int parts = 4000;
    for (int i = 0; i < parts; ++i) {
      const double h = (piece.to - piece.from) / parts, t = piece.from + (i + 0.5) * h;
      angle += h * (momentum + h / 2 * 0.3) / 0.1;
      const double push = wheels.laws[0].torque + general::piece(p.wheels[0].table, 1, 0, t)(t);
      angle += h * h / 2 * (push - 0.3) / 0.1;
      momentum += h * push;
      held += h * general::piece(p.wheels[1].table, 1, 0, t)(t);
    }
    CHECK(piece.wheels[0].at(piece.to - piece.from) == Approx(momentum).epsilon(1e-6));
    momentum = piece.wheels[0].at(piece.to - piece.from);
    const double exact = piece.wheels[0].integral + piece.wheels[0].gained(piece.to - piece.from) / 0.1;
    CHECK(exact == Approx(angle).epsilon(1e-6));
    angle = exact;
    const double turned = piece.wheels[1].integral + piece.wheels[1].gained(piece.to - piece.from) / 0.2;
    CHECK(turned == Approx(held).epsilon(1e-6));
    held = turned;
  });
  CHECK(last == 7);
}

TEST_CASE("the angle of a wheel adds up over many pieces without rounding more than once", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 2.5).asDiagonal();
  p.wheels.resize(1);
  auto& wheel = p.wheels[0];
  wheel.type = WheelType::held, wheel.axial_inertia = 1, wheel.axis = {1, 0, 0};
  wheel.table = {{0}, {0.7}, Between::linear, true};
  auto& torque = p.torques.emplace_back();
  torque.vector = {1, 0, 0};
  for (int i = 0; i < 200; ++i) torque.factor.on.push_back({100 + 0.1 * i, 100 + 0.1 * (i + 0.5)});
  int pieces = 0;
  for_pieces(p, 130., [&](const Piece<double>& piece, const Wheels<double>&) {
    ++pieces;
    const long double exact = static_cast<long double>(0.7) * piece.from;
    const auto& mine = piece.wheels[0];
    CHECK(std::abs(double(mine.integral + static_cast<long double>(mine.lost) - exact)) <= 1e-16 * (1 + double(exact)));
  });
  CHECK(pieces > 400);
}

TEST_CASE("the momentum of a driven wheel adds up over many pieces without rounding more than once", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 2.5).asDiagonal();
  p.wheels.resize(1);
  auto& wheel = p.wheels[0];
  wheel.type = WheelType::torque, wheel.axial_inertia = 0.1, wheel.axis = {1, 0, 0}, wheel.torque = 0.0123;
  auto& torque = p.torques.emplace_back();
  torque.vector = {1, 0, 0};
  for (int i = 0; i < 400; ++i) torque.factor.on.push_back({double(i), i + 0.1});
  int pieces = 0;
  for_pieces(p, 400., [&](const Piece<double>& piece, const Wheels<double>&) {
    ++pieces;
    const long double exact = static_cast<long double>(0.0123) * piece.from;
    const auto& mine = piece.wheels[0];
    CHECK(std::abs(double(mine.c[0] - exact)) <= 1.2e-16 * double(exact));
    CHECK(std::abs(double(mine.c[0] + static_cast<long double>(mine.start_lost) - exact)) <= 1e-18);
  });
  CHECK(pieces >= 800);
}

}  // namespace general_piece_test
