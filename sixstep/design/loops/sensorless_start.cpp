// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/sensorless_start.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/sensorless_basis.hpp"

namespace sixstep::design {
namespace {

constexpr double two_to_32 = 4294967296.0;
constexpr double swings = 6.0;    // duration of each alignment step, in periods of the rotor's swing
constexpr double falling = 0.25;  // fraction of the start current, while the rotor swings towards its
                                  // alignment
constexpr double fastest = 1.5;   // factor on the no-load speed: no rotor turns faster
constexpr double slowest = 0.4;   // fraction of the lowest speed: a slower rotor counts as lost
constexpr double fluxes = 2.0;    // factor by which T may be too long during a steep acceleration
constexpr double periods_a_sector = 4.0, filtered_periods_a_sector = 5.0, captured_periods_a_sector = 3.0;
constexpr double rail_part = 0.03;  // fraction of the bus: a terminal this near to a rail is at the rail

std::uint32_t whole(double x) {
  return x < 0.0 ? 0u : x < 4294967295.0 ? static_cast<std::uint32_t>(std::floor(x + 0.5)) : 0xffffffffu;
}

control::ZeroCrossingConfig crossing_of(const SensorlessBasis& b) {
  control::ZeroCrossingConfig c;
  const auto counts = [&](double V) { return static_cast<std::int32_t>(V / b.lsb_V) + 1; };
  c.seen = b.spec.seen;
  c.rail_counts = static_cast<std::uint16_t>(whole(rail_part * b.spec.bus_V / b.lsb_V));
  c.threshold = counts(b.threshold_V);
  // In the freewheel a diode clamps the terminal one diode drop beyond the rail; the driven pair's mean is
  // beyond the rail by half a drop. y shows the difference.
  c.below = b.spec.seen == control::NeutralSeen::on_time ? c.threshold
                                                         : std::min(c.threshold, counts(b.spec.diode_V / 2));
  const auto through = [](double ticks) { return whole(std::ceil(ticks)); };
  c.margin_ticks = b.lag_s > 0.0 ? through(b.counts(std::max(b.spec.blanking_s, b.settle_s())))
                                 : whole(b.counts(b.spec.blanking_s));
  c.settle_ticks = through(b.counts(b.settle_s()));
  return c;
}

/// Settling time, s, of the filters of terminals and comparators. Half a pulse must be at least as long as this
/// time.
double settled_s(const SensorlessBasis& b) {
  const bool in_pulse = b.spec.comparators.followed && b.spec.comparators.against_half_bus;
  return std::max(b.settle_s(), in_pulse ? rail_lags * b.comparator_lag_s : 0.0);
}

control::CapturedCrossingConfig captured_of(const SensorlessBasis& b) {
  const ComparatorSpec& c = b.spec.comparators;
  if (!c.followed) return {};
  control::CapturedCrossingConfig captured{.follows = true, .lag_ticks = whole(b.counts(b.comparator_lag_s))};
  if (!c.against_half_bus) return captured;
  captured.period_ticks = whole(b.counts(b.spec.period_s));
  captured.settle_ticks = whole(b.counts(rail_lags * b.comparator_lag_s));
  return captured;
}

control::SpinConfig spin_of(const SensorlessBasis& b) {
  control::SpinConfig s;
  s.threshold = static_cast<std::int32_t>(b.threshold_V / b.lsb_V) + 1;
  s.crossings = 4;
  const double L = b.motor.machine.L_H, most_A = std::max(b.start_A, usual_overload * b.nominal_A);
  s.settle_ticks = whole(b.counts(6.0 * L * most_A / b.spec.bus_V + 2.0 * b.spec.period_s));
  s.listen_ticks = b.spec.catches_spin ? whole(b.counts(2.0 * b.sector_s(b.lowest_rad_s))) : 0;
  return s;
}

control::StartUpConfig<double> start_of(const SensorlessBasis& b,
                                        const control::ZeroCrossingConfig& crossing) {
  control::StartUpConfig<double> s;
  const double T = b.spec.period_s, per_sector = b.motor.machine.pole_pairs / base::sector_rad;
  s.current_A = b.start_A;
  s.falling_A = falling * b.start_A;
  s.align_ticks = whole(b.counts(swings * b.swing_s()));
  s.swing_threshold = 4 * crossing.threshold;
  s.swing_shift = 1;
  while (s.swing_shift < 12 && static_cast<double>(2u << s.swing_shift) * T < b.swing_s() / 16.0)
    ++s.swing_shift;
  s.acceleration = std::max(1u, whole(b.ramp_rad_s2() * per_sector * T * T * two_to_32));
  s.last_speed = whole(std::min(0.25, 2.0 * b.lowest_rad_s * per_sector * T) * two_to_32);
  const double ramp_s = 2.0 * b.lowest_rad_s / b.ramp_rad_s2();
  s.longest_ticks = whole(b.counts(2.0 * ramp_s + 12.0 * b.sector_s(b.lowest_rad_s)));
  s.trusted = 6;
  s.trusted_ticks = whole(b.counts(b.sector_s(b.lowest_rad_s)));
  return s;
}

control::LockConfig lock_of(const SensorlessBasis& b) {
  control::LockConfig l;
  l.shortest_ticks = whole(b.counts(b.sector_s(fastest * b.no_load_rad_s)));
  l.threshold = static_cast<std::int32_t>(b.lock_V / b.lsb_V) + 1;
  l.most_flux = whole(fluxes * 3.0 * b.motor.machine.K_e_V_s / b.lsb_V * b.counts(b.sector_s(1.0)));
  // If a leg's diode stops conducting within the on-time, the leg is still moving away from the rail at the
  // sample: the flux cannot be computed from its voltage.
  if (b.lag_s > 0.0 && b.spec.chopping != control::Chopping::hard) l.most_flux = 0xffffffffu;
  l.longest_ticks = whole(b.counts(b.sector_s(slowest * b.lowest_rad_s)));
  return l;
}

void set_measuring(const SensorlessBasis& b, control::SensorlessConfig<double>& rotor) {
  const double sector = base::sector_rad / b.motor.machine.pole_pairs;
  rotor.speed.sector_rad_s_ticks = sector * b.spec.capture_Hz;
  rotor.speed.timeout_ticks = whole(std::min(2.0e9, 4.0 * static_cast<double>(rotor.lock.longest_ticks)));
  rotor.speed.edges = 6;
  rotor.speed.window_ticks = whole(b.counts(b.spec.speed_window_s));
  rotor.position = {60.0 / b.motor.machine.pole_pairs, 60.0 / b.motor.machine.pole_pairs};
}

double least_periods_a_sector(const SensorlessBasis& b) {
  if (b.spec.comparators.followed) return captured_periods_a_sector;
  return b.lag_s > 0.0 ? filtered_periods_a_sector : periods_a_sector;
}

const char* least_sector(const SensorlessBasis& b) {
  if (b.spec.comparators.followed) return "a sector in 3 periods";
  return b.lag_s > 0.0 ? "a sector in 5 periods" : "a sector in 4 periods";
}

std::vector<DerivationStep> steps_of(const SensorlessBasis& b, const SensorlessStart& s) {
  std::vector<DerivationStep> steps = {
      {"y_0", "5 sqrt(6) noise + 2 steps + mismatch U", b.threshold_V, "V"},
      {"w_low", "4 y_0/(2 K_e), at least lowest_part U/K_t", s.lowest_rad_s, "rad/s"},
      {"w_high", least_sector(b), s.highest_rad_s, "rad/s"},
      {"I_start", "overload I_N, at most 0.8 U/R_tt", b.start_A, "A"},
      {"T_swing", "2 pi sqrt(J/(p K_t I_start))", b.swing_s(), "s"},
      {"T_load",
       "greatest_load K_t I_N + T_c; at rest T_c is replaced by the static friction torque if that is larger",
       b.load_Nm, "N m"},
      {"a", "(K_t I_start - T_load)/(2 J)", b.ramp_rad_s2(), "rad/s^2"},
      {"I_ramp", "(J a + T_c + B w_low)/K_t, the current with which the speed loop begins", b.ramp_A(), "A"},
      {"d'", "I_N K_t^2/(J U) with soft chopping, half of it with other chopping",
       s.duty_per_period / b.spec.period_s, "1/s"}};
  if (b.lag_s > 0.0) {
    steps.push_back(
        {"tau",
         "1/(2 pi bandwidth of the terminals' filter), subtracted from the commutation's delay unless comparators are followed",
         b.lag_s, "s"});
    steps.push_back({"t_rail", "3.5 tau, from an edge to the rail", b.settle_s(), "s"});
  }
  if (b.spec.comparators.followed) {
    steps.push_back({"y_c", "offset and half the hysteresis, added to y_0", b.comparators_V(), "V"});
    steps.push_back(
        {"tau_c", "1/(2 pi bandwidth of the comparators' low-pass), subtracted from the commutation's delay",
         b.comparator_lag_s, "s"});
  }
  return steps;
}

}  // namespace

base::Result<SensorlessStart> sensorless_start(const MotorModel& motor, const SensorlessSpec& spec,
                                               double current_at_full_output_A) {
  if (base::Problems problems = unusable(motor, spec); !problems.empty()) return problems;
  const SensorlessBasis b = sensorless_basis(motor, spec);
  if (base::Problems problems = out_of_reach(b); !problems.empty()) return problems;
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
      current_at_full_output_A > 0.0 ? std::min(1.0, b.ramp_A() / current_at_full_output_A) : 0.0;
  const double K_t = motor.K_t_Nm_A;
  // Hard chopping changes the voltage by twice the bus per duty. With complementary chopping, the old current
  // continues while the motor brakes.
  const double swing_V = spec.chopping == control::Chopping::soft ? spec.bus_V : 2.0 * spec.bus_V;
  out.duty_per_period = b.nominal_A * K_t * K_t / (motor.shaft.J_kg_m2 * swing_V) * spec.period_s;
  out.current_per_period = b.nominal_A * spec.period_s / usual_current_settle_s;
  if (spec.seen == control::NeutralSeen::on_time)
    out.least_duty =
        std::min(0.5, 2.0 * (spec.pulse_late_s + std::max(spec.sampling_s, settled_s(b))) / spec.period_s);
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
