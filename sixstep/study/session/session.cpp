// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/session/session.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "sixstep/base/written.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "sixstep/study/live/any_run.hpp"
#include "sixstep/study/run/conclude.hpp"
#include "sixstep/study/run/observers_of.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/session/shortened.hpp"

namespace sixstep::study {

using detail::AnyRun;
using detail::Slice;
using sim::Instant;

namespace {

/// A run with value semantics: a copy continues independently.
class Run {
 public:
  explicit Run(std::unique_ptr<AnyRun> run) : run_(std::move(run)) {}
  Run(const Run& other) : run_(other.run_->clone()) {}
  Run(Run&&) noexcept = default;
  Run& operator=(const Run&) = delete;
  ~Run() = default;
  AnyRun* operator->() { return run_.get(); }
  const AnyRun* operator->() const { return run_.get(); }

 private:
  std::unique_ptr<AnyRun> run_;
};

}  // namespace

struct Session::State {
  // The scenario is never changed, only replaced, because copies of a session share it.
  std::shared_ptr<const Scenario> scenario;
  std::shared_ptr<const Compiled> compiled;  ///< without the timeline, which the rig contains
  Observers watchers;
  Run run;
  Present present{};
  std::optional<detail::LastSegment> last{};
  Instant reach{};
  sim::Stop stop = sim::Stop::observer;
  bool over = false;
  bool figures_moved = false;  ///< true: the figures' windows have changed since the beginning

