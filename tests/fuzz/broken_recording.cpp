// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/broken_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>
#include <vector>

#include "tests/fuzz/draw.hpp"
#include "tests/fuzz/hostile_literals.hpp"

namespace sixstep::testing {
namespace {

using Table = std::vector<std::vector<std::string>>;

/// Texts that instruments write instead of a number. They are used in addition to hostile_literals.hpp.
constexpr const char* cells[] = {"",       "---",    "OL",       "#DIV/0!", "1,5",      "1.2.3",
                                 "+5",     ".5",     "1e",       "0x1",     "12:30:01", "1e12",
                                 "1.1e12", "1e-300", "-1e-12",   "3.3 V",   "-0",       "7",
                                 "8",      "\"4\"",  "\xff\xfe", "0.1e-3",  "1e15",     "99999999999"};
constexpr const char* headings[] = {"time [s]", "time", "t_ms",      "hall",        "hall1",     "hall2",
                                    "hall3",    "u_ab", "u_bc [mV]", "u_ca (kV)",   "u_a",       "u_b_V",
                                    "u_c",      "CH1",  "",          "time [V]",    "hall1 [s]", "[s]",
                                    "s",        "V",    "\x1b[31m",  "\xe2\x80\xae"};

/// A recording of a motor that is turned at constant speed, with six to forty rows per sector. It contains
/// Hall lines, a code or voltages, with or without a heading. The table is valid; other functions damage it.
Table drawn_table(Draw& draw) {
  const int kind = draw.one_of(5), rows = 12 * (20 + draw.one_of(60));
  const double row_deg = draw.decades(1.5, 10.0), row_s = draw.decades(1e-6, 1e-2),
               peak_V = draw.decades(1e-2, 1e2);
  const bool hall = kind < 3, volts = kind != 0;
  Table out(1);
  out[0] = {"time [s]"};
  if (hall) out[0].insert(out[0].end(), {"hall1", "hall2", "hall3"});
  if (volts) out[0].insert(out[0].end(), {"u_ab [V]", "u_bc [V]", "u_ca [V]"});
  constexpr int codes[] = {0b100, 0b110, 0b010, 0b011, 0b001, 0b101};  // docs/reference/notation.md
  for (int row = 0; row < rows; ++row) {
    const double deg = row_deg * row;
    std::vector<std::string> line{fmt::format("{:.9g}", row_s * row)};
    const int code = codes[static_cast<int>(deg / 60.0) % 6];
    for (int bit = 2; hall && bit >= 0; --bit) line.push_back(std::to_string(code >> bit & 1));
    for (int k = 0; volts && k < 3; ++k)  // u_ab leads e_a, whose middle is at 60 degrees, by 30 degrees
      line.push_back(
          fmt::format("{:.4g}", peak_V * (std::cos((deg - 30.0 - 120.0 * k) * std::numbers::pi / 180.0) +
                                          0.01 * draw.between(-1.0, 1.0))));
    out.push_back(std::move(line));
  }
  if (!hall && draw.chance(0.3)) out.erase(out.begin());
  return out;
}

std::string written(const Table& table, const std::string& separator, const std::string& line_end) {
  std::string out;
  for (const std::vector<std::string>& line : table) {
    for (std::size_t n = 0; n < line.size(); ++n) out += (n == 0 ? "" : separator) + line[n];
    out += line_end;
  }
  return out;
}

class RecordingBreaker {
 public:
  explicit RecordingBreaker(std::uint64_t seed) : draw_(seed), table_(drawn_table(draw_)) {}

  BrokenRecording broken() {
    const char* kind = "nothing";
    for (int times = draw_.one_of(4); times > 0; --times) kind = in_table();
    constexpr const char* separators[] = {",", ",", ",", ";", "\t", " ", "|", ", ", ":", ",,"};
    constexpr const char* line_ends[] = {"\n", "\n", "\n", "\r\n", "\r", "\n\n", ""};
    std::string text = written(table_, one_of(separators), one_of(line_ends));
    for (int times = draw_.chance(0.3) ? 1 + draw_.one_of(3) : 0; times > 0; --times) kind = in_bytes(text);
    return {kind, std::move(text)};
  }

 private:
  template <class List>
  const char* one_of(const List& list) {
    return list[at(std::size(list))];
  }
  std::size_t at(std::size_t size) {
    return size == 0 ? 0 : static_cast<std::size_t>(draw_.one_of(static_cast<int>(size)));
  }
  std::vector<std::string>& line() { return table_[at(table_.size())]; }

