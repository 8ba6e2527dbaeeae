// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the free family, its permanent rotations and flips; gyrostat/free.py wraps it.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "answer.hpp"
#include "bind.hpp"
#include "free_arguments.hpp"
#include "gyrostat/ladder/free/motion.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/permanent.hpp"
#include "question_arguments.hpp"
#include "scene_arguments.hpp"

namespace of_free {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;

Data solve_scene(const Array& inertia, const Array& rotor_momentum, const Wheels& wheels,
                 const std::optional<Array>& angular_velocity, const std::optional<Array>& angular_momentum,
                 const Array& attitude, const std::optional<std::tuple<Array, Array, double>>& view, const Array& at,
                 double tolerance, const std::string& model, const std::string& integrator,
                 const std::optional<std::shared_ptr<Monitor>>& monitor, const Ask& ask) {
  const auto assembly = assembly_of(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude);
  Question question = question_of(free::tables, at, tolerance, model, ask);
  (void)takes_cvode(free::tables, integrator, question);
  std::optional<free::ViewRequest> seen;
  if (view) {
    const auto& [axis, direction, half_angle] = *view;
    seen = {vector("view.axis", axis), vector("view.direction", direction), half_angle};
  }
  free::UnsoundWheel<double> unsound;
  const auto scene = checked(sound(free::Scene::make(assembly, question, &unsound), assembly, unsound).viewed(seen));
  Refusal why;
  auto [answer, seconds] = watched(monitor, [&](Monitor* by) { return free::solve(scene, why, by); });
  require_answer(why);
  return to_python(answer, scene.question(), free::tables, seconds);
}

/// Body and wheels as one gyrostat: inertia (3, 3) less that of the wheels that turn freely, the momentum (3,) that the others keep, and M.
Data reduced(const Array& inertia, const Array& rotor_momentum, const Wheels& wheels,
             const std::optional<Array>& angular_velocity, const std::optional<Array>& angular_momentum,
             const Array& attitude) {
  const auto assembly = assembly_of(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude);
  free::UnsoundWheel<double> unsound;
  const auto p = sound(free::Reduced<double>::of(assembly, &unsound), assembly, unsound).problem;
  const Vec3<double> M = p.momentum();
  Data made;
  made["inertia"] = array(std::vector<double>(p.inertia.data(), p.inertia.data() + 9), {3, 3});  // symmetric
  made["rotor_momentum"] = array(std::vector<double>(p.rotor_momentum.data(), p.rotor_momentum.data() + 3), {3});
  made["angular_momentum"] = array(std::vector<double>(M.data(), M.data() + 3), {3});
  return made;
}

/// The permanent rotations at the scene's |M|: angular velocity (n, 3), energy, square of the frequency about each.
Data permanent(const Array& inertia, const Array& rotor_momentum, const Wheels& wheels,
               const std::optional<Array>& angular_velocity, const std::optional<Array>& angular_momentum,
               const Array& attitude) {
  const auto assembly = assembly_of(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude);
  free::UnsoundWheel<double> unsound;
  const auto p = sound(free::Reduced<double>::of(assembly, &unsound), assembly, unsound).problem;
  const auto found = checked(free::permanent_rotations(p, p.momentum().norm()));
  std::vector<double> rates, momenta, squares, energies;
  for (int i = 0; i < found.count; ++i) {
    const auto& one = found.rotation[i];
    for (int k = 0; k < 3; ++k) rates.push_back(one.angular_velocity[k]), momenta.push_back(one.angular_momentum[k]);
    squares.push_back(one.square);
    energies.push_back(one.angular_velocity.dot(p.inertia * one.angular_velocity) / 2);
  }
  const auto n = py::ssize_t(squares.size());
  Data made;
  made["angular_velocity"] = array(std::move(rates), {n, 3});
  made["angular_momentum"] = array(std::move(momenta), {n, 3});
  made["square"] = array(std::move(squares), {n});
  made["energy"] = array(std::move(energies), {n});
  return made;
}

/// Times at which M crosses the plane across a body axis.
py::array_t<double> flips(const Array& inertia, const Array& rotor_momentum, const Wheels& wheels,
                          const std::optional<Array>& angular_velocity, const std::optional<Array>& angular_momentum,
                          const Array& attitude, const Array& axis, double begin, double end) {
  const auto assembly = assembly_of(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude);
  free::UnsoundWheel<double> unsound;
  const auto sound_one = free::Reduced<double>::of(assembly, &unsound);
  sound(sound_one, assembly, unsound);
  const auto motion =
      checked(free::Motion<double>::make<DoubleDouble>(free::Reduced<DoubleDouble>::taken(assembly).problem));
  constexpr std::size_t most = 1000000;
  auto times = free::flips(motion, vector("axis", axis), begin, end, most + 1);
  if (times.size() > most)
    raise("DomainError", "there are more than a million flips until end: ask for a shorter span");
  const auto n = py::ssize_t(times.size());
  return array(std::move(times), {n});
}

}  // namespace
}  // namespace of_free

void bind_free(pybind11::module_& module) {
  using namespace of_free;
  module.def("free_solve", &solve_scene, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("wheels"), py::arg("angular_velocity"), py::arg("angular_momentum"), py::arg("attitude"),
             py::arg("view"), py::arg("times"), py::arg("tolerance"), py::arg("model"), py::arg("integrator"),
             py::arg("monitor"), py::arg("ask") = py::none(), "Answer of the ladder as plain data.");
  module.def("free_reduced", &reduced, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"), py::arg("wheels"),
             py::arg("angular_velocity"), py::arg("angular_momentum"), py::arg("attitude"),
             "Body and wheels as one gyrostat: inertia, rotor momentum and angular momentum at the start.");
  module.def("free_permanent", &permanent, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("wheels"), py::arg("angular_velocity"), py::arg("angular_momentum"), py::arg("attitude"),
             "Permanent rotations with the start's momentum, as columns.");
  module.def("free_flips", &flips, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"), py::arg("wheels"),
             py::arg("angular_velocity"), py::arg("angular_momentum"), py::arg("attitude"), py::arg("axis"),
             py::arg("begin"), py::arg("end"), "(n,) times at which M crosses the plane across a body axis [s].");
}
