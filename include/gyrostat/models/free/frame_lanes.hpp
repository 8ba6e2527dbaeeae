// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iterator>

#include "gyrostat/math/many.hpp"

/// The curve of null vectors and its frame (pencil.hpp, frame.hpp) for as many free gyrostats side by side as a register holds doubles,
/// without branches and with a known number of trips. In trigonometric form only, and where the roots of the pencil keep apart; what does
/// not fit is told, for the caller to do one by one. A principal axis without rotor momentum is given 1e-20 of it, which no rounding shows,
/// so that no axis needs a word of its own.
namespace gyrostat::free::detail {

using math::Choice;
using math::Many;

struct Many4 {
  Many x[4];

  GYROSTAT_INLINE friend Many4 operator+(const Many4& a, const Many4& b) noexcept {
    return {{a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2], a.x[3] + b.x[3]}};
  }
  GYROSTAT_INLINE friend Many4 operator-(const Many4& a, const Many4& b) noexcept {
    return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2], a.x[3] - b.x[3]}};
  }
  GYROSTAT_INLINE friend Many4 operator*(const Many& s, const Many4& a) noexcept {
    return {{s * a.x[0], s * a.x[1], s * a.x[2], s * a.x[3]}};
  }
};

GYROSTAT_INLINE Many dot(const Many4& a, const Many4& b) noexcept {
  return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2] + a.x[3] * b.x[3];
}
GYROSTAT_INLINE Many4 choose(const Choice& c, const Many4& a, const Many4& b) noexcept {
  Many4 r;
  for (int i = 0; i < 4; ++i) r.x[i] = math::choose(c, a.x[i], b.x[i]);
  return r;
}

/// Bodies in principal axes, moments descending: what the set-up begins with.
struct ManyBodies {
  Many moments[3], l[3], G[3], M[3];
};

/// A root of the pencil between two neighbouring inverse moments, and its eigenvector.
struct AxisLanes {
  Many sigma;
  Many4 x;
  Choice found;
};

class PencilLanes {
 public:
  Many a[3], gap01, gap12, gap02;
  Many lambda[3], d[3], b[3], rho, eps, plain, R;
  Choice shifted, rigid;  ///< rigid: no rotor momentum
  Many4 start;

  GYROSTAT_INLINE explicit PencilLanes(const ManyBodies& body) noexcept {
    const Many* J = body.moments;
    for (int i = 0; i < 3; ++i) a[i] = 1 / J[i];
    gap01 = (J[0] - J[1]) * (a[0] * a[1]);
    gap12 = (J[1] - J[2]) * (a[1] * a[2]);
    gap02 = (J[0] - J[2]) * (a[0] * a[2]);
    const Many square = body.M[0] * body.M[0] + body.M[1] * body.M[1] + body.M[2] * body.M[2];
    const Many per_R = math::inverse_sqrt(square);
    R = square * per_R;
    Many n[3], g[3], most = 1;
    for (int i = 0; i < 3; ++i) {
      lambda[i] = body.l[i] * per_R, n[i] = body.M[i] * per_R, g[i] = body.G[i] * per_R;
      most = math::max(most, math::abs(lambda[i]));
    }
    const Many least = 1e-20 * most;
    rigid = math::max(math::max(math::abs(lambda[0]), math::abs(lambda[1])), math::abs(lambda[2])) < least;
    for (int i = 0; i < 3; ++i) lambda[i] = math::choose(math::abs(lambda[i]) < least, least, lambda[i]);
    shifted = g[0] * g[0] + g[1] * g[1] + g[2] * g[2] < 0.99;
    plain = 0., rho = 0., eps = 0.;
    for (int i = 0; i < 3; ++i) {
      plain -= a[i] * n[i] * (n[i] - 2 * lambda[i]);
      rho += g[i] * (g[i] + 2 * lambda[i]);
      eps -= g[i] * (a[i] * g[i]);
      start.x[i] = math::choose(shifted, g[i], n[i]);
      d[i] = math::choose(shifted, lambda[i], 0.);
      b[i] = math::choose(shifted, 0., a[i] * lambda[i]);
    }
    start.x[3] = 1;
    rho = math::choose(shifted, rho, 1.);
    eps = math::choose(shifted, eps, plain);
  }

