// SPDX-License-Identifier: Apache-2.0
// The facts hold on this machine if this file compiles; CMake also compiles them with a compiler of 16-bit int, if there is one.
#include "tests/control/sixteen_bit/facts.hpp"
#include "tests/control/sixteen_bit/sensing_facts.hpp"
