// SPDX-License-Identifier: Apache-2.0
// Writes the parts of every page: head, style, the line with the command, the scripts.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace report {

struct Shell {
  std::string title;  ///< title of the window, escaped
  std::string body;   ///< HTML from the heading on
  std::string_view command;
  std::string_view version;
  std::string_view main_class = {};
  bool charts = true;  ///< true: the page's scripts draw with uPlot
};

/// A page without a script.
std::string in_shell(const Shell& shell);

/// A page with charts. `data` is the JSON that the scripts read. The scripts share one scope and run in the
/// given order, after uPlot if `charts` is true.
std::string in_shell(const Shell& shell, std::string_view data, const std::vector<std::string_view>& scripts);

}  // namespace report
