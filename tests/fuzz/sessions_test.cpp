// SPDX-License-Identifier: Apache-2.0
// Sessions of random scenarios. A session has any steps, copies and changes, and writes a scenario. The run
// of this scenario has the session's digest, even after the scenario was written to text and read again.
#include <gtest/gtest.h>

#include <algorithm>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/session/session.hpp"
#include "tests/fuzz/draw.hpp"
#include "tests/fuzz/drawn_scenario.hpp"
#include "text/scenario/scenario_file.hpp"
#include "text/scenario/scenario_text.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t usual_count = 40;
#else
constexpr std::uint64_t usual_count = 250;
#endif

/// A setpoint that the motor can reach, in the unit of the mode.
double drawn_level(Draw& draw, const Scenario& s, Mode mode) {
  const auto motor = design::motor_model(s.sheet);
  const double part = draw.between(-1.0, 1.0), U = s.supply.voltage_V;
  if (mode == s.control.mode && draw.chance(0.7)) return part * largest_reference(s);
  switch (mode) {
    case Mode::current:
      return 0.2 * part * U / (2 * motor->machine.R_ohm);
    case Mode::speed:
      return 0.5 * part * U / motor->K_t_Nm_A;
    case Mode::position:
      return 45.0 * part;
    default:
      return draw.chance(0.3) ? draw.one_of(3) - 1.0 : part;
  }
}

Reference drawn_turn(Draw& draw, const Scenario& s, Mode mode, double left_s) {
  const double level = drawn_level(draw, s, mode);
  switch (draw.one_of(4)) {
    case 0:
      return {.shape = Shape::ramp, .start = 0.0, .end = level, .end_s = left_s / 3};
    case 1:
      return {.shape = Shape::square, .high = level, .low = -level / 2, .period_s = left_s / 5};
    default:
      return {.value = level};
  }
}

void draw_tuning(Draw& draw, const Scenario& s, At& at) {
  const double period = s.pwm.period_s;
  switch (draw.one_of(5)) {
    case 0:
      if (s.control.current.type == CurrentLoopType::pi)
        at.control.current.settle_s = period * draw.decades(5.0, 50.0);
      else
        at.control.current.band_A = s.control.current.band_A * draw.between(0.7, 2.0);
      return;
    case 1:
      at.control.speed.settle_s = period * draw.decades(30.0, 500.0);
      return;
    case 2:
      at.control.position.gain_rad_s_per_deg = s.control.position.gain_rad_s_per_deg * draw.between(0.5, 1.5);
      return;
    case 3:
      at.pwm.chopping = static_cast<AtChopping>(1 + draw.one_of(3));
      return;
    default:
      at.bridge.dead_time_s = period * draw.decades(1e-3, 0.1);
      if (s.pwm.timer_Hz > 0)
        at.bridge.dead_time_s = std::ceil(*at.bridge.dead_time_s * s.pwm.timer_Hz) / s.pwm.timer_Hz;
  }
}

/// A random change of the kind that a session accepts.
At drawn_change(Draw& draw, const Scenario& s, double left_s) {
  At at;
  const Mode mode = s.at.empty() ? s.control.mode : modes_from(s).back();
  switch (draw.one_of(9)) {
    case 0:
    case 1:
      at.reference = drawn_turn(draw, s, mode, left_s);
      break;
    case 2:
      at.supply.voltage_V = s.supply.voltage_V * draw.between(0.8, 1.0);
      break;
    case 3:
      at.load.torque_Nm = draw.between(-0.02, 0.02);
      break;
    case 4:
      if (draw.chance(0.2))
        at.sensors.hall_break = AtHallBreak{1 + draw.one_of(3), static_cast<PinLevel>(draw.one_of(3))};
      else
        at.load.locked = draw.chance(0.3);
      break;
    case 5:
      if (s.control.drive == FirmwareKind::product)
        at.request = static_cast<DriveRequest>(1 + draw.one_of(3));
      break;
    case 6: {
      const auto other = static_cast<Mode>(draw.one_of(5));
      at.control.mode = static_cast<AtMode>(1 + static_cast<int>(other));
      if (other != Mode::off) at.reference = drawn_turn(draw, s, other, left_s);
      break;
    }
    default:
      draw_tuning(draw, s, at);
  }
  return at;
}

