// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/carried_over.hpp"

#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

bool bounds_anything(const study::Limits& l) {
  return l.current_A || l.torque_Nm || l.speed_rad_s || l.gain_A_s_per_rad;
}

/// Empty: it passes.
std::string against(const study::Scenario& s) {
  const base::Result<study::Outcome> run = study::run(s);
  if (!run) return to_string(run.problems().front());
  if (run->fault) return to_string(*run->fault);
  for (const study::Verdict& v : run->verdicts)
    if (!v.ok) return v.figure + " misses what is required";
  if (run->trip) return "the drive trips: " + run->trip->reasons.front();
  return {};
}

}  // namespace

CarriedOver carry_over(study::Scenario designed, const study::Scenario& board) {
  CarriedOver out{.scenario = designed, .kept = {}};
  study::Scenario& s = out.scenario;
  const auto keep = [&out](const char* name) {
    out.kept += (out.kept.empty() ? "" : ", ") + std::string(name);
  };
  s.control.full_scale = board.control.full_scale;
  if (board.control.drive == study::FirmwareKind::product) {
    s.control.drive = study::FirmwareKind::product;
    s.protection = board.protection;
    s.sensors.hall_stable_samples = board.sensors.hall_stable_samples;
    s.protection.off_at_s.reset();  // a moment of the board's own course
    keep("control.drive and [protection]");
  }
  if (bounds_anything(board.control.limits)) {
    s.control.limits = board.control.limits;
    keep("control.limits");
  }
  if (board.control.regeneration.limit_V) {
    s.control.regeneration = board.control.regeneration;
    keep("control.regeneration");
  }
  std::string lost;
  if (board.control.drive == study::FirmwareKind::sensorless)
    lost =
        "control.drive = \"sensorless\" of the board's scenario is left out: the loops were run with Hall edges "
        "where crossings would be";
  else if (!out.kept.empty())
    if (const std::string reason = against(s); !reason.empty())
      lost = "of the board's scenario " + out.kept + " are left out, for with them " + reason;
  if (lost.empty()) return out;
  if (designed.not_usable.empty()) designed.not_usable = lost;
  return {.scenario = designed, .kept = {}};
}

}  // namespace sixstep::analysis
