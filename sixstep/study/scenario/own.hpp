// SPDX-License-Identifier: Apache-2.0
// A user's own controller (control/own/own_controller.h) in a scenario. own_description.hpp describes each
// key.
#pragma once
#include <string>
#include <vector>

#include "sixstep/control/own/own_controller.h"

namespace sixstep::study {

/// A value that replaces the preset of one of the controller's numbers.
struct OwnNumber {
  std::string name;
  double value = 0.0;
  bool operator==(const OwnNumber&) const = default;
};

struct Own {
  std::string controller;  ///< path of the shared object, relative to the file that names it
  std::vector<OwnNumber> number;
  const sixstep_controller* loaded =
      nullptr;  ///< contents of the shared object, valid until the program ends (filled by text)
  bool operator==(const Own&) const = default;
};

/// True if the controller commands three legs; otherwise it commands a driven pair.
inline bool answers_legs(const Own& own) {
  return own.loaded != nullptr && own.loaded->answers == SIXSTEP_ANSWERS_LEGS;
}

}  // namespace sixstep::study
