// SPDX-License-Identifier: Apache-2.0
// Tests complete drives. Each loop with its inner loops is compared with an explicit simulation, and the
// placed poles are checked. Each warning is tested with a design that must cause it and a design that must
// not.
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/base/angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/loops/margins.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using control::Mode;

MotorModel thesis_motor() {
  MotorModel m;
  m.machine = {.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8};
  m.shaft = {.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6};
  m.K_t_Nm_A = 0.0335;
  m.nominal_voltage_V = 24.0;
  m.no_load_speed_rad_s = 702.67;
  m.stall_torque_Nm = 0.78;
  return m;
}

DriveDesign designed(const DesignSpec& spec) {
  const auto d = design_drive(thesis_motor(), spec);
  EXPECT_TRUE(d);
  return *d;
}

TEST(DriveDesign, PlacesTheThesissPoles) {
  const DriveDesign d = designed({.mode = Mode::speed, .torque_limit_Nm = 0.78});
  ASSERT_EQ(d.loops.size(), 2u);
  EXPECT_NEAR(d.loop("current").gains.d1, 4.0956, 0.5e-4);
  EXPECT_NEAR(d.loop("speed").gains.d1, 0.0158299, 0.5e-7);
  for (const LoopDesign& loop : d.loops) {
    ASSERT_TRUE(loop.placed);
    // At the placed pole, the polynomial (z - 1)(z + a0) + b0 (d1 z + d0) is zero.
    using C = std::complex<double>;
    const C z{loop.placed->z_re, loop.placed->z_im};
    const C value =
        (z - 1.0) * (z + loop.placed->plant.a0) + loop.placed->plant.b0 * (loop.gains.d1 * z + loop.gains.d0);
    EXPECT_LE(std::abs(value), 1e-12);
  }
  // The current loop has placed poles, so its closed-loop denominator is the required polynomial.
  const Polynomial den = closed(d.loop("current").loop).den;
  const PolePlacement& p = *d.loop("current").placed;
  EXPECT_NEAR(den[1], 2 - 2 * p.z_re, 1e-12);  // (z - z1)(z - z2) in powers of z - 1
  EXPECT_NEAR(den[0], (1 - p.z_re) * (1 - p.z_re) + p.z_im * p.z_im, 1e-12);
}

/// An explicit simulation of the cascade, with 50 Runge-Kutta steps per period for the motor's current and
/// speed. The error of the steps is far below the tolerance.
std::vector<double> simulated(const DriveDesign& d, double position_gain, std::size_t count) {
  const double R = 1.03, L = 0.572e-3, K = 0.0335, J = 1.35e-5, B = 7.3e-6, T = d.spec.period_s;
  double i = 0, w = 0, theta = 0, e1 = 0, y = 0, e2 = 0;
  double asked[3] = {0, 0, 0};  // volts: for this sample and for the two before
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) {
    out.push_back(position_gain > 0 ? theta * 180 / 3.14159265358979324 : w);
    const double w_ref = position_gain > 0 ? position_gain * (1 - theta * 180 / 3.14159265358979324) : 1.0;
    const double speed_error = w_ref - w;
    y += d.loop("speed").gains.d1 * speed_error + d.loop("speed").gains.d0 * e1;
    e1 = speed_error;
    const double current_error = y * d.current_at_full_torque_A - i;
    asked[2] = asked[1];
    asked[1] = asked[0];
    asked[0] += d.loop("current").gains.d1 * current_error + d.loop("current").gains.d0 * e2;
    e2 = current_error;
    constexpr int steps = 50;
    for (int n = 0; n < steps; ++n) {
      const double h = T / steps;
      // The sample is in the middle of a period. Until the end of the period, the previous voltage still
      // acts.
      const bool before = d.spec.sampled_in_middle && n < steps / 2;
      const double u = asked[d.spec.delay_periods + (before ? 1 : 0)];
      const auto di = [&](double ii, double ww) { return (u - R * ii - K * ww) / L; };
      const auto dw = [&](double ii, double ww) { return (K * ii - B * ww) / J; };
      const double i1 = di(i, w), w1 = dw(i, w), i2 = di(i + h / 2 * i1, w + h / 2 * w1),
                   w2 = dw(i + h / 2 * i1, w + h / 2 * w1), i3 = di(i + h / 2 * i2, w + h / 2 * w2),
                   w3 = dw(i + h / 2 * i2, w + h / 2 * w2), i4 = di(i + h * i3, w + h * w3),
                   w4 = dw(i + h * i3, w + h * w3);
      theta += h * (w + h / 6 * (w1 + w2 + w3));
      i += h / 6 * (i1 + 2 * i2 + 2 * i3 + i4);
      w += h / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
    }
  }
  return out;
}

