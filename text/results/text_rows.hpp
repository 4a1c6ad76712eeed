// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace text {

/// A table of text. Each column is as wide as its widest cell, with cells at the left or the right; lines
/// have no blanks at their ends.
class Rows {
 public:
  enum class Side { left, right };
  explicit Rows(Side side = Side::left) : side_(side) {}
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  std::string text() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_)
      for (std::size_t n = 0; n < row.size(); ++n) {
        if (n == widths.size()) widths.push_back(0);
        widths[n] = std::max(widths[n], row[n].size());
      }
    std::string out;
    for (const auto& row : rows_) {
      std::string line = " ";
      for (std::size_t n = 0; n < row.size(); ++n)
        line += side_ == Side::left ? fmt::format(" {:<{}} ", row[n], widths[n])
                                    : fmt::format(" {:>{}} ", row[n], widths[n]);
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + "\n";
    }
    return out;
  }

 private:
  Side side_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace text
