// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/rotor/full_lanes.hpp"

namespace gyrostat::rotor {

namespace detail {

/// The walk of companions.hpp in lanes: each lane goes its own way through its own scene, and takes another when it is done.
class FullLanes {
 public:
  static constexpr std::size_t most = 64;  ///< tasks

  explicit FullLanes(std::span<LaneTask> tasks) noexcept
      : tasks_(tasks), answers_(FullBatch<double>{}, options()), firsts_(answers_), seconds_(answers_) {
    // long ones first, and those with as many companions together
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const LaneTask& task = tasks[i];
      const Condition<double> condition{task.gyrostat->condition()};
      rank_[i] = phase_of(task) * (rounding_rules(first_tolerance(task), condition) ? 1e6 : 1);
      order_[i] = std::uint8_t(i);
    }
    std::sort(order_.begin(), order_.begin() + tasks.size(),
              [&](std::uint8_t i, std::uint8_t j) { return rank_[i] != rank_[j] ? rank_[i] > rank_[j] : i < j; });
  }

  void run() noexcept {
    for (std::size_t b = 0; b < size; ++b) fill(b);
    for (unsigned trip = 1; busy_ > 0; ++trip) {
      step_answers();
      step_seconds();
      while (look()) {
      }
      step_firsts();
      if (trip % 256 == 0 && tasks_[0].options.cancelled()) {
        for (std::size_t b = 0; b < size; ++b)
          if (lane_[b].task) lane_[b].task->answer.status = ode::Status::cancelled;
        for (; next_ < tasks_.size(); ++next_) tasks_[order_[next_]].answer.status = ode::Status::cancelled;
        return;
      }
    }
  }

 private:
  static constexpr std::size_t size = ode::batch_size;
  static constexpr std::size_t columns = std::size(column_kinds);
  using Batch = ode::TaylorBatch<FullBatch<double>>;
  using Ends = Batch::Ends;
  using Pack = Wide<double>;
  using Numbers = std::array<double, size>;
  /// Columns of all lanes.
  struct alignas(64) Errors {
    double of[columns][size];
  };
  /// A run's states, and what Row makes of them beside: Omega, omega and V.
  struct Seen {
    alignas(64) double state[9][size];
    alignas(64) double made[5][size];
  };
  struct Lane {
    LaneTask* task = nullptr;
    double step_tolerance, first, last, event, kick_after;
    double stride;  ///< of the answer's last step
    std::size_t next, told;
    int trial;
    bool fresh;  ///< the companions have made no step
    bool alone;  ///< with one companion
    bool seen;   ///< the runs have been compared where the first companion's step ends
    ode::Counts counts;
  };

  static ode::TaylorBatchOptions<double> options() noexcept { return {1, 1 << 19, true}; }
  static double phase_of(const LaneTask& task) noexcept {
    return turning_rate(*task.gyrostat, task.start) * task.times.back();
  }
  static double first_tolerance(const LaneTask& task) noexcept {
    return first_step_tolerance_of_phase(task.options.tolerance, phase_of(task), honesty::loosest_step);
  }

  /// The next task, in lane b.
  void fill(std::size_t b) noexcept {
    Lane& lane = lane_[b];
    while (lane.task == nullptr && next_ < tasks_.size()) {
      lane.task = &tasks_[order_[next_++]];
      ++busy_;
      lane.trial = 0;
      lane.counts = {};
      lane.step_tolerance = first_tolerance(*lane.task);
      set_row(b);
      begin(b);
    }
  }

  /// The principal axes of the R of a neighbour, which is off by some roundings anyway: sooner than to rounding of their own.
  static PrincipalAxes<double> near_axes(const Gyrostat<double>& gyrostat) noexcept {
    const Vec3<double>& e = gyrostat.axis();
    const auto eigen = symmetric_eigen<double>(gyrostat.inertia() - gyrostat.axial_inertia() * (e * e.transpose()));
    const Vec3<double>& R = eigen.values;
    return {R, eigen.axes, {R[0] - R[1], R[1] - R[2], R[0] - R[2]}};
  }

