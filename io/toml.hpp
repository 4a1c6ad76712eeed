// SPDX-License-Identifier: Apache-2.0
// The TOML parser as this project uses it: no exceptions (the browser has none), compiled once in toml.cpp.
#pragma once
#define TOML_EXCEPTIONS 0
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
