// SPDX-License-Identifier: Apache-2.0
#define TOML_IMPLEMENTATION
#include "text/toml/toml.hpp"
