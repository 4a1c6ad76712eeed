// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep completion bash|zsh|fish`: a script with which the shell completes command lines.
Verb declare_completion(CLI::App& app);

/// The word after `sixstep` with which the script calls the program: `sixstep __complete WORD..` prints one
/// candidate per line, with the candidate's meaning after a tab. It is not a verb, so the words after it are
/// not parsed as options.
inline constexpr char complete_word[] = "__complete";
Exit answer_shell(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace cli
