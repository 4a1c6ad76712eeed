// SPDX-License-Identifier: Apache-2.0
// Recordings that give numbers, but none of the motor: noise, gaps, clipped tops.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// Why a channel shows no period: a gap in time, half waves of all lengths, or next to none. `passed` times it passes its mean in all.
base::Problem no_period(const std::vector<double>& t_s, const std::string& channel, std::size_t passed,
                        bool regular);

/// What the fit leaves over is more than what it explains.
base::Problems check_noise(const EmfRecord& record, const HarmonicFit& fit);

/// Tops that are exactly flat, while the flanks are curved or noisy by more than a step of the converter, or go on beyond the top by
/// the parabola that they are: there the voltage went beyond the range. The straight flanks of a trapezoid and steps that hide the noise say nothing.
base::Problems check_clipped(const EmfRecord& record, const EmfResult& result);

/// Tops that stand still for long, and of which too little is lost to tell it from a step of the converter: the upper ends of the
/// constants move by what such a loss would hide.
bool may_be_clipped(const EmfChannelResult& channel);
void allow_for_clipping(EmfResult& result);

/// Fundamentals that differ by more than those of one motor; by less, but more than usual, they widen the constants' bounds.
base::Problems check_alike(const EmfResult& result);
void allow_for_unlike_channels(EmfResult& result);

}  // namespace sixstep::analysis
