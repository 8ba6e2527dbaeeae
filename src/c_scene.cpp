// SPDX-License-Identifier: BSD-3-Clause
#include "c_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string_view>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/general/motion.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::c {
namespace {

using Numbers = std::span<const double>;
using Scene = gyrostat_scene;

using gyrostat::general::axes_words, gyrostat::general::between_words, gyrostat::general::opposed_words,
    gyrostat::general::torque_words, gyrostat::general::wheel_words;
constexpr const char* law_words[] = {"total", "carrier"};
constexpr const char* extend_words[] = {"zero", "hold"};

/// How many numbers a key takes.
enum class Shape : std::uint8_t { one, flag, three, direction, attitude, inertia, matrix, times, many, threes, pairs };

/// When a key must be set.
enum class Need : std::uint8_t {
  no,
  yes,         ///< always, or of a wheel or torque of the types that have it
  with_group,  ///< where another key with the same words before its last point is
  of_question  ///< where the motion is asked for
};

/// A set of types of wheels or torques.
using Types = unsigned;
template <class... Of>
constexpr Types types(Of... of) noexcept {
  return ((1U << unsigned(of)) | ... | 0U);
}
constexpr Types all = ~0U;

struct Key {
  std::string_view name;
  Shape shape;
  Need need;
  void (*put)(Scene&, Numbers);  ///< numbers that fit the shape
  Types of = all;                ///< the types of wheels or torques that have it
};

Vec3<double> vector(Numbers v) { return {v[0], v[1], v[2]}; }
/// Of unit length, whatever the size of the numbers.
Vec3<double> direction(Numbers v) {
  const Vec3<double> d = vector(v);
  return (d / d.cwiseAbs().maxCoeff()).normalized();
}
Mat3<double> matrix(Numbers v) {
  Mat3<double> made = Mat3<double>::Zero();
  for (int i = 0; i < 9; ++i) {
    if (v.size() == 9) made(i / 3, i % 3) = v[std::size_t(i)];
    else if (i / 3 == i % 3) made(i / 3, i / 3) = v[v.size() == 3 ? std::size_t(i / 3) : 0];
  }
  return made;
}
void assign(std::vector<double>& to, Numbers v) { to.assign(v.begin(), v.end()); }

general::Wheel<double>& wheel(Scene& s) { return s.problem.wheels.back(); }
general::Torque<double>& torque(Scene& s) { return s.problem.torques.back(); }
general::Orbit<double>& orbit(Scene& s) { return s.problem.orbit ? *s.problem.orbit : s.problem.orbit.emplace(); }
general::Field<double>& field(Scene& s, general::MagneticField kind) {
  s.problem.field.magnetic = kind;
  return s.problem.field;
}
void put_intervals(Scene& s, Numbers v) {
  std::vector<std::array<double, 2>> on;
  for (std::size_t i = 0; i < v.size(); i += 2) on.push_back({v[i], v[i + 1]});
  torque(s).factor.on = std::move(on);
}

using W = general::WheelType;
using T = general::TorqueType;
using F = general::MagneticField;

constexpr Types moving = all & ~types(W::locked), tabled = types(W::held, W::torque);
constexpr Types factored = all & ~types(T::table);

constexpr Key keys[] = {
    {"body.inertia", Shape::inertia, Need::yes, [](Scene& s, Numbers v) { s.problem.inertia = matrix(v); }},
    {"body.mass", Shape::one, Need::no, [](Scene& s, Numbers v) { s.problem.mass = v[0]; }},
    {"body.centre_of_mass", Shape::three, Need::no, [](Scene& s, Numbers v) { s.problem.centre_of_mass = vector(v); }},
    {"body.fixed", Shape::flag, Need::no, [](Scene& s, Numbers v) { s.problem.fixed = v[0] != 0; }},
    {"body.rotor_momentum", Shape::three, Need::no, [](Scene& s, Numbers v) { s.problem.rotor_momentum = vector(v); }},

    {"initial.attitude", Shape::attitude, Need::no,
     [](Scene& s, Numbers v) { s.problem.attitude = as_unit(Quat<double>{v[3], v[0], v[1], v[2]}); }},
    {"initial.angular_velocity", Shape::three, Need::of_question,
     [](Scene& s, Numbers v) { s.problem.angular_velocity = vector(v); }},
    {"initial.velocity", Shape::three, Need::no, [](Scene& s, Numbers v) { s.problem.velocity = vector(v); }},
    {"initial.position", Shape::three, Need::no, [](Scene& s, Numbers v) { s.problem.position = vector(v); }},
    {"initial.error.attitude", Shape::one, Need::no, [](Scene& s, Numbers v) { s.start_error.attitude = v[0]; }},
    {"initial.error.angular_velocity", Shape::one, Need::no,
     [](Scene& s, Numbers v) { s.start_error.angular_velocity = v[0]; }},
    {"initial.error.rotor_rate", Shape::one, Need::no, [](Scene& s, Numbers v) { s.start_error.rotor_rate = v[0]; }},
    {"initial.error.rotor_angle", Shape::one, Need::no, [](Scene& s, Numbers v) { s.start_error.rotor_angle = v[0]; }},
    {"initial.error.velocity", Shape::one, Need::no, [](Scene& s, Numbers v) { s.start_error.velocity = v[0]; }},
    {"initial.error.position", Shape::one, Need::no, [](Scene& s, Numbers v) { s.start_error.position = v[0]; }},

    {"wheel.axis", Shape::direction, Need::yes, [](Scene& s, Numbers v) { wheel(s).axis = direction(v); }},
    {"wheel.axial_inertia", Shape::one, Need::yes, [](Scene& s, Numbers v) { wheel(s).axial_inertia = v[0]; }},
    {"wheel.rate", Shape::one, Need::no, [](Scene& s, Numbers v) { wheel(s).rate = v[0]; }, moving},
    {"wheel.angle", Shape::one, Need::no, [](Scene& s, Numbers v) { wheel(s).angle = v[0]; }, moving},
    {"wheel.torque", Shape::one, Need::no, [](Scene& s, Numbers v) { wheel(s).torque = v[0]; }, types(W::torque)},
    {"wheel.friction", Shape::one, Need::no, [](Scene& s, Numbers v) { wheel(s).friction = v[0]; },
     types(W::torque, W::motor, W::friction)},
    {"wheel.slope", Shape::one, Need::yes, [](Scene& s, Numbers v) { wheel(s).slope = v[0]; }, types(W::motor)},
    {"wheel.no_load_rate", Shape::one, Need::yes, [](Scene& s, Numbers v) { wheel(s).no_load_rate = v[0]; },
     types(W::motor)},
    {"wheel.times", Shape::times, Need::no, [](Scene& s, Numbers v) { assign(wheel(s).table.times, v); }, tabled},
    {"wheel.values", Shape::many, Need::no, [](Scene& s, Numbers v) { assign(wheel(s).table.values, v); }, tabled},

    {"torque.torque", Shape::three, Need::yes, [](Scene& s, Numbers v) { torque(s).vector = vector(v); },
     types(T::constant)},
    {"torque.times", Shape::times, Need::yes, [](Scene& s, Numbers v) { assign(torque(s).table.times, v); },
     types(T::table)},
    {"torque.values", Shape::threes, Need::yes, [](Scene& s, Numbers v) { assign(torque(s).table.values, v); },
     types(T::table)},
    {"torque.matrix", Shape::matrix, Need::yes, [](Scene& s, Numbers v) { torque(s).matrix = matrix(v); },
     types(T::damping, T::eddy_current)},
    {"torque.limit", Shape::three, Need::yes, [](Scene& s, Numbers v) { torque(s).vector = vector(v); },
     types(T::brake)},
    {"torque.gradient", Shape::one, Need::no, [](Scene& s, Numbers v) { torque(s).gradient = v[0]; },
     types(T::gravity_gradient)},
    {"torque.dipole", Shape::three, Need::yes, [](Scene& s, Numbers v) { torque(s).vector = vector(v); },
     types(T::magnetic)},
    {"torque.force", Shape::three, Need::yes, [](Scene& s, Numbers v) { torque(s).vector = vector(v); },
     types(T::thrust)},
    {"torque.point", Shape::three, Need::no, [](Scene& s, Numbers v) { torque(s).point = vector(v); },
     types(T::thrust)},
    {"torque.momentum", Shape::three, Need::yes, [](Scene& s, Numbers v) { torque(s).vector = vector(v); },
     types(T::charge)},
    {"torque.on", Shape::pairs, Need::no, put_intervals},
    {"torque.factor.mean", Shape::one, Need::no, [](Scene& s, Numbers v) { torque(s).factor.mean = v[0]; }, factored},
    {"torque.factor.amplitude", Shape::one, Need::no, [](Scene& s, Numbers v) { torque(s).factor.amplitude = v[0]; },
     factored},
    {"torque.factor.rate", Shape::one, Need::no, [](Scene& s, Numbers v) { torque(s).factor.rate = v[0]; }, factored},
    {"torque.factor.phase", Shape::one, Need::no, [](Scene& s, Numbers v) { torque(s).factor.phase = v[0]; }, factored},
    {"torque.factor.times", Shape::times, Need::no,
     [](Scene& s, Numbers v) { assign(torque(s).factor.table.times, v); }, factored},
    {"torque.factor.values", Shape::many, Need::no,
     [](Scene& s, Numbers v) { assign(torque(s).factor.table.values, v); }, factored},

    {"orbit.radius", Shape::one, Need::with_group, [](Scene& s, Numbers v) { orbit(s).radius = v[0]; }},
    {"orbit.mu", Shape::one, Need::with_group, [](Scene& s, Numbers v) { orbit(s).mu = v[0]; }},
    {"orbit.eccentricity", Shape::one, Need::no, [](Scene& s, Numbers v) { orbit(s).eccentricity = v[0]; }},
    {"orbit.true_anomaly", Shape::one, Need::no, [](Scene& s, Numbers v) { orbit(s).true_anomaly = v[0]; }},
    {"orbit.radial", Shape::direction, Need::no, [](Scene& s, Numbers v) { orbit(s).radial = direction(v); }},
    {"orbit.along", Shape::direction, Need::no, [](Scene& s, Numbers v) { orbit(s).along = direction(v); }},

    {"field.gravity", Shape::one, Need::no, [](Scene& s, Numbers v) { s.problem.field.gravity = v[0]; }},
    {"field.down", Shape::direction, Need::no, [](Scene& s, Numbers v) { s.problem.field.down = direction(v); }},
    {"field.uniform", Shape::three, Need::no,
     [](Scene& s, Numbers v) { field(s, F::uniform).flux_density = vector(v); }},
    {"field.rotating.axis", Shape::direction, Need::with_group,
     [](Scene& s, Numbers v) { field(s, F::rotating).axis = direction(v); }},
    {"field.rotating.rate", Shape::one, Need::with_group,
     [](Scene& s, Numbers v) { field(s, F::rotating).rate = v[0]; }},
    {"field.rotating.vector", Shape::three, Need::with_group,
     [](Scene& s, Numbers v) { field(s, F::rotating).flux_density = vector(v); }},
    {"field.dipole.axis", Shape::direction, Need::with_group,
     [](Scene& s, Numbers v) { field(s, F::dipole).axis = direction(v); }},
    {"field.dipole.strength", Shape::one, Need::with_group,
     [](Scene& s, Numbers v) { field(s, F::dipole).strength = v[0]; }},
    {"field.dipole.radius", Shape::one, Need::with_group,
     [](Scene& s, Numbers v) { field(s, F::dipole).radius = v[0]; }},

    {"solve.times", Shape::times, Need::of_question, [](Scene& s, Numbers v) { assign(s.question.times, v); }},
    {"solve.tolerance", Shape::one, Need::no, [](Scene& s, Numbers v) { s.question.tolerance = v[0]; }},
    {"solve.recognise", Shape::flag, Need::no, [](Scene& s, Numbers v) { s.recognise = v[0] != 0; }},
};
static_assert(std::size(keys) <= 64);  // a bit each in GivenKeys

struct WordKey {
  std::string_view name;
  std::span<const char* const> words;
  void (*put)(Scene&, std::size_t place);
  Types of = all;
};

constexpr WordKey word_keys[] = {
    {"wheel.interpolation", between_words,
     [](Scene& s, std::size_t i) { wheel(s).table.between = general::Between(i); }, tabled},
    {"wheel.extend", extend_words, [](Scene& s, std::size_t i) { wheel(s).table.holds = i == 1; }, tabled},
    {"torque.frame", axes_words, [](Scene& s, std::size_t i) { torque(s).axes = general::Axes(i); },
     types(T::constant, T::table, T::thrust)},
    {"torque.against", opposed_words, [](Scene& s, std::size_t i) { torque(s).opposed = general::Opposed(i); },
     types(T::damping)},
    {"torque.law", law_words,
     [](Scene& s, std::size_t i) {
       torque(s).opposed = i == 0 ? general::Opposed::momentum : general::Opposed::carrier_momentum;
     },
     types(T::brake)},
    {"torque.interpolation", between_words,
     [](Scene& s, std::size_t i) { torque(s).table.between = general::Between(i); }, types(T::table)},
    {"torque.extend", extend_words, [](Scene& s, std::size_t i) { torque(s).table.holds = i == 1; }, types(T::table)},
    {"torque.factor.interpolation", between_words,
     [](Scene& s, std::size_t i) { torque(s).factor.table.between = general::Between(i); }, factored},
    {"torque.factor.extend", extend_words, [](Scene& s, std::size_t i) { torque(s).factor.table.holds = i == 1; },
     factored},
};

bool begins(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }
bool of_wheel(std::string_view key) { return begins(key, "wheel."); }
bool of_torque(std::string_view key) { return begins(key, "torque."); }
std::string_view group_of(std::string_view key) { return key.substr(0, key.rfind('.')); }

Outcome bad(std::string why) { return {GYROSTAT_BAD_ARGUMENT, std::move(why)}; }

template <class Row>
const Row* find(std::span<const Row> table, std::string_view name) {
  const auto at = std::find_if(table.begin(), table.end(), [&](const Row& row) { return row.name == name; });
  return at == table.end() ? nullptr : &*at;
}

template <class Row>
void list(std::vector<std::string>& names, std::span<const Row> table, std::string_view part, Types type) {
  for (const Row& row : table)
    if (begins(row.name, part) && (row.of & type) != 0) names.emplace_back(row.name);
}

/// The names of the keys that begin so, and that a type has.
std::string keys_of(std::string_view part, Types type) {
  std::vector<std::string> names;
  list<Key>(names, keys, part, type);
  list<WordKey>(names, word_keys, part, type);
  return one_of(names);
}

Outcome unknown_key(const char* key) {
  const std::string_view name = key;
  const std::string_view part = name.substr(0, name.find('.') + 1);
  const std::string known = part.empty() ? "" : keys_of(part, all);
  if (!known.empty()) return bad(std::string("there is no key ") + key + ": use " + known);
  return bad(std::string("there is no key ") + key +
             ": keys begin with body, initial, wheel, torque, orbit, field or solve");
}

/// Whether the scene has something that the key is of, and that this has such a key.
Outcome fits(const Scene& scene, std::string_view key, Types of) {
  const bool wheels = of_wheel(key), torques = of_torque(key);
  if (!wheels && !torques) return {};
  const std::string what = wheels ? "wheel" : "torque";
  if (wheels ? scene.problem.wheels.empty() : scene.problem.torques.empty())
    return bad(std::string(key) + ": there is no " + what + " yet; add one first by gyrostat_add");
  const auto place =
      wheels ? std::size_t(scene.problem.wheels.back().type) : std::size_t(scene.problem.torques.back().type);
  if ((of >> place & 1U) != 0) return {};
  return bad("a " + what + " of the type " + (wheels ? wheel_words : torque_words)[place] + " has no " +
             std::string(key) + ": use " + keys_of(what + ".", 1U << place));
}

/// Why so many numbers do not fit; "": they do.
std::string wrong_count(Shape shape, std::size_t n) {
  const auto wanted = [](bool right, const char* what) { return right ? std::string() : std::string("give ") + what; };
  switch (shape) {
    case Shape::one:
    case Shape::flag: return wanted(n == 1, "one number");
    case Shape::three:
    case Shape::direction: return wanted(n == 3, "3 numbers");
    case Shape::attitude: return wanted(n == 4, "4 numbers, a quaternion [x, y, z, w]");
    case Shape::inertia: return wanted(n == 3 || n == 9, "3 moments or a matrix of 9 numbers");
    case Shape::matrix: return wanted(n == 1 || n == 3 || n == 9, "1, 3 or 9 numbers");
    case Shape::times:
    case Shape::many: return wanted(n > 0, "at least one number");
    case Shape::threes: return wanted(n > 0 && n % 3 == 0, "three numbers for each time");
    case Shape::pairs: return wanted(n > 0 && n % 2 == 0, "pairs of begin and end");
  }
  return "";
}

/// Why numbers of the right count do not fit; "": they do.
std::string wrong_values(Shape shape, Numbers values) {
  for (const double x : values)
    if (!std::isfinite(x)) return "a number is NaN or infinite";
  const bool zero = std::all_of(values.begin(), values.end(), [](double x) { return x == 0; });
  if (shape == Shape::flag && values[0] != 0 && values[0] != 1) return "give 1 for yes or 0 for no";
  if (shape == Shape::direction && zero) return "it must not vanish";
  if (shape == Shape::attitude && zero) return "a quaternion must not vanish";
  for (std::size_t i = 1; shape == Shape::times && i < values.size(); ++i)
    if (!(values[i - 1] < values[i])) return "times must increase";
  return "";
}

/// Why values of this one key do not fit; "": they do.
std::string wrong_meaning(const Scene& scene, std::string_view key, Numbers values) {
  if (key == "solve.tolerance" && !(values[0] > 0 && values[0] < 1)) return "give a number in (0, 1)";
  if (key == "solve.times" && values[0] < 0) return "the first time must not be negative";
  if (begins(key, "initial.error.") && values[0] < 0) return "it must not be negative";
  constexpr std::string_view fields[] = {"", "field.uniform", "field.rotating", "field.dipole"};
  const auto set = fields[std::size_t(scene.problem.field.magnetic)];
  for (const std::string_view each : fields)
    if (!each.empty() && begins(key, each) && !set.empty() && set != each)
      return std::string(set) + " is set, and a scene has one magnetic field";
  return "";
}

GivenKeys bit_of(const Key& key) { return GivenKeys(1) << (&key - keys); }

Outcome missing(const Key& key, const std::string& where) {
  return {GYROSTAT_BAD_SCENE, where + std::string(key.name) + " is not set: give it by gyrostat_set"};
}

}  // namespace

