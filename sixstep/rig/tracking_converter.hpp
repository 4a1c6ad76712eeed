// SPDX-License-Identifier: Apache-2.0
// A resolver-to-digital converter: a chip whose type 2 loop follows the windings with a separate clock. Its
// outputs are the angle, with a limited number of bits, and the speed from the loop's integrator (model.md
// 10).
//
//   detected   tan(phi - theta) from both demodulated windings, with the resolver's angle phi and the loop's
//              angle theta; beyond 45 degrees 1 with the sign of the shorter rotation
//   followed   one step of control/sensing/tracking.hpp per clock of the chip
//   output     angle predicted for this clock, not for the next clock: no lag at constant speed;
//              at constant acceleration a the output lags by a T^2/K_i (clock period T, integral gain K_i)
//
// The chip checks the sum of the squares of both signals, and stores the first fault.
//
// The demodulator is ideal: the model has no ripple at twice the excitation frequency, which chips filter. A
// phase shift relative to the excitation cancels if it is the same in both windings.
#pragma once
#include "sixstep/base/random.hpp"
#include "sixstep/control/sensing/resolver.hpp"
#include "sixstep/rig/shaft_motion.hpp"
#include "sixstep/rig/shaft_sensor_config.hpp"

namespace sixstep::rig {

class TrackingConverter {
 public:
  TrackingConverter() = default;
  /// The loop starts in the settled state at the shaft's initial angle.
  TrackingConverter(const ShaftSensorConfig& given, std::uint64_t seed, const plant::ShaftAngle<double>& at)
      : loop_{given.tracking},
        resolver_(windings_of(given.resolver)),
        watch_(given.watch),
        watched_(given.watched),
        noise_(given.resolver.noise_V / given.resolver.amplitude_V),
        latency_s_(given.resolver.latency_s),
        offset_deg_(given.offset_deg),
        seed_(seed),
        period_ticks_(sim::to_instant(1.0 / given.resolver.converter_Hz).ticks),
        bits_(static_cast<std::uint8_t>(given.resolver.bits)) {
    const auto all =
        static_cast<std::uint64_t>(plant::parts_of_turn(mounted(offset_deg_, at), std::int64_t{1} << 32));
    state_.angle = static_cast<control::BinaryAngle>(all * static_cast<std::uint64_t>(resolver_.pole_pairs));
    next_.ticks = period_ticks_;
    read_ = shown_ = state_;
  }

  template <class Real>
  void follow(const ShaftMotion<Real>& m, const plant::ResolverFaults& faults) {
    const sim::Instant latch = m.next_sample.plus_seconds(-latency_s_);
    bool latches = !(latch < m.from) && !(m.to < latch);
    while (!(m.to < next_)) {
      if (latches && latch < next_) {
        read_ = shown_;
        latches = false;
      }
      step(m.angle(m.part(next_)), faults);
      next_.ticks += period_ticks_;
    }
    if (latches) read_ = shown_;
  }

  /// Angle within the resolver's turn, from the last reading.
  control::BinaryAngle angle() const { return control::quantised(read_.angle, bits_); }
  const ShaftFinding& found() const { return found_; }
  /// Speed in units of 2^-32 turn of the resolver per clock of the chip.
  std::int32_t speed() const { return control::tracking_speed(read_); }

 private:
  template <class Real>
  void step(const plant::ShaftAngle<Real>& at, const plant::ResolverFaults& faults) {
    const plant::ShaftAngle<double> shaft =
        mounted(offset_deg_, plant::ShaftAngle<double>{at.sector, static_cast<double>(at.x), at.pole_pairs});
    std::array<double, 2> noise{};
    if (noise_ > 0) {
      constexpr std::uint64_t stream = std::uint64_t{0x5e502} << 24;
      noise[0] = noise_ * base::normal({seed_, stream, clock_});
      noise[1] = noise_ * base::normal({seed_, stream + 1, clock_});
    }
    ++clock_;
    const std::array<double, 2> x = faults.leave(plant::resolver_envelope(resolver_, shaft), noise);
    if (watched_ && !found_.lost()) look(x[0], x[1]);
    const control::ResolverSignals<double> signals{x[0], x[1]};
    const control::BinaryAngle foretold = state_.angle;
    control::tracking_step(loop_, state_, control::resolver_error(signals, foretold, true));
    shown_ = state_;
    shown_.angle = foretold;
  }

  void look(double c, double s) {
    outside_ = watch_.outside(c * c + s * s) ? outside_ + 1 : 0;
    if (outside_ >= watch_.in_a_row) found_ = watch_.finding(c, s);
  }

  control::TrackingConfig loop_{};
  control::TrackingState state_{};
  control::TrackingState shown_{};  ///< content of the chip's output register since its last clock
  control::TrackingState read_{};
  plant::Resolver resolver_{};
  ResolverWatch watch_{};
  ShaftFinding found_{};
  int outside_ = 0;
  bool watched_ = false;
  sim::Instant next_{};
  double noise_ = 0.0, latency_s_ = 0.0, offset_deg_ = 0.0;
  std::uint64_t seed_ = 0, clock_ = 0;
  std::int64_t period_ticks_ = 1;
  std::uint8_t bits_ = 16;
};

}  // namespace sixstep::rig
