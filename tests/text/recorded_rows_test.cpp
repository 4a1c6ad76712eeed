// SPDX-License-Identifier: Apache-2.0
// Recordings laid over a run: a probe that is known comes back within its bounds, a wrong motor is told, and a file that
// is no recording is refused with words.
#include "text/scenario/recorded_rows.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sixstep/study/measure/laying.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using study::Samples;
using ::testing::HasSubstr;

const char* const driven = R"(
motor = "maxon-251601"
duration_s = 0.02
[control]
mode = "duty"
[reference]
value = 0.5
[load]
dynamometer_times_s = [0]
dynamometer_rad_s = [150]
)";

std::string with(const std::string& compare) { return driven + ("[[compare]]\n" + compare); }

base::Result<study::Scenario> read(const std::string& scenario, const std::string& csv) {
  return read_scenario_text("s.toml", scenario, {.overrides = {}, .resolve = among({{"r.csv", csv}})});
}

/// The signal of the driven motor at an interval.
Samples simulated(const char* column, double interval_s, const char* scenario = driven) {
  study::Scenario s = *read(scenario, "");
  s.record = {.grid_s = interval_s, .events = false, .columns = {column}};
  Samples out{0.0, interval_s, {}};
  EXPECT_TRUE(study::run(s, {.on_record = [&](study::Row row) { out.values.push_back(row[1]); }}));
  return out;
}

/// What a probe shows of samples from `first` on: noise, then the converter's steps.
struct Probe {
  double scale, offset, noise, step;
  Samples of(const Samples& x, std::size_t first, std::size_t count, unsigned seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, noise);
    Samples out{0.0, x.interval_s, {}};
    for (std::size_t n = first; n < first + count; ++n)
      out.values.push_back(step * std::round(((x.values[n] - offset) / scale + normal(random)) / step));
    return out;
  }
};

TEST(RecordedRows, ProbeAndTimeComeBackWithinTheirBounds) {
  const Samples current = simulated("i_a_A", 2e-6);
  const double period_s = 2.0 * std::numbers::pi / (150.0 * 8.0);
  const Probe probe{16.7, -6.1, 0.02, 0.008};
  study::Recording c;
  c.free = {"scale", "offset", "shift"};
  constexpr unsigned drawn = 60;
  unsigned scales = 0, offsets = 0;
  for (unsigned seed = 0; seed < drawn; ++seed) {
    const std::size_t first = 150 + 37 * seed;  // within the first period
    const study::Placing p = study::placed(c, probe.of(current, first, 5000, seed), current, 0.0, period_s);
    EXPECT_NEAR(p.shift_s, 2e-6 * static_cast<double>(first), 4e-6) << seed;
    scales += std::abs(p.scale - probe.scale) <= p.scale_bound ? 1 : 0;
    offsets += std::abs(p.offset - probe.offset) <= p.offset_bound ? 1 : 0;
    EXPECT_LT(p.scale_bound, 0.01 * probe.scale);
    // What is left is the probe's noise with its rounding, in the signal's unit.
    const double left = probe.scale * std::hypot(probe.noise, probe.step / std::sqrt(12.0));
    EXPECT_NEAR(p.rms, left, 0.1 * left);
  }
  // At 95 % 57 of 60 are expected; fewer than 51 come by chance once in 1000.
  EXPECT_GE(scales, 51U);
  EXPECT_GE(offsets, 51U);
}

TEST(RecordedRows, AGivenProbeIsNotFitted) {
  const Samples current = simulated("i_a_A", 2e-6);
  study::Recording c;
  c.scale = 2.0;
  c.offset = 0.5;
  c.shift_s = 2e-4;
  const Probe probe{2.0, 0.5, 0.0, 1e-9};
  const study::Placing p = study::placed(c, probe.of(current, 100, 5000, 1), current, 0.0, 1.0);
  EXPECT_EQ(p.scale, 2.0);
  EXPECT_EQ(p.offset, 0.5);
  EXPECT_EQ(p.scale_bound, 0.0);
  EXPECT_LT(p.rms, 1e-6);
  // An offset of the probe that is not free remains as the distance.
  const Probe off{2.0, 0.7, 0.0, 1e-9};
  EXPECT_NEAR(study::placed(c, off.of(current, 100, 5000, 1), current, 0.0, 1.0).rms, 0.2, 1e-6);
}

study::Estimate figure(const char* word, const Samples& x, double period_s = 0.0, double level = 0.5) {
  return study::estimate({*study::recorded_figure(word), period_s, level, 0.0, HUGE_VAL}, x);
}