  void put(Batch& batch, std::size_t b, const Gyrostat<double>& gyrostat, const State<double>& start,
           const PrincipalAxes<double>& axes, double step_tolerance) noexcept {
    auto& system = batch.system();
    system.set(int(b), gyrostat, start, axes);
    auto scale = system.scale(int(b));
    for (double& each : scale) each *= step_tolerance;
    batch.start(int(b), 0, system.start(int(b)), scale, 1 / turning_rate(gyrostat, start));
  }

  /// The constants of Row.
  void set_row(std::size_t b) noexcept {
    const Gyrostat<double>& body = *lane_[b].task->gyrostat;
    constexpr int row[] = {0, 1, 2, 0, 0, 1}, column[] = {0, 1, 2, 1, 2, 2};
    for (int i = 0; i < 6; ++i) {
      free_inverse_[i][b] = body.free_inverse()(row[i], column[i]);
      inverse_[i][b] = body.inverse_inertia()(row[i], column[i]);
    }
    for (int i = 0; i < 3; ++i) {
      axis_[i][b] = body.axis()[i];
      target_[i][b] = body.target_momentum() * body.axis()[i];
    }
    rotor_inverse_[b] = 1 / body.axial_inertia();
    no_load_rate_[b] = body.no_load_rate();
    rotor_weight_[b] = body.axial_inertia() * body.coupling() / 2;
  }

  /// A run of the lane's task.
  void begin(std::size_t b) noexcept {
    Lane& lane = lane_[b];
    const LaneTask& task = *lane.task;
    const Gyrostat<double>& body = *task.gyrostat;
    const Condition<double> condition{body.condition(), start_sensitivity(body, task.start)};
    const double change = data_change(lane.step_tolerance, condition);
    lane.alone = !rounding_rules(lane.step_tolerance, condition);
    put(answers_, b, body, task.start, body.free_axes(), lane.step_tolerance);
    const auto beside = [&](Batch& batch, Aside aside) noexcept {
      const Neighbour<double> neighbour(body, task.start, change, aside);
      put(batch, b, neighbour.gyrostat, neighbour.start, near_axes(neighbour.gyrostat),
          companion_step(lane.step_tolerance));
    };
    beside(firsts_, Aside::first);
    if (!lane.alone) beside(seconds_, second_aside(condition));

    lane.last = task.times.back();
    lane.next = lane.told = 0;
    lane.kick_after = lane.alone ? lane.last / 2 : infinity<double>;
    lane.fresh = true, lane.seen = false;
    fading_[b] = body.angular_velocity(task.start.momentum, task.start.axial_momentum).norm() / honesty::fading_angle;
    lane.event = std::numeric_limits<double>::min();  // behind the first step
    for (std::size_t i = 0; i < columns; ++i) kept_.of[i][b] = error_.of[i][b] = size_.of[i][b] = 0;
    size_.of[column::attitude][b] = 1;
    for (; lane.next < task.times.size() && !(task.times[lane.next] > 0); ++lane.next) {
      task.states[lane.next] = task.start;
      Comparison<Row<double>> sizes{Row<double>(body)};
      sizes.add(task.start);
      for (std::size_t i = 0; i < columns; ++i) size_.of[i][b] = sizes.size()[i];
      lane.told = lane.next + 1;
    }
    if (lane.next == task.times.size()) end(b, ode::Status::reached);
  }

