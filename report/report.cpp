// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"
#include "report/chip_section.hpp"

#include <fmt/format.h>
#include <report_assets.hpp>

#include "report/chip_section.hpp"
#include "report/energy_balance.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/kept_rows.hpp"
#include "report/parameters.hpp"
#include "report/plots.hpp"
#include "report/scripts.hpp"
#include "report/shell.hpp"
#include "report/spectra.hpp"
#include "report/summary.hpp"
#include "report/svg_chart.hpp"
#include "report/verdicts.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/escape/escape.hpp"
#include "text/results/core_text.hpp"

namespace report {
namespace {

std::string subtitle(const ReportInput& in) {
  const auto& sheet = in.scenario.sheet;
  std::string name = sheet.name.empty() ? in.scenario.motor : sheet.name;
  if (!sheet.maker.empty() && name.find(sheet.maker) == name.npos) name = sheet.maker + " " + name;
  return escaped(name) + " · " + escaped(given(in.outcome.simulated_s, "s")) + " simulated";
}

/// Warnings above all numbers: a fault, and the notes of the run.
std::string alerts(const ReportInput& in) {
  std::string html;
  if (in.outcome.fault)
    html += fmt::format("<p class=\"alert\" role=\"alert\"><b>Fault.</b> {}</p>\n",
                        escaped(sixstep::base::to_string(*in.outcome.fault)));
  for (const std::string& note : in.outcome.notes)
    html += fmt::format("<p class=\"alert\" role=\"alert\"><b>Note.</b> {}</p>\n", escaped(note));
  for (const std::string& remark : in.outcome.remarks)
    html += fmt::format("<p class=\"alert\"><b>Remark.</b> {}</p>\n", escaped(remark));
  if (in.outcome.core)
    for (const std::string& told : text::core_texts(in.outcome))
      html += fmt::format("<p class=\"quiet\">The drive ran {}.</p>\n", escaped(told));
  if (sixstep::study::cut_short(in.scenario, in.outcome))
    html +=
        fmt::format("<p class=\"alert\" role=\"alert\"><b>Interrupted</b> at {} of {}.</p>\n",
                    escaped(given(in.outcome.simulated_s, "s")), escaped(given(in.scenario.duration_s, "s")));
  if (const std::string told = rows_told(in.trace); !told.empty())
    html += fmt::format("<p class=\"quiet\">For this run {}.</p>\n", escaped(told));
  return html;
}

std::string requirements(const sixstep::study::Outcome& outcome) {
  if (outcome.verdicts.empty()) return "";
  return "<table class=\"verdicts\"><thead><tr><th></th><th>Figure</th><th class=\"num\">Required</th>"
         "<th class=\"num\">Measured</th><th>Within limits</th></tr></thead><tbody>\n" +
         requirement_rows(outcome) + "</tbody></table>\n";
}

std::string comparisons(const sixstep::study::Outcome& outcome) {
  if (outcome.comparisons.empty()) return "";
  return "<h2>Compared with</h2><table class=\"comparisons\"><thead><tr><th>Figure</th><th "
         "class=\"num\">Expected</th>"
         "<th class=\"num\">Measured</th><th class=\"num\">Deviation</th><th>Source</th></tr></thead><tbody>\n" +
         comparison_rows(outcome) + "</tbody></table>\n";
}

/// Each recording over its signal, and the difference below.
std::string recordings(const sixstep::study::Outcome& outcome) {
  std::string html;
  if (!outcome.laid) return html;
  for (const sixstep::study::LaidRecording& laid : *outcome.laid) {
    const auto chart = [&](std::string title, std::vector<SvgCurve> curves) {
      html += svg_chart({.title = text::visible(title),
                         .x_label = "ms",
                         .y_label = laid.unit,
                         .curves = std::move(curves),
                         .levels = {0.0}});
    };
    std::vector<double> ms = laid.t_s, apart = laid.recorded;
    for (double& t : ms) t *= 1e3;
    for (std::size_t n = 0; n < apart.size(); ++n) apart[n] -= laid.simulated[n];
    chart(laid.file + " over " + laid.name,
          {{"recorded", "b", ms, laid.recorded}, {"simulated", "a", ms, laid.simulated}});
    chart("Difference", {{"recorded less simulated", "b", ms, apart}});
  }
  return "<div id=\"recordings\">" + html + "</div>\n";
}

BookOf book_of(const sixstep::study::Scenario& s) {
  return {.twist = s.load.stiffness_Nm_rad > 0.0,
          .cogging = !s.sheet.cogging_orders.empty(),
          .delta = s.sheet.connection == sixstep::design::WindingConnection::delta};
}

/// After an interrupt the user waits for the report. Packing every row would take longest, so it is omitted.
PlotSize size_of(const ReportInput& in) {
  PlotSize size;
  if (sixstep::study::cut_short(in.scenario, in.outcome)) size.packed_bytes = 0;
  return size;
}

}  // namespace

std::string render(const ReportInput& in) {
  const Standing verdict = standing(in.outcome);
  const std::string title = escaped(in.scenario.title.empty() ? in.scenario.motor : in.scenario.title);
  const std::string notes =
      in.scenario.notes.empty() ? "" : "<p class=\"notes\">" + escaped(in.scenario.notes) + "</p>\n";
  const double pole_pairs = in.outcome.motor.machine.pole_pairs;
  const std::optional<Spectra> found = spectra(in.trace, in.scenario, pole_pairs);
  const std::string body =
      filled(assets::page_html(),
             {{"title", title},
              {"subtitle", subtitle(in)},
              {"standing_class", verdict.css},
              {"standing", verdict.word},
              {"standing_line", verdict.line},
              {"notes", notes},
              {"alerts", alerts(in)},
              {"glance", glance_section(in.scenario, in.outcome, in.trace)},
              {"requirements", requirements(in.outcome)},
              {"comparisons", comparisons(in.outcome) + recordings(in.outcome) + chip_section(in.outcome)},
              {"setup", setup_section(in.scenario)},
              {"sheet", sheet_section(in.scenario.sheet)},
              {"model", model_section(in.outcome.motor)},
              {"gains", in.scenario.control.drive == sixstep::study::FirmwareKind::own
                            ? own_section(in.scenario.control.own)
                            : gains_section(in.scenario, in.outcome)},
              {"energy", in.outcome.energy ? energy_section(*in.outcome.energy, motion_of(in.outcome.motor),
                                                            book_of(in.scenario)) +
                                                 device_section(in.outcome.devices)
                                           : "<p class=\"quiet\">No energy balance was computed.</p>\n"},
              {"events", event_section(in.outcome)},
              {"plots", assets::plots_html()},
              {"spectra", spectra_section(found)},
              {"scenario", escaped(in.scenario_text)}});
  return in_shell(
      {.title = verdict.word + " · " + title, .body = body, .command = in.command, .version = in.version},
      plot_data(in.trace, in.scenario, pole_pairs, size_of(in), found), run_scripts());
}

}  // namespace report
