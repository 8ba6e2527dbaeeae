// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/models/heavy/exact.hpp"
#include "gyrostat/models/heavy/lagrange_gradient.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "gyrostat/models/heavy/lindstedt.hpp"
#include "gyrostat/models/heavy/series.hpp"

namespace gyrostat::heavy {

template class Series<double>;
template class LagrangeTop<double>;
template class LagrangeGradient<double>;
template class Exact<double>;
template class Lindstedt<double>;
template void FullSystem<double, true>::expand<20>(double, double, double (&)[21][FullSystem<double, true>::width],
                                                   FullSystem<double, true>::Work<20>&) const noexcept;
template void FullSystem<double, false>::expand<20>(double, double, double (&)[21][FullSystem<double, false>::width],
                                                    FullSystem<double, false>::Work<20>&) const noexcept;
template void VariationalSystem<double>::expand<20>(double, double, double (&)[21][VariationalSystem<double>::width],
                                                    VariationalSystem<double>::Work<20>&) const noexcept;

template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, const State<double>&,
                                                              std::span<const double>, std::span<State<double>>,
                                                              const FullMotionOptions<double>&) noexcept;

}  // namespace gyrostat::heavy

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::heavy::FullSystem<double, true>>;
template class gyrostat::ode::Taylor<gyrostat::heavy::FullSystem<double, false>>;
