// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/carlson.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/math/third_kind.hpp"
#include "gyrostat/models/free/pencil.hpp"

namespace gyrostat::free {

/// The plane that two spacelike eigenvectors u, v leave, by its two null directions. Where two roots collide (on a separatrix, where a
/// lobe is born) their eigenvectors lie IN this plane, and nothing here is singular.
template <Real Scalar>
struct NullPlane {
  PencilAxis<Scalar> u, v;  ///< v made orthogonal to u
  Vec4<Scalar> plus = Vec4<Scalar>::Zero(),
               minus = plus;  ///< P+ and P-, future directed, S(P+, P-) = -2; P+ is the one that the start is nearer to
  Scalar E_plus = 0, E_minus = 0;  ///< E(P+, P+)/2, E(P-, P-)/2
  Scalar al = 0, be = 0;           ///< the start is X0 = al P+ + be P- + Yu u + Yv v
  Scalar Yu = 0, Yv = 0;
  Scalar from_u = 0, from_v = 0;  ///< m - sigma_u and m - sigma_v; m: mean of the two roots that belong to the plane

  static NullPlane of(const Pencil<Scalar>& pencil, const PencilAxis<Scalar>& first,
                      const PencilAxis<Scalar>& second) noexcept {
    using std::sqrt;
    NullPlane p;
    p.u = first;
    p.v = second;
    p.v.x -= pencil.S(p.v.x, p.u.x) * p.u.x;
    p.v.x /= sqrt(pencil.S(p.v.x, p.v.x));
    const auto& X = pencil.start();
    p.Yu = pencil.along(p.u, X);
    p.Yv = pencil.along(p.v, X);
    const Vec4<Scalar> W = X - p.Yu * p.u.x - p.Yv * p.v.x;
    Vec4<Scalar> V = p.across(pencil, pencil.timelike());
    V /= sqrt(-pencil.S(V, V));
    const Scalar s = -pencil.S(W, V);
    // a spacelike unit vector of the plane: along the start's, or where that is small along a principal axis
    Vec4<Scalar> e = W - s * V;
    const Scalar square = pencil.S(e, e);
    const bool near = 4 * square > s * s;
    if (near) e /= sqrt(square);
    else e = p.spacelike(pencil, V);
    Scalar D = pencil.S(W, e);
    if (D < 0) D = -D, e = -e;
    p.plus = V + e;
    p.minus = V - e;
    p.al = (s + D) / 2;
    p.be = (p.Yu * p.Yu + p.Yv * p.Yv) / (4 * p.al);
    p.E_minus = pencil.form(p.u, p.minus, p.minus) / 2;
    if (near) {
      // from the point: near an equilibrium or a separatrix the error is that of the data
      const Scalar tau = -2 * p.be;
      p.E_plus = (-pencil.difference(p.u, p.v) * p.Yv * p.Yv + 2 * tau * pencil.form(p.u, W, V) +
                  tau * tau * pencil.form(p.u, V, V)) /
                 (2 * D * D);
    } else {
      p.E_plus = pencil.form(p.u, p.plus, p.plus) / 2;
    }
    p.from_u = -pencil.form(p.u, p.plus, p.minus) / 2;
    p.from_v = -pencil.form(p.v, p.plus, p.minus) / 2;
    return p;
  }

  /// Two real roots belong to the plane, else a complex pair.
  bool real_roots() const noexcept { return E_plus * E_minus >= 0; }
  /// Both of u and v lie on one side of the two roots: these are the lobe's and the timelike one.
  bool holds_lobe() const noexcept { return from_u * from_v > 0; }