TEST(RecordedRows, WidthsAndPeriodsOfPulses) {
  // Pulses of 30.3 us each 100.7 us that pause, with noise at the level.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.01);
  Samples x{0.0, 1e-6, {}};
  for (int n = 0; n < 20000; ++n) {
    const double at = std::fmod(1e-6 * n, 100.7e-6);
    const bool paused = n > 7000 && n < 12000;
    x.values.push_back((at < 30.3e-6 && !paused ? 1.0 : 0.0) + noise(random));
  }
  const study::Estimate high = figure("high_s", x), low = figure("low_s", x), period = figure("period_s", x);
  EXPECT_NEAR(high.value, 30.3e-6, high.uncertainty);
  EXPECT_LT(high.uncertainty, 1e-6);
  EXPECT_NEAR(period.value, 100.7e-6, period.uncertainty);
  EXPECT_LT(period.uncertainty, 0.3e-6);
  EXPECT_NEAR(static_cast<double>(high.count), 15000 / 100.7, 2.0);
  EXPECT_GT(low.value, 70.4e-6) << "the pause counts as low";
  EXPECT_EQ(figure("high_s", Samples{0.0, 1.0, Samples{}.values}).count, 0U);
}

TEST(RecordedRows, APulseThatTheEndsCutIsNone) {
  const Samples x{0.0, 1.0, {1, 1, 0, 0, 1, 1, 1, 0, 0, 1, 1}};
  const study::Estimate high = figure("high_s", x);
  EXPECT_EQ(high.count, 1U);
  EXPECT_DOUBLE_EQ(high.value, 3.0);
  EXPECT_TRUE(std::isinf(high.uncertainty)) << "one pulse shows no spread";
}

TEST(RecordedRows, HarmonicsOfAKnownSum) {
  // The given period is 1 % off; the recording's own one counts. 833.3 samples make no whole period.
  Samples x{0.0, 1e-6, {}};
  const double period = 833.3e-6;
  for (int n = 0; n < 4000; ++n) {
    const double a = 2.0 * std::numbers::pi * 1e-6 * n / period;
    x.values.push_back(0.7 + 2.0 * std::sin(a) + 0.07 * std::sin(5.0 * a + 1.0));
  }
  EXPECT_NEAR(figure("harmonic_1", x, 1.01 * period).value, 2.0, 2e-3);
  EXPECT_NEAR(figure("harmonic_5", x, 1.01 * period).value, 0.035, 1e-4);
  EXPECT_NEAR(figure("harmonic_3", x, 1.01 * period).value, 0.0, 2e-4);
  EXPECT_NEAR(figure("rms", x, period).value, std::sqrt(0.49 + 2.0 + 0.07 * 0.07 / 2.0), 2e-3);
  EXPECT_NEAR(figure("mean", x, period).value, 0.7, 5e-3);
  EXPECT_TRUE(std::isnan(figure("rms", x, 0.01).value)) << "no whole period";
}

TEST(RecordedRows, AMovingMeanOfAPeriodIsItsMean) {
  Samples x{0.0, 1e-6, {}};
  for (int n = 0; n < 500; ++n) x.values.push_back(n % 50 < 20 ? 5.0 : 0.0);
  study::take_moving_mean(x, 50e-6);
  EXPECT_EQ(x.values.size(), 451U);
  EXPECT_DOUBLE_EQ(x.start_s, 24.5e-6);
  for (const double v : x.values) EXPECT_NEAR(v, 2.0, 1e-12);
}

std::string csv_of(const Samples& x, const char* heading) {
  std::string out = fmt::format("# Sample interval: {} s\n{}\n", x.interval_s, heading);
  for (const double v : x.values) out += fmt::format("{:.6g}\n", v);
  return out;
}

/// The comparisons of a run with a recording.
std::vector<study::ComparisonResult> compared(const std::string& scenario, const std::string& csv) {
  const base::Result<study::Scenario> s = read(scenario, csv);
  if (!s) {
    ADD_FAILURE() << to_string(s.problems()[0]);
    return {};
  }
  const base::Result<study::Outcome> out = study::run(*s);
  return out ? out->comparisons : std::vector<study::ComparisonResult>{};
}

TEST(RecordedRows, AWrongMotorIsToldBeyond) {
  const std::string
      turned =
          "motor = \"maxon-251601\"\nduration_s = 0.05\n[load]\ndynamometer_times_s = [0]\ndynamometer_rad_s = [150]\n",
      compare =
          "[[compare]]\nfile = \"r.csv\"\nsignal = \"u_ab_V\"\ncolumn = \"u_ab\"\nfree = "
          "[\"shift\"]\nfigures = [\"harmonic_1\"]\n";
  const Probe scope{1.0, 0.0, 0.05, 0.08};
  const std::string csv =
      csv_of(scope.of(simulated("u_ab_V", 1e-5, turned.c_str()), 40, 4000, 5), "u_ab [V]");
  const auto right = compared(turned + compare, csv),
             wrong =
                 compared("motor_override.torque_constant_mNm_A = { value = 35.2, frame = \"terminal\" }\n" +
                              turned + compare + "tolerance_percent = 3\n",
                          csv);
  ASSERT_EQ(right.size(), 1U);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(right[0].beyond(), 0.0);
  EXPECT_FALSE(right[0].fails);
  EXPECT_NEAR(wrong[0].measured / wrong[0].value, 35.2 / 33.5, 0.005);
  EXPECT_GT(wrong[0].beyond(), 0.04 * wrong[0].value);
  EXPECT_TRUE(wrong[0].fails) << "5 % off, of which 3 % are tolerated";
}

