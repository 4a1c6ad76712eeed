// SPDX-License-Identifier: Apache-2.0
// Keys that a scenario gives and that change nothing, as they are collected.
#pragma once
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

class Unused {
 public:
  template <class Value>
  void add(const std::string& key, const Value& given, const Value& usual, const std::string& reason) {
    if (given == usual) return;
    text_ += (text_.empty() ? "" : ", ") + key + " (" + reason + ")";
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Of [sensors]: of a device that is not there, of a converter that nothing goes through.
void unused_of_sensors(const Scenario& scenario, Unused& out);

}  // namespace sixstep::study
