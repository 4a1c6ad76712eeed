// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep completion bash|zsh|fish`: what makes the shell ask the program.
Verb declare_completion(CLI::App& app);

/// The word by which that script asks: `sixstep __complete WORD..` answers a candidate a line, its meaning
/// behind a tab. It is no verb: the words behind it are read by nobody else.
inline constexpr char complete_word[] = "__complete";
Exit answer_shell(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace cli
