// SPDX-License-Identifier: Apache-2.0
#include "text/export/config_header.hpp"

#include <cmath>
#include <type_traits>

#include "sixstep/base/written.hpp"
#include "sixstep/design/scaling/sensorless_scaling.hpp"
#include "sixstep/study/compile/arithmetic.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/scenario/in_arithmetic.hpp"
#include "text/export/config_text.hpp"
#include "text/export/core_costs.hpp"
#include "text/export/header_comment.hpp"
#include "text/export/name_space.hpp"

namespace text {
namespace {

namespace control = sixstep::control;

std::string proof(const std::vector<design::Headroom>& rows) {
  std::string text =
      "//\n// Fixed point: largest value of each quantity, and largest value of the format, in SI\n";
  for (const design::Headroom& row : rows)
    if (row.largest != 0)
      text += fmt::format("//   {:<28}{:>12.6g} of {:.6g}\n", row.name, row.largest, row.full_scale);
  return text;
}

std::string constant(std::string_view type, std::string_view name, const std::string& value,
                     const std::string& about) {
  const std::string code = fmt::format("inline constexpr {} {} = {};", type, name, value);
  return fmt::format("{:<72}  // {}\n", code, about);
}

/// The offset that the board's decoder subtracts from the electrical angle, if the scenario has one.
std::string sensor_offset(const study::Compiled& c) {
  const double offset_deg = c.board.sensors.shaft.believed_offset_deg;
  if (offset_deg == 0.0) return "";
  return constant("std::uint32_t", "sensor_offset",
                  fmt::format("0x{:08x}u", sixstep::control::binary_degrees(offset_deg)),
                  fmt::format("{} deg, 2^32 to a turn: subtract this offset from the electrical angle",
                              sixstep::base::six_digits(offset_deg)));
}

std::string timing(const study::Compiled& c, const study::Clearance* clearance) {
  const bool cleared = clearance && clearance->clear();
  const sixstep::rig::ModulatorConfig& m = c.board.modulator;
  const auto flag = [](bool on) { return std::string(on ? "true" : "false"); };
  const auto us = [](double ps) { return fmt::format("{:.9g} us", ps / 1e6); };
  const double dead = m.in_counts(m.dead_ticks);
  std::string bridge = "for a bridge";
  if (!c.product) bridge += " that your firmware protects";
  if (clearance && clearance->needs_sink)
    bridge += std::string(c.product ? " whose" : ", and whose") + " supply takes current back";
  return constant("bool", "cleared", flag(cleared),
                  cleared ? bridge + ", by its run"
                          : "NOT cleared for a bridge: refuse this header with a static_assert") +
         constant("std::uint8_t", "pole_pairs",
                  std::to_string(static_cast<int>(c.believed.motor.machine.pole_pairs)),
                  "electrical turns per mechanical turn") +
         sensor_offset(c) +
         constant("std::uint64_t", "pwm_period_ps", std::to_string(m.period_ticks),
                  us(static_cast<double>(m.period_ticks)) + ", and the period of the control tick") +
         constant("bool", "pwm_centre_aligned", flag(m.centre_aligned),
                  "true: centred pulse; false: pulse at the period's start") +
         constant("std::uint64_t", "dead_time_ps", fmt::format("{:.0f}", dead),
                  dead > 0 ? us(dead) : "no dead time: firmware for a bridge needs a dead time") +
         (c.field ? ""
                  : constant("bool", "commutate_at_sample", flag(c.board.commutate_at_sample),
                             "true: at the sample; false: in the Hall interrupt")) +
         constant("bool", "command_delayed", flag(c.board.delayed),
                  "true: a command takes effect in the next period; false: at once") +
         constant("bool", "sampled_in_middle", flag(c.board.sampled_in_middle),
                  "true: sample in the middle of the period; false: at its start");
}

/// Constants for the board's own code. A drive that measures times between edges needs the frequency of its
/// capture timer: a wrong frequency scales every speed and the over-speed limit. A lean drive also needs the
/// bits of its converters and the setpoint's range.
std::string board_constants(const ConfigHeader& w, const study::Compiled& c) {
  using study::RotorSensing;
  const study::Sensors& sensors = w.scenario.sensors;
  const bool has_probes = sensors.rotor == RotorSensing::hall || sensors.rotor == RotorSensing::encoder;
  std::string timer;
  if (c.sensorless || (c.product && has_probes))
    timer = constant("double", "timer_Hz", hex_float(sensors.capture_Hz),
                     sixstep::base::six_digits(sensors.capture_Hz) + " Hz, counts up and wraps at 2^32");
  const control::LowSideConfig<double>& shunts = c.board.sensors.low_side;
  if (shunts.shunts != 0)
    timer += constant("std::uint8_t", "low_side_shunts", std::to_string(shunts.shunts),
                      "legs with a shunt: bit 0 is leg a") +
             constant("double", "low_side_greatest_duty", hex_float(shunts.greatest_duty),
                      sixstep::base::six_digits(shunts.greatest_duty) +
                          ": after its pulse a leg is shown up to it") +
             constant("double", "low_side_least_duty", hex_float(shunts.least_duty),
                      sixstep::base::six_digits(shunts.least_duty) +
                          ": in a lower switch's pulse a leg is shown from it on");
  const bool by_leg = shunts.shunts != 0 || sensors.currents == sixstep::rig::CurrentMeasurement::phases;
  if (c.product || c.field || !by_leg) return timer;
  const double lsb = c.board.sensors.current.lsb(), range = c.setpoint_range;
  return timer +
         constant("int", "adc_bits", std::to_string(sensors.adc_bits), "bits of each current converter") +
         constant("double", "adc_amperes_per_count", hex_float(lsb), sixstep::base::six_digits(lsb) + " A") +
         constant("double", "setpoint_range", hex_float(range),
                  sixstep::base::six_digits(range) +
                      ": setpoint at each end of a potentiometer, in the mode's unit");
}

/// C++ text of a constant and of the function that computes it.
std::string made(std::string_view type, std::string_view name, const std::string& lines) {
  return fmt::format(
      "constexpr sixstep::control::{0}<Scalar> make_{1}() {{\n  using namespace sixstep::control;\n"
      "  {0}<Scalar> c;\n{2}  return c;\n}}\n"
      "inline constexpr sixstep::control::{0}<Scalar> {1} = make_{1}();\n\n",
      type, name, lines);
}

/// A drive has memory for a profile only if the configuration requests it (profiled_position.hpp).
std::string position_profile(const study::Compiled& c) {
  const control::DriveConfig<double>& drive = c.product ? c.product->drive
                                              : c.field ? c.field->drive
                                                        : c.drive;
  if (!drive.extras.on || !drive.extras.position.on) return "";
  return "#ifndef SIXSTEP_POSITION_PROFILE\n"
         "#define SIXSTEP_POSITION_PROFILE  // also in all code that is linked with it\n"
         "#endif\n\n";
}

std::string includes(const ConfigHeader& w, const study::Compiled& c) {
  if (w.single_header) return "#include \"sixstep_control.hpp\"\n";
  return fmt::format("#include \"sixstep/control/{}.hpp\"\n#include \"sixstep/control/units.hpp\"\n",
                     c.product        ? "protected_drive"
                     : c.sensorless   ? "commissioning/pulse_start"
                     : c.estimator.on ? "field/sensorless_field_drive"
                     : c.field        ? "field/field_drive"
                                      : "drive");
}

/// The drive in the target's arithmetic. Which members are used depends on the scenario's kind of drive.
template <class Scalar>
struct Kept {
  control::DriveConfig<Scalar> drive{};
  control::ProtectedConfig<Scalar> product{};
  control::SensorlessFieldConfig<Scalar> field{};
  control::PulsedDriveConfig<Scalar> sensorless{};
};

template <class Scalar>
std::string header(const ConfigHeader& w, const study::Compiled& c, std::string_view type,
                   const Kept<Scalar>& kept, const design::Bases& b,
                   const std::vector<design::Headroom>& rows) {
  std::string text = header_comment(w, c);
  if (!rows.empty()) text += proof(rows);
  text += core_cost_lines(c);
  for (const std::string& note : notes_for_images(w.scenario)) text += fmt::format("// Note: {}.\n", note);
  text +=
      "#pragma once\n#if __cplusplus < 201709L && !defined(_MSC_VER)\n#error \"C++20 is needed, which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack; use clang 19 for the AVR\"\n#endif\n#include <cstdint>\n\n";
  text += position_profile(c) + includes(w, c);
  text += fmt::format("\nnamespace {} {{\n\nusing Scalar = {};\n\n", w.name_space, type);
  const auto base = [](const char* member, double x, const char* unit) {
    return fmt::format("{:<72}  // {} {}\n", fmt::format("  .{} = {},", member, hex_float(x)),
                       sixstep::base::six_digits(x), unit);
  };
  text += "// Physical values of 1.0; its functions make constants of the board: units.amperes(15)\n";
  text += "inline constexpr sixstep::control::Units<Scalar> units{\n" + base("current_A", b.current_A, "A") +
          base("voltage_V", b.voltage_V, "V") + base("speed_rad_s", b.speed_rad_s, "rad/s") +
          base("position_deg", b.position_deg, "deg") + "};\n\n";
  const control::DriveConfig<double>& drive = c.field        ? c.field->drive
                                              : c.sensorless ? c.sensorless->drive.drive
                                                             : c.drive;
  text += timing(c, w.clearance) + board_constants(w, c) + "\n" +
          made("DriveConfig", "drive", config_lines<Scalar>(c.drive.mode, drive, kept.drive, b));
  const auto around = [&](const char* type_name, const char* name, const char* within, const auto& designed,
                          const auto& own) {
    text +=
        made(type_name, name,
             fmt::format("  c.{0} = {0};\n", within) + config_lines<Scalar>(c.drive.mode, designed, own, b));
  };
  if (c.product) around("ProtectedConfig", "product", "drive", *c.product, kept.product);
  if (c.field) around("FieldDriveConfig", "field", "drive", *c.field, kept.field.field);
  if (c.sensorless)
    text += made("PulsedDriveConfig", "sensorless",
                 "  c.drive.drive = drive;\n" +
                     sensorless_lines<Scalar>(c.drive.mode, *c.sensorless, kept.sensorless, b));
  if (c.estimator.on)
    around("SensorlessFieldConfig", "sensorless_field", "field",
           control::SensorlessFieldConfig<double>{{}, c.estimator}, kept.field);
  return text + fmt::format("}}  // namespace {}\n", w.name_space);
}

/// The stated operating range; members that are not stated come from the scenario's range.
design::OperatingRange range_of(const ConfigHeader& w, const study::Compiled& c) {
  const design::OperatingRange own = study::operating_range(w.scenario, c);
  const auto stated = [](double x, double otherwise) { return x > 0 ? x : otherwise; };
  return {stated(w.range.current_A, own.current_A),       stated(w.range.speed_rad_s, own.speed_rad_s),
          stated(w.range.position_deg, own.position_deg), stated(w.range.bus_V, own.bus_V),
          stated(w.range.setpoint, own.setpoint),         own.speed_change_rad_s};
}

/// Problems of a stated range that is smaller than the scenario's own range: the proof would then not apply
/// to the drive of the run.
base::Problems too_small(const ConfigHeader& w, const study::Compiled& c) {
  const design::OperatingRange least = study::least_range(w.scenario, c);
  base::Problems problems;
  const auto look = [&](const char* key, double stated, double asked, const char* unit) {
    if (stated > 0 && stated < asked)
      problems.push_back(
          {fmt::format("--range {}", key), sixstep::base::six_digits(stated),
           fmt::format(
               "is less than {} {}, the largest value that this scenario contains in its reference, limits, supply or initial state",
               sixstep::base::six_digits(asked), unit),
           "give the largest value that the drive may measure or receive, or leave this --range out"});
  };
  look("current_A", w.range.current_A, least.current_A, "A");
  look("speed_rad_s", w.range.speed_rad_s, least.speed_rad_s, "rad/s");
  look("bus_V", w.range.bus_V, least.bus_V, "V");
  if (c.drive.mode == control::Mode::position)
    look("position_deg", w.range.position_deg, least.position_deg, "deg");
  look("setpoint", w.range.setpoint, least.setpoint, "of its unit");
  return problems;
}

template <class Scalar>
base::Result<std::string> floating_header(const ConfigHeader& w, const study::Compiled& c,
                                          std::string_view type) {
  Kept<Scalar> kept;
  kept.drive = study::in_arithmetic<Scalar>(c.drive);
  if (c.product) {
    kept.product = study::product_in<Scalar>(w.scenario, c)->config;
    kept.drive = kept.product.drive;
  }
  if (c.sensorless) {
    kept.sensorless = study::sensorless_in<Scalar>(w.scenario, c)->config;
    kept.drive = kept.sensorless.drive.drive;
  }
  if (c.field) {
    kept.field = study::field_in<Scalar>(c)->config;
    kept.drive = kept.field.field.drive;
  }
  return header<Scalar>(w, c, type, kept, {}, {});
}

/// Bases for the stated range; without a stated range, the bases of the run.
template <class Scalar>
base::Result<design::Bases> chosen_bases(const ConfigHeader& w, const study::Compiled& c,
                                         const design::OperatingRange& range) {
  constexpr auto end = static_cast<double>(Scalar::max());
  if (states_range(w.range))
    return c.sensorless ? design::bases_for(c.sensorless->drive, range, end)
                        : design::bases_for(c.drive, range, end);
  study::Scenario scenario = w.scenario;
  scenario.control.arithmetic = w.arithmetic.value_or(scenario.control.arithmetic);
  const auto told = [](const auto& own) -> base::Result<design::Bases> {
    if (!own) return own.problems();
    const sixstep::rig::Bases& b = own->bases;
    return design::Bases{b.current_A, b.voltage_V, b.speed_rad_s, b.position_deg};
  };
  return c.sensorless ? told(study::sensorless_in<Scalar>(scenario, c))
                      : told(study::drive_in<Scalar>(scenario, c));
}

template <class Scalar>
base::Result<std::string> fixed_header(const ConfigHeader& w, const study::Compiled& c,
                                       std::string_view type) {
  if (c.field)
    return base::Problem{"control.arithmetic",
                         std::string(base::word(study::arithmetic_choices,
                                                w.arithmetic.value_or(w.scenario.control.arithmetic))),
                         "is fixed point, for which the field-oriented drive has no proven scaling",
                         "set --arithmetic float or --arithmetic double"};
  if (base::Problems problems = too_small(w, c); !problems.empty()) return problems;
  const design::OperatingRange range = range_of(w, c);
  const base::Result<design::Bases> bases = chosen_bases<Scalar>(w, c, range);
  if (!bases) return bases.problems();
  Kept<Scalar> kept;
  if (c.product) {
    const auto product =
        design::scaled_product<Scalar>(*c.product, range, *bases, w.scenario.sensors.adc_bits);
    if (!product) return product.problems();
    kept.drive = product->config.drive;
    kept.product = product->config;
    return header<Scalar>(w, c, type, kept, product->bases, product->proof);
  }
  if (c.sensorless) {
    const auto sensorless = design::scaled_sensorless<Scalar>(c.sensorless->drive, range, *bases);
    if (!sensorless) return sensorless.problems();
    kept.drive = sensorless->config.drive;
    kept.sensorless = {sensorless->config, c.sensorless->pulses};
    return header<Scalar>(w, c, type, kept, sensorless->bases, sensorless->proof);
  }
  const base::Result<design::Scaled<Scalar>> scaled = design::scaled<Scalar>(c.drive, range, *bases);
  if (!scaled) return scaled.problems();
  kept.drive = scaled->config;
  return header<Scalar>(w, c, type, kept, scaled->bases, scaled->proof);
}

}  // namespace

base::Result<std::string> config_header(const ConfigHeader& w) {
  if (!is_name_space(w.name_space))
    return base::Problem{
        "--namespace", w.name_space, "is not the name of a C++ namespace",
        "use letters, digits and _, for example product or product::left_wheel, but no C++ keyword, std or sixstep"};
  if (w.scenario.control.mode == control::Mode::off)
    return base::Problem{"control.mode", "off", "leaves no drive to export",
                         "set control.mode to duty, current, speed or position"};
  // A header would configure the library's drive, but the run used the user's controller.
  if (w.scenario.control.drive == study::FirmwareKind::own)
    return base::Problem{
        "control.drive", "\"own\"",
        "has its constants in its own source, and a header configures only the library's drives",
        "compile the controller's source for the chip instead of exporting a header"};
  const base::Result<study::Compiled> c = study::compile(w.scenario);
  if (!c) return c.problems();
  const study::Arithmetic arithmetic = w.arithmetic.value_or(w.scenario.control.arithmetic);
  const std::string_view word = base::word(study::arithmetic_choices, arithmetic);
  return study::in_arithmetic(arithmetic, [&]<class Scalar>() -> base::Result<std::string> {
    if constexpr (std::is_floating_point_v<Scalar>)
      return floating_header<Scalar>(w, *c, word);
    else  // the word "q15" stands for sixstep::control::Q15
      return fixed_header<Scalar>(w, *c, fmt::format("sixstep::control::Q{}", word.substr(1)));
  });
}

}  // namespace text
