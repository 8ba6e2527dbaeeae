// SPDX-License-Identifier: BSD-3-Clause
// Elliptic integrals and functions: native against GSL and the standard library, one by one and over arrays. At the end
// the ratios of this run, from CPU times.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "gyrostat/math/elliptic.hpp"
#if defined(GYROSTAT_HAVE_GSL)
#include "gyrostat/math/gsl.hpp"
#endif

namespace {

using namespace gyrostat::math;

constexpr std::size_t count = 1024;

/// Random moduli, k2 uniform in (0, 1), and an argument for each in (-K, K).
struct Sample {
  std::vector<Modulus<double>> modulus;
  std::vector<double> k2, kp2, k, u;

  Sample() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    for (std::size_t i = 0; i < count; ++i) {
      modulus.push_back(Modulus<double>::from_k2(part(random)));
      k2.push_back(modulus.back().k2);
      kp2.push_back(modulus.back().kp2);
      k.push_back(std::sqrt(k2.back()));
      u.push_back((2 * part(random) - 1) * complete(modulus.back()).K);
    }
  }
};

const Sample& sample() {
  static const Sample one;
  return one;
}

template <class Function>
void each(benchmark::State& state, Function f) {
  const Sample& s = sample();
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) benchmark::DoNotOptimize(f(s, i));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

double sum(const Complete<double>& x) { return x.K + x.E; }
double sum(const Means<double>& x) { return x.K + x.F + x.W + x.V; }
double sum(const Jacobi<double>& x) { return x.sn + x.cn + x.dn; }

void array_native(benchmark::State& state) {
  const Sample& s = sample();
  std::vector<double> K(count), E(count);
  for (auto _ : state) {
    complete(s.k2.data(), s.kp2.data(), K.data(), E.data(), count);
    benchmark::DoNotOptimize(K.data());
    benchmark::DoNotOptimize(E.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void fixed_modulus(benchmark::State& state, double k2) {
  const JacobiAt<double> at(Modulus<double>::from_k2(k2));
  each(state, [&](const Sample& s, std::size_t i) { return sum(at(s.u[i])); });
}

/// Keeps the CPU time of one call of each benchmark.
class Keeper : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && run.iterations > 0)
        keep(run.benchmark_name(), run.cpu_accumulated_time / static_cast<double>(run.iterations) / count * 1e9);
    }
  }

  /// The least of the repetitions, against the noise of a shared machine.
  double time(const std::string& name) const {
    const auto found = time_.find(name);
    return found == time_.end() ? 0 : found->second;
  }

 private:
  void keep(std::string name, double ns) {
    name = name.substr(0, name.find("/repeats"));
    const auto [at, fresh] = time_.emplace(name, ns);
    if (!fresh && ns < at->second) at->second = ns;
  }

  std::map<std::string, double> time_;
};

void add() {
  const auto with = [](const char* name, auto f) {
    benchmark::RegisterBenchmark(name, [f](benchmark::State& state) { each(state, f); })->Repetitions(3);
  };
  with("K+E native", [](const Sample& s, std::size_t i) { return sum(complete(s.modulus[i])); });
  benchmark::RegisterBenchmark("K+E native array", array_native)->Repetitions(3);
  with("K+E std",
       [](const Sample& s, std::size_t i) { return std::comp_ellint_1(s.k[i]) + std::comp_ellint_2(s.k[i]); });
  with("means native", [](const Sample& s, std::size_t i) { return sum(means(s.modulus[i])); });
  with("sn cn dn native", [](const Sample& s, std::size_t i) { return sum(jacobi(s.u[i], s.modulus[i])); });
  with("zeta native", [](const Sample& s, std::size_t i) { return zeta(s.u[i], s.modulus[i]); });
  with("F(phi) native", [](const Sample& s, std::size_t i) { return incomplete_F(s.u[i], s.modulus[i]); });
  with("F(phi) std", [](const Sample& s, std::size_t i) { return std::ellint_1(s.k[i], s.u[i]); });
  for (double k2 : {0.3, 0.7}) {
    const std::string name = "sn cn dn native, k2 = " + std::to_string(k2).substr(0, 3);
    benchmark::RegisterBenchmark(name.c_str(), [k2](benchmark::State& state) {
      fixed_modulus(state, k2);
    })->Repetitions(3);
  }
#if defined(GYROSTAT_HAVE_GSL)
  with("K+E GSL", [](const Sample& s, std::size_t i) {
    return gsl_sf_ellint_Kcomp(s.k[i], GSL_PREC_DOUBLE) + gsl_sf_ellint_Ecomp(s.k[i], GSL_PREC_DOUBLE);
  });
  with("K+E GSL Carlson", [](const Sample& s, std::size_t i) { return sum(Gsl::complete(s.modulus[i])); });
  with("means GSL Carlson", [](const Sample& s, std::size_t i) { return sum(Gsl::means(s.modulus[i])); });
  with("sn cn dn GSL", [](const Sample& s, std::size_t i) {
    double sn = 0, cn = 0, dn = 0;
    gsl_sf_elljac_e(s.u[i], s.k2[i], &sn, &cn, &dn);
    return sn + cn + dn;
  });
  with("zeta GSL", [](const Sample& s, std::size_t i) { return Gsl::zeta(s.u[i], s.modulus[i]); });
  with("F(phi) GSL", [](const Sample& s, std::size_t i) { return gsl_sf_ellint_F(s.u[i], s.k[i], GSL_PREC_DOUBLE); });
#endif
}

void compare(const Keeper& keeper, const char* ours, const char* theirs) {
  const double a = keeper.time(ours), b = keeper.time(theirs);
  if (a > 0 && b > 0) std::printf("%-28s %8.2f ns   %-20s %8.2f ns   ratio %6.1f\n", ours, a, theirs, b, b / a);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  add();
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  std::printf("\n");
  for (const char* theirs : {"K+E GSL", "K+E GSL Carlson", "K+E std"}) {
    compare(keeper, "K+E native", theirs);
    compare(keeper, "K+E native array", theirs);
  }
  compare(keeper, "means native", "means GSL Carlson");
  for (const char* ours : {"sn cn dn native", "sn cn dn native, k2 = 0.3", "sn cn dn native, k2 = 0.7"})
    compare(keeper, ours, "sn cn dn GSL");
  compare(keeper, "zeta native", "zeta GSL");
  compare(keeper, "F(phi) native", "F(phi) GSL");
  compare(keeper, "F(phi) native", "F(phi) std");
  return 0;
}