TEST(DriveDesign, TheClosedLoopsAreTheCascadeWrittenOut) {
  for (const int late : {0, 1, 2, 3}) {
    const DriveDesign d =
        designed({.mode = Mode::position, .delay_periods = late / 2, .sampled_in_middle = late % 2 == 1});
    const double gain = d.loop("position").gains.d1;
    const std::vector<double> speed = simulated(d, 0.0, 300), position = simulated(d, gain, 300);
    const StepResponse w = step_response(closed(d.loop("speed").loop), d.spec.period_s,
                                         300 * d.spec.period_s),
                       theta = step_response(closed(d.loop("position").loop), d.spec.period_s,
                                             300 * d.spec.period_s);
    // The relative error of Runge-Kutta is (h R/L)^4, 1e-12 per period (step h). It accumulates over 300
    // periods and in the sum of the angle.
    for (std::size_t k = 0; k < 300; ++k) {
      ASSERT_NEAR(w.samples[k], speed[k], 1e-9) << k;
      ASSERT_NEAR(theta.samples[k], position[k], 1e-9) << k;
    }
  }
}

/// Overshoot, in A, of a step of 2 A, from the recurrence i' = a_h (a_h i + b_h u_first) + b_h u_then. The
/// factors a_h and b_h are for half a period. The rotor is locked, and the motor has 1.03 ohm and 0.572 mH;
/// the period is 30 us. The sample is in the middle of a period, so its voltage acts only in the second half
/// of the interval to the next sample.
double overshoot_of_recurrence_A(const PiGains& g, int delay_periods, bool middle) {
  const double a = std::exp(-1.03 * 15e-6 / 0.572e-3), b = (1 - a) / 1.03;
  double i = 0, before = 0, highest = 0, volts[3] = {0, 0, 0};
  for (int k = 0; k < 200; ++k) {
    highest = std::max(highest, i);
    volts[2] = volts[1];
    volts[1] = volts[0];
    volts[0] += g.d1 * (2 - i) + g.d0 * before;
    before = 2 - i;
    const double then = volts[delay_periods], first = volts[delay_periods + (middle ? 1 : 0)];
    i = a * (a * i + b * first) + b * then;
  }
  return highest - 2;
}

TEST(DriveDesign, ASampleInTheMiddleMakesTheLoopHalfAPeriodLater) {
  struct Told {
    int delay_periods;
    bool middle;
    double overshoot_A, settling_s;
  };
  for (const Told& told :
       {Told{1, false, 0.22394, 900e-6}, Told{0, true, 0.18295, 960e-6}, Told{1, true, 0.30846, 870e-6}}) {
    const DriveDesign d = designed(
        {.mode = Mode::current, .delay_periods = told.delay_periods, .sampled_in_middle = told.middle});
    EXPECT_NEAR(2 * d.loops[0].step.overshoot, told.overshoot_A, 1e-5);
    EXPECT_NEAR(2 * d.loops[0].step.overshoot,
                overshoot_of_recurrence_A(d.loops[0].gains, told.delay_periods, told.middle), 1e-12);
    EXPECT_NEAR(d.loops[0].step.settling_s, told.settling_s, 1e-9);
  }
}

