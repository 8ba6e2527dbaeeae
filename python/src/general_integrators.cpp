// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a general scene under one integrator at one setting, anew from each breakpoint on.
#include <optional>
#include <vector>

#include "bind.hpp"
#include "general_arguments.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "integrators.hpp"

// the library has them
extern template class gyrostat::ode::Taylor<gyrostat::general::FullSystem<double, true>>;
extern template class gyrostat::ode::Taylor<gyrostat::general::FullSystem<double, false>>;

namespace of_general {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::general;

/// A state, and the numbers that the integrator has for it.
template <Real Scalar>
struct Reached {
  State<Scalar> state;
  std::vector<Scalar> numbers;
};

template <Real Scalar_, bool large>
struct Motion {
  using Scalar = Scalar_;
  using System = FullSystem<Scalar, large>;

  const Prepared<Scalar>& of;
  const Piece<Scalar>& piece;
  typename System::Numbers from;
  System equations{of, piece, from};

  const System& system() const { return equations; }
  typename System::Numbers numbers() const { return from; }
  typename System::Numbers scale(Scalar) const { return equations.scale(); }
  Reached<Scalar> start() const { return state(piece.from, from.data()); }
  Reached<Scalar> state(Scalar t, const Scalar* x) const { return {equations.state(t, x), {x, x + System::width}}; }
};

/// Attitude, M, and p of the wheels that turn by themselves, each over its size.
struct Plain {
  static constexpr std::size_t width = 16;
  using Numbers = std::array<double, width>;
  using Equations = Flow<double>;

  Equations equations;
  double begin;
  Numbers from, size;