  Instant now() const { return run->now(); }
  std::int64_t period() const { return compiled->board.modulator.period_ticks; }
  /// Time in ps from a period's start to its control tick.
  std::int64_t lead() const { return compiled->board.sampled_in_middle ? period() / 2 : 0; }
  bool is_tick(const Instant& t) const { return t.offset == 0.0 && t.ticks % period() == lead(); }
  Instant tick_after(const Instant& t) const {
    const std::int64_t since = t.ticks - lead();
    return since < 0 ? Instant{lead(), 0.0} : Instant{lead() + (since / period() + 1) * period(), 0.0};
  }
  /// Samples an earlier instant, if the last segment contains this instant.
  bool look_back(const Instant& asked) {
    if (!(asked < last->from)) {
      present.t_s = asked.seconds();
      last->look(present.signals, asked);
    }
    return true;
  }
  Slice slice(const Instant& until) { return {watchers, present, last, until, reach, period()}; }
};

namespace {

/// True if both configurations have the same effect on the past. A changed setpoint limit has no effect on
/// setpoints within the limit.
bool same_chip(const Tuned& a, const Tuned& b) {
  if (!(a.drive == b.drive) || a.product.has_value() != b.product.has_value()) return false;
  if (!(a.sensorless == b.sensorless) || !(a.field == b.field)) return false;
  if (!(a.own == b.own) || !(a.estimator == b.estimator)) return false;
  if (!a.product) return true;
  control::ProtectedConfig<double> one = *a.product, other = *b.product;
  one.setpoint_limit = other.setpoint_limit = 0.0;
  return one == other;
}

/// True if the newly compiled scenario has the same run up to the present instant.
bool same_past(const Scenario& s, const Compiled& before, const Compiled& anew, const Instant& now) {
  if (!same_chip(
          {before.drive, {}, before.product, before.sensorless, before.field, before.own, before.estimator},
          {anew.drive, {}, anew.product, anew.sensorless, anew.field, anew.own, anew.estimator}))
    return false;
  std::size_t number = 0;
  for (const At* at : in_order(s)) {
    if (!retunes(*at)) continue;
    if (sample_from_ticks(s.pwm, sim::to_instant(at->time_s).ticks) > now.ticks) break;
    if (!same_chip(before.later[number], anew.later[number])) return false;
    ++number;
  }
  return true;
}

/// The first control tick that the segments so far have not included. Converting its time to seconds and back
/// must not give an earlier tick.
Instant next_change(const Instant& now, const Instant& next_tick, const Instant& reach, std::int64_t period) {
  std::int64_t from = std::max(now.ticks + (now.offset > 0 ? 1 : 0), reach.ticks);
  if (now < next_tick) from = std::max(from, now.ticks + 1);
  std::int64_t tick = (from + period - 1) / period * period;
  while (sim::to_instant(Instant{tick, 0.0}.seconds()).ticks < from) tick += period;
  return {tick, 0.0};
}

/// Keeps the run on the general kernel, even if the event that needed this kernel is now after the end. Adds
/// an event with straight wires, which changes nothing.
Scenario on_same_kernel(Scenario s, const Compiled& before) {
  if (!before.general || needs_general_plant(s)) return s;
  At straight;
  straight.bridge.phases = AtOrder::abc;
  s.at.insert(s.at.begin(), straight);
  return s;
}

}  // namespace

Session::Session(std::unique_ptr<State> state) : state_(std::move(state)) {}
Session::Session(const Session& other) : state_(std::make_unique<State>(*other.state_)) {}
Session& Session::operator=(const Session& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

const Present& Session::present() const { return state_->present; }
double Session::now_s() const { return state_->now().seconds(); }
bool Session::over() const { return state_->over; }
const Scenario& Session::scenario() const { return *state_->scenario; }
const rig::BoardConfig& Session::board() const { return state_->compiled->board; }
double Session::period_s() const { return state_->scenario->pwm.period_s; }

base::Result<Session> Session::open(const Scenario& scenario, const Listeners& listeners,
                                    const rig::ChipPort& instead) {
  if (base::Problems problems = check(scenario); !problems.empty()) return problems;
  base::Result<Compiled> compiled = compile(scenario);
  if (!compiled) return compiled.problems();
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();
  compiled->board.sensors.decodes_hall = true;  // a Hall line may break at any time
  compiled->board.chip = instead;
  rig::Timeline timeline = std::move(compiled->timeline);
  base::Result<std::unique_ptr<AnyRun>> run = detail::made_by(scenario, *compiled, std::move(timeline));
  if (!run) return run.problems();
  const Arithmetic arithmetic = scenario.control.arithmetic;
  Scenario held = scenario;
  if (arithmetic != Arithmetic::float64 && arithmetic != Arithmetic::float32)
    held.control.full_scale = (*run)->full_scale();
  auto state =
      std::make_unique<State>(State{.scenario = std::make_shared<const Scenario>(std::move(held)),
                                    .compiled = std::make_shared<const Compiled>(std::move(*compiled)),
                                    .watchers = observers_of(scenario, listeners, *indices),
                                    .run = Run(std::move(*run))});
  Slice first = state->slice({});
  state->run->look(first);
  return Session(std::move(state));
}

bool Session::advance(double to_s) { return go(sim::to_instant(to_s), true); }
bool Session::skip(double to_s) { return go(sim::to_instant(to_s), false); }
bool Session::advance_to_tick() { return go(state_->tick_after(sim::to_instant(state_->present.t_s)), true); }
bool Session::advance_to_hall_edge(double to_s) {
  State& s = *state_;
  const auto hall = static_cast<std::size_t>(ColumnId::hall);
  const double before = s.present.signals[hall];
  const Instant to = sim::to_instant(to_s);
  if (!s.over &&
      s.now() < to) {  // the event that ended the last slice may be an edge, and lies after present()
    Present here;
    Slice look{s.watchers, here, s.last, s.now(), s.reach, s.period()};
    s.run->look(look);
    if (here.signals[hall] != before) {
      s.present = here;
      return true;
    }
  }
  return go(to, true, static_cast<std::uint8_t>(before));
}
double Session::tick_after_s(double at_s) const {
  return state_->tick_after(sim::to_instant(at_s)).seconds();
}
bool Session::at_tick() const {
  const Instant now = state_->now(), next = state_->run->next_tick();
  return !state_->over && !(now < next) && !(next < now) && state_->is_tick(now) &&
         state_->present.t_s == now.seconds();
}
void Session::call_controller() const {
  State& s = *state_;
  Present present;
  Slice here{s.watchers, present, s.last, s.now(), s.reach, s.period()};
  s.run->look(here);
}

bool Session::go(const Instant& asked, bool read, std::optional<std::uint8_t> pins) {
  State& s = *state_;
  const Instant end = s.compiled->end;
  const bool to_end = !(asked < end);
  if (s.over) return false;
  if (!to_end && !(s.now() < asked)) {
    if (read && s.last) return s.look_back(asked);
    Slice here = s.slice(asked);
    if (read) s.run->look(here);  // reads the present instant, because skip() has stored no earlier instant
    return true;
  }
  Slice slice = s.slice(to_end ? end : asked);
  slice.unread = !read;
  slice.pins = pins;
  if (!read) s.last.reset();
  s.stop = s.now() < slice.until ? s.run->advance(end, slice) : sim::Stop::observer;
  // Actions that are due at the end of the run are executed too.
  const bool at_end = !(s.now() < end);
  if (at_end && s.stop == sim::Stop::observer && !slice.stopped && to_end)
    s.stop = s.run->advance(end, slice);
  s.over = s.stop != sim::Stop::observer || slice.stopped;
  if (!slice.taken && read) {
    if (pins) s.last.reset();  // the stored segment is out of date
    s.run->look(slice);
  }
  return !s.over;
}

base::Result<double> Session::change(At at) {
  State& s = *state_;
  const Instant next_tick = s.run->next_tick();
  const Instant when = next_change(s.now(), next_tick, s.reach, s.period());
  if (s.over || !(when < s.compiled->end))
    return base::Problem{"time_s", base::written(now_s()), "has no later control tick in the session",
                         "open a session with a longer duration_s"};
  at.time_s = when.seconds();
  Scenario candidate = *s.scenario;
  candidate.at.push_back(std::move(at));
  if (base::Problems problems = check(candidate, s.scenario->at.size()); !problems.empty()) return problems;
  base::Result<Compiled> compiled = compile(candidate);
  if (!compiled) return compiled.problems();
  if (compiled->general && !s.compiled->general)
    return base::Problem{
        "at", "", "needs the general kernel, and the session runs on the lean kernel",
        "begin the scenario with an [[at]] at time_s = 0 with bridge.phases = \"abc\": this event changes nothing, but selects the general kernel"};
  if (!same_past(*s.scenario, *s.compiled, *compiled, s.now()))
    return base::Problem{"reference", "",
                         "would change the drive's limits, which are fixed at the start of the session",
                         "add an [[at]] with the largest reference at the end of the session's scenario"};
  compiled->board.sensors.decodes_hall = true;
  compiled->board.chip = s.compiled->board.chip;
  rig::Timeline timeline = std::move(compiled->timeline);
  if (base::Problems problems = s.run->take(candidate, *compiled, std::move(timeline)); !problems.empty())
    return problems;
  s.figures_moved = s.figures_moved || candidate.at.back().reference;
  s.scenario = std::make_shared<const Scenario>(std::move(candidate));
  s.compiled = std::make_shared<const Compiled>(std::move(*compiled));
  return when.seconds();
}

base::Result<Outcome> Session::close(bool replay) {
  State& s = *state_;
  if (!s.over) {
    const Instant next_tick = s.run->next_tick();
    const std::int64_t period = s.period();
    Instant end = next_change(s.now(), next_tick, s.reach, period);
    if (end.ticks == 0) end.ticks = period;
    if (end < s.compiled->end) {
      Scenario cut = on_same_kernel(shortened(*s.scenario, end.seconds()), *s.compiled);
      base::Result<Compiled> compiled = compile(cut);
      if (!compiled || !same_past(cut, *s.compiled, *compiled, s.now()))
        return base::Problem{"duration_s", base::written(end.seconds()),
                             "is before a reference for which the drive's limits were designed",
                             "run the session to its end, or change the reference earlier"};
      compiled->board.chip = s.compiled->board.chip;
      rig::Timeline timeline = std::move(compiled->timeline);
      if (base::Problems problems = s.run->take(cut, *compiled, std::move(timeline)); !problems.empty())
        return problems;
      s.scenario = std::make_shared<const Scenario>(std::move(cut));
      s.compiled = std::make_shared<const Compiled>(std::move(*compiled));
      s.figures_moved = true;
    }
    advance(s.compiled->end.seconds());
  }
  Outcome out = outcome_of(*s.compiled);
  if (base::Problems problems = s.run->end(s.stop, s.watchers, out); !problems.empty()) return problems;
  conclude(*s.scenario, *s.compiled, s.watchers, out);
  if (!s.figures_moved || (s.scenario->require.empty() && s.scenario->compare.empty())) {
    s.watchers.figures.judge(*s.scenario, out);
    return out;
  }
  if (!replay) return out;
  const base::Result<Outcome> again = run(*s.scenario, {.keep_books = false});
  if (!again) return again.problems();
  out.verdicts = again->verdicts;
  out.comparisons = again->comparisons;
  return out;
}

}  // namespace sixstep::study