  /// S x and E x, for products with others.
  GYROSTAT_INLINE Many4 S_of(const Many4& x) const noexcept {
    return {{x.x[0] + d[0] * x.x[3], x.x[1] + d[1] * x.x[3], x.x[2] + d[2] * x.x[3],
             d[0] * x.x[0] + d[1] * x.x[1] + d[2] * x.x[2] - rho * x.x[3]}};
  }
  GYROSTAT_INLINE Many4 E_of(const Many4& x) const noexcept {
    return {{a[0] * x.x[0] - b[0] * x.x[3], a[1] * x.x[1] - b[1] * x.x[3], a[2] * x.x[2] - b[2] * x.x[3],
             eps * x.x[3] - (b[0] * x.x[0] + b[1] * x.x[1] + b[2] * x.x[2])}};
  }
  GYROSTAT_INLINE Many4 timelike() const noexcept {
    const Many g = math::sqrt(start.x[0] * start.x[0] + start.x[1] * start.x[1] + start.x[2] * start.x[2]);
    const Many step = math::choose(shifted & (4 * g < 1.), 3 * g, 1.);
    Many4 x;
    for (int i = 0; i < 3; ++i) x.x[i] = -step * d[i];
    x.x[3] = 1;
    return x;
  }
};

/// The root between a[low] and a[low + 1] that is the nearest to a[1], where the secular equation falls. Times the distances from its poles that is
/// a quartic, here of the distance from one end of the gap, all as parts of the gap.
class RootLanes {
 public:
  GYROSTAT_INLINE RootLanes(const PencilLanes& pencil, int low) noexcept : low_(low) {
    const Many width = low == 0 ? pencil.gap01 : pencil.gap12, beyond = low == 0 ? pencil.gap12 : pencil.gap01;
    const Many per = 1 / width, third = beyond * per, constant = (pencil.a[1] + pencil.plain) * (low == 0 ? -per : per);
    Many g2[3];  // of a[1], of the other end of the gap, of the third
    for (int i = 0; i < 3; ++i) {
      const int of = i == 0 ? 1 : (i == 1) == (low == 0) ? 0 : 2;
      const Many g = pencil.a[of] * pencil.lambda[of] * per;
      g2[i] = g * g;
    }
    const Quartic from_middle(1., third, constant, g2[0], g2[1], g2[2]);

    // from the far end towards a[1]: the change of sign that comes last is kept; where two falls are near a[1], and one another, the far
    // one is not to be taken
    constexpr double distances[] = {0, 1e-5, .01, .05, .13, .25, .4, .65, .9, .999, 1};
    constexpr int last = int(std::size(distances)) - 1;
    Many near = distances[last - 1], far = distances[last], value = from_middle(near), beside = -(third + 1) * g2[1];
    Many here = value;
    for (int j = last - 1; j > 0; --j) {
      const Many next = j > 1 ? from_middle(distances[j - 1]) : third * g2[0];
      const Choice more = here < 0.;
      far = math::choose(more, distances[j], far), near = math::choose(more, distances[j - 1], near);
      beside = math::choose(more, here, beside), value = math::choose(more, next, value);
      here = next;
    }
    const Choice other = near + far > 1.;  // nearer to the other end
    const Many step = (far - near) / (value - beside);
    y_ = math::choose(other, (1 - far) - step * beside, near + step * value);
    lo_ = math::choose(other, 1 - far, near);
    hi_ = math::choose(other, 1 - near, far);
    equation_ = Quartic(math::choose(other, -1., 1.), math::choose(other, third + 1, third),
                        math::choose(other, -1 - constant, constant), math::choose(other, g2[1], g2[0]),
                        math::choose(other, g2[0], g2[1]), g2[2]);
    other_ = other, width_ = width, per_width_ = per;
    found_ = y_ < y_;
  }

