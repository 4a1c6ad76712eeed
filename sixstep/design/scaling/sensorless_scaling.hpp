// SPDX-License-Identifier: Apache-2.0
// The sensorless drive's configuration in fixed point: the drive by scaling.hpp, and the loop that its start runs in every
// mode, each with its lines of the proof.
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

/// The same drive while it starts: it holds a current, whatever comes behind it.
control::DriveConfig<double> while_it_starts(const control::DriveConfig<double>& drive);

/// What comes in while it starts.
OperatingRange while_it_starts(const OperatingRange& range,
                               const control::SensorlessDriveConfig<double>& sensorless);

/// Bases that hold the drive in its mode and while it starts.
Bases bases_for(const control::SensorlessDriveConfig<double>& sensorless, const OperatingRange& range,
                double full_scale);

/// Problems as scaled() has them. Instantiated for Q15, Q31 and the formats with one bit before the point.
template <class Scalar>
base::Result<ScaledSensorless<Scalar>> scaled_sensorless(
    const control::SensorlessDriveConfig<double>& sensorless, const OperatingRange& range,
    const Bases& bases);

}  // namespace sixstep::design
