// SPDX-License-Identifier: Apache-2.0
#include "text/results/fit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/visitor.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_text.hpp"
#include "text/results/interval_json.hpp"
#include "text/results/interval_text.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

using analysis::Fit;
using analysis::FittedValue;
using Json = nlohmann::ordered_json;

/// Correlation of neighbouring differences from which on the text names it.
constexpr double least_correlation = 0.2;

/// Finds the quantity of a sheet's key and its frame.
class QuantityFinder final : public sixstep::base::Visitor {
 public:
  explicit QuantityFinder(std::string_view key) : key_(key) {}
  const sixstep::base::Quantity* quantity = nullptr;
  std::string frame;

 private:
  void visit_quantity(std::string_view key, const sixstep::base::QuantityMember& member,
                      const sixstep::base::About& about) override {
    if (key != key_) return;
    quantity = quantity_in(member);
    frame = about.frame;
    if (quantity && !quantity->frame.empty()) frame = quantity->frame;
  }
  std::string_view key_;
};

/// The key without its table for the motor's constants; "gain of i_a_A in log.csv" for a probe's parameter.
std::string fit_name(std::string_view key, const std::string& bench) {
  if (bench.empty()) return std::string(key.starts_with("motor_override.") ? key.substr(15) : key);
  const std::size_t dot = key.find('.');
  const std::string_view word = key.substr(0, dot);
  return dot == std::string_view::npos
             ? fmt::format("{} of {}", word, visible(bench))
             : fmt::format("{} of {} in {}", word, key.substr(dot + 1), visible(bench));
}

/// The text without the table of the motor's keys.
std::string without_table(std::string text) {
  constexpr std::string_view table = "motor_override.";
  for (std::size_t at = text.find(table); at != text.npos; at = text.find(table))
    text.erase(at, table.size());
  return visible(text);
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() || unit == "1" ? number : number + " " + unit;
}

std::string note_of(const FittedValue& v) {
  if (v.at_zero) return "upper bound; the best value is not above 0";
  if (!v.given.empty()) return fmt::format("for the kept {}", without_table(v.given));
  return v.by_profile ? "bounds by the profile" : "";
}

std::string values_section(const Fit& fit, const design::Sheet& sheet) {
  Rows rows;
  rows.add({"Value", "start", "fitted", "95 %", "frame", ""});
  for (const FittedValue& v : fit.values)
    rows.add({fit_name(v.key, v.bench), with_unit(fmt::format("{:.4g}", v.start), v.unit),
              with_unit(v.at_zero ? "0" : measured_text(v.value), v.unit), bounds_text(v.value),
              fit_frame(sheet, v), note_of(v)});
  return rows.text();
}

std::string undetermined_section(const Fit& fit) {
  if (fit.undetermined.empty()) return "";
  std::string out =
      "\n  Not determined by these recordings; kept at this value, for which the fitted values hold\n";
  for (const analysis::Undetermined& u : fit.undetermined) {
    out += fmt::format("  {} = {}: {}", fit_name(u.key, u.bench),
                       with_unit(fmt::format("{:.4g}", u.value), u.unit), without_table(u.reason));
    if (!u.recording.empty()) out += fmt::format(". To determine it, record {}", u.recording);
    out += "\n";
  }
  return out;
}

std::string residuals_section(const Fit& fit) {
  Rows rows;
  rows.add({"Recording", "column", "rows", "difference, rms", "correlation"});
  for (const analysis::FitColumn& c : fit.columns)
    rows.add({visible(c.bench), c.column.name, std::to_string(c.t_s.size()),
              quantity_text(c.noise, c.column.unit.c_str()), fmt::format("{:.2f}", c.correlation)});
  std::string out = rows.text();
  for (const analysis::FitColumn& c : fit.columns)
    if (std::fabs(c.correlation) >
        std::max(least_correlation, 4.0 / std::sqrt(static_cast<double>(c.t_s.size()))))
      out += fmt::format(
          "  {} of {}: the difference of a row resembles that of the next row (correlation {:.2f}; noise has 0). "
          "Noise alone does not explain it: the scenario differs from the bench, or a parameter is missing\n",
          c.column.name, visible(c.bench), c.correlation);
  return out;
}

}  // namespace

std::string fit_frame(const design::Sheet& sheet, const FittedValue& value) {
  design::Sheet copy = sheet;
  QuantityFinder finder(motor_key(value));
  describe(finder, copy);
  return finder.frame;
}

std::string fit_motor_lines(const Fit& fit, const design::Sheet& sheet) {
  std::string out;
  for (const FittedValue& v : fit.values) {
    if (motor_key(v).empty()) continue;
    design::Sheet copy = sheet;
    QuantityFinder finder(motor_key(v));
    describe(finder, copy);
    if (finder.quantity == nullptr) continue;
    out += fmt::format("{} = {{ value = {}", motor_key(v), v.at_zero ? "0" : measured_text(v.value));
    if (!finder.quantity->frame.empty()) out += fmt::format(", frame = \"{}\"", finder.quantity->frame);
    out += fmt::format(", source = {}, kind = \"measured\" }}  # 95 %: {}\n",
                       toml_text(finder.quantity->source), bounds_text(v.value));
  }
  return out;
}

std::string fit_text(const Fit& fit, const design::Sheet& sheet) {
  std::size_t cells = 0;
  for (const analysis::FitColumn& c : fit.columns) cells += c.t_s.size();
  std::string out =
      fmt::format("{} of {}, {}\n\n", counted(cells, "value"), counted(fit.columns.size(), "column"),
                  counted(fit.simulations, "simulation"));
  if (!fit.converged)
    out += "NOT CONVERGED: the values are the best of all trials, and the bounds may be too narrow\n\n";
  out += values_section(fit, sheet) + undetermined_section(fit) + "\n" + residuals_section(fit);
  const std::string lines = fit_motor_lines(fit, sheet);
  if (!lines.empty()) out += "\nFor the motor's file\n" + lines;
  return out;
}

std::string fit_json(const Fit& fit, const design::Sheet& sheet) {
  Json out = {{"sixstep", SIXSTEP_VERSION}, {"converged", fit.converged}, {"simulations", fit.simulations}};
  for (const char* const list : {"values", "undetermined", "columns"}) out[list] = Json::array();
  for (const FittedValue& v : fit.values) {
    Json one = {{"key", v.key},
                {"recording", v.bench},
                {"unit", v.unit},
                {"frame", fit_frame(sheet, v)},
                {"start", v.start}};
    one.update(interval_json(v.value));
    one["given"] = v.given;
    one["by_profile"] = v.by_profile;
    one["at_zero"] = v.at_zero;
    out["values"].push_back(std::move(one));
  }
  for (const analysis::Undetermined& u : fit.undetermined)
    out["undetermined"].push_back({{"key", u.key},
                                   {"recording", u.bench},
                                   {"unit", u.unit},
                                   {"value", u.value},
                                   {"reason", u.reason},
                                   {"to_record", u.recording}});
  for (const analysis::FitColumn& c : fit.columns)
    out["columns"].push_back({{"recording", c.bench},
                              {"column", c.column.name},
                              {"unit", c.column.unit},
                              {"rows", c.t_s.size()},
                              {"difference_rms", c.noise},
                              {"correlation", c.correlation}});
  return json_text(out) + "\n";
}

}  // namespace text
