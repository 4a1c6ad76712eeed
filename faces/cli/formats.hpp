// SPDX-License-Identifier: Apache-2.0
// The formats that `sixstep run` writes: one list, which options, help, completions, --out, messages, guards
// and interruptions read.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "faces/cli/rooms.hpp"
#include "files/trace/sink.hpp"

namespace cli {

struct Format {
  std::string_view option;   ///< "--csv"
  std::string_view meaning;  ///< of the option, for its help
  files::OpenSink open;
  std::string_view in_folder;  ///< what --out DIR puts behind the scenario's name; empty: not written there
  /// What - as the file's name prints; null: - is a name as any other.
  std::string (*printed)(const files::RunStory&) = nullptr;
  /// What of the run will not fit into it, said before it runs; null: all does.
  std::string (*foretold)(const study::Scenario&) = nullptr;
};

std::span<const Format> formats();

/// The one for people: it may also compare several runs, and the index of --out links to it.
inline constexpr std::string_view page_option = "--html";
/// The one that a chip has to run for.
inline constexpr std::string_view uart_option = "--uart";

/// "--csv, --mat, .."
std::string all_options();

}  // namespace cli
