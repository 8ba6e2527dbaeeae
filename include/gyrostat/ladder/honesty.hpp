// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "gyrostat/core/real.hpp"

/// The constants behind the error estimates of the full equations, in one place (docs/errors.md has what was measured with them). The
/// answer is compared with companions: runs of neighbours, whose data differ by a few roundings, in tighter steps.
namespace gyrostat::honesty {

/// What the estimate of the full equations stands on, the same in every family.
struct Companions {
  double tighter;      ///< step tolerance of the answer over that of a companion
  double data_change;  ///< by how much the data of a companion differ, roundings
  double margin;       ///< of the greatest distance of the answer and its companions from each other
};

/// All families, watched in every step, all components perturbed. The distance from the answer shows its truncation, that between the companions the effect
/// of rounding, and either may be small by chance (error_of_distances).
inline constexpr Companions side_by_side{64, 2, 5};
/// The roundings of the steps add up as the square root of their number; the runs may share this part of the sum. Chosen: with all of it, and four
/// times the roundings of an evaluation, general scenes stated twice as much at 1e-11, and no error came near.
inline constexpr double shared_steps = 1.0 / 8;
/// Directions in which the data vectors of the two companions are changed: orthogonal, and as far apart along every axis as orthogonal ones
/// can be (0.82). Next to a steady rotation, where one number decides, the second lies opposite the first (second_aside): of 2400 driven rotors that leave a saddle the
/// least stated over true was 2.0 so, and 0.5 with these, at the same median.
inline constexpr double directions[2][3] = {{0.90, -0.12, 0.42}, {0.12, -0.90, -0.42}};
/// By how much the moments of a diagonal tensor differ in two companions: in neither two of them nearly alike, or what hangs on the difference of two moments
/// that are nearly equal would err alike in all runs; and no moment nearly alike in both. Chosen: with two that were 0.2 apart 198 of 240 answers of a body, symmetric but for 1e-7 about axis 2, had stated up to 20 times too little.
inline constexpr double moment_shifts[2][3] = {{-0.8, 0.1, 0.9}, {0.1, 0.9, -0.8}};
/// By how much the tensor of a companion differs where it is not diagonal, over its greatest moment: elements 11, 22, 33, 12, 13, 23; none nearly alike in both.
inline constexpr double tensor_shifts[2][6] = {{0.9, -0.8, 0.3, -0.6, 0.8, 0.5}, {0.3, 0.8, 0.9, 0.6, 0.2, -0.5}};
/// By how much single numbers of the data differ, one behind the other, in two companions: what truncation makes of a number cannot be near to what its change
/// makes in both, and yet the two are nearly orthogonal.
inline constexpr double number_shifts[2][11] = {{1.0, -0.6, 0.4, -0.6, 1.0, 0.6, -0.4, 0.6, -1.0, -0.6, 0.6},
                                                {0.4, 0.6, 1.0, 0.6, 0.4, -0.6, -1.0, -0.6, -0.4, 0.6, -0.6}};
/// General scenes: half the angle by which the attitude of a companion is turned, over the change of its data. With a quarter of it 92 of 993 bodies at rest in an unstable
/// balance stated too little, as turns so small round away; with half of it and less where products are small 4 of 972; so 1 of 8634 of twelve such kinds.
inline constexpr double attitude_turn = 2;
/// And as many times the products of the components of the attitude, up to 1: where they vanish, vectors turn without rounding. Chosen: so, only turns below a tenth of a radian are lessened.
inline constexpr double attitude_products = 8;
/// General scenes: motions whose attitudes have come further apart than this have parted, rad: their distance fades no more. Chosen: over 1500 random scenes the medians stayed.
inline constexpr double parted_attitude = 0.5;
/// By how much the data of a lone companion differ, roundings: more, as in its one direction it may be near by chance.
inline constexpr double alone_change = 32;
/// At half the span a lone companion is kicked by so many roundings of each number: the effect of its data may cancel the truncation
/// by chance, at the end or on the way, but not both with the kick and without. Not in general scenes.
inline constexpr double kick = 64;
/// Step tolerance, roundings times the condition of the tensor, below which rounding rules, and a second companion runs along.
inline constexpr double rounding_below = 1 << 20;

/// The longest step of the first companion, over that of the answer at the same place. Its tolerance alone mostly keeps it shorter; but where a mode decays
/// faster than the body turns, as with a fast wheel motor, that mode and no tolerance sets the steps, and all runs had the same truncation: of
/// 43 000 driven rotors 799 had stated too little, by up to 95 times.
inline constexpr double companion_stride = 0.85;
/// The same under waves, fields that move or an orbit: where products of waves come to the same phases in every step the errors of the steps add up, and a
/// companion whose steps did so was as wrong as the answer. Of 6500 bodies under fast waves 8 had stated up to 5 times too little with 0.85, none with 0.7.
inline constexpr double forced_stride = 0.7;
/// No two steps of the companion are alike: their longest lengths, over those of the answer, lie between these and so much less. In steps that come to the same phases of
/// the motion again and again truncation adds up: under damping and a gravity gradient a companion with a 64th of the tolerance was as wrong as
/// the answer, which at 38 of 150 late times had stated up to 1.8 times too little.
inline constexpr double stride_spread = 0.2;

/// Collocation: margin of a companion's error inside the step that holds an asked time, as its last coefficients show it; answer and companion may
/// err alike there, where a jump of the data sets the steps of both.
inline constexpr double margin_between = 2;

/// Collocation: the pace of a companion (RadauOptions::pace). Ends of steps err as the sixteenth power of the length, inside as the ninth.
inline constexpr double companion_pace = 0.7;

/// A distance that was seen fades while the body turns through this angle to one half, rad: twenty turns.
inline constexpr double fading_angle = 128;

/// The runs are compared at the end of every step, at the first and the last asked time in each step of the answer, and at so many of the asked times, or at all if fewer.
inline constexpr double compared_times = 64;
/// At so many of the first asked times they are compared in any case: what a first step errs on its way may be gone at its end.
inline constexpr double first_compared = 16;
/// Whether the runs are compared at the asked time `i` of so many.
constexpr bool is_compared(std::size_t i, std::size_t times) noexcept {
  return i < std::size_t(first_compared) || i % (1 + times / std::size_t(compared_times)) == 0;
}
/// After so many steps they are compared at the ends of one in `end_share`, chosen so that no periodic motion keeps in step with them.
inline constexpr std::uint32_t first_ends = 64, end_share = 4;
/// Whether the runs are compared at the end of this step of the first companion, counted from 0.
constexpr bool is_compared_at_end(std::uint64_t step) noexcept {
  constexpr std::uint32_t golden = 2654435769U;  // multiples of it are spread over the words
  return step < first_ends || std::uint32_t(step) * golden < ~std::uint32_t(0) / end_share;
}

/// Deceleration: errors decrease with the motion, and a distance fades so many times as fast.
inline constexpr double stop_fading_factor = 8;
/// Deceleration: the part of the way to the stop that one step of the answer may go at most, and of its companions. It rules the first
/// steps of loose tolerances, whose truncation sinks as its power: of companions that went as far one step in some thousand erred alike.
inline constexpr double reach = 0.3, companion_reach = 0.25, second_reach = 0.24;

/// First guess of the step tolerance over the tolerance asked for, before the turns count. Steps that err far less than is asked lose
/// themselves in rounding, which is stated less sharply: with an eighth medians at 1e-11 were twice as high.
inline constexpr double first_share = 1;
/// Spinners: so many times first_share, as errors of their steps hardly add up over the turns; not where one companion alone would judge, at which
/// of 1500 random ones at 1e-9 four stated too little. At 1e-11 the median of stated over true went from 20 to 8.6, and the cost down by a sixth.
inline constexpr double spinning_share = 64;
/// DOP853: first_share of its own, as its steps err as much as they may. Chosen.
inline constexpr double dop853_share = 1.0 / 8;
/// With the turns it is first_share / (first_base + angle / first_angle), the angle turned through in rad.
inline constexpr double first_base = 8, first_angle = 16;
/// Bodies without weight: first_share / (first_base + first_drift * angle^2) where that is less, as a rate that drifts takes the phase with it. Chosen by
/// what the first runs of 1200 random general scenes and 1500 driven rotors let foresee: 15 and 18 % had to be run again, 8 and 7 % would be. Heavy bodies
/// would gain nothing.
inline constexpr double first_drift = 0.01;
/// It makes no step tolerance less than this, where rounding is stated less sharply.
inline constexpr double drifting_least = 1e-12;
/// Deceleration, where the error of the phase grows with the square of the angle: first_share / (drifting_base +
/// drifting_phase * angle^2). With 32 and 1.6e-3 the medians of stated over true were 1.4 times as high at 1e-11, and the cost at 1e-2 by a tenth, but five
/// answers fewer, of 600 at 1e-8 and 600 at 1e-11, missed after their last try; with a phase of 2e-5 three more would.
inline constexpr double drifting_base = 8, drifting_phase = 1e-4;
/// No looser steps: at 1e-8, near the radius of convergence of a step, all runs were seen to err alike.
inline constexpr double loosest_step = 1e-9;
/// No looser steps of a run whose own error is not looked at: far under the 1e-4 rad by which starts are displaced (general/start_error.hpp).
inline constexpr double loosest_alone = 1e-11;

/// By how much more than the excess over the tolerance the steps of a second try are tightened.
inline constexpr double retry = 8;
/// After so many steps of all runs no second try is made: it would take seconds more.
inline constexpr double retry_steps = 3e6;

/// A body leaves its stop at a time that all runs know to so many roundings of itself alone. Chosen.
inline constexpr double release_roundings = 4;
/// Stops: margin of the error of their time, over that of the columns.
inline constexpr double stop_margin = 2;
/// Decelerations: to the error of the stop's time so many step tolerances are added, twice what a companion errs; it is one number, at which two
/// runs may be near by chance.
inline constexpr double stop_steps = 1.0 / 32;
/// And so many times the rounding that the runs share. Chosen.
inline constexpr double stop_rounding = 8;
/// The same as stop_steps of the time when a brake stops the body.
inline constexpr double brake_steps = 1;
/// General scenes: margin of what a torque that brakes hold only to rounding may have done, which no companion shows. Chosen: a fifth of what distances
/// state must fit in beside it.
inline constexpr double slip_margin = 1.25;
/// Decelerations: no second try for the modulus or the stop where their error is more than so many times over what is asked: no digits are left for it.
inline constexpr double retry_excess = 1e6;
/// Spinners: the size of the attitude to which rounding is relative, as it is put together from two rotations. Chosen.
inline constexpr double composed_attitude = 1.5;

/// Driven rotors: where the rates of the runs have parted, as behind a saddle, a function of Lyapunov's that is off by more than this is not
/// known: how far three runs have fallen by then may be near by chance.
inline constexpr double parted_lyapunov = 0.01;
/// And what is integrated over the rates, or falls with them, is so many times less certain, for the same reason. Chosen: in scenes of another
/// generator angles of the wheel had erred by 1.8 and V by 3 times the stated; these were not run again.
inline constexpr double parted_margin = 8;

/// Driven rotors, stable or not: a start is next to a steady rotation where its rate is along its momentum but for this share. From 28 scenes of another generator, not
/// a fit.
inline constexpr double next_to_steady = 1e-6;
/// There the start counts as known so many times less well: its distance from the rotation decides when the motion leaves.
inline constexpr double steady_condition = 1e6;
/// Driven rotors that start in a steady rotation, but for so many roundings: what their momentum has gone from it in body axes counts as error, twice. Of 4700
/// that started along an axis 153 had stated too little of V or the angle of the rotor, by any factor, of 44 000 two since, at rounding.
inline constexpr double steady_roundings = 256;
/// And nothing is known behind so much of it, as a share of the momentum. Chosen.
inline constexpr double left_steady = 1e-3;
/// As next_to_steady, of all families, where the steady rotation is unstable. From 11 of 309 000 answers of bodies turned about their middle axis, 3 of which
/// are left at this share, and of driven rotors from 81 of 14 900; not a fit.
inline constexpr double next_to_unstable = 0.1;
/// The same of heavy bodies next to any steady rotation, or to a rest, of plane swings whose energy is so near that of a rest on high, over the range of
/// their potential, and of general scenes next to a rest. From 9 of 146 000 answers of tops and pendulums, 1 of which is left, from 65 of 16 000 such
/// swings, 1 of which is left, and from 47 of 4400 bodies with wheels, none of which is left; not a fit.
inline constexpr double next_to_balance = 0.03;
/// As steady_condition.
inline constexpr double unstable_condition = 1e6;
/// Bodies without weight: next to an unstable rotation the momentum of a companion differs by so many times more than the other data, in the direction that leaves it. Where all
/// differed in one direction parts of that cancelled: of 3812 bodies with rotors 1 by free and 2 by general scenes had stated up to 3.3 times too little, now none,
/// and the medians went from 335 to 476 and from 113 to 148 times; of 890 decelerations 3.
inline constexpr double leaving_shift = 2;
/// The same of heavy bodies next to an unstable steady rotation, in rate and down: of 3700 that an adversary had turned about the vertical three had stated 1.3 to 2.7 times too little, now none.
inline constexpr double heavy_leaving_shift = 0.25;

/// General scenes: a motion whose neighbours part by so many times more than in proportion to the angle turned through has the warning `chaotic`.
inline constexpr double chaotic_growth = 1e4;

/// Heavy bodies by closed forms and series, where the start was converted (an attitude into down, a tensor into moments) or found by shooting: of the
/// distance between two neighbours, of which both may lie near by chance. Chosen.
inline constexpr double neighbours_margin = 4;
/// Periodic motions of heavy bodies, found by shooting: by how many roundings the data of two neighbours differ.
inline constexpr double orbit_change = 2;
/// Margin of their distance in period and trace: of 246 traces of random motions the worst erred by 1/3.4 of what is stated, of 24 periods that were off at all by 1/19.
inline constexpr double orbit_margin = 4;
/// The same of the start, beside neighbours_margin. Chosen.
inline constexpr double orbit_start_margin = 16;
/// Tops, pendulums and bodies without weight, where the bound of their error misses what is asked: over the root mean square of how far four neighbours are
/// off whose data differ by two roundings. With 3 two of 4500 columns (19 200 scenes, `exact` by name), of one slim body, were understated, 3.8 times, the next
/// held by 1.26, and climbing from 9000 columns came to 1.7 times, at 1e-13. Twice that passes no more scenes over.
inline constexpr double exact_margin = 6;
/// And so many times less than the bound at most: with zeros that neighbours keep, and passages through the vertical, they may show too little, 1400
/// times in one of 750 columns.
inline constexpr double exact_trust = 64;
/// Bodies whose least moment is a smaller part of the greatest keep their bound.
inline constexpr double exact_slim = 1e-3;

/// Averaged decelerations: mean equations integrated with a local error err by so many times it in all. Chosen.
inline constexpr double mean_steps = 10;
/// The same of |M|, energy and k2 of `averaged-2`: of 2200 answers one erred by 32, a body that one strong control turns over while it brakes.
inline constexpr double mean_steps_of_slow = 40;
/// The same of `averaged` without rotors where the local error is below `mean_fine`: so many times the number of its steps. Of 10 000 bodies under equal torques and drag, whose
/// |M| has a closed form, the greatest was 0.9 times; at looser local errors 5 in all.
inline constexpr double mean_steps_share = 1.5, mean_fine = 1e-10;
/// Next to a separatrix the momentum of `averaged-2` is as uncertain as so many roundings over the distance. Of two scenes found from outside, that had stated 1.6 and 24 times too little.
inline constexpr double lingering_rounding = 2;
/// To the error of the time at which they stop so many local errors are added. Chosen.
inline constexpr double mean_stop = 100;

/// The longest step under a torque of the caller's own, over the span: it is asked at twelve places of a step by DOP853, the widest gap
/// between which is 0.27 of it, and at its ends by CVODE, whose steps are so many times shorter.
inline constexpr double law_longest = 1.0 / 64, law_shorter = 4;

/// CVODE is compared with so many runs of its own of neighbours.
inline constexpr int cvode_companions = 2;
/// The longest steps of the answer and of these, over the span: where a few steps would do all may err alike.
inline constexpr double cvode_longest[1 + cvode_companions] = {1.0 / 64, 1.0 / 45, 1.0 / 37};
/// Their tolerances are so many times looser.
inline constexpr double cvode_looser[cvode_companions] = {10, 20};
/// The stated error of CVODE over the distance of the first, and of a looser one in proportion.
inline constexpr double cvode_margin = 4;
/// The same next to rounding, where a tighter tolerance gains little.
inline constexpr double cvode_margin_of_rounding = 10;
/// What is next to rounding: a tolerance of the tighter run below this. Chosen.
inline constexpr double cvode_rounding_below = 1e-11;
/// Its runs are compared at least at so many times: at the asked ones, and where these are fewer also before the last one. Chosen: of 9860 columns of
/// slim rotors and of spinners, asked at one to three times, one errs by more than is stated; without a neighbour and these times 21 did.
inline constexpr std::size_t cvode_looks = 16;
/// These others stand in this part of the span. Chosen.
inline constexpr double cvode_watched = 1.0 / 8;
/// At so many times of the whole span its runs are seen to part. Chosen.
inline constexpr std::size_t cvode_parted_looks = 32;
/// The tightest tolerance that CVODE is asked for.
inline constexpr double cvode_tightest = 1e-13;

}  // namespace gyrostat::honesty
