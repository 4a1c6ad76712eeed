// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/motor_command.hpp"

#include <fmt/format.h>

#include <optional>

#include "faces/cli/terminal.hpp"
#include "io/motor_library.hpp"
#include "io/scenario_file.hpp"
#include "sixstep/design/sheet_description.hpp"

namespace cli {
namespace {

/// Visits a sheet and writes one line per value that it gives.
class SheetText {
 public:
  template <class T>
  void value(std::string_view key, const T& member, const base::About& about) {
    const std::string text = fmt::format("{}", member);
    if (!text.empty()) add(key, text, about.unit, "", "");
  }
  template <class Enum, class Choices>
  void choice(std::string_view key, const Enum& member, const Choices& choices, const base::About&) {
    add(key, base::word(choices, member), "", "", "");
  }
  void quantity(std::string_view key, const base::Quantity& q, const base::About& about) {
    add(key, fmt::format("{}", q.value), about.unit, q.frame, q.source);
  }
  void quantity(std::string_view key, const std::optional<base::Quantity>& q, const base::About& about) {
    if (q) quantity(key, *q, about);
  }
  const std::string& text() const { return text_; }

 private:
  void add(std::string_view key, std::string_view value, std::string_view unit, std::string_view frame,
           std::string_view source) {
    std::string row = fmt::format("{:<24} {:>10} {:<7}{:<10}{}", key, value, unit, frame, source);
    row.erase(row.find_last_not_of(' ') + 1);
    text_ += row + "\n";
  }
  std::string text_;
};

}  // namespace

Exit list_motors() {
  for (const std::string& name : io::built_in_motors()) print(name + "\n");
  return Exit::ok;
}

Exit show_motor(const std::string& name, const std::string& data_dir) {
  base::Result<design::Sheet> sheet = io::read_sheet(name, data_dir);
  if (!sheet) {
    complain(sheet.problems());
    return Exit::bad_input;
  }
  SheetText text;
  describe(text, *sheet);
  print(text.text());
  return Exit::ok;
}

}  // namespace cli
