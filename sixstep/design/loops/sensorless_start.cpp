// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/sensorless_start.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

constexpr double two_to_32 = 4294967296.0;
constexpr double noises = 5.0;    // standard deviations that noise does not pass in a day
constexpr double clear = 4.0;     // thresholds that the lowest speed's back-EMF has
constexpr double swings = 6.0;    // periods of the alignment's swing
constexpr double falling = 0.25;  // of the current, while the rotor falls towards its place
constexpr double fastest = 1.5;   // no-load speeds: nothing turns faster
constexpr double slowest = 0.4;   // of the lowest speed: given up below
constexpr double fluxes = 2.0;    // T may be late by so much in a steep acceleration
constexpr double periods_a_sector = 4.0, filtered_periods_a_sector = 5.0, captured_periods_a_sector = 3.0;
constexpr double rail_part = 0.03;       // of the bus
constexpr double rail_lags = 3.5;        // exp(-3.5) is that part
constexpr double forgetting_lags = 5.0;  // exp(-5) of the bus is less than the back-EMF of a slow rotor

std::uint32_t whole(double x) {
  return x < 0.0 ? 0u : x < 4294967295.0 ? static_cast<std::uint32_t>(std::floor(x + 0.5)) : 0xffffffffu;
}

/// What the other numbers are made of.
struct Basis {
  const MotorModel& motor;
  const SensorlessSpec& spec;
  double R_tt = 0.0, no_load_rad_s = 0.0, nominal_A = 0.0, start_A = 0.0, load_Nm = 0.0;
  double lsb_V = 0.0, threshold_V = 0.0, lowest_rad_s = 0.0;
  double lock_V = 0.0;            ///< the threshold with what comparators are off by
  double lag_s = 0.0;             ///< of the terminals' filters
  double comparator_lag_s = 0.0;  ///< of those in front of comparators that are followed

  double sector_s(double speed_rad_s) const {
    return base::sector_rad / (motor.machine.pole_pairs * speed_rad_s);
  }
  double counts(double seconds) const { return seconds * spec.capture_Hz; }
  double settle_s() const { return rail_lags * lag_s; }
  /// On-time of a rotor that turns at the lowest speed without a load.
  double least_on_s() const {
    const double part = lowest_rad_s / no_load_rad_s;
    return (spec.chopping == control::Chopping::hard ? (1.0 + part) / 2.0 : part) * spec.period_s;
  }
};

/// How far from nothing y may be where the line turns over.
double comparators_V(const ComparatorSpec& c) {
  if (!c.followed) return 0.0;
  return (c.against_half_bus ? 2.0 : 3.0) * (c.offset_V + c.hysteresis_V / 2.0);
}

Basis basis_of(const MotorModel& motor, const SensorlessSpec& spec) {
  Basis b{motor, spec};
  b.R_tt = 2.0 * motor.machine.R_ohm;
  b.no_load_rad_s = spec.bus_V / motor.K_t_Nm_A;
  b.nominal_A = nominal_current(motor, spec.bus_V).A;
  b.start_A = std::min(spec.overload * b.nominal_A, 0.8 * spec.bus_V / b.R_tt);
  b.load_Nm = spec.greatest_load * motor.K_t_Nm_A * b.nominal_A +
              std::max(motor.shaft.coulomb_Nm, motor.shaft.static_Nm);
  const double range_V = spec.adc_range_V > 0.0 ? spec.adc_range_V : 1.25 * spec.bus_V;
  b.lsb_V = range_V / static_cast<double>(1 << spec.adc_bits);
  // Of 2 u_f - u_s - u_k: variances 4 + 1 + 1, half a step each way per converter.
  b.threshold_V = noises * std::sqrt(6.0) * spec.adc_noise_V + 2.0 * b.lsb_V + spec.mismatch * spec.bus_V;
  b.lock_V = b.threshold_V + comparators_V(spec.comparators);
  b.lowest_rad_s =
      std::max(spec.lowest_part * b.no_load_rad_s, clear * b.lock_V / (2.0 * motor.machine.K_e_V_s));
  const auto lag_s = [](double Hz) { return Hz > 0.0 ? 1.0 / (2.0 * base::pi * Hz) : 0.0; };
  b.lag_s = lag_s(spec.terminal_bandwidth_Hz);
  if (spec.comparators.followed) b.comparator_lag_s = lag_s(spec.comparators.bandwidth_Hz);
  return b;
}

