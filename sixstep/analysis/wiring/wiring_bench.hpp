// SPDX-License-Identifier: Apache-2.0
// Creates the test bench for all 36 wirings. Its values follow from the motor's sheet, so that a wrongly
// connected motor is not damaged at rest.
#pragma once
#include <optional>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/rig/wiring.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

inline constexpr double electrical_turn_rad = 6 * base::sector_rad;

struct WiringSubject {
  std::string motor{};                ///< name or path, for the scenario
  design::Sheet sheet{};              ///< sheet of the motor
  std::optional<double> voltage_V{};  ///< bus voltage; empty: the sheet's nominal voltage
  /// Current of the stalled motor; empty: the nominal current, or a tenth of the largest current that the bus
  /// can drive.
  std::optional<double> current_A{};
};

enum class BenchCurrent : std::uint8_t { asked_for, nominal, tenth_of_stall };

/// A stiff bus, ideal switches, soft chopping, no load. There are two tests: a free run from rest, and a slow
/// turn by an external machine.
struct WiringBench {
  design::MotorModel motor;
  double voltage_V = 0.0, current_A = 0.0, duty = 0.0;  ///< current_A = duty voltage_V/R_tt
  BenchCurrent from = BenchCurrent::nominal;
  double ideal_rad_s = 0.0;  ///< duty voltage_V/K_t: no load, continuous current
  double free_s = 0.0;  ///< duration: 18 mechanical time constants and one turn of an ideal motor, then the
                        ///< measured part
  double watched_from_s = 0.0;
  double row_s = 0.0;  ///< time between two recorded rows of a free run
  /// PWM period of the slow turn. It is short because rows are recorded at the begin of a period. In a long
  /// period the current would decay before this instant, and the row would not show the torque.
  double turned_pwm_s = 0.0;
  double turned_rad_s = 0.0;  ///< so low that the back-EMF reduces the bench's current by at most a twentieth
  /// First a sector in which the initial current decays, then one electrical turn, 0 to 360 degrees.
  double turned_from_s = 0.0, turned_s = 0.0;
};

/// Problems of `voltage_V`, `current_A` and the sheet.
base::Result<WiringBench> wiring_bench(const WiringSubject& subject);

/// Scenario of a motor that is released from rest at an electrical angle.
study::Scenario free_run(const WiringBench& bench, const WiringSubject& subject, const rig::Wiring& wiring,
                         double electrical_deg);

/// Scenario of a motor that a dynamometer turns through one electrical turn. It records `turned_rows` rows of
/// torque.
inline constexpr int turned_rows = 180;
study::Scenario turned_run(const WiringBench& bench, const WiringSubject& subject, const rig::Wiring& wiring);

}  // namespace sixstep::analysis