/// At the crossover frequency w, a delay reduces the phase by w times the delay, and w is nearly the same.
/// Half a period of delay therefore costs half as much phase as a whole period.
TEST(DriveDesign, HalfAPeriodCostsHalfThePhaseOfOne) {
  const DriveDesign start = designed({.mode = Mode::current, .delay_periods = 1});
  const DriveDesign middle = designed({.mode = Mode::current, .delay_periods = 1, .sampled_in_middle = true});
  const LoopDesign &s = start.loops[0], &m = middle.loops[0];
  const double half = *s.figures.crossover_rad_s * start.spec.period_s / 2;
  EXPECT_NEAR(*start.later(s).phase_rad - *middle.later(m).phase_rad, half, 0.04 * half);
  EXPECT_NEAR(*start.sooner(s).phase_rad - *middle.sooner(m).phase_rad, half, 0.04 * half);
  EXPECT_EQ(late_words(middle.spec.late_periods()), "1.5 periods late");
  EXPECT_EQ(late_words(middle.spec.sooner_periods()), "half a period late");
  // With the longest period that the design reports, the phase margin is 45 degrees. This holds for samples
  // in the middle of a period and at its start.
  const DriveDesign longest = designed({.mode = Mode::current,
                                        .period_s = middle.longest_period_s,
                                        .delay_periods = 1,
                                        .sampled_in_middle = true});
  EXPECT_NEAR(*longest.loops[0].figures.phase_rad, base::pi / 4, 1e-3);
  EXPECT_LT(middle.longest_period_s, start.longest_period_s);
}

/// With hard chopping, a change of the duty has twice the effect on the voltage. Half the gains therefore
/// give the same loops, for each rule.
TEST(DriveDesign, HardChoppingTakesHalfTheGains) {
  for (const GainMethod method :
       {GainMethod::pole_placement, GainMethod::cancellation, GainMethod::symmetrical_optimum}) {
    DesignSpec spec{.mode = Mode::speed, .method = method, .delay_periods = 1};
    const DriveDesign soft = designed(spec);
    spec.chopping = control::Chopping::hard;
    const DriveDesign hard = designed(spec);
    EXPECT_EQ(hard.loops[0].gains.d1, soft.loops[0].gains.d1 / 2);
    EXPECT_EQ(hard.loops[0].gains.d0, soft.loops[0].gains.d0 / 2);
    EXPECT_EQ(hard.loops[1].gains.d1, soft.loops[1].gains.d1);
    for (const std::size_t n : {0u, 1u}) {
      EXPECT_DOUBLE_EQ(*hard.loops[n].figures.phase_rad, *soft.loops[n].figures.phase_rad);
      EXPECT_DOUBLE_EQ(*hard.loops[n].figures.gain, *soft.loops[n].figures.gain);
    }
    EXPECT_DOUBLE_EQ(hard.longest_period_s, soft.longest_period_s);
  }
}

TEST(DriveDesign, TheInnerLoopCostsPhase) {
  const DriveDesign d = designed({.mode = Mode::speed});
  const PolePlacement& p = *d.loop("speed").placed;
  const auto alone = margins(p.plant, p.gains, p.period_s, false);
  ASSERT_TRUE(alone && d.loop("speed").figures.phase_rad);
  EXPECT_LT(*d.loop("speed").figures.phase_rad, alone->phase_rad);
  EXPECT_GT(*d.loop("speed").figures.phase_rad, alone->phase_rad - 0.3);
}

TEST(DriveDesign, TheLinearPositionGainIsTheLargestWithoutOvershoot) {
  const DriveDesign d = designed({.mode = Mode::position});
  EXPECT_LE(d.loop("position").step.overshoot, 1e-9);
  EXPECT_GT(with_position_gain(d, 1.02 * d.loop("position").gains.d1).loop("position").step.overshoot, 1e-9);
}

TEST(DriveDesign, TheLongestPeriodKeepsFortyFiveDegrees) {
  const DriveDesign d = designed({.mode = Mode::current});
  const DriveDesign at =
      designed({.mode = Mode::current, .period_s = d.longest_period_s, .delay_periods = 1});
  EXPECT_NEAR(*at.loop("current").figures.phase_rad * 180 / 3.14159265358979, 45.0, 1e-6);
}

