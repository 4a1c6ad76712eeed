// SPDX-License-Identifier: Apache-2.0
// Converts the sensorless drive's configuration to fixed point: the drive by scaling.hpp, and the current
// loop that runs during the start in every mode. Each value has a line in the proof.
#pragma once
#include "sixstep/control/sensorless/sensorless_drive.hpp"
#include "sixstep/design/scaling/scaling.hpp"

namespace sixstep::design {

template <class Scalar>
struct ScaledSensorless {
  control::SensorlessDriveConfig<Scalar> config;
  Bases bases;
  std::vector<Headroom> proof;
};

/// The drive during its start, in which every mode uses the current loop.
control::DriveConfig<double> while_it_starts(const control::DriveConfig<double>& drive);

/// Range of the inputs during the start.
OperatingRange while_it_starts(const OperatingRange& range,
                               const control::SensorlessDriveConfig<double>& sensorless);

/// Bases that suffice for both the drive's mode and its start.
Bases bases_for(const control::SensorlessDriveConfig<double>& sensorless, const OperatingRange& range,
                double full_scale);

/// Problems as in scaled(). The template is instantiated for Q15, Q31 and the formats with one bit before the
/// point.
template <class Scalar>
base::Result<ScaledSensorless<Scalar>> scaled_sensorless(
    const control::SensorlessDriveConfig<double>& sensorless, const OperatingRange& range,
    const Bases& bases);

}  // namespace sixstep::design
