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
    R = math::sqrt(body.M[0] * body.M[0] + body.M[1] * body.M[1] + body.M[2] * body.M[2]);
    const Many per_R = 1 / R;
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

/// The root between a[low] and a[low + 1] that is the nearest to a[1], where the secular equation falls. Times its poles it is a polynomial, here of
/// the distance y from one end of the gap, as parts of the gap.
class RootLanes {
 public:
  GYROSTAT_INLINE RootLanes(const PencilLanes& pencil, int low) noexcept : low_(low) {
    const Many width = low == 0 ? pencil.gap01 : pencil.gap12, beyond = low == 0 ? pencil.gap12 : pencil.gap01;
    const Many per = 1 / width, side = low == 0 ? -per : per;
    Many g2[3];  // of a[1], of the other end of the gap, of the third
    for (int i = 0; i < 3; ++i) {
      const int of = i == 0 ? 1 : (i == 1) == (low == 0) ? 0 : 2;
      const Many g = pencil.a[of] * pencil.lambda[of] * per;
      g2[i] = g * g;
    }
    const Many constant = (pencil.a[1] + pencil.plain) * side, third = beyond * per;
    const Quartic from_middle(1., third, constant, g2[0], g2[1], g2[2]);

    // from the far end towards a[1]: the change of sign that comes last is kept; where two falls are near a[1], and one another, the far
    // one is not to be taken
    constexpr double distances[] = {0, 1e-5, .01, .05, .13, .25, .4, .65, .9, .999, 1};
    constexpr int last = int(std::size(distances)) - 1;
    Many near, far = distances[last], here, value, beside = -(third + 1) * g2[1];
    near = distances[last - 1], here = value = from_middle(near);
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
    upper_ = low == 0 ? near + far < 1. : other;
    found_ = y_ < y_;
    const Many shift = math::choose(upper_, width, 0.);
    shift_ = shift;
    next_ = math::choose(upper_, -width, width);
    far_ = (low == 0 ? pencil.gap02 : -pencil.gap01) - shift;
    origin_ = math::choose(upper_, pencil.a[low + 1], pencil.a[low]);
  }

