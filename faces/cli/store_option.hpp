// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/App.hpp>

#include <string>

namespace cli {

/// Adds the option --store to a verb. Its value must be a regular file, because a store is read again.
CLI::Option* take_store(CLI::App& verb, std::string& path, const std::string& meaning);

}  // namespace cli
