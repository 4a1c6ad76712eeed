// SPDX-License-Identifier: Apache-2.0
// The list of the compared controllers, one row each. A row contains the keys in which its scenario differs
// from the common scenario (contest_bench.hpp). Everything else is equal.
#pragma once
#include <span>
#include <string_view>

namespace sixstep::analysis {

struct Contestant {
  std::string_view name;
  /// "key = value", separated by "; ", as for --set. contest_values() computes the values of <band_A> and
  /// other names. A table in braces replaces the table of the common scenario.
  std::string_view keys;
  std::string_view sentence;  ///< the difference and its effect, as a sentence that begins with "it"
  /// The drive in data/cores/ that consists of the same blocks; empty: its cost is not counted yet.
  std::string_view core_drive = "";
  /// For a user's own controller: largest number of instructions of a step, and bytes of flash; empty: not
  /// counted (text/contest/own_cost.hpp).
  std::string_view tick = "", flash_bytes = "";
};

inline constexpr std::string_view six_step_name = "six-step, soft";
inline constexpr std::string_view field_name = "field-oriented";

inline constexpr Contestant all_contestants[] = {
    {six_step_name, "",
     "chops only the upper switch: the current freewheels through a diode, and braking is a short circuit",
     "speed"},
    {"six-step, hard", "pwm.chopping = hard",
     "chops both switches: the current rises and falls with twice the voltage, and with twice the ripple",
     "speed"},
    {"six-step, complementary", "pwm.chopping = complementary",
     "turns the lower switch on while the upper switch is off: this avoids the diode's loss, and the current may change its sign",
     "speed"},
    {"six-step, PWM-ON-PWM", "pwm.pattern = pwm-on-pwm",
     "chops the entering leg's switch until the middle of a sector, then the staying leg's switch, so that no current flows in the free phase"},
    {"six-step, smooth", "control.smooth_chopping.on = true",
     "chops softly at large currents and complementarily at small ones", "speed"},
    {"six-step, fed forward", "pwm.chopping = complementary; control.current.back_emf_feed_forward = true",
     "adds the back-EMF at the measured speed to the voltage, so that the current loop has to control only R, L and the commutation",
     "speed"},
    {"six-step, advanced",
     "pwm.chopping = complementary; control.drive = product; sensors.hall_angle = sectors; "
     "control.advance.gain_deg_s_per_rad = <advance>; protection.over_current_A = <trip_A>; "
     "protection.over_voltage_V = <high_V>; protection.under_voltage_V = <low_V>; "
     "protection.over_speed_rad_s = <trip_rad_s>",
     "commutates ahead of the Hall edge by half of a commutation's duration, in the product drive",
     "product"},
    {"six-step, duty step", "pwm.pattern = pwm-on; control.current.commutation = duty-step",
     "keeps the staying phase's current constant during a commutation, by a special duty"},
    {"six-step, overlap", "pwm.pattern = pwm-on; control.current.commutation = overlap",
     "keeps the staying phase's current constant also above half the speed limit of the bus: the leaving phase is fed until the entering phase carries the current"},
    {"six-step, deadbeat", "pwm.chopping = complementary; control.current = {type = \"deadbeat\"}",
     "predicts the current and sets the voltage that brings the current to its reference in one period"},
    {"hysteresis, comparators",
     "control.current = {type = \"hysteresis\", band_A = <band_A>}; pwm.delay_periods = 0",
     "switches when comparators find the current outside the band: without sampling and delay, but at a variable frequency"},
    {"hysteresis, sampled",
     "control.current = {type = \"hysteresis\", band_A = <band_A>, comparator = \"sampled\"}",
     "compares once per period and switches a period late: the current leaves the band by its change during "
     "this delay"},
    {"speed to duty",
     "control.speed = {output = \"duty\", settle_s = <settle_s>, damping = <damping>}; control.current = {}; "
     "control.slew = <slew>",
     "has no current loop and no limit: its setpoint changes only as fast as the torque limit allows"},
    {"state feedback",
     "pwm.chopping = complementary; control.speed = {law = \"state-feedback\", settle_s = <settle_s>, torque_limit_Nm = <limit_Nm>}",
     "feeds back the speed and an estimated load: the controller compensates the load before the speed falls far"},
    {"disturbance rejection",
     "pwm.chopping = complementary; control.speed = {law = \"disturbance-rejection\", settle_s = <settle_s>, torque_limit_Nm = "
     "<limit_Nm>}",
     "estimates every disturbance of the acceleration and compensates the disturbance"},
    {"sliding mode",
     "pwm.chopping = complementary; control.speed = {law = \"sliding-mode\", settle_s = <settle_s>, torque_limit_Nm = <limit_Nm>}",
     "uses its full torque until the state is near the sliding surface, then keeps the state on this surface"},
    {field_name, "control.drive = field-oriented",
     "drives sine currents in the q axis with all three legs: the torque has no commutation ripple, but all three legs switch",
     "field"},
    {"field-oriented, harmonic i_q", "control.drive = field-oriented; control.field.harmonic_current = true",
     "drives currents that follow the shape of the back-EMF, so that the torque is the same at every angle"},
    {"field-oriented, finite set",
     "control.drive = field-oriented; control.field.law = finite-set; control.current = {}",
     "keeps one state of the legs for a whole period: the state whose predicted current is nearest to its reference"},
};

constexpr std::span<const Contestant> contestants() { return all_contestants; }

}  // namespace sixstep::analysis
