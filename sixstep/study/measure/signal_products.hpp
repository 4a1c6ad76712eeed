// SPDX-License-Identifier: Apache-2.0
// Signals that are products of the segment's series: back-EMFs, terminal voltages, powers and losses.
#pragma once
#include "sixstep/study/measure/signals.hpp"

namespace sixstep::study {

/// True if products of two series of this degree must be formed over half segments. Products of series up to
/// degree 8 are exact over the whole segment. For higher degrees, over half segments, the omitted terms are
/// below 2^-53 of the factors' magnitudes: as in series/quadrature.hpp, term j is at most M^2 (2 x)^j/j! with
/// 2 x <= 1/2, and (1/2)^17/17! < 2^-65.
constexpr bool needs_halves(int degree) { return 2 * degree > series::max_degree; }

/// The product over [from, to] of the segment; `signal` must satisfy is_product().
Piece product_piece(const SegmentView& g, Signal signal, double from, double to);

/// The sum w_a i_a + w_b i_b + w_c i_c.
Series weighted_current(const plant::PerLeg<double>& w, const plant::Expansion<double>& y);

/// The bus current as weights of i_a, i_b, i_c.
plant::PerLeg<double> bus_current_weights(const plant::View& plant);

}  // namespace sixstep::study
