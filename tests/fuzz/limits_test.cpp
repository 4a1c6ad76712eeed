// SPDX-License-Identifier: Apache-2.0
// Tests that limits apply to every motor of the library, chopping, sample instant, delay, arithmetic, sensor
// and drive. Current, speed and bus voltage stay within the bounds of design/loops/limit_bounds.hpp, or the
// scenario is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "files/scenario_on_disk.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/fuzz/draw.hpp"
#include "text/motor/motor_library.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using control::Mode;
using study::Arithmetic;
using study::MetricKind;
using study::Scenario;
using study::Signal;

/// Data sheets from which a motor model can be computed.
const std::vector<design::Sheet>& motors() {
  static const std::vector<design::Sheet> all = [] {
    std::vector<design::Sheet> out;
    for (const std::string& name : text::built_in_motors())
      if (const auto sheet = files::read_sheet(name))
        if (const auto model = design::motor_model(*sheet); model && model->shaft.J_kg_m2 > 0)
          out.push_back(*sheet);
    return out;
  }();
  return all;
}

constexpr Arithmetic arithmetics[] = {Arithmetic::float64, Arithmetic::float32, Arithmetic::q15,
                                      Arithmetic::q14,     Arithmetic::q31,     Arithmetic::q30};

/// A drive with limits. Its reference has first one sign and then the other sign.
struct DrawnLimits {
  explicit DrawnLimits(std::uint64_t seed);
  void draw_board(Draw& draw);
  void draw_limits(Draw& draw);
  void draw_sensors(Draw& draw);

  Scenario s;
  design::MotorModel motor;
  double bus_V = 0, top_rad_s = 0, current_A = 0;
};

DrawnLimits::DrawnLimits(std::uint64_t seed) {
  Draw draw(seed);
  s.sheet = motors()[static_cast<std::size_t>(draw.one_of(static_cast<int>(motors().size())))];
  motor = *design::motor_model(s.sheet);
  bus_V = motor.nominal_voltage_V > 0 ? motor.nominal_voltage_V : draw.between(12, 48);
  top_rad_s = bus_V / motor.K_t_Nm_A;
  draw_board(draw);
  draw_limits(draw);
  draw_sensors(draw);
}

void DrawnLimits::draw_board(Draw& draw) {
  s.supply.voltage_V = bus_V;
  s.pwm.period_s = draw.between(15e-6, 50e-6);
  s.pwm.chopping = static_cast<Chopping>(draw.one_of(3));
  s.pwm.alignment = draw.chance(0.5) ? study::Alignment::edge : study::Alignment::centre;
  s.pwm.sample = draw.chance(0.5) ? study::SampleAt::start : study::SampleAt::middle;
  s.pwm.commutation = draw.chance(0.7) ? study::CommutationAt::hall_edge : study::CommutationAt::sample;
  s.pwm.delay_periods = draw.one_of(2);
  s.bridge.diode_drop_V = draw.chance(0.5) ? 0.0 : 0.7;
  s.bridge.dead_time_s = draw.chance(0.5) ? 0.0 : 1e-6;
  s.control.arithmetic = arithmetics[draw.one_of(6)];
}

