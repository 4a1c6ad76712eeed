// SPDX-License-Identifier: Apache-2.0
// Escapes foreign names and texts for output, with one function per target. A title, a label, a key or a file
// name may contain any bytes, and none of these bytes may act on the program that displays, reads or runs the
// output. The program's own numbers and words need no escaping.
#pragma once
#include <string>
#include <string_view>

namespace text {

/// Returns the character at `at` and advances `at` to the next character. Each byte that is not UTF-8 becomes
/// U+FFFD.
char32_t next_character(std::string_view text, std::size_t& at);

enum class Lines { shown, kept };

/// Returns the text for a terminal, a log or a comment line. A character that would move the cursor, colour,
/// hide, reorder or end a line becomes an escape such as \u001b. A byte that is not UTF-8 becomes U+FFFD.
/// Lines::kept keeps line ends and tabs. Within strings of JSON and TOML, such an escape still means the
/// original character.
std::string visible(std::string_view text, Lines lines = Lines::shown);

/// One word of a command line that a shell reads back: quoted if needed, and visible().
std::string shell_word(std::string_view word);

/// Returns text or an attribute's value for HTML and XML. The text is visible() too, because XML 1.0 does not
/// allow every character.
std::string markup_text(std::string_view text, Lines lines = Lines::shown);

/// Returns a file's name as a relative URL, in which no colon begins a scheme and no # or ? ends the name.
std::string url_of_name(std::string_view name);

/// Returns text for a // line of C++. The text cannot end the line, and cannot continue the comment on the
/// next line by a backslash or trigraph.
std::string comment_text(std::string_view text);

/// Returns text for a comment of a VCD file: visible(), without the word that would end the comment.
std::string vcd_text(std::string_view text);

/// Returns a string of TOML, including its quotes.
std::string toml_text(std::string_view text);

}  // namespace text
