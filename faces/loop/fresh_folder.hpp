// SPDX-License-Identifier: Apache-2.0
// A folder of one run's own that is gone when the run is, also where the program is killed: a shell waits for its end.
#pragma once
#include <string>

#include "faces/loop/child.hpp"
#include "faces/loop/descriptor.hpp"

namespace loop {

class FreshFolder {
 public:
  /// Problems: there is no room for one.
  static base::Result<FreshFolder> make();
  FreshFolder(FreshFolder&&) noexcept = default;
  /// With all that is in it.
  ~FreshFolder();

  const std::string& path() const { return path_; }

 private:
  FreshFolder(std::string path, Child&& cleaner, Descriptor&& held)
      : path_(std::move(path)), cleaner_(std::move(cleaner)), held_(std::move(held)) {}

  std::string path_;
  Child cleaner_;
  Descriptor held_;  ///< what the shell reads from: its other end closes with this program
};

}  // namespace loop