control::ZeroCrossingConfig crossing_of(const Basis& b) {
  control::ZeroCrossingConfig c;
  const auto counts = [&](double V) { return static_cast<std::int32_t>(V / b.lsb_V) + 1; };
  c.seen = b.spec.seen;
  c.rail_counts = static_cast<std::uint16_t>(whole(rail_part * b.spec.bus_V / b.lsb_V));
  c.threshold = counts(b.threshold_V);
  // A diode of the freewheel holds the terminal one drop below the rail, and the driven pair half of one.
  c.below = b.spec.seen == control::NeutralSeen::on_time ? c.threshold
                                                         : std::min(c.threshold, counts(b.spec.diode_V / 2));
  const auto through = [](double ticks) { return whole(std::ceil(ticks)); };
  c.margin_ticks = b.lag_s > 0.0 ? through(b.counts(std::max(b.spec.blanking_s, b.settle_s())))
                                 : whole(b.counts(b.spec.blanking_s));
  c.settle_ticks = through(b.counts(b.settle_s()));
  return c;
}

/// Of half a pulse, what its filters take.
double settled_s(const Basis& b) {
  const bool in_pulse = b.spec.comparators.followed && b.spec.comparators.against_half_bus;
  return std::max(b.settle_s(), in_pulse ? rail_lags * b.comparator_lag_s : 0.0);
}

control::CapturedCrossingConfig captured_of(const Basis& b) {
  const ComparatorSpec& c = b.spec.comparators;
  if (!c.followed) return {};
  control::CapturedCrossingConfig captured{.follows = true, .lag_ticks = whole(b.counts(b.comparator_lag_s))};
  if (!c.against_half_bus) return captured;
  captured.period_ticks = whole(b.counts(b.spec.period_s));
  captured.settle_ticks = whole(b.counts(rail_lags * b.comparator_lag_s));
  return captured;
}

control::SpinConfig spin_of(const Basis& b) {
  control::SpinConfig s;
  s.threshold = static_cast<std::int32_t>(b.threshold_V / b.lsb_V) + 1;
  s.crossings = 4;
  const double L = b.motor.machine.L_H, most_A = std::max(b.start_A, usual_overload * b.nominal_A);
  s.settle_ticks = whole(b.counts(6.0 * L * most_A / b.spec.bus_V + 2.0 * b.spec.period_s));
  s.listen_ticks = b.spec.catches_spin ? whole(b.counts(2.0 * b.sector_s(b.lowest_rad_s))) : 0;
  return s;
}

/// rad/s^2 that the ramp asks for.
double ramp_rad_s2(const Basis& b) {
  return (b.motor.K_t_Nm_A * b.start_A - b.load_Nm) / (2.0 * b.motor.shaft.J_kg_m2);
}

/// What the ramp takes as it ends: its acceleration's current and that of the drag which the sheet tells of. The rest of
/// start_A is in reserve for a load, and a speed loop that began with it would run past its reference before it is unwound.
double ramp_A(const Basis& b) {
  const plant::Shaft& shaft = b.motor.shaft;
  const double drag_Nm = shaft.coulomb_Nm + shaft.B_Nm_s * b.lowest_rad_s;
  return std::min(b.start_A, (shaft.J_kg_m2 * ramp_rad_s2(b) + drag_Nm) / b.motor.K_t_Nm_A);
}

double swing_s(const Basis& b) {
  const double stiffness = b.motor.machine.pole_pairs * b.motor.K_t_Nm_A * b.start_A;
  return 2.0 * base::pi * std::sqrt(b.motor.shaft.J_kg_m2 / stiffness);
}

