// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/end_watch.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::study {

namespace {

/// Mean loss between two marks at the sheet's temperature, W.
double cold_W(const EndWatch::Mark& a, const EndWatch::Mark& b) {
  return (b.cold_J - a.cold_J) / (b.t_s - a.t_s);
}

}  // namespace

void EndWatch::look(const Mark& now) {
  while (filled_ <= parts && now.t_s >= duration_s_ * filled_ / parts)
    marks_[static_cast<std::size_t>(filled_++)] = now;
  last_ = now;
}

/// Looks may be further apart than parts, and the last one is where the run ends.
bool EndWatch::is_whole(const Mark& begin, const Mark& end) const {
  return end.t_s - begin.t_s > duration_s_ / (2 * parts);
}

bool EndWatch::steady_from(int part) const {
  const double mean_W = cold_W(at(part), last_);
  for (int n = part; n < parts; ++n) {
    const Mark& end = n + 1 < filled_ ? at(n + 1) : last_;
    if (is_whole(at(n), end) && !(std::fabs(cold_W(at(n), end) - mean_W) <= 0.1 * mean_W)) return false;
  }
  return true;
}

std::optional<double> EndWatch::acceleration() const {
  double least = 0.0, most = 0.0;
  int intervals = 0;
  for (int n = 3 * parts / 5; n < parts; ++n) {
    const Mark& end = n + 1 < filled_ ? at(n + 1) : last_;
    if (!is_whole(at(n), end)) continue;
    const double rad_s2 = (end.speed_rad_s - at(n).speed_rad_s) / (end.t_s - at(n).t_s);
    least = intervals == 0 ? rad_s2 : std::min(least, rad_s2);
    most = intervals == 0 ? rad_s2 : std::max(most, rad_s2);
    ++intervals;
  }
  const bool even = least * most > 0.0 && std::fabs(least) <= 2 * std::fabs(most) &&
                    std::fabs(most) <= 2 * std::fabs(least);
  return intervals >= 2 && even ? std::optional((least + most) / 2) : std::nullopt;
}

std::optional<EndWatch::Kept> EndWatch::kept() const {
  // The marks of the last parts are the end itself if looks are further apart than they.
  const auto is_before_end = [this](int part) { return at(part).t_s < last_.t_s; };
  if (duration_s_ < least_s || filled_ < parts || !is_before_end(parts / 2)) return {};
  int from = 1;
  while (from <= 4 * parts / 5 && is_before_end(from) && !steady_from(from)) ++from;
  const bool steady = from <= 4 * parts / 5 && is_before_end(from);
  if (!steady) {
    from = parts / 2;
    for (const int part : {4 * parts / 5, 9 * parts / 10})
      if (is_before_end(part) && cold_W(at(part), last_) < cold_W(at(from), last_)) from = part;
  }
  const Mark& begin = at(from);
  return Kept{.copper_W = (last_.copper_J - begin.copper_J) / (last_.t_s - begin.t_s),
              .cold_W = cold_W(begin, last_),
              .since_s = begin.t_s,
              .speed_rad_s = last_.speed_rad_s,
              .steady = steady,
              .rad_s2 = acceleration()};
}

}  // namespace sixstep::study
