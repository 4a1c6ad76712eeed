// SPDX-License-Identifier: Apache-2.0
// Variables in a MAT file, written by libmatio.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/trace/mat_version.hpp"
#include "files/trace/matio.hpp"

namespace files {

/// Writes one variable after the other; remembers whether all went well.
class MatFile {
 public:
  MatFile(const Matio& library, const std::string& path, MatVersion version);

  /// Columns one after the other, as MATLAB has them.
  void numbers(const std::string& name, std::vector<double> values, std::size_t rows, std::size_t columns);
  void text(const std::string& name, const std::string& words);
  /// A struct whose fields are texts.
  void texts(const std::string& name, const std::vector<std::pair<std::string, std::string>>& fields);
  /// Below what the column holds already; version 7.3 only.
  void append(const std::string& column, std::span<const double> values);

  /// Whether all is on the disk as far as the program can tell. Nothing may follow.
  bool close();

 private:
  void put(matvar_t* variable);
  matvar_t* text_variable(const char* name, const std::string& words) const;

  const Matio& matio_;
  std::unique_ptr<mat_t, decltype(Matio::Close)> file_;
  bool good_;
};

/// A name among the temporary files, for who can only write to a path; gone at the end.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  bool made() const { return made_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool made_ = false;
};

}  // namespace files
