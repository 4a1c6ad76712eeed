// SPDX-License-Identifier: Apache-2.0
// Every number of a sensorless drive (control/sensorless/) from motor and board, so that nothing is left to be tuned:
//
//   threshold       y = 2 u_f - u_s - u_k: noise of three converters, their steps, and dividers that are not alike
//   lowest speed    2 K_e w is `clear` times that threshold; never below lowest_part of the no-load speed
//   start current   `overload` times the nominal one, no more than 4/5 of what the bus drives through a held rotor
//   alignment       `swings` periods of sqrt(p K_t I/J) for each of the two steps (start_up.hpp)
//   ramp            half of what the start current leaves beyond the greatest load: a = (K_t I - T_load)/(2 J)
//   hand-over       a speed loop goes on from what the ramp takes, (J a + T_c + B w)/K_t, not from the start current
//   catching        currents are gone after 6 L_s I/U; the rotor stands where two sectors of the lowest speed show nothing
//   throttle        the duty grows no faster than the back-EMF follows: d' = I_N K_t^2/(J U), I_N beyond the load's current;
//                   more of it would hide the crossing behind its freewheel. Hard chopping: half of it, whose duty
//                   swings the voltage twice as far; complementary: half of it, too. Braking, its freewheel holds the old
//                   leg at its diode, and the current grows there, until K_e w |s_f| has fallen below d U/2
//   highest speed   two samples before the crossing and one behind the freewheel: four control periods a sector
//   filters         terminals and bus through like lags tau: y is tau late, and the lead takes it off. A leg is at its rail, to
//                   the 3 % of it that the chip asks for, 3.5 tau behind an edge: half of the least on-time, and the
//                   blanking behind commutation and freewheel. That costs a sample: five control periods a sector. But in hard
//                   chopping a diode may hold the leg up to any instant of the on-time: y keeps its sign, its size says nothing
//   comparators     their offset and half their hysteresis are beside the threshold, counted in y: 3 times of them against
//                   the virtual star, 2 times against half the bus. Of their low-pass the lead takes tau off. Against the virtual
//                   star 5 tau are half a sector at no-load speed at most, so that what the freewheel left in it is gone; against
//                   half the bus 7 tau are the least on-time. A sample behind the freewheel, one behind the edge: three
//                   control periods a sector
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/sensorless/sensorless_drive.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

/// Comparators at the terminals whose edges are followed.
struct ComparatorSpec {
  bool followed = false;
  double bandwidth_Hz = 0.0;      ///< of each one's low-pass
  bool against_half_bus = false;  ///< else against the virtual star
  double offset_V = 0.0;          ///< that a terminal may be off by, as their sheet says
  double hysteresis_V = 0.0;      ///< from the level of one edge to that of the other
};

/// What a sensorless drive hangs at; SI.
struct SensorlessSpec {
  double bus_V = 0.0;     ///< of the supply
  double period_s = 0.0;  ///< from sample to sample
  double capture_Hz = 16e6;
  int adc_bits = 12;
  double adc_range_V = 0.0;     ///< of terminals and bus, their dividers counted in; 0: 5/4 of the bus
  double adc_noise_V = 0.0;     ///< root mean square
  double mismatch = 0.0;        ///< of the dividers, a part of 1
  double greatest_load = 0.5;   ///< that it must start against, a part of the nominal torque
  double overload = 1.5;        ///< the start's current, in nominal ones
  double lowest_part = 0.05;    ///< of the no-load speed: where the ramp ends
  double advance_deg = 0.0;     ///< electrical, ahead of the middle between two crossings
  double sampling_s = 0.25e-6;  ///< that a pulse must reach to either side of its middle for a sample to fit
  double pulse_late_s =
      0.0;  ///< by which it begins later than the timer says: a dead time, with complementary chopping
  double blanking_s = 0.0;             ///< beyond the end of the freewheel: dividers' and converters' filters
  double terminal_bandwidth_Hz = 0.0;  ///< of dividers and bus, first-order lags; 0: there are none
  double speed_window_s =
      0.0;  ///< six crossings make a speed within this time, else one (hall_speed.hpp); 0: always six
  control::Chopping chopping = control::Chopping::soft;
  control::NeutralSeen seen = control::NeutralSeen::on_time;
  double diode_V = 0.0;  ///< of the bridge's diodes: seen in a freewheel
  bool catches_spin = true;
  ComparatorSpec comparators{};
};

/// The numbers of chip and judgement.
struct SensorlessStart {
  control::SensorlessConfig<double> rotor;
  double start_output = 0.0;        ///< the ramp's current over that of a speed loop's full output
  double duty_per_period = 0.0;     ///< of the throttle
  double least_duty = 0.0;          ///< that a sample fits into
  double current_per_period = 0.0;  ///< A
  double start_current_A = 0.0;
  double lowest_rad_s = 0.0, highest_rad_s = 0.0;  ///< where crossings can be seen
  std::vector<DerivationStep> steps;
};

/// `motor`: with the load's inertia on its shaft. `current_at_full_output_A`: of the speed loop; 0 without one. Problems
/// name the key that is to be changed: a bus that is not given, a load that the start current does not move, a converter
/// too coarse, or a comparator too far off, to see the back-EMF below half the no-load speed.
base::Result<SensorlessStart> sensorless_start(const MotorModel& motor, const SensorlessSpec& spec,
                                               double current_at_full_output_A);

/// The same around a drive that is designed: what the chip runs.
control::SensorlessDriveConfig<double> sensorless_drive(const control::DriveConfig<double>& drive,
                                                        const SensorlessStart& start);

}  // namespace sixstep::design