void DrawnLimits::draw_limits(Draw& draw) {
  const double R = 2 * motor.machine.R_ohm, L = 2 * motor.machine.L_H, T = s.pwm.period_s;
  current_A = std::max(draw.between(0.05, 0.4) * bus_V / R, draw.between(0.8, 3.0) * bus_V * T / L);
  s.control.mode = draw.chance(0.5) ? Mode::current : Mode::speed;
  s.control.current.settle_s = draw.between(12, 60) * T;
  s.control.current.damping = 0.9;
  s.control.current.limit_A = current_A;
  s.control.limits.current_A = current_A;
  s.control.speed.settle_s = draw.between(5e-3, 50e-3);
  s.control.speed.damping = 0.9;
  s.control.speed.torque_limit_Nm = draw.between(1.0, 1.5) * current_A * motor.K_t_Nm_A;
  // The acceleration to top speed takes 4 to 20 ms. It takes longer if the rotor's inertia alone needs more
  // time.
  const double way = draw.between(4e-3, 20e-3) * current_A * motor.K_t_Nm_A / top_rad_s;
  s.load.inertia_kg_m2 = std::max(0.0, way - motor.shaft.J_kg_m2);
  s.duration_s = 50e-3;
  const double value = s.control.mode == Mode::current ? current_A : draw.between(0.3, 1.2) * top_rad_s;
  const double turn_s = draw.between(0.2, 0.8) * s.duration_s, sign = draw.sign();
  s.reference = {.shape = study::Shape::steps,
                 .times_s = {0.0, turn_s},
                 .values = {sign * value, -sign * draw.between(0.0, 1.0) * value}};
  if (draw.chance(0.6)) s.control.limits.speed_rad_s = draw.between(0.15, 0.9) * top_rad_s;
  if (!draw.chance(0.6)) return;
  s.supply.sinks = false;
  s.supply.resistance_ohm = draw.between(0.02, 0.2) * R;
  const double headroom_V = draw.between(0.05, 0.4) * bus_V;
  s.control.regeneration.limit_V = bus_V + headroom_V;
  // The capacitance is 0.7 to 30 times the value that absorbs the windings' energy within the headroom.
  s.supply.capacitance_F = draw.decades(0.7, 30) * L * std::pow(2 * current_A / headroom_V, 2);
  // The rotor's kinetic energy exceeds the energy that the capacitor absorbs within the headroom. The limit
  // must therefore act.
  const double enough = 6 * s.supply.capacitance_F * bus_V * headroom_V / (top_rad_s * top_rad_s);
  s.load.inertia_kg_m2 = std::max(s.load.inertia_kg_m2, enough);
}

void DrawnLimits::draw_sensors(Draw& draw) {
  const double highest_V = s.control.regeneration.limit_V.value_or(bus_V);
  const bool product = draw.chance(0.3);
  study::Sensors& sensors = s.sensors;
  if (product || draw.chance(0.3)) {
    sensors.currents = rig::CurrentMeasurement::phases;
    sensors.current_range_A = draw.between(1.5, 4) * current_A;
  }
  if (product || draw.chance(0.3)) {
    sensors.bus = study::BusSensing::adc;
    sensors.bus_range_V = 2.5 * highest_V;
  }
  if (product || draw.chance(0.3)) {
    sensors.rotor = study::RotorSensing::hall;
    sensors.speed_edges = 1 + draw.one_of(6);
  } else if (draw.chance(s.supply.sinks ? 0.5 : 1.0)) {
    s.initial.speed_rad_s = draw.sign() * draw.between(0.3, 0.95) * top_rad_s;
  }
  if (!product) return;
  s.control.drive = study::FirmwareKind::product;
  s.protection = {.over_current_A = 0.98 * *sensors.current_range_A,
                  .over_voltage_V = 2.4 * highest_V,
                  .under_voltage_V = 0.1 * bus_V,
                  .over_speed_rad_s = 1.5 * top_rad_s};
}

/// Largest magnitudes in a run.
struct Reached {
  double current_A = 0, speed_rad_s = 0, bus_V = 0;
};

Reached reached(const study::Outcome& out) {
  const auto figure = [&](std::size_t n) { return std::fabs(out.comparisons[n].measured); };
  return {figure(0), std::max(figure(1), figure(2)), figure(3)};
}

void ask(Scenario& s) {
  const auto add = [&s](MetricKind metric, Signal signal) {
    study::Measure m;
    m.metric = metric;
    m.signal = signal;
    s.compare.push_back({m, 0.0, ""});
  };
  add(MetricKind::maximum, Signal::current_magnitude);
  add(MetricKind::maximum, Signal::speed);
  add(MetricKind::minimum, Signal::speed);
  add(MetricKind::maximum, Signal::bus_voltage);
}

/// Largest error of a sensor: half a count of a converter, or half a digit of 16 bits. The range of a format
/// is twice the largest value, because the format must also represent differences.
double digits(const Scenario& s, double largest) {
  const bool narrow = s.control.arithmetic == Arithmetic::q15 || s.control.arithmetic == Arithmetic::q14;
  return largest *
         ((narrow ? 0x1p-12 : 0.0) + 0x1p-10 * (s.sensors.currents != rig::CurrentMeasurement::ideal));
}

