// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat {

/// The angle of the rotation between two attitudes, rad; the signs of the quaternions do not matter.
template <Real Scalar>
Scalar angle_between(const Quat<Scalar>& p, const Quat<Scalar>& q) noexcept {
  const Quat<Scalar> d = conjugate(p) * q;
  return 2 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w));
}

/// The distance of two motions, gathered time by time: greatest difference of each column, and its greatest norm in the first
/// motion. Writer: `Writer::columns` is the table of the columns, `writer(state, row)` writes a state's row, and `writer.scale`, where
/// it has one, holds the scales that the scene sets.
template <class Writer>
class Comparison {
 public:
  using Scalar = typename Writer::Scalar;
  using State = typename Writer::State;
  static constexpr std::size_t count = std::size(Writer::columns);
  using ColumnErrors = Errors<count, Scalar>;

  explicit Comparison(const Writer& writer) noexcept : writer_(writer) {
    for (std::size_t i = 0; i < count; ++i)
      if (Writer::columns[i].measure == Measure::angle) size_[i] = 1;
    if constexpr (requires { writer.scale; }) scale_ = writer.scale;
  }

  void add(const State& first, const State& second) noexcept {
    Scalar a[row_width(Writer::columns)], b[row_width(Writer::columns)];
    writer_(first, a);
    writer_(second, b);
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const ColumnKind& column = Writer::columns[i];
      const Scalar *x = a + at, *y = b + at;
      at += std::size_t(column.width);
      if (column.measure == Measure::angle) {
        difference_[i] = greater(angle_between(attitude(x, column), attitude(y, column)), difference_[i]);
        continue;
      }
      size_[i] = greater(norm(x, column), size_[i]);
      Scalar apart[3];
      for (int j = 0; j < column.width; ++j) apart[j] = x[j] - y[j];
      difference_[i] = greater(norm(apart, column), difference_[i]);
    }
  }
  /// One motion alone: its sizes.
  void add(const State& state) noexcept {
    Scalar row[row_width(Writer::columns)];
    writer_(state, row);
    const Scalar* x = row;
    for (std::size_t i = 0; i < count; x += Writer::columns[i++].width)
      if (Writer::columns[i].measure != Measure::angle) size_[i] = greater(norm(x, Writer::columns[i]), size_[i]);
  }

  /// In units of the columns.
  const ColumnErrors& difference() const noexcept { return difference_; }
  /// Greatest norms in the first motion; attitude: 1.
  const ColumnErrors& size() const noexcept { return size_; }

  /// What errors of a column are relative to: its size, or its scale where that is greater; 1 where they are not relative.
  Scalar unit(std::size_t column) const noexcept {
    return Writer::columns[column].measure == Measure::relative ? greater(size_[column], scale_[column]) : Scalar(1);
  }

  /// `errors` (in units of the columns) over the units; 0/0 = 0.
  ColumnErrors relative(ColumnErrors errors) const noexcept {
    for (std::size_t i = 0; i < count; ++i) errors[i] = over(errors[i], unit(i));
    return errors;
  }
  /// The other way round; 0 where the unit is.
  ColumnErrors absolute(ColumnErrors errors) const noexcept {
    for (std::size_t i = 0; i < count; ++i) errors[i] = unit(i) > 0 ? errors[i] * unit(i) : Scalar(0);
    return errors;
  }

 private:
  static Scalar norm(const Scalar* x, const ColumnKind& column) noexcept {
    return column.width == 3 ? Vec3<Scalar>(x[0], x[1], x[2]).norm() : std::abs(x[0]);
  }
  /// From [x, y, z, w], as a row holds a quaternion, or from 3-1-2 angles.
  static Quat<Scalar> attitude(const Scalar* x, const ColumnKind& column) noexcept {
    return column.width == 4 ? Quat<Scalar>{x[3], x[0], x[1], x[2]} : quaternion_from_312(x[0], x[1], x[2]);
  }

  Writer writer_;
  ColumnErrors difference_{}, size_{}, scale_{};
};

}  // namespace gyrostat
