// SPDX-License-Identifier: Apache-2.0
// Converts a firmware's configuration, at the start and at each event that changes it, to the chip's
// arithmetic. Fixed point keeps the scaling of the start for the whole run: later configurations must fit it.
#pragma once
#include <cmath>
#include <type_traits>

#include "sixstep/rig/chip_drive.hpp"
#include "sixstep/rig/field_drive.hpp"
#include "sixstep/rig/lean_drive.hpp"
#include "sixstep/rig/product_drive.hpp"
#include "sixstep/rig/sensorless_drive.hpp"
#include "sixstep/study/compile/arithmetic.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/rig_of.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {

/// The values of [control.full_scale] that result in these `bases`, exact to the last bit. Empty for floating
/// point.
template <class Scalar>
FullScale full_scale_of(const rig::Bases& bases) {
  if constexpr (std::is_arithmetic_v<Scalar>) {
    return {};
  } else {
    constexpr int before_the_point =
        control::detail::Widths<typename Scalar::Storage>::bits - 1 - Scalar::fraction_bits;
    const auto end = [](double base) { return std::ldexp(base, before_the_point); };
    return {end(bases.current_A), end(bases.voltage_V), end(bases.speed_rad_s), end(bases.position_deg)};
  }
}

namespace detail {

template <class Scalar>
auto given_to(std::type_identity<rig::ProductDrive<Scalar>>, const Scenario& s, const Compiled& c) {
  return product_in<Scalar>(s, c);
}
template <class Scalar>
auto given_to(std::type_identity<rig::SensorlessDrive<Scalar>>, const Scenario& s, const Compiled& c) {
  return sensorless_in<Scalar>(s, c);
}
template <class Scalar>
auto given_to(std::type_identity<rig::FieldDrive<Scalar>>, const Scenario&, const Compiled& c) {
  return field_in<Scalar>(c);
}
/// Configuration of a user's own controller, which computes in SI.
struct OwnGiven {
  rig::OwnConfig config;
  rig::Bases bases;
};
template <class Command>
auto given_to(std::type_identity<rig::OwnDrive<Command>>, const Scenario&, const Compiled& c) {
  return base::Result<OwnGiven>(OwnGiven{c.own, {}});
}
/// The board's part of a chip with its own firmware; the chip has its configuration in its flash.
struct ChipGiven {
  rig::ChipConfig config;
  rig::Bases bases;
};
inline auto given_to(std::type_identity<rig::ChipDrive>, const Scenario& s, const Compiled& c) {
  return base::Result<ChipGiven>(
      ChipGiven{{s.control.mode, c.setpoint_range, std::uint32_t{1} << c.board.sensors.current.bits}, {}});
}
template <class Firmware>
auto given_to(std::type_identity<Firmware>, const Scenario& s, const Compiled& c) {
  return drive_in<typename Firmware::Number>(s, c);
}

template <class Firmware>
base::Problems add_later(const Scenario& s, const Compiled& c, Chip<Firmware>& out) {
  if (c.later.empty()) return {};
  Compiled then = c;
  std::size_t number = 0;
  for (const At* at : in_order(s)) {
    if (!retunes(*at)) continue;
    Scenario settled_s = settled(s, at);
    if (!std::is_arithmetic_v<typename Firmware::Number>) settled_s.control.full_scale = out.full_scale;
    then.drive = c.later[number].drive;
    then.product = c.later[number].product;
    then.sensorless = c.later[number].sensorless;
    then.field = c.later[number].field;
    then.own = c.later[number].own;
    then.estimator = c.later[number].estimator;
    const auto chip = given_to(std::type_identity<Firmware>{}, settled_s, then);
    if (!chip) return told_of_event(s, *at, chip.problems());
    out.later.push_back({chip->config, chip->bases.setpoint});
    ++number;
  }
  return {};
}

}  // namespace detail

/// Problems name the quantities that the format cannot represent. `s` is the scenario from which `c` was
/// compiled.
template <class Firmware>
base::Result<Chip<Firmware>> chip_of(const Scenario& s, const Compiled& c) {
  const std::optional<Scenario> alone = changes_mode(s) ? std::optional(settled(s, nullptr)) : std::nullopt;
  const auto first = detail::given_to(std::type_identity<Firmware>{}, alone ? *alone : s, c);
  if (!first) return first.problems();
  Chip<Firmware> out{first->config, first->bases, {}, full_scale_of<typename Firmware::Number>(first->bases)};
  if (base::Problems problems = detail::add_later(s, c, out); !problems.empty()) return problems;
  return out;
}

}  // namespace sixstep::study
