// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/closed_form_rung_definition.hpp"
#include "gyrostat/ladder/free/full_rung_definition.hpp"
#include "gyrostat/ladder/free/scene_definition.hpp"
#include "gyrostat/ladder/free/solve_definition.hpp"
#include "gyrostat/ladder/free/track_definition.hpp"

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::free::FullSystem<double>>;

namespace gyrostat::free {

template void FullSystem<double>::expand<20>(double, double, double (&)[21][FullSystem<double>::width],
                                             FullSystem<double>::Work<20>&) const noexcept;

template Result<Motion<double>> Motion<double>::make<double>(const Problem<double>&) noexcept;
template Result<Motion<double>> Motion<double>::make<DoubleDouble>(const Problem<DoubleDouble>&) noexcept;
template double Motion<double>::defect(double, double) const noexcept;
template void Motion<double>::grid(double, double, std::size_t, double*, double*, double*) const noexcept;

template MotionError<double> MotionError<double>::of<DoubleDouble>(const Motion<double>&,
                                                                   const Assembly<double, Unbounded>&, Data,
                                                                   double) noexcept;
template std::optional<MotionError<double>> MotionError<double>::quick<math::many_pays>(
    const Motion<double>&, const Assembly<double, Unbounded>&, double) noexcept;
template std::optional<MotionError<double>> MotionError<double>::of_precession(const Motion<double>&,
                                                                               const Assembly<double, Unbounded>&,
                                                                               double) noexcept;
template MotionError<double>::Bound MotionError<double>::at(double) const noexcept;

template Result<Reduced<double>> Reduced<double>::of<double>(const Assembly<double>&, UnsoundWheel<double>*) noexcept;
template Reduced<double> Reduced<double>::taken<double>(const Assembly<double>&) noexcept;
template Reduced<DoubleDouble> Reduced<DoubleDouble>::taken<double>(const Assembly<double>&) noexcept;
template Reduced<DoubleDouble> Reduced<DoubleDouble>::taken<DoubleDouble>(const Assembly<DoubleDouble>&) noexcept;

}  // namespace gyrostat::free
