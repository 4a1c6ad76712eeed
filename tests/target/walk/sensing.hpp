// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks around the loops: sensors, monitoring, limits.
#pragma once
#include "sixstep/control/adc.hpp"
#include "sixstep/control/advance.hpp"
#include "sixstep/control/faults.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/control/limits.hpp"
#include "sixstep/control/one_shunt.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

template <class Scalar>
Measurement<Scalar> drawn_measurement(Random& r) {
  Measurement<Scalar> m{};
  m.i_a_A = signal<Scalar>(r);
  m.i_b_A = signal<Scalar>(r);
  m.i_c_A = signal<Scalar>(r);
  m.speed_rad_s = signal<Scalar>(r);
  m.position_deg = signal<Scalar>(r);
  m.bus_V = r.one_in(8) ? signal<Scalar>(r) : positive<Scalar>(r);
  m.hall = hall_of_sector(r.below(6));
  return m;
}

template <class Scalar>
struct AdcWalk {
  AdcConfig<Scalar> config{};
  AdcState state{};

  void draw(Random& r) {
    config = {gain<Scalar>(r, -4), static_cast<std::uint16_t>(2000 + r.below(100)),
              static_cast<std::uint16_t>(4 + r.below(60)), r.below(5)};
    if (r.one_in(2)) state = {};
  }
  void step(Random& r, Digest& mix) {
    const auto counts = static_cast<std::uint16_t>(2016 + (r.bits() & 63));
    const auto sampled = static_cast<std::uint16_t>(r.bits() & 4095);
    const Calibration result =
        counted<1>("adc_calibrate", [&] { return adc_calibrate(config, state, counts); });
    mix(counted<0>("adc_value", [&] { return adc_value(config, state, sampled); }), state.offset_eighths,
        static_cast<std::uint8_t>(result));
    saw("calibrated", result == Calibration::done);
    saw("failed to calibrate", result == Calibration::failed);
  }
};

template <class Scalar>
struct OneShuntWalk {
  OneShuntConfig<Scalar> config{};
  OneShuntState<Scalar> state{};

  void draw(Random& r) { config = {positive<Scalar>(r, 16000), r.below(6), positive<Scalar>(r)}; }
  void step(Random& r, Digest& mix) {
    if (r.one_in(6)) counted<1>("one_shunt_commutation", [&] { one_shunt_commutation(config, state); });
    const std::uint8_t was = state.commutating;
    const Scalar duty = positive<Scalar>(r), sample = signal<Scalar>(r);
    const bool reversed = r.one_in(8);
    const Scalar i =
        counted<0>("one_shunt_step", [&] { return one_shunt_step(config, state, reversed, duty, sample); });
    Measurement<Scalar> m{};
    set_phase_currents(m, positive_pair(r.below(6)), i);
    mix(i, m.i_a_A, m.i_b_A, m.i_c_A, state.kept_A, state.hidden);
    saw("corrected for a commutation", state.commutating < was && state.commutating > 0);
    saw("hidden", state.hidden > 1);
  }
};

template <class Scalar>
struct HallSpeedWalk {
  HallSpeedConfig<Scalar> config{};
  HallSpeedState state{};
  HallPositionConfig<Scalar> position_config{};
  HallPositionState position{};
  std::uint32_t now = 0;
  std::uint16_t pace = 100;
  std::int8_t direction = 1;
  std::uint8_t since = 0;

  void draw(Random& r) {
    config = {Number<Scalar>::ratio(r.bits()), std::uint32_t{20000}, static_cast<std::uint8_t>(r.below(8)),
              r.one_in(2) ? std::uint32_t{0} : std::uint32_t{600} + (r.bits() & 4095),
              static_cast<std::uint32_t>(1 + r.below(100))};
    position_config = {gain<Scalar>(r, -9), gain<Scalar>(r, 1)};
    pace = static_cast<std::uint16_t>(20 + (r.bits() & 2047));
    if (r.one_in(2)) direction = static_cast<std::int8_t>(-direction);
    if (r.one_in(8)) now += 30000;  // standstill
    if (r.one_in(8)) now += 0x40000000u;
    if (r.one_in(2)) position.sectors = 0;
  }
  void step(Random& r, Digest& mix) {
    now += (static_cast<std::uint32_t>(pace) + r.bits() % (pace / 16 + 1u)) / 4;
    // Mostly, an edge occurs every four or five steps. Sometimes it is missed or too early.
    if (since >= 8 || (++since >= 4 && since < 6 && !r.one_in(6)) || r.one_in(96)) {
      since = 0;
      const SectorTime time = counted<1>("sector_time+hall_speed_edge+hall_position_edge", [&] {
        const SectorTime result = sector_time(state, config.grain_ticks, now);
        hall_speed_edge(state, now, direction);
        hall_position_edge(position, direction);
        return result;
      });
      mix(static_cast<std::uint8_t>(time));
      saw("soon", time == SectorTime::soon);
      saw("within", time == SectorTime::within);
      saw("twice", time == SectorTime::twice);
    }
    const Scalar w = counted<0>("hall_speed", [&] { return hall_speed(config, state, now); });
    Scalar fraction{};
    const Scalar angle = counted<2>("sector_fraction+hall_position", [&] {
      fraction = sector_fraction(config, state, now);
      return hall_position(position_config, position, state.direction, fraction);
    });
    mix(w, fraction, angle, state.known);
    saw("turns forward", w > Scalar{});
    saw("turns back", w < Scalar{});
    saw("knows nothing", state.known == 0);
    saw("past the sector's end", fraction == one<Scalar>);
  }
};

