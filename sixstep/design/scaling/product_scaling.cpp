// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/product_scaling.hpp"

#include "sixstep/design/scaling/fixed_formats.hpp"
#include "sixstep/design/scaling/scale.hpp"

namespace sixstep::design {

using control::ProtectedConfig;

template <class Scalar>
base::Result<ScaledProduct<Scalar>> scaled_product(const ProtectedConfig<double>& p,
                                                   const OperatingRange& range, const Bases& bases,
                                                   int adc_bits) {
  const base::Result<Scaled<Scalar>> drive = scaled<Scalar>(p.drive, range, bases);
  if (!drive) return drive.problems();
  detail::Proof<Scalar> proof;
  proof.rows = drive->proof;
  ProtectedConfig<Scalar> c;
  c.drive = drive->config;
  const Bases& b = drive->bases;
  proof.fits("setpoint_limit", p.setpoint_limit,
             {member_of(Base::setpoint, p.drive.mode), setpoint_base(p.drive.mode, b)});
  detail::Scale<Scalar> scale(p.drive.mode, b, detail::magnitudes(p.drive, range), adc_bits, proof);
  fields(scale, p, c);
  if (!proof.problems.empty()) return proof.problems;
  return ScaledProduct<Scalar>{c, b, std::move(proof.rows)};
}

template <class Scalar>
base::Result<ScaledProduct<Scalar>> scaled_product(const ProtectedConfig<double>& p,
                                                   const OperatingRange& range, int adc_bits) {
  return scaled_product<Scalar>(p, range, bases_for(p.drive, range, detail::full_scale<Scalar>), adc_bits);
}

using Product = ProtectedConfig<double>;
using Range = OperatingRange;
#define SIXSTEP_SCALED_IN(Format)                                                                          \
  template base::Result<ScaledProduct<control::Format>> scaled_product(const Product&, const Range&, int); \
  template base::Result<ScaledProduct<control::Format>> scaled_product(const Product&, const Range&,       \
                                                                       const Bases&, int);
SIXSTEP_FIXED_FORMATS(SIXSTEP_SCALED_IN)
#undef SIXSTEP_SCALED_IN
// Formats that only tests use.
template base::Result<ScaledProduct<control::Fixed<std::int16_t, 13>>> scaled_product(const Product&,
                                                                                      const Range&, int);
template base::Result<ScaledProduct<control::Fixed<std::int16_t, 13>>> scaled_product(const Product&,
                                                                                      const Range&,
                                                                                      const Bases&, int);
template base::Result<ScaledProduct<control::Fixed<std::int32_t, 29>>> scaled_product(const Product&,
                                                                                      const Range&, int);
template base::Result<ScaledProduct<control::Fixed<std::int32_t, 29>>> scaled_product(const Product&,
                                                                                      const Range&,
                                                                                      const Bases&, int);

}  // namespace sixstep::design
