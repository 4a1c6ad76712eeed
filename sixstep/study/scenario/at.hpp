// SPDX-License-Identifier: Apache-2.0
// What changes at an instant of the run, as a scenario says it; what is not given stays as it was. What each
// key means stands in at_description.hpp.
#pragma once
#include "sixstep/study/scenario/reference.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

struct AtSupply {
  std::optional<double> voltage_V;
  std::optional<bool> sinks;
};

struct AtLoad {
  std::optional<double> torque_Nm;
  std::optional<bool> locked;
};

/// What a line's pin reads: a level it sticks at, or what its probe says.
enum class PinLevel : std::uint8_t { low, high, probe };

struct AtHallBreak {
  int line = 1;
  PinLevel level = PinLevel::low;
};

struct AtSensors {
  std::optional<AtHallBreak> hall_break;
};

/// What the product drive is asked for.
enum class DriveRequest : std::uint8_t { none, off, on, clear };

struct At {
  double time_s = 0.0;
  std::optional<Reference> reference;
  AtSupply supply;
  AtLoad load;
  AtSensors sensors;
  DriveRequest request = DriveRequest::none;
};

}  // namespace sixstep::study
