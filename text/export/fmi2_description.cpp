// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/export/fmi_description.hpp"

namespace text {
namespace {

std::string fmi2_head(const UnitModel& m) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiModelDescription generationTool=\"sixstep " SIXSTEP_VERSION
      "\" fmiVersion=\"2.0\" modelName=\"{}\"\n"
      "    guid=\"{}\" description=\"{}\" variableNamingConvention=\"flat\">\n",
      markup_text(m.name), m.token, markup_text(m.scenario.title));
  out += fmt::format(
      "  <CoSimulation modelIdentifier=\"{}\" canHandleVariableCommunicationStepSize=\"true\" "
      "canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\">\n    <SourceFiles>\n",
      m.identifier);
  for (const std::string& file : m.sources) out += fmt::format("      <File name=\"{}\"/>\n", file);
  return out + "    </SourceFiles>\n  </CoSimulation>\n";
}

std::string fmi2_typed(const FmiVariable& v) {
  const bool starts = v.role == FmiRole::input;
  if (v.kind == FmiKind::integer)
    return starts ? fmt::format("<Integer start=\"{}\"/>", base::written(v.start)) : "<Integer/>";
  if (v.kind == FmiKind::boolean) return starts ? "<Boolean start=\"false\"/>" : "<Boolean/>";
  if (v.kind == FmiKind::text) return "<String/>";
  std::string out = "<Real";
  if (!v.unit.empty()) out += fmt::format(" unit=\"{}\"", markup_text(v.unit));
  if (const FmiUnit* const unit = fmi_unit(v.unit); unit != nullptr && !unit->display.empty())
    out += fmt::format(" displayUnit=\"{}\"", unit->display);
  if (starts) out += fmt::format(" start=\"{}\"", base::written(v.start));
  return out + "/>";
}

std::string fmi2_variable(const FmiVariable& v) {
  const char* const causality = v.role == FmiRole::time    ? "independent"
                                : v.role == FmiRole::input ? "input"
                                                           : "output";
  return fmt::format(
      "    <ScalarVariable name=\"{}\" valueReference=\"{}\" causality=\"{}\" variability=\"{}\"{}\n"
      "        description=\"{}\">\n      {}\n    </ScalarVariable>\n",
      markup_text(v.name), v.reference, causality, v.continuous ? "continuous" : "discrete",
      v.role == FmiRole::output ? " initial=\"calculated\"" : "", markup_text(v.description), fmi2_typed(v));
}

/// No output depends directly on an input, because a change waits for a control tick.
std::string fmi2_structure(const UnitModel& m) {
  std::string unknowns;
  for (std::size_t n = 0; n < m.variables.size(); ++n)
    if (m.variables[n].role == FmiRole::output)
      unknowns += fmt::format("      <Unknown index=\"{}\" dependencies=\"\"/>\n", n + 1);
  return fmt::format(
      "  <ModelStructure>\n    <Outputs>\n{0}    </Outputs>\n    <InitialUnknowns>\n{0}    </InitialUnknowns>\n"
      "  </ModelStructure>\n",
      unknowns);
}

}  // namespace

std::string fmi2_description(const UnitModel& m) {
  std::string out = fmi2_head(m) + fmi_unit_lines(m.units());
  out +=
      "  <LogCategories>\n"
      "    <Category name=\"logStatusError\" description=\"refused calls\"/>\n"
      "    <Category name=\"logStatusDiscard\" description=\"steps that the run did not reach\"/>\n"
      "    <Category name=\"logEvents\" description=\"changes of inputs, with their instants\"/>\n"
      "  </LogCategories>\n";
  out += fmt::format(
      "  <DefaultExperiment startTime=\"0\" stopTime=\"{}\" stepSize=\"{}\"/>\n  <ModelVariables>\n",
      base::written(m.scenario.duration_s), base::written(m.scenario.pwm.period_s));
  for (const FmiVariable& v : m.variables) out += fmi2_variable(v);
  return out + "  </ModelVariables>\n" + fmi2_structure(m) + "</fmiModelDescription>\n";
}

}  // namespace text
