// SPDX-License-Identifier: Apache-2.0
// Designs the gains of a whole drive from a motor and a spec, loop by loop from the inside out. It also
// computes the figures by which a designer judges each loop, and warnings where a figure is poor. Everything
// is in closed form, without simulation.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/loops/late_words.hpp"
#include "sixstep/design/loops/loop_figures.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/design/loops/settling_limits.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

enum class GainMethod : std::uint8_t { pole_placement, cancellation, symmetrical_optimum };

/// Demands on a drive. An empty member has the thesis's value, scaled to this motor.
struct DesignSpec {
  control::Mode mode = control::Mode::current;  ///< current, speed or position
  GainMethod method = GainMethod::pole_placement;
  /// Settling time of the PI of `mode`, s. Default for current: 1 ms, or 8 L/R if it is shorter. Default for
  /// speed: the longest of 10 ms, the limit by the sensor, and the limit by torque and inertia
  /// (settle_by_torque_s).
  std::optional<double> settle_s;
  /// Settling time of the current loop inside a speed loop, s. Default: as for current, or a tenth of the
  /// speed loop's settling time if it is shorter.
  std::optional<double> current_settle_s;
  double damping = usual_damping;
  std::optional<double> current_damping;  ///< damping of the current loop inside a speed loop; default:
                                          ///< `damping`
  std::optional<double> bandwidth_rad_s;  ///< bandwidth of the loop that `method` designs; default:
                                          ///< 4.6/settle_s
  double period_s = 30e-6;
  std::optional<double> voltage_V;        ///< voltage of the bus; default: the sheet's nominal voltage
  std::optional<double> torque_limit_Nm;  ///< torque at full output of the speed loop; default:
                                          ///< usual_torque_limit_Nm
  std::optional<double> current_limit_A;  ///< limit of the speed loop's output, if less than full output
  double load_inertia_kg_m2 = 0.0;        ///< inertia on the shaft, in addition to the rotor's inertia
  int delay_periods = 0;                  ///< whole periods from a sample until its output acts, 0 or 1
  bool sampled_in_middle = false;         ///< samples in the middle of a period; the output acts at the next
                                          ///< period's start or later
  control::Chopping chopping = control::Chopping::soft;
  RotorSensing rotor{.hall = false};
  /// Lowest required speed; default: a tenth of the speed that the bus reaches, bus/K_t.
  std::optional<double> lowest_speed_rad_s;

  /// Control periods from a sample until its output acts: 0, 1/2, 1 or 3/2.
  double late_periods() const { return delay_periods + (sampled_in_middle ? 0.5 : 0.0); }
  /// The shorter of the two possible delays of a board with these samples, in periods; later_periods() is the
  /// longer delay.
  double sooner_periods() const { return sampled_in_middle ? 0.5 : 0.0; }
  double later_periods() const { return sooner_periods() + 1.0; }
};

/// Default settling time of a current loop, s: 1 ms, or 8 L/R if it is shorter.
double usual_current_settle_s_of(const MotorModel& motor);

/// Default clock of the timer that captures a sensor's edges, Hz. For Hall probes it is the default of a
/// scenario's sensors. An encoder has far more edges; its clock is the clock of an ordinary chip, whose tick
/// is short compared with a control period.
inline constexpr double usual_capture_Hz = 1e6, usual_encoder_capture_Hz = 16e6;

/// A spec for a real board: Hall probes, and an output that acts one period late.
inline DesignSpec on_a_board() {
  DesignSpec spec;
  spec.rotor.hall = true;
  spec.rotor.capture_Hz = usual_capture_Hz;
  spec.delay_periods = 1;
  return spec;
}

struct LoopDesign {
  std::string name;    ///< "current", "speed", "position"
  std::string method;  ///< method of the design, as text
  PiGains gains;       ///< position: d1 is the gain in rad/s per degree, d0 = 0
  std::vector<DerivationStep> steps;
  std::optional<PolePlacement> placed;
  Transfer loop;        ///< open loop with the spec's delay and with closed inner loops
  LoopFigures figures;  ///< figures of `loop`
  LoopFigures other;    ///< figures of the loop with the board's second possible delay, one period longer or
                        ///< shorter
  LoopFigures built;    ///< figures of `loop` with the lag of the speed sensor at the lowest speed
  StepResponse step;    ///< step of the closed loop with the sensor's lag
};

/// Subject of a warning.
enum class Concern : std::uint8_t {
  other,
  stability,
  delay,
  pace,
  sign,
  overshoot,
  separation,
  sensing,
  grain,
  rest,
  voltage,
  ripple,
  braking,
  heat,
  reach,
  settling,
  swing,
  shunt,
  fault,
  requirement,
  board
};

