// SPDX-License-Identifier: Apache-2.0
// Lists the formats that `sixstep run` writes, for options, help, completions, --out, messages, checks and
// interruptions.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "faces/cli/rooms.hpp"
#include "files/trace/sink.hpp"

namespace cli {

struct Format {
  std::string_view option;   ///< "--csv"
  std::string_view meaning;  ///< help text of the option
  files::OpenSink open;
  std::string_view in_folder;  ///< suffix of the scenario's name in --out DIR; empty: not written there
  /// Makes the text that is printed if the file's name is "-"; null: "-" is an ordinary name.
  std::string (*printed)(const files::RunStory&) = nullptr;
  /// Makes a message before the run about the parts that will not fit into the format; null: everything fits.
  std::string (*foretold)(const study::Scenario&) = nullptr;
};

std::span<const Format> formats();

/// The option of the format for people. This format can also compare several runs, and the index of --out
/// links to it.
inline constexpr std::string_view page_option = "--html";
/// The option of the format that needs a chip in the run.
inline constexpr std::string_view uart_option = "--uart";

/// The options of all formats as text: "--csv, --mat, ..".
std::string all_options();

}  // namespace cli
