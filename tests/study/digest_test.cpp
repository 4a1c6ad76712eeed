// SPDX-License-Identifier: Apache-2.0
// One trajectory has one digest: in repeated runs, in several threads, with and without observers, and if a
// run is resumed from a snapshot.
#include "sixstep/study/measure/digest.hpp"
#include "sixstep/base/hash.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>
#include <type_traits>

#include "sixstep/rig/lean_rig.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/arithmetic.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "tests/support/product_scenarios.hpp"
#include "tests/support/scenario_walk.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

using Rig = rig::LeanRig<double>;
static_assert(std::is_copy_constructible_v<Rig>, "a copy of the rig is its snapshot");

/// A scenario whose states a snapshot could omit: a loop that is designed by its settling time, a bus with R
/// and C, and dead time.
Scenario rich() {
  Scenario s = current_square();
  s.control.current.d1 = s.control.current.d0 = std::nullopt;
  s.control.current.settle_s = 1e-3;
  s.control.current.damping = 0.9;
  s.supply.resistance_ohm = 0.1;
  s.supply.capacitance_F = 1e-3;
  s.bridge.dead_time_s = 1e-6;
  s.pwm.chopping = control::Chopping::complementary;
  s.duration_s = 8e-3;
  return s;
}

Scenario late_chip() {
  Scenario s = maxon_scenario(Mode::speed, 80.0);
  s.pwm.delay_periods = 1;
  s.pwm.commutation = CommutationAt::sample;
  s.duration_s = 8e-3;
  return s;
}

Rig rig_of(const Compiled& c) {
  const plant::Plant<double> plant(c.motor.machine, c.shaft, c.devices, c.supply, c.start);
  return {plant, in_arithmetic<double>(c.drive), c.board, c.timeline};
}

std::uint64_t digest_of(const Scenario& s, const Listeners& listeners = {}) {
  return run(s, listeners).operator*().digest;
}

/// A digest of the end state only. Runs with and without observers can be compared by it.
std::uint64_t end_state(const Rig& rig) { return Digest{}.after(rig); }

/// Calls each(rig, digest) at every control tick, after the tick's event.
template <class Each>
struct AtTicks {
  Digest digest;
  Each each;
  bool ticked = false;

  void segment(const Rig& rig, double s) {
    digest.segment(rig, s);
    ticked = rig.ticked();
  }
  bool done(const Rig& rig) {
    if (ticked) each(rig, digest);
    return false;
  }
};
template <class Each>
AtTicks(Digest, Each) -> AtTicks<Each>;

TEST(Digest, IsTheSameOnEveryRun) {
  for (const Scenario& s : {rich(), hysteresis(), late_chip()}) EXPECT_EQ(digest_of(s), digest_of(s));
}

TEST(Pitfall10_RecordersChangeNoBit, WhoeverListens) {
  for (Scenario s : {rich(), hysteresis(), late_chip()}) {
    const std::uint64_t alone = digest_of(s);
    ask(s, measure(MetricKind::rms, Signal::current));
    s.record.columns = {"i_a_A"};
    EXPECT_EQ(digest_of(s, {.on_record = [](Row) {}}), alone);
    EXPECT_EQ(digest_of(s, {.on_event = [](Row) {}, .keep_going = [](double) { return true; }}), alone);
    EXPECT_EQ(digest_of(s, {.keep_books = false}), alone);
    s.record.events = true;
    EXPECT_EQ(digest_of(s, {.on_record = [](Row) {}, .on_event = [](Row) {}}), alone);
    EXPECT_EQ(digest_of(s, {.on_logic = [](std::int64_t, std::span<const std::uint32_t>) {}}), alone);
  }
}

TEST(Pitfall10_RecordersChangeNoBit, NorDoesTheDigest) {
  for (const Scenario& s : {rich(), hysteresis(), late_chip()}) {
    const auto compiled = compile(s);
    ASSERT_TRUE(compiled);
    Rig plain = rig_of(*compiled), watched = rig_of(*compiled);
    sim::NoObserver nobody;
    Digest digest;
    EXPECT_EQ(sim::run(plain, compiled->end, nobody).segments,
              sim::run(watched, compiled->end, digest).segments);
    EXPECT_EQ(end_state(plain), end_state(watched));
    EXPECT_EQ(digest.after(watched), digest_of(s));
  }
}

TEST(Digest, IsTheSameOnManyThreadsAtOnce) {
  const Scenario s = rich();
  const std::uint64_t alone = digest_of(s);
  std::array<std::uint64_t, 8> found{};
  std::vector<std::thread> threads;
  for (std::uint64_t& one : found) threads.emplace_back([&one, &s] { one = digest_of(s); });
  for (std::thread& t : threads) t.join();
  for (const std::uint64_t one : found) EXPECT_EQ(one, alone);
}

