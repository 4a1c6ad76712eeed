// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

namespace sixstep::study {

/// Converts a callback without parameter to the form of Listeners::keep_going.
inline std::function<bool(double)> listening(const std::function<bool()>& keep_going) {
  if (!keep_going) return {};
  return [keep_going](double) { return keep_going(); };
}

}  // namespace sixstep::study
