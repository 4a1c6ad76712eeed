// SPDX-License-Identifier: Apache-2.0
// Tests the bounds of a signal that are quick to compute. In most segments, they make the search for extremes
// unnecessary.
#include "sixstep/study/measure/signals.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "sixstep/study/measure/full_row.hpp"
#include "sixstep/study/measure/gauge.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;

constexpr Signal bounded[] = {Signal::current, Signal::phase_a,     Signal::phase_b,
                              Signal::phase_c, Signal::bus_current, Signal::speed};

struct WithinBounds {
  std::int64_t segments = 0, breaches = 0, useful = 0;

  template <class Rig>
  void segment(const Rig& rig, double) {
    const int degree = rig.plant().expansion().degree;
    for (const Signal signal : bounded) {
      const Series c = piece_of(segment_view(rig), signal, 0.0, 1.0).c;
      const series::Extremes<double> e = series::extremes(c, degree),
                                     b = signal_bounds(segment_view(rig), signal);
      ++segments;
      breaches += !(b.low <= e.low && e.high <= b.high);
      // For a straight line, one bound is an end of the line, and the other bound is its mirror image. The
      // interval is then twice as wide as necessary.
      useful += b.high - b.low <= 2.5 * (e.high - e.low) + 1e-9;
    }
  }
};

TEST(SignalBounds, HoldTheWholeCurve) {
  for (const bool sine : {false, true}) {
    for (const double duty : {0.3, -0.95}) {
      Board b = Board::duty(duty);
      if (sine) b.machine.back_emf = plant::BackEmf::sine;
      b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
      auto rig = b.rig();
      WithinBounds within;
      ASSERT_EQ(run_to(rig, 10e-3, within), sim::Stop::end);
      EXPECT_EQ(within.breaches, 0) << sine << " " << duty;
      EXPECT_GT(within.segments, 3000);
      EXPECT_GT(within.useful, within.segments / 2) << "bounds as wide as this exclude nothing";
    }
  }
}