  /// The run of lane b has ended: another one, tighter, or another task.
  void end(std::size_t b, ode::Status status) noexcept {
    Lane& lane = lane_[b];
    LaneTask& task = *lane.task;
    FullMotionAnswer<double>& answer = task.answer;
    const std::uint64_t steps = answers_.counts(int(b)).steps;
    for (Batch* batch : {&answers_, &firsts_, &seconds_})
      if (batch != &seconds_ || !lane.alone) lane.counts += batch->counts(int(b));
    answer.status = status;
    answer.counts = lane.counts;
    answer.step_tolerance = lane.step_tolerance;
    answer.met = false;
    answer.error = ColumnErrors<double>::all(nan<double>);
    if (status == ode::Status::reached) {
      const Row<double> row(*task.gyrostat, task.start);
      ColumnErrors<double> sizes;
      for (std::size_t i = 0; i < columns; ++i) sizes[i] = size_.of[i][b];
      // an attitude is put together anew in each step, from one product more
      constexpr double eps = epsilon<double>;
      auto error =
          rounding_of_columns(row, task.start, sizes, 4 * eps + 2 * eps * std::sqrt(double(steps)), task.times.back());
      for (std::size_t i = 0; i < columns; ++i) {
        error[i] = stated_error(error_.of[i][b], error[i], lane.alone);
        if (column_kinds[i].measure == Measure::relative) error[i] = over(error[i], greater(sizes[i], row.scale[i]));
      }
      answer.error = relative_to_truth(error, column_kinds);
      forget_parted(answer.error);
      count_departure(answer.error, departure_from_steady<double>(*task.gyrostat, task.start, task.states));
      const double excess = task.options.excess(answer);
      answer.met = excess <= 1;
      if (!answer.met && lane.trial < 2 && lane.step_tolerance > finest_step_tolerance<double> &&
          double(lane.counts.steps) <= honesty::retry_steps) {
        const double by = excess > 1 ? honesty::retry * excess : infinity<double>;
        lane.step_tolerance = std::max(finest_step_tolerance<double>, lane.step_tolerance / by);
        ++lane.trial;
        return begin(b);
      }
    }
    lane.task = nullptr;
    --busy_;
    fill(b);
  }

  /// One step of the lanes that have an end; those that failed end.
  void step(Batch& batch, const Ends& ends, bool any) noexcept {
    if (!any) return;
    batch.step(ends);
    for (std::size_t b = 0; b < size; ++b)
      if (ends[b] > 0 && batch.status(int(b)) != ode::Status::reached) end(b, batch.status(int(b)));
  }

  void step_answers() noexcept {
    Ends ends;
    std::array<double, size> before;
    bool any = false;
    for (std::size_t b = 0; b < size; ++b) {
      before[b] = answers_.time(int(b));
      const bool goes = lane_[b].task && before[b] < lane_[b].event;
      ends[b] = goes ? lane_[b].last : -infinity<double>;
      any = any || goes;
    }
    step(answers_, ends, any);
    for (std::size_t b = 0; b < size; ++b)
      if (ends[b] > 0) lane_[b].stride = answers_.time(int(b)) - before[b];
  }

  void step_seconds() noexcept {
    Ends ends;
    bool any = false;
    for (std::size_t b = 0; b < size; ++b) {
      Lane& lane = lane_[b];
      ends[b] = -infinity<double>;
      if (lane.task == nullptr || lane.alone) continue;
      const double now = seconds_.time(int(b)), first = answers_.time(int(b));
      if (lane.fresh ? first > 0 && !(now > 0) : now < lane.event) {
        ends[b] = lane.fresh ? first / 3 : lane.last;
        any = true;
      }
    }
    step(seconds_, ends, any);
  }

  /// The first companions lead: where all has been seen up to where they are, they make a step.
  void step_firsts() noexcept {
    Ends ends;
    std::array<double, size> before;
    bool any = false;
    for (std::size_t b = 0; b < size; ++b) {
      Lane& lane = lane_[b];
      ends[b] = -infinity<double>;
      before[b] = firsts_.time(int(b));
      if (lane.task == nullptr) continue;
      const double first = answers_.time(int(b));
      if (lane.fresh ? first > 0 && (lane.alone || seconds_.time(int(b)) > 0) : lane.seen) {
        const double stride = companion_stride(honesty::companion_stride, firsts_.counts(int(b)).steps) * lane.stride;
        ends[b] = lane.fresh ? first / 2 : companion_reaches(before[b], stride, lane.last);
        any = true;
      }
    }
    if (!any) return;
    firsts_.step(ends);
    alignas(64) double fades[size];
    for (std::size_t b = 0; b < size; ++b) {
      Lane& lane = lane_[b];
      fades[b] = 1;
      if (!(ends[b] > 0)) continue;
      if (firsts_.status(int(b)) != ode::Status::reached) {
        end(b, firsts_.status(int(b)));
        continue;
      }
      const double now = firsts_.time(int(b));
      fades[b] = 1 / (1 + (now - before[b]) * fading_[b]);
      lane.fresh = lane.seen = false;
      lane.event = std::min(now, lane.task->times[lane.next]);
    }
    for (std::size_t i = 0; i < columns; ++i)
      for (std::size_t b = 0; b < size; b += pack)
        store(&kept_.of[i][b], load_wide(&kept_.of[i][b]) * load_wide(&fades[b]));
  }