TEST(DriveDesign, EachMethodGivesAStableDrive) {
  for (const GainMethod method :
       {GainMethod::pole_placement, GainMethod::cancellation, GainMethod::symmetrical_optimum}) {
    const DriveDesign d = designed({.mode = Mode::speed, .method = method});
    for (const LoopDesign& loop : d.loops) {
      EXPECT_TRUE(loop.figures.stable) << loop.method;
      EXPECT_TRUE(std::isfinite(loop.step.settling_s)) << loop.method;
    }
  }
  const DriveDesign d = designed({.mode = Mode::current, .method = GainMethod::cancellation});
  EXPECT_LE(d.loop("current").step.overshoot, 1e-12);  // a single pole
}

bool warns(const DriveDesign& d, const std::string& of) {
  for (const Warning& w : d.warnings)
    if (w.what.find(of) != std::string::npos) return true;
  return false;
}

/// A loop with a small phase margin is not usable. At the crossover, |1 + L| is 2 sin(phase margin/2). At 20
/// degrees, the loop amplifies disturbances 2.9 times.
TEST(DriveDesign, LittlePhaseIsGrave) {
  int usable = 0, unusable = 0;
  for (double settle_s = 0.15e-3; settle_s < 0.5e-3; settle_s *= 1.03) {
    const DriveDesign d = designed({.mode = Mode::current, .settle_s = settle_s, .delay_periods = 1});
    const LoopFigures& f = d.loop("current").figures;
    if (!f.stable || !f.phase_rad) continue;
    const double phase_deg = *f.phase_rad * 180 / base::pi;
    EXPECT_GE(f.sensitivity_peak * (1 + 1e-3), 1 / (2 * std::sin(*f.phase_rad / 2))) << settle_s;
    bool grave = false;
    for (const Warning& w : d.warnings) grave = grave || (w.grave && w.of == Concern::delay);
    EXPECT_EQ(grave, phase_deg < 20) << settle_s << ": " << phase_deg;
    ++(phase_deg < 20 ? unusable : usable);
  }
  EXPECT_GT(usable, 5);
  EXPECT_GT(unusable, 5);
}

TEST(DriveDesign, WarnsOfWhatIsOffAndOfNothingElse) {
  const DriveDesign good = designed({.mode = Mode::current, .chopping = control::Chopping::complementary});
  ASSERT_EQ(good.warnings.size(), 1u);
  EXPECT_TRUE(warns(good, "the sheet names no nominal current"));
  EXPECT_FALSE(good.warnings[0].grave);
  EXPECT_TRUE(warns(designed({.mode = Mode::current}), "soft chopping cannot limit the braking current"));
  EXPECT_TRUE(
      warns(designed({.mode = Mode::current, .settle_s = 0.3e-3, .delay_periods = 1}), "phase margin of"));
  EXPECT_TRUE(
      warns(designed({.mode = Mode::current, .settle_s = 0.1e-3, .delay_periods = 1}), "loop is unstable"));
  EXPECT_TRUE(warns(designed({.mode = Mode::speed, .settle_s = 10e-3, .current_settle_s = 8e-3}),
                    "times the frequency"));
  EXPECT_TRUE(warns(designed({.mode = Mode::current, .settle_s = 0.25e-3}), "is designed to settle within"));
  EXPECT_TRUE(warns(designed({.mode = Mode::current, .period_s = 60e-6}), "ripple"));
  // A current ripple above the nominal current causes a grave warning. The proposed chokes reduce the ripple
  // to a fifth, even with a very small L/R.
  for (const double period_s : {10e-6, 1e-3}) {
    MotorModel bare = thesis_motor();
    bare.machine.L_H /= 40;
    const DesignSpec hurried{.mode = Mode::current, .period_s = period_s};
    const auto rippled = design_drive(bare, hurried);
    ASSERT_TRUE(rippled);
    ASSERT_GT(rippled->ripple.worst_A, rippled->nominal_current_A);
    for (const Warning& w : rippled->warnings)
      if (w.of == Concern::ripple)
        bare.machine.L_H += 1e-3 * std::stod(w.what.substr(w.what.find("choke of ") + 9));
    const auto choked = design_drive(bare, hurried);
    ASSERT_TRUE(choked);
    EXPECT_NEAR(choked->ripple.worst_A, 0.2 * choked->nominal_current_A, 0.005 * choked->nominal_current_A);
  }
  EXPECT_TRUE(warns(designed({.mode = Mode::speed}), "names no nominal current"));
  MotorModel printed = thesis_motor();
  printed.nominal_current_A = 2.33;
  EXPECT_FALSE(warns(*design_drive(printed, {.mode = Mode::speed}), "nominal current:"));
  EXPECT_TRUE(warns(*design_drive(printed, {.mode = Mode::speed, .torque_limit_Nm = 0.78}),
                    "times the nominal current"));
}