TEST(SignalBounds, NoneForWhatHasNoneAtHand) {
  auto rig = Board::duty(0.3).rig();
  EXPECT_EQ(signal_bounds(segment_view(rig), Signal::current_magnitude).high,
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(signal_bounds(segment_view(rig), Signal::torque).low, -std::numeric_limits<double>::infinity());
}

/// Compares every signal with the values of the trace at the same instant: the columns by their names, and
/// the powers.
struct AgainstTheTrace {
  double worst = 0.0;  ///< difference divided by the signal's natural size
  std::string where;
  std::int64_t compared = 0, floating_stars = 0, high_degrees = 0;

  void compare(double is, double should, double size, std::string_view what) {
    ++compared;
    if (const double apart = std::fabs(is - should) / size; !(apart <= worst)) {
      worst = apart;
      where = what;
    }
  }
  template <class Rig>
  void segment(const Rig& rig, double s) {
    const SegmentView g = segment_view(rig);
    floating_stars += plant::connected_count(g.plant.legs()) == 0;
    high_degrees += 2 * g.plant.expansion().degree > series::max_degree;
    for (const SignalFact& fact : signal_facts)
      for_each_piece(g, fact.signal, 0.1 * s, s, [&](const Piece& y, double from, double to) {
        for (const double at : {0.0, 0.37, 1.0})
          at_one(rig, fact, series::evaluate(y.c, y.degree, at), from + at * (to - from));
      });
  }
  template <class Rig>
  void at_one(const Rig& rig, const SignalFact& fact, double value, double s) {
    const FullRow row = full_row(rig, s, 0.0);
    const std::vector<Column>& columns = all_columns();
    const auto& c = rig.plant().constants();
    std::string_view name = fact.word;
    for (const auto& [word, signal, meaning, turning] : column_words)
      if (signal == fact.signal) name = word;
    for (std::size_t n = 0; n < columns.size(); ++n)
      if (columns[n].name == name) {
        const double size = fact.unit == "A"       ? c.amp_scale
                            : fact.unit == "V"     ? c.volt_scale
                            : fact.unit == "rad/s" ? c.speed_scale
                            : fact.unit == "N m"   ? c.torque_scale
                                                   : 1.0;
        return compare(value, row[n], size, name);
      }
    derived(rig, fact, value, s);
  }
  /// Compares a signal without a column with its formula.
  template <class Rig>
  void derived(const Rig& rig, const SignalFact& fact, double value, double s) {
    const auto& c = rig.plant().constants();
    const double amps = c.amp_scale, watts = amps * c.volt_scale;
    const std::string_view name = fact.word;
    const plant::Snapshot<double> now = rig.plant().at(s);
    const FullRow row = full_row(rig, s, 0.0);
    const auto column = [&](ColumnId id) { return row[static_cast<std::size_t>(id)]; };
    double copper = 0.0, motor = 0.0, magnitude = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      copper += c.R * now.i[k] * now.i[k];
      motor += now.pole[k] * now.i[k];
      magnitude += std::fabs(now.i[k]) / 2;
    }
    const plant::Motion motion = rig.plant().mode().motion;
    const double slide = motion == plant::Motion::forward    ? c.coulomb
                         : motion == plant::Motion::backward ? -c.coulomb
                                                             : 0.0;
    const double degrees = now.angle * 180 / base::pi,
                 friction = c.B * now.speed * now.speed + slide * now.speed;
    switch (fact.signal) {
      case Signal::current_magnitude:
        return compare(value, magnitude, amps, name);
      case Signal::position:
        return compare(value, degrees, 360, name);
      case Signal::current_error:
        return compare(value, column(ColumnId::i_ref) - column(ColumnId::i_m), amps, name);
      case Signal::speed_error:
        return compare(value, column(ColumnId::speed_ref) - now.speed, c.speed_scale, name);
      case Signal::position_error:
        return compare(value, rig.setpoint() - degrees, 360, name);
      case Signal::supply_power:
        return compare(value, now.bus * now.bus_current, watts, name);
      case Signal::motor_power:
        return compare(value, motor, watts, name);
      case Signal::mechanical_power:
        return compare(value, now.torque * now.speed, watts, name);
      case Signal::load_power:
        return compare(value, c.load * now.speed, watts, name);
      case Signal::copper_loss:
        return compare(value, copper, watts, name);
      case Signal::device_loss:
        return compare(value, now.bus * now.bus_current - motor, watts, name);
      case Signal::friction_loss:
        return compare(value, friction, watts, name);
      default:
        ADD_FAILURE() << name << " is neither a column nor derived here";
    }
  }
};

TEST(Signals, AreWhatTheTraceShows) {
  // Both computations have some 50 roundings of the size of the signal, and they omit products below 2^-53.
  constexpr double bound = 256 * 0x1p-53;
  const auto watched = [&](Board b, double to_s) {
    b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
    b.shaft.coulomb_Nm = 1e-3;
    b.load(0, 0.01);
    auto rig = b.rig();
    AgainstTheTrace against;
    EXPECT_EQ(run_to(rig, to_s, against), sim::Stop::end);
    EXPECT_LE(against.worst, bound) << against.where;
    EXPECT_GT(against.compared, 1000);
    return against;
  };
  std::int64_t high_degrees = 0;
  for (const double flat_deg : {0.0, 120.0, 100.0, 140.0}) {  // 0: a sine
    Board b = Board::duty(0.6, flat_deg == 100.0 ? control::Chopping::hard : control::Chopping::soft);
    if (flat_deg > 0.0)
      b.machine.flat_deg = flat_deg;
    else
      b.machine.back_emf = plant::BackEmf::sine;
    if (flat_deg == 140.0) b.supply = {.V_0_V = 24.0, .R_b_ohm = 0.1, .C_F = 1e-3};
    high_degrees += watched(b, 4e-3).high_degrees;
    b.drive.mode = control::Mode::off;
    for (const double speed : {500.0, -500.0, 900.0}) {  // at 900 rad/s the back-EMF exceeds the bus: diodes
                                                         // conduct
      b.start.speed_rad_s = speed;
      const std::int64_t floating_stars = watched(b, 6e-3).floating_stars;
      if (speed < 900.0) {
        EXPECT_GT(floating_stars, 5) << flat_deg;
      }
    }
  }
  EXPECT_GT(high_degrees, 10) << "segments whose products take two pieces";
}

