// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/full_motion.hpp"
#include "gyrostat/models/deceleration/orbit.hpp"

namespace gyrostat::deceleration {

template class Orbit<double, math::Native>;
template void FullSystem<double, true, true>::expand<20>(double, double,
                                                         double (&)[21][FullSystem<double, true, true>::width],
                                                         FullSystem<double, true, true>::Work<20>&) const noexcept;
template void FullSystem<double, true, false>::expand<20>(double, double,
                                                          double (&)[21][FullSystem<double, true, false>::width],
                                                          FullSystem<double, true, false>::Work<20>&) const noexcept;
template void FullSystem<double, false, true>::expand<20>(double, double,
                                                          double (&)[21][FullSystem<double, false, true>::width],
                                                          FullSystem<double, false, true>::Work<20>&) const noexcept;
template void FullSystem<double, false, false>::expand<20>(double, double,
                                                           double (&)[21][FullSystem<double, false, false>::width],
                                                           FullSystem<double, false, false>::Work<20>&) const noexcept;

template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                              std::span<State<double>>,
                                                              const FullMotionOptions<double>&,
                                                              const Quat<double>*) noexcept;

}  // namespace gyrostat::deceleration

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::deceleration::FullSystem<double, true, false>>;
template class gyrostat::ode::Taylor<gyrostat::deceleration::FullSystem<double, false, false>>;
