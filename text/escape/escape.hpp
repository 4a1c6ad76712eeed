// SPDX-License-Identifier: Apache-2.0
// Names and texts of others on their way out: a title, a label, a key or a file's name may hold any bytes,
// and none of them may act on what shows it, reads it or runs it. One function per target. Numbers and words of
// our own need none.
#pragma once
#include <string>
#include <string_view>

namespace text {

/// The character at `at`, which moves behind it. What is no UTF-8 counts byte by byte as U+FFFD.
char32_t next_character(std::string_view text, std::size_t& at);

enum class Lines { shown, kept };

/// For a terminal, a log and a line of comment: what would move the cursor, colour, hide, reorder or end a
/// line stands as \u001b, what is no UTF-8 as U+FFFD. With Lines::kept a text may have lines and tabs. Inside
/// the strings of JSON and TOML the escapes mean the character that they stand for.
std::string visible(std::string_view text, Lines lines = Lines::shown);

/// One word of a command line, as a shell takes it again: quoted where it has to be, and visible.
std::string shell_word(std::string_view word);

/// Text or an attribute of HTML and of XML: visible, for XML 1.0 cannot hold every character.
std::string markup_text(std::string_view text, Lines lines = Lines::shown);

/// A file's name as a relative URL: no colon begins a scheme, no # or ? ends the name.
std::string url_of_name(std::string_view name);

/// A line of // in C++: nothing in it ends the line or continues it, neither a last backslash nor its
/// trigraph.
std::string comment_text(std::string_view text);

/// A comment of a VCD file: visible, and nothing ends it.
std::string vcd_text(std::string_view text);

/// A string of TOML, with its quotes.
std::string toml_text(std::string_view text);

}  // namespace text
