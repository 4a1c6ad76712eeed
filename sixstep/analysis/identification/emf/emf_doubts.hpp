// SPDX-License-Identifier: Apache-2.0
// Finds recordings whose values do not describe the motor: noise, missing rows, clipped tops.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// The Problem of a channel without a visible period: missing rows, half waves of irregular length, or too
/// few half waves. `passed`: number of crossings of the mean; `regular`: true if the half waves are of
/// similar length.
base::Problem no_period(const std::vector<double>& t_s, const std::string& channel, std::size_t passed,
                        bool regular);

/// A Problem if the fit's residual exceeds the fitted part.
base::Problems check_noise(const EmfRecord& record, const HarmonicFit& fit);

/// A Problem if tops are clipped. Clipped tops are exactly flat, and one of two conditions holds: the flanks
/// are curved or noisy by more than a step of the converter, or the flanks continue beyond the top as a
/// parabola. The straight flanks of a trapezoid, and steps that are larger than the noise, give no evidence.
base::Problems check_clipped(const EmfRecord& record, const EmfResult& result);

/// True if tops are constant for a long time, but the loss is too small to distinguish clipping from a step
/// of the converter. allow_for_clipping() raises the constants' upper bounds by such a loss.
bool may_be_clipped(const EmfChannelResult& channel);
void allow_for_clipping(EmfResult& result);

/// A Problem if the fundamentals of the channels differ by more than the phases of one motor differ.
/// allow_for_unlike_channels() widens the constants' bounds for smaller but unusual differences.
base::Problems check_alike(const EmfResult& result);
void allow_for_unlike_channels(EmfResult& result);

}  // namespace sixstep::analysis
