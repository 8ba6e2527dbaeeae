// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

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

  /// The row of a state.
  using Row = std::array<Scalar, std::size_t(row_width(Writer::columns))>;
  Row row(const State& state) const noexcept {
    Row made;
    writer_(state, made.data());
    return made;
  }
  /// The difference of two rows, column by column, in units of the columns.
  static ColumnErrors apart(const Row& first, const Row& second) noexcept {
    return each_column([&]<std::size_t i>() noexcept {
      constexpr int width = Writer::columns[i].width;
      const Scalar *x = first.data() + begins[i], *y = second.data() + begins[i];
      if constexpr (Writer::columns[i].measure == Measure::angle) {
        return angle_between(attitude<width>(x), attitude<width>(y));
      } else {
        Scalar between[width];
        for (int j = 0; j < width; ++j) between[j] = x[j] - y[j];
        return norm<width>(between);
      }
    });
  }

  void add(const State& first, const State& second) noexcept {
    const Row a = row(first);
    difference_.raise(apart(a, row(second)));
    add(a);
  }
  /// One motion alone: its sizes.
  void add(const State& state) noexcept { add(row(state)); }
  void add(const Row& row) noexcept {
    size_.raise(each_column([&]<std::size_t i>() noexcept {
      if constexpr (Writer::columns[i].measure == Measure::angle) return Scalar(1);
      else return norm<Writer::columns[i].width>(row.data() + begins[i]);
    }));
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
    for (std::size_t i = 0; i < count; ++i) errors[i] = unit(i) == 0 ? Scalar(0) : errors[i] * unit(i);
    return errors;
  }

 private:
  /// What `of.template operator()<i>()` gives for each column i: nothing about a column is looked up when a motion is compared.
  template <class Of>
  static ColumnErrors each_column(const Of& of) noexcept {
    return [&]<std::size_t... i>(std::index_sequence<i...>) noexcept {
      return ColumnErrors { {of.template operator()<i>()...} };
    }(std::make_index_sequence<count>{});
  }

  template <int width>
  static Scalar norm(const Scalar* x) noexcept {
    if constexpr (width == 1) return std::abs(x[0]);
    Scalar square = 0;
    for (int j = 0; j < width; ++j) square += x[j] * x[j];
    return std::sqrt(square);
  }
  /// From [x, y, z, w], as a row holds a quaternion, or from 3-1-2 angles.
  template <int width>
  static Quat<Scalar> attitude(const Scalar* x) noexcept {
    if constexpr (width == 4) return {x[3], x[0], x[1], x[2]};
    else return quaternion_from_312(x[0], x[1], x[2]);
  }

  static constexpr auto begins = [] {
    std::array<std::size_t, count> begin{};
    for (std::size_t i = 1; i < count; ++i) begin[i] = begin[i - 1] + std::size_t(Writer::columns[i - 1].width);
    return begin;
  }();

  Writer writer_;
  ColumnErrors difference_{}, size_{}, scale_{};
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