  Plain(const Prepared<double>& of, double begin_, double end, const std::vector<double>& numbers)
      : equations(of.problem, of.wheels), begin(begin_), size(ode::uniform<double, width>(1)) {
    equations.inside = begin + (end - begin) / 2;
    const double most = std::max(of.sizes.momenta, of.sizes.built);
    for (std::size_t i = Equations::momentum; i < width && most > 0; ++i) size[i] = most;
    if (numbers.size() == width) std::copy_n(numbers.begin(), width, from.begin());
    else from = scaled(equations.start());  // at the start, or those of a method that has no use for this
  }
  Numbers scaled(const Equations::Numbers& y) const noexcept {
    Numbers made;
    for (std::size_t i = 0; i < width; ++i) made[i] = y[i] / size[i];
    return made;
  }
  Equations::Numbers raw(const double* y) const noexcept {
    Equations::Numbers made{};
    for (std::size_t i = 0; i < width; ++i) made[i] = y[i] * size[i];
    return made;
  }
  Numbers numbers() const { return from; }
  Numbers absolute(double tolerance) const { return ode::uniform<double, width>(tolerance); }
  Reached<double> start() const { return state(begin, from.data()); }
  Reached<double> state(double t, const double* y) const { return {equations.state(t, raw(y)), {y, y + width}}; }
  void operator()(double t, const Numbers& y, Numbers& rate) const noexcept {
    Equations::Numbers made{};
    equations(t, raw(y.data()), made);
    rate = scaled(made);
  }
};

template <Real Scalar>
general::Table<Scalar> cast(const general::Table<double>& of) {
  return {{of.times.begin(), of.times.end()}, {of.values.begin(), of.values.end()}, of.between, of.holds};
}

template <Real Scalar>
Torque<Scalar> cast(const Torque<double>& of) {
  Torque<Scalar> made{of.type,
                      of.axes,
                      of.opposed,
                      of.vector.cast<Scalar>(),
                      of.point.cast<Scalar>(),
                      of.matrix.cast<Scalar>(),
                      of.gradient,
                      cast<Scalar>(of.table),
                      {}};
  for (const auto& [from, to] : of.factor.on) made.factor.on.push_back({Scalar(from), Scalar(to)});
  made.factor.table = cast<Scalar>(of.factor.table);
  made.factor.mean = of.factor.mean, made.factor.amplitude = of.factor.amplitude;
  made.factor.rate = of.factor.rate, made.factor.phase = of.factor.phase;
  return made;
}

template <Real Scalar>
Wheel<Scalar> cast(const Wheel<double>& of) {
  return {of.type,  of.axis.cast<Scalar>(), of.axial_inertia,      of.rate, of.angle, of.torque, of.friction,
          of.slope, of.no_load_rate,        cast<Scalar>(of.table)};
}

template <Real Scalar>
Problem<Scalar> cast(const Problem<double>& of) {
  Problem<Scalar> made;
  made.inertia = of.inertia.cast<Scalar>(), made.mass = of.mass, made.fixed = of.fixed;
  made.centre_of_mass = of.centre_of_mass.cast<Scalar>(), made.rotor_momentum = of.rotor_momentum.cast<Scalar>();
  for (const auto& wheel : of.wheels) made.wheels.push_back(cast<Scalar>(wheel));
  for (const auto& torque : of.torques) made.torques.push_back(cast<Scalar>(torque));
  if (const auto& orbit = of.orbit)
    made.orbit = Orbit<Scalar>{orbit->radius,
                               orbit->mu,
                               orbit->eccentricity,
                               orbit->true_anomaly,
                               orbit->radial.cast<Scalar>(),
                               orbit->along.cast<Scalar>()};
  const auto& field = of.field;
  made.field = {field.gravity,
                field.down.cast<Scalar>(),
                field.magnetic,
                field.flux_density.cast<Scalar>(),
                field.axis.cast<Scalar>(),
                field.rate,
                field.strength,
                field.radius};
  const auto& q = of.attitude;
  made.attitude = normalised(Quat<Scalar>{q.w, q.x, q.y, q.z});
  made.angular_velocity = of.angular_velocity.cast<Scalar>();
  made.velocity = of.velocity.cast<Scalar>(), made.position = of.position.cast<Scalar>();
  return made;
}

/// One piece by the method of the task, from `numbers`, those of the start where there are none.
template <bool large, Real Scalar, class Put>
Course over(const Prepared<Scalar>& of, const Piece<Scalar>& piece, const Task& task, std::vector<Scalar> numbers,
            Put&& put) {
  auto from = first_numbers<Scalar, large>(of);
  if (numbers.size() == from.size()) std::copy(numbers.begin(), numbers.end(), from.begin());
  const auto motion = [&] { return Motion<Scalar, large>{of, piece, from}; };
  if constexpr (std::is_same_v<Scalar, double>)
    return by_name(motion(), Plain(of, piece.from, piece.to, numbers), task, put);
  else return by_taylor<long_order>(motion(), task, put);
}

/// All pieces; put(i, state). A time at a breakpoint belongs to the piece behind it.
template <bool large, Real Scalar, class Put>
Course by_pieces(const Prepared<Scalar>& of, const Task& task, const Put& put) {
  const std::vector<Scalar> cuts = breakpoints(of.problem, of.span);
  const double end = thread_seconds() + task.patience;
  std::vector<Scalar> numbers;
  std::optional<Piece<Scalar>> piece;
  Course all;
  std::size_t first = 0;
  for (std::size_t k = 0; k <= cuts.size(); ++k) {
    const bool last = k == cuts.size();
    const Scalar to = last ? of.span : cuts[k];
    piece = piece ? Piece<Scalar>::behind(*piece, of.problem, of.wheels, of.torques, to)
                  : Piece<Scalar>::first(of.problem, of.wheels, of.torques, to);
    Task leg = task;
    leg.begin = double(piece->from);
    leg.patience = end - thread_seconds();
    if (!(leg.patience > 0)) return {all.counts, ode::Status::cancelled};
    const auto from = task.times.begin() + std::ptrdiff_t(first);
    leg.times.assign(from, last ? task.times.end() : std::lower_bound(from, task.times.end(), double(to)));
    const std::size_t rows = leg.times.size();
    if (!last) leg.times.push_back(double(to));
    const Course course = over<large>(of, *piece, leg, numbers, [&](std::size_t i, const Reached<Scalar>& reached) {
      if (i < rows) put(first + i, reached.state);
      else numbers = reached.numbers;
    });
    all.counts += course.counts;
    all.status = course.status;
    if (course.status != ode::Status::reached) break;
    first += rows;
  }
  return all;
}

Data integrate(const Data& scene, const Array& at, const std::string& method, int order, double tolerance,
               const std::string& precision, double patience) {
  const Task task = task_of(times(at), method, order, tolerance, precision, patience);
  const auto given = general_problem(scene);
  if (const Fault wrong = check(given)) raise_fault(given, wrong.code);
  python::Table table(task.times.size(), {{"attitude", 4}, {"angular_velocity", 3}});
  const auto run = [&]<Real Scalar>(Scalar) {
    const auto problem = cast<Scalar>(given);
    const auto put = [&](std::size_t i, const State<Scalar>& state) {
      table.put(0, i, xyzw(state.attitude));
      table.put(1, i, state.angular_velocity);
    };
    const auto [course, seconds] = timed([&] {
      const Prepared<Scalar> of(problem, Scalar(task.times.back()));
      return of.is_large() ? by_pieces<true>(of, task, put) : by_pieces<false>(of, task, put);
    });
    return std::move(table).data(course, seconds);
  };
  return task.long_double ? run(0.0L) : run(0.0);
}

}  // namespace
}  // namespace of_general

void bind_general_integrators(pybind11::module_& module) {
  using namespace of_general;
  module.def("general_integrate", &integrate, py::kw_only(), py::arg("scene"), py::arg("times"), py::arg("method"),
             py::arg("order") = 20, py::arg("tolerance"), py::arg("precision") = "double",
             py::arg("patience") = infinity<double>, "The full equations under one integrator, timed.");
}
