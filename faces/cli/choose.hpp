// SPDX-License-Identifier: Apache-2.0
// Reads an option whose value is one of a few words.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"
#include "text/keys/key_advice.hpp"

namespace cli {

/// Adds a Problem if the word is not one of the choices.
template <class Choices, class Enum>
void choose(const char* option, const std::string& word, const Choices& choices, Enum& into,
            base::Problems& found) {
  std::vector<std::string> known;
  for (const auto& choice : choices) {
    if (choice.word == word) {
      into = choice.value;
      return;
    }
    known.emplace_back(choice.word);
  }
  const std::string near = text::nearest(word, known);
  found.push_back(
      {option, word, fmt::format("must be one of {}", fmt::join(known, ", ")),
       near.empty() ? fmt::format("write {}", known.front()) : fmt::format("did you mean {}?", near)});
}

}  // namespace cli