TEST(RecordedRows, ARecordingIsMovedOutOfTheComparisonsWithAValue) {
  const std::string csv = csv_of(simulated("i_a_A", 1e-5), "i_a [A]");
  const auto s = read(with("file = \"r.csv\"\nsignal = \"i_a\"\n[[compare]]\nmetric = \"mean\"\nvalue = 1\n"
                           "source = \"x\"\nto_s = 3\n"),
                      csv);
  ASSERT_FALSE(s);
  EXPECT_THAT(to_string(s.problems()[0]), HasSubstr("s.toml:18:")) << "the line of the second table";
}

TEST(RecordedRows, FilesThatAreNoRecordingAreRefusedWithWords) {
  std::string rows = "# Sample interval: 1e-5 s\nu_a [V]\n", current = "time [s],i_a [A]\n", uneven = current;
  for (int n = 0; n < 100; ++n) {
    rows += fmt::format("{}\n", n % 7);
    current += fmt::format("{},{}\n", n * 1e-5, n);
    uneven += fmt::format("{},{}\n", n * n * 1e-5, n);
  }
  const std::string nan = rows + "nan\n", infinite = rows + "1e999\n", few = rows.substr(0, 60);
  const std::string u_a = "file = \"r.csv\"\nsignal = \"u_a_V\"\n",
                    i_a = "file = \"r.csv\"\nsignal = \"i_a\"\n";
  const std::string cases[][3] = {
      {u_a, "", "r.csv"},
      {u_a, "no table at all", "r.csv"},
      {u_a, std::string(2000, '\xff'), "r.csv"},
      {u_a, nan, "r.csv"},
      {u_a, infinite, "r.csv"},
      {u_a, few, "r.csv"},
      {i_a + "column = \"u_a\"\n", rows, "V"},  // another unit
      {i_a, uneven, "not evenly spaced"},
      {u_a + "column = \"u_x\"\n", rows, "u_x"},
      {u_a + "shift_s = 5\n", rows, "fewer than 16 rows"},  // the window is elsewhere
      {u_a + "from_s = 0.0199\n", rows, "fewer than 16 rows"},
      {u_a + "from_s = 1\n", rows, "not before the end"},
      {u_a + "mean_s = 1\n", rows, "longer than half"},
      {u_a + "figures = [\"harmonic_0\"]\n", rows, "no figure"},
      {u_a + "figures = [\"harmonic_\"]\n", rows, "no figure"},
      {u_a + "figures = [\"harmonic_1e9\"]\n", rows, "no figure"},
      {u_a + "figures = [\"high_s\"]\n", rows, "level"},
      {u_a + "level = 3\n", rows, "no effect"},
      {u_a + "free = [\"colour\"]\n", rows, "no property"},
      {u_a + "scale = 0\n", rows, "must not be 0"},
      {u_a + "value = 3\n", rows, "no effect with file"},
      {"file = \"r.csv\"\nsignal = \"copper_loss_W\"\n", rows, "not a column"},
      {"file = \"none.csv\"\nsignal = \"u_a_V\"\n", rows, "none.csv"},
      {"metric = \"mean\"\nvalue = 1\nsource = \"x\"\nscale = 2\n", rows, "without file"},
      {"signal = \"u_a_V\"\n", rows, "metric"},
  };
  for (const auto& [compare, csv, said] : cases) {
    const auto s = read(with(compare), csv);
    ASSERT_FALSE(s) << compare << csv.substr(0, 60);
    std::string all;
    for (const base::Problem& p : s.problems()) all += to_string(p) + "\n";
    EXPECT_THAT(all, HasSubstr(said)) << compare;
  }
  EXPECT_TRUE(read(with(u_a), rows)) << "the same without a mistake";
}

TEST(RecordedRows, TooManySamplesOfOneRunAreRefused) {
  std::string rows = "# Sample interval: 1e-9 s\nu_a [V]\n";
  for (int n = 0; n < 100; ++n) rows += "1\n";
  const auto s = read(with("file = \"r.csv\"\nsignal = \"u_a_V\"\n"), rows);
  ASSERT_FALSE(s);
  EXPECT_THAT(to_string(s.problems()[0]), HasSubstr("too many"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text
