// SPDX-License-Identifier: Apache-2.0
// Tests the duty step at a commutation on the switching motor. With an unchanged duty, theory predicts a
// current dip. The step must remove this dip, and must reduce the torque ripple of a drive with a current
// loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sixstep/study/check/check.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using control::PwmPattern;
using study::CurrentCommutation;
using study::MetricKind;
using study::Scenario;
using study::Signal;

constexpr double K_t = 33.5e-3, R = 0.515, L = 0.286e-3, U = 24.0;  // per phase, of maxon_sheet()

/// An external drive turns the motor. The chopping is complementary.
Scenario turned(CurrentCommutation commutation, PwmPattern pattern, double speed_rad_s, double current_A) {
  Scenario s = maxon_scenario(Mode::current, current_A);
  s.pwm.chopping = control::Chopping::complementary;
  s.pwm.pattern = pattern;
  s.load.dynamometer_times_s = {0.0};
  s.load.dynamometer_rad_s = {speed_rad_s};
  s.control.current.commutation = commutation;
  return s;
}

void ask_torque(Scenario& s, MetricKind metric, double from_s) {
  study::Measure figure = measure(metric, Signal::torque);
  figure.from_s = from_s;
  ask(s, figure);
}

/// Current, in A, of the staying phase at the instant when the leaving phase's current reaches zero. E is the
/// back-EMF of a phase, I is the current before the commutation, and u is the voltage between the entering
/// and the staying phase (model.md 1). The leaving terminal is at the lower rail.
double after_commutation_A(double E, double I, double u) {
  const double leaving = (u + 2 * E) / (3 * R), staying = (4 * E - u) / (3 * R);
  const double faded = leaving / (leaving + I);  // exp(-t R/L) when the leaving current is zero
  return (I + staying) * faded - staying;
}

/// The smallest current at the first commutation after the start. The loop has settled before this
/// commutation, and its duty is constant from then on.
double least_current_A(CurrentCommutation commutation, PwmPattern pattern, double speed_rad_s,
                       double current_A) {
  Scenario s = turned(commutation, pattern, speed_rad_s, current_A);
  const double sector_s = base::sector_rad / (8 * speed_rad_s);
  s.sheet.flat_deg = 170;  // the flat tops last longer than the leaving phase's decay
  s.pwm.period_s = 0.5e-6;
  s.control.current.settle_s = 0.3 * sector_s;
  s.duration_s = 1.9 * sector_s;
  study::At frozen;
  frozen.time_s = 0.95 * sector_s;
  frozen.control.current.d1 = 1e-9;
  frozen.control.current.d0 = 0.0;
  s.at = {frozen};
  ask_torque(s, MetricKind::minimum, 0.97 * sector_s);
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? out->comparisons[0].measured / K_t : 0.0;
}

TEST(CommutationStep, LeavesNothingOfTheDipThatTheoryForetells) {
  for (const double speed_rad_s : {60.0, 150.0, 250.0})
    for (const double current_A : {1.0, 3.0})
      for (const PwmPattern pattern : {PwmPattern::pwm_on, PwmPattern::upper}) {
        const double E = K_t * speed_rad_s / 2, ripple_A = U * 0.5e-6 / (4 * L);
        const double foretold =
            after_commutation_A(E, current_A, 2 * E + 2 * R * current_A);  // the pair's duty, unchanged
        SCOPED_TRACE(::testing::Message() << speed_rad_s << " rad/s, " << current_A << " A");
        EXPECT_LT(foretold, 0.75 * current_A);
        EXPECT_NEAR(least_current_A(CurrentCommutation::plain, PwmPattern::pwm_on, speed_rad_s, current_A),
                    foretold, ripple_A + 0.01 * current_A);
        EXPECT_NEAR(least_current_A(CurrentCommutation::duty_step, pattern, speed_rad_s, current_A),
                    current_A, ripple_A + 0.01 * current_A);
      }
}

