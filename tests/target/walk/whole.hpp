// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks without a scalar that process pins and states.
#pragma once
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/hall.hpp"
#include "sixstep/control/state_machine.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

/// The Hall sector of a rotor. It changes by one sector, forward or back.
struct Rotor {
  std::uint8_t sector = 0;

  constexpr void move(bool back) { sector = static_cast<std::uint8_t>((sector + (back ? 5 : 1)) % 6); }
  constexpr std::uint8_t code() const { return hall_of_sector(sector); }
};

struct HallWalk {
  HallConfig config{};
  HallState state{};
  Rotor rotor{};
  bool back = false;

  void draw(Random& r) {
    config = {r.one_in(2) ? HallArrangement::degrees_60 : HallArrangement::degrees_120,
              static_cast<std::uint8_t>(r.one_in(2) ? 1 : r.below(4))};
    state = {};
    back = r.one_in(2);
  }
  /// The code of the pins. For probes 60 degrees apart, it is computed by the inverse of as_120_degrees().
  std::uint8_t pins() const {
    const std::uint8_t code = rotor.code();
    if (config.arrangement == HallArrangement::degrees_120) return code;
    return static_cast<std::uint8_t>((code & 4) | ((code & 1) != 0 ? 0 : 2) | ((code & 2) != 0 ? 1 : 0));
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(3)) rotor.move(r.one_in(32) ? !back : back);
    if (r.one_in(64)) rotor.move(back);
    const std::uint8_t read = r.one_in(32) ? static_cast<std::uint8_t>(r.below(8)) : pins();
    const auto time = static_cast<SectorTime>(r.below(4));
    const HallReading reading = counted<0>("hall_step", [&] { return hall_step(config, state, read, time); });
    mix(reading.sector, reading.moved, static_cast<std::uint8_t>(reading.fault), reading.line, state.suspect);
    saw("forward", reading.moved > 0);
    saw("back", reading.moved < 0);
    saw("an impossible code", reading.fault == HallFault::impossible_code);
    saw("a jump", reading.fault == HallFault::jump);
    saw("a line to blame", reading.line != 0);
  }
};

struct StateMachineWalk {
  ActivityState state{};
  Request request{};

  void draw(Random& r) { request.run = !r.one_in(3); }
  void step(Random& r, Digest& mix) {
    request.clear = r.one_in(3);
    ActivityInput in{request, r.one_in(3), r.one_in(3), r.one_in(3), r.one_in(64)};
    if (r.one_in(16)) in.request.run = request.run = !request.run;
    const bool clears = clear_requested(state, request);
    if (state.activity == Activity::fault && !clears) in.faulty = true;
    const Activity now = counted<0>("activity_step", [&] { return activity_step(state, in); });
    mix(static_cast<std::uint8_t>(now), clears, state.run_released);
    saw("calibrates", now == Activity::calibrate);
    saw("aligns", now == Activity::align);
    saw("runs", now == Activity::run);
    saw("brakes", now == Activity::brake);
    saw("fault", now == Activity::fault);
  }
};

}  // namespace target
