// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

  GYROSTAT_INLINE Many S(const Many4& x, const Many4& y) const noexcept {
    Many sum = -rho * x.x[3] * y.x[3];
    for (int i = 0; i < 3; ++i) sum += x.x[i] * y.x[i] + d[i] * (x.x[i] * y.x[3] + y.x[i] * x.x[3]);
    return sum;
  }
  GYROSTAT_INLINE Many E(const Many4& x, const Many4& y) const noexcept {
    Many sum = eps * x.x[3] * y.x[3];
    for (int i = 0; i < 3; ++i) sum += a[i] * x.x[i] * y.x[i] - b[i] * (x.x[i] * y.x[3] + y.x[i] * x.x[3]);
    return sum;
  }
  GYROSTAT_INLINE Many form(const AxisLanes& at, const Many4& x, const Many4& y) const noexcept {
    return E(x, y) - at.sigma * S(x, y);
  }
  GYROSTAT_INLINE Many along(const AxisLanes& u, const Many4& x) const noexcept {
    return math::choose(shifted, E(x, u.x) / u.sigma, S(x, u.x));
  }
  GYROSTAT_INLINE Many4 timelike(int axis = -1) const noexcept {
    const Many g = math::sqrt(start.x[0] * start.x[0] + start.x[1] * start.x[1] + start.x[2] * start.x[2]);
    const Many step = math::choose(shifted & (4 * g < 1.), 3 * g, 1.);
    Many4 x;
    for (int i = 0; i < 3; ++i) x.x[i] = -step * d[i];
    x.x[3] = 1;
    if (axis >= 0) x.x[axis] += step;
    return x;
  }
};

/// The root between a[low] and a[low + 1] that is the nearest to a[1], where the secular equation falls.
class RootLanes {
 public:
  GYROSTAT_INLINE RootLanes(const PencilLanes& pencil, int low) noexcept : low_(low) {
    const Many width = low == 0 ? pencil.gap01 : pencil.gap12, third = low == 0 ? pencil.gap02 : -pencil.gap01;
    Many g2[3];
    for (int i = 0; i < 3; ++i) g2[i] = pencil.a[i] * pencil.lambda[i] * (pencil.a[i] * pencil.lambda[i]);
    Many from, to;
    bracket(pencil, g2, width, third, from, to);
    // from the nearer pole, whose term is kept while the rest is made linear
    upper_ = from + to > 1.;
    shift_ = math::choose(upper_, width, 0.);
    next_ = math::choose(upper_, -width, width);
    far_ = third - shift_;
    weight_ = math::choose(upper_, g2[low + 1], g2[low]);
    beside_ = math::choose(upper_, g2[low], g2[low + 1]);
    other_ = g2[low == 0 ? 2 : 0];
    origin_ = math::choose(upper_, pencil.a[low + 1], pencil.a[low]);
    constant_ = origin_ + pencil.plain;
    lo_ = from * width - shift_;
    hi_ = to * width - shift_;
    x_ = 0.5 * (lo_ + hi_);
    found_ = x_ < x_;
  }

  /// A step towards each root that is not found: what the last one leaves is of the order of its square.
  GYROSTAT_INLINE void step() noexcept {
    const Many p = 1 / ((next_ - x_) * (far_ - x_)), of_next = (far_ - x_) * p, of_far = (next_ - x_) * p;
    const Many first = beside_ * of_next, second = other_ * of_far;
    const Many rest = constant_ + x_ - first - second, steep = 1 - first * of_next - second * of_far;
    const Choice rises = (rest * x_ + weight_) * x_ > 0.;  // the sign of rest + weight/x
    lo_ = math::choose(rises, x_, lo_);
    hi_ = math::choose(rises, hi_, x_);
    const Many beta = rest - steep * x_, root = math::sqrt(math::max(beta * beta - 4 * steep * weight_, 0.));
    const Many q = -0.5 * (beta + math::choose(beta < 0., -root, root));
    const Many one = weight_ / q, two = q / steep;
    // a step out of the bracket becomes a bisection, unless by rounding only
    const Many little = 1e-9 * math::abs(x_), least = lo_ - little, most = hi_ + little;
    Many y = 0.5 * (lo_ + hi_);
    y = math::choose((least < two) & (two < most), two, y);
    y = math::choose((least < one) & (one < most), one, y);
    const Choice near = math::abs(y - x_) < 1e-8 * math::abs(x_);
    x_ = math::choose(found_, x_, y);
    found_ = found_ | near;
  }
  Choice found() const noexcept { return found_; }
  const Many& offset() const noexcept { return x_; }  ///< from the pole that it is the nearer to
  Choice upper() const noexcept { return upper_; }    ///< that is the upper of the two

