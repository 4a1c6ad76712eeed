// SPDX-License-Identifier: Apache-2.0
// Makes the sentences of a comparison of controllers from its numbers, by rules.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include "text/contest/contest_text.hpp"

namespace text {
namespace {

using analysis::Contest;
using analysis::contest_figures;

/// Relative difference below which two figures count as equal.
constexpr double alike = 0.05;

/// Says how much larger b is than a: "3.2 times" or "12 % more". If a is 0, the text has both values: "3.2 ms
/// against 0 s".
std::string larger(double a, double b, const analysis::ContestFigure& figure) {
  if (!(a > 0.0)) return fmt::format("{} against {}", contest_value(b, figure), contest_value(a, figure));
  return b / a >= 2.0 ? fmt::format("{:.1f} times", b / a) : fmt::format("{:.0f} % more", 100 * (b / a - 1));
}

/// The two rows with the least values, among the rows that may win and have the figure.
struct Ranked {
  std::optional<std::size_t> first, second;
};
Ranked ranked(const Contest& c, std::size_t figure, const std::function<bool(std::size_t)>& counts) {
  Ranked r;
  const auto value = [&](std::size_t n) { return c.rows[n].values[figure]; };
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    if (!analysis::may_win(c, n) || !std::isfinite(value(n)) || !counts(n)) continue;
    if (!r.first || value(n) < value(*r.first)) {
      r.second = r.first;
      r.first = n;
    } else if (!r.second || value(n) < value(*r.second)) {
      r.second = n;
    }
  }
  return r;
}

bool are_alike(double a, double b) {
  return std::fabs(b - a) <= alike * std::fmin(std::fabs(a), std::fabs(b));
}

/// All rows that may win and whose figure equals the least value within `alike`.
std::vector<std::size_t> sharing(const Contest& c, std::size_t figure, double least) {
  std::vector<std::size_t> who;
  for (std::size_t n = 0; n < c.rows.size(); ++n)
    if (analysis::may_win(c, n) && std::isfinite(c.rows[n].values[figure]) &&
        are_alike(least, c.rows[n].values[figure]))
      who.push_back(n);
  return who;
}

/// "a", "a and b", "a; b and c". Semicolons, because names contain commas.
std::string names_of(const Contest& c, const std::vector<std::size_t>& who) {
  std::vector<std::string_view> names;
  names.reserve(who.size());
  for (const std::size_t n : who) names.push_back(c.entries[n].who->name);
  if (names.size() == 1) return std::string(names[0]);
  const std::string_view last = names.back();
  names.pop_back();
  return fmt::format("{} and {}", fmt::join(names, "; "), last);
}

/// The rows that share a figure, as text: "a; b and c share". If more than four rows share the figure, and
/// fewer rows do not share it, the text names the rows that do not: "all but d and e share".
std::string who_share(const Contest& c, const std::vector<std::size_t>& who) {
  constexpr std::size_t most_named = 4;
  std::vector<std::size_t> others;
  for (std::size_t n = 0; n < c.rows.size(); ++n)
    if (c.rows[n].nominal_held && std::find(who.begin(), who.end(), n) == who.end()) others.push_back(n);
  if (who.size() <= most_named || others.size() >= who.size()) return names_of(c, who) + " share";
  const std::string all = "All controllers that hold the course";
  return others.empty() ? all + " share" : fmt::format("{}, but for {}, share", all, names_of(c, others));
}

/// Whether exactly one row that may win has a finite value of the figure, because the other rows never
/// settle.
bool is_alone(const Contest& c, std::size_t figure) {
  std::size_t have = 0, never = 0;
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    if (!analysis::may_win(c, n)) continue;
    have += std::isfinite(c.rows[n].values[figure]) ? 1U : 0U;
    never += std::isinf(c.rows[n].values[figure]) ? 1U : 0U;
  }
  return have == 1 && never > 0;
}

