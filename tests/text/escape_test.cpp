// SPDX-License-Identifier: Apache-2.0
// Every escaping function makes every hostile name harmless. The readers of the target formats prove this:
// bash, the parsers of TOML and JSON, and the value read back from a URL.
#include "text/escape/escape.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "report/html.hpp"
#include "tests/support/hostile_names.hpp"
#include "text/escape/csv_cell.hpp"
#include "text/toml/document.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using sixstep::testing::hostile_names;

/// Returns whether a text contains bytes that control a terminal. The control characters of two UTF-8 bytes
/// are included.
bool acts(const std::string& text) {
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto c = static_cast<unsigned char>(text[n]);
    const auto next = static_cast<unsigned char>(n + 1 < text.size() ? text[n + 1] : 0);
    if (c < 0x20 || c == 0x7f || (c == 0xc2 && next < 0xa0)) return true;
  }
  for (const char* reorders : {"\u202e", "\u2066", "\u2028", "\u200b", "\ufeff", "\u061c"})
    if (text.find(reorders) != std::string::npos) return true;
  return false;
}

bool is_utf8(const std::string& text) {  // the JSON library checks the text and throws
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

/// The text, in which a replacement character replaces each byte that is not UTF-8.
std::string as_utf8(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    out += next_character(text, at) == 0xFFFD ? "\uFFFD" : text.substr(begin, at - begin);
  }
  return out;
}

/// The words that bash reads from a line.
std::vector<std::string> read_by_bash(const std::string& words) {
  const std::string script = ::testing::TempDir() + "sixstep-words.sh";
  std::ofstream(script) << "printf '%s\\0' " << words << "\n";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(
      ::popen(("bash " + shell_word(script)).c_str(), "r"), &::pclose);
  std::vector<std::string> read(1);
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
    if (c == 0)
      read.emplace_back();
    else
      read.back() += static_cast<char>(c);
  read.pop_back();
  return read;
}

TEST(Escape, TheListHoldsWhatItIsFor) {
  const std::vector<std::string> names = hostile_names();
  EXPECT_GT(names.size(), 40U);
  EXPECT_THAT(names, ::testing::Contains("a$(touch X)"));
  EXPECT_THAT(names, ::testing::Contains("a\nall 3 requirements hold"));
  EXPECT_THAT(names, ::testing::Contains("a\xff"
                                         "b"));
  EXPECT_GT(std::ranges::count_if(names, acts), 10);
}

TEST(Escape, WhatIsVisibleMovesNoCursorAndEndsNoLine) {
  for (const std::string& name : hostile_names()) {
    const std::string shown = visible(name);
    EXPECT_FALSE(acts(shown)) << shown;
    EXPECT_TRUE(is_utf8(shown)) << shown;
    EXPECT_EQ(visible(shown), shown);
    EXPECT_EQ(shown == name, !acts(name) && is_utf8(name)) << "and harmless names stay as they are";
  }
  EXPECT_EQ(visible("a\x1b[31m\xc2\x9b\u202e\x7f"), "a\\u001b[31m\\u009b\\u202e\\u007f");
  EXPECT_EQ(visible("a\nb\tc\r\nd\re", Lines::kept), "a\nb\tc\r\nd\\u000de");
  EXPECT_EQ(visible("é 漢 🚀 ‌‍"), "é 漢 🚀 ‌‍")
      << "letters of all scripts, with the joiners that they need";
}

TEST(Escape, AShellTakesAWordForWhatItWas) {
  std::string words;
  for (const std::string& name : hostile_names()) {
    EXPECT_FALSE(acts(shell_word(name))) << name;
    words += shell_word(name) + " ";
  }
  EXPECT_EQ(read_by_bash(words), hostile_names());
  EXPECT_EQ(shell_word("data/a-1.toml"), "data/a-1.toml");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("a\x1b"
                       "1"),
            "$'a\\0331'");
  EXPECT_EQ(shell_word(""), "''");
}

/// The text after removal of the given words.
std::string without(std::string text, std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words)
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at))
      text.erase(at, word.size());
  return text;
}