  GYROSTAT_INLINE AxisLanes axis(const PencilLanes& pencil) const noexcept {
    AxisLanes u;
    u.found = found_;
    u.sigma = origin_ + x_;
    Many distance[3];  // a_i - sigma
    distance[low_] = -shift_ - x_;
    distance[low_ + 1] = math::choose(upper_, 0., next_) - x_;
    distance[low_ == 0 ? 2 : 0] = far_ - x_;
    for (int i = 0; i < 3; ++i)
      u.x.x[i] = math::choose(pencil.shifted, u.sigma, pencil.a[i]) * pencil.lambda[i] / distance[i];
    u.x.x[3] = 1;
    u.x = (1 / math::sqrt(math::abs(pencil.S(u.x, u.x)))) * u.x;
    return u;
  }

 private:
  /// Where the equation falls from + to -, as parts of the gap.
  GYROSTAT_INLINE void bracket(const PencilLanes& pencil, const Many (&g2)[3], const Many& width, const Many& third,
                               Many& from, Many& to) const noexcept {
    constexpr int count = 12;
    constexpr double parts[count + 2] = {0, 1e-5, .01, .05, .13, .25, .4, .6, .75, .87, .95, .99, .99999, 1};
    const Many constant = pencil.a[low_] + pencil.plain, other = g2[low_ == 0 ? 2 : 0];
    from = low_ == 0 ? parts[0] : parts[count];
    to = low_ == 0 ? parts[1] : parts[count + 1];
    for (int k = 0; k < count; ++k) {
      const int j = low_ == 0 ? k + 1 : count - k, next = low_ == 0 ? j : j - 1;
      const Many s = parts[j] * width, right = (1 - parts[j]) * width, far = third - s;
      // the equation times the distances, of which only that to the third can be negative
      const Many value = far * ((constant + s) * s * right + g2[low_] * right - g2[low_ + 1] * s) - other * s * right;
      const Choice more = value > 0.;
      from = math::choose(more, parts[next], from), to = math::choose(more, parts[next + 1], to);
    }
  }

  int low_;
  Choice upper_, found_;
  Many shift_, next_, far_, weight_, beside_, other_, origin_, constant_, lo_, hi_, x_;
};

