// SPDX-License-Identifier: BSD-3-Clause
// Series, exact cases, periodic motions and stability of heavy bodies over rows; gyrostat/heavy.py wraps them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "gil.hpp"
#include "gyrostat/ladder/heavy/conversion_error.hpp"
#include "gyrostat/ladder/heavy/periodic_family.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/exact.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/hanging.hpp"
#include "gyrostat/models/heavy/regular_precession.hpp"
#include "gyrostat/models/heavy/series.hpp"
#include "gyrostat/models/heavy/sleeping_top.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"
#include "heavy_arguments.hpp"

namespace of_heavy {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::heavy;

/// The columns of motions at times, (rows, n, ...).
struct Motions {
  std::size_t rows, n;
  std::vector<double> rates, down, attitude;

  Motions(std::size_t bodies, std::size_t count)
      : rows(bodies),
        n(count),
        rates(rows * n * 3, missing),
        down(rates.size(), missing),
        attitude(rows * n * 4, missing) {}

  void put(std::size_t row, std::size_t i, const State<double>& s) {
    const std::size_t place = row * n + i;
    std::copy_n(s.angular_velocity.data(), 3, &rates[3 * place]);
    std::copy_n(s.down.data(), 3, &down[3 * place]);
    const double q[] = {s.attitude.x, s.attitude.y, s.attitude.z, s.attitude.w};
    std::copy_n(q, 4, &attitude[4 * place]);
  }
  void give(Data& made) {
    const auto r = py::ssize_t(rows), m = py::ssize_t(n);
    made["angular_velocity"] = array(std::move(rates), {r, m, 3});
    made["down"] = array(std::move(down), {r, m, 3});
    made["attitude"] = array(std::move(attitude), {r, m, 4});
  }
};

/// (rows,) or (rows, width) from a table of rows.
template <std::size_t width>
py::array_t<double> columns(std::vector<std::array<double, width>>& table) {
  std::vector<double> flat;
  flat.reserve(table.size() * width);
  for (const auto& row : table) flat.insert(flat.end(), row.begin(), row.end());
  return array(std::move(flat), {py::ssize_t(table.size()), py::ssize_t(width)});
}

py::list words(const std::vector<const char*>& texts) {
  py::list made;
  for (const char* text : texts) made.append(text);
  return made;
}

std::vector<double> moments_of_time(const Array& at) {
  require_shape("t", at, {-1});
  require_finite("t", at);
  return {at.data(), at.data() + at.size()};
}

/// The fast periodic motion of every row by series. order: even, or 0: what the tolerance wants until the farthest time.
Data series_rows(const HeavyBodies& bodies, const Array& spin, const Array& cosine, const Array& at, int order,
                 double tolerance) {
  const std::vector<double> t = moments_of_time(at);
  require_rows("spin", spin, bodies.size());
  require_rows("cos_inclination", cosine, bodies.size());
  double span = 0;
  for (const double time : t) span = std::max(span, std::abs(time));
  Motions motions(bodies.size(), t.size());
  std::vector<std::array<double, 8>> numbers;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const auto& body = bodies.rows()[row];
    const double r0 = spin.data()[row], G0 = cosine.data()[row];
    const auto made = order > 0 ? Series<double>::make(body, r0, G0, order)
                                : Series<double>::to_tolerance(body, r0, G0, tolerance, span);
    if (!made)
      raise(made.error(), bodies.label(py::ssize_t(row)) + "spin = " + text(r0) + ", cos_inclination = " + text(G0) +
                              ": " + message(made.error()));
    const Unlocked free;
    std::vector<State<double>> states(t.size());
    made->at(t, states);
    for (std::size_t i = 0; i < t.size(); ++i) motions.put(row, i, states[i]);
    const auto e = made->error(span), first = made->error(0);
    // what the series leave out of the start: no error of theirs means anything where that is great
    const double beyond =
        std::max(first.angular_velocity / std::abs(r0), first.down) < series_domain ? 0 : infinity<double>;
    numbers.push_back({double(made->order()), made->period(), made->period() * made->period_error() + beyond,
                       made->precession_rate(), made->precession_error() + beyond, e.angular_velocity + beyond,
                       e.down + beyond, e.attitude + beyond});
  }
  Data made;
  motions.give(made);
  made["numbers"] = columns(numbers);
  return made;
}

