// SPDX-License-Identifier: Apache-2.0
#include "text/motor/foreign_lines.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_tree.hpp"
#include "text/keys/template_line.hpp"

namespace text {
namespace {

/// Peak of a phase's sinusoidal back-EMF per mechanical rad/s for the speed constant `rpm_V`, in mV s.
double emf_of_kv(double rpm_V, bool six_step) {
  const double between = six_step ? 3.0 * std::sqrt(3.0) / base::pi : std::sqrt(3.0);
  return 1e3 * 30.0 / base::pi / rpm_V / between;
}

}  // namespace

std::string ten_digits(double x) { return fmt::format("{:.10g}", x); }

KeyEntry foreign_entry(std::string_view key) {
  const KeyEntry* const entry = find_key(sheet_keys(), key);
  for (const base::Spelling& spelling : entry->about.also)
    if (spelling.key == key) return spelled(*entry, spelling);
  return *entry;
}

std::string foreign_line(std::string_view key, double x, std::string_view frame, const std::string& source) {
  return fmt::format("{} = {{ value = {}{}, source = {} }}\n", key, ten_digits(x),
                     frame.empty() ? "" : fmt::format(", frame = \"{}\"", frame), source);
}

std::string missing_line(std::string_view key, const std::string& file) {
  const KeyEntry entry = foreign_entry(key);
  const bool open = frames_of(entry.about.frame).size() > 1;
  const std::string value = entry.type == KeyType::quantity
                                ? fmt::format("{{ value = nan{}, source = \"\" }}",
                                              open ? fmt::format(", frame = \"{}\"", entry.about.frame) : "")
                                : "0";
  return wrapped_comment("not in " + visible(file) + ":") +
         template_line(entry, {.key = key, .value = value, .open = true});
}

std::string answers_to(const ForeignKey& row, double x) {
  const auto means = [&](std::string_view frame) {
    return row.key == "resistance_ohm"
               ? fmt::format("R_s = {} ohm", base::six_digits(frame == "terminal" ? x / 2 : x))
               : fmt::format("K_e = {} mV s", base::six_digits(emf_of_kv(x, frame == "six-step")));
  };
  return fmt::format("answer {0}={1} ({2}) or {0}={3} ({4})", row.question, row.frame, means(row.frame),
                     row.other, means(row.other));
}

}  // namespace text
