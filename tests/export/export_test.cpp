// SPDX-License-Identifier: Apache-2.0
// Firmware and simulation use the same bits. The definitions in exported headers are compared with the values
// of the run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "files/scenario_on_disk.hpp"
#include "sixstep/control/field/sensorless_field_drive.hpp"
#include "sixstep/design/fields/estimator_fields.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/scaling/product_scaling.hpp"
#include "sixstep/study/compile/arithmetic.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/export/extras_drive.hpp"
#include "tests/export/headers.hpp"
#include "text/export/config_header.hpp"
#include "text/export/config_text.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::control;

study::Scenario shipped(const std::string& name) {
  const std::string path = std::string(SIXSTEP_SOURCE_DIR) + "/data/scenarios/" + name + ".toml";
  const auto scenario = files::read_scenario(path);
  if (!scenario) ADD_FAILURE() << to_string(scenario.problems()[0]);
  return scenario ? *scenario : study::Scenario{};
}

study::Compiled compiled(const study::Scenario& scenario) { return *study::compile(scenario); }

std::int64_t bits(double x) { return std::bit_cast<std::int64_t>(x); }
std::int64_t bits(float x) { return std::bit_cast<std::int32_t>(x); }
template <class Storage, int n>
std::int64_t bits(Fixed<Storage, n> x) {
  return x.raw;
}
template <class Storage>
std::int64_t bits(FixedGain<Storage> x) {
  return std::int64_t{x.mantissa} * 256 + x.right;
}
template <class Storage>
std::int64_t bits(FixedDivisor<Storage> x) {
  return bits(x.reciprocal);
}
template <class Format>
std::int64_t bits(FixedSum<Format> x) {
  return x.raw;
}
template <class Format>
std::int64_t bits(FixedTickRatio<Format> x) {
  return x.raw;
}
template <class Whole>
requires std::is_enum_v<Whole> || std::is_integral_v<Whole> std::int64_t bits(Whole x) {
  return static_cast<std::int64_t>(x);
}

