// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/full_motion.hpp"

namespace gyrostat::deceleration {

template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                              std::span<State<double>>,
                                                              const FullMotionOptions<double>&,
                                                              const Quat<double>*) noexcept;

}  // namespace gyrostat::deceleration

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::deceleration::FullSystem<double, true, false>>;
template class gyrostat::ode::Taylor<gyrostat::deceleration::FullSystem<double, false, false>>;
