// SPDX-License-Identifier: Apache-2.0
// The keys of [control.own]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/own.hpp"

namespace sixstep::study {

inline void describe(base::Visitor& v, OwnNumber& s) {
  v.value("name", s.name, {.meaning = "name of one of the controller's numbers", .required = true});
  v.value("value", s.value,
          {.meaning = "value of this number, in the unit that the controller defines", .required = true});
}

inline void describe(base::Visitor& v, Own& s) {
  v.value(
      "controller", s.controller,
      {.meaning =
           "shared object of the compiled controller, with its path relative to this file; the controller runs inside the program"});
  v.list("number", s.number, {.meaning = "numbers of the controller that differ from their presets"});
}

}  // namespace sixstep::study
