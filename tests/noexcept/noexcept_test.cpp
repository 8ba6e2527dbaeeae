// SPDX-License-Identifier: BSD-3-Clause
// Every header in one program without exceptions and without run-time type information.
#include "gyrostat/gyrostat.hpp"

#include <cstdio>
#include <cstring>

#if defined(__cpp_exceptions) || defined(__cpp_rtti)
#error "this program shows that gyrostat needs neither exceptions nor run-time type information"
#endif

namespace {

int failures = 0;

void check(bool right, const char* what) {
  std::printf("%s %s\n", right ? "ok  " : "FAIL", what);
  if (!right) ++failures;
}

gyrostat::Result<double> refuse() { return gyrostat::Errc::out_of_domain; }

}  // namespace

int main() {
  check(std::strcmp(gyrostat::library_version(), gyrostat::header_version) == 0, "library and headers are of one version");
  check(refuse().error() == gyrostat::Errc::out_of_domain, "a failure comes back as a value");
  return failures == 0 ? 0 : 1;
}
