// SPDX-License-Identifier: Apache-2.0
// If this file compiles, the results are correct on this machine. CMake also compiles them with a compiler of
// 16-bit int, if there is one.
#include "tests/control/sixteen_bit/facts.hpp"
#include "tests/control/sixteen_bit/sensing_facts.hpp"
