// SPDX-License-Identifier: Apache-2.0
// Output signals of an encoder or a resolver at an instant, like with an instrument at the sensor's wires
// (model.md 10).
#pragma once
#include "sixstep/rig/shaft_motion.hpp"
#include "sixstep/rig/shaft_ports.hpp"

namespace sixstep::rig {

/// Output of the installed kind of sensor; members of other kinds are 0.
struct ShaftRaw {
  std::uint8_t lines = 0;  ///< levels at the pins including stuck lines: A has the value 4, B 2, Z 1
  std::uint32_t code = 0;  ///< Gray code, including stuck tracks
  std::array<double, 2>
      winding_V{};  ///< cosine and sine winding, V, without noise; 0 before the excitation starts at the
                    ///< first sample
};

inline ShaftRaw shaft_raw(const ShaftPorts& ports, const plant::ShaftAngle<double>& at,
                          const sim::Instant& t) {
  switch (ports.given().kind) {
    case ShaftSensor::none:
      break;
    case ShaftSensor::encoder:
      return {.lines = ports.pins_in(ports.quarter_at(at))};
    case ShaftSensor::absolute:
      return {.code = ports.code_at(at)};
    case ShaftSensor::resolver:
      return {.winding_V = ports.windings_V(at, t)};
  }
  return {};
}

namespace detail {

/// Visits the quarters of lines that the shaft passes without a reversal. For each quarter the visitor
/// receives the fraction of the segment at which the shaft enters the quarter.
template <class Real, class Visit>
void for_each_quarter_one_way(const ShaftMotion<Real>& m, const ShaftPorts& ports, Real from, Real to,
                              Visit&& visit) {
  const auto quarter_at = [&ports](const plant::ShaftAngle<Real>& at) { return ports.quarter_at(at); };
  const std::int64_t begin = quarter_at(m.angle(from)), end = quarter_at(m.angle(to));
  const int way = end > begin ? 1 : -1;
  Real reached = from;
  for (std::int64_t quarter = begin; quarter != end;) {
    quarter += way;
    const Real at = part_of_count(m, quarter_at, reached, to, quarter, way);
    visit(quarter, at);
    reached = at;
  }
}

}  // namespace detail

/// Visits the quarters of lines in the order in which the shaft enters them.
template <class Real, class Visit>
void for_each_quarter(const ShaftMotion<Real>& m, const ShaftPorts& ports, Visit&& visit) {
  const Real turns = turning_part(m);
  if (turns > 0) detail::for_each_quarter_one_way(m, ports, Real(0), turns, visit);
  detail::for_each_quarter_one_way(m, ports, turns, m.s, visit);
}

}  // namespace sixstep::rig
