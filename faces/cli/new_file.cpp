// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/new_file.hpp"

#include <filesystem>

#include "files/atomic_file.hpp"

namespace cli {

namespace fs = std::filesystem;

std::string toml_path(const std::string& name) { return name.ends_with(".toml") ? name : name + ".toml"; }

base::Problems taken(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  return {
      {.where = path, .limit = "already exists", .cure = "choose another name, or move the existing file"}};
}

base::Problems write_new(const std::string& path, const std::string& text) {
  if (base::Problems found = taken(path); !found.empty()) return found;
  base::Result<files::AtomicFile> file = files::AtomicFile::create(path);
  if (!file) return file.problems();
  file->write(text);
  return file->commit();
}

std::string motor_beside(const std::string& motor, const std::string& toml) {
  std::error_code error;
  if (toml.empty() || !fs::is_regular_file(motor, error)) return motor;
  const fs::path folder = fs::absolute(toml, error).parent_path();
  const fs::path relative = fs::relative(motor, folder, error);
  return relative.empty() ? motor : relative.generic_string();
}

}  // namespace cli
