// SPDX-License-Identifier: Apache-2.0
// The free parameters of a fit, as unknowns u of the solver. A positive constant has the value start exp(u),
// any other parameter the value start + scale u. A change of u by 1 is large for every parameter.
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
  std::size_t bench = 0;   ///< index of the bench; not used for a key
  std::size_t column = 0;  ///< index in the bench's log; only for offset, gain and delay
  double start = 0.0, scale = 1.0;
  bool logarithmic = false;
  bool positive = false;  ///< true: a friction, whose value is at least 0

  double value(double u) const;
  /// Step of u for a central difference. The model is exact to 1e-12, so that truncation and rounding stay below 1e-7.
  double step() const { return logarithmic ? 1e-4 : 1e-3; }
};

/// The parameters that request.free names.
base::Result<std::vector<FitParameter>> fit_parameters(const FitRequest& request);

/// The bench's scenario with the values of all keys. Problems: a value out of its key's range.
base::Result<study::Scenario> bench_with(const study::Scenario& scenario,
                                         std::span<const FitParameter> parameters, std::span<const double> u);

}  // namespace batch
