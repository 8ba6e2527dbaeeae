// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/periodic_family.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"

namespace gyrostat::heavy {

template Result<PeriodicOrbit<double>> periodic_orbit<double>(const Problem<double>&, double, double) noexcept;
template Result<PeriodicFamily<double>> periodic_family<double>(const Problem<double>&, double, double,
                                                                const FamilyOptions<double>&);

}  // namespace gyrostat::heavy