struct Told {
  int changes = 0, refused = 0, mode_changes = 0;
};

/// Advances in steps of any length, with some changes. Sometimes a copy of the session replaces the session.
void live(Draw& draw, Session& session, Told& told) {
  const double duration_s = session.scenario().duration_s;
  double t_s = 0.0;
  for (int n = 0; n < 40 && session.advance(t_s); ++n) {
    if (draw.chance(0.35)) {
      const At change = drawn_change(draw, session.scenario(), duration_s - t_s);
      const bool taken = bool(session.change(change));
      told.mode_changes += taken && change.control.mode != AtMode::same;
      ++(taken ? told.changes : told.refused);
    }
    if (draw.chance(0.1)) session = Session(session);
    t_s = session.now_s() + duration_s * draw.decades(1e-4, 0.2);
  }
}

std::uint64_t digest_of(const Scenario& s, std::uint64_t seed) {
  const auto out = run(s, {.keep_books = false});
  if (!out) ADD_FAILURE() << "SIXSTEP_FUZZ_SEED=" << seed << ": " << to_string(out.problems()[0]);
  return out ? out->digest : 0;
}

bool examine(std::uint64_t seed, Told& told) {
  const DrawnScenario drawn = drawn_scenario(seed);
  const auto whole = run(drawn.scenario, {.keep_books = false});
  auto session = Session::open(drawn.scenario, {.keep_books = false});
  EXPECT_EQ(bool(session), bool(whole)) << "SIXSTEP_FUZZ_SEED=" << seed;
  if (!session || !whole) return false;
  SCOPED_TRACE("SIXSTEP_FUZZ_SEED=" + std::to_string(seed));
  Draw draw(seed ^ 0x5e55'1011);
  Session sliced = *session;
  for (double t_s = 0.0; sliced.advance(t_s);) t_s += drawn.scenario.duration_s * draw.decades(1e-3, 0.3);
  const auto uncut = sliced.close();
  EXPECT_TRUE(uncut && uncut->digest == whole->digest) << "sliced";
  live(draw, *session, told);
  if (draw.chance(0.6)) session->advance(1e6);
  auto out = session->close();
  // With a shorter duration, the scenario would describe a different drive from the start. close() refuses
  // it, and the session continues.
  if (!out && out.problems()[0].where == "duration_s") {
    session->advance(1e6);
    out = session->close();
  }
  if (!out) {
    ADD_FAILURE() << to_string(out.problems()[0]);
    return false;
  }
  EXPECT_EQ(digest_of(session->scenario(), seed), out->digest) << "replayed";
  const std::string file = text::scenario_text(session->scenario());
  const auto read = text::read_scenario_text(SIXSTEP_SOURCE_DIR "/data/scenarios/x.toml", file, {});
  if (!read) {
    ADD_FAILURE() << to_string(read.problems()[0]) << "\n" << file;
    return false;
  }
  EXPECT_EQ(digest_of(*read, seed), out->digest) << "replayed from text\n" << file;
  return true;
}

TEST(Sessions, ReplayFromWhatTheyWroteWhateverTheyWereTold) {
  const Seeds range = seeds(usual_count);
  Told told;
  int examined = 0;
  for (std::uint64_t seed = range.first; seed < range.first + range.count; ++seed)
    examined += examine(seed, told);
  if (std::getenv("SIXSTEP_FUZZ_SEED")) return;
  EXPECT_GT(examined, static_cast<int>(range.count) / 2);
  EXPECT_GT(told.changes, told.refused) << "most of what is drawn must be worth telling";
  EXPECT_GT(told.mode_changes, examined / 20);
}

}  // namespace SIXSTEP_TEST_FILE
