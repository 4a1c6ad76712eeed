// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/position_gain.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

constexpr double precision = 1e-3, coarse_precision = 0.02;

/// Remaining control periods of a search.
class Left {
 public:
  Left(const GainSearch& search, TrialBudget* budget)
      : longest_(search.longest_periods), own_{search.periods}, of_all_(budget) {}
  /// Subtracts this number of runs of the scenario. Returns false if one run is too long or no periods
  /// remain.
  bool takes(const study::Scenario& s, std::size_t runs) {
    if (!(s.duration_s / s.pwm.period_s <= longest_)) return false;
    return own_.takes(s, runs) && (of_all_ == nullptr || of_all_->takes(s, runs));
  }

 private:
  double longest_;
  TrialBudget own_;
  TrialBudget* of_all_;
};

base::Problem none_found(const design::DesignSpec& spec, const DesignSubject& subject,
                         const std::string& who) {
  const bool encoder_helps = spec.rotor.hall && decodes_encoders(subject.board);
  return {"mode", "position",
          "has no gain without overshoot for " + who + "; smaller gains take too long to simulate",
          std::string("raise torque_limit_Nm, or give a smaller step") +
              (encoder_helps ? ", or rotor = encoder instead of Hall probes" : "")};
}

constexpr const char* the_drive = "the nominal motor";
constexpr const char* all_motors = "all motors within the tolerances";

/// Runs the move with a gain, and judges only the overshoot.
class Trial {
 public:
  Trial(const design::DriveDesign& design, const DesignSubject& subject,
        const std::function<bool()>& keep_going, Left left)
      : design_(design), subject_(subject), keep_going_(keep_going), left_(left) {}

  bool overshoots(double gain) {
    ++runs;
    design::DriveDesign d = design_;
    d.loops.back().gains.d1 = gain;
    study::Scenario s = design_scenario(d, subject_);
    s.compare.clear();
    s.require.resize(1);
    if (!left_.takes(s, 1)) {
      problems = {none_found(design_.spec, subject_, the_drive)};
      return true;
    }
    const base::Result<study::Outcome> outcome = study::run(
        s,
        {.on_record = {}, .on_event = {}, .keep_going = study::listening(keep_going_), .keep_books = false});
    if (!outcome) {
      problems = outcome.problems();
      return true;
    }
    return !outcome->passed();
  }

  int runs = 0;
  base::Problems problems;

 private:
  const design::DriveDesign& design_;
  const DesignSubject& subject_;
  const std::function<bool()>& keep_going_;
  Left left_;
};

/// Runs the move with a gain for all motors within the tolerances.
class Field {
 public:
  Field(const design::DriveDesign& design, const DesignSubject& subject,
        const std::vector<Tolerance>& tolerances, const ForEach& for_each,
        const std::function<bool()>& keep_going, Left left)
      : design_(design),
        subject_(subject),
        tolerances_(tolerances),
        all_(variations(tolerances)),
        for_each_(for_each),
        keep_going_(keep_going),
        left_(left) {}

  std::size_t motors() const { return all_.size(); }

  bool holds(double gain) {
    design::DriveDesign d = design_;
    d.loops.back().gains.d1 = gain;
    study::Scenario nominal = design_scenario(d, subject_);
    nominal.compare.clear();
    nominal.require.resize(1);
    nominal.require.front().max = allowed_overshoot_deg(d, nominal.reference.value);
    if (!left_.takes(nominal, all_.size())) {
      too_long = true;
      problems = {none_found(design_.spec, subject_, all_motors)};
      return false;
    }
    std::vector<base::Result<study::Outcome>> outcomes(all_.size(), base::Problem{});
    for_each_(all_.size(), [&](std::size_t n) {
      outcomes[n] = study::run(n == 0 ? nominal : varied_scenario(nominal, d.motor, tolerances_, all_[n]),
                               {.on_record = {},
                                .on_event = {},
                                .keep_going = study::listening(keep_going_),
                                .keep_books = false});
    });
    for (const base::Result<study::Outcome>& outcome : outcomes) {
      if (!outcome) problems = outcome.problems();
      if (!outcome || outcome->fault || !outcome->passed()) return false;
    }
    return true;
  }

  base::Problems problems;
  bool too_long = false;

 private:
  const design::DriveDesign& design_;
  const DesignSubject& subject_;
  const std::vector<Tolerance>& tolerances_;
  std::vector<Variation> all_;
  const ForEach& for_each_;
  const std::function<bool()>& keep_going_;
  Left left_;
};

}  // namespace

bool TrialBudget::takes(const study::Scenario& s, std::size_t runs) {
  periods -= s.duration_s / s.pwm.period_s * static_cast<double>(runs);
  return periods >= 0.0;
}

double braking_gain(const design::DriveDesign& d) {
  return d.most_torque_Nm() / d.motor.shaft.J_kg_m2 / (d.bus_V / d.motor.K_t_Nm_A) * base::pi / 180;
}

base::Result<PositionGain> largest_position_gain(const design::DriveDesign& design,
                                                 const DesignSubject& subject,
                                                 const std::function<bool()>& keep_going,
                                                 const GainSearch& search, TrialBudget* budget) {
  PositionGain found;
  found.linear = design.loop("position").gains.d1;
  found.estimate = braking_gain(design);
  Trial trial(design, subject, keep_going, Left(search, budget));
  double low = std::min(found.estimate, found.linear), high = found.linear;
  for (int n = 0; n < 20 && trial.overshoots(low) && trial.problems.empty(); ++n) {
    high = found.overshoots = low;
    low /= 2;
  }
  if (!trial.problems.empty()) return trial.problems;
  if (search.quick) high = low;
  if (found.overshoots == 0.0 && high > low) {
    if (trial.overshoots(high))
      found.overshoots = high;
    else
      low = high;
  }
  while (trial.problems.empty() && high - low > precision * low) {
    const double middle = low + (high - low) / 2;
    if (trial.overshoots(middle))
      high = found.overshoots = middle;
    else
      low = middle;
  }
  if (!trial.problems.empty()) return trial.problems;
  found.gain_rad_s_per_deg = found.nominal = low;
  found.runs = trial.runs;
  return found;
}

base::Result<PositionGain> lowered_for_tolerances(const design::DriveDesign& design,
                                                  const DesignSubject& subject, const PositionGain& nominal,
                                                  const std::vector<Tolerance>& tolerances,
                                                  const ForEach& for_each,
                                                  const std::function<bool()>& keep_going,
                                                  const GainSearch& search, TrialBudget* budget) {
  PositionGain found = nominal;
  Field field(design, subject, tolerances, for_each, keep_going, Left(search, budget));
  const auto holds = [&](double gain) {
    found.runs += static_cast<int>(field.motors());
    return field.holds(gain);
  };
  double low = nominal.nominal, high = low;
  bool held = holds(low);
  while (!held && low >= nominal.nominal / 16 && field.problems.empty()) {
    high = low;
    low /= 2;
    held = holds(low);
  }
  while (!search.quick && held && field.problems.empty() && high - low > coarse_precision * low) {
    const double middle = low + (high - low) / 2;
    (holds(middle) ? low : high) = middle;
  }
  if (!field.problems.empty() && !field.too_long) return field.problems;
  if (!held)
    return field.too_long && !search.quick
               ? base::Result<PositionGain>(none_found(design.spec, subject, all_motors))
               : found;
  found.gain_rad_s_per_deg = low;
  return found;
}

}  // namespace sixstep::analysis