Outcome add(gyrostat_scene& scene, const char* what, const char* type) {
  const std::string_view part = what;
  if (part != "wheel" && part != "torque")
    return bad(std::string("there is no ") + what + " to add: use wheel or torque");
  const bool wheels = part == "wheel";
  const std::span<const char* const> words = wheels ? std::span<const char* const>(wheel_words) : torque_words;
  const auto at = std::find(words.begin(), words.end(), std::string_view(type));
  if (at == words.end()) return bad(std::string("a ") + what + " has no type " + type + ": use " + one_of(words));
  const auto place = std::size_t(at - words.begin());
  // a refused call, for want of memory too, changes nothing
  auto& given = wheels ? scene.given_wheels : scene.given_torques;
  given.reserve(given.size() + 1);
  if (!wheels) {
    scene.problem.torques.emplace_back().type = T(place);
    if (T(place) == T::brake) scene.problem.torques.back().opposed = general::Opposed::momentum;
    scene.given_torques.push_back(0);
    return {};
  }
  if (scene.problem.wheels.size() == general::most_wheels)
    return bad("there are 8 wheels already, the most that a scene has");
  scene.problem.wheels.emplace_back().type = W(place);
  if (W(place) == W::locked) scene.problem.wheels.back().axial_inertia = 0;
  scene.given_wheels.push_back(0);
  return {};
}

