// SPDX-License-Identifier: Apache-2.0
// The product's drive obeys its bounds for any register values.
#include <gtest/gtest.h>

#include <random>

#include "sixstep/control/gates.hpp"
#include "tests/control/product.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

template <class S>
bool is_number(S x) {
  return x == x && static_cast<double>(x) - static_cast<double>(x) == 0;
}

/// Laws that every command obeys, for any register values.
template <class S>
::testing::AssertionResult lawful(const ProtectedConfig<S>& config, const ProtectedState<S>& state,
                                  const ProtectedTelemetry<S>& t, const BridgeCommand<S>& c) {
  const auto no = [](const char* why) { return ::testing::AssertionFailure() << why; };
  for (const S x : {c.duty, c.on_below_A, c.off_above_A, t.drive.motor_current_A, t.drive.current_reference_A,
                    t.drive.speed_reference_rad_s, t.drive.duty, t.measured.i_a_A, t.measured.i_b_A,
                    t.measured.i_c_A, t.measured.speed_rad_s, t.measured.position_deg, t.measured.bus_V,
                    state.drive.current.e, state.drive.speed.e, state.shunt.driven_A})
    if (!is_number(x)) return no("not a number");
  if (!(c.duty >= S{} && c.duty <= one<S>)) return no("duty outside 0..1");
  for (const bool on : {false, true})
    for (unsigned leg = 0; leg < 3; ++leg)
      if ((gates(c, on) >> (2 * leg) & 3) == 3) return no("both switches of a leg");
  if (c.enabled && c.pair.source == c.pair.sink) return no("a pair of one leg");
  if (c.enabled && state.faults.latched != 0) return no("on with a fault latched");
  if (c.enabled && t.activity != Activity::run && t.activity != Activity::brake &&
      t.activity != Activity::align)
    return no("on in an activity that has no bridge");
  const bool loops = t.activity == Activity::run && config.drive.mode >= Mode::speed;
  if (loops && magnitude(t.drive.current_reference_A) > config.drive.current_limit_A) return no("reference");
  return ::testing::AssertionSuccess();
}

/// The code of three probes in an arrangement (model.md 3): each probe is high over half a turn.
std::uint8_t pins_of(HallArrangement arrangement, int sector) {
  constexpr std::uint8_t degrees_60[6] = {0b110, 0b111, 0b011, 0b001, 0b000, 0b100};
  return arrangement == HallArrangement::degrees_120 ? sixstep::plant::hall_code(sector) : degrees_60[sector];
}

template <class S>
void configure(ProtectedConfig<S>& c, std::uint64_t bits) {
  c.drive.mode = static_cast<Mode>(bits % 5);
  c.drive.chopping = static_cast<Chopping>(bits / 8 % 3);
  c.drive.speed_control = static_cast<SpeedControl>(bits / 32 % 2);
  c.drive.current_control = static_cast<CurrentControl>(bits / 64 % 4 == 0);
  c.drive.hysteresis = {static_cast<S>(0.01), static_cast<Watch>(bits / 256 % 3)};
  c.drive.position_gain = static_cast<Gain<S>>(0.05 * base_deg / base_rad_s);
  c.drive.speed_limit_rad_s = static_cast<S>(0.5);
  c.drive.extras.on = bits / 1024 % 2;
  c.drive.extras.slews_setpoint = bits / 2048 % 2;
  c.drive.extras.slew = {static_cast<Accumulator<S>>(0.001)};
  c.drive.extras.limits_current = bits / 4096 % 2;
  c.drive.extras.limits = {static_cast<S>(0.4),       true, static_cast<S>(0.6),
                           static_cast<Gain<S>>(8.0), true, static_cast<S>(1.1),
                           static_cast<Gain<S>>(6.0)};
  c.drive.extras.torque_fraction_per_A = static_cast<Gain<S>>(base_A * K_t / 0.78);
  c.drive.extras.feed_forward = {static_cast<Gain<S>>(K_t * base_rad_s / base_V)};
  c.drive.extras.bus = {static_cast<S>(bits / 8192 % 2 ? 0.25 : 0.0)};
  c.drive.extras.smooth_chopping = bits / 16384 % 2;
  c.drive.extras.speed_law = bits / 67108864 % 2 ? SpeedLaw::positional : SpeedLaw::pi;
  c.drive.extras.speed = {static_cast<Gain<S>>(0.0158299 * base_rad_s),
                          static_cast<Gain<S>>(0.00013378 * base_rad_s),
                          static_cast<Gain<S>>(0.25 * static_cast<double>(bits / 134217728 % 5)), one<S>};
  c.drive.extras.speed_derivative = {static_cast<Gain<S>>(2.0), static_cast<Gain<S>>(0.1)};
  c.sensing = static_cast<CurrentSensing>(bits / 32768 % 2);
  c.shunt = {static_cast<S>(0.05), 20, static_cast<S>(0.9)};
  c.hall.stable_samples = static_cast<std::uint8_t>(bits / 65536 % 3);
  c.hall.arrangement = static_cast<HallArrangement>(bits / 262144 % 2);
  c.advance = {static_cast<S>(0.25 * static_cast<double>(bits / 2097152 % 4)), static_cast<Gain<S>>(0.2),
               static_cast<S>(0.125 * static_cast<double>(1 + bits / 8388608 % 7))};
  c.align.ticks = bits / 524288 % 2 ? 20 : 0;
  c.align.current_A = static_cast<S>(0.1);
  if (bits / 1048576 % 2) {  // high thresholds accept nearly all values, so that deeper states are reached
    const S most = is_fixed<S> ? static_cast<S>(1.99) : static_cast<S>(1e6);
    c.faults = {most, most, -most, most, most, 0xffffffffu, 255};
  }
}

