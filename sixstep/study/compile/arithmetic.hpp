// SPDX-License-Identifier: Apache-2.0
// Converts the drive, which is designed in double, to the chip's arithmetic: the same numbers as float, or
// numbers scaled to fixed point with a proof that they fit.
#pragma once
#include "sixstep/control/commissioning/pulse_start.hpp"
#include "sixstep/control/field/sensorless_field_drive.hpp"
#include "sixstep/design/scaling/product_scaling.hpp"
#include "sixstep/rig/bases.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// The largest magnitudes of the loops' quantities in this scenario:
/// - current: twice the largest reference or limit, at most (bus + opposing back-EMF)/R. The factor 2 leaves
///   room for the overshoot of a reversal, whose error would otherwise saturate (scenario "7.3.1 turning"
///   shows it).
/// - speed: the speed U/K_t that the bus voltage U reaches without load and loss, and the speed at the start.
/// - position: the largest reference and the position at the start.
/// - bus: the source's voltage, and the bus voltage at the start.
///
/// For the product drive the ranges are the ranges of its converters, and the speed is above its over-speed
/// threshold.
design::OperatingRange operating_range(const Scenario& scenario, const Compiled& compiled);

/// The smallest allowed range: what this scenario requests or starts with (largest reference, limits, source,
/// start), and for the product drive the range of its converters.
design::OperatingRange least_range(const Scenario& scenario, const Compiled& compiled);

/// The same controller in float or double.
template <class Scalar>
control::DriveConfig<Scalar> in_arithmetic(const control::DriveConfig<double>& c);

template <class Scalar>
struct DriveIn {
  control::DriveConfig<Scalar> config;
  rig::Bases bases;
};

/// The drive in the chip's arithmetic. Problems name the quantity that the format cannot represent, under the
/// key control.arithmetic. Instantiated for float, double, Q15, Q31 and the formats with one bit before the
/// point.
template <class Scalar>
base::Result<DriveIn<Scalar>> drive_in(const Scenario& scenario, const Compiled& compiled);

/// The product drive in the chip's arithmetic, like drive_in().
template <class Scalar>
struct ProductIn {
  control::ProtectedConfig<Scalar> config;
  rig::Bases bases;
};
template <class Scalar>
base::Result<ProductIn<Scalar>> product_in(const Scenario& scenario, const Compiled& compiled);

/// The sensorless drive in the chip's arithmetic, like drive_in(). Its pulses are integers in every
/// arithmetic.
template <class Scalar>
struct SensorlessIn {
  control::PulsedDriveConfig<Scalar> config;
  rig::Bases bases;
};
template <class Scalar>
base::Result<SensorlessIn<Scalar>> sensorless_in(const Scenario& scenario, const Compiled& compiled);

/// The field-oriented drive like drive_in(), but in floating point only: its scaling to fixed point is not
/// proved yet.
template <class Scalar>
struct FieldIn {
  control::SensorlessFieldConfig<Scalar> config;
  rig::Bases bases;
};
template <class Scalar>
base::Result<FieldIn<Scalar>> field_in(const Compiled& compiled);

}  // namespace sixstep::study