  /// A step towards each root that is not found, Householder's with three slopes: what it leaves is of the order of its fourth power.
  GYROSTAT_INLINE void step() noexcept {
    const auto& [side, third, c0, c1, c2, c3] = equation_;
    const Many c4 = -side, y = y_, y2 = y * y;
    // the value and the slopes over 1, 2 and 6
    const Many f = (c0 + c1 * y) + y2 * ((c2 + c3 * y) + c4 * y2);
    const Many f1 = (c1 + 2 * c2 * y) + y2 * (3 * c3 + 4 * c4 * y), f2 = (c2 + 3 * c3 * y) + 6 * c4 * y2,
               f3 = c3 + 4 * c4 * y;
    const Many of_f2 = f * f2, square = f1 * f1 - of_f2;
    const Many next = y - f * square / (f1 * (square - of_f2) + f * f * f3);
    const Choice above = f > 0.;
    lo_ = math::choose(above, y, lo_);
    hi_ = math::choose(above, hi_, y);
    // a step out of the bracket becomes a bisection, unless by rounding only
    const Many little = 1e-9 * y;
    const Choice inside = (lo_ - little < next) & (next < hi_ + little);
    const Many to = math::choose(inside, next, 0.5 * (lo_ + hi_));
    const Choice near = math::abs(to - y) < 5e-6 * y;
    y_ = math::choose(found_, y, to);
    found_ = found_ | near;
  }
  Choice found() const noexcept { return found_; }
  Many from_middle() const noexcept { return width_ * math::choose(other_, 1 - y_, y_); }  ///< its distance from a[1]

  /// Its eigenvector, of any length.
  GYROSTAT_INLINE AxisLanes axis(const PencilLanes& pencil) const noexcept {
    AxisLanes u;
    const int end = low_ == 0 ? 0 : 2;
    const double side = low_ == 0 ? 1 : -1;
    const Many off = side * width_ * y_, rest = 1 - y_;
    u.found = found_;
    u.sigma = math::choose(other_, pencil.a[end] + off, pencil.a[1] - off);
    // a_i - sigma as parts of the gap
    const Many middle = math::choose(other_, rest, y_), of_end = math::choose(other_, y_, rest),
               third = equation_.third + equation_.side * y_;
    const Many product[3] = {of_end * third, -middle * third, middle * of_end};
    const int at[3] = {1, end, 2 - end};
    for (int i = 0; i < 3; ++i) {
      const int n = at[i];
      u.x.x[n] = math::choose(pencil.shifted, u.sigma, pencil.a[n]) * pencil.lambda[n] * (per_width_ * product[i]);
    }
    u.x.x[3] = side * middle * product[0];
    return u;
  }

 private:
  /// (third + side y) (y (1 - y) (constant + y) + (1 - y) near - y next) + side y (1 - y) far, falling from y = 0: with side 1 from a[1], the third
  /// pole behind it; with side -1 from the other end.
  struct Quartic {
    Many side, third, c0, c1, c2, c3;  ///< the last coefficient is -side

    Quartic() = default;
    GYROSTAT_INLINE Quartic(const Many& side_of_third, const Many& third_pole, const Many& constant, const Many& near,
                            const Many& next, const Many& far) noexcept
        : side(side_of_third), third(third_pole) {
      const Many first = constant - near - next, second = 1 - constant;
      c0 = third * near;
      c1 = third * first + side * (near + far);
      c2 = third * second + side * (first - far);
      c3 = side * second - third;
    }
    GYROSTAT_INLINE Many operator()(const Many& y) const noexcept {
      return c0 + y * (c1 + y * (c2 + y * (c3 - y * side)));
    }
  };