TEST(DriveDesign, AsksForWhatTheMotorStandsWhereNobodySaid) {
  MotorModel motor = thesis_motor();
  motor.nominal_current_A = 2.33;
  EXPECT_DOUBLE_EQ(design_drive(motor, {.mode = Mode::speed})->current_at_full_torque_A, 2.5 * 2.33);
  // If the sheet states no nominal current, the design uses a tenth of the stall current, 24/1.03/10 A. The
  // result says that this current is not from the sheet.
  const auto silent = design_drive(thesis_motor(), {.mode = Mode::speed});
  EXPECT_FALSE(silent->nominal_printed);
  EXPECT_DOUBLE_EQ(silent->current_at_full_torque_A, 2.5 * 24 / 1.03 / 10);
  // The current at full torque is at most the current of the whole bus voltage through the locked rotor.
  motor.nominal_current_A = 20.0;
  EXPECT_DOUBLE_EQ(design_drive(motor, {.mode = Mode::speed})->current_at_full_torque_A, 24 / 1.03);
}

DesignSpec on_hall_probes(int edges, double settle_s) {
  return {.mode = Mode::speed,
          .settle_s = settle_s,
          .delay_periods = 1,
          .rotor = {.hall = true, .edges = edges},
          .lowest_speed_rad_s = 100.0};
}

TEST(DriveDesign, TakesNoFasterSpeedLoopThanItsSensorStands) {
  DesignSpec open = on_hall_probes(6, 1.0);
  open.settle_s.reset();
  const DriveDesign slow = designed(open);
  open.rotor.edges = 1;
  const DriveDesign quick = designed(open);
  // At 100 rad/s, the delay is 3.5 sectors of 1.309 ms with six edges, and one sector with one edge. The
  // ratio of the settling times is also 3.5, apart from the effect of the current loop.
  EXPECT_NEAR(slow.lag.delay_s(), 3.5 * base::pi / 3 / 8 / 100, 1e-12);
  EXPECT_NEAR(quick.lag.delay_s(), base::pi / 3 / 8 / 100, 1e-12);
  EXPECT_NEAR(*slow.spec.settle_s / *quick.spec.settle_s, 3.5, 0.35);
  for (const DriveDesign* d : {&slow, &quick}) {
    EXPECT_GE(*d->loop("speed").built.phase_rad * 180 / base::pi, 45.0);
    EXPECT_LE(*d->loop("speed").built.phase_rad * 180 / base::pi, 47.0);  // rounded up to two digits
    EXPECT_FALSE(warns(*d, "rad/s, where a speed from Hall edges"));
  }
  EXPECT_TRUE(warns(designed(on_hall_probes(6, 60e-3)), ", at 100 rad/s, where"));
  EXPECT_TRUE(warns(designed(on_hall_probes(6, 10e-3)), "the speed loop is unstable at 100 rad/s"));
  EXPECT_FALSE(warns(designed({.mode = Mode::speed}), "Hall"));
}

/// If the sensor makes a loop unstable, the overshoot is infinite and is not printed.
TEST(DriveDesign, AnUnstableLoopIsCalledSo) {
  DesignSpec spec = on_hall_probes(1, 10e-3);
  spec.settle_s.reset();
  spec.method = GainMethod::symmetrical_optimum;
  const DriveDesign d = designed(spec);
  ASSERT_FALSE(d.loop("speed").built.stable);
  EXPECT_TRUE(warns(d, "the speed loop is unstable at 100 rad/s"));
  for (const Warning& w : d.warnings) EXPECT_EQ(w.what.find("inf"), std::string::npos) << w.what;
}

