// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/App.hpp>

#include <string>

namespace cli {

/// Adds the option --store of every verb that keeps rows. Its value must be a file, because a store is read
/// again.
CLI::Option* take_store(CLI::App& verb, std::string& path, const std::string& meaning);

}  // namespace cli
