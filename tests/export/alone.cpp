// SPDX-License-Identifier: Apache-2.0
// Every exported header compiles for a chip, and its constants are available at compile time.
#include "tests/export/headers.hpp"

namespace {
using sixstep::control::Mode;
static_assert(exported_duty::drive.mode == Mode::duty && exported_current::drive.mode == Mode::current);
static_assert(exported_speed_q15::drive.mode == Mode::speed &&
              exported_position_q31::drive.mode == Mode::position);
static_assert(exported_position::pwm_period_ps == 30'000'000 && exported_position::pole_pairs == 8);
static_assert(exported_product::product.hall.stable_samples == 3 &&
              exported_product_q15::product.advance.fixed > exported_product_q15::Scalar{});
static_assert(exported_field::field.drive.mode == Mode::speed &&
              exported_field::field.weakening.most_A == 8.0 &&
              exported_field_salient::field.current.limit == sixstep::control::VoltageLimit::axes &&
              exported_field_salient::field.per_ampere.k_per_A > 0.0f);
static_assert(exported_field_observer::sensorless_field.estimator.on &&
              exported_field_observer::sensorless_field.field == exported_field_observer::field &&
              exported_field_injection::sensorless_field.estimator.injection.voltage_V > 0.0);
static_assert(exported_position_q15::units.amperes(1.0).raw > 0);
}  // namespace
