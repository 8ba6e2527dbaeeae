// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "gyrostat/core/real.hpp"

namespace gyrostat::deceleration {

/// Two real functions of period one, by n samples at j/n (n a power of two up to 256), as one complex Fourier sum: mean,
/// zero-mean antiderivative, value anywhere. The highest harmonic is dropped.
template <Real Scalar>
class PeriodicPair {
 public:
  static constexpr int capacity = 256;

  struct Value {
    Scalar first, second;
  };

  /// The roots of unity that a transform of n samples needs; build once for many transforms.
  struct Roots {
    int n;
    Scalar cos[capacity / 2 + 1], sin[capacity / 2 + 1];

    explicit Roots(int samples) noexcept : n(samples) {
      for (int i = 0; i <= n / 2; ++i) {
        cos[i] = std::cos(2 * pi<Scalar> * Scalar(i) / Scalar(n));
        sin[i] = std::sin(2 * pi<Scalar> * Scalar(i) / Scalar(n));
      }
    }
  };

  PeriodicPair() = default;  ///< zero

  PeriodicPair(const Roots& roots, const Scalar* first, const Scalar* second) noexcept : n_(roots.n) {
    Scalar greatest[2] = {0, 0};
    for (int i = 0; i < n_; ++i) {
      greatest[0] = std::max(greatest[0], std::abs(first[i]));
      greatest[1] = std::max(greatest[1], std::abs(second[i]));
    }
    if (greatest[0] > 0 && greatest[1] > 0 && greatest[0] < infinity<Scalar> && greatest[1] < infinity<Scalar>) {
      constexpr int most = std::numeric_limits<Scalar>::max_exponent / 2;  // beyond it neither matters to the other
      unit_ = std::ldexp(Scalar(1), std::clamp(std::ilogb(greatest[1]) - std::ilogb(greatest[0]), -most, most));
    }
    for (int i = 0; i < n_; ++i) {
      re_[i] = first[i] / Scalar(n_);
      im_[i] = second[i] / unit_ / Scalar(n_);
    }
    transform(roots, -1);
    re_[n_ / 2] = im_[n_ / 2] = 0;
  }

  Value mean() const noexcept { return n_ > 1 ? Value{re_[0], im_[0] * unit_} : Value{0, 0}; }

  /// Antiderivative of the function less its mean, itself of zero mean.
  PeriodicPair integral() const noexcept {
    PeriodicPair r;
    r.n_ = n_, r.unit_ = unit_;
    r.re_[0] = r.im_[0] = r.re_[n_ / 2] = r.im_[n_ / 2] = 0;
    for (int k = 1; k < n_ / 2; ++k) {
      const Scalar w = 1 / (2 * pi<Scalar> * Scalar(k));
      r.re_[k] = im_[k] * w;  // over +i k
      r.im_[k] = -re_[k] * w;
      r.re_[n_ - k] = -im_[n_ - k] * w;
      r.im_[n_ - k] = re_[n_ - k] * w;
    }
    return r;
  }

  PeriodicPair times(Scalar factor) const noexcept {
    PeriodicPair r = *this;
    for (int k = 0; k < n_; ++k) r.re_[k] *= factor, r.im_[k] *= factor;
    return r;
  }

  /// The samples at j/n.
  void sample(const Roots& roots, Scalar* first, Scalar* second) const noexcept {
    PeriodicPair r = *this;
    r.transform(roots, 1);
    for (int i = 0; i < n_; ++i) first[i] = r.re_[i], second[i] = r.im_[i] * unit_;
  }

  Value at(Scalar phase) const noexcept {
    const Scalar c = std::cos(2 * pi<Scalar> * phase), s = std::sin(2 * pi<Scalar> * phase);
    Value v = mean();
    v.second /= unit_;
    Scalar ck = c, sk = s;
    for (int k = 1; k < n_ / 2; ++k) {
      const Scalar ap = re_[k], bp = im_[k], am = re_[n_ - k], bm = im_[n_ - k];
      v.first += (ap + am) * ck - (bp - bm) * sk;
      v.second += (bp + bm) * ck + (ap - am) * sk;
      const Scalar next = ck * c - sk * s;
      sk = ck * s + sk * c;
      ck = next;
    }
    v.second *= unit_;
    return v;
  }

 private:
  /// Fast Fourier transform in place, kernel exp(sign 2 pi i j k/n).
  void transform(const Roots& roots, int sign) noexcept {
    for (int i = 1, j = 0; i < n_; ++i) {
      int bit = n_ >> 1;
      for (; j & bit; bit >>= 1) j ^= bit;
      j ^= bit;
      if (i < j) {
        const Scalar re = re_[i], im = im_[i];
        re_[i] = re_[j], im_[i] = im_[j];
        re_[j] = re, im_[j] = im;
      }
    }
    for (int length = 2; length <= n_; length *= 2) {
      const int half = length / 2, stride = n_ / length;
      for (int start = 0; start < n_; start += length)
        for (int k = 0; k < half; ++k) {
          const Scalar c = roots.cos[k * stride], s = Scalar(sign) * roots.sin[k * stride];
          const int a = start + k, b = a + half;
          const Scalar re = re_[b] * c - im_[b] * s, im = re_[b] * s + im_[b] * c;
          re_[b] = re_[a] - re, im_[b] = im_[a] - im;
          re_[a] += re, im_[a] += im;
        }
    }
  }

  int n_ = 1;
  Scalar unit_ = 1;  ///< of the second function, a power of two: both go through the transform as numbers of one size
  Scalar re_[capacity], im_[capacity];  // the first n_ count
};

}  // namespace gyrostat::deceleration