template <class Scalar>
class ProductFuzz : public ::testing::Test {};
TYPED_TEST_SUITE(ProductFuzz, Scalars);

TYPED_TEST(ProductFuzz, RandomRegistersNeverLeadToAnUnlawfulCommand) {
  using S = TypeParam;
  const std::uint64_t seed = 20260105;
  std::mt19937_64 random{seed};
  long enabled = 0, faulty = 0;
  for (int run = 0; run < 400; ++run) {
    ProtectedConfig<S> config = product<S>();
    configure(config, random());
    ProtectedState<S> state;
    ProtectedTelemetry<S> telemetry;
    BoardInput in;
    Request request;
    int sector = 0;
    const int wild = static_cast<int>(random() % 4);
    for (int n = 0; n < 500; ++n) {
      const std::uint64_t a = random(), b = random();
      const unsigned spread = wild == 3 ? 65536 : 64u << (3 * wild);
      for (int k = 0; k < 3; ++k)
        in.current_counts[k] = static_cast<std::uint16_t>(
            (n < 40 ? 2048 : 2048 + (a >> (16 * k)) % spread - spread / 2) & 0xffff);
      in.bus_counts = static_cast<std::uint16_t>(wild == 3 ? a >> 48 : 2400 + (a >> 48) % 100);
      if (b % 31 == 0) sector += b / 16 % 5 == 0 ? 5 : 1;
      in.hall_pins = wild >= 2 && b / 128 % 50 == 0 ? static_cast<std::uint8_t>(b >> 56)
                                                    : pins_of(config.hall.arrangement, sector % 6);
      in.now += static_cast<std::uint32_t>(wild == 3 && b / 1024 % 100 == 0 ? b >> 32 : 30);
      if (b / 4096 % 60 == 0 || n == 0) request = {.run = b / 65536 % 4 != 0, .clear = b / 262144 % 2 == 0};
      double setpoint = std::ldexp(static_cast<double>(static_cast<std::int64_t>(b)), -62);
      if (!is_fixed<S> && b / 32 % 64 == 0) setpoint = b % 2 ? NAN : INFINITY;
      const BridgeCommand<S> c =
          protected_step(config, state, in, request, Setpoint<S>{static_cast<S>(setpoint)}, telemetry);
      ASSERT_TRUE(lawful(config, state, telemetry, c)) << "seed " << seed << " run " << run << " tick " << n;
      if (b / 8 % 3 == 0) {
        const BridgeCommand<S> h = protected_on_hall(config, state, in.hall_pins, in.now);
        ASSERT_TRUE(lawful(config, state, telemetry, h))
            << "seed " << seed << " run " << run << " edge " << n;
      }
      enabled += c.enabled;
      faulty += telemetry.faults != 0;
    }
  }
  // This test proves something only if both kinds of ticks occur.
  EXPECT_GT(enabled, 10000) << "seed " << seed;
  EXPECT_GT(faulty, 10000) << "seed " << seed;
  std::printf("seed %llu: %ld ticks with the bridge on, %ld with a fault\n",
              static_cast<unsigned long long>(seed), enabled, faulty);
}

}  // namespace SIXSTEP_TEST_FILE