/// If 4 E + 3 R I exceeds the bus voltage U, even full duty is too small (back-EMF E, current I). Overlapping
/// then keeps the current.
TEST(CommutationStep, OverlappingHoldsWhatAWholeDutyDoesNot) {
  for (const double speed_rad_s : {370.0, 430.0})
    for (const PwmPattern pattern : {PwmPattern::pwm_on, PwmPattern::upper, PwmPattern::on_pwm}) {
      const double E = K_t * speed_rad_s / 2, current_A = 3.0, ripple_A = U * 0.5e-6 / (4 * L);
      ASSERT_GT(4 * E + 3 * R * current_A, U);
      SCOPED_TRACE(::testing::Message() << speed_rad_s << " rad/s, pattern " << static_cast<int>(pattern));
      EXPECT_NEAR(least_current_A(CurrentCommutation::duty_step, pattern, speed_rad_s, current_A),
                  after_commutation_A(E, current_A, U), ripple_A + 0.01 * current_A);
      EXPECT_NEAR(least_current_A(CurrentCommutation::overlap, pattern, speed_rad_s, current_A), current_A,
                  ripple_A + 0.01 * current_A);
    }
}

/// The torque ripple of a drive with its current loop at the usual period.
double ripple_Nm(CurrentCommutation commutation, PwmPattern pattern, double speed_rad_s, double current_A,
                 int delay_periods, study::Arithmetic arithmetic = study::Arithmetic::float64) {
  Scenario s = turned(commutation, pattern, speed_rad_s, current_A);
  s.control.arithmetic = arithmetic;
  s.pwm.delay_periods = delay_periods;
  ask_torque(s, MetricKind::ripple_rms, 5e-3);
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? out->comparisons[0].measured : 0.0;
}

/// At speeds at which full duty is too small, overlapping also reduces the torque ripple with the current
/// loop. The bus voltage limits this effect.
TEST(CommutationStep, OverlappingTakesOnWhereADutyIsTooLittle) {
  for (const double speed_rad_s : {350.0, -400.0, 450.0, -500.0})
    for (const int delay_periods : {0, 1}) {
      const auto ripple = [&](CurrentCommutation commutation) {
        return ripple_Nm(commutation, PwmPattern::pwm_on, speed_rad_s, std::copysign(3.0, speed_rad_s),
                         delay_periods);
      };
      SCOPED_TRACE(::testing::Message() << speed_rad_s << " rad/s, " << delay_periods << " late");
      EXPECT_LT(ripple(CurrentCommutation::overlap), 0.85 * ripple(CurrentCommutation::duty_step));
      EXPECT_LT(ripple(CurrentCommutation::overlap),
                (delay_periods == 1 ? 0.75 : 0.85) * ripple(CurrentCommutation::plain));
    }
}

/// The step reduces the ripple if a commutation lasts several periods. If a commutation lasts one period, the
/// ripple is about equal. For a braked motor, the step changes nothing.
TEST(CommutationStep, HalvesTheRippleBehindTheLoop) {
  using enum PwmPattern;
  for (const double speed_rad_s : {50.0, -150.0, 300.0})
    for (const PwmPattern pattern : {upper, lower, pwm_on, on_pwm, pwm_on_pwm})
      for (const int delay_periods : {0, 1}) {
        const auto part_left = [&](double current_A) {
          return ripple_Nm(CurrentCommutation::duty_step, pattern, speed_rad_s, current_A, delay_periods) /
                 ripple_Nm(CurrentCommutation::plain, pattern, speed_rad_s, current_A, delay_periods);
        };
        SCOPED_TRACE(::testing::Message() << speed_rad_s << " rad/s, pattern " << static_cast<int>(pattern)
                                          << ", " << delay_periods << " late");
        EXPECT_LT(part_left(std::copysign(3.0, speed_rad_s)), delay_periods == 1 ? 0.6 : 0.76);
        EXPECT_LT(part_left(std::copysign(1.0, speed_rad_s)), 1.15);
        EXPECT_EQ(part_left(std::copysign(3.0, -speed_rad_s)), 1.0);
      }
}

