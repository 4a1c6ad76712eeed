// SPDX-License-Identifier: Apache-2.0
// A synthetic chip with known gates runs on the board with its own clock (rig/chip_drive.hpp). Its result is
// equal to the result of the board's timer with the same pulses. The chip receives its samples and pins at
// the right instants.
#include "sixstep/rig/chip_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/gates.hpp"
#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using rig::ChipEvent;
using rig::CoreTrouble;
using rig::EventKind;
using ChipRig = rig::Rig<double, rig::ChipDrive>;

constexpr std::uint32_t clock_Hz = 16'000'000;
constexpr std::uint64_t period = 1600;  // cycles: 100 us
constexpr double range_A = 50.0, setpoint_range = 2.0;

/// The chip drives the pair of the Hall pins with a centred pulse of half a period. At the beginning of each
/// period, it samples channel 0.
struct PlayedChip {
  std::uint64_t cycle = 0, bad_from = ~std::uint64_t{0}, silent_from = bad_from,
                samples_again_from = bad_from;
  ChipEvent bad = ChipEvent::gates;
  std::uint32_t gates = 0;
  std::uint64_t sampled = 0;  ///< number of the last sampled period, plus one
  std::uint64_t calls = 0;
  rig::ChipRun last_sample{};
  bool waits_for_counts = false;

  std::uint32_t wanted(std::uint64_t at, std::uint32_t pins) const {
    if (at >= bad_from) return 3;  // both gates of leg a
    control::BridgeCommand<double> c{};
    c.enabled = true;
    c.pair = control::positive_pair(control::sector_of_hall(static_cast<std::uint8_t>(pins)));
    const std::uint64_t in_period = at % period;
    return control::gates(c, in_period >= period / 4 && in_period < 3 * period / 4);
  }
  rig::ChipAnswer go_on(const rig::ChipRun& run) {
    ++calls;
    if (waits_for_counts) last_sample = run;
    waits_for_counts = false;
    for (; cycle <= run.until; ++cycle) {
      if (cycle >= bad_from && bad == ChipEvent::ended) return {cycle, ChipEvent::ended, gates, 0, 0};
      if (const std::uint32_t now = wanted(cycle, run.hall_pins); now != gates)
        return {cycle, ChipEvent::gates, gates = now, 0, 0};
      if (cycle % period == 0 && (cycle < silent_from || cycle >= samples_again_from) &&
          sampled <= cycle / period) {
        sampled = cycle / period + 1;
        waits_for_counts = true;
        return {cycle, ChipEvent::sample, gates, 0, 0};
      }
    }
    cycle = run.until;
    return {cycle, ChipEvent::ran, gates, 0, 0};
  }
  rig::ChipPort port() {
    return {this,
            [](void* chip, const rig::ChipRun& run, rig::ChipAnswer& answer) {
              answer = static_cast<PlayedChip*>(chip)->go_on(run);
              return CoreTrouble::none;
            },
            clock_Hz};
  }
};

Board with_timer(double duty) {
  Board b = Board::duty(duty);
  b.board.modulator.period_ticks = 100'000'000;
  b.board.modulator.centre_aligned = true;
  return b;
}

struct OnChip {
  Board board = with_timer(0.5);
  PlayedChip chip;
  ChipRig rig() {
    board.board.chip = chip.port();
    board.board.sensors.current = {.bits = 10, .range = range_A};
    return ChipRig(board.plant<double>(), {control::Mode::current, setpoint_range, 1024}, board.board,
                   board.timeline);
  }
};

TEST(ChipDrive, ItsPulsesDriveWhatTheBoardsOwnTimerDrives) {
  OnChip on;
  on.board.shaft.locked = true;
  auto chip = on.rig();
  auto host = on.board.rig();
  for (const double t_s : {0.4e-3, 3.13e-3, 20e-3}) {
    ASSERT_EQ(run_to(chip, t_s), sim::Stop::end);
    ASSERT_EQ(run_to(host, t_s), sim::Stop::end);
    for (const std::size_t k : {0U, 1U, 2U})
      EXPECT_NEAR(chip.plant().state().i[k], host.plant().state().i[k],
                  1e-12 * (1 + std::fabs(host.plant().state().i[k])));
    EXPECT_EQ(chip.modulator().turn_ons(), host.modulator().turn_ons());
  }
  EXPECT_NEAR(chip.modulator().duty(), 0.5, 1e-12);
}