  /// Whether the runs are compared at the lane's next asked time, where the step of its answer ends at `end`.
  static bool compares_at(const Lane& lane, double end) noexcept {
    const std::span<const double> times(lane.task->times);
    return honesty::is_compared(lane.next, times.size()) || is_next_to_end(times, lane.next, end - lane.stride, end);
  }

  /// Looks at the lanes whose runs have come to what is next, an asked time or the end of the first companion's step; false where there are none.
  bool look() noexcept {
    Ends t;
    std::array<bool, size> here, asked;
    alignas(64) double looks[size], adds[size], pairs[size];
    bool any = false, compares = false, second = false;
    for (std::size_t b = 0; b < size; ++b) {
      const Lane& lane = lane_[b];
      here[b] = lane.task && !lane.fresh && !lane.seen && answers_.time(int(b)) >= lane.event &&
                (lane.alone || seconds_.time(int(b)) >= lane.event);
      t[b] = here[b] ? lane.event : answers_.time(int(b));
      asked[b] = here[b] && lane.next < lane.task->times.size() && lane.task->times[lane.next] == lane.event;
      const bool now = here[b] && lane.event == firsts_.time(int(b));
      const bool compare = now || (asked[b] && compares_at(lane, answers_.time(int(b))));
      looks[b] = compare, adds[b] = asked[b], pairs[b] = compare && !lane.alone;
      any = any || here[b];
      compares = compares || compare;
      second = second || (compare && !lane.alone);
    }
    if (!any) return false;
    Seen answer;
    see(answers_, t, answer);
    add_sizes(answer, adds);
    if (compares) {
      Seen one, two;
      for (std::size_t b = 0; b < size; ++b)
        if (!here[b]) t[b] = firsts_.time(int(b));
      see(firsts_, t, one);
      if (second) see(seconds_, t, two);
      for (std::size_t b = 0; b < size; b += pack) compare(b, answer, one, second ? &two : nullptr, looks, pairs);
    }
    for (std::size_t b = 0; b < size; ++b)
      if (here[b]) note(b, asked[b], looks[b] > 0, answer);
    return true;
  }

  /// What a look of lane b found, which was at an asked time or at the end of the first companion's step or at both.
  void note(std::size_t b, bool asked, bool compared, const Seen& answer) noexcept {
    Lane& lane = lane_[b];
    LaneTask& task = *lane.task;
    if (asked) {
      const auto s = [&](int i) { return answer.state[i][b]; };
      task.states[lane.next++] = {{s(0), s(1), s(2), s(3)}, {s(4), s(5), s(6)}, s(7), s(8)};
    }
    if (compared && lane.told < lane.next) {
      for (std::size_t i = 0; i < columns; ++i) error_.of[i][b] = greater(kept_.of[i][b], error_.of[i][b]);
      lane.told = lane.next;
    }
    const double now = firsts_.time(int(b));
    if (lane.event < now) {
      lane.event = lane.next < task.times.size() ? std::min(now, task.times[lane.next]) : now;
      return;
    }
    if (lane.next == task.times.size()) return end(b, ode::Status::reached);
    lane.seen = true;
    if (now > lane.kick_after) {
      firsts_.kick(int(b), honesty::kick * epsilon<double>);
      lane.kick_after = infinity<double>;
    }
  }

