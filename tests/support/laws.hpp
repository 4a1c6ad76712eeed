// SPDX-License-Identifier: Apache-2.0
// An observer that checks the laws of model.md 5, which apply to every run, for any system with a plant. It
// checks instants within the segments, not only their ends.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sixstep/plant/general/audit.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::testing {

/// The energy balance of the kernel with which the run is simulated.
template <class Real>
struct BooksOfEither {
  plant::Audit<Real> lean;
  plant::general::Audit<Real> general;
  bool on_general = false;
  void segment(const plant::Plant<Real>& p, Real s) { lean.segment(p, s); }
  void segment(const plant::general::Plant<Real>& p, Real s) {
    on_general = true;
    general.segment(p, s);
  }
  plant::EnergyBook energy() const { return on_general ? general.energy() : lean.energy(); }
};

template <class Real = double>
class LawChecker {
 public:
  template <class System>
  void segment(const System& system, Real s) {
    audit_.segment(system.plant(), s);
    const auto& p = system.plant();
    if (system.now() < last_) time_went_back_ = true;
    last_ = system.now();
    amp_scale_ = static_cast<double>(p.constants().amp_scale);
    volt_scale_ = static_cast<double>(p.constants().volt_scale);
    speed_scale_ = static_cast<double>(p.constants().speed_scale);
    inductance_ = 1 / static_cast<double>(p.constants().inv_L);
    if (segments_ > 0) join(p);
    stray_W_ = 0;
    for (const double part : {0.0, 0.23, 0.5, 0.81, 1.0}) look(p, s * static_cast<Real>(part));
    stray_J_ += stray_W_ * static_cast<double>(p.expansion().h * s);
    end_ = p.at(s);
    ++segments_;
  }

  const plant::Audit<Real>& audit() const { return audit_.lean; }
  double highest_current_A() const { return highest_current_; }
  /// Counts how often a free shaft stopped abruptly because a clamp gripped it and released it at one
  /// instant.
  int stops() const { return stops_; }

  /// A law, and the largest deviation of the run from the law, divided by the allowed deviation.
  struct Used {
    const char* law;
    double part;
  };

  /// Deviations that rounding causes, divided by their limits:
  /// - Sums are exact by construction.
  /// - Diodes and rails may deviate by twice the noise of the guards, 64 eps of scale, times the widening
  ///   factor of the mode. The factor of two is needed because the evaluation has the same noise.
  /// - Currents and speed may deviate by the same amount from one segment to the next.
  /// - The energy balances to 1e-11 after the energy of these steps has been added. A step d of a current i
  ///   changes the energy by L i d. If i is far below the scale, this is large compared with the energy so
  ///   far.
  /// - Within a segment, a current is rounded by some eps of the scale (8, as in the sum of the currents). L
  ///   i times this rounding is also allowed.
  /// - The sum of three currents has a rounding error. This error times the bus voltage is also allowed as
  ///   energy.
  std::array<Used, 9> used(double energy_tolerance = 1e-11) const {
    const plant::EnergyBook book = audit_.energy();
    const double rounded_A = 8 * 0x1p-52 * amp_scale_;
    const double rounded_J = 2 * inductance_ * highest_current_ * rounded_A;  // two legs carry the current
    return {{{"currents sum to zero", current_sum_ / rounded_A},
             {"a floating leg carries nothing", floating_current_ == 0.0 ? 0.0 : 2.0},
             {"no diode conducts backwards", reverse_diode_},
             {"a floating terminal lies between the rails", beyond_rail_},
             {"no current jumps", current_step_ / (noise * amp_scale_)},
             {"no speed jumps", speed_step_ / (noise * speed_scale_)},
             {"time does not go back", time_went_back_ ? 2.0 : 0.0},
             {"electrical energy balances", std::fabs(book.electrical_residual + stepped_ / book.scale) /
                                                (energy_tolerance + (rounded_J + stray_J_) / book.scale)},
             {"mechanical energy balances", std::fabs(book.mechanical_residual) / energy_tolerance}}};
  }
  void expect_all(double energy_tolerance = 1e-11) const {
    EXPECT_GT(segments_, 0);
    EXPECT_EQ(stops_, 0);
    for (const Used& u : used(energy_tolerance)) EXPECT_LE(u.part, 1.0) << u.law;
  }

 private:
  static constexpr double noise = 128 * 0x1p-52;

  /// Raises `worst` to v if v is larger. If `worst` is NaN, it remains NaN.
  static void raise(double& worst, double v) {
    if (!(v <= worst) && worst == worst) worst = v;
  }
  /// Checks that the steps of currents and speed between two segments are not larger than rounding. A clamp
  /// may stop the shaft.
  void join(const auto& p) {
    const plant::Snapshot<Real> now = p.at(Real(0));
    const auto d = [](Real v) { return static_cast<double>(v); };
    for (int k = 0; k < 3; ++k) {
      const Real step = now.i[k] - end_.i[k];
      raise(current_step_, std::fabs(d(step)));
      stepped_ += d(step * (now.i[k] + end_.i[k]) / (2 * p.constants().inv_L));
    }
    const double speed_step = std::fabs(d(now.speed - end_.speed));
    if (p.mode().motion == plant::Motion::locked) return;
    if (now.speed == 0 && speed_step > noise * speed_scale_)
      ++stops_;
    else
      raise(speed_step_, speed_step);
  }

  void look(const auto& p, Real s) {
    const plant::Snapshot<Real> now = p.at(s);
    const auto d = [](Real v) { return static_cast<double>(v); };
    const double V_f = p.constants().devices.V_f_V;
    const double allowed = noise * static_cast<double>(p.slack());
    const double amp = allowed * amp_scale_, volt = allowed * volt_scale_;
    const double sum = std::fabs(d(now.i[0] + now.i[1] + now.i[2]));
    raise(current_sum_, sum);
    raise(stray_W_, sum * d(now.bus));
    for (int k = 0; k < 3; ++k) {
      const plant::Connection leg = p.mode().legs[k];
      raise(highest_current_, std::fabs(d(now.i[k])));
      if (leg == plant::Connection::low_diode) raise(reverse_diode_, -d(now.i[k]) / amp);
      if (leg == plant::Connection::high_diode) raise(reverse_diode_, d(now.i[k]) / amp);
      if (!plant::is_floating(leg)) continue;
      raise(floating_current_, std::fabs(d(now.i[k])));
      if constexpr (requires { p.dead(); })
        if ((p.dead() >> k & 1) != 0) continue;  // the terminal of a broken wire may be outside the rails
      raise(beyond_rail_, (-V_f - d(now.pole[k])) / volt);
      raise(beyond_rail_, (d(now.pole[k] - now.bus) - V_f) / volt);
    }
  }

  BooksOfEither<Real> audit_;
  sim::Instant last_{};
  bool time_went_back_ = false;
  plant::Snapshot<Real> end_{};  ///< end of the preceding segment
  double current_step_ = 0, speed_step_ = 0, speed_scale_ = 0;
  double stray_W_ = 0, stray_J_ = 0;  ///< of the present segment, and of all segments
  double stepped_ = 0;                ///< magnetic energy that the steps of the currents added between
                                      ///< segments, J
  std::int64_t segments_ = 0;
  int stops_ = 0;
  double inductance_ = 0, amp_scale_ = 0, volt_scale_ = 0, current_sum_ = 0, floating_current_ = 0,
         highest_current_ = 0;
  double reverse_diode_ = 0, beyond_rail_ = 0;  ///< as fractions of the allowed deviations
};

}  // namespace sixstep::testing
