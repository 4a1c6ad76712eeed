// SPDX-License-Identifier: Apache-2.0
// Checks a field-oriented drive with a finite control set, which has no gains, no pulses and no intermediate
// voltages.
#include "sixstep/study/check/field.hpp"
#include "sixstep/study/scenario/field_description.hpp"

namespace sixstep::study {

namespace {

/// Refuses keys that only the finite set has.
void check_beside_pi(const Field& f, base::Problems& out) {
  const auto refuse = [&out](bool given, const char* key) {
    if (given)
      out.push_back({key, "", "applies to finite-set control only, and control.field.law is \"pi\"",
                     "set control.field.law = \"finite-set\", or remove this key"});
  };
  refuse(f.switching_weight_A > 0, "control.field.switching_weight_A");
  refuse(f.peak_A.has_value(), "control.field.peak_A");
  refuse(!f.delay_compensation, "control.field.delay_compensation");
}

}  // namespace

void check_finite_set(const Scenario& s, base::Problems& out) {
  const Field& f = s.control.field;
  if (f.law == FieldLaw::pi) return check_beside_pi(f, out);
  const auto refuse = [&out](bool given, const char* key, const char* limit, const char* cure) {
    if (given) out.push_back({key, "", limit, cure});
  };
  const CurrentLoop& loop = s.control.current;
  const char* const no_loop =
      "applies only to current loops, which control.field.law = \"finite-set\" does not have";
  const char* const to_pi = "remove this key, or set control.field.law = \"pi\"";
  refuse(f.bandwidth_Hz.has_value(), "control.field.bandwidth_Hz", no_loop, to_pi);
  refuse(gives_gains(loop), "control.current", no_loop, to_pi);
  refuse(!f.decoupling, "control.field.decoupling",
         "= false omits the induced voltages, which finite-set control needs for its prediction", to_pi);
  refuse(
      f.voltage_limit != control::VoltageLimit::circle, "control.field.voltage_limit",
      "= \"axes\" limits the magnitude of the voltage, which is fixed when the legs keep one state for a whole period",
      to_pi);
  refuse(
      f.weakening_A.has_value(), "control.field.weakening_A",
      "adjusts the magnitude of the voltage, which is fixed when the legs keep one state for a whole period",
      to_pi);
  refuse(f.advance_periods.has_value(), "control.field.advance_periods",
         "rotates the output, and finite-set control predicts the magnet's angle itself", to_pi);
  refuse(
      s.pwm.sample == SampleAt::middle, "pwm.sample",
      "= \"middle\" samples half a period before the legs switch, and finite-set control does not predict over this half period",
      "set sample = \"start\"");
}

}  // namespace sixstep::study
