// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/linear_study.hpp"

#include <string_view>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace sixstep::analysis {
namespace {

/// A derivation step that has another symbol or formula for a linear motor.
struct LinearStep {
  std::string_view symbol, told_symbol, formula;
};

/// Steps that linear_words() (base/linear.hpp) does not convert. With an empty formula the step keeps its
/// formula.
constexpr LinearStep linear_steps[] = {
    {"w_low", "v_low", ""},
    {"w_high", "v_high", ""},
    {"dw_high", "dv_high", ""},
    {"dw", "dv", "v_low s/(k tau/3), s: error of k sectors from misplaced probes"},
    {"dw_3", "dv_3", ""},
    {"w_min", "v_min", ""},
    {"d1 dw", "d1 dv", ""},
    {"du", "du", "change of the voltage: d1 dv times F_max/K_f times the current loop's d1"},
    {"u_left", "u_left", "remaining voltage of the bus at v_high and half the nominal current"},
    {"T", "T", "(tau/3)/v_low, a sector at that speed"},
    {"q", "q", "tau/3, a Hall step"},
};

void tell(std::vector<design::DerivationStep>& steps) {
  for (design::DerivationStep& s : steps) {
    for (const LinearStep& row : linear_steps)
      if (s.symbol == row.symbol) {
        s.symbol = row.told_symbol;
        if (!row.formula.empty()) s.formula = row.formula;
        break;
      }
    s.formula = base::linear_words(s.formula);
    for (std::size_t at = 0; (at = s.formula.find("w_low", at)) != std::string::npos;) s.formula[at] = 'v';
  }
}

/// Converts a loop's steps. In a loop's steps rad/s is an angular frequency and becomes 1/s; only a
/// position's gains change their value.
void tell_loop(design::LoopDesign& loop) {
  for (design::DerivationStep& s : loop.steps) {
    if (s.formula == "J w_c / T_max") s.formula = "m w_c / F_max";
    if (s.formula == "the same in radians") s.formula = "the same in metres";
    if (s.unit == "rad/s") s.unit = "1/s";
    if (loop.name != "position") continue;
    const base::LinearUnit unit = base::in_linear(s.unit);
    s.value *= unit.factor;
    s.unit = std::string(unit.linear);
  }
  tell(loop.steps);
}

void tell_sensing(std::vector<design::DerivationStep>& steps) {
  for (design::DerivationStep& s : steps) {
    if (s.symbol == "w_c") {  // an angular frequency, not a speed
      s.formula = "d1 F_max/m, crossover of the speed loop with d1 only";
      s.unit = "1/s";
    }
    const bool speed = s.unit == "rad/s" && s.symbol != "w_n";
    if (!speed && s.symbol != "q") continue;  // a loop's phase margin stays in degrees
    const base::LinearUnit unit = base::in_linear(s.unit);
    s.value *= unit.factor;
    s.unit = std::string(unit.linear);
  }
  tell(steps);
}

void tell(std::vector<RobustFigure>& figures) {
  for (RobustFigure& f : figures)
    for (std::string* text : {&f.at, &f.culprit}) *text = base::linear_words(*text);
}

}  // namespace

void say_in_metres(study::Scenario& s) {
  if (s.sheet.kind == design::MotorKind::rotary) return;
  s.title = base::linear_words(s.title);
  for (study::Comparison& c : s.compare) c.source = base::linear_words(c.source);
  const std::vector<study::Column>&turning = study::all_columns(), &linear = study::all_columns(s.sheet.kind);
  for (std::string& name : s.record.columns)
    for (std::size_t n = 0; n < turning.size(); ++n)
      if (turning[n].name == name) {
        name = linear[n].name;
        break;
      }
}

void tell_in_metres(DesignStudy& study) {
  if (!design::motion_of(study.scenario.sheet).linear) return;
  for (design::LoopDesign& loop : study.design.loops) tell_loop(loop);
  tell_sensing(study.design.sensing);
  for (std::vector<design::Warning>* warnings : {&study.warnings, &study.design.warnings})
    for (design::Warning& w : *warnings) {
      w.what = base::linear_words(w.what);
      w.cure = base::linear_words(w.cure);
    }
  if (!study.robustness) return;
  tell(study.robustness->figures);
  tell(study.robustness->phases);
}

base::Problems told_in_metres(base::Problems problems) {
  for (base::Problem& p : problems) {
    if (p.where == "bandwidth_rad_s") continue;  // a frequency keeps its unit
    p.where = base::linear_words(p.where);
    p.limit = base::linear_words(p.limit);
    p.cure = base::linear_words(p.cure);
  }
  return problems;
}

}  // namespace sixstep::analysis
