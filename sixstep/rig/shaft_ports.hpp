// SPDX-License-Identifier: Apache-2.0
// What a board's peripherals make of an encoder or a resolver on the shaft (model.md 10), until the next sample asks:
//
//   incremental   the timer counts the quarters of lines by itself, captures the time of the last one, and latches its count
//                 where the index passes; edges that it misses are not counted
//   absolute      the code is latched some time before it is read; a track may stick
//   resolver      both windings through converters, at the peaks of the excitation; or a chip that follows them
#pragma once
#include <cmath>

#include "sixstep/rig/adc.hpp"
#include "sixstep/rig/capture_clock.hpp"
#include "sixstep/rig/tracking_converter.hpp"

namespace sixstep::rig {

class ShaftPorts {
 public:
  ShaftPorts(const ShaftGiven& given, double capture_Hz, std::uint64_t seed,
             const plant::ShaftAngle<double>& at);

  const ShaftGiven& given() const { return given_; }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    if (given_.kind == ShaftSensor::encoder) count(motion);
    if (given_.kind == ShaftSensor::absolute) latch(motion);
    if (given_.kind != ShaftSensor::resolver) return;
    if (given_.reading == ResolverReading::tracking) converter_.follow(motion, broken_winding_);
    if (given_.on_load) stands_ = as_double(motion.angle(motion.s));
  }

  /// Quarters of lines as the timer counted them, over all turns.
  std::int64_t quarters() const { return counted_; }
  /// Of the last quarter counted: the counter's reading, and which way.
  std::uint32_t edge_time() const { return edge_time_; }
  int edge_direction() const { return edge_direction_; }
  /// Whether the index was passed since the last call.
  bool index_passed() {
    const bool passed = index_;
    index_ = false;
    return passed;
  }
  /// Counts since the last index: those by which the rotor is behind the start of its turn.
  std::int64_t since_index() const { return counted_ - at_index_; }
  std::uint32_t code() const { return (code_ | stuck_high_) & ~stuck_low_; }
  /// Of both windings, at a peak; `at` is where the rotor stands.
  control::ResolverCounts resolver_counts(const plant::ShaftAngle<double>& at, const sim::Instant& t,
                                          std::uint64_t number);
  const TrackingConverter& converter() const { return converter_; }

  /// The next so many edges are not counted.
  void miss(std::int64_t edges) { missing_ += edges; }
  /// A track of the Gray code shows one level from now on, bit 0 the finest.
  void stick_track(int bit, bool high) { (high ? stuck_high_ : stuck_low_) |= std::uint32_t{1} << bit; }
  /// 1: the cosine's winding gives nothing from now on; 2: the sine's.
  void break_winding(int which) { broken_winding_ = which; }

 private:
  std::int64_t parts() const { return 4 * given_.lines; }
  template <class Real>
  static plant::ShaftAngle<double> as_double(const plant::ShaftAngle<Real>& at) {
    return {at.sector, static_cast<double>(at.x), at.pole_pairs};
  }
  template <class Real>
  void count(const ShaftMotion<Real>& m);
  template <class Real>
  void count_one_way(const ShaftMotion<Real>& m, Real from, Real to);
  void look_for_index(std::int64_t end, std::int64_t not_missed);
  template <class Real>
  void latch(const ShaftMotion<Real>& m);

  ShaftGiven given_;
  CaptureClock capture_{1e6};
  AdcPath adc_{};
  TrackingConverter converter_{};
  plant::ShaftAngle<double> stands_{};  ///< the load's shaft at the end of the last segment
  std::uint64_t seed_ = 0;
  std::int64_t quarters_ = 0;  ///< the shaft's own
  std::int64_t counted_ = 0, at_index_ = 0, missing_ = 0, excited_ticks_ = 0;
  std::uint32_t edge_time_ = 0, code_ = 0, stuck_high_ = 0, stuck_low_ = 0;
  int edge_direction_ = 0, broken_winding_ = 0;
  bool index_ = false, excited_ = false;
};

