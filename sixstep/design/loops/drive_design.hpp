// SPDX-License-Identifier: Apache-2.0
// From a motor and a spec to the gains of a whole drive, loop by loop from the inside out, with the figures
// by which a designer judges each loop and a warning where one is off. Closed form: nothing is simulated
// here.
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

/// What is wanted. What is left out is the thesis's choice, carried over to this motor.
struct DesignSpec {
  control::Mode mode = control::Mode::current;  ///< current, speed or position
  GainMethod method = GainMethod::pole_placement;
  /// Of the PI of the mode; for current 1 ms, or 8 L/R where that is shorter; for speed 10 ms, or what the sensor allows, or what torque
  /// limit and inertia ask for (settle_by_torque_s), where one of those is more.
  std::optional<double> settle_s;
  /// Of the inner loop; as above, or a tenth of the speed loop's where that is shorter.
  std::optional<double> current_settle_s;
  double damping = usual_damping;
  std::optional<double> current_damping;  ///< of the inner loop; else as above
  std::optional<double> bandwidth_rad_s;  ///< of the loop the method is for; else 4.6/settle_s
  double period_s = 30e-6;
  std::optional<double> voltage_V;        ///< of the bus; else the sheet's
  std::optional<double> torque_limit_Nm;  ///< full output of the speed loop; else usual_torque_limit_Nm
  std::optional<double>
      current_limit_A;  ///< that a speed loop's output is cut off at, where that is less than full output
  double load_inertia_kg_m2 = 0.0;  ///< on the shaft, beside the rotor's
  int delay_periods = 0;            ///< whole ones from a sample until its result takes effect, 0 or 1
  bool sampled_in_middle =
      false;  ///< of a period, whose next start is the soonest that a result takes effect
  control::Chopping chopping = control::Chopping::soft;
  RotorSensing rotor{.hall = false};
  /// That the drive is to hold; else a tenth of the speed that the bus reaches, bus/K_t.
  std::optional<double> lowest_speed_rad_s;

  /// Control periods from a sample until its result takes effect: 0, 1/2, 1 or 3/2.
  double late_periods() const { return delay_periods + (sampled_in_middle ? 0.5 : 0.0); }
  /// The two that such a board may have, whichever the spec's is.
  double sooner_periods() const { return sampled_in_middle ? 0.5 : 0.0; }
  double later_periods() const { return sooner_periods() + 1.0; }
};

/// Settling time of a current loop that nobody gives one: 1 ms, or 8 L/R where that is shorter. In s.
double usual_current_settle_s_of(const MotorModel& motor);

/// Clock of the timer that captures a sensor's edges where nobody says: of Hall probes as a scenario's sensors have it, of an encoder's
/// many more edges that of an ordinary chip, of which a tick is small beside a control period.
inline constexpr double usual_capture_Hz = 1e6, usual_encoder_capture_Hz = 16e6;

/// A spec as for a board that is built: Hall probes, and a command that counts one period late.
inline DesignSpec on_a_board() {
  DesignSpec spec;
  spec.rotor.hall = true;
  spec.rotor.capture_Hz = usual_capture_Hz;
  spec.delay_periods = 1;
  return spec;
}

struct LoopDesign {
  std::string name;    ///< "current", "speed", "position"
  std::string method;  ///< in words
  PiGains gains;       ///< position: d1 is the gain in rad/s per degree, d0 = 0
  std::vector<DerivationStep> steps;
  std::optional<PolePlacement> placed;
  Transfer loop;        ///< open, with the wished delay, the inner loops counted in
  LoopFigures figures;  ///< of `loop`
  LoopFigures other;    ///< with the other delay: a period more where the spec's is the sooner, else one less
  LoopFigures built;    ///< of `loop` with what the spec's sensor of the speed adds at the lowest speed
  StepResponse step;    ///< of the closed loop, sensor included
};

/// What a warning is about.
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
  std::string what;  ///< one sentence
  /// What helps: a design's by having been tried (analysis/verify/advice.hpp), empty where nothing that was tried does.
  std::string cure;
  bool grave = false;  ///< not to be put on a motor
  Concern of = Concern::other;
};

