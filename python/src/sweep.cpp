// SPDX-License-Identifier: BSD-3-Clause
// Sweeps over rows of scenes, of every family; gyrostat/sweeps.py wraps them.
#include "gyrostat/ladder/sweep.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "convert.hpp"
#include "elliptic_backend.hpp"
#include "general_arguments.hpp"
#include "gil.hpp"
#include "gyrostat/ladder/deceleration/inputs.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/ladder/free/inputs.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/ladder/general/custom_rung.hpp"
#include "gyrostat/ladder/general/inputs.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/heavy/inputs.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/ladder/rotor/inputs.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/ladder/spinning/inputs.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "question_arguments.hpp"

namespace gyrostat::python {

template <>
decltype(deceleration::Scene::full_equations) by_cvode<deceleration::Scene>() noexcept;
template <>
decltype(rotor::Scene::full_equations) by_cvode<rotor::Scene>() noexcept;
template <>
decltype(spinning::Scene::full_equations) by_cvode<spinning::Scene>() noexcept;
template <>
decltype(heavy::Scene::full_equations) by_cvode<heavy::Scene>() noexcept;
template <>
decltype(general::Scene::full_equations) by_cvode<general::Scene>() noexcept;

}  // namespace gyrostat::python

namespace {

using namespace gyrostat;
using namespace gyrostat::python;

/// The rows that are asked for, apart from the family.
struct Rows {
  const Array& numbers;
  const std::vector<std::size_t>& places;
  const Array& values;
  std::size_t count;
  unsigned threads;
  Monitor* monitor;
};

/// Arrays for the columns and scalars that the question asks for, and where they are.
class Tables {
 public:
  Tables(const Family& family, const Question& question, std::size_t rows, std::size_t rotors) {
    const bool all = question.asked.empty() && question.rung != any_rung;
    for (std::size_t place = 0; place < family.columns.size(); ++place) {
      const ColumnKind& kind = family.columns[place];
      const std::size_t width = kind.width == per_rotor ? rotors : std::size_t(kind.width);
      if (width == 0 || !(all || aim_of(question, family, false, place))) continue;
      std::vector<py::ssize_t> shape{py::ssize_t(rows), py::ssize_t(question.times.size())};
      if (kind.width != 1) shape.push_back(py::ssize_t(width));
      add(kind.name, place, false, width * question.times.size(), rows, std::move(shape));
    }
    for (std::size_t place = 0; place < family.scalars.size(); ++place) {
      const ScalarKind& kind = family.scalars[place];
      if (!question.asked.empty() && !aim_of(question, family, true, place)) continue;
      std::vector<py::ssize_t> shape{py::ssize_t(rows)};
      if (kind.width != 1) shape.push_back(kind.width);
      add(kind.name, place, true, std::size_t(kind.width), rows, std::move(shape));
    }
  }

  const std::vector<SweepTarget>& targets() const noexcept { return targets_; }
  const Data& values() const noexcept { return values_; }
  const Data& errors() const noexcept { return errors_; }

 private:
  void add(const char* name, std::size_t place, bool scalar, std::size_t width, std::size_t rows,
           std::vector<py::ssize_t> shape) {
    py::array_t<double> values(std::move(shape)), errors{py::ssize_t(rows)};
    targets_.push_back(
        {place, scalar, width, {values.mutable_data(), std::size_t(values.size())}, {errors.mutable_data(), rows}});
    values_[name] = values;
    errors_[name] = errors;
  }