TEST(Digest, GoesOnFromASnapshotAtAnyTick) {
  for (const Scenario& s : {rich(), hysteresis(), late_chip()}) {
    const auto compiled = compile(s);
    ASSERT_TRUE(compiled);
    Rig whole = rig_of(*compiled);
    std::vector<std::pair<Rig, Digest>> snapshots;
    AtTicks watcher{Digest{}, [&](const Rig& r, const Digest& d) { snapshots.emplace_back(r, d); }};
    sim::run(whole, compiled->end, watcher);
    const std::uint64_t expected = watcher.digest.after(whole);
    EXPECT_EQ(expected, digest_of(s));
    EXPECT_GT(snapshots.size(), 200u);
    for (auto& [rig, digest] : snapshots) {
      const double from_s = rig.now().seconds();
      sim::run(rig, compiled->end, digest);
      ASSERT_EQ(digest.after(rig), expected) << "resumed at " << from_s;
    }
  }
}

/// Scenarios with states of a sensed firmware and of a product firmware that a snapshot could omit. The
/// states are noise, offsets, captured edges, the memory of the one-shunt measurement, filters, fault
/// counters, a changing reference and later events.
Scenario one_shunt() {
  Scenario s = current_square();
  s.control.current = {.settle_s = 1e-3, .damping = 0.9};
  s.sensors = board_sensors();
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  s.sensors.current_noise_A = 0.02;
  s.sensors.bus_noise_V = 0.05;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  s.initial.speed_rad_s = 60.0;
  return s;
}

Scenario flashed() {
  Scenario s = product_scenario(Mode::speed, 0.0);
  s.reference = {.shape = Shape::trapezoid, .end = 150.0, .slope = 2e4, .acceleration = 4e6};
  s.control.speed.form = SpeedForm::positional;
  s.control.speed.derivative_s = 1e-3;
  s.control.speed.derivative_filter_s = 3e-3;
  s.control.limits.speed_rad_s = 300.0;
  s.control.slew = 5e4;
  s.sensors.current_noise_A = 0.01;
  s.sensors.hall_stable_samples = 2;
  s.protection.align = {.current_A = 3.0, .longest_s = 4e-3, .settled_s = 1e-3};
  s.protection.brake_current_A = 4.0;
  s.protection.off_at_s = 17e-3;
  s.initial.angle_rad = 0.1;
  return s;
}

TEST(Digest, GoesOnFromASnapshotInEveryFirmwareAndArithmetic) {
  for (Scenario s : {late_chip(), one_shunt(), flashed()})
    for (const auto& arithmetic : arithmetic_choices) {
      s.control.arithmetic = arithmetic.value;
      SCOPED_TRACE(std::string(s.control.drive == FirmwareKind::product ? "product " : "") +
                   std::string(arithmetic.word));
      const auto compiled = compile(s);
      ASSERT_TRUE(compiled);
      const Walk walked = walk(s, *compiled, {.snapshot_every = 7});
      ASSERT_TRUE(walked.problems.empty()) << to_string(walked.problems[0]);
      EXPECT_EQ(walked.digest, digest_of(s));
      EXPECT_GT(walked.resumed, 30);
      EXPECT_EQ(walked.resumed_otherwise, 0);
    }
}

TEST(Digest, SeesTheLastBitOfOneParameter) {
  Scenario s = rich();
  const std::uint64_t before = digest_of(s);
  s.initial.speed_rad_s = 0x1p-60;
  EXPECT_NE(digest_of(s), before);
}

TEST(Hash, SeesEveryBitOfEveryWord) {
  const auto of = [](std::uint64_t a, std::uint64_t b) {
    base::Hash h;
    h.word(a);
    h.word(b);
    return h.value();
  };
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t one = std::uint64_t{1} << bit;
    EXPECT_NE(of(0, 0), of(one, 0));
    EXPECT_NE(of(0, 0), of(0, one));
    EXPECT_NE(of(0, 0), of(one, one));  // two signs change at the same time: a plain product would be equal
    EXPECT_NE(of(one, 0), of(0, one));
  }
}

TEST(Hash, KnowsOneNaNOnly) {
  const auto of = [](double x) {
    base::Hash h;
    h.number(x);
    return h.value();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of(nan), of(-nan));
  EXPECT_EQ(of(nan), of(std::bit_cast<double>(std::uint64_t{0x7ff8000000000123u})));
  EXPECT_NE(of(0.0), of(-0.0));
}

}  // namespace SIXSTEP_TEST_FILE
