// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/carried_over.hpp"

#include <cmath>

#include "sixstep/analysis/verify/run_warnings.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

bool bounds_anything(const study::Limits& l) {
  return l.current_A || l.torque_Nm || l.speed_rad_s || l.gain_A_s_per_rad;
}

/// The reason why the run with the board's settings is slower than the designed run; empty if it is not
/// slower.
std::string slower(const study::Scenario& s, const study::Outcome& run, const study::Outcome& designed) {
  if (s.control.mode != control::Mode::speed) return {};
  const auto of = [](const study::Outcome& out, const char* figure) {
    const study::ComparisonResult* found = figure_of(out, figure);
    return found ? found->measured : 0.0;
  };
  if (std::isfinite(of(designed, settling_of_start)) && !std::isfinite(of(run, settling_of_start)))
    return "the start never settles";
  const double now = of(run, "settling time"), before = of(designed, "settling time");
  if (!std::isfinite(before) || now <= 1.25 * before) return {};
  return "a step settles in " + base::three_digits(1e3 * now) + " ms instead of " +
         base::three_digits(1e3 * before) + " ms";
}

/// Returns, for example, "41.8 ms" for 0.0418 and "s".
std::string in_words(double value, const std::string& unit) {
  const bool milliseconds = unit == "s" && std::fabs(value) < 1.0;
  return base::three_digits(milliseconds ? 1e3 * value : value) + (milliseconds ? " ms" : " " + unit);
}

/// The figures that differ from the design's figures by more than a twentieth: "settling time 41.8 ms instead
/// of 50.1 ms".
std::string others(const study::Outcome& run, const study::Outcome& designed) {
  std::string out;
  for (const char* figure : {"settling time", "overshoot", settling_of_start, "peak current of the start",
                             "peak current of the step"}) {
    const study::ComparisonResult *now = figure_of(run, figure), *before = figure_of(designed, figure);
    if (!now || !before || std::fabs(now->measured - before->measured) <= 0.05 * std::fabs(before->measured))
      continue;
    out += (out.empty() ? "" : ", ") + before->figure + " " + in_words(now->measured, before->unit) +
           " instead of " + in_words(before->measured, before->unit);
  }
  return out;
}

/// The reason why the scenario does not pass; empty: it passes.
std::string against(const study::Scenario& s, const study::Outcome& designed,
                    std::string* differs = nullptr) {
  const base::Result<study::Outcome> run = study::run(s);
  if (!run) return to_string(run.problems().front());
  if (differs) *differs = others(*run, designed);
  if (run->fault) return to_string(*run->fault);
  for (const study::Verdict& v : run->verdicts)
    if (!v.ok) return v.figure + " does not meet its requirement";
  if (run->trip) return "the drive trips: " + run->trip->reasons.front();
  return slower(s, *run, designed);
}

/// The reason why the drive trips with a motor within the tolerances; empty if it does not trip. The
/// protection is active with every motor.
std::string trips_within_tolerances(const DesignStudy& study, const study::Scenario& s) {
  const std::optional<double>& trip_A = s.protection.over_current_A;
  if (s.control.drive != study::FirmwareKind::product || !trip_A || !study.robustness) return {};
  for (const RobustFigure& f : study.robustness->figures)
    if (f.figure.starts_with("peak current") && std::isfinite(f.worst) && f.worst >= *trip_A)
      return "the drive trips within the tolerances: the " + f.figure + " is " + base::three_digits(f.worst) +
             " A" + (f.at.empty() ? "" : " with " + f.at) + ", and protection.over_current_A is " +
             base::three_digits(*trip_A) + " A";
  return {};
}

/// Copies the current loop's settings except its gains and its limit. Returns false if there are no such
/// settings, or if the board's loop is no PI.
bool take_current_loop(const study::Control& board, study::Control& to) {
  study::CurrentLoop current = board.current;
  if (current.type != study::CurrentLoopType::pi) return false;
  for (const auto gain : {&study::CurrentLoop::settle_s, &study::CurrentLoop::damping,
                          &study::CurrentLoop::d1, &study::CurrentLoop::d0, &study::CurrentLoop::kp,
                          &study::CurrentLoop::ki, &study::CurrentLoop::ki_per_s})
    current.*gain = to.current.*gain;
  current.limit_A = to.current.limit_A;
  to.current = current;
  return current.back_emf_feed_forward || current.feedback != study::CurrentFeedback::mean ||
         current.commutation != study::CurrentCommutation::plain || current.measured_bus_from_V;
}

}  // namespace

CarriedOver carry_over(const DesignStudy& study, study::Scenario designed, const study::Scenario& board) {
  CarriedOver out{.scenario = designed, .kept = {}, .lost = {}, .differs = {}};
  study::Scenario& s = out.scenario;
  const auto keep = [&out](const char* name) {
    out.kept += (out.kept.empty() ? "" : ", ") + std::string(name);
  };
  s.control.full_scale = board.control.full_scale;
  if (take_current_loop(board.control, s.control)) keep("the keys of control.current other than gains");
  if (board.control.drive == study::FirmwareKind::product) {
    s.control.drive = study::FirmwareKind::product;
    s.protection = board.protection;
    s.sensors.hall_stable_samples = board.sensors.hall_stable_samples;
    s.protection.off_at_s.reset();  // this time belongs to the reference of the board's scenario
    keep("control.drive and [protection]");
  }
  if (bounds_anything(board.control.limits)) {
    s.control.limits = board.control.limits;
    if (s.control.mode != control::Mode::current) s.control.current.limit_A = board.control.current.limit_A;
    keep("control.limits");
  }
  if (board.control.regeneration.limit_V) {
    s.control.regeneration = board.control.regeneration;
    keep("control.regeneration");
  }
  if (board.control.drive == study::FirmwareKind::sensorless)
    out.lost =
        "control.drive = \"sensorless\" of the board's scenario is left out: the loops were tested with Hall edges in place of zero crossings";
  else if (!out.kept.empty()) {
    std::string reason = against(s, study.outcome, &out.differs);
    if (reason.empty()) reason = trips_within_tolerances(study, s);
    if (!reason.empty())
      out.lost = "these keys of the board's scenario are left out: " + out.kept + "; with them " + reason;
  }
  if (out.lost.empty()) {
    study::Scenario in_its_numbers = s;
    in_its_numbers.control.arithmetic = board.control.arithmetic;
    if (board.control.arithmetic != s.control.arithmetic && against(in_its_numbers, study.outcome).empty()) {
      s = std::move(in_its_numbers);
      keep("control.arithmetic");
    }
    return out;
  }
  if (designed.not_usable.empty()) designed.not_usable = out.lost;
  return {.scenario = designed, .kept = {}, .lost = out.lost, .differs = {}};
}

}  // namespace sixstep::analysis
