// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/App.hpp>

#include <string>

namespace cli {

/// --store, of every verb that keeps rows: a file, for a store is read from again.
CLI::Option* take_store(CLI::App& verb, std::string& path, const std::string& meaning);

}  // namespace cli
