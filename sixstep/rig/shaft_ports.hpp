// SPDX-License-Identifier: Apache-2.0
// Peripherals of the board for an encoder or a resolver on the shaft (model.md 10), simulated between two
// samples:
//
//   incremental   The timer counts the quarters of lines, captures the time of the last edge, and latches its
//                 count at the index. It does not count edges that it misses. The timer reads only the pins:
//                 if A or B is stuck, each edge of the intact line reverses the step of the previous edge.
//   absolute      The code is latched a latency before it is read; a track may be stuck.
//   resolver      Both windings are connected to converters, which sample at the peaks of the excitation, or
//                 to a tracking converter.
#pragma once
#include <cmath>

#include "sixstep/control/sensing/quadrature.hpp"
#include "sixstep/rig/adc.hpp"
#include "sixstep/rig/capture_clock.hpp"
#include "sixstep/rig/tracking_converter.hpp"

namespace sixstep::rig {

/// Converter of each winding. The range is 1.25 times the winding's amplitude.
inline AdcPath resolver_adc(const ShaftSensorConfig& given) {
  return {.bits = 12, .range = 1.25 * given.resolver.amplitude_V, .noise = given.resolver.noise_V};
}

class ShaftPorts {
 public:
  ShaftPorts(const ShaftSensorConfig& given, double capture_Hz, std::uint64_t seed,
             const plant::ShaftAngle<double>& at);

  const ShaftSensorConfig& given() const { return given_; }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    if (given_.kind == ShaftSensor::encoder) count(motion);
    if (given_.kind == ShaftSensor::absolute) latch(motion);
    if (given_.kind != ShaftSensor::resolver) return;
    if (given_.resolver.reading == ResolverReading::tracking) converter_.follow(motion, windings_);
    if (given_.on_load) stands_ = as_double(motion.angle(motion.s));
  }

  /// Quarters of lines that the timer has counted, over all turns.
  std::int64_t quarters() const { return counted_; }
  /// Count of the capture timer at the last counted edge; edge_direction() is the direction of this edge.
  std::uint32_t edge_time() const { return edge_time_; }
  int edge_direction() const { return edge_direction_; }
  /// True if the shaft has passed the index since the last call.
  bool index_passed() {
    const bool passed = index_;
    index_ = false;
    return passed;
  }
  /// Counts since the last index, which is the start of a turn.
  std::int64_t since_index() const { return counted_ - at_index_; }
  std::uint32_t code() const { return shown(code_); }
  /// Counts of both windings at a peak of the excitation, for a rotor at the angle `at`.
  control::ResolverCounts resolver_counts(const plant::ShaftAngle<double>& at, const sim::Instant& t,
                                          std::uint64_t number);
  const TrackingConverter& converter() const { return converter_; }

  /// Levels of the pins in a quarter of a line, as bits like in plant::encoder_lines.
  std::uint8_t pins_in(std::int64_t quarter) const {
    const unsigned elsewhere =
        given_.linear && (quarter < 0 || quarter > 3) ? 1 : 0;  // a linear scale has only one index, at 0
    const unsigned shown = plant::encoder_lines_in(quarter, given_.encoder.lines) & ~elsewhere;
    return static_cast<std::uint8_t>((shown | lines_high_) & ~unsigned{lines_low_});
  }
  /// Levels of the pins for the shaft at the end of the last segment.
  std::uint8_t pins() const { return pins_in(quarters_); }
  /// Quarter of a line that the encoder shows for a shaft's angle.
  template <class Real>
  std::int64_t quarter_at(const plant::ShaftAngle<Real>& at) const {
    return encoder_quarter(given_, at);
  }
  /// Gray code of a shaft's angle, with stuck tracks.
  std::uint32_t code_at(const plant::ShaftAngle<double>& at) const {
    return shown(absolute_code(given_, at));
  }
  /// Voltages of cosine and sine winding, V, without noise. A drive that samples the windings starts the
  /// excitation at its first sample. A tracking converter excites the windings from t = 0 on.
  std::array<double, 2> windings_V(const plant::ShaftAngle<double>& at, const sim::Instant& t) const {
    if (!excited_ && given_.resolver.reading == ResolverReading::sampled) return {};
    return windings_.leave(
        plant::resolver_V(resolver_, mounted(given_.offset_deg, at), t.ticks - excited_ticks_), {});
  }

