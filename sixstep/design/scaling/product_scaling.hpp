// SPDX-License-Identifier: Apache-2.0
// Converts the whole product's configuration to fixed point: the drive by scaling.hpp, and in addition ADC
// gains, speed from edges, and thresholds of faults. Each value has a line in the proof.
#pragma once
#include "sixstep/control/protected_drive.hpp"
#include "sixstep/design/scaling/scaling.hpp"

namespace sixstep::design {

template <class Scalar>
struct ScaledProduct {
  control::ProtectedConfig<Scalar> config;
  Bases bases;
  std::vector<Headroom> proof;
};

/// Converts with given bases. In `product`, gains of ADCs are A and V per eighth of a count, speeds rad/s,
/// positions degrees, as in the configuration of double. Additional Problems to those of scaling.hpp are
///   - a converter's span beyond full scale, or more eighths of counts than the format holds;
///   - a threshold that no signal can exceed, because it is beyond the format's range;
///   - a ratio of ticks that does not fit its sum.
/// Position is measured in position mode only: in other modes it has no base. The template is instantiated
/// for the same formats as scaled().
template <class Scalar>
base::Result<ScaledProduct<Scalar>> scaled_product(const control::ProtectedConfig<double>& product,
                                                   const OperatingRange& range, const Bases& bases,
                                                   int adc_bits);

/// Converts with the bases of bases_for().
template <class Scalar>
base::Result<ScaledProduct<Scalar>> scaled_product(const control::ProtectedConfig<double>& product,
                                                   const OperatingRange& range, int adc_bits);

}  // namespace sixstep::design
