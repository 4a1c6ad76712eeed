// SPDX-License-Identifier: Apache-2.0
#include "text/recording/preamble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "text/keys/decimal_number.hpp"
#include "text/keys/units.hpp"
#include "text/recording/cells.hpp"
#include "text/recording/decimal_marks.hpp"
#include "text/recording/heading.hpp"

namespace text {
namespace {

constexpr std::string_view names_of_rates[] = {"samplerate", "samplingrate", "samplefrequency",
                                               "samplingfrequency", "samplesrate"};
constexpr std::string_view names_of_intervals[] = {
    "sampleinterval", "samplinginterval", "sampleperiod", "samplingperiod", "deltax",     "dt",
    "deltat",         "xincrement",       "xinc",         "timeincrement",  "hresolution"};

template <class Names>
bool is_one_of(std::string_view name, const Names& names) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// The value in s or 1/s of a text such as "20 kHz", "1.25GSa/s", "Analog:0.000002" or "4e-06,s".
std::optional<double> value_in(std::string_view text, char separator, bool rate) {
  if (const std::size_t word = text.find(':'); word < text.find_first_of("0123456789"))
    text.remove_prefix(word + 1);
  text.remove_prefix(std::min(text.find_first_not_of(" ,;\t\""), text.size()));
  const std::size_t size = decimal_number(text).size;
  std::size_t end = size;
  if (separator == ';' || separator == '\t')  // with these separators, "0,0001" is one number
    end = std::min(text.find_first_not_of("0123456789.,eE+-"), text.size());
  // "10,000 Hz" is ambiguous: it may mean ten hertz or ten thousand.
  const std::size_t digits = std::min(text.find_first_not_of("0123456789,"), text.size());
  if (may_part_thousands(text.substr(0, digits), ',')) return {};
  const std::optional<double> number = number_in(text.substr(0, end));
  if (!number || !(*number > 0.0)) return {};
  std::string_view unit = text.substr(end);
  const std::size_t first = unit.find_first_not_of(" ,;\t\"()[]");
  unit = first == std::string_view::npos ? std::string_view() : unit.substr(first);
  unit = unit.substr(0, std::min(unit.find_first_of(" ,;\t\"()[]"), unit.size()));
  std::string word(unit);
  for (const std::string_view samples : {"Sa/s", "sa/s", "SPS", "sps", "S/s"})
    if (word.ends_with(samples)) word.replace(word.size() - samples.size(), samples.size(), "Hz");
  const std::string known = unit_in_words(word);
  const base::Result<Conversion> in_si = conversion(known.empty() ? "1" : known, rate ? "Hz" : "s");
  return in_si ? in_si->of(*number) : *number;  // otherwise the next cell is not a unit
}

/// Finds the times that Rigol's MSO5000 writes among its headings: "CH1V,t0 = -6e-06,tInc = 2e-09".
std::optional<RowClock> clock_among_headings(std::string_view line, char separator) {
  const auto value_of = [&](std::string_view name) -> std::optional<double> {
    const std::size_t at = line.find(name), equals = line.find('=', std::min(at, line.size()));
    if (at == std::string_view::npos || equals == std::string_view::npos) return {};
    std::string_view rest = line.substr(equals + 1);
    rest = bare_cell(rest.substr(0, std::min(rest.find(separator), rest.size())));
    return number_in(rest);
  };
  const std::optional<double> step = value_of("tInc"), start = value_of("t0");
  if (!step || !(*step > 0.0)) return {};
  return RowClock{*step, start.value_or(0.0), fmt::format("tInc = {:g}", *step)};
}

}  // namespace

std::optional<RowClock> clock_in(std::string_view line, char separator) {
  if (std::optional<RowClock> found = clock_among_headings(line, separator)) return found;
  const std::size_t first = line.find_first_not_of(" \t\";#%/");
  if (first == std::string_view::npos) return {};
  line.remove_prefix(first);
  const std::size_t cut = line.find_first_of(":=,;\t");
  if (cut == std::string_view::npos) return {};
  const std::string name = bare_name(heading_of(line.substr(0, cut)).name);
  const bool rate = is_one_of(name, names_of_rates);
  if (!rate && !is_one_of(name, names_of_intervals)) return {};
  const std::optional<double> value = value_in(line.substr(cut + 1), separator, rate);
  if (!value) return {};
  std::string said(line.substr(0, 60));
  std::replace(said.begin(), said.end(), '\t', ' ');
  while (said.ends_with(separator) || said.ends_with(' ')) said.pop_back();
  return RowClock{rate ? 1.0 / *value : *value, 0.0, said};
}

std::optional<RowClock> clock_below(const std::vector<std::string_view>& names,
                                    const std::vector<std::string_view>& values) {
  RowClock out;
  for (std::size_t n = 0; n < std::min(names.size(), values.size()); ++n) {
    const std::string name = bare_name(names[n]);
    const std::optional<double> number = number_in(values[n]);
    if (!number) continue;
    if (name == "increment" && *number > 0.0) out.interval_s = *number;
    if (name == "start") out.start_s = *number;
    if (name == "increment") out.said = "Increment " + std::string(values[n]);
  }
  return out.interval_s > 0.0 ? std::optional(out) : std::nullopt;
}

std::vector<std::string> channels_in(std::string_view line) {
  const std::size_t cut = line.find(':');
  if (cut == std::string_view::npos || !bare_name(line.substr(0, cut)).starts_with("channels")) return {};
  std::vector<std::string> out;
  for (const std::string_view cell : cells_of_line(line.substr(cut + 1), ',')) out.emplace_back(cell);
  return out;
}

}  // namespace text
