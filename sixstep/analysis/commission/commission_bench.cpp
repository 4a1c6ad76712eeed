// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/commission/commission_bench.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/commission/commission_truth.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/study/check/check.hpp"

namespace sixstep::analysis {
namespace {

/// A usual board: offset and noise of the converters in counts, dead time, diodes, and switches with a tenth
/// of the phase's resistance. The current range is twice the test current. The bus range is 1.25 times the
/// bus voltage.
constexpr double offset_counts = 12.3, noise_counts = 1.0, dead_s = 0.5e-6, channel_part = 0.1, diode_V = 0.7,
                 most_diode_ohm = 0.01, current_room = 2.0, bus_room = 1.25;
constexpr int adc_bits = 12;
/// Hysteresis of usual Hall probes.
constexpr double hysteresis_deg = 2.0;

/// Time scales of the motor, from its sheet.
struct Paces {
  double tau_s = 0.0;  ///< L/R
  double swing_rad_s =
      0.0;                 ///< angular frequency of the rotor's swing in the static field of the test current
  double calming_s = 0.0;  ///< time constant of the decay of this swing
  double spin_turns_s2 = 0.0;     ///< electrical acceleration in turns/s^2 by the test current
  double half_emf_turns_s = 0.0;  ///< speed at which the back-EMF is half of the voltage vector
};

Paces paces_of(const design::MotorModel& m, double flux_Vs, double R_ohm, double I_A) {
  const double p = m.machine.pole_pairs, J = m.shaft.J_kg_m2;
  const double torque_per_rad = 1.5 * p * flux_Vs * I_A;
  const double braking = 1.5 * p * p * flux_Vs * flux_Vs / R_ohm + m.shaft.B_Nm_s;
  return {.tau_s = m.machine.L_H / R_ohm,
          .swing_rad_s = std::sqrt(p * torque_per_rad / J),
          .calming_s = 2 * J / braking,
          .spin_turns_s2 = p * torque_per_rad / J / base::turn_rad,
          .half_emf_turns_s = R_ohm * I_A / (2 * flux_Vs) / base::turn_rad};
}

/// Settings of the test for these time scales. No duration is shorter than its default.
control::CommissioningWish wish_of(const Paces& p, double I_A) {
  control::CommissioningWish w;
  w.test_A = I_A;
  w.settle_s = std::max(w.settle_s, 6 * p.calming_s);
  w.step_s = std::max(w.step_s, 12 * p.tau_s);
  // With the factor 18, six times the turn's speed is below a third of the swing's frequency
  // (hall_survey.hpp).
  w.slow_turns_s = std::min(w.slow_turns_s, p.swing_rad_s / (18 * base::turn_rad));
  w.fastest_turns_s = std::max(w.fastest_turns_s, 2 * p.half_emf_turns_s);
  w.spin_up_s = std::max(w.spin_up_s, 5 * w.fastest_turns_s / p.spin_turns_s2);
  return w;
}

/// Largest duration of the whole test in s, including all tries of the fast turn.
double longest_of(const control::CommissioningWish& w, const Paces& p) {
  const double spun = w.spin_up_s * std::min(1.0, 1.5 * p.half_emf_turns_s / w.fastest_turns_s) + 1.0;
  return 2.0 + 2 * w.settle_s + 10 * w.step_s + 8.0 / w.slow_turns_s + 16 * spun + w.tries * w.settle_s;
}

/// Control period in s: an eighth of L/R, within the 20 to 50 us of usual bridges.
double period_of(double tau_s) {
  return std::clamp(base::shortened(tau_s / 8, 1, base::Towards::down), 20e-6, 50e-6);
}

study::Scenario on_bench(const CommissionSubject& subject, double voltage_V, double current_A, double R_ohm,
                         double tau_s) {
  study::Scenario s;
  s.title = "A drive identifies its motor";
  s.motor = subject.motor;
  s.sheet = subject.sheet;
  s.duration_s = 1.0;
  s.supply.voltage_V = voltage_V;
  s.bridge = {.phases = subject.wires.phases,
              .on_resistance_ohm = channel_part * R_ohm,
              .diode_drop_V = diode_V,
              .diode_resistance_ohm = std::min(most_diode_ohm, channel_part * R_ohm),
              .dead_time_s = dead_s};
  s.pwm.period_s = period_of(tau_s);
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  study::Sensors& x = s.sensors;
  x.currents = rig::CurrentMeasurement::phases;
  x.adc_bits = adc_bits;
  x.current_range_A = base::shortened(current_room * current_A, 2, base::Towards::up);
  const double count_A = 2 * *x.current_range_A / (1 << adc_bits);
  x.current_offset_A = offset_counts * count_A;
  x.current_noise_A = noise_counts * count_A;
  x.bus = study::BusSensing::adc;
  x.bus_range_V = base::shortened(bus_room * voltage_V, 2, base::Towards::up);
  x.rotor = study::RotorSensing::hall;
  x.seed = subject.seed;
  x.hall_lines = subject.wires.probes;
  x.hall_inverted = static_cast<study::HallLines>(subject.wires.inverted);
  x.hall_offset_deg = subject.hall_offset_deg;
  x.hall_hysteresis_deg = hysteresis_deg;
  s.control.mode = control::Mode::duty;
  return s;
}

base::Problems unfit(const CommissionSubject& subject) {
  if (subject.sheet.kind == design::MotorKind::linear)
    return {
        {"kind", "linear",
         "cannot be commissioned: the test moves the field over many pole pitches each way, and a track is too short",
         "measure R, L and back-EMF on a bench"}};
  if (subject.sheet.connection == design::WindingConnection::delta)
    return {
        {"connection", "delta",
         "cannot be commissioned: the chip identifies the values of a star, and the loop current of a delta falsifies these values",
         "measure R, L and back-EMF on a bench"}};
  return {};
}

base::Result<double> voltage_of(const CommissionSubject& subject, const design::MotorModel& motor) {
  const double V = subject.voltage_V.value_or(motor.nominal_voltage_V);
  if (!subject.voltage_V && !(V > 0.0))
    return base::Problem{"voltage_V", "", "is missing, and the sheet prints no nominal voltage",
                         "give the bus voltage in volts"};
  if (base::Problems found = base::out_of_range("voltage_V", V, base::allowed(base::above(0), "V"), "V",
                                                "give the bus voltage in volts");
      !found.empty())
    return found;
  return V;
}

/// Largest current at which a salient rotor stays aligned with the field: a third of I with (L_q - L_d) I =
/// psi. At I, the reluctance torque exceeds the magnet's torque. L_d, L_q: inductances along and across the
/// magnet's axis; psi: flux linkage.
double salient_most_A(const study::GeneralPlant& plant) {
  const CommissionTruth t = truth_of(plant, 0.0);
  return t.beyond_L_H > 0.0 ? t.flux_linkage_Vs / t.beyond_L_H / 3 : HUGE_VAL;
}

struct TestCurrentFrom {
  double A = 0.0;
  TestCurrent from = TestCurrent::asked_for;
};

/// The test current: twice the nominal current, which a motor withstands for seconds. It is at most half of
/// the largest current that the bus can drive. With a smaller current, the voltage of dead time and diodes
/// would be a large part of the vector. Along a phase the vector reaches half of the bus (field_vector.hpp);
/// a tenth of this half is reserved for dead time and diodes.
base::Result<TestCurrentFrom> current_of(const CommissionSubject& subject, const design::MotorModel& motor,
                                         double V) {
  const double R = motor.machine.R_ohm;
  const base::Result<study::Compiled> tried =
      study::compile(on_bench(subject, V, 1.0, R, motor.machine.L_H / R));
  if (!tried) return tried.problems();
  const double most_A = std::min(0.45 * V / R / (1 + channel_part), salient_most_A(*tried->general));
  const design::NominalCurrent nominal = design::nominal_current(motor, V);
  const TestCurrent from = subject.current_A            ? TestCurrent::asked_for
                           : 2 * nominal.A > most_A / 2 ? TestCurrent::half_of_most
                           : nominal.printed            ? TestCurrent::twice_nominal
                                                        : TestCurrent::twice_tenth_of_stall;
  const double I = subject.current_A.value_or(
      base::shortened(std::min(2 * nominal.A, most_A / 2), 2, base::Towards::down));
  if (!(I > 0.0 && I <= most_A))
    return base::Problem{
        "current_A", base::written(I),
        "must be above 0 and at most " + base::rounded(most_A, 4) +
            " A, which the bus can drive and at which the rotor stays aligned with the field",
        nominal.printed
            ? "leave the current out: the default is twice the sheet's nominal current, at most half of this largest current"
            : "leave the current out: the default is at most half of this largest current"};
  return TestCurrentFrom{I, from};
}

/// Problems of the test's torque or duration that no setting of the test can solve.
base::Problems too_weak(const CommissionBench& b, const design::MotorModel& motor) {
  const double torque = 1.5 * motor.machine.pole_pairs * b.truth.flux_linkage_Vs * b.wish.test_A;
  const double against = motor.shaft.coulomb_Nm + b.truth.cogging_Nm;
  constexpr double most_part = 0.3, most_s = 300.0;
  if (against > most_part * torque)
    return {{"current_A", base::written(b.wish.test_A),
             "pulls the rotor with " + base::rounded(1e3 * torque, 3) + " mNm against " +
                 base::rounded(1e3 * against, 3) +
                 " mNm of friction and cogging: the rotor does not align with the field",
             "raise current_A above " +
                 base::written(
                     base::shortened(b.wish.test_A * against / (most_part * torque), 3, base::Towards::up)) +
                 " A: the torque must exceed 10/3 times the sum of friction and cogging"}};
  if (!(b.longest_s < most_s))
    return {{"current_A", base::written(b.wish.test_A),
             "makes the test last up to " + base::rounded(b.longest_s, 3) + " s, more than " +
                 base::rounded(most_s, 3) + " s: the rotor takes too long to come to rest in the field",
             "raise current_A, or correct the units of inertia and torque constant in the motor file"}};
  return {};
}

}  // namespace

base::Result<CommissionBench> commission_bench(const CommissionSubject& subject) {
  base::Result<design::MotorModel> motor = design::motor_model(subject.sheet);
  if (!motor) return motor.problems();
  if (base::Problems found = unfit(subject); !found.empty()) return found;
  base::Problems wrong =
      base::out_of_range("hall_offset_deg", subject.hall_offset_deg, base::between(-180, 180), "deg",
                         "give the angle by which all Hall edges come late, -180 to 180 electrical degrees");
  if (!wrong.empty()) return wrong;
  const base::Result<double> V = voltage_of(subject, *motor);
  if (!V) return V.problems();
  const base::Result<TestCurrentFrom> current = current_of(subject, *motor, *V);
  if (!current) return current.problems();
  const double I = current->A;
  const double R = motor->machine.R_ohm;
  const study::Scenario scenario = on_bench(subject, *V, I, R, motor->machine.L_H / R);
  if (base::Problems found = study::check(scenario); !found.empty()) return found;
  base::Result<study::Compiled> compiled = study::compile(scenario);
  if (!compiled) return compiled.problems();
  CommissionBench b{.compiled = std::move(*compiled),
                    .board = {},
                    .wish = {},
                    .truth = {},
                    .voltage_V = *V,
                    .from = current->from,
                    .nominal_printed = motor->nominal_current_A > 0.0};
  const rig::SensorsConfig& sensors = b.compiled.board.sensors;
  b.noise_A = sensors.current.noise;
  b.board = {.V_per_count = sensors.bus.lsb(),
             .A_per_count = sensors.current.lsb(),
             .zero_counts = sensors.current.zero(),
             .period_s = period_of(motor->machine.L_H / R),
             .timer_Hz = sensors.capture_Hz,
             .late_half_ticks = 1};
  b.truth = truth_of(*b.compiled.general, dead_s / b.board.period_s * 2);
  const Paces paces = paces_of(*motor, b.truth.flux_linkage_Vs, R, I);
  b.wish = wish_of(paces, I);
  b.longest_s = longest_of(b.wish, paces);
  if (base::Problems found = too_weak(b, *motor); !found.empty()) return found;
  return b;
}

}  // namespace sixstep::analysis