/// The period, s; of a top how its axis nods, least and greatest down along it, and its mean turn about the vertical, rad/s. NaN of what is none, or
/// is not resolved.
std::array<double, 4> periodic_numbers(const Exact<double>& motion) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (const auto* top = motion.top()) return {motion.period(), top->least(), top->greatest(), top->mean_precession()};
  if (const auto* top = motion.top_in_gradient()) {
    const bool resolved = top->resolves_period();
    return {resolved ? motion.period() : none, top->least(), top->greatest(), resolved ? top->mean_precession() : none};
  }
  return {motion.period(), none, none, none};
}

/// Bounds of the errors of an exact motion, with what rounding makes of a start whose down was an attitude. times: to compare at, s, the span last.
ExactError<double> error_of_exact(const HeavyBodies& bodies, std::size_t row, const Exact<double>& motion,
                                  const State<double>& start, bool oriented, const std::vector<double>& times) {
  const auto bound = motion.error(times.back());
  if (!oriented || !(bound.attitude < infinity<double>)) return bound;
  const int axis = motion.pendulum() ? motion.pendulum()->axis() : -1;
  return conversion_error(
      bodies.rows()[row], false, motion, times,
      [&](const Problem<double>&, int which) -> Result<State<double>> { return off_start(start, which, axis); });
}

/// The motion of every row by a closed form or a quadrature, NaN where there is none. down: or none, and that of the attitude counts.
Data exact_rows(const HeavyBodies& bodies, const Array& angular_velocity, const std::optional<Array>& down,
                const Array& attitude, const Array& at) {
  const std::vector<double> t = moments_of_time(at);
  const auto n = py::ssize_t(bodies.size());
  require_shape("angular_velocity", angular_velocity, {n, 3});
  if (down) require_shape("down", *down, {n, 3});
  require_shape("attitude", attitude, {n, 4});
  double span = 0;
  for (const double time : t) span = std::max(span, std::abs(time));
  std::vector<double> times;
  for (std::size_t i = 0; i < t.size(); i += 1 + t.size() / 32) times.push_back(t[i]);
  for (const double share : {-1.0, 0.25, 0.5, 0.75, 1.0}) times.push_back(share * span);
  Motions motions(bodies.size(), t.size());
  std::vector<const char*> which;
  std::vector<std::array<double, 7>> numbers;
  std::size_t row = 0;
  Errc wrong = Errc::ok;
  for (const Unlocked free; row < bodies.size(); ++row) {
    const double *w = angular_velocity.data() + 3 * row, *q = attitude.data() + 4 * row;
    State<double> given{{w[0], w[1], w[2]}, {0, 0, -1}, {q[3], q[0], q[1], q[2]}};
    if (down) given.down = Vec3<double>(down->data()[3 * row], down->data()[3 * row + 1], down->data()[3 * row + 2]);
    else if (norm(given.attitude) > 0)
      given.down = rotate<double>(conjugate(normalised(given.attitude)), Vec3<double>(0, 0, -1));
    const auto start = aligned<double>(given);
    if (!start) {
      wrong = start.error();
      break;
    }
    const Exact<double> motion(bodies.rows()[row], *start);
    which.push_back(symbol(motion.which()));
    const auto e = error_of_exact(bodies, row, motion, *start, !down, times);
    const auto [period, least, greatest, precession] = periodic_numbers(motion);
    numbers.push_back({period, e.angular_velocity, e.down, e.attitude, least, greatest, precession});
    if (!motion.applies()) continue;
    for (std::size_t i = 0; i < t.size(); ++i) motions.put(row, i, motion.at(t[i]));
  }
  if (wrong != Errc::ok) raise("DomainError", bodies.label(py::ssize_t(row)) + "start: " + message(wrong));
  Data made;
  motions.give(made);
  made["case"] = words(which);
  made["numbers"] = columns(numbers);
  return made;
}

SymmetricTop<double> top_of(const HeavyBodies& bodies, std::size_t row) {
  const auto top = SymmetricTop<double>::of(bodies.rows()[row]);
  if (!top)
    raise("DomainError", bodies.label(py::ssize_t(row)) +
                             "no axis of symmetry passes through the mass centre: two moments must be equal, and the "
                             "mass centre on the third axis");
  return *top;
}