  std::vector<SweepTarget> targets_;
  Data values_, errors_;
};

/// What is known of the rows beside their values: rung (-1: no answer), met, excess, warnings, and the place of the reason in `reasons`,
/// of which the first is empty.
void tell(Data& made, const std::vector<SweepRow>& told) {
  const auto n = py::ssize_t(told.size());
  py::array_t<std::int8_t> rung(n);
  py::array_t<bool> met(n);
  py::array_t<double> excess(n);
  py::array_t<std::uint32_t> warnings(n);
  py::array_t<std::int16_t> reason(n);
  std::vector<std::pair<const char*, int>> known{{nullptr, -1}};
  for (py::ssize_t i = 0; i < n; ++i) {
    const SweepRow& row = told[std::size_t(i)];
    rung.mutable_at(i) = std::int8_t(row.reason ? -1 : row.rung);
    met.mutable_at(i) = row.met;
    excess.mutable_at(i) = row.excess;
    warnings.mutable_at(i) = row.warnings;
    const std::pair why{row.reason, row.reason ? row.rung : -1};
    auto place = std::find(known.begin(), known.end(), why);
    if (place == known.end()) place = known.insert(known.end(), why);
    reason.mutable_at(i) = std::int16_t(place - known.begin());
  }
  made["rung"] = rung;
  made["met"] = met;
  made["excess"] = excess;
  made["warnings"] = warnings;
  made["reason"] = reason;
  py::list reasons;
  for (const auto& [why, refused_by] : known) reasons.append(py::make_tuple(why ? why : "", refused_by));
  made["reasons"] = reasons;
}

std::size_t rotors_of(const general::Scene& scene) { return scene.wheels().count; }
template <class Scene>
std::size_t rotors_of(const Scene& scene) {
  if constexpr (requires { scene.wheels(); }) return scene.wheels();
  else return 0;
}

/// The scene of a row, asked what the question asks.
template <class SceneOf>
struct Posed {
  const SceneOf& scene_of;
  const Question& question;
  bool cvode;

  auto operator()(std::span<const double> numbers) const {
    auto scene = scene_of(numbers, question);
    using Scene = std::remove_cvref_t<decltype(*scene)>;
    if constexpr (requires(Scene s) { s.full_equations; }) {
      if (!cvode || !scene) return scene;
      Scene made = std::move(scene).value();
      made.full_equations = by_cvode<Scene>();
      return Result<Scene>(std::move(made));
    } else {
      return scene;
    }
  }
  const char* why(std::span<const double> numbers) const
    requires requires { scene_of.why(numbers); }
  {
    return scene_of.why(numbers);
  }
};

/// The general scene of a row, a problem with other numbers; behind the first `count` of these there may be those of the error of the start.
struct GeneralOf {
  const general::Problem<double>& problem;
  std::size_t count;
  bool recognise, dop853;
  const std::optional<EulerAxes>& euler;