  /// The states of a run, and what Row makes of them beside.
  void see(const Batch& batch, const Ends& t, Seen& to) const noexcept {
    alignas(64) Batch::Rows numbers;
    batch.at(t, numbers);
    batch.system().states(t, numbers, to.state);
    for (std::size_t b = 0; b < size; b += pack) {
      const Pack p = load_wide(&to.state[7][b]);
      Pack e[3], G[3], y[3];
      for (int i = 0; i < 3; ++i) {
        e[i] = load_wide(&axis_[i][b]);
        const Pack H = load_wide(&to.state[4 + i][b]);
        G[i] = H - p * e[i];
        y[i] = H - load_wide(&target_[i][b]);
      }
      const auto times = [&](const double(&m)[6][size], const Pack(&v)[3], Pack(&made)[3]) GYROSTAT_INLINE_LAMBDA {
        const auto of = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&m[i][b]); };
        made[0] = multiply_add(of(0), v[0], multiply_add(of(3), v[1], of(4) * v[2]));
        made[1] = multiply_add(of(3), v[0], multiply_add(of(1), v[1], of(5) * v[2]));
        made[2] = multiply_add(of(4), v[0], multiply_add(of(5), v[1], of(2) * v[2]));
      };
      Pack Omega[3], J[3];
      times(free_inverse_, G, Omega);
      times(inverse_, y, J);
      const Pack rate = load_wide(&rotor_inverse_[b]) * p -
                        multiply_add(e[0], Omega[0], multiply_add(e[1], Omega[1], e[2] * Omega[2]));
      const Pack excess = rate - load_wide(&no_load_rate_[b]);
      const Pack level = multiply_add(y[0], J[0], multiply_add(y[1], J[1], y[2] * J[2]));
      for (int i = 0; i < 3; ++i) store(&to.made[i][b], Omega[i]);
      store(&to.made[3][b], rate);
      store(&to.made[4][b], multiply_add(load_wide(&rotor_weight_[b]) * excess, excess, wide(0.5) * level));
    }
  }

  static GYROSTAT_INLINE Pack size_of(const Pack& x) noexcept { return greater_of<double>(x, wide(0.) - x); }
  static GYROSTAT_INLINE Pack size_of(const Pack& x, const Pack& y, const Pack& z) noexcept {
    return square_root<double>(multiply_add(x, x, multiply_add(y, y, z * z)));
  }

  /// The sizes of columns of a run where `adds`.
  void add_sizes(const Seen& run, const double (&adds)[size]) noexcept {
    for (std::size_t b = 0; b < size; b += pack) {
      const auto yes = less<double>(wide(0.), load_wide(&adds[b]));
      const auto raise = [&](std::size_t i, const Pack& by) GYROSTAT_INLINE_LAMBDA { raise_to(size_, i, b, by, yes); };
      const auto s = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&run.state[i][b]); };
      const auto m = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&run.made[i][b]); };
      raise(column::angular_velocity, size_of(m(0), m(1), m(2)));
      raise(column::angular_momentum, size_of(s(4), s(5), s(6)));
      raise(column::rotor_rate, size_of(m(3)));
      raise(column::rotor_angle, size_of(s(8)));
      raise(column::lyapunov, size_of(m(4)));
    }
  }

  /// NaN stays.
  static GYROSTAT_INLINE void raise_to(Errors& to, std::size_t i, std::size_t b, const Pack& by,
                                       const WideChoices<double>& yes) noexcept {
    const Pack before = load_wide(&to.of[i][b]);
    const Pack raised = greater_of<double>(by, multiply_add(wide(0.), by, before));
    store(&to.of[i][b], choose<double>(yes, raised, before));
  }

  /// The distance of two runs, column by column, of the lanes from b on; that of attitudes from above, within a share of its square.
  static GYROSTAT_INLINE void apart(std::size_t b, const Seen& x, const Seen& y, Pack (&to)[columns]) noexcept {
    const auto p = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&x.state[i][b]); };
    const auto q = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&y.state[i][b]); };
    const auto state = [&](int i) GYROSTAT_INLINE_LAMBDA { return p(i) - q(i); };
    const auto made = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&x.made[i][b]) - load_wide(&y.made[i][b]); };
    Pack turn[3];
    for (int i = 0; i < 3; ++i) {
      const int j = 1 + (i + 1) % 3, k = 1 + (i + 2) % 3;
      turn[i] = (p(0) * q(1 + i) - p(1 + i) * q(0)) - (p(j) * q(k) - p(k) * q(j));
    }
    const Pack square = multiply_add(turn[0], turn[0], multiply_add(turn[1], turn[1], turn[2] * turn[2]));
    const Pack sine = square_root<double>(square), rest = greater_of<double>(wide(1.) - square, wide(1e-12));
    // 2 asin s is below both
    const Pack near = (sine + sine) * inverse_square_root<double>(rest), far = wide(pi<double>) * sine;
    to[column::attitude] = choose<double>(less<double>(near, far), near, far);
    to[column::angular_velocity] = size_of(made(0), made(1), made(2));
    to[column::angular_momentum] = size_of(state(4), state(5), state(6));
    to[column::rotor_rate] = size_of(made(3));
    to[column::rotor_angle] = size_of(state(8));
    to[column::lyapunov] = size_of(made(4));
  }

  /// What the distances of the runs tell, of the lanes from b on.
  void compare(std::size_t b, const Seen& answer, const Seen& one, const Seen* two, const double (&looks)[size],
               const double (&pairs)[size]) noexcept {
    constexpr auto& how = honesty::side_by_side;
    const auto yes = less<double>(wide(0.), load_wide(&looks[b])), both = less<double>(wide(0.), load_wide(&pairs[b]));
    Pack away[columns], further[columns], between[columns];
    apart(b, answer, one, away);
    if (two != nullptr) {
      apart(b, answer, *two, further);
      apart(b, one, *two, between);
    }
    const auto made = [&](int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&answer.made[i][b]); };
    const Pack rate = size_of(made(0), made(1), made(2)) * wide(1 / honesty::fading_angle);
    store(&fading_[b], choose<double>(yes, rate, load_wide(&fading_[b])));
    for (std::size_t i = 0; i < columns; ++i) {
      Pack told = wide(how.margin) * away[i];
      if (two != nullptr) {
        // error_of_distances
        const Pack greatest = greater_of<double>(away[i], multiply_add(wide(0.), away[i], further[i]));
        const Pack paired =
            wide(how.margin) * greater_of<double>(greatest, multiply_add(wide(0.), greatest, between[i]));
        told = choose<double>(both, paired, told);
      }
      raise_to(kept_, i, b, told, yes);
    }
  }

  static constexpr std::size_t pack = std::size_t(wide_size<double>);

  std::span<LaneTask> tasks_;
  std::array<std::uint8_t, most> order_{};
  std::array<double, most> rank_{};
  std::size_t next_ = 0;
  int busy_ = 0;
  std::array<Lane, size> lane_{};
  Batch answers_, firsts_, seconds_;
  Errors kept_{}, error_{}, size_{};  ///< of Walk, and the distances that fade
  alignas(64) double free_inverse_[6][size]{};
  alignas(64) double inverse_[6][size]{};
  alignas(64) double axis_[3][size]{};
  alignas(64) double target_[3][size]{};
  alignas(64) double rotor_inverse_[size]{};
  alignas(64) double no_load_rate_[size]{};
  alignas(64) double rotor_weight_[size]{};
  alignas(64) double fading_[size]{};
};

}  // namespace detail

GYROSTAT_COMPILED_ONCE void full_in_lanes(std::span<LaneTask> tasks) noexcept {
  while (!tasks.empty()) {
    const std::size_t some = std::min(tasks.size(), detail::FullLanes::most);
    detail::FullLanes(tasks.first(some)).run();
    tasks = tasks.subspan(some);
  }
}

}  // namespace gyrostat::rotor