  int low_;
  Choice other_, found_;
  Quartic equation_;
  Many width_, per_width_, lo_, hi_, y_;
};

/// The plane that two spacelike eigenvectors leave, by its null directions (NullPlane).
struct PlaneLanes {
  AxisLanes u, v;
  Many split;  ///< sigma_v - sigma_u
  Many4 plus, minus;
  Many E_plus, E_minus, al, be, Yu, Yv, from_u, from_v;
  Many turned;     ///< its sign is that of the determinant of u, v, plus + minus, plus - minus
  Choice decided;  ///< rounding does not decide of which signs E_plus and E_minus are

  GYROSTAT_INLINE explicit PlaneLanes(const PencilLanes& pencil) noexcept {
    const unsigned rigid = pencil.rigid.bits();
    if (rigid == 0) by_roots(pencil);
    else if (rigid == math::all_numbers) by_components(pencil);
    else mix(pencil);
  }

 private:
  PlaneLanes() = default;

  GYROSTAT_NOINLINE void mix(const PencilLanes& pencil) noexcept {
    by_roots(pencil);
    PlaneLanes other;
    other.by_components(pencil);
    const Choice rigid = pencil.rigid;
    const auto take = [&](auto member) { this->*member = choose(rigid, other.*member, this->*member); };
    for (const auto axis : {&PlaneLanes::u, &PlaneLanes::v}) {
      AxisLanes& to = this->*axis;
      const AxisLanes& from = other.*axis;
      to.sigma = math::choose(rigid, from.sigma, to.sigma);
      to.x = choose(rigid, from.x, to.x);
      to.found = to.found | rigid;
    }
    for (const auto member : {&PlaneLanes::plus, &PlaneLanes::minus}) take(member);
    for (const auto member :
         {&PlaneLanes::split, &PlaneLanes::E_plus, &PlaneLanes::E_minus, &PlaneLanes::al, &PlaneLanes::be,
          &PlaneLanes::Yu, &PlaneLanes::Yv, &PlaneLanes::from_u, &PlaneLanes::from_v, &PlaneLanes::turned})
      take(member);
    decided = decided | rigid;
  }

