// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/export/fmi_description.hpp"

namespace text {
namespace {

std::string fmi3_head(const UnitModel& m) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiModelDescription generationTool=\"sixstep " SIXSTEP_VERSION
      "\" fmiVersion=\"3.0\" modelName=\"{}\"\n"
      "    instantiationToken=\"{}\" description=\"{}\" variableNamingConvention=\"flat\">\n"
      "  <CoSimulation modelIdentifier=\"{}\" canHandleVariableCommunicationStepSize=\"true\" "
      "canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\"\n"
      "      mightReturnEarlyFromDoStep=\"true\" canReturnEarlyAfterIntermediateUpdate=\"true\" "
      "hasEventMode=\"true\" providesIntermediateUpdate=\"true\"/>\n",
      markup_text(m.name), m.token, markup_text(m.scenario.title), m.identifier);
}

const char* fmi3_type(FmiKind kind) {
  switch (kind) {
    case FmiKind::integer:
      return "Int32";
    case FmiKind::boolean:
      return "Boolean";
    case FmiKind::text:
      return "String";
    case FmiKind::clock:
      return "Clock";
    default:
      return "Float64";
  }
}

/// The start values, as many as the array has elements.
std::string fmi3_start(const FmiVariable& v) {
  const std::string one = v.kind == FmiKind::boolean ? "false" : base::written(v.start);
  std::string all = one;
  for (int n = 1; n < v.count; ++n) all += " " + one;
  return all;
}

const char* fmi3_causality(FmiRole role) {
  switch (role) {
    case FmiRole::time:
      return "independent";
    case FmiRole::input:
      return "input";
    case FmiRole::parameter:
      return "parameter";
    default:
      return "output";
  }
}

/// The attributes that a variable has by its role and kind.
std::string fmi3_attributes(const FmiVariable& v) {
  if (v.kind == FmiKind::clock) return " intervalVariability=\"triggered\"";
  if (v.role == FmiRole::parameter) return " initial=\"exact\" start=\"true\"";
  if (v.role != FmiRole::output) return "";
  return std::string(" initial=\"calculated\"") +
         (v.continuous && v.kind == FmiKind::real ? " intermediateUpdate=\"true\"" : "");
}

std::string fmi3_variable(const FmiVariable& v) {
  std::string out = fmt::format(
      "    <{} name=\"{}\" valueReference=\"{}\" causality=\"{}\" variability=\"{}\"{}\n        description=\"{}\"",
      fmi3_type(v.kind), markup_text(v.name), v.reference, fmi3_causality(v.role),
      v.role == FmiRole::parameter ? "fixed"
      : v.continuous               ? "continuous"
                                   : "discrete",
      fmi3_attributes(v), markup_text(v.description));
  if (v.kind == FmiKind::real && !v.unit.empty()) {
    out += fmt::format(" unit=\"{}\"", markup_text(v.unit));
    if (const FmiUnit* const unit = fmi_unit(v.unit); unit != nullptr && !unit->display.empty())
      out += fmt::format(" displayUnit=\"{}\"", unit->display);
  }
  if (v.role == FmiRole::input) out += fmt::format(" start=\"{}\"", fmi3_start(v));
  if (v.count == 1) return out + "/>\n";
  return out + fmt::format(">\n      <Dimension start=\"{}\"/>\n    </{}>\n", v.count, fmi3_type(v.kind));
}

/// No output depends directly on an input, because a change waits for a control tick.
std::string fmi3_structure(const UnitModel& m) {
  std::string outputs, unknowns;
  for (const FmiVariable& v : m.variables) {
    if (v.role != FmiRole::output) continue;
    outputs += fmt::format("    <Output valueReference=\"{}\" dependencies=\"\"/>\n", v.reference);
    if (v.kind == FmiKind::clock) continue;
    unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\" dependencies=\"\"/>\n", v.reference);
  }
  return "  <ModelStructure>\n" + outputs + unknowns + "  </ModelStructure>\n";
}

}  // namespace

std::string fmi3_description(const UnitModel& m) {
  std::string out = fmi3_head(m) + fmi_unit_lines(m.units());
  out +=
      "  <LogCategories>\n"
      "    <Category name=\"logStatusError\" description=\"refused calls\"/>\n"
      "    <Category name=\"logStatusDiscard\" description=\"runs that were over before the end of a step\"/>\n"
      "    <Category name=\"logEvents\" description=\"changes of inputs, with their instants\"/>\n"
      "  </LogCategories>\n";
  out += fmt::format(
      "  <DefaultExperiment startTime=\"0\" stopTime=\"{}\" stepSize=\"{}\"/>\n  <ModelVariables>\n",
      base::written(m.scenario.duration_s), base::written(m.scenario.pwm.period_s));
  for (const FmiVariable& v : m.variables) out += fmi3_variable(v);
  return out + "  </ModelVariables>\n" + fmi3_structure(m) + "</fmiModelDescription>\n";
}

std::string fmi3_build(const UnitModel& m) {
  std::string files;
  for (const std::string& file : m.sources) files += fmt::format("      <SourceFile name=\"{}\"/>\n", file);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiBuildDescription fmiVersion=\"3.0\">\n"
      "  <BuildConfiguration modelIdentifier=\"{}\" description=\"needs libsixstep, the library of sixstep for C\">\n"
      "    <SourceFileSet language=\"C99\">\n{}      <IncludeDirectory name=\".\"/>\n    </SourceFileSet>\n"
      "    <Library name=\"sixstep\" external=\"true\"/>\n    <Library name=\"m\" external=\"true\"/>\n"
      "  </BuildConfiguration>\n</fmiBuildDescription>\n",
      m.identifier, files);
}

}  // namespace text
