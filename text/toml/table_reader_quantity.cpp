// SPDX-License-Identifier: Apache-2.0
// Reads quantities: a number in one of several spellings, with frame, source, trust and range.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sixstep/base/decimal.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_tree.hpp"
#include "text/keys/units.hpp"
#include "text/toml/table_reader.hpp"

namespace text {

std::optional<base::Spelling> TableReader::spelling_in_file(std::string_view key, const base::About& about) {
  std::optional<base::Spelling> used;
  const auto look = [&](const base::Spelling& spelling) {
    known_.emplace_back(spelling.key);
    if (spelling.linear && !complaints_.linear_motor()) other_motion_.emplace_back(spelling.key);
    const toml::node* node = table_.get(spelling.key);
    if (!node) return;
    if (used)
      complaints_.value(*node, at(spelling.key),
                        {.limit = fmt::format("is already given, as {}", used->key),
                         .cure = "keep one of the two keys, which have the same meaning"});
    else
      used = spelling;
  };
  look({.key = key});
  for (const base::Spelling& spelling : about.also) look(spelling);
  return used;
}

/// The value of the number's last digit, from the text of the file: 0.1 for 36.0, 1 for 36, and 0.0001 for
/// "36.0 mH" if the key's unit is H.
std::optional<double> TableReader::last_digit(const toml::node& node, const std::string& path,
                                              const base::About& about, int ten) const {
  std::string text = complaints_.document().quote(node, path);
  double factor = 1.0;
  if (const toml::value<std::string>* quoted = node.as_string()) {
    const std::optional<Written> written = split_number(quoted->get());
    if (!written) return {};
    const base::Result<Conversion> by = conversion(written->unit, wanted_in(std::string(about.unit), about));
    if (!by) return {};
    text = written->number;
    ten += by->ten;
    factor = by->multiply / by->divide;
  }
  const std::size_t exponent = text.find_first_of("eE"), point = text.find('.');
  const std::string_view digits = std::string_view(text).substr(0, exponent);
  if (digits.empty() || digits.find_first_not_of("+-_.0123456789") != std::string_view::npos) return {};
  int power = 0;
  if (exponent != std::string::npos) {
    const char* from = text.c_str() + exponent + 1;
    from += *from == '+';
    if (std::from_chars(from, text.c_str() + text.size(), power).ec != std::errc()) return {};
    if (power < -400 || power > 400) return {};  // outside the range of double
  }
  power += ten;
  if (point != std::string::npos)
    power -= static_cast<int>(std::count_if(digits.begin() + static_cast<std::ptrdiff_t>(point), digits.end(),
                                            [](char c) { return c >= '0' && c <= '9'; }));
  if (power < -22 || power > 22) return {};
  return factor * base::times_ten_to(1.0, power);
}

void TableReader::interval(const toml::node& node, const std::string& path, const base::About& about, int ten,
                           base::Quantity& out) {
  const toml::array* ends = node.as_array();
  double low = 0.0, high = 0.0;
  if (!ends || ends->size() != 2)
    return complaints_.value(node, path,
                             {.limit = "must be a list of two numbers", .cure = "write range = [low, high]"});
  base::About end = about;
  end.required = false;
  if (!number(*ends->get(0), path + "[0]", end, low) || !number(*ends->get(1), path + "[1]", end, high))
    return;
  if (low > high)
    return complaints_.value(node, path,
                             {.limit = "is not in rising order", .cure = "write range = [low, high]"});
  if (!(low <= out.value && out.value <= high))
    return complaints_.value(
        node, path,
        {.limit = fmt::format("does not contain the value, {}", shortest(out.value)),
         .cure = "write the least and the largest value of all sources, including this value"});
  out.range = base::Interval{base::times_ten_to(low, ten), base::times_ten_to(high, ten)};
}

void TableReader::parts(const toml::table& table, const std::string& path, const base::About& about,
                        const base::Spelling& spelling, base::Quantity& out) {
  TableReader reader(table, path, complaints_, false);
  base::About number_about = about;
  number_about.required = true;
  number_about.also = {};
  reader.value("value", out.value, number_about);
  const toml::node* const value = table.get("value");
  if (value) out.last_digit = last_digit(*value, path + ".value", about, spelling.ten);
  if (const toml::node* written = reader.find("frame", {}))
    reader.word(*written, path + ".frame", {.meaning = "frame"}, out.frame);
  if (const toml::node* written = reader.find("source", {}))
    reader.word(*written, path + ".source", {.meaning = "source"}, out.source);
  if (table.contains("kind"))
    reader.choice("kind", out.kind, base::trust_choices, {});
  else
    reader.find("kind", {});
  if (const toml::node* written = reader.find("range", {}))
    interval(*written, path + ".range", about, spelling.ten, out);
  if (value) frame_of_unit(*value, path + ".value", about, out);
  frame(table.contains("frame") ? *table.get("frame") : static_cast<const toml::node&>(table), path, about,
        out);
  reader.refuse_unknown_keys();
}

void TableReader::read(std::string_view key, base::Quantity& member, const base::About& about) {
  const std::optional<base::Spelling> spelling = spelling_in_file(key, about);
  if (!spelling) {
    find(key, about);
    return;
  }
  const toml::node& node = *table_.get(spelling->key);
  base::About spelled = about;
  if (!spelling->unit.empty()) spelled.unit = spelling->unit;
  if (!spelling->frame.empty()) spelled.frame = spelling->frame;
  base::Quantity read;
  read.frame = spelling->frame.empty() ? member.frame : std::string();  // an override keeps the frame
  read.source = partial_ ? "motor_override" : std::string(spelling->source);
  if (spelling->key != key) read.key = spelling->key;
  const std::string path = at(spelling->key);
  if (const toml::table* table = node.as_table()) {
    parts(*table, path, spelled, *spelling, read);
  } else if (number(node, path, spelled, read.value)) {
    frame_of_unit(node, path, spelled, read);
    frame(node, path, spelled, read);
    read.last_digit = last_digit(node, path, spelled, spelling->ten);
  }
  read.value = base::times_ten_to(read.value, spelling->ten) * spelling->factor;
  if (read.range)
    read.range = base::Interval{read.range->low * spelling->factor, read.range->high * spelling->factor};
  if (read.last_digit) *read.last_digit *= spelling->factor;
  member = std::move(read);
}

/// Sets the frame that follows from the unit: Nm/Arms determines the frame, and so does Vrms/krpm if only one
/// frame of the key is an rms frame. A given frame must agree.
void TableReader::frame_of_unit(const toml::node& node, const std::string& path, const base::About& about,
                                base::Quantity& quantity) {
  const toml::value<std::string>* text = node.as_string();
  const std::optional<Written> written = text ? split_number(text->get()) : std::nullopt;
  const std::string_view measure = written ? measure_in(written->unit) : std::string_view();
  if (measure.empty()) return;
  const std::vector<std::string> fit = frames_with(about.frame, measure);
  if (quantity.frame.empty() && fit.size() == 1) quantity.frame = fit.front();
  if (fit.empty() || std::find(fit.begin(), fit.end(), quantity.frame) != fit.end()) return;
  complaints_.value(
      node, path,
      {.limit = quantity.frame.empty()
                    ? fmt::format("is {}, and the frame is missing", measure)
                    : fmt::format("is {}, but the frame is \"{}\"", measure, quantity.frame),
       .cure = fmt::format("write frame = {}{}", quoted_alternatives(fit),
                           quantity.frame.empty() ? "" : ", or the unit without " + std::string(measure))});
}

/// Sets the frame that the file gives. A missing frame is reported by the struct's own check, which can
/// explain each candidate.
void TableReader::frame(const toml::node& node, const std::string& path, const base::About& about,
                        base::Quantity& quantity) {
  const std::vector<std::string> frames = frames_of(about.frame);
  if (frames.size() == 1 && quantity.frame.empty()) quantity.frame = frames[0];
  if (quantity.frame.empty() || std::find(frames.begin(), frames.end(), quantity.frame) != frames.end())
    return;
  if (frames.empty())
    complaints_.value(node, path + ".frame",
                      {.limit = "is not needed", .cure = "remove frame: this value has only one meaning"});
  else
    complaints_.value(node, path + ".frame",
                      {.limit = fmt::format("must be {}", quoted_alternatives(frames)),
                       .cure = "write frame = with the points between which the sheet measures the value"});
}

}  // namespace text
