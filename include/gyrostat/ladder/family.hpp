// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "gyrostat/core/level.hpp"

/// What a family of scenes gives, as constant tables: its columns, scalars, warnings, rungs and integrators. Bindings, plots and
/// documentation read names, units and meanings from here.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// The axes that a column or scalar refers to.
enum class Frame : std::uint8_t {
  none,              ///< a number without direction
  body,              ///< components along the body axes
  inertial,          ///< components along the inertial axes
  body_to_inertial,  ///< a rotation that takes body components to inertial ones
  body_to_orbit,     ///< to those along the axes of the orbit
};

/// How the error of a column or scalar is measured.
enum class Measure : std::uint8_t {
  relative,  ///< norm of the difference over the scale of the column
  angle,     ///< angle of the rotation between the two attitudes, given as quaternions or as angles, rad
  absolute,  ///< the difference itself, in the unit
  none,      ///< it has no error: a word, a definition
};

/// What a value is.
enum class Kind : std::uint8_t {
  number,  ///< one number or a vector
  flag,    ///< 1 yes, 0 no, NaN not known
  place,   ///< an index into a list, NaN none
  word,    ///< a place in a list of names
  words,   ///< some of a list of names, a bit for the place of each
};

/// In place of a width: one number for each rotor of the scene.
inline constexpr int per_rotor = 0;

/// One output column: a row of `width` numbers at each time.
struct ColumnKind {
  const char* name;
  int width;  ///< or per_rotor
  const char* unit;
  Frame frame;
  Measure measure;
  const char* meaning;
  /// Measure::relative: what errors are relative to beside the greatest norm of the column, the greater of the two; the scene sets it.
  const char* scale = "";
  Kind kind = Kind::number;
  std::span<const char* const> words{};  ///< of Kind::word and Kind::words
};

/// One number, or one vector, about the whole motion.
struct ScalarKind {
  const char* name;
  int width;
  const char* unit;
  Frame frame;
  Measure measure;
  const char* meaning;
  Kind kind = Kind::number;
  std::span<const char* const> words{};  ///< of Kind::word and Kind::words
};

/// Something that the user should know: a code to test for and a sentence, to which the number that raised it is added.
struct WarningKind {
  const char* code;
  const char* text;
};
/// In a sweep of scenes that may be recognised as those of other families: one of their warnings.
inline constexpr const char* warning_of_family = "of-family";

/// A set of columns: one bit for the place of each.
using ColumnSet = std::uint32_t;

/// The set of these places, each below 32.
template <std::convertible_to<std::size_t>... Places>
constexpr ColumnSet column_set(Places... places) noexcept {
  return ((ColumnSet{1} << std::size_t{places}) | ... | ColumnSet{0});
}
/// Whether the column at `place`, below 32, is in the set.
constexpr bool has(ColumnSet set, std::size_t place) noexcept { return (set >> place & 1U) != 0; }

/// A model of the ladder, and what it is in a few words.
struct RungKind {
  const char* name;
  const char* meaning;
  ColumnSet lacks = 0;  ///< columns that it never gives
};

/// The tables of one family. Rungs stand cheapest first.
struct Family {
  const char* name;
  std::span<const ColumnKind> columns;
  std::span<const ScalarKind> scalars;
  std::span<const WarningKind> warnings;
  std::span<const RungKind> rungs;
  std::span<const char* const> integrators;
  ColumnSet unasked = 0;                         ///< columns that an answer lacks where nobody asks for them
  std::span<const std::size_t> asked_scalars{};  ///< scalars whose errors count where nobody says what is asked
};

/// Place of the row of a table with this name or code; -1 where there is none.
template <class Row>
constexpr int place_of(std::span<const Row> table, std::string_view name) noexcept {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if constexpr (requires { table[i].code; }) {
      if (table[i].code == name) return int(i);
    } else {
      if (table[i].name == name) return int(i);
    }
  }
  return -1;
}

/// Numbers in one row of all columns.
template <std::size_t N>
constexpr std::size_t row_width(const ColumnKind (&columns)[N]) noexcept {
  std::size_t sum = 0;
  for (const ColumnKind& column : columns) sum += std::size_t(column.width);
  return sum;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