template <class Scalar>
struct AdvanceWalk {
  AdvanceConfig<Scalar> config{};

  void draw(Random& r) {
    config = {positive<Scalar>(r, 8000), positive_gain<Scalar>(r, -1), positive<Scalar>(r, 16000)};
  }
  void step(Random& r, Digest& mix) {
    const std::uint8_t sector = r.below(7);
    const auto direction = static_cast<std::int8_t>(r.below(3) - 1);
    const Scalar w = signal<Scalar>(r);
    const Scalar fraction = positive<Scalar>(r);
    const std::uint8_t to = counted<0>(
        "advanced_sector", [&] { return advanced_sector(config, sector, direction, fraction, w); });
    mix(advance_angle(config, w), to);
    saw("ahead", to != sector);
    saw("not yet", to == sector && direction != 0);
  }
};

template <class Scalar>
struct LimitsWalk {
  LimitsConfig<Scalar> config{};

  void draw(Random& r) {
    config = {positive<Scalar>(r, 26000),   !r.one_in(4), positive<Scalar>(r),
              positive_gain<Scalar>(r, -4), !r.one_in(4), positive<Scalar>(r),
              positive_gain<Scalar>(r, -4)};
  }
  void step(Random& r, Digest& mix) {
    const Measurement<Scalar> m = drawn_measurement<Scalar>(r);
    const Scalar reference = signal<Scalar>(r);
    const CurrentWindow<Scalar> window =
        counted<0>("current_window", [&] { return current_window(config, m.speed_rad_s, m.bus_V); });
    const bool coasts =
        counted<1>("must_coast", [&] { return must_coast(config, reference, m.speed_rad_s, m.bus_V); });
    mix(window.low, window.high, coasts, counted<2>("over_limit", [&] { return over_limit(config, m); }));
    mix(current_of_torque(m.i_a_A, config.A_per_V));
    saw("narrowed", window.high < config.current_A);
    saw("closed", window.low == Scalar{} || window.high == Scalar{});
    saw("must coast", coasts);
    saw("above the limit", over_limit(config, m));
  }
};

template <class Scalar>
struct FaultsWalk {
  FaultConfig<Scalar> config{};
  FaultState state{};

  void draw(Random& r) {
    const Scalar far = Number<Scalar>::part(0x50000000);
    config = {far + positive<Scalar>(r, 12000),
              far + positive<Scalar>(r, 12000),
              positive<Scalar>(r, 2000),
              far + positive<Scalar>(r, 12000),
              positive<Scalar>(r, 12000),
              static_cast<std::uint32_t>(r.below(8)),
              r.below(4)};
    fault_clear(state);
  }
  void step(Random& r, Digest& mix) {
    const FaultEvents events{r.one_in(64), r.below(4), r.one_in(8), r.below(4),
                             r.one_in(64) ? fault_align : fault_none};
    const Measurement<Scalar> m = drawn_measurement<Scalar>(r);
    const std::uint16_t latched =
        counted<0>("fault_step", [&] { return fault_step(config, state, m, events); });
    mix(latched, state.present, state.first, state.still, state.hall_line);
    saw("over current", (state.present & fault_over_current) != 0);
    saw("over voltage", (state.present & fault_over_voltage) != 0);
    saw("under voltage", (state.present & fault_under_voltage) != 0);
    saw("over speed", (state.present & fault_over_speed) != 0);
    saw("stall", (state.present & fault_stall) != 0);
    saw("nothing wrong", latched == 0);
    if (r.one_in(4)) saw("cleared", fault_clear(state));
  }
};

}  // namespace target
