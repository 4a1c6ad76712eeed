// SPDX-License-Identifier: Apache-2.0
// What changes at an instant of the run, as a scenario says it; what is not given stays as it was. What each
// key means stands in at_description.hpp.
#pragma once
#include "sixstep/study/reference.hpp"
#include "sixstep/study/sensors.hpp"

namespace sixstep::study {

struct AtSupply {
  std::optional<double> voltage_V;
  std::optional<bool> sinks;
};

struct AtLoad {
  std::optional<double> torque_Nm;
  std::optional<bool> locked;
};

struct AtHallBreak {
  int line = 1;
  Level01 level = Level01::low;
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
