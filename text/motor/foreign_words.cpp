// SPDX-License-Identifier: Apache-2.0
#include "text/motor/foreign_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "sixstep/base/angle.hpp"
#include "text/keys/decimal_number.hpp"

namespace text {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Returns the line of a position in the text. Positions must increase from call to call.
class LineCount {
 public:
  explicit LineCount(std::string_view text) : text_(text) {}
  std::size_t at(std::size_t place) {
    for (; counted_ < place && counted_ < text_.size(); ++counted_)
      if (text_[counted_] == '\n') ++line_;
    return line_;
  }

 private:
  std::string_view text_;
  std::size_t counted_ = 0, line_ = 1;
};

base::Problem cut_off(std::string_view missing) {
  return {.where = {},
          .value = {},
          .limit = "ends before its last " + std::string(missing),
          .cure = "the file is cut off or damaged: save it again"};
}

/// The lines of a text, with their numbers, without the comment that begins with `mark`.
template <class Each>
void for_each_line(std::string_view text, std::string_view mark, const Each& each) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    each(trimmed(row.substr(0, std::min(row.find(mark), row.size()))), line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// Where the first of several statements in a line of MATLAB ends. Brackets hold rows and arguments together.
std::size_t end_of_statement(std::string_view row) {
  int open = 0;
  for (std::size_t n = 0; n < row.size(); ++n) {
    const char c = row[n];
    if (c == '(' || c == '[' || c == '{') ++open;
    if (c == ')' || c == ']' || c == '}') --open;
    if (open <= 0 && (c == ';' || c == ',')) return n;
  }
  return row.size();
}

/// Splits "axis0.motor.config.pole_pairs" into its part and its last word.
ForeignWord word_of_path(std::string_view path, std::string_view value, std::size_t line) {
  const std::size_t last = path.rfind('.'), first = path.find('.');
  ForeignWord word{.name = std::string(path.substr(last == std::string_view::npos ? 0 : last + 1)),
                   .part = {},
                   .value = std::string(value),
                   .line = line};
  if (first != std::string_view::npos) word.part = path.substr(0, first);
  return word;
}

/// Reads a JSON text once, and records the keys of the open objects.
class JsonWalk {
 public:
  explicit JsonWalk(std::string_view text) : text_(text), lines_(text) {}

  base::Result<ForeignWords> words() {
    constexpr std::size_t deepest = 64;
    while (next() && open_.size() < deepest)
      if (!step()) return damaged();
    if (!open_.empty()) return cut_off("bracket");
    if (key_) return damaged();
    return std::move(out_);
  }

 private:
  bool next() {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    return at_ < text_.size();
  }

  bool step() {
    const char c = text_[at_];
    if (c == '{' || c == '[') {
      open_.push_back({c, std::exchange(key_, {}).value_or("")});
    } else if (c == '}' || c == ']') {
      if (open_.empty() || open_.back().first != (c == '}' ? '{' : '[')) return false;
      open_.pop_back();
    } else if (c != ',') {
      return c == '"' ? text_or_key() : plain();
    }
    ++at_;
    return true;
  }

  bool text_or_key() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
    if (end >= text_.size() || open_.empty()) return false;
    const std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    if (open_.back().first == '{' && !key_) {
      key_ = std::string(inside);
      if (!next() || text_[at_] != ':') return false;
      ++at_;
    } else {
      key_.reset();
    }
    return true;
  }

  bool plain() {
    const std::size_t end = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    const std::string_view value = text_.substr(at_, end - at_);
    if (open_.empty() || value.empty() || !std::isalnum(static_cast<unsigned char>(value.back())))
      return false;
    if (open_.back().first == '{') {
      if (!key_) return false;
      std::string path;
      for (const auto& [kind, name] : open_) path += name.empty() ? "" : name + ".";
      out_.push_back(word_of_path(path + *key_, value, lines_.at(at_)));
      key_.reset();
    }
    at_ = end;
    return true;
  }

  base::Problem damaged() {
    return {.where = {},
            .value = {},
            .limit = "has a JSON error in line " + std::to_string(lines_.at(at_)) + " on",
            .cure = "the file is cut off or damaged: save it again"};
  }

  std::string_view text_;
  LineCount lines_;
  std::size_t at_ = 0;
  std::vector<std::pair<char, std::string>> open_;
  std::optional<std::string> key_;
  ForeignWords out_;
};

/// The sketch without its comments; line ends remain.
std::string without_comments(std::string_view text) {
  std::string out;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const std::string_view rest = text.substr(n);
    if (rest.starts_with("//")) {
      n += std::min(rest.find('\n'), rest.size()) - 1;
    } else if (rest.starts_with("/*")) {
      const std::size_t size = std::min(rest.find("*/"), rest.size());
      for (const char c : rest.substr(0, size))
        if (c == '\n') out += c;
      n += size + 1;
    } else {
      out += text[n];
    }
  }
  return out;
}

/// The variable's name before "= BLDCMotor(", or between BLDCMotor and the bracket.
std::string variable_before(std::string_view text, std::size_t name, std::size_t bracket) {
  constexpr std::string_view constructor = "BLDCMotor";
  std::string_view between =
      trimmed(text.substr(name + constructor.size(), bracket - name - constructor.size()));
  if (between.empty()) {
    std::string_view before = trimmed(text.substr(0, name));
    if (!before.ends_with('=')) return {};
    before = trimmed(before.substr(0, before.size() - 1));
    const std::size_t blank = before.find_last_of(" \t\r\n;*");
    between = blank == std::string_view::npos ? before : before.substr(blank + 1);
  }
  return std::string(between);
}

