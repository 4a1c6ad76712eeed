// SPDX-License-Identifier: Apache-2.0
// Observers that write rows: on a grid, or at every event with both sides of each jump. They only read the
// segments' polynomials, so the run's results stay the same to the bit.
#pragma once
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "sixstep/study/measure/full_row.hpp"

namespace sixstep::study {

using RowSink = std::function<void(std::span<const double>)>;

/// The selected columns of the full row; NaN where a column has no meaning in the present mode.
class Selection {
 public:
  explicit Selection(const std::vector<std::size_t>& columns) : columns_(columns) { choose(); }
  /// Sets the mode of the following rows.
  void follow(control::Mode mode) {
    if (mode == mode_) return;
    mode_ = mode;
    choose();
  }
  /// Returns true if a number differs from the row before.
  bool take(const FullRow& full) {
    bool differs = false;
    double all = 0.0;
    for (const Choice& c : chosen_) {
      const double v = full[c.column];
      differs |= v != row_[c.place];
      row_[c.place] = v;
      all += v - v;
    }
    sound_ = all == 0.0;
    return differs;
  }
  /// True if all numbers of the row are finite. A run-away can produce infinite numbers or NaN before the run
  /// stops.
  bool sound() const { return sound_; }
  std::span<const double> row() const { return row_; }

 private:
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  struct Choice {
    std::size_t place, column;
  };
  void choose() {
    chosen_.clear();
    row_.assign(columns_.size(), nothing);
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      if (!applies(static_cast<ColumnId>(columns_[n]), mode_)) continue;
      chosen_.push_back({n, columns_[n]});
      row_[n] = 0.0;
    }
  }

  std::vector<std::size_t> columns_;
  control::Mode mode_ = control::Mode::off;
  std::vector<Choice> chosen_;
  std::vector<double> row_;
  bool sound_ = true;
};

/// Writes rows at n * grid up to the end of the run; the end itself has a row only if it lies on the grid. At
/// a jump the row has the value after the jump.
class GridRecorder {
 public:
  GridRecorder(std::int64_t grid_ticks, sim::Instant end, const std::vector<std::size_t>& columns,
               RowSink sink)
      : grid_(grid_ticks), end_(end), selection_(columns), sink_(std::move(sink)) {}

  template <class Rig>
  void segment(const Rig& rig, double s) {
    const double length = rig.plant().expansion().h * s;
    const sim::Instant from = rig.now(), to = from.plus_seconds(length);
    for (;;) {
      const bool last = next_ == end_ && sim::seconds_between(to, end_) <= 0.5e-12;
      // A segment's end between two picoseconds is rounded. A row at this rounded instant belongs to the next
      // segment.
      if (!(sim::seconds_between(next_, to) > 0x1p-50 * length) && !last) return;
      const double at = length > 0 ? sim::seconds_between(from, next_) / rig.plant().expansion().h : 0.0;
      selection_.follow(rig.firmware().mode());
      selection_.take(full_row(rig, at < s ? (at > 0 ? at : 0.0) : s, next_.seconds()));
      if (selection_.sound()) sink_(selection_.row());
      next_.ticks += grid_;
    }
  }

 private:
  std::int64_t grid_;
  sim::Instant end_, next_{};
  Selection selection_;
  RowSink sink_;
};

/// Writes both ends of every segment. If a segment is long compared with `gap_s`, it also writes points
/// between, so that lines from row to row show the curve. A row equal to the row before is omitted.
class EventRecorder {
 public:
  EventRecorder(double gap_s, const std::vector<std::size_t>& columns, RowSink sink)
      : gap_s_(gap_s), selection_(columns), sink_(std::move(sink)) {}

  template <class Rig>
  void segment(const Rig& rig, double s) {
    const double h = rig.plant().expansion().h;
    const double gaps = h * s / gap_s_;
    const int parts = 1 + static_cast<int>(gaps < 1000.0 ? gaps : 1000.0);
    selection_.follow(rig.firmware().mode());
    for (int n = 0; n <= parts; ++n) {
      const double at = s * n / parts;
      const double t = rig.now().plus_seconds(at * h).seconds();
      last_s_ = t > last_s_ ? t : last_s_;  // time must not go back by rounding
      const bool differs = selection_.take(full_row(rig, at, last_s_));
      if ((differs || first_) && selection_.sound()) sink_(selection_.row());
      first_ = false;
    }
  }

 private:
  double gap_s_, last_s_ = 0.0;
  Selection selection_;
  RowSink sink_;
  bool first_ = true;
};

}  // namespace sixstep::study
