// SPDX-License-Identifier: Apache-2.0
// Collects the values for a run's remarks (study/run/remarks.hpp): extremes, and how often a shunt showed no
// current.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>

#include "sixstep/study/measure/signals.hpp"

namespace sixstep::study {

struct RunWatch {
  double fastest_rad_s = 0.0;
  double emf_rad_s = 0.0, emf_bus_V = 1.0;  ///< speed and bus at the largest ratio of back-EMF to bus
  double highest_bus_V = 0.0;
  double highest_phase_A = 0.0;                      ///< largest magnitude of a phase current
  double lowest_charge = 1.0, highest_charge = 0.0;  ///< charge of a battery
  std::optional<double> empty_s{}, full_s{};  ///< when the battery was first empty, and when first overfull
  double winding_degC = 0.0, junction_degC = 0.0;  ///< highest temperatures so far; only with the general
                                                   ///< kernel
  double shunt_least_duty = -1.0;  ///< a shunt shows a current above this duty; negative: no shunt
  std::int64_t samples = 0, hidden_samples = 0;  ///< all samples of the shunt, and the samples in which it
                                                 ///< shows no current
  bool held_a_commutation = false;               ///< true: the drive made at least one duty step
  bool held_other_duty = false;  ///< true: in or just before a duty step, the duty was below 1
  double duty_before = 0.0;      ///< magnitude of the drive's last duty outside of a duty step
  double held_rad_s = 0.0,
         held_A = 0.0;  ///< speed and current reference of the duty step at which their product was largest

  template <class Rig>
  void segment(const Rig& rig) {
    const auto& state = rig.plant().state();
    const double speed = std::fabs(state.w);
    if (speed > fastest_rad_s) fastest_rad_s = speed;
    if (speed * emf_bus_V > emf_rad_s * state.bus) {
      emf_rad_s = speed;
      emf_bus_V = state.bus;
    }
    if (state.bus > highest_bus_V) highest_bus_V = state.bus;
    for (const auto i : state.i)
      if (const double ampere = std::fabs(static_cast<double>(i)); ampere > highest_phase_A)
        highest_phase_A = ampere;
    if constexpr (requires { rig.firmware().holds_commutation(); }) look_at_commutation(rig, speed);
    if constexpr (requires { rig.plant().more(); }) look_at_charge(rig.plant().more().charge.value, rig);
    if (shunt_least_duty >= 0.0 && rig.ticked()) {
      ++samples;
      const double duty = signed_duty(ModulatorView(rig.modulator()), rig.board_sector());
      hidden_samples += std::fabs(duty) <= shunt_least_duty ? 1 : 0;
    }
  }

  /// If the duty is 1 before and during a duty step, the step changes nothing. A duty of 1 in fixed point may
  /// be slightly below 1.
  template <class Rig>
  void look_at_commutation(const Rig& rig, double speed) {
    constexpr double full = 0.999;
    const double told = std::fabs(static_cast<double>(rig.telemetry().duty));
    if (!rig.firmware().holds_commutation()) {
      duty_before = told;
      return;
    }
    held_a_commutation = true;
    const double asked = std::fabs(rig.current_reference_A());
    if (speed * asked > held_rad_s * held_A) {
      held_rad_s = speed;
      held_A = asked;
    }
    if (held_other_duty) return;
    const double in_effect = std::fabs(signed_duty(ModulatorView(rig.modulator()), rig.board_sector()));
    held_other_duty = duty_before < full || told < full || in_effect < full;
  }

  /// A battery counts as overfull only above 1.001: rounding, and a small charge that flows back into a full
  /// battery, are ignored.
  template <class Rig>
  void look_at_charge(double charge, const Rig& rig) {
    if (charge < lowest_charge) {
      lowest_charge = charge;
      if (charge < 0.0 && !empty_s) empty_s = rig.now().seconds();
    }
    if (charge > highest_charge) {
      highest_charge = charge;
      if (charge > 1.001 && !full_s) full_s = rig.now().seconds();
    }
  }

  /// Called from time to time and at the end only, because temperatures change slowly and each call costs an
  /// exponential.
  template <class Rig>
  void look(const Rig& rig) {
    if constexpr (requires { rig.plant().heat(); }) {
      if (!rig.plant().heat().on()) return;
      winding_degC = std::fmax(winding_degC, rig.plant().bodies_degC(0.0).winding);
      junction_degC = std::fmax(junction_degC, rig.plant().heat().hottest_junction_degC());
    }
  }
};

}  // namespace sixstep::study
