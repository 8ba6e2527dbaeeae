// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/full_motion.hpp"

namespace gyrostat::general {

template Load<double> load_at<double>(const Problem<double>&, const Pose<double>&, double, double) noexcept;

template void FullSystem<double, true>::expand<20>(double, double, double (&)[21][FullSystem<double, true>::width],
                                                   FullSystem<double, true>::Work<20>&) const noexcept;
template void FullSystem<double, false>::expand<20>(double, double, double (&)[21][FullSystem<double, false>::width],
                                                    FullSystem<double, false>::Work<20>&) const noexcept;

template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                              std::span<State<double>>,
                                                              const FullMotionOptions<double>&) noexcept;
template BalanceAnswer<double> balance<double>(const Problem<double>&, double, double, bool, std::uint64_t) noexcept;

}  // namespace gyrostat::general

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::general::FullSystem<double, true>>;
template class gyrostat::ode::Taylor<gyrostat::general::FullSystem<double, false>>;
