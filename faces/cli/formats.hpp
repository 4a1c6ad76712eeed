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
  /// The text that - as the file's name prints; null: - is a file name.
  std::string (*printed)(const files::RunStory&) = nullptr;
  /// A message before the run about the parts that will not fit into the format; null: everything fits.
  std::string (*foretold)(const study::Scenario&) = nullptr;
};

std::span<const Format> formats();

/// The format for people: it can also compare several runs, and the index of --out links to it.
inline constexpr std::string_view page_option = "--html";
/// The format that needs a chip to run.
inline constexpr std::string_view uart_option = "--uart";

/// "--csv, --mat, .."
std::string all_options();

}  // namespace cli