/// (rows, 3) threshold, frequency squared, amplification; and the verdicts.
Data sleeping_rows(const HeavyBodies& bodies, const Array& spin,
                   const py::array_t<bool, py::array::c_style | py::array::forcecast>& axis_down) {
  require_rows("spin", spin, bodies.size());
  require_shape("axis_down", axis_down, {py::ssize_t(bodies.size())});
  std::vector<std::array<double, 3>> numbers;
  std::vector<const char*> verdicts;
  constexpr const char* names[] = {"stable", "unstable", "undecided"};
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const double r = spin.data()[row];
    const auto sleep = sleeping_top(top_of(bodies, row), axis_down.data()[row], r);
    numbers.push_back({sleep.threshold, sleep.frequency_square, sleep.amplification(r)});
    verdicts.push_back(names[int(sleep.verdict)]);
  }
  Data made;
  made["numbers"] = columns(numbers);
  made["verdict"] = words(verdicts);
  return made;
}

/// (rows, 2) slow and fast rate, NaN where there is none.
py::array_t<double> precession_rows(const HeavyBodies& bodies, const Array& cosine, const Array& spin) {
  require_rows("cos_inclination", cosine, bodies.size());
  require_rows("spin", spin, bodies.size());
  std::vector<std::array<double, 2>> numbers;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const double u = cosine.data()[row];
    if (!(std::abs(u) <= 1))
      raise("DomainError",
            bodies.label(py::ssize_t(row)) + "cos_inclination = " + text(u) + ": give a number in [-1, 1]");
    const auto rates = regular_precession(top_of(bodies, row), u, spin.data()[row]);
    numbers.push_back({rates.slow, rates.fast});
  }
  return columns(numbers);
}

/// (rows, 11): down of the least potential energy, two frequencies, two directions in which down swings.
py::array_t<double> hanging_rows(const HeavyBodies& bodies) {
  std::vector<std::array<double, 11>> numbers;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const auto made = hanging(bodies.rows()[row]);
    if (!made) raise("DomainError", bodies.label(py::ssize_t(row)) + "all orientations are alike: there is no torque");
    const auto &d = made->down, &a = made->swing[0], &b = made->swing[1];
    numbers.push_back({d[0], d[1], d[2], made->frequency[0], made->frequency[1], a[0], a[1], a[2], b[0], b[1], b[2]});
  }
  return columns(numbers);
}

constexpr const char* symbol_of(OrbitStability stability) noexcept {
  constexpr const char* names[] = {"stable", "unstable", "undecided"};
  return names[int(stability)];
}

/// What is reported of a periodic motion.
class Orbits {
 public:
  void add(const PeriodicOrbit<double>& o) {
    const auto &w = o.start.angular_velocity, &d = o.start.down;
    const auto& m = o.multipliers;
    numbers_.push_back({w[0], w[1], w[2], d[0], d[1], d[2], o.period, o.period * o.error.period, o.closure,
                        o.trace_minus_4, o.error.trace, m.first.re, m.first.im, m.second.re, m.second.im, m.turns});
    verdicts_.push_back(symbol_of(o.stability));
    methods_.push_back(o.method == OrbitMethod::shooting ? "shooting" : "continuation");
    why_.push_back("");
  }
  void add(Errc failure) {
    numbers_.emplace_back();
    numbers_.back().fill(missing);
    verdicts_.push_back("none");
    methods_.push_back("");
    why_.push_back(message(failure));
  }
  void give(Data& made) {
    made["numbers"] = columns(numbers_);
    made["verdict"] = words(verdicts_);
    made["method"] = words(methods_);
    made["why"] = words(why_);
  }

 private:
  std::vector<std::array<double, 16>> numbers_;
  std::vector<const char*> verdicts_, methods_, why_;
};

Data periodic_rows(const HeavyBodies& bodies, const Array& spin, const Array& cosine) {
  require_rows("spin", spin, bodies.size());
  require_rows("cos_inclination", cosine, bodies.size());
  Orbits orbits;
  {
    const Unlocked free;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
      const auto orbit = periodic_orbit(bodies.rows()[row], spin.data()[row], cosine.data()[row]);
      if (orbit) orbits.add(*orbit);
      else orbits.add(orbit.error());
    }
  }
  Data made;
  orbits.give(made);
  return made;
}

