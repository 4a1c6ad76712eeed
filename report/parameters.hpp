// SPDX-License-Identifier: Apache-2.0
// Writes the inputs of a run: the sheet's values with frame and source, the model computed from them, and the
// gains.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

std::string sheet_section(const sixstep::design::Sheet& sheet);
std::string model_section(const sixstep::design::MotorModel& motor);
std::string setup_section(const sixstep::study::Scenario& scenario);
/// Unit of d1 and d0: output per error. The output of an outer loop is a fraction of its largest output.
std::string_view gain_unit(const sixstep::study::LoopGains& gains, bool linear);
/// Describes a controller without gains in words: "none: the duty is given". Empty for a controller with
/// gains, such as a PI controller.
std::string without_gains(const sixstep::study::Scenario& scenario);
std::string gains_section(const sixstep::study::Scenario& scenario, const sixstep::study::Outcome& outcome);
/// The numbers of a user's controller. Preset numbers are marked.
std::string own_section(const sixstep::study::Own& own);
/// The derivation of a design as a table: symbol, formula, value.
std::string derivation_table(const std::vector<sixstep::design::DerivationStep>& steps, bool linear);

}  // namespace report
