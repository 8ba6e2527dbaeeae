// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/result.hpp"
#include "gyrostat/models/rotor/attractor.hpp"

/// How long V takes to fall when the rotor damps the motion little in one turn (docs/rotor.md, section 4): dV/dt = -<S x^2>, the mean over the
/// fast motion m' = m x J(l m - h e) on a level of F, with x from k x' + (S/lambda) x = -l n.m' in its periodic state.
namespace gyrostat::rotor {

/// Time in which V falls from one level of F to a lower one, s: an estimate, right to leading order in the coupling
/// kappa/D = lambda l q/(k D). start: the minimum or maximum `from_top` ... see the implementation.
/// into: index of the minimum whose valley is entered; from_lobe: index of the maximum whose lobe is left, used above the highest saddle.
/// Both levels between F of `into` and of `from_lobe`, these excluded.
template <Real Scalar>
Result<Scalar> time_between_levels(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady, Scalar momentum_norm,
                                   int from_lobe, int into, Scalar from, Scalar to) noexcept;

}  // namespace gyrostat::rotor