 private:
  Vec4<Scalar> across(const Pencil<Scalar>& pencil, const Vec4<Scalar>& x) const noexcept {
    return x - pencil.along(u, x) * u.x - pencil.along(v, x) * v.x;
  }
  Vec4<Scalar> spacelike(const Pencil<Scalar>& pencil, const Vec4<Scalar>& V) const noexcept {
    using std::sqrt;
    Vec4<Scalar> best = Vec4<Scalar>::Zero();
    Scalar most = 0;
    for (int i = 0; i < 3; ++i) {
      Vec4<Scalar> e = across(pencil, pencil.timelike(i));
      e += pencil.S(e, V) * V;
      const Scalar square = pencil.S(e, e);
      if (square > most) most = square, best = e;
    }
    return best / sqrt(most);
  }
};

/// The path of M as a curve in Jacobi's functions of u, du/dt = rate R, and the frame in which its spinor is a pair of theta functions.
enum class PathForm : std::uint8_t {
  lobe,  ///< two components, frame of the plane of the lobe's axis and the timelike one: theta functions in trigonometric form
  separatrix,  ///< two components, frame of the plane through which the separatrix goes: theta functions in hyperbolic form
  single,      ///< one component
};

template <Real Scalar>
struct SpinorFrame {
  PathForm form = PathForm::single;
  int side = 0;  ///< of two components: 1 where M surrounds the axis of the largest moment, -1 that of the smallest
  bool exact = false;  ///< the axis next to the timelike one is a principal axis: kp2 is known as well as the data
  Vec4<Scalar> plus = Vec4<Scalar>::Zero(), minus = plus, xa = plus,
               xb = plus;  ///< N+, N- (null, S = -2) and two spacelike vectors, an orthogonal frame with (N+ +- N-)/2
  int delta = 1;           ///< orientation
  math::Modulus<Scalar> modulus;
  Scalar rate = 0;                ///< du/dt over R
  Scalar sn = 0, cn = 1, dn = 1;  ///< of the start, cn >= 0
  Scalar eta = 0, eta_rest = 0;   ///< imaginary shift of the theta functions' argument, 0 < eta < K', and K' - eta
  Scalar size[2] = {1, 1};        ///< |zeta_1|^2, |zeta_2|^2 at u = 0, one component
  Scalar psi[2] = {0, 0};         ///< rate of the phase of a spinor's components at u = 0, over R

  /// Errors: those of Pencil::axes(); separatrix where the two roots cannot be told apart.
  static Result<SpinorFrame> of(const Pencil<Scalar>& pencil) noexcept {
    const auto axes = pencil.axes();
    if (!axes) return axes.error();
    SpinorFrame frame;
    const PencilAxis<Scalar>* axis = axes->axis;
    if (axes->count == 2) return frame.take(pencil, NullPlane<Scalar>::of(pencil, axis[0], axis[1]), nullptr, nullptr);
    // lobe, then the near and the far one of the others
    const bool low = axes->lobe_lowest;
    const PencilAxis<Scalar>&lobe = axis[low ? 0 : 2], &near = axis[1], &far = axis[low ? 2 : 0];
    const auto plane = [&](bool of_lobe) {
      if (of_lobe) return NullPlane<Scalar>::of(pencil, low ? near : far, low ? far : near);
      return NullPlane<Scalar>::of(pencil, axis[0], axis[2]);
    };
    bool of_lobe = 2 * axes->share < 1;
    for (int trip = 0; trip < 2; ++trip) {
      frame = SpinorFrame();
      const auto p = plane(of_lobe);
      const auto taken = frame.take(pencil, p, of_lobe ? &lobe : nullptr, &near);
      if (!taken || frame.form == PathForm::single) return taken;
      frame = *taken;
      // K <= 2 K': kp2 >= (sqrt 2 - 1)^4
      const bool wanted = frame.modulus.kp2 >= Scalar(0.02943725152285942L);
      if (wanted == of_lobe) break;
      of_lobe = wanted;
    }
    return frame;
  }

 private:
  using Axis = PencilAxis<Scalar>;
  using Plane = NullPlane<Scalar>;

  Result<SpinorFrame> take(const Pencil<Scalar>& pencil, Plane plane, const Axis* lobe, const Axis* near) noexcept {
    const bool known = near && near->exact;  // of a level with two components for certain
    if (!known && !plane.real_roots()) {
      single(pencil, plane);
    } else {
      // roots that agree to the last bit are taken to differ by eps^2
      const Scalar least = epsilon<Scalar> * epsilon<Scalar>;
      if (plane.E_plus == 0) plane.E_plus = plane.E_minus * least;
      if (plane.E_minus == 0) plane.E_minus = plane.E_plus * least;
      if (plane.holds_lobe()) lobe_plane(pencil, plane, lobe, near);
      else separatrix_plane(pencil, plane, near);
    }
    if (!(rate > 0) || !(modulus.legal())) return Errc::separatrix;
    return *this;
  }

