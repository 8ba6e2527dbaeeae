// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/turns.hpp"
#include "gyrostat/rotation/quaternion.hpp"

/// Free motions on even grids of times: blocks of points, each wound up from its first.
namespace gyrostat::free {

/// What a block of a grid works on, array by array.
template <Real Scalar>
struct Motion<Scalar>::Block {
  using Row = Scalar[block];
  using Wound = Scalar[block + 8];  // what is wound up eight at once
  Wound up, down;                   // cos and sin of the angle of E, or E and 1/E; of the half angle about axis_
  Wound cosine, sine;               // of the spinor's phase; of the half angle about precession_axis_
  Row sign;                         // -1 an odd number of half periods on (hyperbolic form)
  Row rate[3], momentum[3], attitude[4];
};

template <Real Scalar>
void Motion<Scalar>::fill(Block& b, Scalar first, Scalar step, const detail::Winding<Scalar>& angle,
                          const detail::Winding<Scalar>& phase) const noexcept {
  using std::exp;
  const auto turned = [](Scalar turns) { return math::unit(2 * pi<Scalar> * turns); };
  if (precesses_) {
    const auto x = detail::Fraction<Scalar>::of(rate_, first, {}),
               y = detail::Fraction<Scalar>::of(precession_, first, {});
    angle.wind(turned(x.high + x.low), b.up, b.down, block);
    phase.wind(turned(y.high + y.low), b.cosine, b.sine, block);
    return;
  }
  if (!pair_.hyperbolic) {
    const Place place = place_at(first);
    angle.wind(math::unit(place.exponent), b.up, b.down, block);
    phase.wind(turned(place.turns), b.cosine, b.sine, block);
    return;
  }
  const bool endless = kind_ == Kind::separatrix;
  const Scalar rise = rate_.high * step * span_.high, end = endless ? Scalar(100) : span_.high / 2;
  const detail::Growth<Scalar> up(rise), down(-rise);
  for (int k = 0; k < block;) {  // from one end of a window to the next
    const Place place = place_at(first + step * Scalar(k));
    const Scalar left = (rise < 0 ? place.exponent + end : end - place.exponent) / std::abs(rise);
    const int some = left < Scalar(block - k) ? std::max(1, int(left)) : block - k;
    const Scalar E = exp(place.exponent) * (1 + place.rest);
    up.grow(E, b.up + k, some);
    down.grow(1 / E, b.down + k, some);
    phase.wind(turned(place.turns), b.cosine + k, b.sine + k, some);
    std::fill_n(b.sign + k, some, Scalar(place.odd ? -1 : 1));
    k += some;
  }
}

/// ThetaPair::at for the points from k on that a register holds.
template <Real Scalar>
GYROSTAT_INLINE void Motion<Scalar>::sums(const Block& b, int k, Points (&zeta)[4]) const noexcept {
  using Grid = detail::GridPoints<Scalar>;
  const bool hyperbolic = pair_.hyperbolic, single = pair_.single;
  const Points up = Grid::from(b.up + k), down = Grid::from(b.down + k), none = Grid::all(Scalar(0));
  Points re = up, im = down;  // E^m and E^-m, or its real and imaginary part
  const auto advance = [&]() GYROSTAT_INLINE_LAMBDA {
    if (hyperbolic) {
      re = re * up, im = im * down;
      return;
    }
    const Points r = multiply_add(re, up, none - im * down);
    im = multiply_add(re, down, im * up);
    re = r;
  };
  // sums of odd and even powers: real and imaginary parts
  Points odd_re = none, odd_im = none, even_re = Grid::all(pair_.x[0]), even_im = none;
  for (int m = 1; m <= pair_.powers; m += 2) {
    const Points x = Grid::all(pair_.x[m]), y = Grid::all(pair_.y[m]);
    if (hyperbolic && !single) {
      const bool swapped = m % 4 == 3;
      const Points one = swapped ? im : re, two = swapped ? re : im;
      odd_re = multiply_add(x, one, odd_re), odd_im = multiply_add(y, one, odd_im);
      even_re = multiply_add(none - x, two, even_re), even_im = multiply_add(y, two, even_im);
    } else {
      odd_re = multiply_add(x, hyperbolic ? re - im : re, odd_re);
      odd_im = multiply_add(y, hyperbolic ? re + im : im, odd_im);
    }
    if (m == pair_.powers) break;
    advance();
    if (!hyperbolic || single) {
      const Points x2 = Grid::all(pair_.x[m + 1]), y2 = Grid::all(pair_.y[m + 1]);
      even_re = multiply_add(x2, hyperbolic ? re + im : re, even_re);
      even_im = multiply_add(y2, hyperbolic ? re - im : im, even_im);
    }
    advance();
  }
  if (!hyperbolic) {  // -i times the odd sum
    const Points turned = none - odd_re;
    odd_re = odd_im, odd_im = turned;
  } else {
    const Points sign = Grid::from(b.sign + k);
    if (single) {
      odd_re = sign * odd_re, odd_im = sign * odd_im;
    } else {
      const Points one_re = Grid::choose(sign, none - even_re, odd_re),
                   one_im = Grid::choose(sign, none - even_im, odd_im);
      even_re = Grid::choose(sign, none - odd_re, even_re), even_im = Grid::choose(sign, none - odd_im, even_im);
      odd_re = one_re, odd_im = one_im;
    }
  }
  const bool odd_first = single || hyperbolic;
  zeta[0] = odd_first ? odd_re : even_re, zeta[1] = odd_first ? odd_im : even_im;
  zeta[2] = odd_first ? even_re : odd_re, zeta[3] = odd_first ? even_im : odd_im;
}

/// assemble() for these points.
template <Real Scalar>
GYROSTAT_INLINE void Motion<Scalar>::forms(Block& b, int k, const Points (&zeta)[4],
                                           bool with_momentum) const noexcept {
  using Grid = detail::GridPoints<Scalar>;
  const Points &ar = zeta[0], &ai = zeta[1], &br = zeta[2], &bi = zeta[3];
  const auto product = [](const Points& x, const Points& y, const Points& z, const Points& w)
                           GYROSTAT_INLINE_LAMBDA { return multiply_add(x, y, z * w); };
  const Points f[4] = {product(ar, ar, ai, ai), product(br, br, bi, bi), product(ar, br, ai, bi), ar * bi - ai * br};
  const auto form = [&](Scalar c0, Scalar c1, Scalar c2, Scalar c3) GYROSTAT_INLINE_LAMBDA {
    return multiply_add(Grid::all(c0), f[0],
                        multiply_add(Grid::all(c1), f[1], multiply_add(Grid::all(c2), f[2], Grid::all(c3) * f[3])));
  };
  const auto form_of = [&](const Mat34<Scalar>& A, int i)
                           GYROSTAT_INLINE_LAMBDA { return form(A(i, 0), A(i, 1), A(i, 2), A(i, 3)); };
  const auto combined = [&](const C& one, const C& two, Points& re, Points& im) GYROSTAT_INLINE_LAMBDA {
    re = multiply_add(
        Grid::all(one.re), ar,
        multiply_add(Grid::all(-one.im), ai, multiply_add(Grid::all(two.re), br, Grid::all(-two.im) * bi)));
    im = multiply_add(Grid::all(one.re), ai,
                      multiply_add(Grid::all(one.im), ar, multiply_add(Grid::all(two.re), bi, Grid::all(two.im) * br)));
  };
  // lay_ times the spinor, whose turn is left for the end: q = (up.re, down.im, -down.re, up.im)
  const Points c = Grid::from(b.cosine + k), s = Grid::from(b.sine + k);
  Points up_re, up_im, down_re, down_im;
  combined(spinor_[0][0], spinor_[0][1], up_re, up_im);
  combined(spinor_[1][0], spinor_[1][1], down_re, down_im);
  const Points square = product(up_re, up_re, up_im, up_im) + product(down_re, down_re, down_im, down_im);
  const Points size = form(size_[0], size_[1], size_[2], size_[3]), length = Grid::root(square);
  // one division for both
  const Points both = Grid::all(Scalar(1)) / (size * length), of_size = both * length, of_length = both * size;
  for (int i = 0; i < 3; ++i) store(b.rate[i] + k, form_of(W_, i) * of_size);
  for (int i = 0; with_momentum && i < 3; ++i) store(b.momentum[i] + k, form_of(M_, i) * of_size);
  const Points tc = c * of_length, ts = s * of_length, none = Grid::all(Scalar(0));
  const Points w = product(up_re, tc, none - up_im, ts), z = product(up_re, ts, up_im, tc);
  const Points y = none - product(down_re, tc, none - down_im, ts), x = product(down_re, ts, down_im, tc);
  const auto row = [&](int i, Scalar cw, Scalar cx, Scalar cy, Scalar cz) GYROSTAT_INLINE_LAMBDA {
    store(b.attitude[i] + k,
          multiply_add(Grid::all(cw), w,
                       multiply_add(Grid::all(cx), x, multiply_add(Grid::all(cy), y, Grid::all(cz) * z))));
  };
  const Quat<Scalar>& l = lay_;
  row(0, l.x, l.w, -l.z, l.y);
  row(1, l.y, l.z, l.w, -l.x);
  row(2, l.z, -l.y, l.x, l.w);
  row(3, l.w, -l.x, -l.y, -l.z);
}

/// precession_at() for n points, from the half angles.
template <Real Scalar>
void Motion<Scalar>::precess(Block& b, int n) const noexcept {
  const auto turned = [&](const Vec3<Scalar>& v, Scalar(&to)[3][block]) noexcept {
    const Vec3<Scalar> along = axis_.dot(v) * axis_, across = v - along, beside = cross<Scalar>(axis_, across);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < n; ++k) {
        const Scalar c = b.up[k], s = b.down[k];
        to[i][k] = along[i] + ((c * c - s * s) * across[i] + 2 * c * s * beside[i]);
      }
  };
  turned(initial_.angular_velocity, b.rate);
  turned(initial_.angular_momentum, b.momentum);
  const auto pure = [](const Vec3<Scalar>& v) noexcept { return Quat<Scalar>{Scalar(0), v[0], v[1], v[2]}; };
  const Quat<Scalar>& q = initial_.attitude;
  const Quat<Scalar> back = q * conjugate(pure(axis_)), round = pure(precession_axis_) * q,
                     both = round * conjugate(pure(axis_));
  const Scalar rows[4][4] = {{q.x, back.x, round.x, both.x},
                             {q.y, back.y, round.y, both.y},
                             {q.z, back.z, round.z, both.z},
                             {q.w, back.w, round.w, both.w}};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < n; ++k) {
      const Scalar c = b.up[k], s = b.down[k];
      b.attitude[i][k] =
          b.cosine[k] * (c * rows[i][0] + s * rows[i][1]) + b.sine[k] * (c * rows[i][2] + s * rows[i][3]);
    }
}

