// SPDX-License-Identifier: Apache-2.0
// Creates a temporary folder for one run. A shell process removes the folder when the run ends, even if the
// program is killed.
#pragma once
#include <string>

#include "faces/loop/child.hpp"
#include "faces/loop/descriptor.hpp"

namespace loop {

class FreshFolder {
 public:
  /// Creates the folder. Problems: the system refuses it.
  static base::Result<FreshFolder> make();
  FreshFolder(FreshFolder&&) noexcept = default;
  /// Removes the folder with its content.
  ~FreshFolder();

  const std::string& path() const { return path_; }

 private:
  FreshFolder(std::string path, Child&& cleaner, Descriptor&& held)
      : path_(std::move(path)), cleaner_(std::move(cleaner)), held_(std::move(held)) {}

  std::string path_;
  Child cleaner_;
  Descriptor held_;  ///< write end of the pipe that the shell reads; it closes when this program ends
};

}  // namespace loop
