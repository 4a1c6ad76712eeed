// SPDX-License-Identifier: Apache-2.0
#include "text/export/core_costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "sixstep/base/decimal.hpp"
#include "text/cores.hpp"

namespace text {
namespace {

namespace control = sixstep::control;

/// The name of the reference drive in the tables.
std::string_view kind(const study::Compiled& c) {
  if (c.product) return "product";
  if (c.field) return "field";
  switch (c.drive.mode) {
    case control::Mode::duty:
      return "duty";
    case control::Mode::current:
      return c.drive.current_control == control::CurrentControl::hysteresis ? "hysteresis" : "current";
    case control::Mode::position:
      return "position";
    case control::Mode::speed:
    case control::Mode::off:
      break;
  }
  return "speed";
}

using Words = std::vector<std::string_view>;

/// The table's lines as words, without lines that begin with #.
std::vector<Words> rows(std::string_view table) {
  std::vector<Words> all;
  while (!table.empty()) {
    std::string_view line = table.substr(0, table.find('\n'));
    table.remove_prefix(line.size() < table.size() ? line.size() + 1 : line.size());
    if (line.starts_with('#')) continue;
    Words words;
    while (!line.empty()) {
      const std::string_view word = line.substr(0, line.find(' '));
      line.remove_prefix(word.size() < line.size() ? word.size() + 1 : word.size());
      words.push_back(word);
    }
    all.push_back(words);
  }
  return all;
}

/// The row that begins with the words of `key`: core, drive, arithmetic; for a count also the entry function.
const Words* row_of(const std::vector<Words>& all, const Words& key) {
  for (const Words& row : all)
    if (row.size() > key.size() && std::equal(key.begin(), key.end(), row.begin())) return &row;
  return nullptr;
}

/// Blocks that no reference drive has, by the names of their headers.
std::string blocks_beside(const study::Compiled& c) {
  const auto& e = c.drive.extras;
  const bool advances = c.product && (c.product->advance.fixed != 0 || c.product->advance.per_speed != 0);
  const bool weakens = c.field && c.field->weakening.most_A > 0;
  const bool salient = c.field && c.field->per_ampere.k_per_A != 0;
  const bool follows_shape = c.field && c.field->harmonic.on;
  const std::array<std::pair<bool, std::string_view>, 18> blocks{{
      {e.on && e.slews_setpoint, "slew"},
      {e.on && e.position.on, "jerk_profile"},
      {e.on && e.limits_current, "limits"},
      {e.on && (e.feed_forward.K_t_V_s != 0 || e.bus.lowest_bus_V != 0), "feed_forward"},
      {e.on && e.smooth_chopping, "smooth_chopping"},
      {e.on && e.pwm.pattern != control::PwmPattern::upper, "pwm_pattern"},
      {e.on && e.predicts_current, "deadbeat"},
      {e.on && e.steps_commutation, "commutation_step"},
      {e.on && e.speed_law == control::SpeedLaw::positional, "pi_positional"},
      {e.on && e.speed_law == control::SpeedLaw::observed, "observed_speed"},
      {e.on && e.speed_law == control::SpeedLaw::sliding, "sliding_speed"},
      {e.on && e.speed_derivative.g != 0, "derivative"},
      {advances, "advance"},
      {weakens, "field_weakening"},
      {salient, "torque_per_ampere"},
      {follows_shape, "harmonic_current"},
      {c.field && c.field->finite_set.on, "finite_set"},
      {c.product && c.product->sensing == control::CurrentSensing::one_shunt, "one_shunt"},
  }};
  std::string names;
  for (const auto& [has, name] : blocks)
    if (has) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

}  // namespace

std::optional<CoreCost> core_cost(std::string_view core, std::string_view drive,
                                  std::string_view arithmetic) {
  const std::vector<Words> counts = rows(cores::drives_txt()), sizes = rows(cores::sizes_txt());
  const Words* tick = row_of(counts, {core, drive, arithmetic, "tick"});
  const Words* size = row_of(sizes, {core, drive, arithmetic});
  if (!tick || !size) return std::nullopt;
  return CoreCost{std::string(tick->back()), std::string((*size)[3])};
}

std::string too_short_for_images(double period_s) {
  if (period_s >= atmega_least_period_s) return {};
  const std::string period = fmt::format("a control period of {:.4g} us is shorter than", 1e6 * period_s);
  const std::string atmega = fmt::format("{:.0f} us", 1e6 * atmega_least_period_s);
  // Rounded up, because a shorter period is too short.
  const auto stm32 = [](double least_s) {
    return fmt::format("{} us", sixstep::base::shortened(1e6 * least_s, 3, sixstep::base::Towards::up));
  };
  if (period_s >= stm32_sure_period_s)
    return fmt::format("{} the shortest period of the ATmega2560's image, {}", period, atmega);
  if (period_s >= stm32_least_period_s)
    return fmt::format(
        "{} the shortest period of the ATmega2560's image ({}). Below {} the STM32F303's image may apply a command one period late: look for `missed` above 0 in its log",
        period, atmega, stm32(stm32_sure_period_s));
  return fmt::format("{} the shortest period of both images: {} on the STM32F303, {} on the ATmega2560",
                     period, stm32(stm32_least_period_s), atmega);
}

std::string other_than_stm32_image(const study::Scenario& s) {
  if (s.control.drive != study::FirmwareKind::product) return {};
  std::string keys;
  const auto differs = [&keys](bool does, const char* key) {
    if (does) keys += (keys.empty() ? "" : ", ") + std::string(key);
  };
  differs(s.pwm.alignment != study::Alignment::edge, "pwm.alignment = \"edge\"");
  differs(s.pwm.sample != study::SampleAt::start, "pwm.sample = \"start\"");
  differs(s.pwm.delay_periods != 1, "pwm.delay_periods = 1");
  differs(s.sensors.capture_Hz != 72e6, "sensors.capture_Hz = 72e6");
  return keys.empty() ? "" : "the STM32F303's image needs " + keys;
}

std::vector<std::string> notes_for_images(const study::Scenario& s) {
  std::vector<std::string> notes;
  for (std::string note : {too_short_for_images(s.pwm.period_s), other_than_stm32_image(s)})
    if (!note.empty()) notes.push_back(std::move(note));
  return notes;
}

std::string core_cost_lines(const study::Compiled& c) {
  if (c.sensorless)
    return "//\n// docs/reference/block-costs.md lists the costs of this drive's functions on a core: sensorless_drive_step, sensorless_drive_commutate and\n// sensorless_drive_hall.\n";
  const std::vector<Words> counts = rows(cores::drives_txt()), sizes = rows(cores::sizes_txt());
  std::string text = fmt::format(
      "//\n// Worst costs on a core of a control tick and a Hall interrupt, without an interrupt's entry and exit. They were counted over\n"
      "// 80 000 recorded periods of the {} drive of tests/target/scenarios/ (docs/reference/core-costs.md):\n"
      "//   {:<12}{:<12}{:>8}{:>8}{:<16}{:>8}{:>8}\n",
      kind(c), "", "", "tick", "Hall", "", "flash", "RAM");
  for (const Words& size : sizes) {
    if (size.size() != 5 || size[1] != kind(c)) continue;
    const Words* tick = row_of(counts, {size[0], size[1], size[2], "tick"});
    const Words* hall = row_of(counts, {size[0], size[1], size[2], "hall"});
    if (!tick || (!hall && !c.field)) continue;
    text += fmt::format("//   {:<12}{:<12}{:>8}{:>8}{:<16}{:>8}{:>8} bytes\n", size[0], size[2], tick->back(),
                        hall ? hall->back() : "-", size[0].starts_with("AT") ? " cycles" : " instructions",
                        size[3], size[4]);
  }
  text += "// The counts cover the control code only; an image also contains the board's code.\n";
  if (const std::string more = blocks_beside(c); !more.empty())
    text += fmt::format("// These counts do not include: {}.\n", more);
  return text;
}

}  // namespace text