  // compiled once each, so that a lane has the same bits whatever stands beside it
  GYROSTAT_NOINLINE void by_roots(const PencilLanes& pencil) noexcept {
    RootLanes first(pencil, 0), second(pencil, 1);
    for (int trip = 0; trip < 12; ++trip) {
      first.step();
      second.step();
      if ((first.found() & second.found()).bits() == math::all_numbers) break;
    }
    u = first.axis(pencil);
    v = second.axis(pencil);
    split = first.from_middle() + second.from_middle();
    // of vectors of any length, so that nothing waits for the roots that make it 1
    const Many4 Su = pencil.S_of(u.x), Sv = pencil.S_of(v.x), &X = pencil.start, T = pencil.timelike();
    const Many per_v = 1 / v.sigma;
    const Many4 of_u = choose(pencil.shifted, (1 / u.sigma) * pencil.E_of(u.x), Su),
                of_v = choose(pencil.shifted, per_v * pencil.E_of(v.x), Sv);
    const Many uu = math::abs(dot(Su, u.x)), vv = math::abs(dot(Sv, v.x)), per_uu = 1 / uu, per_vv = 1 / vv;
    const Many along = per_uu * dot(of_u, v.x), of_along = along * math::choose(pencil.shifted, u.sigma * per_v, 1.);
    v.x = v.x - along * u.x;
    const Many uX = dot(of_u, X), uT = dot(of_u, T);
    const Many vX = dot(of_v, X) - of_along * uX, vT = dot(of_v, T) - of_along * uT;
    const Many4 W = X - per_uu * uX * u.x - per_vv * vX * v.x, V = T - per_uu * uT * u.x - per_vv * vT * v.x;
    const Many u_length = math::inverse_sqrt(uu), v_length = math::inverse_sqrt(vv);
    Yu = u_length * uX;
    Yv = v_length * vX;
    const Many4 SV = pencil.S_of(V);
    const Many VV = -dot(SV, V), VW = -dot(SV, W), length = math::inverse_sqrt(VV), s = length * VW;
    const Many ratio = VW / VV;
    Many4 e = W - ratio * V;
    const Many square = dot(pencil.S_of(e), e);
    const Choice near = 4 * square > s * s;
    const Many4 cross = minors(V);
    e = choose(near, e, across(pencil, cross));
    Many e_length = math::choose(near, math::inverse_sqrt(square), u_length * v_length * length);
    Many D = math::choose(near, square, dot(cross, W)) * e_length;
    e_length = math::choose(D < 0., -e_length, e_length);
    D = math::abs(D);
    turned = dot(cross, e) * e_length;
    // E - sigma_u S, in which what errors leave along u does not count
    const auto part = [&](const Many4& x) GYROSTAT_INLINE_LAMBDA { return pencil.E_of(x) - u.sigma * pencil.S_of(x); };
    const Many4 of_V = part(V), of_e = part(e);
    al = 0.5 * (s + D);
    be = (Yu * Yu + Yv * Yv) / (4 * al);
    const Many tau = -2 * be, of_VV = length * length * dot(of_V, V), of_ee = e_length * e_length * dot(of_e, e),
               twice_Ve = 2 * length * e_length * dot(of_V, e);
    E_minus = 0.5 * (of_VV - twice_Ve + of_ee);
    // of `near` E_plus by that of the start, which is 0
    const Many one = -split * Yv * Yv, two = 2 * tau * length * dot(of_V, W), three = tau * tau * of_VV;
    const Many per_start = 1 / (2 * D * D);
    E_plus = math::choose(near, per_start * (one + two + three), 0.5 * (of_VV + twice_Ve + of_ee));
    const Many terms = math::abs(of_VV) + math::abs(twice_Ve) + math::abs(of_ee),
               terms_of_start = per_start * (math::abs(one) + math::abs(two) + math::abs(three));
    decided =
        (math::abs(E_minus) > 1e-13 * terms) & (math::abs(E_plus) > 1e-13 * math::choose(near, terms_of_start, terms));
    from_u = 0.5 * (of_ee - of_VV);
    from_v = from_u - split;
    u.x = u_length * u.x, v.x = v_length * v.x;
    const Many4 timelike = length * V, spacelike = e_length * e;
    plus = timelike + spacelike;
    minus = timelike - spacelike;
  }

  /// Of rigid lanes, whose eigenvectors are the principal axes: all is told by the components of M (docs/free.md, section 2).
  GYROSTAT_NOINLINE void by_components(const PencilLanes& pencil) noexcept {
    const Many* n = pencil.start.x;
    const Many* a = pencil.a;
    const Many n0 = n[0] * n[0], n1 = n[1] * n[1], n2 = n[2] * n[2];
    const Many rise = pencil.gap01 * n0 - pencil.gap12 * n2;
    const Choice lowest = rise > 0.;  // the lobe's axis is that of a[0], else that of a[2]
    const auto either = [lowest](const Many& x, const Many& y)
                            GYROSTAT_INLINE_LAMBDA { return math::choose(lowest, x, y); };
    const Many one = either(1., 0.), other = either(0., 1.), none = 0., m = either(n[0], n[2]);
    u.sigma = either(a[1], a[0]), u.x = {{other, one, none, none}};
    v.sigma = either(a[2], a[1]), v.x = {{none, other, one, none}};
    u.found = v.found = decided = Many(0.) < 1.;
    split = either(pencil.gap12, pencil.gap01);
    Yu = either(n[1], n[0]), Yv = either(n[2], n[1]);
    const Many half = 0.5 * (either(pencil.gap01, pencil.gap12) * n1 + pencil.gap02 * either(n2, n0));
    const Many near = math::abs(rise) + half;
    E_plus = E_minus = half;
    from_u = either(-near, near + split), from_v = either(-near - split, near);
    const Many side = math::choose(m < 0., -1., 1.);
    const Many4 e{{side * one, none, side * other, none}}, V{{none, none, none, 1.}};
    plus = V + e, minus = V - e;
    turned = -side;
    const Many sum = 1 + math::abs(m);
    al = 0.5 * sum;
    be = (n1 + either(n2, n0)) / (2 * sum);
  }