  /// Nonnegative parts of the modulus: differences of the timelike root to the lobe's, the near and the far one.
  void set_modulus(Scalar nu, Scalar p2, Scalar p3, Scalar split) noexcept {
    using std::max, std::min, std::sqrt;
    const Scalar least = Scalar(1e-290);
    nu = max(nu, Scalar(0));
    const Scalar whole = (p2 + nu) * p3;
    modulus = {min(max(split * nu / whole, least), Scalar(1)), min(p2 * (p3 + nu) / whole, Scalar(1))};
    rate = sqrt(whole);
    // sn(eta, k') = sqrt((nu + p2)/(nu + p3)), sn(K' - eta, k') = sqrt(p3/(p3 + nu))
    const Scalar c1 = sqrt(p3 / (p3 + nu)), floor = least;
    const Scalar c2 = max(nu / (nu + p2), floor), c3 = max(nu / (nu + p3), floor);
    eta = sqrt((nu + p2) / (nu + p3)) *
          math::carlson_RF<Scalar>(max(split / (nu + p3), floor), max(split / p3, floor), Scalar(1));
    eta_rest = c1 * math::carlson_RF<Scalar>(c3, c2, Scalar(1));
  }

  struct Differences {
    Scalar nu, p2, p3, split;
  };

  /// Plane of the lobe's axis x0 and t; u and v are x1 and x2 in some order.
  void lobe_plane(const Pencil<Scalar>& pencil, const Plane& p, const Axis* lobe, const Axis* near) noexcept {
    using std::abs, std::sqrt;
    form = PathForm::lobe;
    side = p.from_u < 0 ? 1 : -1;
    const bool u_near = side > 0;
    const Axis &x1 = u_near ? p.u : p.v, &x2 = u_near ? p.v : p.u;
    Scalar Y1 = u_near ? p.Yu : p.Yv, Y2 = u_near ? p.Yv : p.Yu;
    const Scalar to_near = abs(u_near ? p.from_u : p.from_v), to_far = abs(u_near ? p.from_v : p.from_u);
    Differences r{2 * sqrt(abs(p.E_plus * p.E_minus)), 0, 0, pencil.difference(p.u, p.v)};
    r.p2 = to_near - r.nu / 2;
    r.p3 = to_far - r.nu / 2;
    Scalar boost = sqrt(sqrt(abs(p.E_minus / p.E_plus)));
    if (lobe && lobe->exact) {
      const Scalar Y0 = pencil.S(pencil.start(), lobe->x), w0 = Y0 * Y0, w1 = Y1 * Y1, w2 = Y2 * Y2, all = w0 + w1 + w2;
      const Scalar s10 = abs(pencil.difference(*lobe, x1)), s20 = abs(pencil.difference(*lobe, x2));
      r.nu = (s10 * w1 + s20 * w2) / all;
      exact = near && near->exact;
      r.p2 = exact ? abs(s10 * w0 - r.split * w2) / all : s10 - r.nu;
      r.p3 = s20 - r.nu;
      boost = sqrt(abs(pencil.S(p.minus, lobe->x) / pencil.S(p.plus, lobe->x)));
    }
    set_modulus(r.nu, r.p2, r.p3, r.split);
    plus = boost * p.plus;
    minus = p.minus / boost;
    Scalar al = p.al / boost, be = p.be * boost;
    if (al < be) plus.swap(minus), std::swap(al, be);
    Vec4<Scalar> v1 = x1.x, v2 = x2.x;
    phase(r, Y1, Y2, al - be, al + be, v1, v2, (plus - minus) / 2);
    xa = v1;
    xb = Scalar(delta) * v2;
    // (s_t +- c1 s0)/(2 (1 +- c1)), s0 = s_t -+ nu
    const Scalar st = pencil.sigma(x1) - Scalar(side) * r.p2, c1 = sqrt(r.p3 / (r.p3 + r.nu));
    const Scalar s0 = st - Scalar(side) * r.nu;
    psi[0] = (st + c1 * s0) / (2 * (1 + c1));
    psi[1] = s0 / 2 + Scalar(side) * (r.p3 + r.nu) * (1 + c1) / 2;
  }