struct Warning {
  std::string what;  ///< the warning, in one sentence
  /// Cure that trials found (analysis/verify/advice.hpp); empty if no trial helped.
  std::string cure;
  bool grave = false;  ///< true: the design is not usable
  Concern of = Concern::other;
};

struct DriveDesign {
  DesignSpec spec;
  MotorModel motor;  ///< its inertia is the sum of the load's and the rotor's inertia
  double bus_V = 0.0;
  double torque_limit_Nm = 0.0;
  double current_at_full_torque_A = 0.0;
  double nominal_current_A = 0.0;
  bool nominal_printed = true;  ///< false: the sheet has no nominal current, and a tenth of the stall current
                                ///< is used
  double lowest_speed_rad_s = 0.0;
  SpeedLag lag;                         ///< lag of the measured speed at the lowest speed
  std::vector<DerivationStep> sensing;  ///< derivation of `lag`
  std::vector<SettlingLimit> limits;    ///< for speed and position: limits of the settling time for each kind
                                        ///< of sensing
  double settle_by_torque_s =
      0.0;  ///< speed: 1.5 times the time that the torque limit needs to change the speed by half the lowest
            ///< speed, J w_low/(2 T_max)
  std::vector<LoopDesign> loops;  ///< all loops, from the inside out
  Ripple ripple;
  double longest_period_s =
      0.0;  ///< longest period at which the current loop has 45 degrees of phase margin with the longer
            ///< of the delays
  double headroom_end_rad_s = 0.0;   ///< highest speed at which the bus drives the nominal current
  double high_speed_rad_s = 0.0;     ///< with a speed loop: nine tenths of headroom_end_rad_s
  double speed_step_rad_s = 0.0;     ///< step of the measured speed at high_speed_rad_s while the speed is
                                     ///< constant
  double speed_step_part = 0.0;      ///< output step of the speed loop for speed_step_rad_s, relative to the
                                     ///< torque limit
  double speed_step_V = 0.0;         ///< output step of the current loop for this torque step, in the same
                                     ///< sample
  double high_speed_left_V = 0.0;    ///< remaining voltage of the bus at high_speed_rad_s and half the
                                     ///< nominal current
  double braking_limit_rad_s = 0.0;  ///< highest speed at which soft chopping can limit the braking current
                                     ///< to the nominal current
  double commutation_limit_rad_s =
      0.0;  ///< highest speed at which a duty can keep the nominal current constant through a commutation
  std::vector<Warning> warnings;

  const LoopDesign& loop(std::string_view name) const;
  /// Largest current at the output of the speed loop, A: the current at full output, or the spec's current
  /// limit.
  double most_current_A() const;
  double most_torque_Nm() const;
  /// A loop's figures with the shorter of the two delays; later() returns them with the longer delay.
  const LoopFigures& sooner(const LoopDesign& loop) const {
    return spec.delay_periods > 0 ? loop.other : loop.figures;
  }
  const LoopFigures& later(const LoopDesign& loop) const {
    return spec.delay_periods > 0 ? loop.figures : loop.other;
  }
};

/// Name of nominal_current_A in messages; the name shows if the value is not from the sheet.
inline const char* nominal_current_words(const DriveDesign& d) {
  return d.nominal_printed ? "the nominal current"
                           : "a tenth of the stall current (the sheet names no nominal current)";
}

/// Relative band of a loop's settling time, for the linear step and for the run.
double settling_band(const DriveDesign& design, const LoopDesign& loop);

/// Relative band in which a step of the speed counts as settled: 2 %. With Hall probes it is 10 %, because
/// their speed is coarse: the test's step is half of the lowest speed, and 10 % of the step are a twentieth
/// of this speed.
double settling_band(const DriveDesign& design);

/// Designs the gains for the spec. In position mode the gain is the largest gain without overshoot of the
/// linear loop. analysis/verify/position_gain.hpp then finds the largest gain that the limits allow, and sets
/// it with with_position_gain(). Problems name the option.
base::Result<DriveDesign> design_drive(const MotorModel& motor, const DesignSpec& spec);

/// The same design with another position gain; figures and warnings are recomputed.
DriveDesign with_position_gain(const DriveDesign& design, double gain_rad_s_per_deg);

/// Computes figures and step of a loop with given gains: for the open loop with its delay, with the other
/// delay, and with the speed sensor's lag. `band`: settling band of a speed loop.
void judge_loop(LoopDesign& loop, const Transfer& open, const Transfer& other, const SensedLoop& sensed,
                double period_s, double band);

/// Open loops of the same controller on another motor, from the inside out. They show the effect of
/// tolerances on the margins.
std::vector<Transfer> open_loops(const DriveDesign& design, const MotorModel& motor, double late_periods);

/// The same open loops with the lag of the spec's speed sensor at the lowest speed.
std::vector<SensedLoop> sensed_loops(const DriveDesign& design, const MotorModel& motor, double late_periods);

}  // namespace sixstep::design
