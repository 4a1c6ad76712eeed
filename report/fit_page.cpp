// SPDX-License-Identifier: Apache-2.0
#include "report/fit_page.hpp"

#include <fmt/format.h>

#include <report_assets.hpp>

#include "report/bench_facts.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/shell.hpp"
#include "text/escape/escape.hpp"
#include "text/results/fit_text.hpp"
#include "text/results/interval_text.hpp"

namespace report {
namespace {

using sixstep::analysis::FitColumn;
using sixstep::analysis::FittedValue;

std::string facts(const FitPage& page) {
  std::string out;
  for (const FittedValue& v : page.fit.values)
    if (const std::string_view key = motor_key(v); !key.empty())
      out += bench_fact(key, v.at_zero ? fmt::format("≤ {:.3g} {}", v.value.high, v.unit)
                                       : text::with_bounds(v.value, v.unit.c_str()));
  return out;
}

/// Recorded and simulated values of one column; below them the difference.
std::string charts(const FitColumn& column) {
  const std::string name = fmt::format("{} of {}", column.column.name, text::visible(column.bench));
  SvgChart over{.title = name + ": recorded, and simulated over it",
                .x_label = "ms",
                .y_label = column.column.unit,
                .levels = {0.0}};
  SvgChart under{.title = name + ": recorded minus simulated",
                 .x_label = "ms",
                 .y_label = column.column.unit,
                 .levels = {0.0}};
  SvgCurve recorded{"recorded", curve_styles[0], {}, {}}, model{"simulated", "reference", {}, {}},
      difference{"difference", curve_styles[0], {}, {}};
  const std::size_t stride = thinned_stride(column.t_s.size());
  for (std::size_t n = 0; n < column.t_s.size(); n += stride) {
    const double t_ms = 1e3 * column.t_s[n];
    for (SvgCurve* const curve : {&recorded, &model, &difference}) curve->x.push_back(t_ms);
    recorded.y.push_back(column.recorded[n]);
    model.y.push_back(column.model[n]);
    difference.y.push_back(column.recorded[n] - column.model[n]);
  }
  over.curves = {std::move(recorded), std::move(model)};
  under.curves = {std::move(difference)};
  return svg_chart(over) + svg_chart(under);
}

}  // namespace

std::string render_fit(const FitPage& page) {
  const std::string title = "Constants fitted to recordings";
  std::string pictures;
  for (const FitColumn& column : page.fit.columns) pictures += charts(column);
  const std::string body =
      filled(assets::bench_html(),
             {{"title", title},
              {"subtitle", escaped(fmt::format("{} columns, {} simulations", page.fit.columns.size(),
                                               grouped(static_cast<long long>(page.fit.simulations))))},
              {"facts", facts(page)},
              {"pictured", "Recorded and simulated"},
              {"charts", pictures},
              {"text", escaped(text::fit_text(page.fit, page.sheet))}});
  return in_shell({.title = title, .body = body, .command = page.command, .version = page.version});
}

}  // namespace report