control::StartUpConfig<double> start_of(const Basis& b, const control::ZeroCrossingConfig& crossing) {
  control::StartUpConfig<double> s;
  const double T = b.spec.period_s, per_sector = b.motor.machine.pole_pairs / base::sector_rad;
  s.current_A = b.start_A;
  s.falling_A = falling * b.start_A;
  s.align_ticks = whole(b.counts(swings * swing_s(b)));
  s.swing_threshold = 4 * crossing.threshold;
  s.swing_shift = 1;
  while (s.swing_shift < 12 && static_cast<double>(2u << s.swing_shift) * T < swing_s(b) / 16.0)
    ++s.swing_shift;
  s.acceleration = std::max(1u, whole(ramp_rad_s2(b) * per_sector * T * T * two_to_32));
  s.last_speed = whole(std::min(0.25, 2.0 * b.lowest_rad_s * per_sector * T) * two_to_32);
  const double ramp_s = 2.0 * b.lowest_rad_s / ramp_rad_s2(b);
  s.longest_ticks = whole(b.counts(2.0 * ramp_s + 12.0 * b.sector_s(b.lowest_rad_s)));
  s.trusted = 6;
  s.trusted_ticks = whole(b.counts(b.sector_s(b.lowest_rad_s)));
  return s;
}

control::LockConfig lock_of(const Basis& b) {
  control::LockConfig l;
  l.shortest_ticks = whole(b.counts(b.sector_s(fastest * b.no_load_rad_s)));
  l.threshold = static_cast<std::int32_t>(b.lock_V / b.lsb_V) + 1;
  l.most_flux = whole(fluxes * 3.0 * b.motor.machine.K_e_V_s / b.lsb_V * b.counts(b.sector_s(1.0)));
  // A leg that its diode lets go within the on-time is seen on its way from the rail: no voltage that tells a flux.
  if (b.lag_s > 0.0 && b.spec.chopping != control::Chopping::hard) l.most_flux = 0xffffffffu;
  l.longest_ticks = whole(b.counts(b.sector_s(slowest * b.lowest_rad_s)));
  return l;
}

void set_measuring(const Basis& b, control::SensorlessConfig<double>& rotor) {
  const double sector = base::sector_rad / b.motor.machine.pole_pairs;
  rotor.speed.sector_rad_s_ticks = sector * b.spec.capture_Hz;
  rotor.speed.timeout_ticks = whole(std::min(2.0e9, 4.0 * static_cast<double>(rotor.lock.longest_ticks)));
  rotor.speed.edges = 6;
  rotor.speed.window_ticks = whole(b.counts(b.spec.speed_window_s));
  rotor.position = {60.0 / b.motor.machine.pole_pairs, 60.0 / b.motor.machine.pole_pairs};
}

base::Problems problems_of(const MotorModel& motor, const SensorlessSpec& spec) {
  base::Problems problems;
  if (!(spec.bus_V > 0.0))
    problems.push_back(
        {"bus_V", base::rounded(spec.bus_V, 4), "must be above 0", "give the voltage of the bus"});
  if (!(spec.period_s > 0.0))
    problems.push_back(
        {"period_s", base::rounded(spec.period_s, 4), "must be above 0", "give the control period"});
  if (!(spec.capture_Hz > 0.0))
    problems.push_back(
        {"capture_Hz", base::rounded(spec.capture_Hz, 4), "must be above 0", "give the timer's frequency"});
  if (spec.adc_bits < 6 || spec.adc_bits > 16)
    problems.push_back(
        {"adc_bits", std::to_string(spec.adc_bits), "must be 6 to 16", "choose another converter"});
  if (!(motor.shaft.J_kg_m2 > 0.0) || !(motor.K_t_Nm_A > 0.0) || !(motor.machine.R_ohm > 0.0))
    problems.push_back(
        {"motor", "", "must have resistance, torque constant and inertia", "give them in the motor's file"});
  return problems;
}