  Result<general::Scene> operator()(std::span<const double> numbers, const Question& question) const {
    const auto made = general::Scene::make(general::with_numbers(problem, numbers.first(count)), question, recognise);
    if (!made) return made;
    const auto off = numbers.subspan(count);
    for (const double each : off)
      if (!(each >= 0 && each < infinity<double>)) return Errc::not_finite;
    general::Scene scene = off.empty() ? *made : made->known_within({off[0], off[1], off[2], off[3], off[4], off[5]});
    if (euler) scene = scene.told_by(*euler);
    if (dop853) scene.full_equations = &general::full_by_dop853;
    return scene;
  }
  /// What must hold of the body; of a wheel or torque the words do not say which it is.
  const char* why(std::span<const double> numbers) const {
    const general::Fault fault = general::check(general::with_numbers(problem, numbers.first(count)));
    return fault && fault.place < 0 ? fault.why : nullptr;
  }
};

template <class SceneOf, class Solve>
Data rows_of(const Family& family, const SceneOf& scene_of, const Solve& solve, const Question& question, bool cvode,
             const Rows& rows) {
  const Posed<SceneOf> posed{scene_of, question, cvode};
  const std::span numbers(rows.numbers.data(), std::size_t(rows.numbers.size()));
  const auto first = posed(numbers);
  const auto& whole = checked(first);
  const Tables tables(family, whole.question(), rows.count, rotors_of(whole));
  std::vector<Varied> varied;
  for (std::size_t i = 0; i < rows.places.size(); ++i)
    varied.push_back({rows.places[i], {rows.values.data() + i * rows.count, rows.count}});
  std::vector<SweepRow> told(rows.count);
  {
    const Unlocked free;
    sweep(family, numbers, varied, posed, solve, tables.targets(), told, rows.threads, rows.monitor);
  }
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();  // what a signal has raised
  Data made;
  made["values"] = tables.values();
  made["errors"] = tables.errors();
  tell(made, told);
  return made;
}

/// The numbers of a general scene, and of what they are, one behind the other: name, how many.
py::typing::Tuple<py::array_t<double>, py::typing::List<py::typing::Tuple<py::str, py::int_>>> general_numbers(
    const Data& scene) {
  auto problem = general_problem(scene);
  std::vector<double> numbers;
  py::typing::List<py::typing::Tuple<py::str, py::int_>> names;
  general::visit_numbers(problem, [&](const general::InputName& name, const auto& value) {
    const std::size_t before = numbers.size();
    general::give(value, numbers);
    const std::string place = name.place < 0 ? "" : "[" + std::to_string(name.place) + "]";
    names.append(py::make_tuple(name.table + place + "." + name.key, numbers.size() - before));
  });
  const auto n = py::ssize_t(numbers.size());
  return py::make_tuple(array(std::move(numbers), {n}), names);
}

Data sweep_rows(const std::string& kind, const Array& numbers, const std::vector<std::size_t>& places,
                const Array& values, const Array& at, double tolerance, const std::string& model,
                const std::string& integrator, const std::string& elliptic, const Ask& ask, unsigned threads,
                const std::optional<std::shared_ptr<Monitor>>& monitor, const std::optional<Data>& scene,
                bool recognise, const std::optional<EulerAxes>& euler) {
  require_shape("numbers", numbers, {-1});
  require_shape("values", values, {py::ssize_t(places.size()), -1});
  for (const std::size_t place : places)
    if (place >= std::size_t(numbers.size()))
      raise("DomainError", "places: the scene has no number " + std::to_string(place));
  const Rows rows{numbers, places, values, std::size_t(values.shape(1)), threads, monitor ? monitor->get() : nullptr};
  const auto run = [&](const Family& family, auto scene_of, const auto& solve) {
    Question question = question_of(family, at, tolerance, model, ask);
    const bool cvode = takes_cvode(family, integrator, question);
    return rows_of(family, scene_of, solve, question, cvode, rows);
  };
  if (kind == "deceleration")
    return run(deceleration::tables, &deceleration::scene_of, elliptic_backend(elliptic).decelerate);
  if (kind == "rotor") return run(rotor::tables, &rotor::scene_of, rotor::SweepSolver{});
  if (kind == "spinning") return run(spinning::tables, &spinning::scene_of, &spinning::solve);
  if (kind == "heavy") return run(heavy::tables, heavy::SceneOf{}, &heavy::solve);
  if (kind == "free") return run(free::tables, &free::scene_of, free::SweepSolver{});
  if (kind == "general" && scene) {
    const auto problem = general_problem(*scene);
    const auto count = general_numbers(*scene)[0].cast<Array>().size();
    require_shape("numbers", numbers, {numbers.size() == count ? count : count + 6});
    return run(general::tables, GeneralOf{problem, std::size_t(count), recognise, integrator == "dop853", euler},
               &general::solve);
  }
  raise("DomainError", "kind = '" + kind + "': there is no such family");
}

}  // namespace

void bind_sweep(pybind11::module_& module) {
  module.def("sweep", &sweep_rows, py::kw_only(), py::arg("kind"), py::arg("numbers"), py::arg("places"),
             py::arg("values"), py::arg("times"), py::arg("tolerance"), py::arg("model"), py::arg("integrator"),
             py::arg("elliptic"), py::arg("ask"), py::arg("threads"), py::arg("monitor"), py::arg("scene") = py::none(),
             py::arg("recognise") = true, py::arg("euler") = py::none(),
             "Answers of the ladder to rows of scenes: `numbers` in the order of the family's inputs, those at "
             "`places` from `values` (k, n); of a general `scene` in that of general_numbers, and behind them, where "
             "there are more, the errors of the start: attitude, angular_velocity, rotor_rate, rotor_angle, velocity, "
             "position.");
  module.def("general_numbers", &general_numbers, py::arg("scene"),
             "The numbers of a general scene (n,), and name and width of what they are, in their order.");
}