/// The plane that two spacelike eigenvectors leave, by its null directions (NullPlane).
struct PlaneLanes {
  AxisLanes u, v;
  Many split;  ///< sigma_v - sigma_u
  Many4 plus, minus;
  Many E_plus, E_minus, al, be, Yu, Yv, from_u, from_v;

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
      to = {math::choose(rigid, from.sigma, to.sigma), choose(rigid, from.x, to.x), to.found | rigid};
    }
    for (const auto member : {&PlaneLanes::plus, &PlaneLanes::minus}) take(member);
    for (const auto member :
         {&PlaneLanes::split, &PlaneLanes::E_plus, &PlaneLanes::E_minus, &PlaneLanes::al, &PlaneLanes::be,
          &PlaneLanes::Yu, &PlaneLanes::Yv, &PlaneLanes::from_u, &PlaneLanes::from_v})
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
    v.x = v.x - pencil.S(v.x, u.x) * u.x;
    v.x = (1 / math::sqrt(pencil.S(v.x, v.x))) * v.x;
    const Many4& X = pencil.start;
    Yu = pencil.along(u, X);
    Yv = pencil.along(v, X);
    const Many4 W = X - Yu * u.x - Yv * v.x;
    Many4 V = across(pencil, pencil.timelike());
    V = (1 / math::sqrt(-pencil.S(V, V))) * V;
    const Many s = -pencil.S(W, V);
    Many4 e = W - s * V;
    const Many square = pencil.S(e, e);
    const Choice near = 4 * square > s * s;
    e = (1 / math::sqrt(square)) * e;
    if (near.bits() != math::all_numbers) e = choose(near, e, spacelike(pencil, V));
    Many D = pencil.S(W, e);
    const Choice back = D < 0.;
    D = math::abs(D);
    e = choose(back, -1. * e, e);
    plus = V + e;
    minus = V - e;
    al = 0.5 * (s + D);
    be = (Yu * Yu + Yv * Yv) / (4 * al);
    E_minus = 0.5 * pencil.form(u, minus, minus);
    const Many tau = -2 * be;
    const Many from_start =
        (-split * Yv * Yv + 2 * tau * pencil.form(u, W, V) + tau * tau * pencil.form(u, V, V)) / (2 * D * D);
    E_plus = math::choose(near, from_start, 0.5 * pencil.form(u, plus, plus));
    from_u = -0.5 * pencil.form(u, plus, minus);
    from_v = -0.5 * pencil.form(v, plus, minus);
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
    u = {either(a[1], a[0]), {{other, one, none, none}}, Many(0.) < 1.};
    v = {either(a[2], a[1]), {{none, other, one, none}}, u.found};
    split = either(pencil.gap12, pencil.gap01);
    Yu = either(n[1], n[0]), Yv = either(n[2], n[1]);
    const Many half = 0.5 * (either(pencil.gap01, pencil.gap12) * n1 + pencil.gap02 * either(n2, n0));
    const Many near = math::abs(rise) + half;
    E_plus = E_minus = half;
    from_u = either(-near, near + split), from_v = either(-near - split, near);
    const Many side = math::choose(m < 0., -1., 1.);
    const Many4 e{{side * one, none, side * other, none}}, V{{none, none, none, 1.}};
    plus = V + e, minus = V - e;
    const Many sum = 1 + math::abs(m);
    al = 0.5 * sum;
    be = (n1 + either(n2, n0)) / (2 * sum);
  }

  GYROSTAT_INLINE Many4 across(const PencilLanes& pencil, const Many4& x) const noexcept {
    return x - pencil.along(u, x) * u.x - pencil.along(v, x) * v.x;
  }
  GYROSTAT_NOINLINE Many4 spacelike(const PencilLanes& pencil, const Many4& V) const noexcept {
    Many4 best = V;
    Many most = 0;
    for (int i = 0; i < 3; ++i) {
      Many4 e = across(pencil, pencil.timelike(i));
      e = e + pencil.S(e, V) * V;
      const Many square = pencil.S(e, e);
      const Choice more = square > most;
      best = choose(more, e, best);
      most = math::choose(more, square, most);
    }
    return (1 / math::sqrt(most)) * best;
  }
};

/// SpinorFrame of PathForm::lobe and PathForm::single.
struct FrameLanes {
  Choice single, sound;  ///< sound: of trigonometric form, and nothing went wrong
  Many side, delta;      ///< side: of two components, 1 about the axis of the largest moment, else -1
  Many4 plus, minus, xa, xb;
  Many k2, kp2, rate, u_start;  ///< u_start: the argument of the start
  Many eta, size[2], psi[2];

  GYROSTAT_INLINE explicit FrameLanes(const PencilLanes& pencil) noexcept;

 private:
  /// What one of the two forms has of its own; eta = factor R_F(x, y, 1).
  struct Form {
    Many4 plus, minus, x1, x2;
    Many al, be, k2, kp2, rate, sn, cn, dn, psi[2], size[2];
    Many factor, x, y;
    Choice sound;
  };
  // compiled once each, so that a lane has the same bits whether the other form is there beside it or not
  GYROSTAT_NOINLINE inline Form lobe(const PencilLanes& pencil, const PlaneLanes& p) noexcept;
  GYROSTAT_NOINLINE static inline Form alone(const PencilLanes& pencil, const PlaneLanes& p) noexcept;
  GYROSTAT_INLINE static Many determinant(const Many4& a, const Many4& b, const Many4& c, const Many4& d) noexcept {
    const auto minor = [](const Many4& x, const Many4& y, int i, int j)
                           GYROSTAT_INLINE_LAMBDA { return x.x[i] * y.x[j] - x.x[j] * y.x[i]; };
    return minor(a, b, 0, 1) * minor(c, d, 2, 3) - minor(a, b, 0, 2) * minor(c, d, 1, 3) +
           minor(a, b, 0, 3) * minor(c, d, 1, 2) + minor(a, b, 1, 2) * minor(c, d, 0, 3) -
           minor(a, b, 1, 3) * minor(c, d, 0, 2) + minor(a, b, 2, 3) * minor(c, d, 0, 1);
  }
  static constexpr double least_k2 = 1e-16;
};