template <Real Scalar>
void Motion<Scalar>::grid(Scalar first, Scalar step, std::size_t count, Scalar* angular_velocity, Scalar* attitude,
                          Scalar* angular_momentum) const noexcept {
  const bool special = kind_ == Kind::steady;
  const detail::Winding<Scalar> angle(detail::Fraction<Scalar>::of(rate_, step, {})),
      phase(detail::Fraction<Scalar>::of(precesses_ ? precession_ : phase_rate_, step, {}));
  Block b{};
  for (std::size_t begin = 0; begin < count; begin += block) {
    const int n = static_cast<int>(std::min<std::size_t>(block, count - begin));
    if (precesses_) {
      fill(b, first + step * Scalar(begin), step, angle, phase);
      precess(b, n);
    } else if (!special) {
      fill(b, first + step * Scalar(begin), step, angle, phase);
      for (int k = 0; k < n; k += detail::GridPoints<Scalar>::size) {
        Points zeta[4];
        sums(b, k, zeta);
        forms(b, k, zeta, angular_momentum != nullptr);
      }
    }
    for (int k = 0; special && k < n; ++k) {
      const State<Scalar> s = at(first + step * Scalar(begin + std::size_t(k)));
      for (int i = 0; i < 3; ++i) b.rate[i][k] = s.angular_velocity[i], b.momentum[i][k] = s.angular_momentum[i];
      b.attitude[0][k] = s.attitude.x, b.attitude[1][k] = s.attitude.y, b.attitude[2][k] = s.attitude.z,
      b.attitude[3][k] = s.attitude.w;
    }
    const auto put = [n]<std::size_t width>(Scalar*& to, const Scalar(&rows)[width][block]) {
      if (!to) return;
      for (int k = 0; k < n; ++k, to += width)
        [&]<std::size_t... i>(std::index_sequence<i...>) {
          ((to[i] = rows[i][k]), ...);
        }(std::make_index_sequence<width>());
    };
    put(angular_velocity, b.rate);
    put(attitude, b.attitude);
    put(angular_momentum, b.momentum);
  }
}

}  // namespace gyrostat::free
