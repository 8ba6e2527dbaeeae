// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A scene as a row of numbers, for callers that have scenes in tables: the inputs.hpp of each family lists the keys of its scene file
/// (`input_kinds`), and makes a scene of their numbers, one behind the other in the order of the list (`scene_of`). What a scene leaves
/// out is NaN.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// A key of the scene files and how many numbers it has.
struct InputKind {
  const char* key;  ///< with its table, such as "torque.control"
  int width;        ///< a tensor: 9, row after row; a choice: 1, its place among the choices; a quaternion: x, y, z, w
  bool listed = false;  ///< any number of elements, each of this width; the last of its table
};

/// Numbers in a row, without those of a list.
template <std::size_t N>
constexpr std::size_t input_width(const InputKind (&kinds)[N]) noexcept {
  std::size_t sum = 0;
  for (const InputKind& kind : kinds) sum += kind.listed ? 0 : std::size_t(kind.width);
  return sum;
}

/// Whether the key has a value in this scene.
inline bool is_given(double number) noexcept { return !std::isnan(number); }
inline bool is_given(const Vec3<double>& v) noexcept { return !std::isnan(v[0]); }
inline bool is_given(const Mat3<double>& m) noexcept { return !std::isnan(m(0, 0)); }
inline bool is_given(const Quat<double>& q) noexcept { return !std::isnan(q.x); }

/// Takes the values of a row one after the other. There must be as many as are taken.
class InputReader {
 public:
  explicit InputReader(std::span<const double> numbers) noexcept : next_(numbers.data()), left_(numbers.size()) {}

  std::size_t left() const noexcept { return left_; }

  double number() noexcept {
    --left_;
    return *next_++;
  }
  Vec3<double> vector() noexcept {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  /// A vector brought to unit length; one that has it to rounding, and one without length, stays as it is.
  Vec3<double> direction() noexcept {
    const Vec3<double> v = vector();
    const double length = magnitude(v);
    return std::abs(length - 1) <= 4 * epsilon<double> || !(length > 0) ? v : Vec3<double>(v / length);
  }
  /// An attitude brought to unit norm; one without length, which turns nothing, stays as it is.
  Quat<double> quaternion() noexcept {
    const double x = number(), y = number(), z = number(), w = number();
    const Quat<double> q{w, x, y, z};
    return norm(q) == 0 ? q : as_unit(q);
  }
  Mat3<double> tensor() noexcept {
    Mat3<double> made;
    for (int i = 0; i < 9; ++i) made(i / 3, i % 3) = number();
    return made;
  }
  /// An enumerator by its place among so many; nothing where there is none.
  template <class Word>
  std::optional<Word> choice(int words) noexcept {
    const double place = number();
    for (int i = 0; i < words; ++i)
      if (place == i) return static_cast<Word>(i);
    return std::nullopt;
  }

 private:
  const double* next_;
  std::size_t left_;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