/// Sentences about the figures in which one controller clearly leads, and about the figures that several
/// controllers share: "NAME has these least values: rms torque ripple (1.2 mN m, the next 2.3 times)."
std::vector<std::string> winners(const Contest& c) {
  std::vector<std::vector<std::string>> wins(c.rows.size());
  std::map<std::vector<std::size_t>, std::vector<std::string>>
      even;  // the figures that several controllers share; key: these controllers
  for (std::size_t f = 0; f < std::size(contest_figures); ++f) {
    const Ranked r = ranked(c, f, [](std::size_t) { return true; });
    if (r.first && is_alone(c, f))
      wins[*r.first].push_back(fmt::format("{} ({}; the other controllers never settle)",
                                           contest_figures[f].phrase,
                                           contest_cell(c, f, c.rows[*r.first].values[f])));
    if (!r.first || !r.second) continue;
    const double least = c.rows[*r.first].values[f], next = c.rows[*r.second].values[f];
    if (are_alike(least, next))
      even[sharing(c, f, least)].emplace_back(contest_figures[f].phrase);
    else
      wins[*r.first].push_back(fmt::format(
          "{} ({}; the next controller: {})", contest_figures[f].phrase, contest_cell(c, f, least),
          least > 0.0 ? larger(least, next, contest_figures[f]) : contest_cell(c, f, next)));
  }
  std::vector<std::string> out;
  for (std::size_t n = 0; n < wins.size(); ++n)
    if (!wins[n].empty())
      out.push_back(fmt::format("{} has these least values: {}. It {}.", c.entries[n].who->name,
                                fmt::join(wins[n], ", "), c.entries[n].who->sentence));
  for (const auto& [who, figures] : even)
    out.push_back(
        fmt::format("{} these least values within 5 %: {}.", who_share(c, who), fmt::join(figures, ", ")));
  return out;
}

/// Compares ripples or losses: -1 if the first is clearly less, 1 if the second is clearly less, 0 if they
/// are equal.
int less_of(double a, double b) { return are_alike(a, b) ? 0 : a < b ? -1 : 1; }

const char* answer(int ripple, int loss) {
  if (ripple < 0 && loss < 0) return "field-oriented has less ripple and less heat";
  if (ripple > 0 && loss > 0) return "six-step has less ripple and less heat";
  if (ripple < 0)
    return loss == 0 ? "field-oriented has less ripple at the same heat"
                     : "field-oriented has less ripple, six-step less heat";
  if (ripple > 0)
    return loss == 0 ? "six-step has less ripple at the same heat"
                     : "six-step has less ripple, field-oriented less heat";
  if (loss == 0) return "both have the same ripple and heat, and six-step is the smaller program";
  return loss < 0 ? "field-oriented has less heat at the same ripple"
                  : "six-step has less heat at the same ripple";
}

/// Compares the best six-step row of each figure with the field-oriented row.
std::vector<std::string> six_step_or_field(const Contest& c) {
  std::optional<std::size_t> field;
  for (std::size_t n = 0; n < c.rows.size(); ++n)
    if (c.entries[n].who->name == analysis::field_name && c.rows[n].nominal_held) field = n;
  if (!field) return {};
  std::vector<std::string> less, more, same;
  int ripple = 0, loss = 0;
  for (std::size_t f = 0; f < std::size(contest_figures); ++f) {
    const Ranked six =
        ranked(c, f, [&](std::size_t n) { return c.entries[n].who->name.starts_with("six-step"); });
    const double own = c.rows[*field].values[f];
    if (!six.first || !std::isfinite(own)) continue;
    const double other = c.rows[*six.first].values[f];
    const int order = less_of(own, other);
    if (f == analysis::ripple_figure) ripple = order;
    if (f == analysis::loss_figure) loss = order;
    const std::string_view phrase = contest_figures[f].phrase;
    if (order == 0)
      same.emplace_back(phrase);
    else if (order < 0)
      less.push_back(fmt::format("{} ({})", phrase, larger(own, other, contest_figures[f])));
    else
      more.push_back(fmt::format("{} ({})", phrase, larger(other, own, contest_figures[f])));
  }
  std::vector<std::string> out{
      fmt::format("Six-step or field-oriented? On this motor, {}.", answer(ripple, loss))};
  if (!less.empty())
    out.push_back(
        fmt::format("Figures that are larger with the best six-step controller: {}.", fmt::join(less, ", ")));
  if (!more.empty())
    out.push_back(
        fmt::format("Figures that are larger with field-oriented control: {}.", fmt::join(more, ", ")));
  if (!same.empty()) out.push_back(fmt::format("Equal within 5 %: {}.", fmt::join(same, ", ")));
  return out;
}

}  // namespace

std::vector<std::string> contest_words(const Contest& c) {
  std::vector<std::string> out = winners(c);
  for (std::string& line : six_step_or_field(c)) out.push_back(std::move(line));
  return out;
}

}  // namespace text
