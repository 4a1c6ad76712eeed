// SPDX-License-Identifier: Apache-2.0
// Observers that write rows: on a grid, or at every event with both sides of each jump. They read the dense
// output and cannot change the run by a bit.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "sixstep/study/columns.hpp"

namespace sixstep::study {

using RowSink = std::function<void(std::span<const double>)>;

/// Rows at n * grid up to the end of the run, included where it lies on the grid: right limits at a jump.
class GridRecorder {
 public:
  GridRecorder(std::int64_t grid_ticks, sim::Instant end, control::Mode mode,
               std::vector<std::size_t> columns, RowSink sink)
      : grid_(grid_ticks),
        end_(end),
        mode_(mode),
        columns_(std::move(columns)),
        sink_(std::move(sink)),
        row_(columns_.size()) {}

  template <class Rig>
  void segment(const Rig& rig, double s) {
    const double length = rig.plant().expansion().h * s;
    const sim::Instant from = rig.now(), to = from.plus_seconds(length);
    for (;;) {
      const double ahead = sim::seconds_between(from, next_);
      const bool last = next_ == end_ && sim::seconds_between(to, end_) <= 0.5e-12;
      if (!(next_ < to) && !last) return;
      const double at = length > 0 ? ahead / rig.plant().expansion().h : 0.0;
      emit(full_row(rig, at < s ? (at > 0 ? at : 0.0) : s, next_.seconds(), mode_));
      next_.ticks += grid_;
    }
  }

 private:
  void emit(const FullRow& full) {
    for (std::size_t c = 0; c < columns_.size(); ++c) row_[c] = full[columns_[c]];
    sink_(row_);
  }

  std::int64_t grid_;
  sim::Instant end_, next_{};
  control::Mode mode_;
  std::vector<std::size_t> columns_;
  RowSink sink_;
  std::vector<double> row_;
};

/// Both ends of every segment, and points between where a segment is long against `gap_s`, so that lines
/// drawn from row to row show the curve. A row equal to the one before is left out.
class EventRecorder {
 public:
  EventRecorder(double gap_s, control::Mode mode, std::vector<std::size_t> columns, RowSink sink)
      : gap_s_(gap_s),
        mode_(mode),
        columns_(std::move(columns)),
        sink_(std::move(sink)),
        row_(columns_.size()) {}

  template <class Rig>
  void segment(const Rig& rig, double s) {
    const double h = rig.plant().expansion().h;
    const int parts = 1 + static_cast<int>(std::fmin(h * s / gap_s_, 1000.0));
    for (int n = 0; n <= parts; ++n) {
      const double at = s * n / parts;
      last_s_ =
          std::fmax(last_s_, rig.now().plus_seconds(at * h).seconds());  // rounding may not turn time back
      emit(full_row(rig, at, last_s_, mode_));
    }
  }

 private:
  void emit(const FullRow& full) {
    bool differs = false;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const double v = full[columns_[c]];
      differs = differs || (v != row_[c] && v == v);
      row_[c] = v;
    }
    if (differs || first_) sink_(row_);
    first_ = false;
  }

  double gap_s_, last_s_ = 0.0;
  control::Mode mode_;
  std::vector<std::size_t> columns_;
  RowSink sink_;
  std::vector<double> row_;
  bool first_ = true;
};

}  // namespace sixstep::study
