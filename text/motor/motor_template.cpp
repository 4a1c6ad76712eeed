// SPDX-License-Identifier: Apache-2.0
#include "text/motor/motor_template.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/escape/escape.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/keys/template_line.hpp"
#include "text/motor/motor_styles.hpp"

namespace text {
namespace {

/// The entry in another spelling, with the spelling's unit. For a linear motor the key already has its
/// spelling.
KeyEntry as_spelled(const KeyEntry& entry, std::string_view key) {
  for (const base::Spelling& spelling : entry.about.also)
    if (spelling.key == key) return spelled(entry, spelling);
  return entry;
}

/// The placeholder frame = "terminal|phase" is invalid until the user deletes one of the two words, because
/// no frame has that name.
std::string empty_value(const KeyEntry& entry) {
  if (entry.type == KeyType::text) return "\"\"";
  if (entry.type == KeyType::flag) return "true";
  if (entry.type != KeyType::quantity) return "0";
  if (frames_of(entry.about.frame).size() < 2) return "{ value = nan, source = \"data sheet\" }";
  return fmt::format("{{ value = nan, frame = \"{}\", source = \"data sheet\" }}", entry.about.frame);
}

/// Writes the line of a key. The comment above the line states what is different on such a sheet.
std::string line(const MotorStyle& style, const KeyEntry& given, std::string_view key, bool needed) {
  const KeyEntry entry = as_spelled(given, key);
  const bool choice = frames_of(entry.about.frame).size() > 1;
  std::string text;
  for (const auto& [of, note] : style.notes)
    if (of == key) text += wrapped_comment(note);
  return text + template_line(entry, {.key = key,
                                      .value = empty_value(entry),
                                      .open = needed,
                                      .more = choice ? "frame: keep the word that fits the sheet" : ""});
}

}  // namespace

std::vector<std::string> template_styles() {
  std::vector<std::string> names;
  for (const MotorStyle& style : motor_styles()) names.emplace_back(style.name);
  return names;
}

base::Result<std::string> motor_template(std::string_view style_name, const std::string& name) {
  const auto style = std::find_if(motor_styles().begin(), motor_styles().end(),
                                  [&](const MotorStyle& s) { return s.name == style_name; });
  if (style == motor_styles().end())
    return base::Problem{.where = "--style",
                         .value = std::string(style_name),
                         .limit = fmt::format("is none of {}", fmt::join(template_styles(), ", ")),
                         .cure = "choose the style whose sheet looks like yours"};
  const std::vector<KeyEntry> keys = style->linear ? in_linear_words(sheet_keys()) : sheet_keys();
  std::string text = fmt::format(
      "# A motor, to be filled in from its sheet: {}.\n"
      "# Replace each nan by a number; remove the # from other lines that the sheet has. sixstep help KEY\n"
      "# explains a key, and sixstep motor check FILE reports values that contradict each other.\n"
      "# Type the zeros as the sheet prints them (4.00): the check allows each value half of its last digit.\n"
      "name = {}\nmaker = \"{}\"\n{}\n"
      "# shape of the back-EMF over the electrical angle, trapezoid or sine: sheets rarely state it\n"
      "back_emf = \"{}\"\n\n",
      style->what, toml_text(name), style->name == "maxon" ? "maxon" : "",
      style->linear ? "kind = \"linear\"  # the motor moves along a line\n" : "", style->shape);
  for (const std::string_view key : style->needed)
    if (const KeyEntry* entry = find_key(keys, key)) text += line(*style, *entry, key, true);
  text += "\n";
  for (const std::string_view key : style->optional)
    if (const KeyEntry* entry = find_key(keys, key)) text += line(*style, *entry, key, false);
  return text;
}

}  // namespace text
