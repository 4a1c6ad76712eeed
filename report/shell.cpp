// SPDX-License-Identifier: Apache-2.0
#include "report/shell.hpp"

#include <fmt/format.h>

#include <report_assets.hpp>

#include "report/html.hpp"

namespace report {
namespace {

std::string style(std::string_view css) { return fmt::format("<style>{}</style>\n", css); }

std::string filled_shell(const Shell& s, std::string_view styles, std::string_view scripts) {
  return filled(assets::shell_html(),
                {{"title", s.title},
                 {"styles", styles},
                 {"main", s.main_class.empty() ? "" : fmt::format(" class=\"{}\"", s.main_class)},
                 {"body", s.body},
                 {"version", escaped(s.version)},
                 {"command", escaped(s.command)},
                 {"scripts", scripts}});
}

}  // namespace

std::string in_shell(const Shell& shell) { return filled_shell(shell, style(assets::report_css()), ""); }

std::string in_shell(const Shell& shell, std::string_view data,
                     const std::vector<std::string_view>& scripts) {
  std::string code = "<script type=\"application/json\" id=\"data\">";
  code += script_safe(data);  // the data are nearly the whole page
  code += "</script>\n";
  if (shell.charts) {
    code.append("<!-- Charts: uPlot.\n").append(assets::LICENSE()).append("-->\n<script>");
    code.append(assets::uPlot_iife_min_js()).append("</script>\n");
  }
  code += "<script>\n(() => {\n\"use strict\";\n";
  for (const std::string_view script : scripts) code.append(script);
  code += "})();\n</script>\n";
  const std::string styles = style(assets::report_css());
  return filled_shell(shell, shell.charts ? style(assets::uPlot_min_css()) + styles : styles, code);
}

}  // namespace report
