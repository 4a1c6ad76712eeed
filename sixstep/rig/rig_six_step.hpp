// SPDX-License-Identifier: Apache-2.0
// Member functions of rig.hpp for six-step only: the change of the pair at a Hall edge, and comparators that
// switch the pair's legs.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

/// The Hall interrupt of six-step. It changes the pair in the command in effect and in the pending commands.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::commutate() {
  move_pair(firmware_.hall_interrupt(chip_pins(), now_));
}

/// Executes the timer interrupt that commutates between two ticks. Returns false if no commutation is due.
template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_commutation() {
  if constexpr (has_commutation_clock) {
    if (now_ < firmware_.next_commutation()) return false;
    move_pair(firmware_.commutation_interrupt(now_));
    return true;
  }
  return false;
}

template <class Real, class Firmware, class Plant>
template <class Answer>
void Rig<Real, Firmware, Plant>::move_pair(const Answer& answer) {
  if (answer.fault && ends_run(firmware_)) fault_ = fault_of(firmware_.diagnosis());
  if (!answer.enabled) return let_go();
  // mutant: pending_.pair = answer.pair; => nothing
  pending_.pair = answer.pair;
  pending_.chopped = answer.chopped;
  pending_.duty = to_si(answer.duty, 1.0);
  pending_.overlap = to_si(answer.overlap, 1.0);
  if (board_.sampled_in_middle) {
    loaded_.pair = firmware_.reversed() == loaded_reversed_ ? answer.pair : control::swapped(answer.pair);
    loaded_.chopped = answer.chopped;
    if (!board_.delayed) {
      loaded_.duty = pending_.duty;
      loaded_.overlap = pending_.overlap;
    }
  }
  // mutant: firmware_.reversed() == reversed_ => true
  if (firmware_.reversed() == reversed_)
    modulator_.commutate(now_, answer.pair, answer.chopped);
  else
    modulator_.commutate(now_, control::swapped(answer.pair));
}

/// Switches the pulses of comparators whose current is beyond the comparator's level. Returns true if a pulse
/// was switched.
template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::compare() {
  const int switched = modulator_.compare(now_, wires_.at_legs(plant_.state().i));
  event_counts_[static_cast<std::size_t>(EventKind::comparator)] += switched;
  due_ = next_due();
  return switched > 0;
}

/// Processes the event that a comparator's current has reached its level. If two legs conduct, both phases
/// have the same current, and two comparators with equal levels switch at the same instant. The second
/// comparator must then switch too, independent of rounding errors of the current.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::trip(int which) {
  const ArmedComparator other = modulator_.comparator(1 - which);
  const bool same_level = other.armed && other.switches_off == modulator_.comparator(which).switches_off;
  modulator_.comparator_tripped(now_, which);
  if (!same_level || plant::connected_count(plant_.mode().legs) != 2) return;
  const plant::PerLeg<double> weight = modulator_.comparator_weights(1 - which);
  const plant::PerLeg<Real>& i = wires_.at_legs(plant_.state().i);
  const Real current = Real(weight[0]) * i[0] + Real(weight[1]) * i[1] + Real(weight[2]) * i[2];
  if (std::fabs(current - Real(other.level_A)) > plant_.constants().amp_noise) return;
  count(EventKind::comparator);
  modulator_.comparator_tripped(now_, 1 - which);
}

template <class Real, class Firmware, class Plant>
template <class Visit>
void Rig<Real, Firmware, Plant>::comparator_guards(Visit&& visit) const {
  for (int which = 0; which < 2; ++which) {
    const ArmedComparator c = modulator_.comparator(which);
    if (!c.armed) continue;
    const plant::PerLeg<double> weight = modulator_.comparator_weights(which);
    const plant::Expansion<Real>& y = plant_.expansion();
    const Real sign = c.switches_off ? Real(-1) : Real(1);
    const auto current = [&](int j) {
      return sign * (Real(weight[0]) * y.i[wires_.phase(0)][j] + Real(weight[1]) * y.i[wires_.phase(1)][j] +
                     Real(weight[2]) * y.i[wires_.phase(2)][j]);
    };
    series::Coefficients<Real> g;
    g[0] = current(0) - sign * Real(c.level_A);
    for (int j = 1; j <= y.degree; ++j) g[j] = current(j);
    visit(plant::guard::first_free + which, g, y.degree, plant_.constants().amp_noise);
  }
}

}  // namespace sixstep::rig
