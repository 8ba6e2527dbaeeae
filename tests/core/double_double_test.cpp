// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/double_double.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

#include "catch.hpp"

using namespace gyrostat;

static_assert(Real<DoubleDouble>);

namespace {

using DD = DoubleDouble;

/// Error of `got` relative to `right`, in units of epsilon.
double off(const DD& got, const DD& right) {
  return static_cast<double>(abs(got - right)) / std::abs(right.high) / epsilon<DD>.high;
}

struct ElementaryRow {
  DD x, exponential, sine, cosine, logarithm, root;  // logarithm and root of |x|; mpmath, 60 digits
};
const ElementaryRow elementary_rows[] = {
    {{0x1.3333333333333p-2, 0x1.3333333333333p-72},
     {0x1.599058c8c1a96p+0, -0x1.b3adcceaed673p-54},
     {0x1.2e9cd95baba33p-2, 0x1.51dcf9c9687d7p-56},
     {0x1.e921dd42f09bap-1, 0x1.82c97596b41e6p-55},
     {-0x1.34378fcbda721p+0, 0x1.9c1504e27f13dp-54},
     {0x1.186f174f88472p-1, 0x1.0a91bc4eec1a9p-55}},
    {{-0x1.b333333333333p+0, -0x1.b333333333333p-70},
     {0x1.7622c78a98a07p-3, -0x1.90bb3bfa564d4p-58},
     {-0x1.fbbb7d72f98b6p-1, -0x1.d45805acf79fbp-55},
     {-0x1.07df9f4a26c86p-3, -0x1.0da778131f355p-58},
     {0x1.0fae81914a991p-1, -0x1.768526cde19f3p-58},
     {0x1.4dc87d61451dap+0, -0x1.25e21c8bf7a17p-56}},
    {{0x1.4000000000000p+1, 0x1.4000000000000p-69},
     {0x1.85d6fd931e0bbp+3, 0x1.d4edfdb3d0092p-53},
     {0x1.326af0dcfcab1p-1, -0x1.fd4674b81ed27p-55},
     {-0x1.9a2f7ef858b7dp-1, -0x1.5882f6b832e82p-56},
     {0x1.d5240f0e0e078p-1, -0x1.7df3360740fe5p-55},
     {0x1.94c583ada5b53p+0, -0x1.b7ecaaab31f5cp-54}},
    {{0x1.12e0be826d695p-30, 0x1.12e0be826d695p-100},
     {0x1.000000044b830p+0, -0x1.7b444af5c2662p-54},
     {0x1.12e0be826d695p-30, -0x1.a467186c80269p-93},
     {0x1.0000000000000p+0, -0x1.2725dd1d243acp-61},
     {-0x1.4b927f32bffb8p+4, -0x1.75e05db0f0f33p-51},
     {0x1.09456549be1bdp-15, -0x1.2c9ea60fb3568p-70}},
    {{0x1.4200000000000p+4, 0x1.4200000000000p-66},
     {0x1.0625e2f548a3ap+29, 0x1.2fddab2ac8685p-26},
     {0x1.e9d48a085fa1fp-1, -0x1.1dd6b85ae1cdbp-60},
     {0x1.2a100daeb07b1p-2, -0x1.7242a85b3912cp-56},
     {0x1.8040515af35a8p+1, 0x1.2cc9b5334a4f4p-53},
     {0x1.1f1c1799ca8ffp+2, -0x1.28b49f291a13cp-52}},
    {{-0x1.0000000000000p-7, -0x1.0000000000000p-77},
     {0x1.fc03fd56aa225p-1, -0x1.a00d4333b548bp-59},
     {-0x1.fffeaaaaeeeefp-8, 0x1.e45c2eca7b767p-62},
     {0x1.fffc000155552p-1, 0x1.f4a019f996e03p-55},
     {-0x1.3687a9f1af2b1p+2, -0x1.3b28139e9281cp-52},
     {0x1.6a09e667f3bcdp-4, -0x1.bdd28c3633116p-58}},
};

/// A number with two full words.
struct WideRandom {
  std::mt19937_64 engine{7};
  DD operator()() {
    std::normal_distribution<double> z;
    const double high = z(engine);
    return DD::quick_sum(high, high * 0x1p-53 * std::uniform_real_distribution<double>(-1, 1)(engine));
  }
};

}  // namespace