/// The torque ripple in the chip's arithmetic is compared with the ripple in double. The bound is the torque
/// of 0.02 A.
TEST(CommutationStep, InTheNumbersOfAChip) {
  for (const study::Arithmetic arithmetic :
       {study::Arithmetic::float32, study::Arithmetic::q15, study::Arithmetic::q31})
    EXPECT_NEAR(ripple_Nm(CurrentCommutation::duty_step, PwmPattern::pwm_on, 150.0, 3.0, 1, arithmetic),
                ripple_Nm(CurrentCommutation::duty_step, PwmPattern::pwm_on, 150.0, 3.0, 1), 0.02 * K_t);
}

/// The remark is printed exactly if the bits of the run are equal to the run without a step. The current of
/// the leaving phase lasts at most L I/u, with u = 2 E + 3 R I/2 (back-EMF E, current I). The drive applies
/// no step if this time is shorter than the command's delay, or if the motor is braked or at rest.
TEST(CommutationStep, TellsARunInWhichItNeverActs) {
  for (const double speed_rad_s : {0.0, 60.0, 300.0})
    for (const double current_A : {0.5, 3.0, -3.0})
      for (const double period_s : {10e-6, 30e-6, 60e-6}) {
        const auto of = [&](CurrentCommutation commutation) {
          Scenario s = turned(commutation, PwmPattern::pwm_on, speed_rad_s, current_A);
          s.pwm.period_s = period_s;
          s.control.current.settle_s = 40 * period_s;
          s.duration_s = 20e-3;
          const auto out = study::run(s);
          if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
          return std::pair{out ? out->digest : 0,
                           out && std::any_of(out->remarks.begin(), out->remarks.end(), [](const auto& text) {
                             return text.find("\"duty-step\" has no effect in this run") != text.npos;
                           })};
        };
        SCOPED_TRACE(::testing::Message() << speed_rad_s << " rad/s, " << current_A << " A, " << period_s);
        const auto [digest, told] = of(CurrentCommutation::duty_step);
        EXPECT_EQ(told, digest == of(CurrentCommutation::plain).first);
        const double lasts_s = L * current_A / (K_t * speed_rad_s + 1.5 * R * current_A);
        const bool never = speed_rad_s == 0 || current_A < 0 || lasts_s < 0.4 * period_s;
        const bool acts = speed_rad_s > 0 && current_A > 0 && lasts_s > 0.7 * period_s;
        EXPECT_TRUE(told || !never);
        EXPECT_FALSE(told && acts);
      }
}

/// If the pattern chops the staying leg, the current has a larger peak and a deeper dip than with PWM-ON. A
/// remark states this.
TEST(CommutationStep, TellsAPatternThatChopsTheStayingLeg) {
  struct Seen {
    double least_Nm, most_A;
    bool told;
  };
  const auto seen = [](CurrentCommutation commutation, PwmPattern pattern, double speed_rad_s) {
    Scenario s = turned(commutation, pattern, speed_rad_s, 3.0);
    s.pwm.delay_periods = 1;
    s.duration_s = 40e-3;
    ask_torque(s, MetricKind::minimum, 5e-3);
    study::Measure peak = measure(MetricKind::maximum, Signal::current_magnitude);
    peak.from_s = 5e-3;
    ask(s, peak);
    const auto out = study::run(s);
    if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
    if (!out) return Seen{};
    return Seen{out->comparisons[0].measured, out->comparisons[1].measured,
                std::any_of(out->remarks.begin(), out->remarks.end(), [](const auto& text) {
                  return text.find("a larger current peak") != text.npos;
                })};
  };
  for (const double speed_rad_s : {40.0, 150.0}) {
    const Seen best = seen(CurrentCommutation::duty_step, PwmPattern::pwm_on, speed_rad_s);
    EXPECT_FALSE(best.told);
    EXPECT_FALSE(seen(CurrentCommutation::duty_step, PwmPattern::pwm_on_pwm, speed_rad_s).told);
    EXPECT_FALSE(seen(CurrentCommutation::plain, PwmPattern::upper, speed_rad_s).told);
    for (const PwmPattern pattern : {PwmPattern::upper, PwmPattern::lower, PwmPattern::on_pwm}) {
      const Seen other = seen(CurrentCommutation::duty_step, pattern, speed_rad_s);
      EXPECT_TRUE(other.told);
      EXPECT_GT(other.most_A, best.most_A + 0.1);
      EXPECT_LT(other.least_Nm, best.least_Nm - 0.1 * K_t * 3.0);
    }
  }
}

