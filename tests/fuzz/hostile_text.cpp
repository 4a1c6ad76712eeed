// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/hostile_text.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <vector>

#include "files/text_file.hpp"
#include "tests/fuzz/draw.hpp"
#include "tests/fuzz/drawn_scenario.hpp"
#include "tests/fuzz/hostile_literals.hpp"
#include "text/keys/key_catalog.hpp"

namespace sixstep::testing {
namespace {

namespace fs = std::filesystem;

/// The texts that are changed: every shipped scenario, and a file that uses all keys of the language.
const std::vector<std::string>& shipped() {
  static const std::vector<std::string> texts = [] {
    std::vector<fs::path> files{fs::path(SIXSTEP_SOURCE_DIR) /
                                "tests/fuzz/libfuzzer/seeds/toml/language.toml"};
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(SIXSTEP_SOURCE_DIR) / "data/scenarios"))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());  // a folder has no defined order
    std::vector<std::string> all;
    for (const fs::path& file : files)
      if (const auto text = files::read_text(file.string())) all.push_back(*text);
    return all;
  }();
  return texts;
}

const std::vector<text::KeyEntry>& keys() {
  static const std::vector<text::KeyEntry> all = [] {
    std::vector<text::KeyEntry> keys = text::scenario_keys();
    for (text::KeyEntry key : text::sheet_keys()) {
      key.path.insert(0, "motor_override.");
      keys.push_back(std::move(key));
    }
    return keys;
  }();
  return all;
}

class Breaker {
 public:
  explicit Breaker(std::uint64_t seed) : draw_(seed) {}

  BrokenText broken() {
    const auto n = static_cast<int>(shipped().size());
    text_ = draw_.chance(0.3) ? drawn_scenario(draw_.bits()).text : shipped()[at(n)];
    const char* kind = "";
    for (int times = 1 + draw_.one_of(3); times > 0; --times) kind = once();
    return {kind, std::move(text_)};
  }

 private:
  struct Way {
    const char* kind;
    int weight;
    void (Breaker::*breaks)();
  };
  static const Way ways[];

  const char* once() {
    if (text_.empty()) text_ = shipped()[0];
    int total = 0;
    for (const Way* w = ways; w->kind; ++w) total += w->weight;
    int drawn = draw_.one_of(total);
    const Way* way = ways;
    while (drawn >= way->weight) drawn -= (way++)->weight;
    (this->*way->breaks)();
    return way->kind;
  }

  std::size_t at(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(draw_.unit() * double(n)); }
  std::size_t at(int n) { return at(static_cast<std::size_t>(n)); }
  std::string literal() { return hostile_literals[at(std::size(hostile_literals))]; }
  const text::KeyEntry& key() { return keys()[at(keys().size())]; }
  static std::string repeated(std::string_view piece, std::size_t times) {
    std::string out;
    for (out.reserve(piece.size() * times); times > 0; --times) out += piece;
    return out;
  }

  /// A range between two characters of the set `ends`, as [begin, end).
  std::pair<std::size_t, std::size_t> stretch(const char* ends) {
    const std::size_t place = at(text_.size());
    const std::size_t begin = text_.find_last_of(ends, place), end = text_.find_first_of(ends, place);
    const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
    return {from, std::max(from, std::min(end, text_.size()))};
  }

