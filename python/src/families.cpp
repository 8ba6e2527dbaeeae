// SPDX-License-Identifier: BSD-3-Clause
// What the families give, from their tables: the one source of names, units and meanings for the package.
#include <pybind11/pybind11.h>

#include "bind.hpp"
#include "convert.hpp"
#include "gyrostat/ladder/deceleration/inputs.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/free/inputs.hpp"
#include "gyrostat/ladder/free/motion.hpp"
#include "gyrostat/ladder/general/motion.hpp"
#include "gyrostat/ladder/heavy/inputs.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/rotor/inputs.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/ladder/rung.hpp"
#include "gyrostat/ladder/spinning/inputs.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::python;

const char* word(Frame frame) {
  switch (frame) {
    case Frame::body: return "body";
    case Frame::inertial: return "inertial";
    case Frame::body_to_inertial: return "body to inertial";
    case Frame::body_to_orbit: return "body to orbit";
    case Frame::none: break;
  }
  return "";
}

const char* word(Measure measure) {
  switch (measure) {
    case Measure::relative: return "relative";
    case Measure::angle: return "angle";
    case Measure::absolute: return "absolute";
    case Measure::none: break;
  }
  return "";
}

const char* word(Kind kind) {
  switch (kind) {
    case Kind::number: return "number";
    case Kind::flag: return "flag";
    case Kind::place: return "place";
    case Kind::words: return "words";
    case Kind::word: break;
  }
  return "word";
}

template <class Kinds>
py::list values(const Kinds& kinds) {
  py::list made;
  for (const auto& kind : kinds) {
    py::dict item;
    item["name"] = kind.name;
    item["width"] = kind.width;
    item["unit"] = kind.unit;
    item["frame"] = word(kind.frame);
    item["measure"] = word(kind.measure);
    item["meaning"] = kind.meaning;
    if constexpr (requires { kind.scale; }) item["scale"] = kind.scale;
    item["kind"] = word(kind.kind);
    py::list words;
    for (const char* each : kind.words) words.append(each);
    item["words"] = py::tuple(words);
    made.append(item);
  }
  return made;
}

py::list families() {
  struct Entry {
    const Family* family;
    std::span<const InputKind> inputs;
  };
  py::list made;
  for (const auto& [family, inputs] :
       {Entry{&deceleration::tables, deceleration::input_kinds}, Entry{&rotor::tables, rotor::input_kinds},
        Entry{&spinning::tables, spinning::input_kinds}, Entry{&heavy::tables, heavy::input_kinds},
        Entry{&free::tables, free::input_kinds}, Entry{&general::tables, {}}}) {
    py::list rungs, warnings, integrators, keys;
    for (const RungKind& rung : family->rungs) {
      py::dict item;
      item["name"] = rung.name;
      item["meaning"] = rung.meaning;
      py::list lacks;
      for (std::size_t i = 0; i < family->columns.size(); ++i)
        if (has(rung.lacks, i)) lacks.append(family->columns[i].name);
      item["lacks"] = lacks;
      rungs.append(item);
    }
    const auto append = [&](const WarningKind& warning) {
      py::dict item;
      item["code"] = warning.code;
      item["text"] = warning.text;
      warnings.append(item);
    };
    for (const WarningKind& warning : family->warnings) append(warning);
    append(no_value);
    for (const char* name : family->integrators) integrators.append(name);
    py::dict item;
    item["name"] = family->name;
    item["columns"] = values(family->columns);
    item["scalars"] = values(family->scalars);
    item["rungs"] = rungs;
    item["integrators"] = integrators;
    item["warnings"] = warnings;
    for (const InputKind& input : inputs) keys.append(py::make_tuple(input.key, input.width, input.listed));
    item["inputs"] = keys;
    made.append(item);
  }
  return made;
}

}  // namespace

void bind_families(pybind11::module_& module) {
  module.def("families", &families,
             "What each family gives: columns, scalars, rungs (cheapest first), integrators and warnings; and the "
             "numbers of a "
             "row of a sweep.");
}
