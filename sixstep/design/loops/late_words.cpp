// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/late_words.hpp"

#include "sixstep/base/written.hpp"

namespace sixstep::design {

std::string periods_words(double periods) {
  return periods == 0.5   ? "half a period"
         : periods == 1.0 ? "one period"
                          : base::three_digits(periods) + " periods";
}

std::string late_words(double periods) {
  return periods > 0.0 ? periods_words(periods) + " late" : "at once";
}

}  // namespace sixstep::design
