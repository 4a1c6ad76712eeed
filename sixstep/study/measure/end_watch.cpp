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

/// Accelerations of a run's parts; even if they have one sign and differ by a factor of two at most.
class Accelerations {
 public:
  void add(const EndWatch::Mark& a, const EndWatch::Mark& b) {
    const double rad_s2 = (b.speed_rad_s - a.speed_rad_s) / (b.t_s - a.t_s);
    least_ = count_ == 0 ? rad_s2 : std::min(least_, rad_s2);
    most_ = count_ == 0 ? rad_s2 : std::max(most_, rad_s2);
    ++count_;
  }
  int count() const { return count_; }
  std::optional<double> even() const {
    const bool is_even = least_ * most_ > 0.0 && std::fabs(least_) <= 2 * std::fabs(most_) &&
                         std::fabs(most_) <= 2 * std::fabs(least_);
    return count_ >= 2 && is_even ? std::optional((least_ + most_) / 2) : std::nullopt;
  }

 private:
  double least_ = 0.0, most_ = 0.0;
  int count_ = 0;
};

}  // namespace

void EndWatch::look(const Mark& now) {
  while (filled_ <= parts && now.t_s >= duration_s_ * filled_ / parts)
    marks_[static_cast<std::size_t>(filled_++)] = now;
  while (fine_filled_ < fine_parts &&
         now.t_s >= duration_s_ * (9 * fine_parts + fine_filled_) / (10 * fine_parts))
    fine_[static_cast<std::size_t>(fine_filled_++)] = now;
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
  Accelerations all;
  for (int n = 3 * parts / 5; n < parts; ++n) {
    const Mark& end = n + 1 < filled_ ? at(n + 1) : last_;
    if (is_whole(at(n), end)) all.add(at(n), end);
  }
  return all.even();
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

std::optional<EndWatch::Kept> EndWatch::steady_since(const Mark& begin, int fine) const {
  if (!(last_.t_s - begin.t_s >= brief_s)) return {};
  const double mean_W = cold_W(begin, last_);
  Accelerations all;
  for (int n = fine; n < fine_parts; ++n) {
    const Mark& from = fine_[static_cast<std::size_t>(n)];
    const Mark& to = n + 1 < fine_parts ? fine_[static_cast<std::size_t>(n) + 1] : last_;
    const bool whole = to.t_s - from.t_s > duration_s_ / (20 * fine_parts);
    if (!whole) continue;
    if (!(std::fabs(cold_W(from, to) - mean_W) <= 0.1 * mean_W)) return {};
    all.add(from, to);
  }
  if (all.count() < 2) return {};
  return Kept{.copper_W = (last_.copper_J - begin.copper_J) / (last_.t_s - begin.t_s),
              .cold_W = mean_W,
              .since_s = begin.t_s,
              .speed_rad_s = last_.speed_rad_s,
              .steady = true,
              .rad_s2 = all.even()};
}

std::optional<EndWatch::Kept> EndWatch::kept_briefly() const {
  if (duration_s_ < least_s || filled_ < parts || fine_filled_ < fine_parts) return {};
  if (const std::optional<Kept> all = kept(); !all || all->steady) return {};
  constexpr int before = 4 * parts / 5 + 1;  // the last part that begins before the fine ones
  if (steady_from(before))
    if (const std::optional<Kept> since = steady_since(at(before), 0)) return since;
  for (int n = 0; n <= fine_parts / 2; ++n)
    if (const std::optional<Kept> since = steady_since(fine_[static_cast<std::size_t>(n)], n)) return since;
  return {};
}

}  // namespace sixstep::study
