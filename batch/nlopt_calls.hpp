// SPDX-License-Identifier: Apache-2.0
// NLopt's functions. The library is loaded when a search begins, because loading it would delay every other
// command.
#pragma once
#include <nlopt.h>

namespace batch {

// The functions that the search uses, without the prefix nlopt_.
// clang-format off
#define SIXSTEP_NLOPT_CALLS(X) \
  X(create) X(destroy) X(set_lower_bounds) X(set_upper_bounds) X(set_initial_step) \
  X(set_min_objective) X(add_inequality_constraint) X(set_xtol_rel) X(set_xtol_abs) X(set_maxeval) \
  X(optimize) X(force_stop)
// clang-format on

struct NloptCalls {
// A declaration cannot be in parentheses.
// NOLINTNEXTLINE(bugprone-macro-parentheses)
#define SIXSTEP_NLOPT_MEMBER(name) decltype(&nlopt_##name) name = nullptr;
  SIXSTEP_NLOPT_CALLS(SIXSTEP_NLOPT_MEMBER)
#undef SIXSTEP_NLOPT_MEMBER
};

/// The functions of the loaded library; null if it cannot be loaded. Any number of threads may call this
/// function.
const NloptCalls* nlopt_calls();

}  // namespace batch