  /// Plane of x1 and t; u and v are the lobe's axis x0 and x2 in some order.
  void separatrix_plane(const Pencil<Scalar>& pencil, const Plane& p, const Axis* near) noexcept {
    using std::abs, std::sqrt;
    form = PathForm::separatrix;
    exact = near && near->exact;
    Scalar p2 = 2 * sqrt(abs(p.E_plus * p.E_minus));
    side = p.E_minus > 0 ? 1 : -1;
    Scalar boost = sqrt(sqrt(abs(p.E_minus / p.E_plus)));
    if (exact) {
      const Scalar Y1 = pencil.S(pencil.start(), near->x), wu = p.Yu * p.Yu, wv = p.Yv * p.Yv;
      const Scalar d = (pencil.difference(p.u, *near) * wu - pencil.difference(*near, p.v) * wv) / (Y1 * Y1 + wu + wv);
      p2 = abs(d);
      side = d >= 0 ? 1 : -1;
      boost = sqrt(abs(pencil.S(p.minus, near->x) / pencil.S(p.plus, near->x)));
    }
    const bool u_lobe = side > 0;
    const Scalar to_lobe = abs(u_lobe ? p.from_u : p.from_v), to_far = abs(u_lobe ? p.from_v : p.from_u);
    const Differences r{to_lobe - p2 / 2, p2, to_far + p2 / 2, to_far - p2 / 2};
    set_modulus(r.nu, r.p2, r.p3, r.split);
    plus = boost * p.plus;
    minus = p.minus / boost;
    Scalar al = p.al / boost, be = p.be * boost, Y0 = u_lobe ? p.Yu : p.Yv;
    Vec4<Scalar> v0 = u_lobe ? p.u.x : p.v.x, v1 = (plus - minus) / 2, v2 = u_lobe ? p.v.x : p.u.x;
    if (Y0 < 0) Y0 = -Y0, v0 = -v0;
    const bool swapped = phase(r, al - be, u_lobe ? p.Yv : p.Yu, Y0, al + be, v1, v2, v0);
    if (swapped) plus.swap(minus);
    xa = -v0;
    xb = Scalar(delta) * v2;
    const Scalar st = pencil.sigma(p.u) + p.from_u - Scalar(side) * p2 / 2;
    psi[0] = psi[1] = st / 2;
  }

  /// sn, cn, dn of the start, the directions of x1 and x2 in which cn >= 0 and u grows with time, and delta. True where x1 turned.
  bool phase(const Differences& r, Scalar Y1, Scalar Y2, Scalar Y0, Scalar Y4, Vec4<Scalar>& x1, Vec4<Scalar>& x2,
             const Vec4<Scalar>& x0) noexcept {
    using std::sqrt;
    const Scalar nu = std::max(r.nu, Scalar(1e-290) * r.p3);
    sn = Y1 / (Y4 * sqrt(nu / (nu + r.p2)));
    cn = Y2 / (Y4 * sqrt(nu / (nu + r.p3)));
    dn = Y0 / (Y4 * sqrt(r.p3 / (r.p3 + nu)));
    if (cn < 0) cn = -cn, x2 = -x2;
    delta = -side;  // the sense in which M circles its lobe (Euler's equations)
    const bool turn = determinant(x1, x2, x0, (plus + minus) / 2) * Scalar(delta) < 0;
    if (turn) sn = -sn, x1 = -x1;
    return turn;
  }