  /// Of u, v and V: what times a fourth is the determinant of the four.
  GYROSTAT_INLINE Many4 minors(const Many4& V) const noexcept {
    const Many *a = u.x.x, *b = v.x.x, *c = V.x;
    const auto subdeterminant = [a, b](int i, int j) GYROSTAT_INLINE_LAMBDA { return a[i] * b[j] - a[j] * b[i]; };
    const Many m01 = subdeterminant(0, 1), m02 = subdeterminant(0, 2), m03 = subdeterminant(0, 3),
               m12 = subdeterminant(1, 2), m13 = subdeterminant(1, 3), m23 = subdeterminant(2, 3);
    return {{m13 * c[2] - m12 * c[3] - m23 * c[1], m02 * c[3] - m03 * c[2] + m23 * c[0],
             m03 * c[1] - m01 * c[3] - m13 * c[0], m01 * c[2] - m02 * c[1] + m12 * c[0]}};
  }
  /// The vector across them, of square 1: S has the inverse {{1 - d d', d}, {d', -1}}, because rho + d^2 = 1.
  GYROSTAT_INLINE static Many4 across(const PencilLanes& pencil, const Many4& minors) noexcept {
    const Many* y = minors.x;
    Many4 e;
    e.x[3] = pencil.d[0] * y[0] + pencil.d[1] * y[1] + pencil.d[2] * y[2] - y[3];
    for (int i = 0; i < 3; ++i) e.x[i] = y[i] - pencil.d[i] * e.x[3];
    return e;
  }
};

/// SpinorFrame of PathForm::lobe and PathForm::single.
struct FrameLanes {
  Choice single, sound;  ///< sound: of trigonometric form, and nothing went wrong
  Many side, delta;      ///< side: of two components, 1 about the axis of the largest moment, else -1
  Many4 plus, minus, xa, xb;
  Many k2, kp2, rate, start;      ///< start: its argument, as a part of 4 K
  math::ManyIntegrals integrals;  ///< K, K' and, as F', eta
  Many size[2], psi[2];

  GYROSTAT_INLINE explicit FrameLanes(const PencilLanes& pencil) noexcept;

 private:
  /// What one of the two forms has of its own; sn, cn: of the start, but for a positive factor of each.
  struct Form {
    Many4 plus, minus, x1, x2;
    Many k2, kp2, rate, sn, cn, psi[2], size[2];
    Many cotangent[2];  ///< of the amplitudes of the start and of eta
    Many turned;        ///< its sign is that of the determinant of x1, x2, plus - minus, plus + minus
    Choice sound;
  };
  /// The null directions, of equal |E|; inverse: of the root of E_plus E_minus.
  struct NullPair {
    Many4 plus, minus;
    Many al, be;

    GYROSTAT_INLINE NullPair(const PlaneLanes& p, const Many& inverse) noexcept {
      const Many square = math::abs(p.E_minus) * inverse, lower = math::inverse_sqrt(square), boost = square * lower;
      plus = boost * p.plus, minus = lower * p.minus;
      al = lower * p.al, be = boost * p.be;
    }
  };
  GYROSTAT_INLINE static void set_pair(Form& f, const NullPair& pair, const Choice& swapped,
                                       const Many& turned) noexcept {
    f.plus = choose(swapped, pair.minus, pair.plus);
    f.minus = choose(swapped, pair.plus, pair.minus);
    f.turned = math::choose(swapped, turned, -turned);
  }
  // compiled once each, so that a lane has the same bits whether the other form is there beside it or not
  GYROSTAT_NOINLINE inline Form lobe(const PlaneLanes& p) noexcept;
  GYROSTAT_NOINLINE static inline Form alone(const PlaneLanes& p) noexcept;
  static constexpr double least_k2 = 1e-16;
};

