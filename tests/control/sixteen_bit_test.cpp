// SPDX-License-Identifier: Apache-2.0
// The facts hold on this machine by compiling; CMake asks a compiler whose int has 16 bits, where there is
// one.
#include "tests/control/sixteen_bit/facts.hpp"
#include "tests/control/sixteen_bit/sensing_facts.hpp"
