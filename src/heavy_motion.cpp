// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/full_motion.hpp"

namespace gyrostat::heavy {

template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, const State<double>&,
                                                              std::span<const double>, std::span<State<double>>,
                                                              const FullMotionOptions<double>&) noexcept;

}  // namespace gyrostat::heavy

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::heavy::FullSystem<double, true>>;
template class gyrostat::ode::Taylor<gyrostat::heavy::FullSystem<double, false>>;