  /// The next `edges` edges are not counted.
  void miss(std::int64_t edges) { missing_ += edges; }
  /// A track of the Gray code is stuck at one level from now on; bit 0 is the finest track.
  void stick_track(int bit, bool high) { (high ? stuck_high_ : stuck_low_) |= std::uint32_t{1} << bit; }
  /// A track of the Gray code works again.
  void free_track(int bit) {
    stuck_high_ &= ~(std::uint32_t{1} << bit);
    stuck_low_ &= ~(std::uint32_t{1} << bit);
  }
  /// Line 1 to 3 (A, B, Z) is stuck at one level from now on. A change to this level is an edge.
  void stick_line(int line, bool high, const sim::Instant& now) {
    const std::uint8_t bit = static_cast<std::uint8_t>(8 >> line);
    set_lines(static_cast<std::uint8_t>(high ? lines_high_ | bit : lines_high_ & ~bit),
              static_cast<std::uint8_t>(high ? lines_low_ & ~bit : lines_low_ | bit), now);
  }
  /// A line works again.
  void free_line(int line, const sim::Instant& now) {
    const std::uint8_t rest = static_cast<std::uint8_t>(~(8 >> line));
    set_lines(lines_high_ & rest, lines_low_ & rest, now);
  }
  /// Simulates a pulse on an intact Z line that only the timer detects. The pulse has no effect while Z is
  /// high.
  void pulse_index() {
    if ((pins_in(quarters_) & 1) == 0 && (lines_low_ & 1) == 0) latch_index(counted_);
  }
  /// 1: the cosine winding has no signal from now on; 2: the sine winding; 0: both are intact.
  void break_winding(int which) {
    windings_.broken = static_cast<std::uint8_t>(which == 0 ? 0 : windings_.broken | which);
  }
  /// Sets the amplitude of the excitation, relative to the intact excitation.
  void excite(double part) { windings_.excitation = part; }

 private:
  std::int64_t parts() const { return given_.quarters(); }
  std::uint32_t shown(std::uint32_t code) const { return (code | stuck_high_) & ~stuck_low_; }
  bool stands_index(std::int64_t border) const { return given_.linear ? border == 0 : border % parts() == 0; }
  template <class Real>
  static plant::ShaftAngle<double> as_double(const plant::ShaftAngle<Real>& at) {
    return {at.sector, static_cast<double>(at.x), at.pole_pairs};
  }
  template <class Real>
  void count(const ShaftMotion<Real>& m);
  template <class Real>
  void count_one_way(const ShaftMotion<Real>& m, Real from, Real to);
  template <class Real>
  void count_by_pins(const ShaftMotion<Real>& m, Real from, Real to, std::int64_t end);
  template <class Real>
  void capture(const ShaftMotion<Real>& m, Real low, Real high, std::int64_t count, int way);
  void look_for_index(std::int64_t end, std::int64_t not_missed);
  void latch_index(std::int64_t at) {
    index_ = true;
    at_index_ = at;
  }
  bool counts_edge(std::uint8_t before, std::uint8_t after);
  void set_lines(std::uint8_t high, std::uint8_t low, const sim::Instant& now);
  template <class Real>
  void latch(const ShaftMotion<Real>& m);

  ShaftSensorConfig given_;
  plant::Resolver resolver_{};
  CaptureClock capture_{1e6};
  AdcPath adc_{};
  TrackingConverter converter_{};
  plant::ShaftAngle<double> stands_{};  ///< angle of the load's shaft at the end of the last segment, if the
                                        ///< sensor is on this shaft
  std::uint64_t seed_ = 0;
  std::int64_t quarters_ = 0;  ///< true count of the shaft
  std::int64_t counted_ = 0, at_index_ = 0, missing_ = 0, excited_ticks_ = 0;
  std::uint32_t edge_time_ = 0, code_ = 0, stuck_high_ = 0, stuck_low_ = 0;
  int edge_direction_ = 0;
  std::uint8_t lines_high_ = 0, lines_low_ = 0;  ///< stuck lines of an incremental encoder
  plant::ResolverFaults windings_{};
  bool index_ = false, excited_ = false;
};

inline ShaftPorts::ShaftPorts(const ShaftSensorConfig& given, double capture_Hz, std::uint64_t seed,
                              const plant::ShaftAngle<double>& at)
    : given_(given), capture_(capture_Hz), stands_(at), seed_(seed) {
  if (given.kind == ShaftSensor::encoder) counted_ = quarters_ = quarter_at(at);
  if (given.kind == ShaftSensor::absolute) code_ = absolute_code(given, at);
  if (given.kind != ShaftSensor::resolver) return;
  adc_ = resolver_adc(given);
  resolver_ = windings_of(given.resolver);
  if (given.resolver.reading == ResolverReading::tracking) converter_ = TrackingConverter(given, seed, at);
}

/// Counts the quarters that the shaft passes in a segment. If the shaft reverses, which it can do once, each
/// direction is counted separately.
template <class Real>
void ShaftPorts::count(const ShaftMotion<Real>& m) {
  const Real turns = turning_part(m);
  if (turns > 0) count_one_way(m, Real(0), turns);
  count_one_way(m, turns, m.s);
}