/// "motor.phase_resistance = 0.23;" after the constructor, which it replaces.
void add_members(std::string_view text, const std::string& variable, std::size_t from, ForeignWords& out) {
  constexpr std::pair<const char*, const char*> members[] = {
      {".pole_pairs", "pp"}, {".phase_resistance", "R"}, {".phase_inductance", "Lq"}};
  if (variable.empty()) return;
  for (const auto& [member, name] : members) {
    const std::string path = variable + member;
    for (std::size_t at = text.find(path, from); at != std::string_view::npos; at = text.find(path, at + 1)) {
      std::string_view rest = trimmed(text.substr(at + path.size()));
      const bool whole = at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]));
      if (!whole || !rest.starts_with('=') || rest.starts_with("==")) continue;
      rest = rest.substr(1, std::min(rest.find(';'), rest.size()) - 1);
      out.push_back({name, variable, std::string(trimmed(rest)), LineCount(text).at(at)});
    }
  }
}

}  // namespace

base::Result<ForeignWords> words_of_xml(std::string_view text) {
  ForeignWords out;
  LineCount lines(text);
  std::string_view root;
  bool closed = false;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) return cut_off("bracket");
    const std::string_view name = text.substr(at + 1, end - at - 1);
    if (name.empty() || name[0] == '?' || name[0] == '!') continue;
    if (root.empty()) root = name.substr(0, name.find_first_of(blanks));
    if (name[0] == '/') {
      closed = closed || name.substr(1) == root;
      continue;
    }
    const std::size_t next = std::min(text.find('<', end), text.size());
    const std::string_view behind = text.substr(next, name.size() + 3);
    if (behind.starts_with("</") && behind.substr(2) == std::string(name) + ">")
      out.push_back(
          {std::string(name), {}, std::string(trimmed(text.substr(end + 1, next - end - 1))), lines.at(at)});
  }
  if (!closed) return cut_off("element, </" + std::string(root) + ">,");
  return out;
}

base::Result<ForeignWords> words_of_json(std::string_view text) { return JsonWalk(text).words(); }

ForeignWords words_of_lines(std::string_view text) {
  ForeignWords out;
  for_each_line(text, "#", [&out](std::string_view row, std::size_t line) {
    if (row.starts_with("conf set ")) row = trimmed(row.substr(9));
    const std::size_t blank = row.find_first_of(blanks);
    if (blank == std::string_view::npos) return;
    out.push_back({std::string(row.substr(0, blank)), {}, std::string(trimmed(row.substr(blank))), line});
  });
  return out;
}

ForeignWords words_of_matlab(std::string_view text) {
  ForeignWords out;
  for_each_line(text, "%", [&out](std::string_view row, std::size_t line) {
    while (!row.empty()) {
      const std::size_t end = end_of_statement(row), equals = row.find('='), dot = row.find('.');
      if (equals < end && dot < equals)
        out.push_back(word_of_path(trimmed(row.substr(0, equals)),
                                   trimmed(row.substr(equals + 1, end - equals - 1)), line));
      row.remove_prefix(std::min(end + 1, row.size()));
    }
  });
  return out;
}

base::Result<ForeignWords> words_of_sketch(std::string_view given) {
  constexpr std::array<std::string_view, 5> names = {"pp", "R", "KV", "Lq", "Ld"};
  constexpr std::string_view constructor = "BLDCMotor";
  const std::string kept = without_comments(given);
  const std::string_view text = kept;
  LineCount lines(text);
  ForeignWords out;
  for (std::size_t at = text.find(constructor); at != std::string_view::npos;
       at = text.find(constructor, at + 1)) {
    const std::size_t bracket = text.find_first_of("(;{})", at);
    if (bracket == std::string_view::npos || (text[bracket] != '(' && text[bracket] != '{')) continue;
    const std::string variable = variable_before(text, at, bracket);
    if (text[bracket] == '{' && variable.empty()) continue;  // a class
    const std::size_t end = text.find_first_of(");}", bracket);
    if (end == std::string_view::npos || text[end] == ';') return cut_off("bracket");
    std::string_view rest = text.substr(bracket + 1, end - bracket - 1);
    for (const std::string_view name : names) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      if (const std::string_view value = trimmed(rest.substr(0, comma)); !value.empty() && value != "NOT_SET")
        out.push_back({std::string(name), variable, std::string(value), lines.at(at)});
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    add_members(text, variable, end, out);
    at = end;
  }
  return out;
}

std::optional<double> foreign_number(std::string_view text) {
  double product = 1.0;
  char before = '*';
  for (text = trimmed(text);; text = trimmed(text)) {
    double factor = base::pi;
    if (text.starts_with("sqrt(")) {
      const DecimalNumber x = decimal_number(text.substr(5));
      if (x.kind != DecimalNumber::Kind::number || !text.substr(5 + x.size).starts_with(')')) return {};
      factor = std::sqrt(x.value);
      text.remove_prefix(x.size + 6);
    } else if (text.starts_with("pi")) {
      text.remove_prefix(2);
    } else {
      const DecimalNumber x = decimal_number(text);
      if (x.kind != DecimalNumber::Kind::number) return {};
      factor = x.value;
      text.remove_prefix(x.size);
      if (text.starts_with('f') || text.starts_with('F')) text.remove_prefix(1);
    }
    product = before == '*' ? product * factor : product / factor;
    text = trimmed(text);
    if (text.empty()) return std::isfinite(product) ? std::optional(product) : std::nullopt;
    before = text[0];
    if (before != '*' && before != '/') return {};
    text.remove_prefix(1);
  }
}

}  // namespace text
