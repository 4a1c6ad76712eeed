// SPDX-License-Identifier: Apache-2.0
// Reads a number in its unit: the key's unit, the unit of its control mode or of another key, or a linear
// motor's unit.
#include <fmt/format.h>

#include "sixstep/base/linear.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/keys/units.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace {

std::optional<std::string> word_at(const Document& document, const std::string& path) {
  const toml::node* node = document.find(path);
  return node ? node->value<std::string>() : std::nullopt;
}

/// The control mode of the table at `path`. In an [[at]] it is the mode after the last event that changes the
/// mode, up to and including this event.
std::optional<std::string> mode_at(const Document& document, const std::string& path) {
  std::optional<std::string> mode = word_at(document, "control.mode");
  if (!path.starts_with("at[")) return mode;
  const std::string own = path.substr(0, path.find(']') + 1);
  const auto time_of = [&](const std::string& event) {
    const toml::node* node = document.find(event + ".time_s");
    return node ? node->value<double>().value_or(0.0) : 0.0;
  };
  const toml::node* events = document.find("at");
  const std::size_t count = events && events->is_array() ? events->as_array()->size() : 0;
  const double own_s = time_of(own);
  double last_s = -1.0;
  for (std::size_t n = 0; n < count; ++n) {
    const std::string event = fmt::format("at[{}]", n);
    const double time_s = time_of(event);
    if (time_s > own_s || time_s < last_s) continue;
    const std::optional<std::string> changed = word_at(document, event + ".control.mode");
    if (!changed || *changed == "same") continue;
    mode = changed;
    last_s = time_s;
  }
  return mode;
}

/// The unit of a reference in its control mode; empty if the mode has no unit or is unknown.
std::string mode_unit(const Document& document, const std::string& path) {
  const std::optional<std::string> word = mode_at(document, path);
  for (const auto& choice : study::mode_choices)
    if (word == choice.word) return std::string(study::reference_unit(choice.value));
  return {};
}

/// The unit of the number at a path of a scenario.
std::optional<std::string> unit_at(std::string_view path) {
  for (const KeyEntry& entry : scenario_keys()) {
    if (entry.type != KeyType::number && entry.type != KeyType::quantity) continue;
    if (entry.path == path) return std::string(entry.about.unit);
    const base::Spelling* linear = base::linear_spelling(entry.about);
    if (linear && spelled(entry, *linear).path == path) return std::string(linear->unit);
  }
  return {};
}

}  // namespace

/// The unit of a key: an empty text for a plain number; no value if the unit follows from a control mode that
/// has no unit.
std::optional<TableReader::WrittenIn> TableReader::unit_of_key(const base::About& about) const {
  const auto moving = [this](std::string_view unit) {
    const base::LinearUnit row =
        complaints_.linear_motor() ? base::in_linear(unit) : base::LinearUnit{unit, unit};
    return WrittenIn{std::string(row.linear), row.factor};
  };
  if (about.unit_here == "1") return WrittenIn{};
  if (!about.unit_here.empty()) return moving(about.unit_here);
  if (!about.unit_of.empty()) {
    const std::optional<std::string> unit = unit_at(about.unit_of);
    return unit ? std::optional(WrittenIn{*unit}) : std::nullopt;
  }
  if (about.mode_unit.empty()) return WrittenIn{std::string(about.unit)};
  const std::string unit = mode_unit(complaints_.document(), path_);
  if (unit.empty()) return {};
  // "1" is the unit of a duty, which is a plain number.
  WrittenIn whole = moving(unit);
  whole.unit += about.mode_unit.substr(1);
  if (whole.unit == "1") whole.unit.clear();
  return whole;
}

Wanted TableReader::wanted_in(const std::string& unit, const base::About& about) const {
  return {unit, about.frame, complaints_.pole_pairs()};
}

base::Result<double> TableReader::number_of(const toml::node& node, const base::About& about) const {
  const std::optional<WrittenIn> unit = unit_of_key(about);
  const double factor = unit ? unit->factor : 1.0;
  if (const toml::value<std::string>* text = node.as_string()) {
    if (unit) {
      base::Result<double> x = in_unit(text->get(), wanted_in(unit->unit, about));
      return x ? base::Result<double>(*x / factor) : x;
    }
    if (!about.unit_of.empty())
      return base::Problem{
          .limit = fmt::format("is in the unit of {}, which has no numeric value here", about.unit_of),
          .cure = "name a key of the scenario with a number, for example supply.voltage_V"};
    return base::Problem{.limit = "is in the unit of control.mode, but this mode has no unit",
                         .cure = "set control.mode, or write a number without quotes"};
  }
  if (node.is_integer()) return static_cast<double>(node.as_integer()->get()) / factor;
  if (node.is_floating_point()) return node.as_floating_point()->get() / factor;
  return base::Problem{.limit = "must be a number"};
}

/// Converts a limit to the unit in which the user has written the value.
std::string TableReader::limit_as_written(const toml::node& node, const base::About& about, double x) const {
  const base::Range allowed = base::allowed(about);
  const toml::value<std::string>* text = node.as_string();
  const std::optional<WrittenIn> own = text ? unit_of_key(about) : std::nullopt;
  const std::optional<Written> written = text ? split_number(text->get()) : std::nullopt;
  if (!own || own->unit.empty() || !written || written->unit.empty())
    return limit_of(about.range, allowed, x);
  const base::Result<Conversion> by = conversion(written->unit, wanted_in(own->unit, about));
  if (!by) return limit_of(about.range, allowed, x);
  const auto there = [&](double value) { return by->back(value * own->factor); };
  const auto in_its_unit = [&](base::Range range) {
    range.low = there(range.low);
    range.high = there(range.high);
    if (range.least != 0.0) range.least = there(range.least);
    return range;
  };
  return fmt::format("{}, in {}", limit_of(in_its_unit(about.range), in_its_unit(allowed), there(x)),
                     written->unit);
}

}  // namespace text