Outcome set(gyrostat_scene& scene, const char* name, std::span<const double> values) {
  const Key* key = find<Key>(keys, name);
  if (key == nullptr) {
    const bool by_word = find<WordKey>(word_keys, name) != nullptr || std::string_view(name) == "solve.model";
    return by_word ? bad(std::string(name) + ": give a word, by gyrostat_set_word") : unknown_key(name);
  }
  if (auto wrong = fits(scene, key->name, key->of); wrong.code != GYROSTAT_OK) return wrong;
  std::string why = wrong_count(key->shape, values.size());
  if (why.empty()) why = wrong_values(key->shape, values);
  if (why.empty()) why = wrong_meaning(scene, key->name, values);
  if (!why.empty()) return bad(std::string(name) + ": " + why);
  key->put(scene, values);
  (of_wheel(name)    ? scene.given_wheels.back()
   : of_torque(name) ? scene.given_torques.back()
                     : scene.given) |= bit_of(*key);
  return {};
}

Outcome set_word(gyrostat_scene& scene, const char* name, const char* word) {
  if (std::string_view(name) == "solve.model") {
    const int place = place_of(general::tables.rungs, word);
    std::vector<std::string> models{"auto"};
    for (const RungKind& rung : general::tables.rungs) models.emplace_back(rung.name);
    if (place < 0 && std::string_view(word) != "auto")
      return bad(std::string("there is no model ") + word + ": use " + one_of(models));
    scene.question.rung = place < 0 ? any_rung : place;
    return {};
  }
  const WordKey* key = find<WordKey>(word_keys, name);
  if (key == nullptr)
    return find<Key>(keys, name) != nullptr ? bad(std::string(name) + ": give numbers, by gyrostat_set")
                                            : unknown_key(name);
  if (auto wrong = fits(scene, key->name, key->of); wrong.code != GYROSTAT_OK) return wrong;
  const auto at = std::find(key->words.begin(), key->words.end(), std::string_view(word));
  if (at == key->words.end()) return bad(std::string(name) + " cannot be " + word + ": use " + one_of(key->words));
  key->put(scene, std::size_t(at - key->words.begin()));
  return {};
}

