// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/store_option.hpp"

namespace cli {

CLI::Option* take_store(CLI::App& verb, std::string& path, const std::string& meaning) {
  const auto is_file = [](const std::string& word) {
    return word == "-" ? std::string("means standard output, but a store must be a file") : std::string();
  };
  return verb.add_option("--store", path, meaning)->type_name("FILE")->check(is_file);
}

}  // namespace cli