FrameLanes::Form FrameLanes::lobe(const PencilLanes&, const PlaneLanes& p) noexcept {
  Form f;
  const Choice first = p.from_u < 0.;  // u is x1
  side = math::choose(first, 1., -1.);
  f.x1 = choose(first, p.u.x, p.v.x);
  f.x2 = choose(first, p.v.x, p.u.x);
  const Many Y1 = math::choose(first, p.Yu, p.Yv), Y2 = math::choose(first, p.Yv, p.Yu);
  const Many to_u = math::abs(p.from_u), to_v = math::abs(p.from_v);
  const Many nu = 2 * math::sqrt(math::abs(p.E_plus * p.E_minus));
  const Many p2 = math::choose(first, to_u, to_v) - 0.5 * nu, p3 = math::choose(first, to_v, to_u) - 0.5 * nu;
  const Many whole = (p2 + nu) * p3;
  f.k2 = p.split * nu / whole;
  f.kp2 = p2 * (p3 + nu) / whole;
  f.rate = math::sqrt(whole);
  f.sound = (p.from_u * p.from_v > 0.) & (f.kp2 > 0.0295) & (f.k2 > least_k2);
  const Many near = 1 / (nu + p2), far = 1 / (nu + p3);
  const Many c1 = math::sqrt(p3 * far), c2 = math::sqrt(nu * near), c3 = math::sqrt(nu * far);
  f.factor = math::sqrt((nu + p2) * far);
  f.x = p.split * far, f.y = p.split / p3;
  const Many boost = math::sqrt(math::sqrt(math::abs(p.E_minus / p.E_plus))), lower = 1 / boost;
  const Many al = p.al * lower, be = p.be * boost;
  const Choice swapped = al < be;
  const Many4 boosted_plus = boost * p.plus, boosted_minus = lower * p.minus;
  f.plus = choose(swapped, boosted_minus, boosted_plus);
  f.minus = choose(swapped, boosted_plus, boosted_minus);
  f.al = math::max(al, be);
  f.be = math::min(al, be);
  const Many Y4 = 1 / (f.al + f.be);
  f.sn = Y1 * Y4 / c2;
  f.cn = Y2 * Y4 / c3;
  f.dn = (f.al - f.be) * Y4 / c1;
  const Many st = math::choose(first, p.u.sigma, p.v.sigma) - side * p2, s0 = st - side * nu;
  f.psi[0] = 0.5 * (st + c1 * s0) / (1 + c1);
  f.psi[1] = 0.5 * (s0 + side * (p3 + nu) * (1 + c1));
  f.size[0] = f.size[1] = 1;
  return f;
}

