// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/symmetric.hpp"

#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat {

template SymmetricEigen<float> symmetric_eigen<float>(const Mat3<float>&) noexcept;
template SymmetricEigen<double> symmetric_eigen<double>(const Mat3<double>&) noexcept;
template SymmetricEigen<long double> symmetric_eigen<long double>(const Mat3<long double>&) noexcept;
template SymmetricEigen<DoubleDouble> symmetric_eigen<DoubleDouble>(const Mat3<DoubleDouble>&) noexcept;

}  // namespace gyrostat
