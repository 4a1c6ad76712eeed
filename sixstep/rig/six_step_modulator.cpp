// SPDX-License-Identifier: Apache-2.0
#include "sixstep/rig/six_step_modulator.hpp"

#include <bit>
#include <cmath>

namespace sixstep::rig {

using control::Chopping;
using control::Watch;
using sim::Instant;

namespace {

unsigned index(control::Leg leg) { return static_cast<unsigned>(leg); }

}  // namespace

/// Passes the state of the leg that leaves the pair to the leg that enters, and returns the entering leg.
/// Returns none_late if the two legs are the same, as at a change of sign: each leg keeps its state.
int SixStepModulator::hand_over(control::Pair to) {
  const auto legs_of = [](control::Pair pair) { return 1u << index(pair.source) | 1u << index(pair.sink); };
  const unsigned before = legs_of(command_.pair), after = legs_of(to);
  const unsigned entering = after & ~before, leaving = before & ~after;
  if (entering == 0 || leaving == 0) return LegTimer::none_late;
  const int entered = std::countr_zero(entering);
  timer_.hand_over(static_cast<unsigned>(std::countr_zero(leaving)), static_cast<unsigned>(entered));
  return entered;
}

int SixStepModulator::take(const Instant& t, const BoardCommand& command) {
  // mutant: command.enabled && !command_.enabled => command.enabled
  const bool wakes = command.enabled && !command_.enabled;
  const int entered = hand_over(command.pair);
  // The fields are copied separately, as they were written. A copy in wider pieces would stall the processor
  // until the fields are in memory. The binding does not compile if a field is added.
  const auto& [enabled, pair, duty, chopping, chopped, watch, overlap, on_below_A, off_above_A] = command;
  command_.enabled = enabled;
  command_.pair = pair;
  command_.duty = duty;
  command_.chopping = chopping;
  command_.chopped = chopped;
  command_.watch = watch;
  command_.overlap = overlap;
  command_.on_below_A = on_below_A;
  command_.off_above_A = off_above_A;
  if (!wakes) return entered;
  // The legs' previous states are unknown: every leg counts as changed by the first command.
  timer_.wake(t);
  timer_.preset_pulse(sink_pulse, true);
  if (watch != Watch::none)
    timer_.switch_pulse(source_pulse, true);  // hysteresis control starts with the pulse on (model.md 4)
  return entered;
}

void SixStepModulator::start_period(const Instant& t, const BoardCommand& command) {
  const int entered = take(t, command);
  timer_.start_period(t);
  if (command.enabled && command.watch == Watch::none) timer_.start_pulse(source_pulse, t, command.duty);
  if (command.overlap != 0.0 || timer_.pulse_on(overlap_pulse))
    timer_.start_pulse(overlap_pulse, t, std::fabs(command.overlap));
  fill_legs(t, entered);
}

void SixStepModulator::commutate(const Instant& t, control::Pair pair, control::ChoppedSwitch chopped) {
  const int entered = hand_over(pair);
  command_.pair = pair;
  command_.chopped = chopped;
  command_.overlap = 0.0;
  fill_legs(t, entered);
}

void SixStepModulator::turn_off(const Instant& t) {
  command_.enabled = false;
  fill_legs(t, LegTimer::none_late);
}

/// Sets the commands of three legs from the pair (model.md 3). Both legs of the pair follow one pulse. With
/// two comparators (hard chopping) the sink follows the second pulse.
void SixStepModulator::fill_legs(const Instant& t, int entered) {
  timer_.disconnect();
  if (command_.enabled) {
    const Chopping chopping = command_.chopping;
    const control::ChoppedSwitch chopped = command_.chopped;
    // mutant: sink_pulse => source_pulse
    const unsigned sink = command_.watch == Watch::phase ? sink_pulse : source_pulse;
    if (command_.pair.source != command_.pair.sink)  // otherwise gates() returns the commanded switches
      timer_.connect(index(command_.pair.source), sides_of(control::source_leg(chopping, chopped, 0.0)),
                     source_pulse);
    timer_.connect(index(command_.pair.sink), sides_of(control::sink_leg(chopping, chopped, 0.0)), sink);
    if (command_.overlap != 0.0)
      timer_.connect(index(control::free_leg(command_.pair)),
                     sides_of(control::overlapping_leg(command_.overlap)), overlap_pulse);
  }
  timer_.update(t, timer_.dead_time_at_commutation() ? entered : LegTimer::none_late);
}

ArmedComparator SixStepModulator::comparator(int which) const {
  const bool second = which == 1;
  if (!command_.enabled || command_.watch == Watch::none) return {};
  if (second && !(command_.watch == Watch::phase && command_.chopping == Chopping::hard)) return {};
  const bool on = timer_.pulse_on(second ? sink_pulse : source_pulse);
  return {true, on, on ? command_.off_above_A : command_.on_below_A};
}

plant::PerLeg<double> SixStepModulator::comparator_weights(int which) const {
  plant::PerLeg<double> weight{};
  const double share = command_.watch == Watch::motor ? 0.5 : 1.0;
  if (command_.watch == Watch::motor || which == 0) weight[index(command_.pair.source)] = share;
  if (command_.watch == Watch::motor || which == 1) weight[index(command_.pair.sink)] = -share;
  return weight;
}

void SixStepModulator::comparator_tripped(const Instant& now, int which) {
  const unsigned pulse = which == 1 ? sink_pulse : source_pulse;
  timer_.switch_pulse(pulse, !timer_.pulse_on(pulse));
  timer_.update(now);
}

}  // namespace sixstep::rig