/// The converter's range leaves a quarter of room above the windings' amplitude.
inline ShaftPorts::ShaftPorts(const ShaftGiven& given, double capture_Hz, std::uint64_t seed,
                              const plant::ShaftAngle<double>& at)
    : given_(given), capture_(capture_Hz), stands_(at), seed_(seed) {
  if (given.kind == ShaftSensor::encoder) counted_ = quarters_ = plant::parts_of_turn(at, parts());
  if (given.kind == ShaftSensor::absolute) code_ = plant::gray_code(at, given.bits);
  if (given.kind != ShaftSensor::resolver) return;
  adc_ = {.bits = 12, .range = 1.25 * given.resolver.amplitude_V, .noise = given.noise_V};
  if (given.reading == ResolverReading::tracking) converter_ = TrackingConverter(given, seed, at);
}

/// Within a segment the shaft may turn round once: then each way by itself.
template <class Real>
void ShaftPorts::count(const ShaftMotion<Real>& m) {
  const Real start = m.speed(Real(0)), end = m.speed(m.s);
  if (!((start > 0 && end < 0) || (start < 0 && end > 0))) return count_one_way(m, Real(0), m.s);
  Real low = 0, high = m.s;
  for (int n = 0; n < 60; ++n) {
    const Real middle = (low + high) / 2;
    ((m.speed(middle) > 0) == (start > 0) ? low : high) = middle;
  }
  count_one_way(m, Real(0), high);
  count_one_way(m, high, m.s);
}

template <class Real>
void ShaftPorts::count_one_way(const ShaftMotion<Real>& m, Real from, Real to) {
  const std::int64_t end = plant::parts_of_turn(m.angle(to), parts());
  if (end == quarters_) return;
  const int direction = end > quarters_ ? 1 : -1;
  const std::int64_t passed = direction * (end - quarters_);
  // Of the edges passed the first ones are missed.
  const std::int64_t missed = missing_ < passed ? missing_ : passed, not_missed = passed - missed;
  missing_ -= missed;
  counted_ += direction * not_missed;
  look_for_index(end, not_missed);
  quarters_ = end;
  if (not_missed == 0) return;
  // The last border: where the count of the end begins to stand.
  Real low = from, high = to;
  for (int n = 0; n < 60; ++n) {
    const Real middle = (low + high) / 2;
    (plant::parts_of_turn(m.angle(middle), parts()) == end ? high : low) = middle;
  }
  edge_time_ = capture_.counts(m.from.plus_seconds(static_cast<double>(high * m.y.h)));
  edge_direction_ = direction;
}

/// The index stands where a turn begins, a border of turns between both counts. What was counted behind it is taken off: so
/// the timer latches its count there, that of the border's upper side.
inline void ShaftPorts::look_for_index(std::int64_t end, std::int64_t not_missed) {
  const auto turn_of = [&](std::int64_t n) { return n >= 0 ? n / parts() : -((-n + parts() - 1) / parts()); };
  const std::int64_t last = turn_of(end), first = turn_of(quarters_);
  if (last == first) return;
  index_ = true;
  const bool forward = end > quarters_;
  const std::int64_t behind = forward ? end - last * parts() : (last + 1) * parts() - 1 - end;
  const std::int64_t counted_behind = behind < not_missed ? behind : not_missed;
  at_index_ = forward ? counted_ - counted_behind : counted_ + counted_behind + 1;
}

template <class Real>
void ShaftPorts::latch(const ShaftMotion<Real>& m) {
  const sim::Instant at = m.next_sample.plus_seconds(-given_.latency_s);
  if (at < m.from || m.to < at) return;
  code_ = plant::gray_code(m.angle(m.part(at)), given_.bits);
}

/// The chip begins its excitation so that samples fall on peaks.
inline control::ResolverCounts ShaftPorts::resolver_counts(const plant::ShaftAngle<double>& at,
                                                           const sim::Instant& t, std::uint64_t number) {
  if (!excited_) {
    excited_ = true;
    excited_ticks_ = t.ticks - sim::to_instant(0.25 / given_.resolver.excitation_Hz).ticks;
  }
  std::array<double, 2> V =
      plant::resolver_V(given_.resolver, given_.on_load ? stands_ : at, t.ticks - excited_ticks_);
  if (broken_winding_ > 0) V[static_cast<std::size_t>(broken_winding_ - 1)] = 0;
  constexpr std::uint64_t stream = std::uint64_t{0x5e501} << 24;
  return {converted(adc_, V[0], {seed_, stream, number}), converted(adc_, V[1], {seed_, stream + 1, number})};
}

}  // namespace sixstep::rig
