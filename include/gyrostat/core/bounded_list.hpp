// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/level.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// A list of at most `most` values that uses no heap. A value pushed onto a full list is dropped.
template <class T, std::size_t most>
class BoundedList {
 public:
  constexpr void push_back(const T& value) noexcept {
    if (size_ < most) values_[size_++] = value;
  }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr T& operator[](std::size_t i) noexcept { return values_[i]; }
  constexpr const T& operator[](std::size_t i) const noexcept { return values_[i]; }
  constexpr T& back() noexcept { return values_[size_ - 1]; }
  constexpr T* begin() noexcept { return values_.data(); }
  constexpr T* end() noexcept { return values_.data() + size_; }
  constexpr const T* begin() const noexcept { return values_.data(); }
  constexpr const T* end() const noexcept { return values_.data() + size_; }

 private:
  std::array<T, most> values_{};
  std::size_t size_ = 0;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