/// Counts of the runs in which each limit was reached, and the largest used fraction of each allowed
/// overshoot.
struct Counts {
  int runs = 0, refused = 0, currents = 0, speeds = 0, buses = 0;
  double current = 0, speed = 0, bus = 0;
};

void judge(const DrawnLimits& drawn, const Reached& r, Counts& counts) {
  const Scenario& s = drawn.s;
  const auto compiled = study::compile(s);
  const study::Basis basis{compiled->motor, s.sheet, compiled->shaft, s.supply.voltage_V};
  const design::LimitSetting setting = study::limit_setting(s, basis, compiled->drive);
  ASSERT_LE(r.speed_rad_s, 1.05 * setting.speed_rad_s) << "or the bounds say nothing";
  const double most_A = design::most_current_A(setting) + digits(s, 3 * drawn.current_A);
  EXPECT_LE(r.current_A, most_A);
  counts.currents += r.current_A > drawn.current_A;
  counts.current = std::max(counts.current, (r.current_A - drawn.current_A) / (most_A - drawn.current_A));
  const double started = std::fabs(s.initial.speed_rad_s);
  if (const auto limit = s.control.limits.speed_rad_s; limit && *limit > started) {
    const double late = s.sensors.rotor == study::RotorSensing::hall
                            ? (s.sensors.speed_edges + 1) * M_PI / 3 / basis.motor.machine.pole_pairs
                            : 0.0;
    const double most = design::most_speed_rad_s(setting, *limit, late) + digits(s, 3 * setting.speed_rad_s);
    EXPECT_LE(r.speed_rad_s, most) << "limit " << *limit;
    counts.speeds += r.speed_rad_s > 0.98 * *limit;
    counts.speed = std::max(counts.speed, (r.speed_rad_s - *limit) / (most - *limit));
  }
  if (const auto limit = s.control.regeneration.limit_V) {
    design::LimitSetting at_most = setting;
    at_most.bus_V = 2 * *limit - drawn.bus_V + 2 * s.bridge.diode_drop_V;
    const double most = design::most_bus_V(at_most, *limit, s.supply.capacitance_F) + digits(s, 3 * *limit);
    EXPECT_LE(r.bus_V, most) << "limit " << *limit;
    counts.buses += r.bus_V > 0.9 * *limit + 0.1 * drawn.bus_V;
    counts.bus = std::max(counts.bus, (r.bus_V - *limit) / (most - *limit));
  }
}

void run_one(std::uint64_t seed, Counts& counts) {
  SCOPED_TRACE("SIXSTEP_FUZZ_SEED=" + std::to_string(seed));
  DrawnLimits drawn(seed);
  ask(drawn.s);
  const auto out = study::run(drawn.s);
  ++counts.runs;
  if (!out) {
    ++counts.refused;
    for (const base::Problem& p : out.problems()) {
      EXPECT_FALSE(p.cure.empty()) << to_string(p);
      if (std::getenv("SIXSTEP_FUZZ_SEED")) std::printf("refused: %s\n", to_string(p).c_str());
    }
    return;
  }
  judge(drawn, reached(*out), counts);
}

TEST(Fuzz, LimitsHoldOrAreRefused) {
  const Seeds range = seeds(600);
  Counts t;
  for (std::uint64_t n = 0; n < range.count; ++n) run_one(range.first + n, t);
  std::printf(
      "seeds %llu to %llu: %d runs, %d refused; limits reached, and most of what they may be passed by: "
      "current %d, %.2f, speed %d, %.2f, bus %d, %.2f\n",
      static_cast<unsigned long long>(range.first),
      static_cast<unsigned long long>(range.first + range.count - 1), t.runs, t.refused, t.currents,
      t.current, t.speeds, t.speed, t.buses, t.bus);
  if (range.count < 100) return;
  EXPECT_LT(t.refused, t.runs / 2);
  for (const int times : {t.currents, t.speeds, t.buses})
    EXPECT_GT(times, t.runs / 50) << "or nothing was tried";
}

}  // namespace SIXSTEP_TEST_FILE