struct DriveDesign {
  DesignSpec spec;
  MotorModel motor;  ///< with the load's inertia on its shaft
  double bus_V = 0.0;
  double torque_limit_Nm = 0.0;
  double current_at_full_torque_A = 0.0;
  double nominal_current_A = 0.0;
  bool nominal_printed = true;  ///< false: the sheet is silent, and a tenth of the stall current stands in
  double lowest_speed_rad_s = 0.0;
  SpeedLag lag;                         ///< of the speed at the lowest speed
  std::vector<DerivationStep> sensing;  ///< how that lag comes about
  std::vector<SettlingLimit> limits;    ///< what each way of sensing allows; speed and position
  double settle_by_torque_s =
      0.0;  ///< speed: one and a half times what the torque limit takes for half the lowest one, J w_low/(2 T_max)
  std::vector<LoopDesign> loops;  ///< from the inside out
  Ripple ripple;
  double longest_period_s =
      0.0;  ///< up to which the current loop keeps 45 degrees with the later of the delays
  double headroom_end_rad_s = 0.0;  ///< up to which the nominal current can be driven
  double high_speed_rad_s = 0.0;    ///< of drives with a speed loop: a tenth below that
  double speed_step_rad_s = 0.0;    ///< by which the measured speed jumps there while the speed stands
  double speed_step_part = 0.0;     ///< of the torque limit, that the speed loop makes of such a step at once
  double speed_step_V = 0.0;        ///< that the current loop makes of that at once
  double high_speed_left_V = 0.0;   ///< of the bus there, at half the nominal current
  double braking_limit_rad_s = 0.0;  ///< up to which soft chopping holds the nominal current while braking
  std::vector<Warning> warnings;

  const LoopDesign& loop(std::string_view name) const;
  /// What the speed loop can ask for: full output, or the spec's limit of the current.
  double most_current_A() const;
  double most_torque_Nm() const;
  /// A loop's figures with the sooner and with the later of the two delays, whichever the spec has.
  const LoopFigures& sooner(const LoopDesign& loop) const {
    return spec.delay_periods > 0 ? loop.other : loop.figures;
  }
  const LoopFigures& later(const LoopDesign& loop) const {
    return spec.delay_periods > 0 ? loop.figures : loop.other;
  }
};

/// What nominal_current_A is called: nothing that was made up passes for the sheet's.
inline const char* nominal_current_words(const DriveDesign& d) {
  return d.nominal_printed ? "the nominal current"
                           : "a tenth of the stall current (the sheet names no nominal one)";
}

/// Part of its step within which a loop's settling time is told, in the linear step as in the run.
double settling_band(const DriveDesign& design, const LoopDesign& loop);

/// Part of a step of the speed within which it counts as settled: 2 %, on Hall probes 10 %, the twentieth of
/// the lowest speed that a step of half of it is judged by.
double settling_band(const DriveDesign& design);

/// Gains for the spec. In position mode the gain is the largest with which the linear loop does not
/// overshoot; what limits allow is study's to find, with with_position_gain(). Problems name the option.
base::Result<DriveDesign> design_drive(const MotorModel& motor, const DesignSpec& spec);

/// The same with another position gain, figures and warnings anew.
DriveDesign with_position_gain(const DriveDesign& design, double gain_rad_s_per_deg);

/// Fills in figures and step of a loop whose gains are there: open with the delay that it has and with the other one, and as the
/// speed's sensor shows it. `band`: of a speed loop's settling.
void judge_loop(LoopDesign& loop, const Transfer& open, const Transfer& other, const SensedLoop& sensed,
                double period_s, double band);

/// The loops of the same controller on another motor: what a tolerance does to the margins. From the inside
/// out, open.
std::vector<Transfer> open_loops(const DriveDesign& design, const MotorModel& motor, double late_periods);

/// The same with what the spec's sensor of the speed adds at the lowest speed.
std::vector<SensedLoop> sensed_loops(const DriveDesign& design, const MotorModel& motor, double late_periods);

}  // namespace sixstep::design
