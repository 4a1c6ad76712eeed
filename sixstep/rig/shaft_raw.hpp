// SPDX-License-Identifier: Apache-2.0
// What an encoder or a resolver gives at an instant, on its way to the board: what a probe on its wires would show (model.md 10).
#pragma once
#include "sixstep/rig/shaft_motion.hpp"
#include "sixstep/rig/shaft_ports.hpp"

namespace sixstep::rig {

/// Of the kind that is fitted; the others' members are 0.
struct ShaftRaw {
  std::uint8_t lines = 0;  ///< A 4, B 2, Z 1 at the pins, stuck ones included
  std::uint32_t code = 0;  ///< Gray code, tracks that stick included
  std::array<double, 2>
      winding_V{};  ///< cosine's and sine's, without noise; 0 before the first sample excites them
};

inline ShaftRaw shaft_raw(const ShaftPorts& ports, const plant::ShaftAngle<double>& at,
                          const sim::Instant& t) {
  const ShaftGiven& given = ports.given();
  switch (given.kind) {
    case ShaftSensor::none:
      break;
    case ShaftSensor::encoder:
      return {.lines = ports.pins_in(plant::parts_of_turn(at, 4 * given.lines))};
    case ShaftSensor::absolute:
      return {.code = ports.shown(plant::gray_code(at, given.bits))};
    case ShaftSensor::resolver:
      return {.winding_V = ports.windings_V(at, t)};
  }
  return {};
}

namespace detail {

/// The quarters of lines passed on a way without a turn, each with the part of the segment where it begins to stand.
template <class Real, class Visit>
void for_each_quarter_one_way(const ShaftMotion<Real>& m, std::int64_t parts, Real from, Real to,
                              Visit&& visit) {
  const std::int64_t begin = plant::parts_of_turn(m.angle(from), parts),
                     end = plant::parts_of_turn(m.angle(to), parts);
  const int way = end > begin ? 1 : -1;
  Real reached = from;
  for (std::int64_t quarter = begin; quarter != end;) {
    quarter += way;
    const Real at = part_of_count(m, parts, reached, to, quarter, way);
    visit(quarter, at);
    reached = at;
  }
}

}  // namespace detail

/// In the order of time, as often as the shaft passes each.
template <class Real, class Visit>
void for_each_quarter(const ShaftMotion<Real>& m, std::int64_t parts, Visit&& visit) {
  const Real turns = turning_part(m);
  if (turns > 0) detail::for_each_quarter_one_way(m, parts, Real(0), turns, visit);
  detail::for_each_quarter_one_way(m, parts, turns, m.s, visit);
}

}  // namespace sixstep::rig