/// Sampled in the middle of the on-time, half of which has to be enough for the legs to come to their rails.
base::Problem too_slow(const Basis& b) {
  const double needed_Hz = rail_lags / (base::pi * b.least_on_s());
  return {"terminal_bandwidth_Hz", base::rounded(b.spec.terminal_bandwidth_Hz, 4),
          "lets the terminals come to their rails within " + base::rounded(2e6 * b.settle_s(), 4) +
              " us, 7 time constants, and the least on-time has " + base::rounded(1e6 * b.least_on_s(), 4) +
              " us",
          "raise it to " + base::rounded(needed_Hz, 4) + " Hz, or hand over at a higher lowest_part"};
}

/// A comparator's time constant at most: that has forgotten the freewheel half a sector later, or is settled in half a pulse.
double longest_comparator_lag_s(const Basis& b) {
  if (b.spec.comparators.against_half_bus) return b.least_on_s() / (2.0 * rail_lags);
  return b.sector_s(b.no_load_rad_s) / (2.0 * forgetting_lags);
}

/// Without a low-pass comparators turn over at each edge of the pulse, with too slow a one they tell what was.
base::Problem badly_filtered(const Basis& b) {
  const ComparatorSpec& c = b.spec.comparators;
  const std::string least = base::rounded(1.01 / (2.0 * base::pi * longest_comparator_lag_s(b)), 3) +
                            " Hz";  // rounded, still enough
  if (!(c.bandwidth_Hz > 0.0))
    return {"comparators.bandwidth_Hz", "",
            "is missing, and comparators without a low-pass turn over at each edge of the pulse",
            "give it; " + least + " is slow enough here, and fast enough"};
  return {"comparators.bandwidth_Hz", base::rounded(c.bandwidth_Hz, 4),
          c.against_half_bus ? "is not settled within half of the least on-time"
                             : "has not forgotten the freewheel by the crossing at no-load speed",
          c.against_half_bus ? "raise it to " + least + ", or hand over at a higher lowest_part"
                             : "raise it to " + least};
}

base::Problem hidden_below(const Basis& b) {
  const double comparators = comparators_V(b.spec.comparators);
  const std::string hides = "hides the back-EMF below " + base::rounded(b.lowest_rad_s, 4) + " rad/s";
  if (comparators > b.threshold_V)
    return {"comparators", base::rounded(comparators, 4) + " V off", hides,
            "take comparators with less offset and hysteresis"};
  return {"adc_noise_V", base::rounded(b.spec.adc_noise_V, 4), hides,
          "take a finer or quieter converter, or dividers that are more alike"};
}

double least_periods_a_sector(const Basis& b) {
  if (b.spec.comparators.followed) return captured_periods_a_sector;
  return b.lag_s > 0.0 ? filtered_periods_a_sector : periods_a_sector;
}

const char* least_sector(const Basis& b) {
  if (b.spec.comparators.followed) return "a sector in 3 periods";
  return b.lag_s > 0.0 ? "a sector in 5 periods" : "a sector in 4 periods";
}

std::vector<DerivationStep> steps_of(const Basis& b, const SensorlessStart& s) {
  std::vector<DerivationStep> steps = {
      {"y_0", "5 sqrt(6) noise + 2 steps + mismatch U", b.threshold_V, "V"},
      {"w_low", "4 y_0/(2 K_e), at least lowest_part U/K_t", s.lowest_rad_s, "rad/s"},
      {"w_high", least_sector(b), s.highest_rad_s, "rad/s"},
      {"I_start", "overload I_N, at most 0.8 U/R_tt", b.start_A, "A"},
      {"T_swing", "2 pi sqrt(J/(p K_t I_start))", swing_s(b), "s"},
      {"a", "(K_t I_start - T_load)/(2 J)", ramp_rad_s2(b), "rad/s^2"},
      {"I_ramp", "(J a + T_c + B w_low)/K_t, where the speed loop goes on", ramp_A(b), "A"},
      {"d'", "I_N K_t^2/(J U), of 2 U unless soft", s.duty_per_period / b.spec.period_s, "1/s"}};
  if (b.lag_s > 0.0) {
    steps.push_back({"tau", "1/(2 pi bandwidth), taken off the commutation", b.lag_s, "s"});
    steps.push_back({"t_rail", "3.5 tau, from an edge to the rail", b.settle_s(), "s"});
  }
  if (b.spec.comparators.followed) {
    steps.push_back(
        {"y_c", "offset and half the hysteresis, beside y_0", comparators_V(b.spec.comparators), "V"});
    steps.push_back({"tau_c", "1/(2 pi bandwidth), taken off the commutation", b.comparator_lag_s, "s"});
  }
  return steps;
}

}  // namespace

