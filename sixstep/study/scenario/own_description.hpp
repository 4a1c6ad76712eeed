// SPDX-License-Identifier: Apache-2.0
// The keys of [control.own]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/own.hpp"

namespace sixstep::study {

inline void describe(base::Visitor& v, OwnNumber& s) {
  v.value("name", s.name, {.meaning = "name of one of the controller's numbers", .required = true});
  v.value("value", s.value,
          {.meaning = "its value, in the unit that the controller gives it", .required = true});
}

inline void describe(base::Visitor& v, Own& s) {
  v.value("controller", s.controller,
          {.meaning =
               "shared object that it is compiled into, beside this file; it runs as a part of the program"});
  v.list("number", s.number, {.meaning = "a number of the controller, where it is not as preset"});
}

}  // namespace sixstep::study