/// The bits of every member. tests/design/fields_test.cpp proves that no member is missing.
struct Bits {
  std::vector<std::int64_t> all;
  static constexpr bool when_run(bool) { return true; }
  static constexpr bool when_on(bool) { return true; }
  void add(const auto& kept) { all.push_back(bits(kept)); }
  void flag(const design::Field&, auto, const auto& kept) { add(kept); }
  void choice(const design::Field&, auto, const auto& kept, auto) { add(kept); }
  void count(const design::Field&, auto, const auto& kept, auto) { add(kept); }
  void signal(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void threshold(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void gain(const design::Field&, double, const auto& kept, design::Ratio) { add(kept); }
  void raw_gain(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void gain_of_raw(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void divisor(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void sum(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void ticks(const design::Field&, double, const auto& kept, design::Base) { add(kept); }
  void part(const char*, const auto& designed, const auto& kept, const auto&... told) {
    design::fields(*this, designed, kept, told...);
  }
};

template <class S>
std::vector<std::int64_t> bits_of(const DriveConfig<S>& c) {
  Bits walk;
  design::fields(walk, DriveConfig<double>{}, c);
  return walk.all;
}

TEST(ExportHeader, FloatingPointIsWhatTheRunComputesWith) {
  EXPECT_EQ(bits_of(exported_current::drive),
            bits_of(compiled(shipped("thesis/7.3.1-locked-exact-design")).drive));
  EXPECT_EQ(bits_of(exported_hysteresis::drive), bits_of(compiled(shipped("thesis/7.3.2-motor-hard")).drive));
  const auto speed = compiled(shipped("thesis/7.4-speed-thesis-gains")).drive;
  EXPECT_EQ(bits_of(exported_speed::drive), bits_of(speed));
  EXPECT_EQ(bits_of(exported_speed_float::drive), bits_of(study::in_arithmetic<float>(speed)));
  const auto position = compiled(shipped("thesis/7.5-position")).drive;
  EXPECT_EQ(bits_of(exported_position::drive), bits_of(position));
  EXPECT_EQ(bits_of(exported_position_float::drive), bits_of(study::in_arithmetic<float>(position)));
}

/// Checks that drive and bases are equal to the result of design::scaled() over the header's range.
template <class S>
void expect_scaled(const DriveConfig<S>& drive, const Units<S>& units, const char* name,
                   std::optional<design::OperatingRange> stated = {}) {
  SCOPED_TRACE(name);
  const study::Scenario scenario = shipped(name);
  const study::Compiled c = compiled(scenario);
  const auto scaled = design::scaled<S>(c.drive, stated.value_or(study::operating_range(scenario, c)));
  ASSERT_TRUE(scaled) << to_string(scaled.problems()[0]);
  EXPECT_EQ(bits_of(drive), bits_of(scaled->config));
  EXPECT_EQ(units.current_A, scaled->bases.current_A);
  EXPECT_EQ(units.voltage_V, scaled->bases.voltage_V);
  EXPECT_EQ(units.speed_rad_s, scaled->bases.speed_rad_s);
  EXPECT_EQ(units.position_deg, scaled->bases.position_deg);
}

constexpr design::OperatingRange stated{.current_A = 24, .speed_rad_s = 850, .bus_V = 40, .setpoint = 700};

TEST(ExportHeader, FixedPointIsWhatTheScalingProved) {
  expect_scaled(exported_duty::drive, exported_duty::units, "reference/R3");
  expect_scaled(exported_current_q15::drive, exported_current_q15::units, "thesis/7.3.1-locked-exact-design");
  expect_scaled(exported_hysteresis_q31::drive, exported_hysteresis_q31::units, "thesis/7.3.2-motor-hard");
  expect_scaled(exported_speed_q15::drive, exported_speed_q15::units, "thesis/7.4-speed-thesis-gains");
  expect_scaled(exported_speed_stated::drive, exported_speed_stated::units, "thesis/7.4-speed-thesis-gains",
                stated);
  expect_scaled(exported_position_q15::drive, exported_position_q15::units, "thesis/7.5-position");
  expect_scaled(exported_position_q14::drive, exported_position_q14::units, "thesis/7.5-position");
  expect_scaled(exported_position_q30::drive, exported_position_q30::units, "thesis/7.5-position");
  expect_scaled(exported_position_q31::drive, exported_position_q31::units, "thesis/7.5-position");
}

template <class S>
std::vector<std::int64_t> bits_of(const ProtectedConfig<S>& c) {
  Bits walk{bits_of(c.drive)};
  design::fields(walk, ProtectedConfig<double>{}, c);
  return walk.all;
}

template <class S>
void expect_product(const ProtectedConfig<S>& product, const Units<S>& units,
                    std::optional<double> full_scale_A = {}) {
  study::Scenario s = shipped("product-broken-hall-line");
  s.control.advance = {6.0, 0.02, 30.0};
  s.sensors.hall_stable_samples = 3;
  s.protection.brake_current_A = 4.0;
  s.control.full_scale.current_A = full_scale_A;
  const auto run = study::product_in<S>(s, compiled(s));
  ASSERT_TRUE(run) << to_string(run.problems()[0]);
  EXPECT_EQ(bits_of(product), bits_of(run->config));
  EXPECT_EQ(units.current_A, run->bases.current_A);
  EXPECT_EQ(units.speed_rad_s, run->bases.speed_rad_s);
}

TEST(ExportHeader, TheProductIsWhatTheRunComputesWith) {
  expect_product(exported_product::product, exported_product::units);
  expect_product(exported_product_float::product, exported_product_float::units);
  expect_product(exported_product_q15::product, exported_product_q15::units);
  expect_product(exported_product_q31::product, exported_product_q31::units, 40.0);
}

template <class S>
std::vector<std::int64_t> bits_of(const FieldDriveConfig<S>& c) {
  Bits walk{bits_of(c.drive)};
  design::fields(walk, FieldDriveConfig<double>{}, c);
  return walk.all;
}

study::Scenario salient() {
  study::Scenario s = shipped("gallery/machine-sine-field");
  s.control.field.voltage_limit = VoltageLimit::axes;
  s.sheet.inductance_mH = std::nullopt;
  s.sheet.d_axis_inductance_mH = base::Quantity{0.2, "", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.4, "", ""};
  return s;
}

/// Checks that the constants of the header are equal to the constants of the run. For any input of the chip,
/// the results of each step are also equal.
template <class S>
void expect_field(const FieldDriveConfig<S>& header, const study::Scenario& s) {
  const auto run = study::field_in<S>(compiled(s));
  ASSERT_TRUE(run);
  EXPECT_EQ(bits_of(header), bits_of(run->config.field));
  FieldDriveState<S> chip, simulated;
  Telemetry<S> told;
  BinaryAngle electrical = 0;
  S swing{};
  for (int n = 0; n < 2000; ++n) {
    electrical += 20000000u + static_cast<BinaryAngle>(n) * 10007u;
    const auto part = [&](int k) { return static_cast<S>((n * k) % 200 - 100) / 100; };
    FieldDriveInput<S> input;
    input.measured = {.i_a_A = 8 * part(7), .i_b_A = 8 * part(11), .i_c_A = 8 * part(13)};
    input.measured.speed_rad_s = 900 * part(3);
    input.measured.bus_V = static_cast<S>(24);
    input.magnet = field_directions(header.advance, electrical, input.measured.speed_rad_s);
    const Setpoint<S> setpoint{5 * part(17)};
    const LegCommands<S> a = field_drive_step(header, chip, input, setpoint, told);
    const LegCommands<S> b = field_drive_step(run->config.field, simulated, input, setpoint, told);
    ASSERT_TRUE(a.enabled);
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(bits(a.leg[k].duty), bits(b.leg[k].duty)) << n;
    swing = std::max(swing, a.leg[0].duty - a.leg[1].duty);
  }
  EXPECT_GT(swing, S(0.5)) << "it answers with the bus";
}

TEST(ExportHeader, TheFieldOrientedDriveIsWhatTheRunComputesWith) {
  expect_field(exported_field::field, shipped("gallery/field-weakened"));
  expect_field(exported_field_float::field, shipped("gallery/field-weakened"));
  expect_field(exported_field_salient::field, salient());
}

template <class S>
std::vector<std::int64_t> bits_of(const SensorlessFieldConfig<S>& c) {
  Bits walk{bits_of(c.field)};
  design::fields(walk, SensorlessFieldConfig<double>{}, c);
  return walk.all;
}

TEST(ExportHeader, TheEstimatorIsWhatTheRunComputesWith) {
  const auto observer = study::field_in<float>(compiled(shipped("gallery/field-observer")));
  EXPECT_EQ(bits_of(exported_field_observer::sensorless_field), bits_of(observer->config));
  EXPECT_TRUE(exported_field_observer::sensorless_field == observer->config);
  const auto injection = study::field_in<double>(compiled(shipped("gallery/field-injection")));
  EXPECT_EQ(bits_of(exported_field_injection::sensorless_field), bits_of(injection->config));
  EXPECT_TRUE(exported_field_injection::sensorless_field == injection->config);
}

template <class S>
std::vector<std::int64_t> bits_of(const PulsedDriveConfig<S>& c) {
  Bits walk{bits_of(c.drive.drive)};
  const PulsedDriveConfig<double> none{};
  walk.part("", none.drive, c.drive);
  walk.part("", none.drive.observer, c.drive.observer);
  walk.part("", none.pulses, c.pulses);
  return walk.all;
}

template <class S>
void expect_sensorless(const PulsedDriveConfig<S>& header, const char* name) {
  const auto run = study::sensorless_in<S>(shipped(name), compiled(shipped(name)));
  ASSERT_TRUE(run) << to_string(run.problems()[0]);
  EXPECT_EQ(bits_of(header), bits_of(run->config)) << name;
}

TEST(ExportHeader, TheSensorlessDriveIsWhatTheRunComputesWith) {
  expect_sensorless(exported_sensorless::sensorless, "gallery/sensorless-pulses");
  expect_sensorless(exported_sensorless_q15::sensorless, "gallery/sensorless-flux-linkage");
  expect_sensorless(exported_sensorless_comparators::sensorless, "gallery/sensorless-comparators");
  expect_sensorless(exported_sensorless_hall::sensorless, "gallery/sensorless-fallback");
}

constexpr DriveConfig<double> extras_double() {
  using Scalar = double;
  DriveConfig<Scalar> c;
#include "extras_double.inc"
  return c;
}
constexpr DriveConfig<Q31> extras_q31() {
  using Scalar = Q31;
  DriveConfig<Scalar> c;
#include "extras_q31.inc"
  return c;
}

TEST(ExportHeader, ExtrasComeAlong) {
  EXPECT_EQ(bits_of(extras_double()), bits_of(extras::drive()));
  EXPECT_EQ(bits_of(extras_q31()), bits_of(design::scaled<Q31>(extras::drive(), extras::range)->config));
}

// Constants that the header's units convert are equal to the constants that design::scaled_product() proves.
TEST(ExportHeader, UnitsGiveTheBitsOfTheProductsScaling) {
  constexpr auto u = exported_speed_stated::units;
  ProtectedConfig<double> product;
  product.drive = compiled(shipped("thesis/7.4-speed-thesis-gains")).drive;
  product.setpoint_limit = 700;
  for (AdcConfig<double>& adc : product.current_adc) adc = {40.0 / 4096 / 8, 2048, 40, 6};
  product.bus_adc = {40.0 / 4096 / 8, 0, 0, 6};
  product.speed = {
      .sector_rad_s_ticks = 3.14159265358979323846 / 3 / 8 * 1e6, .timeout_ticks = 100000, .edges = 6};
  product.faults = {15, 30, 10, 800, 8, 3000, 3};
  const auto scaled = design::scaled_product<Q15>(product, stated, 12);
  ASSERT_TRUE(scaled) << to_string(scaled.problems()[0]);
  const ProtectedConfig<Q15>& c = scaled->config;
  EXPECT_EQ(bits(c.setpoint_limit), bits(u.rad_per_s(700)));
  EXPECT_EQ(bits(c.current_adc[0].per_eighth), bits(u.amperes_per_count(40.0 / 4096)));
  EXPECT_EQ(bits(c.bus_adc.per_eighth), bits(u.volts_per_count(40.0 / 4096)));
  EXPECT_EQ(c.speed.sector_rad_s_ticks.raw, u.hall_speed(8, 1e6, 100000, 6).sector_rad_s_ticks.raw);
  EXPECT_EQ(bits(c.faults.over_current_A), bits(u.amperes(15)));
  EXPECT_EQ(bits(c.faults.over_voltage_V), bits(u.volts(30)));
  EXPECT_EQ(bits(c.faults.over_speed_rad_s), bits(u.rad_per_s(800)));
}

TEST(ExportHeader, UnitsCountPositionAsTheProductsScaling) {
  constexpr auto u = exported_position_q31::units;
  const study::Scenario scenario = shipped("thesis/7.5-position");
  const study::Compiled c = compiled(scenario);
  ProtectedConfig<double> product;
  product.drive = c.drive;
  product.position = {60.0 / 8, 60.0 / 8};
  const auto scaled = design::scaled_product<Q31>(product, study::operating_range(scenario, c), 12);
  ASSERT_TRUE(scaled) << to_string(scaled.problems()[0]);
  EXPECT_EQ(bits(scaled->config.position.per_sector), bits(u.hall_position(8).per_sector));
  EXPECT_EQ(bits(scaled->config.position.per_fraction), bits(u.hall_position(8).per_fraction));
  constexpr Units<float> si;  // floating point uses SI units
  EXPECT_EQ(si.hall_position(8).per_sector, 7.5f);
  EXPECT_EQ(si.amperes(15.5), 15.5f);
  EXPECT_EQ(si.amperes_per_count(0.25), 0.03125f);
}

base::Result<std::string> header_of(const study::Scenario& s, study::Arithmetic a, const char* name = "x",
                                    design::OperatingRange range = {}) {
  return text::config_header(
      {.scenario = s, .arithmetic = a, .range = range, .name_space = name, .command = "c"});
}

TEST(ExportHeader, WhatDoesNotFitIsNamed) {
  study::Scenario s = shipped("thesis/7.4-speed-thesis-gains");
  s.control.speed.d1 = 1e-9;
  s.control.speed.d0 = -0.9e-9;
  const auto text = header_of(s, study::Arithmetic::q15);
  ASSERT_FALSE(text);
  const base::Problem& p = text.problems()[0];
  EXPECT_EQ(p.where, "control.arithmetic");
  EXPECT_NE(p.limit.find("speed.K_i"), std::string::npos);
  EXPECT_NE(p.limit.find("one digit has no effect"), std::string::npos);
  EXPECT_FALSE(p.value.empty() || p.cure.empty());
  EXPECT_TRUE(header_of(s, study::Arithmetic::float64));
}

// The PI cancels the plant's pole at -a0. This pole remains, and the second pole is at 1 - b0 d1.
TEST(ExportHeader, GivenGainsAreToldWithTheirOwnPoles) {
  study::Scenario s = shipped("current-square");
  const design::ZohPlant plant = design::current_plant(1.03, 0.572e-3, s.pwm.period_s);
  s.control.current = {.d1 = 5.0, .d0 = 5.0 * plant.a0};
  const auto text = header_of(s, study::Arithmetic::float64);
  ASSERT_TRUE(text);
  const std::string poles = fmt::format("poles z = {:.6g} and {:.6g} on", -plant.a0, 1 - 5 * plant.b0);
  EXPECT_NE(text->find(poles), std::string::npos) << poles << "\n" << text->substr(0, 900);
  EXPECT_NE(text->find("settle_s = 0.001, damping = 0.9 would give d1 = 4.09559"), std::string::npos);
}

TEST(ExportHeader, NoFixedPointIsProvedOfTheFieldOrientedDrive) {
  const auto text = header_of(shipped("gallery/field-weakened"), study::Arithmetic::q15);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.problems()[0].where, "control.arithmetic");
  EXPECT_EQ(text.problems()[0].value, "q15");
}

TEST(ExportHeader, NamespacesAreNames) {
  const study::Scenario s = shipped("thesis/7.5-position");
  for (const char* good : {"a", "left::wheel_2", "_x"})
    EXPECT_TRUE(header_of(s, study::Arithmetic::float64, good)) << good;
  for (const char* bad : {"", "2a", "a::", "::a", "a:b", "a b", "a;", "a::2"})
    EXPECT_FALSE(header_of(s, study::Arithmetic::float64, bad)) << bad;
}

// A title must have no effect on the compiler. The comment therefore contains no line end, no line
// continuation and no reordering characters.
TEST(ExportHeader, TextsStayInTheirComment) {
  study::Scenario s = shipped("thesis/7.5-position");
  s.title = "a\nint b;\r*/ \u202e\u2066 gr\u00fcn \\";
  const auto text = header_of(s, study::Arithmetic::float64);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("// scenario  a\\u000aint b;\\u000d*/ \\u202e\\u2066 gr\u00fcn\n"), std::string::npos)
      << text->substr(0, 400);
}

}  // namespace SIXSTEP_TEST_FILE