/// If the overlap is longer than a sector, the torque is lower than with the duty step. The speed limit
/// follows from the voltage that reduces the leaving current, U - 2 E - 3 R I/2. Above this speed, the run
/// has a remark.
TEST(CommutationStep, AnOverlapLongerThanASectorLowersTheTorqueAndIsTold) {
  const double current_A = 5.0;
  const double limit_rad_s = (U - 1.5 * R * current_A) / (8 * L * current_A / base::sector_rad + K_t);
  for (const double part : {0.85, 0.94, 1.04, 1.1}) {
    const auto seen = [&](CurrentCommutation commutation) {
      Scenario s = turned(commutation, PwmPattern::pwm_on, part * limit_rad_s, current_A);
      s.duration_s = 30e-3;
      ask_torque(s, MetricKind::mean, 10e-3);
      const auto out = study::run(s);
      EXPECT_TRUE(out) << (out ? "" : to_string(out.problems()[0]));
      const bool told = out && std::any_of(out->remarks.begin(), out->remarks.end(), [](const auto& text) {
                          return text.find("\"overlap\" lowers the torque when") != text.npos;
                        });
      return std::pair(out ? out->comparisons[0].measured : 0.0, told);
    };
    const auto [overlapped_Nm, told] = seen(CurrentCommutation::overlap);
    const auto [stepped_Nm, never] = seen(CurrentCommutation::duty_step);
    EXPECT_EQ(told, part > 1) << part;
    EXPECT_FALSE(never);
    if (told)
      EXPECT_LT(overlapped_Nm, 0.95 * stepped_Nm) << part;
    else
      EXPECT_GT(overlapped_Nm, 0.97 * stepped_Nm) << part;
  }
}

/// If the duty is 1 with and without the duty step, the bits are the same, and a remark says so for each
/// pattern. At a lower speed, the step has an effect.
TEST(CommutationStep, IsIdleWhereTheDutyIsOneAnyway) {
  for (const PwmPattern pattern : {PwmPattern::pwm_on, PwmPattern::upper})
    for (const double speed_rad_s : {200.0, 640.0}) {
      const auto seen = [&](CurrentCommutation commutation) {
        Scenario s = turned(commutation, pattern, speed_rad_s, 5.0);
        const auto out = study::run(s);
        EXPECT_TRUE(out) << (out ? "" : to_string(out.problems()[0]));
        return out ? *out : study::Outcome{};
      };
      const study::Outcome with = seen(CurrentCommutation::duty_step);
      const auto has = [&with](const char* words) {
        return std::any_of(with.remarks.begin(), with.remarks.end(),
                           [words](const auto& text) { return text.find(words) != text.npos; });
      };
      const bool idle = with.digest == seen(CurrentCommutation::plain).digest;
      EXPECT_EQ(idle, speed_rad_s > 400) << speed_rad_s;
      EXPECT_EQ(has("has no effect in this run"), idle);
      EXPECT_EQ(has("a larger current peak"), !idle && pattern == PwmPattern::upper);
    }
}

/// A scenario is refused if its drive does not compute a duty or does not drive a pair.
TEST(CommutationStep, IsRefusedWhereNothingHolds) {
  const auto told = [](const Scenario& s) {
    const base::Problems problems = study::check(s);
    return problems.size() == 1 ? problems[0].where : std::to_string(problems.size()) + " problems";
  };
  Scenario s = turned(CurrentCommutation::duty_step, PwmPattern::upper, 150.0, 3.0);
  EXPECT_EQ(told(s), "0 problems");
  s.pwm.chopping = control::Chopping::hard;
  EXPECT_EQ(told(s), "control.current.commutation");
  s.pwm.chopping = control::Chopping::soft;
  s.control.current.type = study::CurrentLoopType::hysteresis;
  EXPECT_EQ(told(s), "control.current.commutation");
  s.control.current.type = study::CurrentLoopType::deadbeat;
  EXPECT_EQ(told(s), "control.current.commutation");
}

}  // namespace SIXSTEP_TEST_FILE