Outcome ask(gyrostat_scene& scene, const char* name, double tolerance) {
  const int column = place_of(general::tables.columns, name), scalar = place_of(general::tables.scalars, name);
  if (column < 0 && scalar < 0) {
    std::vector<std::string> names;
    for (const ColumnKind& kind : general::tables.columns) names.emplace_back(kind.name);
    for (const ScalarKind& kind : general::tables.scalars) names.emplace_back(kind.name);
    return bad(std::string("there is no column or scalar ") + name + ": use " + one_of(names));
  }
  if (!(tolerance >= 0 && std::isfinite(tolerance)))
    return bad(std::string(name) + ": give a finite tolerance > 0, or 0 for solve.tolerance");
  const AskedQuantity made{std::size_t(column < 0 ? scalar : column), column < 0,
                           tolerance > 0 ? tolerance : nan<double>};
  auto& asked = scene.question.asked;
  const auto at = std::find_if(asked.begin(), asked.end(), [&](const AskedQuantity& each) {
    return each.place == made.place && each.scalar == made.scalar;
  });
  if (at == asked.end()) asked.push_back(made);
  else *at = made;
  return {};
}

Outcome drive(gyrostat_scene& scene, gyrostat_torque torque, void* data, std::span<const double> breakpoints) {
  if (!std::all_of(breakpoints.begin(), breakpoints.end(), [](double t) { return std::isfinite(t); }))
    return bad("a breakpoint is NaN or infinite");
  scene.breakpoints.assign(breakpoints.begin(), breakpoints.end());
  scene.torque = torque, scene.torque_data = data;
  return {};
}