/// The largest torque T_max changes the speed of the inertia J by half the lowest speed w_low in the time J
/// w_low/(2 T_max). The default settling time is 1.5 times this time. With a small inertia, it is the
/// thesis's 10 ms.
TEST(DriveDesign, IsNoFasterThanTorqueAndInertiaAllow) {
  for (const double load_kg_m2 : {0.0, 1e-4, 1e-3, 1e-2}) {
    const DriveDesign d = designed({.mode = Mode::speed, .load_inertia_kg_m2 = load_kg_m2});
    const double soonest = (1.35e-5 + load_kg_m2) * d.lowest_speed_rad_s / 2 / d.torque_limit_Nm;
    EXPECT_NEAR(d.settle_by_torque_s / soonest, 1.5, 1e-12);
    EXPECT_GE(*d.spec.settle_s, 1.5 * soonest);
    EXPECT_LE(*d.spec.settle_s, std::max(10e-3, 1.6 * soonest)) << "two digits, upwards";
  }
  EXPECT_EQ(*designed({.mode = Mode::speed, .settle_s = 5e-3, .load_inertia_kg_m2 = 1e-3}).spec.settle_s,
            5e-3)
      << "what somebody asks for stays";
}

/// 1.2 times the lowest speed must be below 0.9 (U - R I)/(K_t + 3.6 p L_s I/pi) (symbols of model.md). The
/// current I is half the current at the torque limit or half the nominal current, plus the current of
/// friction.
TEST(DriveDesign, RefusesALowestSpeedWithoutRoomAboveIt) {
  MotorModel motor = thesis_motor();
  motor.nominal_current_A = 2.33;
  const double I = 2.33 / 2 + motor.shaft.B_Nm_s * 24 / (0.0335 * 0.0335);
  const double top = 0.9 * (24 - 1.03 * I) / (0.0335 + 3.6 * 8 * motor.machine.L_H * I / base::pi);
  DesignSpec spec = on_hall_probes(0, 20e-3);
  spec.lowest_speed_rad_s = std::floor(top / 1.2 / 10) * 10;  // two digits
  EXPECT_TRUE(design_drive(motor, spec));
  *spec.lowest_speed_rad_s += 1;
  const auto refused = design_drive(motor, spec);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      to_string(refused.problems()[0]),
      "lowest_speed_rad_s = 451 is too high for the test, a step from 1.2 times this speed down to this speed; this bus allows at most 450 rad/s; lower this value, or give a higher voltage_V");
  spec.voltage_V = 30;
  EXPECT_TRUE(design_drive(motor, spec)) << "the cure";
}

TEST(DriveDesign, TellsWhatEachWayOfSensingAllows) {
  const DriveDesign d = designed(on_hall_probes(0, 0.1));
  ASSERT_EQ(d.limits.size(), 9u);
  for (std::size_t n = 0; n < 9; ++n) {
    ASSERT_TRUE(d.limits[n].settle_s);
    EXPECT_DOUBLE_EQ(d.limits[n].lowest_speed_rad_s, (n % 3 == 0 ? 1.0 : n % 3 == 1 ? 2.0 : 5.0) * 100.0);
    if (n % 3 > 0) {
      EXPECT_LT(*d.limits[n].settle_s, *d.limits[n - 1].settle_s);  // faster at a higher speed
    }
    if (n >= 3 && n < 6) {
      EXPECT_GT(*d.limits[n].settle_s, *d.limits[n - 3].settle_s);  // six edges instead of one edge
    }
  }
}

TEST(DriveDesign, NamesOptionsThatContradict) {
  const auto refused = [](const DesignSpec& spec) {
    const auto d = design_drive(thesis_motor(), spec);
    return d ? std::string() : to_string(d.problems()[0]);
  };
  EXPECT_EQ(
      refused({.method = GainMethod::symmetrical_optimum}),
      "method = symmetrical-optimum applies to speed loops only; add mode = speed, or use pole-placement or cancellation");
  EXPECT_EQ(refused({.settle_s = -1.0}), "settle_s = -1 must be above 0; give the settling time in seconds");
  EXPECT_NE(refused({.bandwidth_rad_s = 100.0}), "");
  EXPECT_NE(refused({.damping = 1.5}), "");
}

}  // namespace SIXSTEP_TEST_FILE
