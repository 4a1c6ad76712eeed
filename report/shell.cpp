// SPDX-License-Identifier: Apache-2.0
#include "report/shell.hpp"

#include <fmt/format.h>

#include <report_assets.hpp>

#include "report/html.hpp"

namespace report {
namespace {

std::string style(std::string_view css) { return fmt::format("<style>{}</style>\n", css); }

std::string filled_shell(const Shell& s, std::string_view styles, std::string_view scripts) {
  return filled(assets::shell_html,
                {{"title", s.title},
                 {"styles", styles},
                 {"main", s.main_class.empty() ? "" : fmt::format(" class=\"{}\"", s.main_class)},
                 {"body", s.body},
                 {"version", escaped(s.version)},
                 {"command", escaped(s.command)},
                 {"scripts", scripts}});
}

}  // namespace

std::string in_shell(const Shell& shell) { return filled_shell(shell, style(assets::report_css), ""); }

std::string in_shell(const Shell& shell, std::string_view data,
                     std::initializer_list<std::string_view> scripts) {
  std::string own;
  for (const std::string_view script : scripts) own.append(script);
  const std::string charts = shell.charts ? fmt::format("<!-- Charts: uPlot.\n{}-->\n<script>{}</script>\n",
                                                        assets::LICENSE, assets::uPlot_iife_min_js)
                                          : std::string();
  const std::string code = fmt::format(
      "<script type=\"application/json\" id=\"data\">{}</script>\n{}<script>\n(() => {{\n\"use strict\";\n{}}})();\n</script>\n",
      script_safe(data), charts, own);
  const std::string styles = style(assets::report_css);
  return filled_shell(shell, shell.charts ? style(assets::uPlot_min_css) + styles : styles, code);
}

}  // namespace report
