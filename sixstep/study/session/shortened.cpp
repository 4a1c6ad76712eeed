// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/session/shortened.hpp"

#include <algorithm>
#include <string>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {

namespace {

void shorten(std::vector<double>& times_s, std::vector<double>& values, double end_s) {
  std::size_t kept = 0;
  while (kept < times_s.size() && times_s[kept] < end_s) ++kept;
  times_s.resize(kept);
  values.resize(std::min(values.size(), kept));
}

/// If all steps come after the new end, the value before them remains, as with a ramp that has not begun.
void shorten(Reference& r, double length_s) {
  if (r.shape != Shape::steps) return;
  shorten(r.times_s, r.values, length_s);
  if (!r.times_s.empty()) return;
  r = Reference{.shape = Shape::ramp, .begin_s = 0.0, .end = 0.0, .slope = 1e-3};
  r.begin_s = length_s;
}

/// Removes the figures in which check() finds problems for the shorter run.
template <class Item>
void drop_named(std::vector<Item>& items, const char* list, const base::Problems& problems) {
  for (std::size_t n = items.size(); n-- > 0;) {
    const std::string where = std::string(list) + "[" + std::to_string(n) + "]";
    if (std::any_of(problems.begin(), problems.end(),
                    [&](const base::Problem& p) { return p.where.starts_with(where); }))
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(n));
  }
}

template <class Item>
void cut_windows(std::vector<Item>& items, double end_s) {
  std::erase_if(items, [&](const Item& item) { return item.measure.from_s.value_or(0.0) >= end_s; });
  for (Item& item : items)
    if (item.measure.to_s && *item.measure.to_s > end_s) item.measure.to_s.reset();
}

}  // namespace

Scenario shortened(const Scenario& s, double end_s) {
  Scenario out = s;
  out.duration_s = end_s;
  std::erase_if(out.at, [&](const At& at) { return happens_at_s(s, at) >= end_s || at.time_s >= end_s; });
  shorten(out.load.times_s, out.load.torques_Nm, end_s);
  shorten(out.reference, end_s);
  for (At& at : out.at)
    if (at.reference) shorten(*at.reference, end_s - at.time_s);
  if (out.sensors.hall_break.at_s && *out.sensors.hall_break.at_s >= end_s)
    out.sensors.hall_break.at_s.reset();
  if (out.protection.off_at_s && *out.protection.off_at_s >= end_s) out.protection.off_at_s.reset();
  cut_windows(out.require, end_s);
  cut_windows(out.compare, end_s);
  const base::Problems problems = check(out);
  drop_named(out.require, "require", problems);
  drop_named(out.compare, "compare", problems);
  return out;
}

}  // namespace sixstep::study
