// SPDX-License-Identifier: Apache-2.0
// The controller of a scenario. control_description.hpp describes each key.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/study/scenario/field.hpp"
#include "sixstep/study/scenario/own.hpp"
#include "sixstep/study/scenario/sensorless.hpp"

namespace sixstep::study {

enum class CurrentLoopType : std::uint8_t { pi, hysteresis, deadbeat };
/// The current that the loop controls: the mean (i_p - i_n)/2 of the driven pair, or the current of the
/// staying phase. The staying phase belongs to the pair before the last commutation and to the pair after it.
enum class CurrentFeedback : std::uint8_t { mean, staying_phase };
/// The duty during a commutation: the loop's duty (plain), or a duty that keeps the staying phase's current
/// constant (duty_step; overlap also drives the leaving phase's leg if duty 1 is too small).
enum class CurrentCommutation : std::uint8_t { plain, duty_step, overlap };
enum class HysteresisOn : std::uint8_t { motor, phase };
enum class Comparator : std::uint8_t { event, sampled };

/// The current loop. A PI's gains are given as d1 and d0, or as kp with ki (per sample) or ki_per_s (per
/// second), or they are designed by pole placement from settle_s and damping.
struct CurrentLoop {
  CurrentLoopType type = CurrentLoopType::pi;
  std::optional<double> settle_s, damping;
  std::optional<double> d1, d0;
  std::optional<double> kp, ki, ki_per_s;
  double band_A = 0.2;
  HysteresisOn on = HysteresisOn::motor;
  Comparator comparator = Comparator::event;
  std::optional<double> limit_A;  // bound of the current reference; only in a cascade
  bool back_emf_feed_forward = false;
  CurrentFeedback feedback = CurrentFeedback::mean;
  CurrentCommutation commutation = CurrentCommutation::plain;
  std::optional<double> correction;           // deadbeat: part of the prediction error corrected per sample
  std::optional<double> measured_bus_from_V;  // at this bus voltage and above, duty = u/measured bus; below,
                                              // u/nominal bus
};

/// True if the loop gives any key from which a PI's gains follow.
template <class Loop>
bool gives_gains(const Loop& loop) {
  return loop.d1 || loop.d0 || loop.kp || loop.ki || loop.ki_per_s || loop.settle_s || loop.damping;
}

enum class SpeedOutput : std::uint8_t { current, duty };

/// The form of the speed loop's PI: incremental (pi.hpp), or positional (pi_positional.hpp with
/// derivative.hpp).
enum class SpeedForm : std::uint8_t { incremental, positional };

/// The law that computes a torque from a speed error (design/loops/speed_laws.hpp).
enum class SpeedLaw : std::uint8_t { pi, state_feedback, disturbance_rejection, sliding_mode };

struct SpeedLoop {
  SpeedOutput output = SpeedOutput::current;
  SpeedLaw law = SpeedLaw::pi;
  SpeedForm form = SpeedForm::incremental;
  std::optional<double> settle_s, damping;
  std::optional<double> d1, d0;
  std::optional<double> kp, ki, ki_per_s;
  std::optional<double> torque_limit_Nm;
  std::optional<double> anti_windup;
  std::optional<double> derivative_s, derivative_filter_s;
  std::optional<double> setpoint_weight;
  std::optional<double> observer_ratio;
};

/// The profile of the position loop's setpoint (control/profiled_position.hpp). Values that are not given are
/// computed from the drive's torque and speed limits (compile/position_profile.cpp).
struct PositionProfile {
  bool on = false;  // false: the setpoint is not shaped
  std::optional<double> speed_rad_s, acceleration_rad_s2;
  std::optional<double> jerk_rad_s3, smoothing_s;
  bool feed_forward = true;
  bool operator==(const PositionProfile&) const = default;
};

struct PositionLoop {
  double gain_rad_s_per_deg = 1.0;
  std::optional<double> speed_limit_rad_s;
  PositionProfile profile;
};

/// Number format of the controller; fixed-point formats are named by their fraction bits.
enum class Arithmetic : std::uint8_t { float64, float32, q15, q14, q31, q30 };

/// Fixed point: the largest value that each quantity can have. The default is computed by operating_range()
/// (compile/arithmetic.hpp).
struct FullScale {
  std::optional<double> current_A, voltage_V, speed_rad_s, position_deg;
};

/// Limits the bus voltage of a supply that cannot take current back: the drive brakes less.
struct Regeneration {
  std::optional<double> limit_V;
  std::optional<double> gain_A_per_V;
};

/// Bounds of the current reference (control/limits.hpp); a bound that is not given has no effect.
struct Limits {
  std::optional<double> current_A;
  std::optional<double> torque_Nm;
  std::optional<double> speed_rad_s;
  std::optional<double> gain_A_s_per_rad;
};

/// Chopping chosen by the current (control/smooth_chopping.hpp), instead of pwm.chopping.
struct SmoothChopping {
  bool on = false;
  std::optional<double> soft_above_A;
  std::optional<double> complementary_below_A;
};

/// Commutation ahead of the Hall edge (control/advance.hpp), in electrical degrees.
struct Advance {
  double angle_deg = 0.0;
  double gain_deg_s_per_rad = 0.0;
  double limit_deg = 30.0;
};
constexpr bool advances(const Advance& a) { return a.angle_deg > 0 || a.gain_deg_s_per_rad > 0; }

/// The chip's program (rig/firmware.hpp, rig/sensorless_drive.hpp, rig/field_drive.hpp, rig/own_drive.hpp).
enum class FirmwareKind : std::uint8_t { lean, product, sensorless, field, own };

struct Control {
  FirmwareKind drive = FirmwareKind::lean;
  control::Mode mode = control::Mode::off;
  Arithmetic arithmetic = Arithmetic::float64;
  FullScale full_scale;
  CurrentLoop current;
  SpeedLoop speed;
  PositionLoop position;
  std::optional<double> slew;  // largest rate of the setpoint, in the mode's unit
  Limits limits;
  Regeneration regeneration;
  SmoothChopping smooth_chopping;
  Advance advance;
  Sensorless sensorless;
  Field field;
  Own own;
};

}  // namespace sixstep::study