Outcome complete(const gyrostat_scene& scene, bool with_question) {
  const auto lacks = [](GivenKeys given, const Key& key) { return (given & bit_of(key)) == 0; };
  for (const Key& key : keys) {
    if (of_wheel(key.name) && key.need == Need::yes) {
      for (std::size_t i = 0; i < scene.given_wheels.size(); ++i) {
        const auto type = scene.problem.wheels[i].type;
        const bool massless = type == W::locked && key.name == "wheel.axial_inertia";
        if ((key.of & types(type)) != 0 && !massless && lacks(scene.given_wheels[i], key))
          return missing(key, "of wheel " + std::to_string(i + 1) + " ");
      }
    } else if (of_torque(key.name) && key.need == Need::yes) {
      for (std::size_t i = 0; i < scene.given_torques.size(); ++i)
        if ((key.of & types(scene.problem.torques[i].type)) != 0 && lacks(scene.given_torques[i], key))
          return missing(key, "of torque " + std::to_string(i + 1) + " ");
    } else if (key.need == Need::yes || (key.need == Need::of_question && with_question)) {
      if (lacks(scene.given, key)) return missing(key, "");
    } else if (key.need == Need::with_group && lacks(scene.given, key)) {
      for (const Key& other : keys)
        if (group_of(other.name) == group_of(key.name) && !lacks(scene.given, other))
          return missing(key, std::string(other.name) + " is set and ");
    }
  }
  const auto given = [&](const char* name) { return !lacks(scene.given, *find<Key>(keys, name)); };
  for (std::size_t i = 0; i < scene.problem.torques.size(); ++i)
    if (scene.problem.torques[i].type == T::weight && scene.problem.fixed && !given("field.gravity"))
      return missing(*find<Key>(keys, "field.gravity"), "torque " + std::to_string(i + 1) + " is a weight, and ");
  for (std::size_t i = 0; i < scene.given_torques.size(); ++i) {
    const auto has = [&](const char* name) { return !lacks(scene.given_torques[i], *find<Key>(keys, name)); };
    if (has("torque.factor.times") && (has("torque.factor.mean") || has("torque.factor.rate")))
      return {GYROSTAT_BAD_SCENE,
              "of torque " + std::to_string(i + 1) + " the factor is a wave and a table: give one of them"};
  }
  for (std::size_t i = 0; i < scene.problem.wheels.size(); ++i)
    if (scene.problem.wheels[i].type == W::friction && lacks(scene.given_wheels[i], *find<Key>(keys, "wheel.friction")))
      return missing(*find<Key>(keys, "wheel.friction"), "of wheel " + std::to_string(i + 1) + " ");
  return {};
}