/// Time, codes and the outputs of a rotor sensor change at edges that do not begin a segment. Segments
/// therefore contain no polynomials for these columns.
TEST(Signals, EveryColumnThatIsACurveHasOne) {
  const std::set<std::string_view> no_curves = {"t_s",           "hall",           "sector",
                                                "encoder_A",     "encoder_B",      "encoder_Z",
                                                "absolute_code", "resolver_cos_V", "resolver_sin_V"};
  for (const Column& column : all_columns()) {
    if (no_curves.contains(column.name)) continue;
    bool found = false;
    for (const auto& [word, signal, meaning, turning] : signal_choices)
      if (word == column.name) {
        found = true;
        EXPECT_EQ(unit_of(signal), column.unit) << word;
      }
    EXPECT_TRUE(found) << column.name;
  }
}

TEST(Signals, WordsAreUnique) {
  for (const auto& a : signal_choices)
    for (const auto& b : signal_choices) EXPECT_TRUE(&a == &b || a.word != b.word) << a.word;
}

Gauge seen(MetricKind kind, double level = 0.0) {
  Measure m;
  m.metric = kind;
  Gauge gauge(m, {0.0, 10.0}, level, 0.0);
  gauge.part({1.0, 2.0}, 1, 0.0, 1.0);  // a line from 1 to 3
  return gauge;
}

TEST(GaugeHolds, OnlyOnTheSideThatCounts) {
  const series::Extremes<double> above{2.0, 4.0}, below{0.0, 2.0}, inside{1.0, 3.0};
  EXPECT_TRUE(seen(MetricKind::maximum).holds([&] { return below; }));
  EXPECT_FALSE(seen(MetricKind::maximum).holds([&] { return above; }));
  EXPECT_TRUE(seen(MetricKind::minimum).holds([&] { return above; }));
  EXPECT_FALSE(seen(MetricKind::minimum).holds([&] { return below; }));
  EXPECT_TRUE(seen(MetricKind::peak_to_peak).holds([&] { return inside; }));
  EXPECT_FALSE(seen(MetricKind::peak_to_peak).holds([&] { return above; }));
  EXPECT_FALSE(seen(MetricKind::peak_to_peak).holds([&] { return below; }));
  EXPECT_TRUE(seen(MetricKind::overshoot, 5.0).holds([&] { return below; }));
  EXPECT_FALSE(seen(MetricKind::overshoot, 5.0).holds([&] { return above; }));
  EXPECT_TRUE(seen(MetricKind::overshoot, -5.0).holds([&] { return above; }));
  EXPECT_FALSE(seen(MetricKind::overshoot, -5.0).holds([&] { return below; }));
}

TEST(GaugeHolds, NeverBeforeTheFirstPartNorForOtherMetrics) {
  Measure m;
  m.metric = MetricKind::maximum;
  EXPECT_FALSE(Gauge(m, {0.0, 1.0}, 0.0, {}).holds([] { return series::Extremes<double>{0.0, 0.0}; }));
  EXPECT_FALSE(seen(MetricKind::mean).holds([] { return series::Extremes<double>{2.0, 2.0}; }));
  EXPECT_FALSE(seen(MetricKind::final_value).holds([] { return series::Extremes<double>{2.0, 2.0}; }));
}

}  // namespace SIXSTEP_TEST_FILE
