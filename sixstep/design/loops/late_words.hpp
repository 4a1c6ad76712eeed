// SPDX-License-Identifier: Apache-2.0
// Text for the delay of a command after its sample.
#pragma once
#include <string>

namespace sixstep::design {

/// Delay of a command as text: "at once", "half a period late", "one period late", "1.5 periods late".
std::string late_words(double periods);
/// A number of periods as text: "half a period", "one period", "1.5 periods".
std::string periods_words(double periods);

}  // namespace sixstep::design