general::Problem<double> problem_of(const gyrostat_scene& scene) {
  general::Problem<double> made = scene.problem;
  made.mass_given = (scene.given & bit_of(*find<Key>(keys, "body.mass"))) != 0;
  const GivenKeys mean = bit_of(*find<Key>(keys, "torque.factor.mean"));
  const GivenKeys rate = bit_of(*find<Key>(keys, "torque.factor.rate"));
  for (std::size_t i = 0; i < made.torques.size(); ++i)
    if ((scene.given_torques[i] & (mean | rate)) == rate) made.torques[i].factor.mean = 0;
  if (!made.orbit) return made;
  const Vec3<double>& radial = made.orbit->radial;
  Vec3<double>& along = made.orbit->along;
  for (int trip = 0; trip < 2; ++trip) {  // the second drops what the first left of a direction that is nearly radial
    along -= along.dot(radial) * radial;
    if (!along.isZero(0)) along.normalize();
  }
  return made;
}

std::string fault_of(const general::Problem<double>& problem, Errc code) {
  const general::Fault of_wheel = general::check_wheels(problem), fault = general::check(problem);
  if (!fault) return message(code);
  if (fault.place < 0) return fault.why;
  return (of_wheel ? "wheel " : "torque ") + std::to_string(fault.place + 1) + ": " + fault.why;
}

}  // namespace gyrostat::c
