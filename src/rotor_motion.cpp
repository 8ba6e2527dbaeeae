// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/models/rotor/linear_tail.hpp"

namespace gyrostat::rotor {

template class LinearTail<double>;
template void FullSystem<double>::expand<20>(double, double, double (&)[21][FullSystem<double>::width],
                                             FullSystem<double>::Work<20>&) const noexcept;

template Result<FullMotionAnswer<double>> full_motion<double>(const Gyrostat<double>&, const State<double>&,
                                                              std::span<const double>, std::span<State<double>>,
                                                              const FullMotionOptions<double>&) noexcept;

}  // namespace gyrostat::rotor

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::rotor::FullSystem<double>>;