  /// A step towards each root that is not found: Householder's of the fourth order.
  GYROSTAT_INLINE void step() noexcept {
    const auto [c0, c1, c2, c3, c4] = equation_;
    const Many y = y_, y2 = y * y;
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
  Many offset() const noexcept { return y_ * next_; }  ///< from the pole that it is the nearer to
  Choice upper() const noexcept { return upper_; }     ///< that is the upper of the two

  GYROSTAT_INLINE AxisLanes axis(const PencilLanes& pencil) const noexcept {
    AxisLanes u;
    const Many x = offset();
    u.found = found_;
    u.sigma = origin_ + x;
    Many distance[3];  // a_i - sigma
    distance[low_] = -shift_ - x;
    distance[low_ + 1] = math::choose(upper_, 0., next_) - x;
    distance[low_ == 0 ? 2 : 0] = far_ - x;
    const Many low = distance[0] * distance[1], per_all = 1 / (low * distance[2]), per_low = per_all * distance[2];
    const Many per[3] = {per_low * distance[1], per_low * distance[0], per_all * low};
    for (int i = 0; i < 3; ++i)
      u.x.x[i] = math::choose(pencil.shifted, u.sigma, pencil.a[i]) * pencil.lambda[i] * per[i];
    u.x.x[3] = 1;
    u.x = math::inverse_sqrt(math::abs(dot(pencil.S_of(u.x), u.x))) * u.x;
    return u;
  }

 private:
  /// (third + side y) (y (1 - y) (constant + y) + (1 - y) near - y next) + side y (1 - y) far, falling from y = 0.
  struct Quartic {
    Many c0, c1, c2, c3, c4;

    Quartic() = default;
    GYROSTAT_INLINE Quartic(const Many& side, const Many& third, const Many& constant, const Many& near,
                            const Many& next, const Many& far) noexcept {
      const Many first = constant - near - next, second = 1 - constant;
      c0 = third * near;
      c1 = third * first + side * (near + far);
      c2 = third * second + side * (first - far);
      c3 = side * second - third;
      c4 = -side;
    }
    GYROSTAT_INLINE Many operator()(const Many& y) const noexcept {
      return c0 + y * (c1 + y * (c2 + y * (c3 + y * c4)));
    }
  };

  int low_;
  Choice upper_, found_;
  Quartic equation_;
  Many shift_, next_, far_, origin_, lo_, hi_, y_;
};

/// The plane that two spacelike eigenvectors leave, by its null directions (NullPlane).
struct PlaneLanes {
  AxisLanes u, v;
  Many split;  ///< sigma_v - sigma_u
  Many4 plus, minus;
  Many E_plus, E_minus, al, be, Yu, Yv, from_u, from_v;
  Many turned;  ///< its sign is that of the determinant of u, v, plus + minus, plus - minus

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
    split = math::choose(first.upper(), 0., pencil.gap01) + math::choose(second.upper(), pencil.gap12, 0.) +
            (second.offset() - first.offset());
    const auto covector = [&pencil](const AxisLanes& w) GYROSTAT_INLINE_LAMBDA {
      return choose(pencil.shifted, (1 / w.sigma) * pencil.E_of(w.x), pencil.S_of(w.x));
    };
    const Many4 of_u = covector(u);
    v.x = v.x - dot(of_u, v.x) * u.x;
    const Many4 of_v = covector(v), &X = pencil.start, T = pencil.timelike();
    Yu = dot(of_u, X);
    Yv = dot(of_v, X);
    const Many4 W = X - Yu * u.x - Yv * v.x;
    Many4 V = T - dot(of_u, T) * u.x - dot(of_v, T) * v.x;
    V = math::inverse_sqrt(-dot(pencil.S_of(V), V)) * V;
    const Many s = -dot(pencil.S_of(V), W);
    Many4 e = W - s * V;
    const Many square = dot(pencil.S_of(e), e);
    const Choice near = 4 * square > s * s;
    const Many4 cross = minors(V);
    e = choose(near, math::inverse_sqrt(square) * e, across(pencil, cross));
    Many D = dot(pencil.S_of(e), W);
    const Choice back = D < 0.;
    D = math::abs(D);
    e = choose(back, -1. * e, e);
    turned = dot(cross, e);
    plus = V + e;
    minus = V - e;
    al = 0.5 * (s + D);
    be = (Yu * Yu + Yv * Yv) / (4 * al);
    // E - sigma_u S, in which what errors leave along u does not count
    const auto part = [&](const Many4& x) GYROSTAT_INLINE_LAMBDA { return pencil.E_of(x) - u.sigma * pencil.S_of(x); };
    const Many4 of_V = part(V), of_e = part(e);
    const Many VV = dot(of_V, V), twice_Ve = 2 * dot(of_V, e), ee = dot(of_e, e), tau = -2 * be;
    E_minus = 0.5 * (VV - twice_Ve + ee);
    const Many from_start = (-split * Yv * Yv + 2 * tau * dot(of_V, W) + tau * tau * VV) / (2 * D * D);
    E_plus = math::choose(near, from_start, 0.5 * (VV + twice_Ve + ee));
    from_u = 0.5 * (ee - VV);
    from_v = from_u - split;
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
    u.found = v.found = Many(0.) < 1.;
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
    const auto minor = [a, b](int i, int j) GYROSTAT_INLINE_LAMBDA { return a[i] * b[j] - a[j] * b[i]; };
    const Many m01 = minor(0, 1), m02 = minor(0, 2), m03 = minor(0, 3), m12 = minor(1, 2), m13 = minor(1, 3),
               m23 = minor(2, 3);
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
  /// What one of the two forms has of its own; cotangent: of the amplitude of eta.
  struct Form {
    Many4 plus, minus, x1, x2;
    Many al, be, k2, kp2, rate, sn, cn, psi[2], size[2];
    Many cotangent;
    Many turned;  ///< its sign is that of the determinant of x1, x2, plus - minus, plus + minus
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
    f.al = math::choose(swapped, pair.be, pair.al);
    f.be = math::choose(swapped, pair.al, pair.be);
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
  f.cotangent = math::sqrt(p.split * near);
  const NullPair pair(p, inverse);
  const Choice swapped = pair.al < pair.be;
  set_pair(f, pair, swapped, p.turned);
  f.turned = math::choose(first, f.turned, -f.turned);
  const Many Y4 = 1 / (f.al + f.be);
  f.sn = Y1 * Y4 * math::inverse_sqrt(nu * near);
  f.cn = Y2 * Y4 * math::inverse_sqrt(nu * far);
  const Many st = math::choose(first, p.u.sigma, p.v.sigma) - side * p2, s0 = st - side * nu;
  f.psi[0] = 0.5 * (st + c1 * s0) / (1 + c1);
  f.psi[1] = 0.5 * (s0 + side * (p3 + nu) * (1 + c1));
  f.size[0] = f.size[1] = 1;
  return f;
}

FrameLanes::Form FrameLanes::alone(const PlaneLanes& p) noexcept {
  Form f;
  const Many square = -p.E_plus * p.E_minus, inverse = math::inverse_sqrt(square), B = square * inverse;
  set_pair(f, NullPair(p, inverse), p.E_plus < 0., p.turned);
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
  const Many l = 1 / (cg * f.al + sg * f.be);
  f.cn = 0.5 * (p.Yv * l * side_inverse);
  f.sn = p.Yu * l * math::inverse_sqrt(2 * sine * (xc2 * xc2 + 1) * (f.kp2 + f.k2 * f.cn * f.cn));
  const Many length = math::inverse_sqrt(f.sn * f.sn + f.cn * f.cn);
  f.sn *= length;
  f.cn *= length;
  const Many bez = sg + cg * xc2, per_bez = 1 / bez, per_alz = bez * (side_inverse * side_inverse);
  const Many moduli = f.k2 * math::inverse_sqrt(f.k2 * f.kp2);  // k/k'
  f.cotangent = math::sqrt(sg * per_alz * moduli);
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
  Form f;
  if (some == math::all_numbers) {
    side = 1;
    f = alone(p);
    f.sound = single & f.sound;
  } else {
    f = lobe(p);
  }
  if (some != 0 && some != math::all_numbers) {
    const Form g = alone(p);
    const auto take = [&](auto member) GYROSTAT_INLINE_LAMBDA { f.*member = choose(single, g.*member, f.*member); };
    take(&Form::plus), take(&Form::minus), take(&Form::x1), take(&Form::x2);
    take(&Form::k2), take(&Form::kp2), take(&Form::rate), take(&Form::sn), take(&Form::cn);
    take(&Form::cotangent), take(&Form::turned);
    for (int i = 0; i < 2; ++i) {
      f.psi[i] = math::choose(single, g.psi[i], f.psi[i]);
      f.size[i] = math::choose(single, g.size[i], f.size[i]);
    }
    f.sound = (single & g.sound) | ((p.E_plus * p.E_minus > 0.) & f.sound);
  }
  sound = f.sound & p.u.found & p.v.found & (pencil.gap01 > 1e-12 * pencil.a[2]) &
          (pencil.gap12 > 1e-12 * pencil.a[2]) & (pencil.a[0] > 1e-60) & (pencil.a[2] < 1e60);
  const Choice back = f.cn < 0.;
  f.cn = math::abs(f.cn);
  f.x2 = choose(back, -1. * f.x2, f.x2);
  delta = math::choose(single, -1., -side);
  // delta det(x1, x2, plus - minus, plus + minus) > 0, without delta where there is one component
  Many turned = math::choose(back, -f.turned, f.turned);
  turned = math::choose(single, turned, delta * turned);
  const Choice turn = turned < 0.;
  f.sn = math::choose(turn, -f.sn, f.sn);
  f.x1 = choose(turn, -1. * f.x1, f.x1);
  plus = f.plus, minus = f.minus, xa = f.x1;
  xb = math::choose(single, 1., delta) * f.x2;
  k2 = f.k2, kp2 = f.kp2, rate = f.rate;
  integrals = math::first_kind(k2, kp2, f.cn / math::abs(f.sn), f.cotangent);
  start = math::choose(f.sn < 0., -integrals.F_part, integrals.F_part);
  for (int i = 0; i < 2; ++i) psi[i] = f.psi[i], size[i] = f.size[i];
}

}  // namespace gyrostat::free::detail