FrameLanes::Form FrameLanes::lobe(const PlaneLanes& p) noexcept {
  Form f;
  const Choice first = p.from_u < 0.;  // u is x1
  side = math::choose(first, 1., -1.);
  f.x1 = choose(first, p.u.x, p.v.x);
  f.x2 = choose(first, p.v.x, p.u.x);
  const Many Y1 = math::choose(first, p.Yu, p.Yv), Y2 = math::choose(first, p.Yv, p.Yu);
  const Many to_u = math::abs(p.from_u), to_v = math::abs(p.from_v);
  const Many product = math::abs(p.E_plus * p.E_minus), inverse = math::inverse_sqrt(product),
             nu = 2 * (product * inverse);
  const Many p2 = math::choose(first, to_u, to_v) - 0.5 * nu, p3 = math::choose(first, to_v, to_u) - 0.5 * nu;
  const Many whole = (p2 + nu) * p3, of_rate = math::inverse_sqrt(whole), of_whole = of_rate * of_rate;
  f.k2 = p.split * nu * of_whole;
  f.kp2 = p2 * (p3 + nu) * of_whole;
  f.rate = whole * of_rate;
  f.sound = (p.from_u * p.from_v > 0.) & (f.kp2 > 0.0295) & (f.k2 > least_k2);
  const Many far = 1 / (nu + p3), near = p3 * of_whole, c1 = math::sqrt(p3 * far);
  f.cotangent[1] = math::sqrt(p.split * near);
  const NullPair pair(p, inverse);
  const Choice swapped = pair.al < pair.be;
  set_pair(f, pair, swapped, p.turned);
  f.turned = math::choose(first, f.turned, -f.turned);
  f.sn = Y1, f.cn = Y2;
  f.cotangent[0] = math::abs(Y2 / Y1) * math::sqrt(near * (nu + p3));
  const Many st = math::choose(first, p.u.sigma, p.v.sigma) - side * p2, s0 = st - side * nu;
  f.psi[0] = 0.5 * (st + c1 * s0) / (1 + c1);
  f.psi[1] = 0.5 * (s0 + side * (p3 + nu) * (1 + c1));
  f.size[0] = f.size[1] = 1;
  return f;
}

