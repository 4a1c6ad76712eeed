// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/unused_keys.hpp"

#include <algorithm>
#include <iterator>

#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/study/check/unused_list.hpp"
#include "sixstep/study/measure/device_watch.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {
namespace {

void of_power(const Scenario& s, bool ambient_is_used, Unused& out) {
  if (!s.heat.motor && !s.heat.devices)
    out.add("heat.step_s", s.heat.step_s, Heat{}.step_s, "nothing warms up");
  if (!s.heat.motor && !s.heat.devices && !ambient_is_used)
    out.add("heat.ambient_degC", s.heat.ambient_degC, Heat{}.ambient_degC, "nothing warms up");
  const Bridge& b = s.bridge;
  if (!(b.turn_on_J > 0 || b.turn_off_J > 0 || b.recovery_J > 0)) {
    out.add("bridge.energies_at_V", b.energies_at_V, Bridge{}.energies_at_V, "no energies are given");
    out.add("bridge.energies_at_A", b.energies_at_A, Bridge{}.energies_at_A, "no energies are given");
  }
  if (!(s.bridge.dead_time_s > 0))
    out.add("bridge.dead_time_at_commutation", s.bridge.dead_time_at_commutation,
            Bridge{}.dead_time_at_commutation, "bridge.dead_time_s is 0");
  if (!s.heat.devices && !tells_losses(s.bridge)) {
    constexpr char reason[] = "no junction warms up, and no losses are reported";
    out.add("bridge.junction_K_W", s.bridge.junction_K_W, Bridge{}.junction_K_W, reason);
    out.add("bridge.sink_degC", s.bridge.sink_degC, Bridge{}.sink_degC, reason);
  }
  if (s.supply.source != SourceKind::battery)
    out.add("supply.battery_charge", s.supply.battery_charge, Supply{}.battery_charge, "no battery");
  if (s.supply.source == SourceKind::steady || s.supply.source == SourceKind::battery)
    out.add("supply.mains_Hz", s.supply.mains_Hz, Supply{}.mains_Hz, "no mains");
}

void of_protection(const Scenario& s, Unused& out) {
  if (s.control.drive != FirmwareKind::product) {
    constexpr char reason[] = "control.drive is not product";
    const Protection none, &p = s.protection;
    out.add("protection.voltage_samples", p.voltage_samples, none.voltage_samples, reason);
    out.add("protection.offset_tolerance_A", p.offset_tolerance_A, none.offset_tolerance_A, reason);
    out.add("protection.short_below_rad_s", p.short_below_rad_s, none.short_below_rad_s, reason);
    out.add("protection.standing_rad_s", p.standing_rad_s, none.standing_rad_s, reason);
  }
  const Align usual, &x = s.protection.align;
  if (x.current_A) return;
  constexpr char reason[] = "no protection.align.current_A";
  out.add("protection.align.longest_s", x.longest_s, usual.longest_s, reason);
  out.add("protection.align.settled_s", x.settled_s, usual.settled_s, reason);
  out.add("protection.align.sector", x.sector, usual.sector, reason);
}

void of_control(const Scenario& s, Unused& out) {
  const Control usual, &x = s.control;
  if (x.current.type != CurrentLoopType::hysteresis && s.at.empty()) {
    constexpr char reason[] = "control.current.type is not hysteresis";
    out.add("control.current.band_A", x.current.band_A, usual.current.band_A, reason);
    out.add("control.current.on", x.current.on, usual.current.on, reason);
    out.add("control.current.comparator", x.current.comparator, usual.current.comparator, reason);
  }
  if (!x.regeneration.limit_V)
    out.add("control.regeneration.gain_A_per_V", x.regeneration.gain_A_per_V, usual.regeneration.gain_A_per_V,
            "no control.regeneration.limit_V");
  if (!advances(x.advance))
    out.add("control.advance.limit_deg", x.advance.limit_deg, usual.advance.limit_deg, "nothing is advanced");
  if (!x.smooth_chopping.on) {
    constexpr char reason[] = "control.smooth_chopping.on is false";
    out.add("control.smooth_chopping.soft_above_A", x.smooth_chopping.soft_above_A, {}, reason);
    out.add("control.smooth_chopping.complementary_below_A", x.smooth_chopping.complementary_below_A, {},
            reason);
  }
}

/// Finds keys of loops that are closed neither in the first mode nor in the mode of an event.
void of_idle_loops(const Scenario& s, Unused& out) {
  using control::Mode;
  const bool position = comes_into(s, Mode::position), speed = position || comes_into(s, Mode::speed);
  if (!position) {
    constexpr char none[] = "control.mode has no position loop";
    const PositionLoop usual, &x = s.control.position;
    out.add("control.position.gain_rad_s_per_deg", x.gain_rad_s_per_deg, usual.gain_rad_s_per_deg, none);
    out.add("control.position.speed_limit_rad_s", x.speed_limit_rad_s, usual.speed_limit_rad_s, none);
    out.add("control.position.profile.on", x.profile.on, usual.profile.on, none);
  }
  if (speed) return;
  const std::string reason = "control.mode has no speed loop";
  const SpeedLoop usual, &x = s.control.speed;
  const auto idle = [&](const char* key, const auto& given, const auto& unset) {
    out.add(key, given, unset, reason);
  };
  idle("control.speed.output", x.output, usual.output);
  idle("control.speed.law", x.law, usual.law);
  idle("control.speed.form", x.form, usual.form);
  idle("control.speed.settle_s", x.settle_s, usual.settle_s);
  idle("control.speed.damping", x.damping, usual.damping);
  idle("control.speed.d1", x.d1, usual.d1);
  idle("control.speed.d0", x.d0, usual.d0);
  idle("control.speed.kp", x.kp, usual.kp);
  idle("control.speed.ki", x.ki, usual.ki);
  idle("control.speed.ki_per_s", x.ki_per_s, usual.ki_per_s);
  idle("control.speed.torque_limit_Nm", x.torque_limit_Nm, usual.torque_limit_Nm);
  idle("control.current.limit_A", s.control.current.limit_A, std::optional<double>());
  if (comes_into(s, Mode::current)) return;
  constexpr char open[] = "control.mode has no current loop";
  const CurrentLoop none, &y = s.control.current;
  out.add("control.current.type", y.type, none.type, open);
  out.add("control.current.feedback", y.feedback, none.feedback, open);
  out.add("control.current.settle_s", y.settle_s, none.settle_s, open);
  out.add("control.current.damping", y.damping, none.damping, open);
  out.add("control.current.back_emf_feed_forward", y.back_emf_feed_forward, none.back_emf_feed_forward, open);
  out.add("control.current.measured_bus_from_V", y.measured_bus_from_V, none.measured_bus_from_V, open);
}

/// Comparators and a finite set choose the switches' states directly.
void of_pulses(const Scenario& s, Unused& out) {
  const bool currents = s.at.empty() && s.control.mode >= control::Mode::current;
  const bool comparators = s.control.current.type == CurrentLoopType::hysteresis;
  const bool states = s.control.drive == FirmwareKind::field && s.control.field.law == FieldLaw::finite_set;
  if (!currents || (!comparators && !states)) return;
  const std::string reason =
      comparators ? "control.current.type is hysteresis" : "control.field.law is finite-set";
  out.add("pwm.minimum_pulse_s", s.pwm.minimum_pulse_s, Pwm{}.minimum_pulse_s, reason);
  if (comparators) out.add("pwm.alignment", s.pwm.alignment, Pwm{}.alignment, reason);
}

/// Finds laws of a load that never moves. Behind an elastic shaft the load moves while the rotor is held. The
/// design of a speed loop uses inertia, friction and gear even if the rotor is held.
void of_load(const Scenario& s, Unused& out) {
  const Load usual, &x = s.load;
  const bool elastic = x.stiffness_Nm_rad > 0;
  if (!x.dynamometer_rad_s.empty() && !elastic)
    out.add("load.static_Nm", x.static_Nm, usual.static_Nm, "a dynamometer turns the shaft");
  const bool freed =
      std::any_of(s.at.begin(), s.at.end(), [](const At& at) { return at.load.locked == false; });
  if (!x.locked || freed || elastic) return;
  constexpr char reason[] = "load.locked is true";
  const auto add = [&](const char* key, const auto& given, const auto& unset) {
    out.add(std::string("load.") + key, given, unset, reason);
  };
  add("torque_Nm", x.torque_Nm, usual.torque_Nm);
  add("torques_Nm", x.torques_Nm, usual.torques_Nm);
  add("at_speeds_Nm", x.at_speeds_Nm, usual.at_speeds_Nm);
  add("coulomb_Nm", x.coulomb_Nm, usual.coulomb_Nm);
  add("static_Nm", x.static_Nm, usual.static_Nm);
  out.add(square_law(x).key, square_law(x).Nm_s2, square_law(usual).Nm_s2, reason);
  add("gravity_Nm", x.gravity_Nm, usual.gravity_Nm);
  if (comes_into(s, control::Mode::speed) || comes_into(s, control::Mode::position)) return;
  add("viscous_Nm_s", x.viscous_Nm_s, usual.viscous_Nm_s);
  add("inertia_kg_m2", x.inertia_kg_m2, usual.inertia_kg_m2);
  add("gear", x.gear, usual.gear);
}

/// Finds overridden lines of the sheet that the model does not use. Some other lines have no effect on the
/// model either, but on the run's defaults or remarks:
/// - the nominal current sets the default torque limit;
/// - the nominal voltage is compared with the default bus in a remark;
/// - limits cause remarks.
void of_sheet(const Scenario& s, Unused& out) {
  if (!s.motor_sheet) return;
  const base::Result<design::SheetCheck> now = design::check_sheet(s.sheet),
                                         file = design::check_sheet(*s.motor_sheet);
  if (!now || !file) return;
  constexpr std::string_view lines[] = {"no_load_current_mA",       "no_load_speed_rpm",
                                        "no_load_voltage_V",        "second_no_load_current_mA",
                                        "second_no_load_speed_rpm", "second_no_load_voltage_V",
                                        "stall_current_A",          "stall_torque_mNm",
                                        "nominal_speed_rpm",        "nominal_torque_mNm"};
  for (const design::LineUse& line : now->lines) {
    if (line.used || std::find(std::begin(lines), std::end(lines), line.key) == std::end(lines)) continue;
    const bool as_in_file = std::any_of(file->lines.begin(), file->lines.end(), [&line](const auto& printed) {
      return printed.key == line.key && printed.value == line.value;
    });
    if (!as_in_file) out.add(("motor_override." + line.key), true, false, line.why);
  }
}

}  // namespace

std::string unused_keys(const Scenario& s, bool ambient_is_used) {
  Unused out;
  unused_of_sensors(s, out);
  of_power(s, ambient_is_used, out);
  of_protection(s, out);
  of_control(s, out);
  of_idle_loops(s, out);
  of_pulses(s, out);
  of_load(s, out);
  of_sheet(s, out);
  unused_beliefs(s, out);
  return out.text();
}

}  // namespace sixstep::study