base::Result<SensorlessStart> sensorless_start(const MotorModel& motor, const SensorlessSpec& spec,
                                               double current_at_full_output_A) {
  if (base::Problems problems = problems_of(motor, spec); !problems.empty()) return problems;
  const Basis b = basis_of(motor, spec);
  if (!(ramp_rad_s2(b) > 0.0))
    return base::Problem{"greatest_load", base::rounded(spec.greatest_load, 4),
                         "is more than the start's current moves: " + base::rounded(b.start_A, 4) + " A",
                         "raise overload, or start against less"};
  if (b.lowest_rad_s > 0.5 * b.no_load_rad_s) return hidden_below(b);
  if (spec.comparators.followed &&
      !(b.comparator_lag_s > 0.0 && b.comparator_lag_s <= longest_comparator_lag_s(b)))
    return badly_filtered(b);
  if (b.spec.seen == control::NeutralSeen::on_time && 2.0 * b.settle_s() > b.least_on_s()) return too_slow(b);
  SensorlessStart out;
  out.rotor.crossing = crossing_of(b);
  out.rotor.captured = captured_of(b);
  out.rotor.spin = spin_of(b);
  out.rotor.start = start_of(b, out.rotor.crossing);
  out.rotor.lock = lock_of(b);
  out.rotor.clock.crossings = 2;
  out.rotor.clock.lead_ticks = whole(b.counts(spec.comparators.followed ? b.comparator_lag_s : b.lag_s));
  out.rotor.clock.advance =
      static_cast<std::uint16_t>(whole(std::clamp(spec.advance_deg, 0.0, 30.0) / 60.0 * 65536.0));
  set_measuring(b, out.rotor);
  out.start_current_A = b.start_A;
  out.start_output =
      current_at_full_output_A > 0.0 ? std::min(1.0, ramp_A(b) / current_at_full_output_A) : 0.0;
  const double K_t = motor.K_t_Nm_A;
  // Hard chopping applies (2 d - 1) of the bus; complementary chopping, while it brakes, keeps the old current alive.
  const double swing_V = spec.chopping == control::Chopping::soft ? spec.bus_V : 2.0 * spec.bus_V;
  out.duty_per_period = b.nominal_A * K_t * K_t / (motor.shaft.J_kg_m2 * swing_V) * spec.period_s;
  out.current_per_period = b.nominal_A * spec.period_s / usual_current_settle_s;
  if (spec.seen == control::NeutralSeen::on_time)
    out.least_duty = std::min(0.5, 2.0 * std::max(spec.sampling_s, settled_s(b)) / spec.period_s);
  out.lowest_rad_s = b.lowest_rad_s;
  out.highest_rad_s = b.sector_s(1.0) / (least_periods_a_sector(b) * spec.period_s);
  out.steps = steps_of(b, out);
  return out;
}

control::SensorlessDriveConfig<double> sensorless_drive(const control::DriveConfig<double>& drive,
                                                        const SensorlessStart& start) {
  control::SensorlessDriveConfig<double> chip;
  chip.drive = drive;
  chip.sensorless = start.rotor;
  chip.start_output = start.start_output;
  chip.duty.step = start.duty_per_period;
  chip.least_duty = start.least_duty;
  chip.current.step = start.current_per_period;
  return chip;
}

}  // namespace sixstep::design