  /// Replaces a value: the rest of a line after some '='.
  void value_in_place() {
    std::size_t sign = text_.find('=', at(text_.size()));
    if (sign == std::string::npos) sign = text_.find('=');
    if (sign == std::string::npos) return extra_key();
    const std::size_t end = std::min(text_.find('\n', sign), text_.size());
    text_.replace(sign + 1, end - sign - 1, " " + literal());
  }
  /// Changes a number of the file by some decades, or changes its sign.
  void number_in_place() {
    std::size_t place = text_.find_first_of("0123456789", at(text_.size()));
    if (place == std::string::npos) return value_in_place();
    const std::size_t end = std::min(text_.find_first_not_of("0123456789.e-", place), text_.size());
    static constexpr const char* ends[] = {"e3",   "e-3",   "e9",   "e-9",   "e18", "e-18",
                                           "e150", "e-150", "e300", "e-300", "0",   ""};
    const std::string number = text_.substr(place, end - place);
    text_.replace(place, end - place, (draw_.chance(0.2) ? "-" : "") + number + ends[at(std::size(ends))]);
  }
  /// Adds a key of the language: with its full path at the start of the file, or within its table.
  void extra_key() {
    const std::string path = key().path, line = path + " = " + literal() + "\n";
    const std::size_t dot = path.rfind('.');
    if (draw_.chance(0.5) || dot == std::string::npos)
      text_.insert(0, line);
    else
      text_ += "\n[" + path.substr(0, dot) + "]\n" + path.substr(dot + 1) + " = " + literal() + "\n";
  }
  /// Sets a key to a number at an end of its range, or next to this end.
  void end_of_range() {
    const text::KeyEntry& k = key();
    const auto& range = k.about.range;
    const double ends[] = {range.low, range.high, range.low * (1 - 1e-16), range.high * (1 + 1e-15)};
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", ends[at(4)]);
    text_.insert(0, k.path + " = " + text + "\n");
  }
  void bytes() {
    for (int n = 1 + draw_.one_of(8); n > 0; --n)
      text_[at(text_.size())] = static_cast<char>(draw_.one_of(256));
  }
  void binary() {
    std::string noise;
    for (std::size_t n = 1 + at(300); n > 0; --n) noise += static_cast<char>(draw_.one_of(256));
    if (draw_.chance(0.3))
      text_ = noise;
    else
      text_.insert(at(text_.size()), noise);
  }
  void cut() { text_.resize(at(text_.size())); }
  void piece_moved() {
    const bool lines = draw_.chance(0.5);
    const auto [begin, end] = stretch(lines ? "\n" : "\n =,[]{}\"");
    const std::string piece = text_.substr(begin, end - begin) + (lines ? "\n" : "");
    if (draw_.chance(0.5)) text_.erase(begin, end - begin);
    if (draw_.chance(0.7)) text_.insert(lines && begin <= text_.size() ? begin : at(text_.size()), piece);
  }
  void word_in_place() {
    const auto [begin, end] = stretch("\n =,[]{}\"");
    text_.replace(begin, end - begin, draw_.chance(0.5) ? literal() : key().path);
  }
  void doubled() {
    const auto [begin, end] = stretch("[");
    text_ += "\n[" + text_.substr(begin, end - begin) + "\n";
    if (draw_.chance(0.2)) text_ += text_;
  }
  void wrong_kind_of_table() {
    const std::size_t open = text_.find('[', at(text_.size()));
    if (open == std::string::npos) return doubled();
    if (text_.compare(open, 2, "[[") == 0)
      text_.erase(open, 1);
    else
      text_.insert(open, "[");
  }
  void line_ends() {
    static constexpr const char* ends[] = {"\r\n", "\r", "\n\n", "\v", "\xe2\x80\xa8", " \\\n"};
    const char* end = ends[at(std::size(ends))];
    std::string out = draw_.chance(0.3) ? "\xef\xbb\xbf" : "";
    for (const char c : text_) out += c == '\n' ? std::string(end) : std::string(1, c);
    text_ = out;
  }
  /// Length of names, texts and lists. Very long lengths are rare, because they cost time.
  std::size_t length() {
    return static_cast<std::size_t>(draw_.decades(10.0, draw_.chance(0.01) ? 2e5 : 2e3));
  }
  void deep_keys() {
    const std::string path = repeated("a.", length()) + "a";
    text_.insert(0, draw_.chance(0.5) ? path + " = 1\n" : "[" + path + "]\n");
  }
  void deep_values() {
    const std::size_t n = length();
    const bool lists = draw_.chance(0.5);
    const std::string open = repeated(lists ? "[" : "{a=", n), close = repeated(lists ? "]" : "}", n);
    text_.insert(0, key().path + " = " + open + (lists ? "" : "1") + (draw_.chance(0.8) ? close : "") + "\n");
  }
  void long_key() { text_.insert(0, repeated(draw_.chance(0.5) ? "k" : "\xc3\xa4", length()) + " = 1\n"); }
  void long_text() { text_.insert(0, key().path + " = \"" + repeated("x ", length()) + "\"\n"); }
  void long_list() {
    static constexpr const char* items[] = {"1",  "\"a\"", "true", "{}",
                                            "[]", "1e308", "nan",  "{ time_s = 1 }"};
    const std::string item = items[at(std::size(items))];
    text_.insert(0, key().path + " = [" + repeated(item + ", ", length()) + item + "]\n");
  }
  void many_tables() {
    static constexpr const char* tables[] = {"[[at]]\ntime_s = 0.001\nload.torque_Nm = 0.01\n",
                                             "[[require]]\nmetric = \"max\"\n",
                                             "[[at]]\n",
                                             "[[require]]\nmetric = 3\n",
                                             "[[compare]]\n",
                                             "[[spread]]\nkey = \"a\"\n"};
    text_ += "\n" + repeated(tables[at(std::size(tables))], 1 + length() / 20);
  }

  Draw draw_;
  std::string text_;
};

const Breaker::Way Breaker::ways[] = {{"a value replaced", 14, &Breaker::value_in_place},
                                      {"a number changed", 14, &Breaker::number_in_place},
                                      {"a key added", 14, &Breaker::extra_key},
                                      {"a key at its range's end", 8, &Breaker::end_of_range},
                                      {"a word replaced", 8, &Breaker::word_in_place},
                                      {"a piece moved, lost or doubled", 8, &Breaker::piece_moved},
                                      {"bytes changed", 6, &Breaker::bytes},
                                      {"binary", 3, &Breaker::binary},
                                      {"cut", 4, &Breaker::cut},
                                      {"a table doubled", 4, &Breaker::doubled},
                                      {"a table of the wrong kind", 4, &Breaker::wrong_kind_of_table},
                                      {"line ends", 2, &Breaker::line_ends},
                                      {"deep keys", 2, &Breaker::deep_keys},
                                      {"deep values", 2, &Breaker::deep_values},
                                      {"a long key", 1, &Breaker::long_key},
                                      {"a long text", 2, &Breaker::long_text},
                                      {"a long list", 2, &Breaker::long_list},
                                      {"many tables", 2, &Breaker::many_tables},
                                      {nullptr, 0, nullptr}};

}  // namespace

BrokenText broken_text(std::uint64_t seed) { return Breaker(seed).broken(); }

}  // namespace sixstep::testing