  const char* in_table() {
    if (table_.empty() || table_[0].empty()) return "left alone";
    const std::size_t column = at(table_[0].size());
    const int kind = draw_.one_of(13);
    const bool of_columns = kind == 5 || kind == 6 || kind == 7 || kind == 10 || kind == 12;
    return of_columns ? in_columns(kind, column) : in_lines(kind);
  }

  const char* in_lines(int kind) {
    switch (kind) {
      case 0:
        return of_cell(line(), draw_.chance(0.5) ? one_of(cells) : one_of(hostile_literals));
      case 1:
        return of_cell(table_[0], one_of(headings));
      case 2:
        table_.resize(at(table_.size()) + 1);
        return "cut short";
      case 3:
        table_.erase(table_.begin() + static_cast<std::ptrdiff_t>(at(table_.size())));
        return "a line missing";
      case 4: {
        const std::vector<std::string> copy = line();
        table_.insert(table_.begin() + static_cast<std::ptrdiff_t>(at(table_.size())), copy);
        return "a line repeated elsewhere";
      }
      case 8:
        line().resize(at(8));
        return "a line of another length";
      case 9:
        std::reverse(table_.begin() + 1, table_.end());
        return "backward";
      default:
        return bounce();
    }
  }

  const char* in_columns(int kind, std::size_t column) {
    switch (kind) {
      case 5:
        for (auto& cells_of_line : table_)
          if (column < cells_of_line.size())
            cells_of_line.erase(cells_of_line.begin() + static_cast<std::ptrdiff_t>(column));
        return "a column missing";
      case 6: {
        const char* const same = draw_.chance(0.5) ? one_of(cells) : one_of(hostile_literals);
        for (std::size_t n = 1; n < table_.size(); ++n)
          if (column < table_[n].size()) table_[n][column] = same;
        return "a column of one value";
      }
      case 7:
        return scale(column, draw_.chance(0.5) ? draw_.decades(1e-30, 1e30) : draw_.decades(1e-6, 1e6));
      case 10:
        for (std::size_t n = 1; n < table_.size(); ++n)
          if (column < table_[n].size() && draw_.chance(0.1))
            table_[n][column] = draw_.chance(0.5) ? "0" : "1";
        return "a loose contact";
      default: {
        const std::size_t other = at(table_[0].size());
        for (auto& cells_of_line : table_)
          if (std::max(column, other) < cells_of_line.size())
            std::swap(cells_of_line[column], cells_of_line[other]);
        return "two columns swapped";
      }
    }
  }

  const char* of_cell(std::vector<std::string>& cells_of_line, const char* text) {
    if (!cells_of_line.empty()) cells_of_line[at(cells_of_line.size())] = text;
    return "a strange cell";
  }

  const char* scale(std::size_t column, double factor) {
    for (std::size_t n = 1; n < table_.size(); ++n)
      if (column < table_[n].size())
        table_[n][column] = fmt::format("{:.9g}", std::strtod(table_[n][column].c_str(), nullptr) * factor);
    return "a column in another unit";
  }

  /// Simulates a bouncing contact: the rows of a range alternate.
  const char* bounce() {
    const std::size_t from = at(table_.size()), length = std::min(table_.size() - from, at(60));
    const std::vector<std::string> other = line();
    for (std::size_t n = from; n < from + length; n += 2)
      for (std::size_t c = 1; c < std::min(table_[n].size(), other.size()); ++c) table_[n][c] = other[c];
    return "a burst";
  }

  const char* in_bytes(std::string& text) {
    if (text.empty()) return "empty";
    const std::size_t place = at(text.size());
    switch (draw_.one_of(5)) {
      case 0:
        text.resize(place);
        return "cut in the middle";
      case 1:
        text[place] = static_cast<char>(draw_.one_of(256));
        return "a byte";
      case 2:
        for (int n = 20; n > 0; --n)
          text.insert(text.begin() + static_cast<std::ptrdiff_t>(place),
                      static_cast<char>(draw_.one_of(256)));
        return "rubbish within";
      case 3:
        text.insert(place, text.substr(place / 2, 2000));
        return "a part twice";
      default:
        for (char& c : text)
          if (draw_.chance(0.01)) c = static_cast<char>(draw_.one_of(256));
        return "noise";
    }
  }

  Draw draw_;
  Table table_;
};

}  // namespace

BrokenRecording broken_recording(std::uint64_t seed) { return RecordingBreaker(seed).broken(); }

}  // namespace sixstep::testing