FrameLanes::Form FrameLanes::alone(const PencilLanes& pencil, const PlaneLanes& p) noexcept {
  Form f;
  const Many B = math::sqrt(-p.E_plus * p.E_minus);
  const Many boost = math::sqrt(math::sqrt(math::abs(p.E_minus / p.E_plus))), lower = 1 / boost;
  const Many al = p.al * lower, be = p.be * boost;
  const Many4 boosted_plus = boost * p.plus, boosted_minus = lower * p.minus;
  const Choice straight = p.E_plus > 0.;
  f.plus = choose(straight, boosted_plus, boosted_minus);
  f.minus = choose(straight, boosted_minus, boosted_plus);
  f.al = math::choose(straight, al, be);
  f.be = math::choose(straight, be, al);
  f.x1 = p.u.x, f.x2 = p.v.x;
  const Many width = p.split, rho = math::sqrt(p.from_u * p.from_u + B * B),
             rho2 = math::sqrt(p.from_v * p.from_v + B * B);
  f.rate = math::sqrt(rho * rho2);
  // of trigonometric form where reach <= 0
  const Many reach = (-p.from_u * p.from_v - B * B) / B, root = math::sqrt(width * width + reach * reach);
  f.k2 = width / (2 * root) * (width / (root + math::abs(reach)));
  f.kp2 = 1 - f.k2;
  f.sound = (reach < 0.) & (f.k2 > least_k2);
  const Many xc2_width = 1 / (root - reach), xc2 = xc2_width * width;
  const Many cosine = p.from_u / rho, sine = B / rho;
  const Many larger = math::sqrt(0.5 * (1 + math::abs(cosine))), other = sine / (2 * larger);
  const Choice acute = cosine > 0.;
  const Many cg = math::choose(acute, larger, other), sg = math::choose(acute, other, larger);
  const Many l = 1 / (cg * f.al + sg * f.be);
  f.cn = p.Yv * l / (2 * math::sqrt(xc2_width * rho));
  f.sn = p.Yu * l / math::sqrt(2 * sine * (xc2 * xc2 + 1)) / math::sqrt(f.kp2 + f.k2 * f.cn * f.cn);
  const Many length = 1 / math::sqrt(f.sn * f.sn + f.cn * f.cn);
  f.sn *= length;
  f.cn *= length;
  f.dn = math::sqrt(f.kp2 + f.k2 * f.cn * f.cn);
  const Many k = math::sqrt(f.k2), kp = math::sqrt(f.kp2), tangent = sg / cg;
  const Many bez = sg + cg * xc2, alz = xc2_width * rho / bez, sum = k + kp * tangent;
  f.factor = math::sqrt(alz / cg);
  f.x = tangent * k / kp, f.y = k * sum;
  f.size[0] = alz, f.size[1] = bez;
  const Many m = -0.5 * pencil.E(f.plus, f.minus);
  f.psi[0] = 0.5 * (m + B * bez / alz);
  f.psi[1] = 0.5 * (m - B * alz / bez);
  return f;
}

GYROSTAT_INLINE FrameLanes::FrameLanes(const PencilLanes& pencil) noexcept {
  const PlaneLanes p(pencil);
  single = p.E_plus * p.E_minus < 0.;
  const unsigned some = single.bits();
  Form f;
  if (some == math::all_numbers) {
    side = 1;
    f = alone(pencil, p);
    f.sound = single & f.sound;
  } else {
    f = lobe(pencil, p);
  }
  if (some != 0 && some != math::all_numbers) {
    const Form g = alone(pencil, p);
    const auto take = [&](auto member) GYROSTAT_INLINE_LAMBDA { f.*member = choose(single, g.*member, f.*member); };
    take(&Form::plus), take(&Form::minus), take(&Form::x1), take(&Form::x2);
    take(&Form::k2), take(&Form::kp2), take(&Form::rate), take(&Form::sn), take(&Form::cn), take(&Form::dn);
    take(&Form::factor), take(&Form::x), take(&Form::y);
    for (int i = 0; i < 2; ++i) {
      f.psi[i] = math::choose(single, g.psi[i], f.psi[i]);
      f.size[i] = math::choose(single, g.size[i], f.size[i]);
    }
    f.sound = (single & g.sound) | ((p.E_plus * p.E_minus > 0.) & f.sound);
  }
  sound = f.sound & p.u.found & p.v.found & (pencil.gap01 > 1e-12 * pencil.a[2]) & (pencil.gap12 > 1e-12 * pencil.a[2]);
  const Choice back = f.cn < 0.;
  f.cn = math::abs(f.cn);
  f.x2 = choose(back, -1. * f.x2, f.x2);
  delta = math::choose(single, -1., -side);
  const Many4 lobe_axis = 0.5 * (f.plus - f.minus), middle = 0.5 * (f.plus + f.minus);
  const Many turned = determinant(f.x1, f.x2, lobe_axis, middle) * math::choose(single, 1., delta);
  const Choice turn = turned < 0.;
  f.sn = math::choose(turn, -f.sn, f.sn);
  f.x1 = choose(turn, -1. * f.x1, f.x1);
  plus = f.plus, minus = f.minus, xa = f.x1;
  xb = math::choose(single, 1., delta) * f.x2;
  k2 = f.k2, kp2 = f.kp2, rate = f.rate;
  Many x[2] = {f.x, f.cn * f.cn}, y[2] = {f.y, f.dn * f.dn}, F[2];
  math::carlson_RF(x, y, F);
  eta = f.factor * F[0];
  u_start = f.sn * F[1];
  for (int i = 0; i < 2; ++i) psi[i] = f.psi[i], size[i] = f.size[i];
}

}  // namespace gyrostat::free::detail