FrameLanes::Form FrameLanes::alone(const PlaneLanes& p) noexcept {
  Form f;
  const Many square = -p.E_plus * p.E_minus, inverse = math::inverse_sqrt(square), B = square * inverse;
  const NullPair pair(p, inverse);
  const Choice swapped = p.E_plus < 0.;
  set_pair(f, pair, swapped, p.turned);
  f.x1 = p.u.x, f.x2 = p.v.x;
  const Many width = p.split, rho_square = p.from_u * p.from_u + square, rho_inverse = math::inverse_sqrt(rho_square),
             rho = rho_square * rho_inverse;
  f.rate = math::sqrt(rho * math::sqrt(p.from_v * p.from_v + square));
  // of trigonometric form where reach <= 0
  const Many reach = (-p.from_u * p.from_v - square) * inverse, root = math::sqrt(width * width + reach * reach);
  const Many sum = root + math::abs(reach), per_both = 1 / (root * sum), per_sum = per_both * root;
  f.k2 = 0.5 * (width * width) * per_both;
  f.kp2 = 1 - f.k2;
  f.sound = (reach < 0.) & (f.k2 > least_k2);
  const Many xc2 = per_sum * width, side_square = per_sum * rho, side_inverse = math::inverse_sqrt(side_square);
  const Many cosine = p.from_u * rho_inverse, sine = B * rho_inverse;
  const Many half = 0.5 * (1 + math::abs(cosine)), half_inverse = math::inverse_sqrt(half);
  const Many larger = half * half_inverse, other = 0.5 * (sine * half_inverse);
  const Choice acute = cosine > 0.;
  const Many cg = math::choose(acute, larger, other), sg = math::choose(acute, other, larger);
  const Many l = 1 / (math::choose(swapped, sg, cg) * pair.al + math::choose(swapped, cg, sg) * pair.be);
  f.sn = p.Yu, f.cn = p.Yv;
  const Many cn = 0.5 * (p.Yv * side_inverse), cn_start = cn * l;
  f.cotangent[0] = math::abs(cn / p.Yu) * math::sqrt(2 * sine * (xc2 * xc2 + 1) * (f.kp2 + f.k2 * cn_start * cn_start));
  const Many bez = sg + cg * xc2, per_bez = 1 / bez, per_alz = bez * (side_inverse * side_inverse);
  const Many moduli = f.k2 * math::inverse_sqrt(f.k2 * f.kp2);  // k/k'
  f.cotangent[1] = math::sqrt(sg * per_alz * moduli);
  f.size[0] = side_square * per_bez, f.size[1] = bez;
  const Many m = p.u.sigma + p.from_u;
  f.psi[0] = 0.5 * (m + B * bez * per_alz);
  f.psi[1] = 0.5 * (m - B * f.size[0] * per_bez);
  return f;
}

GYROSTAT_INLINE FrameLanes::FrameLanes(const PencilLanes& pencil) noexcept {
  const PlaneLanes p(pencil);
  single = p.E_plus * p.E_minus < 0.;
  const unsigned some = single.bits();
  side = 1;
  Form f = some == math::all_numbers ? alone(p) : lobe(p);
  if (some == math::all_numbers) f.sound = single & f.sound;
  if (some != 0 && some != math::all_numbers) {
    const Form g = alone(p);
    const auto take = [&](auto member) GYROSTAT_INLINE_LAMBDA { f.*member = choose(single, g.*member, f.*member); };
    take(&Form::plus), take(&Form::minus), take(&Form::x1), take(&Form::x2);
    take(&Form::k2), take(&Form::kp2), take(&Form::rate), take(&Form::sn), take(&Form::cn);
    take(&Form::turned);
    for (int i = 0; i < 2; ++i) {
      f.cotangent[i] = math::choose(single, g.cotangent[i], f.cotangent[i]);
      f.psi[i] = math::choose(single, g.psi[i], f.psi[i]);
      f.size[i] = math::choose(single, g.size[i], f.size[i]);
    }
    f.sound = (single & g.sound) | ((p.E_plus * p.E_minus > 0.) & f.sound);
  }
  sound = f.sound & p.decided & p.u.found & p.v.found & (pencil.gap01 > 1e-12 * pencil.a[2]) &
          (pencil.gap12 > 1e-12 * pencil.a[2]) & (pencil.a[0] > 1e-60) & (pencil.a[2] < 1e60);
  const Many back = math::choose(f.cn < 0., -1., 1.);
  delta = math::choose(single, -1., -side);
  // delta det(x1, x2, plus - minus, plus + minus) > 0, without delta where there is one component
  const Many of_x2 = math::choose(single, back, delta * back);
  const Many of_x1 = math::choose(of_x2 * f.turned < 0., -1., 1.);
  plus = f.plus, minus = f.minus;
  xa = of_x1 * f.x1;
  xb = of_x2 * f.x2;
  k2 = f.k2, kp2 = f.kp2, rate = f.rate;
  integrals = math::first_kind(k2, kp2, f.cotangent[0], f.cotangent[1]);
  start = math::choose(of_x1 * f.sn < 0., -integrals.F_part, integrals.F_part);
  for (int i = 0; i < 2; ++i) psi[i] = f.psi[i], size[i] = f.size[i];
}

}  // namespace gyrostat::free::detail
