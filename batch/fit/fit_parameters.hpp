// SPDX-License-Identifier: Apache-2.0
// The free parameters of a fit, as unknowns u of the solver: a positive constant is start exp(u), every other value
// start + scale u. A change of u by 1 is large for every parameter.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "batch/fit/fit.hpp"

namespace batch {

enum class FitRole : std::uint8_t { key, shift, drift, offset, gain, delay };

struct FitParameter {
  FitRole role = FitRole::key;
  std::string key;  ///< as in Fit::values
  std::string unit;
  std::size_t bench = 0;   ///< not for a key
  std::size_t column = 0;  ///< index in the bench's log; only for offset, gain and delay
  double start = 0.0, scale = 1.0;
  bool logarithmic = false;
  bool positive = false;    ///< a friction: its value is at least 0
  bool of_inertia = false;  ///< whether value() is that of the starting inertia, and grows with the inertia

  double value(double u) const;
};

/// The parameters that request.free names.
base::Result<std::vector<FitParameter>> fit_parameters(const FitRequest& request);

bool is_inertia(const FitParameter& parameter);

/// The inertia relative to its start; 1 if it is not free.
double inertia_factor(std::span<const FitParameter> parameters, std::span<const double> u);

/// The bench's scenario with the values of all keys. Problems: a value out of its key's range.
base::Result<study::Scenario> bench_with(const study::Scenario& scenario,
                                         std::span<const FitParameter> parameters, std::span<const double> u);

}  // namespace batch