TEST_CASE("the four operations undo each other to a few units of 2^-104", "[core]") {
  WideRandom random;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const DD a = random(), b = random();
    worst = std::max(worst, off((a + b) - b, a) * std::abs(a.high) / std::max(std::abs(a.high), std::abs(b.high)));
    worst = std::max({worst, off(a * b / b, a), off(a / b * b, a), off(sqrt(abs(a)) * sqrt(abs(a)), abs(a))});
    worst = std::max(worst, off((a + b) * (a - b) + b * b, a * a) * std::min(1.0, std::pow(a.high / b.high, 2)));
    const DD s = a * b + a;
    CHECK(std::abs(s.low) <= std::abs(s.high) * 0x1p-52);
  }
  CHECK(worst < 16);
  CHECK(off(DD(1) / 3 * 3, 1) < 1);
  for (int i = 0; i < 1000; ++i) {  // of one word as of two
    const DD a = random();
    const double b = random().high;
    for (const auto& [mixed, whole] :
         {std::pair{a + b, a + DD(b)}, {b - a, DD(b) - a}, {a * b, a * DD(b)}, {a / b, a / DD(b)}})
      CHECK(off(mixed, whole) <= 4);
  }
  CHECK(off(DD(1) / 3, DD(0x1.5555555555555p-2, 0x1.5555555555555p-56)) < 1);
}

TEST_CASE("elementary functions of a double-double against sixty digits", "[core]") {
  for (const auto& row : elementary_rows) {
    CAPTURE(row.x.high);
    CHECK(off(exp(row.x), row.exponential) < 64 * std::max(1.0, std::abs(row.x.high)));
    CHECK(off(sin(row.x), row.sine) < 64);
    CHECK(off(cos(row.x), row.cosine) < 64);
    CHECK(off(log(abs(row.x)), row.logarithm) < 64);
    CHECK(off(sqrt(abs(row.x)), row.root) < 4);
    CHECK(off(asin(row.sine), asin(sin(row.x))) < 64);
    CHECK(off(hypot(3 * row.x, 4 * row.x), 5 * abs(row.x)) < 16);
    const DD angle = atan2(row.sine, row.cosine), turns = (row.x - angle) / (2 * pi<DD>);
    CHECK(abs(turns - nearbyint(turns)) < 64 * epsilon<DD> * std::max(1.0, std::abs(row.x.high)));
  }
  CHECK(abs(sin(pi<DD>)) < 2 * epsilon<DD>);
  CHECK(off(sin(DD(1e6) * pi<DD> + 1), sin(DD(1))) < 1e7);
}

TEST_CASE("whole numbers, signs and order of double-doubles look at both words", "[core]") {
  const DD above(3, 1e-20), below(3, -1e-20), half_up(2.5, 1e-20), half_down(2.5, -1e-20);
  CHECK(floor(above) == 3);
  CHECK(floor(below) == 2);
  CHECK(nearbyint(half_up) == 3);
  CHECK(nearbyint(half_down) == 2);
  CHECK(nearbyint(DD(1e17, 0.75)) == DD(1e17) + 1);
  CHECK((below < 3 && above > 3 && below <= above && above >= below && above != below));
  CHECK(copysign(above, DD(-2)) == -above);
  CHECK(abs(-above) == above);
  CHECK(ldexp(above, 3) == 8 * above);
  CHECK(static_cast<double>(above) == 3);
  CHECK(static_cast<int>(DD(7.9)) == 7);
  CHECK(static_cast<int>(DD(3, -1e-20)) == 2);
  CHECK(static_cast<int>(DD(-3, 1e-20)) == -2);
  CHECK(static_cast<int>(DD(3, 1e-20)) == 3);
  CHECK(DD(std::numeric_limits<std::int64_t>::max()) == DD(9223372036854775808.) - 1);
  CHECK(DD(std::numeric_limits<std::int64_t>::min()) == DD(-9223372036854775808.));
  CHECK(DD(std::numeric_limits<std::uint64_t>::max()) == DD(18446744073709551616.) - 1);
  CHECK(DD(9007199254740993LL) == DD(9007199254740992.) + 1);
}

TEST_CASE("double-doubles without a value behave as doubles do", "[core]") {
  const DD no = gyrostat::nan<DD>, endless = infinity<DD>;
  for (const DD& x : {no + 1, no * 0, no / 2, sqrt(no), exp(no), log(no), sin(no), hypot(no, DD(1)), sqrt(DD(-1)),
                      sin(endless), endless - endless, 0 * endless, DD(0) / 0})
    CHECK(isnan(x));
  CHECK(!(no < 1));
  CHECK(!(no >= 1));
  CHECK((endless + 1 == endless && endless * 2 == endless && DD(1) / endless == 0 && DD(1) / 0 == endless));
  CHECK((exp(DD(1000)) == endless && exp(DD(-1000)) == 0 && log(DD(0)) == -endless && sqrt(endless) == endless));
  CHECK((sqrt(DD(0)) == 0 && isinf(endless) && !isfinite(no) && isfinite(DD(1))));
}
