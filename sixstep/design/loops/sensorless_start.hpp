// SPDX-License-Identifier: Apache-2.0
// Computes every number of a sensorless drive (control/sensorless/) from motor and board, so that the user
// need not tune any number. U is the bus, I the start current, J the inertia, T the control period:
//
//   threshold       for y = 2 u_f - u_s - u_k: noise of three converters, their steps, and the mismatch of
//                   the dividers
//   lowest speed    2 K_e w is `clear` times the threshold; at least lowest_part of the no-load speed
//   start current   `overload` times the nominal current, and at most 4/5 of the current that the bus drives
//                   through a held rotor
//   alignment       each of its two steps (start_up.hpp) lasts `swings` periods of the swing sqrt(p K_t I/J)
//   ramp            half of the start current's excess over the greatest load: a = (K_t I - T_load)/(2 J)
//   hand-over       a speed loop continues from the ramp's current, (J a + T_c + B w)/K_t, not from the start
//                   current
//   catching        currents are zero after 6 L_s I/U. The rotor is at rest if there is no crossing for two
//                   sectors of the lowest speed
//   throttle        the duty grows no faster than the back-EMF can follow: d' = I_N K_t^2/(J U), with the
//                   nominal current I_N in addition to the load's current. A faster growth would cause a
//                   freewheel that hides the crossing. In two cases the growth is half of d'. Hard chopping:
//                   its duty changes the voltage twice as much. Complementary chopping: while the motor
//                   brakes, the freewheel holds the old leg at its diode, and the leg's current grows until
//                   K_e w |s_f| has fallen below d U/2
//   highest speed   two samples before the crossing and one after the freewheel: four control periods per
//                   sector
//   filters         terminals and bus have equal lags tau: y is tau late, and the lead is reduced by tau. 3.5
//                   tau after an edge the distance of a leg to its rail is 3 %, as the chip requires. This
//                   time is half of the least on-time, and the blanking after commutation and freewheel. The
//                   filters require an additional sample: five control periods per sector. With hard chopping
//                   a diode may hold the leg up to any instant of the on-time: the sign of y is then right,
//                   but its size has no meaning
//   comparators     offset and half the hysteresis are added to the threshold, as a change of y: 3 times with
//                   the virtual star, 2 times with half the bus. The lead is reduced by the low-pass's tau.
//                   With the virtual star 5 tau are at most half a sector at no-load speed, so that the
//                   freewheel's effect has decayed; with half the bus 7 tau are at most the least on-time.
//                   One sample after the freewheel and one after the edge: three control periods per sector
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/sensorless/sensorless_drive.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

/// Comparators at the terminals, used if `followed`.
struct ComparatorSpec {
  bool followed = false;
  double bandwidth_Hz = 0.0;      ///< bandwidth of each low-pass
  bool against_half_bus = false;  ///< false: against the virtual star
  double offset_V = 0.0;          ///< largest offset according to the comparators' sheet, referred to the
                                  ///< terminal
  double hysteresis_V = 0.0;      ///< difference between the levels of a rising and a falling edge, at the
                                  ///< terminal
};

/// Supply, board and load of a sensorless drive; SI.
struct SensorlessSpec {
  double bus_V = 0.0;     ///< voltage of the supply
  double period_s = 0.0;  ///< time from sample to sample
  double capture_Hz = 16e6;
  int adc_bits = 12;
  double adc_range_V = 0.0;     ///< range of terminals and bus, at their dividers' inputs; 0: 5/4 of the bus
  double adc_noise_V = 0.0;     ///< rms noise of each converter
  double mismatch = 0.0;        ///< relative mismatch of the dividers
  double greatest_load = 0.5;   ///< load at the start, relative to the nominal torque
  double overload = 1.5;        ///< start current relative to the nominal current
  double lowest_part = 0.05;    ///< fraction of the no-load speed at which the ramp ends
  double advance_deg = 0.0;     ///< advance of the commutation before the middle between two crossings,
                                ///< electrical
  double sampling_s = 0.25e-6;  ///< time that a sample needs on either side of the pulse's middle
  double pulse_late_s =
      0.0;                  ///< delay of the pulse after the timer's command: a dead time, with complementary
                            ///< chopping
  double blanking_s = 0.0;  ///< blanking after the end of the freewheel, for filters of dividers and
                            ///< converters
  double terminal_bandwidth_Hz = 0.0;  ///< bandwidth of the first-order lags of terminals and bus; 0: no
                                       ///< filters
  double speed_window_s =
      0.0;  ///< a speed is measured over six crossings if they occur within this time, else over one
            ///< (hall_speed.hpp); 0: always over six
  control::Chopping chopping = control::Chopping::soft;
  control::NeutralSeen seen = control::NeutralSeen::on_time;
  double diode_V = 0.0;  ///< drop of the bridge's diodes; a measurement in the freewheel contains it
  bool catches_spin = true;
  ComparatorSpec comparators{};
};

/// Configuration of the rotor's part of the chip, and figures of the design.
struct SensorlessStart {
  control::SensorlessConfig<double> rotor;
  double start_output = 0.0;        ///< the ramp's current, relative to the current of the speed loop's full
                                    ///< output
  double duty_per_period = 0.0;     ///< largest change of a duty setpoint per period
  double least_duty = 0.0;          ///< least duty whose pulse is long enough for a sample
  double current_per_period = 0.0;  ///< largest change of a current setpoint per period, A
  double start_current_A = 0.0;
  double lowest_rad_s = 0.0, highest_rad_s = 0.0;  ///< range in which crossings can be measured
  std::vector<DerivationStep> steps;
};

/// `motor` includes the load's inertia on its shaft. `current_at_full_output_A`: current at the speed loop's
/// full output; 0 without a speed loop. Problems name the key to change: the bus is not given, the start
/// current does not move the load, or converter or comparators are too inexact to measure the back-EMF below
/// half the no-load speed.
base::Result<SensorlessStart> sensorless_start(const MotorModel& motor, const SensorlessSpec& spec,
                                               double current_at_full_output_A);

/// The chip's configuration: sensorless operation around a designed drive.
control::SensorlessDriveConfig<double> sensorless_drive(const control::DriveConfig<double>& drive,
                                                        const SensorlessStart& start);

}  // namespace sixstep::design