Data family_of(const HeavyBodies& bodies, double first_spin, double cosine, double last_spin, std::size_t most) {
  if (bodies.size() != 1) raise("DomainError", "one body is wanted here");
  FamilyOptions<double> options;
  options.last_spin = last_spin;
  options.most_members = most;
  Result<PeriodicFamily<double>> found = Errc::no_convergence;
  {
    const Unlocked free;
    found = periodic_family(bodies.rows().front(), first_spin, cosine, options);
  }
  if (!found)
    raise(found.error(), "first_spin = " + text(first_spin) + ", last_spin = " + text(last_spin) +
                             ", cos_inclination = " + text(cosine) + ": " + message(found.error()));
  Orbits orbits;
  for (const auto& member : found->members) orbits.add(member);
  constexpr const char* ends[] = {"spin-reached", "spin-zero", "homoclinic", "stalled", "member-limit"};
  Data made;
  orbits.give(made);
  made["end"] = ends[int(found->end)];
  py::list folds;
  for (const std::size_t i : found->folds) folds.append(i);
  made["folds"] = folds;
  return made;
}

/// (rows, 6): nu^2, its error, half width of the tongue, trace - 4, growth a turn, exponent; and the verdicts.
Data fast_stability_rows(const HeavyBodies& bodies, const Array& spin, const Array& cosine) {
  require_rows("spin", spin, bodies.size());
  require_rows("cos_inclination", cosine, bodies.size());
  std::vector<std::array<double, 6>> numbers;
  std::vector<const char*> verdicts;
  constexpr const char* names[] = {"stable", "unstable", "undecided"};
  std::size_t row = 0;
  Errc wrong = Errc::ok;
  for (const Unlocked free; row < bodies.size(); ++row) {
    const auto scaled = Scaled<double>::make(bodies.rows()[row], spin.data()[row], cosine.data()[row]);
    if (!scaled) {
      wrong = scaled.error();
      break;
    }
    const Floquet<double> floquet(*scaled);
    numbers.push_back({floquet.squared, floquet.squared_error, floquet.tongue, floquet.trace_minus_4, floquet.growth,
                       floquet.exponent()});
    verdicts.push_back(names[int(floquet.verdict)]);
  }
  if (wrong != Errc::ok)
    raise("DomainError", bodies.label(py::ssize_t(row)) + "spin = " + text(spin.data()[row]) +
                             ", cos_inclination = " + text(cosine.data()[row]) + ": " + message(wrong));
  Data made;
  made["numbers"] = columns(numbers);
  made["verdict"] = words(verdicts);
  return made;
}

}  // namespace
}  // namespace of_heavy

void bind_heavy_motions(pybind11::module_& module) {
  using namespace of_heavy;
  module.def(
      "heavy_series", &series_rows, py::arg("bodies"), py::kw_only(), py::arg("spin"), py::arg("cos_inclination"),
      py::arg("t"), py::arg("order"), py::arg("tolerance"),
      "The fast periodic motion of every row; numbers (rows, 8): order, period and its error, precession rate and "
      "its error, errors of rates, down and attitude.");
  module.def("heavy_exact", &exact_rows, py::arg("bodies"), py::kw_only(), py::arg("angular_velocity"), py::arg("down"),
             py::arg("attitude"), py::arg("t"),
             "The exact motion of every row; numbers (rows, 7): period, errors of rates, down and attitude, least and "
             "greatest down along the axis of a top, and its mean precession.");
  module.def("heavy_sleeping", &sleeping_rows, py::arg("bodies"), py::kw_only(), py::arg("spin"), py::arg("axis_down"),
             "Sleeping tops; numbers (rows, 3): threshold, frequency squared, amplification.");
  module.def("heavy_regular_precession", &precession_rows, py::arg("bodies"), py::kw_only(), py::arg("cos_inclination"),
             py::arg("spin"), "(rows, 2): slow and fast rate about down.");
  module.def("heavy_hanging", &hanging_rows, py::arg("bodies"),
             "(rows, 11): down at rest, two frequencies, two directions of the swing.");
  module.def(
      "heavy_periodic_orbits", &periodic_rows, py::arg("bodies"), py::kw_only(), py::arg("spin"),
      py::arg("cos_inclination"),
      "Periodic motions; numbers (rows, 16): rates and down at the start, period and its error, closure, trace - "
      "4 and its error, both multipliers (re, im), turns of the first.");
  module.def("heavy_periodic_family", &family_of, py::arg("body"), py::kw_only(), py::arg("first_spin"),
             py::arg("cos_inclination"), py::arg("last_spin"), py::arg("most_members"),
             "The family over the spin, one row a member as in heavy_periodic_orbits.");
  module.def("heavy_fast_stability", &fast_stability_rows, py::arg("bodies"), py::kw_only(), py::arg("spin"),
             py::arg("cos_inclination"),
             "Free nutations of fast spins; numbers (rows, 6): nu^2, its error, tongue, trace - 4, growth, exponent.");
}