TEST(ChipDrive, IsShownHallEdgesWhereTheyAre) {
  OnChip on;
  auto chip = on.rig();
  auto host = on.board.rig();
  ASSERT_EQ(run_to(chip, 60e-3), sim::Stop::end);
  ASSERT_EQ(run_to(host, 60e-3), sim::Stop::end);
  ASSERT_GT(host.event_count(EventKind::sector_edge), 50);
  EXPECT_EQ(chip.event_count(EventKind::sector_edge), host.event_count(EventKind::sector_edge));
  EXPECT_GT(chip.firmware().latest_edge_s(), 0.0);
  EXPECT_LE(chip.firmware().latest_edge_s(), 8.5 / clock_Hz) << "eight cycles, and the one that it stands in";
  EXPECT_NEAR(chip.plant().state().w, host.plant().state().w, 2e-4 * host.plant().state().w);
  EXPECT_LT(on.chip.calls, 60e-3 / 100e-6 * 40) << "far from an edge it runs on by itself";
}

TEST(ChipDrive, ASampleIsCountsOfTheLegsAndOfThePotentiometer) {
  OnChip on;
  on.board.shaft.locked = true;
  on.board.timeline.clear();
  on.board.setpoint(0, -0.75);
  auto chip = on.rig();
  ASSERT_EQ(run_to(chip, 9.95e-3), sim::Stop::end);
  EXPECT_EQ(chip.event_count(EventKind::tick), 100) << "one a period";
  const double lsb_A = 2 * range_A / 1024;
  for (const std::size_t k : {0U, 1U, 2U})
    EXPECT_NEAR(on.chip.last_sample.counts[k], 512 + chip.plant().state().i[k] / lsb_A, 3.0) << k;
  EXPECT_NE(on.chip.last_sample.counts[0], 512);
  EXPECT_EQ(on.chip.last_sample.counts[rig::potentiometer_input], 512 - 0.75 / setpoint_range * 512);
  EXPECT_EQ(chip.current_reference_A(), -0.75);
}

TEST(ChipDrive, BothGatesOfALegEndTheRun) {
  OnChip on;
  on.chip.bad_from = 5000;
  auto chip = on.rig();
  EXPECT_EQ(run_to(chip, 10e-3), sim::Stop::fault);
  EXPECT_EQ(chip.fault(), rig::Fault::shoot_through);
  EXPECT_EQ(chip.now().ticks, 5000 * 62'500);
}

TEST(ChipDrive, OneThatEndsIsGoneWhereItEnded) {
  OnChip on;
  on.chip.bad_from = 5000;
  on.chip.bad = ChipEvent::ended;
  auto chip = on.rig();
  EXPECT_EQ(run_to(chip, 10e-3), sim::Stop::fault);
  EXPECT_EQ(chip.fault(), rig::Fault::core);
  EXPECT_EQ(chip.firmware().diagnosis().core, CoreTrouble::gone);
}

TEST(ChipDrive, OneThatSamplesNoLongerHasStalled) {
  OnChip on;
  on.chip.silent_from = 16000;
  auto chip = on.rig();
  EXPECT_EQ(run_to(chip, 50e-3), sim::Stop::fault);
  EXPECT_EQ(chip.firmware().diagnosis().core, CoreTrouble::stalled);
  EXPECT_NEAR(chip.now().seconds(), 0.9e-3 + 30e-3, 0.1e-3);
}

/// The shortest watchdog time of an AVR is 16 ms, and its oscillator may be 10 % slow. After the reset, the
/// chip restarts. In this test, it is silent for 20 ms.
TEST(ChipDrive, OneThatAWatchdogResetGoesOn) {
  OnChip on;
  on.chip.silent_from = 16000;
  on.chip.samples_again_from = 16000 + 320'000;
  auto chip = on.rig();
  EXPECT_EQ(run_to(chip, 50e-3), sim::Stop::end);
  EXPECT_GT(chip.event_count(EventKind::tick), 290) << "of 500 periods 200 had none";
}

}  // namespace SIXSTEP_TEST_FILE
