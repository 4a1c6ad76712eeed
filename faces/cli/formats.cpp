// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/formats.hpp"

#include <fmt/format.h>

#include <memory>

#include "faces/cli/report_page.hpp"
#include "files/trace/sinks.hpp"
#include "report/kept_rows.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "text/escape/escape.hpp"
#include "text/results/json_summary.hpp"
#include "text/results/quantity_text.hpp"

namespace cli {
namespace {

std::string json_text(const files::RunStory& s) { return text::json_summary(s.scenario, s.outcome); }

/// A run with its rows. The rows refer to `scenario`, so this object must not move.
struct Kept {
  explicit Kept(const study::Scenario& s) : scenario(s), events(scenario) {}
  study::Scenario scenario;
  report::KeptRows events;
};

base::Result<files::Sink> report_sink(const files::Destination& to, const study::Scenario& scenario,
                                      const files::TraceOrigin&) {
  const auto kept = std::make_shared<Kept>(scenario);
  base::Result<files::Sink> sink = files::page_sink(to, [kept](const files::RunStory& s) {
    return report_page({s.scenario, s.outcome, kept->events.trace(), s.origin.text, s.origin.command});
  });
  if (!sink) return sink;
  sink->on_event = [kept](study::Row row) { kept->events.add(row); };
  sink->left_out = [kept] { return report::rows_told(kept->events.trace()); };
  return sink;
}

/// The output of a chip's serial line, below a comment line with the chip and the command.
std::string sent_text(const files::RunStory& s) {
  if (!s.outcome.chip) return "";
  return fmt::format("# sixstep {}: serial output of an emulated {}; {}\n{}", SIXSTEP_VERSION,
                     s.outcome.chip->chip, text::visible(s.origin.command), s.outcome.chip->sent);
}

base::Result<files::Sink> uart_sink(const files::Destination& to, const study::Scenario&,
                                    const files::TraceOrigin&) {
  return files::page_sink(to, sent_text);
}

/// A message with the number and the size of the rows, if they need much disk space; else empty.
std::string grid_foretold(const study::Scenario& s, double bytes_a_number) {
  constexpr double many_bytes = 5e8;
  const base::Result<std::vector<study::Column>> columns = study::record_columns(s);
  if (!columns || s.record.events) return "";
  const double grid_s = s.record.grid_s.value_or(s.pwm.period_s), rows = s.duration_s / grid_s;
  const double bytes = rows * bytes_a_number * static_cast<double>(columns->size());
  if (!(bytes > many_bytes)) return "";
  const auto rough = [](double x) { return x < 10 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x); };
  return fmt::format(
      "one row per {} gives about {} million rows, {} GB; for fewer rows set a longer record.grid_s",
      text::quantity_text(grid_s, "s", 3), rough(rows / 1e6), rough(bytes / 1e9));
}
std::string csv_foretold(const study::Scenario& s) { return grid_foretold(s, 11); }
std::string mat_foretold(const study::Scenario& s) { return grid_foretold(s, 8); }

std::string report_foretold(const study::Scenario& scenario) { return report::rows_foretold(scenario); }

constexpr Format list[] = {
    {.option = "--csv",
     .meaning = "write the recorded trace",
     .open = files::csv_sink,
     .in_folder = ".csv",
     .foretold = csv_foretold},
    {.option = "--mat",
     .meaning = "write the trace for MATLAB, Octave and scipy: MAT 5",
     .open = files::mat_sink,
     .in_folder = "",
     .foretold = mat_foretold},
    {.option = "--mat73",
     .meaning = "write the trace as MAT 7.3, which is HDF5",
     .open = files::mat73_sink,
     .in_folder = "",
     .foretold = mat_foretold},
    {.option = "--vcd",
     .meaning = "write gates, Hall lines, timer and faults as VCD, for a waveform viewer",
     .open = files::vcd_sink,
     .in_folder = ""},
    {.option = "--json",
     .meaning = "write verdicts and figures as JSON; - writes to standard output",
     .open = files::json_sink,
     .in_folder = ".json",
     .printed = json_text},
    {.option = uart_option,
     .meaning = "write the serial output of the chip of --on avr or of your own firmware",
     .open = uart_sink,
     .in_folder = ""},
    {.option = page_option,
     .meaning = "write the report; for several files, a report that compares them",
     .open = report_sink,
     .in_folder = ".html",
     .foretold = report_foretold},
};

}  // namespace

std::span<const Format> formats() { return list; }

std::string all_options() {
  std::string text;
  for (const Format& format : list) text.append(text.empty() ? "" : ", ").append(format.option);
  return text;
}

}  // namespace cli
