// SPDX-License-Identifier: Apache-2.0
#include "text/results/optimum_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/escape/json_text.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

std::string bounds(const analysis::FigureColumn& f) {
  std::string text;
  if (f.min) text += fmt::format("at least {}", quantity_text(*f.min, f.unit));
  if (f.max) text += fmt::format("{}at most {}", f.min ? ", " : "", quantity_text(*f.max, f.unit));
  return text;
}

std::string limits(const OptimumStory& s, const analysis::Optimum& best) {
  if (!best.holds) return "  no tried point holds every requirement; the point above is the nearest\n";
  if (best.limits.empty()) return best.converged ? "  no limit: the minimum is inside all ranges\n" : "";
  std::vector<std::string> words;
  for (const analysis::Limit& limit : best.limits)
    words.push_back(limit.of_key
                        ? fmt::format("the {} end of {}", limit.upper ? "upper" : "lower", limit.what)
                        : visible(limit.what));
  return fmt::format("  limited by {}{}\n", fmt::join(words, ", "),
                     s.plan.drives > 1 ? " (the worst drive's)" : "");
}

}  // namespace

std::string optimum_text(const OptimumStory& s, const analysis::Optimum& best) {
  std::size_t width = 0;
  for (const analysis::InputColumn& c : s.columns.keys) width = std::max(width, c.key.size());
  for (const analysis::FigureColumn& f : s.columns.figures) width = std::max(width, visible(f.name).size());
  std::string text =
      fmt::format("{}: least {} of {} points{}\n", visible(s.name), visible(s.columns.figures[s.figure].name),
                  best.evaluations, s.plan.drives > 1 ? fmt::format(" of {} drives", s.plan.drives) : "");
  for (std::size_t k = 0; k < best.point.size(); ++k) {
    const analysis::Axis& axis = s.plan.axes[k];
    text += fmt::format("  {:<{}}  {:>12}  in {} .. {}\n", axis.key, width,
                        quantity_text(best.values[k], s.columns.keys[k].unit),
                        quantity_text(axis.from, s.columns.keys[k].unit),
                        quantity_text(axis.to, s.columns.keys[k].unit));
  }
  for (std::size_t n = 0; n < s.columns.figures.size(); ++n) {
    const analysis::FigureColumn& f = s.columns.figures[n];
    const std::string asked = n == s.figure && bounds(f).empty() ? "least" : bounds(f);
    text += fmt::format("  {:<{}}  {:>12}  {}", visible(f.name), width,
                        quantity_text(best.figures[n], f.unit), asked);
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  text += limits(s, best);
  if (!best.converged)
    text +=
        fmt::format("  not converged after {} points: raise evaluations in the plan to find a better point\n",
                    best.evaluations);
  text += " ";
  for (std::size_t k = 0; k < best.point.size(); ++k)
    text += fmt::format(" --set {}={}", s.plan.axes[k].key, best.point[k]);
  return text + "\n";
}

std::string optimum_json(const OptimumStory& s, const analysis::Optimum& best) {
  Json json = {{"sixstep", SIXSTEP_VERSION},
               {"plan", s.name},
               {"minimise", s.columns.figures[s.figure].name},
               {"holds", best.holds},
               {"converged", best.converged},
               {"evaluations", best.evaluations},
               {"drives", std::max<std::size_t>(s.plan.drives, 1)}};
  for (std::size_t k = 0; k < best.point.size(); ++k)
    json["point"].push_back({{"key", s.plan.axes[k].key},
                             {"value", best.values[k]},
                             {"unit", s.columns.keys[k].unit},
                             {"from", s.plan.axes[k].from},
                             {"to", s.plan.axes[k].to}});
  for (std::size_t n = 0; n < s.columns.figures.size(); ++n) {
    const analysis::FigureColumn& f = s.columns.figures[n];
    json["figures"].push_back({{"figure", f.name},
                               {"unit", f.unit},
                               {"worst", figure_json(best.figures[n])},
                               {"min", or_null(f.min)},
                               {"max", or_null(f.max)}});
  }
  json["limits"] = Json::array();
  for (const analysis::Limit& limit : best.limits)
    json["limits"].push_back(
        {{limit.of_key ? "key" : "figure", limit.what}, {"end", limit.upper ? "upper" : "lower"}});
  return json_text(json) + "\n";
}

}  // namespace text