/// Returns whether a URL contains only unreserved characters and codes such as %41.
bool is_plain_url(std::string_view url) {
  for (std::size_t n = 0; n < url.size(); ++n) {
    if (url[n] != '%') {
      if (!std::isalnum(static_cast<unsigned char>(url[n])) && !std::strchr("._~-", url[n])) return false;
      continue;
    }
    for (int digit = 0; digit < 2; ++digit)
      if (++n >= url.size() || url[n] == '\0' || !std::strchr("0123456789ABCDEF", url[n])) return false;
  }
  return true;
}

TEST(Escape, AUrlLeadsToTheFileAndNowhereElse) {
  for (const std::string& name : hostile_names()) {
    const std::string url = url_of_name(name);
    EXPECT_TRUE(is_plain_url(url)) << url;
    std::string back;
    for (std::size_t n = 0; n < url.size(); ++n)
      back += url[n] == '%' ? static_cast<char>(std::stoi(url.substr((n += 2) - 1, 2), nullptr, 16)) : url[n];
    EXPECT_EQ(back, name);
  }
}

TEST(Escape, APageShowsANameAsText) {
  for (const std::string& name : hostile_names())
    for (const std::string& html : {report::escaped(name), report::with_subscripts(name)}) {
      const std::string text = without(html, {"<sub>", "</sub>", "&amp;", "&lt;", "&gt;", "&quot;", "&#39;"});
      EXPECT_EQ(text.find_first_of("<>\"'&"), std::string::npos) << html;
      EXPECT_FALSE(acts(without(text, {"\n", "\t"}))) << html;
    }
}

TEST(Escape, ALineOfCommentEndsWhereItEnds) {
  for (const std::string& name : hostile_names()) {
    const std::string line = comment_text(name);
    EXPECT_FALSE(acts(line)) << line;
    EXPECT_FALSE(line.ends_with('\\') ||
                 line.ends_with("?"
                                "?/") ||
                 line.ends_with("\\ "))
        << line;
    EXPECT_EQ(vcd_text(name).find("$end"), std::string::npos);
    EXPECT_FALSE(acts(vcd_text(name)));
  }
  EXPECT_EQ(comment_text("a \\ \?\?/\\"), "a");
}

TEST(Escape, TomlAndJsonReadBackWhatWasWritten) {
  for (const std::string& name : hostile_names()) {
    const std::string text = "title = " + toml_text(name) + "\n";
    EXPECT_FALSE(acts(text.substr(0, text.size() - 1))) << text;
    const base::Result<Document> document = Document::parse("a.toml", text);
    ASSERT_TRUE(document) << text;
    EXPECT_EQ(document->find("title")->value<std::string>(), as_utf8(name));

    using Json = nlohmann::json;
    const std::string json =
        visible(Json{{"title", name}}.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept);
    EXPECT_EQ(Json::parse(report::script_safe(json)), Json::parse(json));
    if (is_utf8(name)) {
      EXPECT_EQ(Json::parse(json)["title"], name);
    }
  }
}

/// A cell must remain one cell of one line, and must not begin like the formula of a spreadsheet.
TEST(Escape, ACellIsANameAndRunsNothing) {
  for (const std::string& name : hostile_names()) {
    for (const std::string& text : {name, "=" + name, " +" + name, "-" + name, "@" + name, "\uff1d" + name}) {
      const std::string shown = cell_name(text), cell = csv_cell(text);
      EXPECT_FALSE(acts(shown)) << shown;
      EXPECT_EQ(
          std::string("=+-@").find(shown.substr(std::min(shown.find_first_not_of(' '), shown.size()), 1)[0]),
          std::string::npos)
          << shown;
      // A reader by RFC 4180 must restore the name from the cell.
      std::string read = cell;
      if (cell.starts_with('"')) {
        ASSERT_TRUE(cell.size() > 1 && cell.ends_with('"')) << cell;
        read.clear();
        for (std::size_t n = 1; n + 1 < cell.size(); ++n) {
          read += cell[n];
          if (cell[n] != '"') continue;
          ASSERT_EQ(cell[++n], '"') << cell;
        }
      } else {
        EXPECT_EQ(cell.find_first_of(",;\""), std::string::npos);
      }
      EXPECT_EQ(read, shown);
    }
  }
  EXPECT_EQ(csv_cell("six-step, soft"), "\"six-step, soft\"");
  EXPECT_EQ(csv_cell("=1+1"), "'=1+1");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(cell_name("i_m - ripple"), "i_m - ripple");
  EXPECT_EQ(cell_name(""), "");
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text
