// SPDX-License-Identifier: Apache-2.0
// A controller of one's own (control/own/own_controller.h), as a scenario names it. What each key means stands in
// own_description.hpp.
#pragma once
#include <string>
#include <vector>

#include "sixstep/control/own/own_controller.h"

namespace sixstep::study {

/// One of its numbers that is not as it presets it.
struct OwnNumber {
  std::string name;
  double value = 0.0;
  bool operator==(const OwnNumber&) const = default;
};

struct Own {
  std::string controller;  ///< the shared object, beside the file that names it
  std::vector<OwnNumber> number;
  const sixstep_controller* loaded =
      nullptr;  ///< what stands in it, for as long as the program runs (filled by text)
  bool operator==(const Own&) const = default;
};

/// Whether it answers three legs; else a pair that moves on.
inline bool answers_legs(const Own& own) {
  return own.loaded != nullptr && own.loaded->answers == SIXSTEP_ANSWERS_LEGS;
}

}  // namespace sixstep::study
