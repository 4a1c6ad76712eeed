// SPDX-License-Identifier: Apache-2.0
// If this file compiles, the results are correct on this machine. If a compiler with 16-bit int is installed,
// CMake also compiles this file with that compiler.
#include "tests/control/sixteen_bit/facts.hpp"
#include "tests/control/sixteen_bit/sensing_facts.hpp"
