// SPDX-License-Identifier: Apache-2.0
// Lists the file formats that `sixstep run` writes.
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
  std::string_view in_folder;  ///< suffix of the file name in --out DIR; empty: not written there
  /// Returns the text for standard output, if the file's name is "-"; null: "-" is an ordinary name.
  std::string (*printed)(const files::RunStory&) = nullptr;
  /// Returns a message, before the run, about parts that do not fit the format; null: everything fits.
  std::string (*foretold)(const study::Scenario&) = nullptr;
};

std::span<const Format> formats();

/// The option of the HTML page. The page can also compare several runs, and the index of --out links to it.
inline constexpr std::string_view page_option = "--html";
/// The option of the serial output; only a run with a chip has such output.
inline constexpr std::string_view uart_option = "--uart";

/// The options of all formats as text: "--csv, --mat, ..".
std::string all_options();

}  // namespace cli