template <class Real>
void ShaftPorts::count_one_way(const ShaftMotion<Real>& m, Real from, Real to) {
  const std::int64_t end = quarter_at(m.angle(to));
  if (end == quarters_) return;
  if (((lines_high_ | lines_low_) & 6) != 0) return count_by_pins(m, from, to, end);
  const int direction = end > quarters_ ? 1 : -1;
  const std::int64_t passed = direction * (end - quarters_);
  // The missed edges are the first edges that the shaft passes in this segment.
  const std::int64_t missed = missing_ < passed ? missing_ : passed, not_missed = passed - missed;
  missing_ -= missed;
  counted_ += direction * not_missed;
  look_for_index(end, not_missed);
  quarters_ = end;
  if (not_missed == 0) return;
  edge_direction_ = direction;
  capture(m, from, to, end, direction);  // captures the last passed border, at which the present quarter
                                         // begins
}

template <class Real>
void ShaftPorts::capture(const ShaftMotion<Real>& m, Real low, Real high, std::int64_t count, int way) {
  const auto quarter = [this](const plant::ShaftAngle<Real>& shaft) { return quarter_at(shaft); };
  const Real at = part_of_count(m, quarter, low, high, count, way);
  edge_time_ = capture_.counts(m.from.plus_seconds(static_cast<double>(at * m.y.h)));
}

/// The timer's counting rule: the changed line and the level of the other line determine the direction.
/// Returns true if the count has changed.
inline bool ShaftPorts::counts_edge(std::uint8_t before, std::uint8_t after) {
  const auto quarter = [](std::uint8_t pins) {
    return static_cast<int>(control::quarter_of_line((pins & 4) != 0, (pins & 2) != 0));
  };
  const int ahead = (quarter(after) - quarter(before) + 4) % 4;
  if (ahead == 0) return false;
  if (missing_ > 0) return --missing_, false;
  edge_direction_ = ahead == 1 ? 1 : -1;
  counted_ += edge_direction_;
  return true;
}

/// Counts each edge from the levels of the pins, for the case that lines are stuck.
template <class Real>
void ShaftPorts::count_by_pins(const ShaftMotion<Real>& m, Real from, Real to, std::int64_t end) {
  const int way = end > quarters_ ? 1 : -1;
  const std::int64_t begin = quarters_;
  std::int64_t last = begin;
  while (quarters_ != end) {
    const std::uint8_t before = pins_in(quarters_);
    const std::int64_t border = way > 0 ? quarters_ + 1 : quarters_;
    quarters_ += way;
    if (counts_edge(before, pins_in(quarters_))) last = quarters_;
    if (stands_index(border) && ((lines_high_ | lines_low_) & 1) == 0)
      latch_index(way > 0 ? counted_ : counted_ + 1);
  }
  if (last != begin) capture(m, from, to, last, way);
}

/// Sets which lines are stuck. A pin whose level changes is an edge for the timer; a rising Z is an index.
inline void ShaftPorts::set_lines(std::uint8_t high, std::uint8_t low, const sim::Instant& now) {
  const std::uint8_t before = pins_in(quarters_);
  lines_high_ = high;
  lines_low_ = low;
  const std::uint8_t after = pins_in(quarters_);
  if (counts_edge(before, after)) edge_time_ = capture_.counts(now);
  if ((before & 1) == 0 && (after & 1) != 0) latch_index(counted_);
}

/// Latches the count if the shaft has passed the index, the border between two turns. Counts after the border
/// are subtracted, so that the latched value is the count just above the border.
inline void ShaftPorts::look_for_index(std::int64_t end, std::int64_t not_missed) {
  const auto turn_of = [&](std::int64_t n) { return n >= 0 ? n / parts() : -((-n + parts() - 1) / parts()); };
  const std::int64_t last = turn_of(end), first = turn_of(quarters_);
  if (last == first || ((lines_high_ | lines_low_) & 1) != 0) return;
  const bool forward = end > quarters_;
  if (given_.linear && (last < 0) == (first < 0)) return;
  const std::int64_t behind = forward ? end - last * parts() : (last + 1) * parts() - 1 - end;
  const std::int64_t counted_behind = behind < not_missed ? behind : not_missed;
  latch_index(forward ? counted_ - counted_behind : counted_ + counted_behind + 1);
}

template <class Real>
void ShaftPorts::latch(const ShaftMotion<Real>& m) {
  const sim::Instant at = m.next_sample.plus_seconds(-given_.absolute.latency_s);
  if (at < m.from || m.to < at) return;
  code_ = absolute_code(given_, m.angle(m.part(at)));
}

/// Samples both windings. The phase of the excitation is set at the first sample, so that the samples are at
/// the peaks.
inline control::ResolverCounts ShaftPorts::resolver_counts(const plant::ShaftAngle<double>& at,
                                                           const sim::Instant& t, std::uint64_t number) {
  if (!excited_) {
    excited_ = true;
    excited_ticks_ = t.ticks - sim::to_instant(0.25 / given_.resolver.excitation_Hz).ticks;
  }
  const std::array<double, 2> V = windings_V(given_.on_load ? stands_ : at, t);
  constexpr std::uint64_t stream = std::uint64_t{0x5e501} << 24;
  return {converted(adc_, V[0], {seed_, stream, number}), converted(adc_, V[1], {seed_, stream + 1, number})};
}

}  // namespace sixstep::rig
