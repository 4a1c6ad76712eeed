// SPDX-License-Identifier: Apache-2.0
// Computes Sobol's sequence: points that fill a cube more evenly than random points. Each point is a function
// of its number only: runs can be computed in any order, on any machine.
//
// I. M. Sobol (1967), in the order of Antonov and Saleev (Gray code, 1979), with the direction numbers of S. Joe
// and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30
// (2008).
#pragma once
#include <cstddef>
#include <cstdint>

namespace sixstep::analysis {

inline constexpr std::size_t sobol_dimensions = 64;

/// Coordinate `dimension` < sobol_dimensions of point `number`, as 32 bits after the binary point.
std::uint32_t sobol_bits(std::size_t dimension, std::uint32_t number);

/// The same coordinate as a number in (0, 1), with its digits shifted at random by the seed. The points of
/// each seed are equally even. The spread between seeds estimates the error.
double sobol(std::size_t dimension, std::uint32_t number, std::uint64_t seed);

}  // namespace sixstep::analysis