  void single(const Pencil<Scalar>& pencil, const Plane& p) noexcept {
    using std::abs, std::hypot, std::sqrt;
    form = PathForm::single;
    const Scalar B = sqrt(-p.E_plus * p.E_minus), boost = sqrt(sqrt(abs(p.E_minus / p.E_plus)));
    Scalar al = p.al / boost, be = p.be * boost;
    plus = boost * p.plus;
    minus = p.minus / boost;
    if (!(p.E_plus > 0)) plus.swap(minus), std::swap(al, be);
    const Scalar width = pencil.difference(p.u, p.v), rho = hypot(p.from_u, B), rho2 = hypot(p.from_v, B);
    rate = sqrt(rho * rho2);
    // r = reach/width; without dividing, since the roots of a symmetric body agree
    const Scalar reach = (-p.from_u * p.from_v - B * B) / B, root = hypot(width, reach);
    const Scalar small = std::max(width / (2 * root) * (width / (root + abs(reach))), Scalar(1e-290));
    modulus = reach > 0 ? math::Modulus<Scalar>::from_kp2(small) : math::Modulus<Scalar>::from_k2(small);
    const Scalar xc2_width = reach > 0 ? (root + reach) / width / width : 1 / (root - reach), xc2 = xc2_width * width;
    const Scalar cosine = p.from_u / rho, sine = B / rho;
    Scalar cg, sg;  // of half the angle of m - s1 + i B
    if (cosine > 0) cg = sqrt((1 + cosine) / 2), sg = sine / (2 * cg);
    else sg = sqrt((1 - cosine) / 2), cg = sine / (2 * sg);
    const Scalar f = cg * al + sg * be, ns = sqrt(2 * sine * (xc2 * xc2 + 1)), nc = 2 * sqrt(xc2_width * rho);
    Vec4<Scalar> x1 = p.u.x, x2 = p.v.x;
    cn = p.Yv / (nc * f);
    if (cn < 0) cn = -cn, x2 = -x2;
    sn = p.Yu / (ns * f) / sqrt(modulus.kp2 + modulus.k2 * cn * cn);
    const Scalar length = hypot(sn, cn);
    sn /= length;
    cn /= length;
    dn = sqrt(modulus.kp2 + modulus.k2 * cn * cn);
    delta = -1;  // with x1 turned so that u grows with time
    if (determinant(x1, x2, (plus - minus) / 2, (plus + minus) / 2) < 0) sn = -sn, x1 = -x1;
    xa = x1;
    xb = -Scalar(delta) * x2;
    const Scalar k = sqrt(modulus.k2), kp = sqrt(modulus.kp2), tangent = sg / cg;
    const Scalar bez = sg + cg * xc2, alz = xc2_width * rho / bez, sum = k + kp * tangent;
    eta = sqrt(alz / cg) * math::carlson_RF<Scalar>(tangent * k / kp, k * sum, Scalar(1));
    eta_rest = sqrt(tangent / (kp * sum)) * math::carlson_RF<Scalar>(k * alz / cg / sum, k / sum, Scalar(1));
    size[0] = alz;
    size[1] = bez;
    const Scalar m = -pencil.E(plus, minus) / 2;
    psi[0] = (m + B * bez / alz) / 2;
    psi[1] = (m - B * alz / bez) / 2;
  }

  static Scalar determinant(const Vec4<Scalar>& a, const Vec4<Scalar>& b, const Vec4<Scalar>& c,
                            const Vec4<Scalar>& d) noexcept {
    const auto subdeterminant = [](const Vec4<Scalar>& x, const Vec4<Scalar>& y, int i, int j) {
      return x[i] * y[j] - x[j] * y[i];
    };
    return subdeterminant(a, b, 0, 1) * subdeterminant(c, d, 2, 3) -
           subdeterminant(a, b, 0, 2) * subdeterminant(c, d, 1, 3) +
           subdeterminant(a, b, 0, 3) * subdeterminant(c, d, 1, 2) +
           subdeterminant(a, b, 1, 2) * subdeterminant(c, d, 0, 3) -
           subdeterminant(a, b, 1, 3) * subdeterminant(c, d, 0, 2) +
           subdeterminant(a, b, 2, 3) * subdeterminant(c, d, 0, 1);
  }
};

}  // namespace gyrostat::free
