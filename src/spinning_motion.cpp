// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/models/spinning/block_grid.hpp"
#include "gyrostat/models/spinning/mode_grid.hpp"

namespace gyrostat::spinning {

template class BlockGrid<double>;
template class ModeGrid<double>;
template void FullSystem<double>::expand<20>(double, double, double (&)[21][FullSystem<double>::width],
                                             FullSystem<double>::Work<20>&) const noexcept;

template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                              std::span<State<double>>,
                                                              const FullMotionOptions<double>&) noexcept;

}  // namespace gyrostat::spinning

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::spinning::FullSystem<double>>;
