// SPDX-License-Identifier: Apache-2.0
// The product's drive, fed by registers: a coarse motor to walk through its activities, and noise to find
// what it must never do.
#include "sixstep/control/protected_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/control/gates.hpp"
#include "sixstep/plant/hall.hpp"
#include "tests/control/scalars.hpp"

namespace {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<ProtectedState<double>> &&
              std::is_trivially_copyable_v<ProtectedState<Q15>> &&
              std::is_trivially_copyable_v<ProtectedConfig<Q15>>);

// What 1.0 means. Signals end at 2, so differences of full-scale signals still fit.
constexpr double base_A = 20, base_V = 25, base_rad_s = 500, base_deg = 2000;
// maxon 251601 (MODEL 6) at the terminals; the thesis's period; a timer of 1 MHz.
constexpr double R = 1.03, L = 0.572e-3, K_t = 33.5e-3, J = 135e-7, T = 30e-6, U = 24;
constexpr int pole_pairs = 8;

template <class S>
PiConfig<S> pi(double d1, double K_i, double limit) {
  if constexpr (is_fixed<S>)
    return {Gain<S>(d1), Gain<S>(K_i), S(limit)};
  else
    return {static_cast<S>(d1), static_cast<S>(K_i - d1), static_cast<S>(limit)};
}

/// Gains of the thesis's chapter 6 (THESIS, the design numbers), per unit.
template <class S>
ProtectedConfig<S> product() {
  const auto s = [](double x) { return static_cast<S>(x); };
  const auto g = [](double x) { return static_cast<Gain<S>>(x); };
  ProtectedConfig<S> c;
  c.drive.mode = Mode::speed;
  c.drive.chopping = Chopping::complementary;
  c.drive.current = pi<S>(4.0956 * base_A / base_V, 0.4016 * base_A / base_V, U / base_V);
  c.drive.nominal_bus_V = static_cast<Divisor<S>>(U / base_V);
  c.drive.speed = pi<S>(0.0158299 * base_rad_s, 0.00013378 * base_rad_s, 1.0);
  c.drive.current_at_full_torque_A = g(0.78 / K_t / base_A);
  c.drive.current_limit_A = s(10 / base_A);
  c.setpoint_limit = s(1.0);
  for (AdcConfig<S>& adc : c.current_adc) adc = {per_count<S>(40.0 / 4096 / 8 / base_A), 2048, 40, 4};
  c.bus_adc = {per_count<S>(40.0 / 4096 / 8 / base_V), 0, 0, 0};
  c.speed = {TickRatio<S>(M_PI / 3 / pole_pairs * 1e6 / base_rad_s), 100000, 1};
  c.position = {per_count<S>(60.0 / pole_pairs / base_deg), g(60.0 / pole_pairs / base_deg)};
  c.faults = {s(15 / base_A), s(30 / base_V), s(10 / base_V), s(450 / base_rad_s), s(8 / base_A), 3000, 3};
  c.brake_current_A = s(5 / base_A);
  c.short_below_rad_s = s(100 / base_rad_s);
  c.standing_rad_s = s(5 / base_rad_s);
  return c;
}

/// One mean circuit R L between the driven terminals, flat back-EMF: enough to close the loops.
struct Motor {
  double i = 0, w = 0, theta_e = 0.3, t = 0;  // theta_e in sectors
  int sector() const { return static_cast<int>(std::floor(theta_e)); }
  std::uint8_t pins() const { return sixstep::plant::hall_code((sector() % 6 + 6) % 6); }

  template <class S>
  void run(const BridgeCommand<S>& c) {
    const Pair positive = positive_pair(sector_of_hall(pins()));
    double u = K_t * w;  // floating: no current
    if (c.enabled) {
      const bool forward = c.pair == positive, backward = c.pair == swapped(positive);
      u = (forward ? 1 : backward ? -1 : 0) * static_cast<double>(c.duty) * U;
    } else {
      i = 0;
    }
    const double h = T / 10;
    for (int n = 0; n < 10; ++n) {
      i += h * (u - R * i - K_t * w) / L;
      w += h * (K_t * i - 1e-5 * w) / J;
      theta_e += h * w * pole_pairs * 3 / M_PI;
    }
    t += T;
  }
};

template <class S>
struct Plant {
  ProtectedConfig<S> config = product<S>();
  ProtectedState<S> state{};
  ProtectedTelemetry<S> telemetry{};
  Motor motor;
  BridgeCommand<S> command{};
  Request request{};
  double setpoint = 0;
  std::uint8_t stuck_low = 0, stuck_high = 0;

  BoardInput registers() const {
    BoardInput in;
    const Pair p = positive_pair(sector_of_hall(motor.pins()));
    for (int k = 0; k < 3; ++k) {
      const Leg leg = static_cast<Leg>(k);
      const double i = leg == p.source ? motor.i : leg == p.sink ? -motor.i : 0;
      in.current_counts[k] = static_cast<std::uint16_t>(std::lround(2055 + i * 4096 / 40));
    }
    if (config.sensing == CurrentSensing::one_shunt) {
      const bool visible = command.enabled && static_cast<double>(command.duty) > 0.05;
      const double driven = !visible ? 0 : state.drive.reversed ? -motor.i : motor.i;
      in.current_counts[0] = static_cast<std::uint16_t>(std::lround(2055 + driven * 4096 / 40));
    }
    in.bus_counts = static_cast<std::uint16_t>(std::lround(U * 4096 / 40));
    in.hall_pins = static_cast<std::uint8_t>((motor.pins() | stuck_high) & ~stuck_low);
    in.now = static_cast<std::uint32_t>(std::llround(motor.t * 1e6));
    return in;
  }
  void tick() {
    command =
        protected_step(config, state, registers(), request, Setpoint<S>{static_cast<S>(setpoint)}, telemetry);
    const int before = motor.sector();
    motor.run(command);
    if (motor.sector() != before) {
      const BoardInput in = registers();
      command = protected_on_hall(config, state, in.hall_pins, in.now);
    }
  }
  void ticks(int n) {
    for (int k = 0; k < n; ++k) tick();
  }
};

template <class Scalar>
class Product : public testing::Test {};
TYPED_TEST_SUITE(Product, Scalars);

TYPED_TEST(Product, DefaultsNeverTurnTheBridgeOn) {
  using S = TypeParam;
  ProtectedState<S> state;
  ProtectedTelemetry<S> telemetry;
  for (int n = 0; n < 1000; ++n) {
    const BridgeCommand<S> c =
        protected_step(ProtectedConfig<S>{}, state, BoardInput{.hall_pins = 0b100},
                       Request{.run = true, .clear = n % 2 == 0}, Setpoint<S>{S(1.0)}, telemetry);
    EXPECT_FALSE(c.enabled);
  }
}

TYPED_TEST(Product, CalibratesRunsBrakesAndLetsGo) {
  using S = TypeParam;
  Plant<S> p;
  p.ticks(5);
  EXPECT_EQ(p.telemetry.activity, Activity::off);
  p.request.run = true;
  p.setpoint = 200 / base_rad_s;
  p.tick();
  EXPECT_EQ(p.telemetry.activity, Activity::calibrate);
  EXPECT_FALSE(p.command.enabled);
  p.ticks(18);
  EXPECT_EQ(p.telemetry.activity, Activity::run);
  EXPECT_EQ(p.state.current_adc[1].offset_eighths, 8 * 2055);
  // The integral makes the mean of the estimate the setpoint. The estimate knows a sector's time of 654 us to
  // 1 us, 0.31 rad/s of 200; it is new once a sector, which makes the speed hunt by some rad/s (dw), and a
  // mean of 1/time differs from that of speed by dw^2/w: 0.1 rad/s for 4.
  const auto mean_speed = [&p] {
    p.ticks(8000);
    double sum = 0;
    for (int n = 0; n < 8000; ++n) p.tick(), sum += p.motor.w;
    return sum / 8000;
  };
  EXPECT_NEAR(mean_speed(), 200, 0.41);
  EXPECT_EQ(p.telemetry.faults, 0);
  p.setpoint = -200 / base_rad_s;
  EXPECT_NEAR(mean_speed(), -200, 0.41) << "reversal";
  EXPECT_EQ(p.telemetry.faults, 0);
  p.request.run = false;
  p.tick();
  EXPECT_EQ(p.telemetry.activity, Activity::brake);
  for (int n = 0; n < 20000 && p.telemetry.activity == Activity::brake; ++n) p.tick();
  EXPECT_EQ(p.telemetry.activity, Activity::off);
  EXPECT_FALSE(p.command.enabled);
  // It lets go where the estimate says 5 rad/s; between edges the estimate is only a bound from above.
  EXPECT_LE(std::fabs(p.motor.w), 5.0);
}

TYPED_TEST(Product, AHallFaultStopsTheBridgeWithinATickAndNamesTheLine) {
  using S = TypeParam;
  for (int line = 1; line <= 3; ++line)
    for (const bool high : {false, true}) {
      Plant<S> p;
      p.request.run = true;
      p.setpoint = 200 / base_rad_s;
      p.ticks(4000);
      ASSERT_EQ(p.telemetry.activity, Activity::run);
      const auto bit = static_cast<std::uint8_t>(0b1000u >> line);
      (high ? p.stuck_high : p.stuck_low) = bit;
      int n = 0;
      for (; n < 400 && p.telemetry.faults == 0; ++n) {
        const std::uint8_t pins = p.registers().hall_pins;
        p.tick();
        if (sector_of_hall(pins) == no_sector) {
          EXPECT_FALSE(p.command.enabled) << "the very tick";
        }
      }
      EXPECT_EQ(p.telemetry.first_fault, fault_hall) << line;
      EXPECT_EQ(p.telemetry.activity, Activity::fault);
      EXPECT_EQ(p.telemetry.hall_line, line);
      // The way out: the line is mended, clear, run released and asked for again.
      p.stuck_low = p.stuck_high = 0;
      p.ticks(3);
      p.request = {.run = true, .clear = true};
      p.ticks(3);
      EXPECT_EQ(p.telemetry.activity, Activity::off);
      p.request = {};
      p.tick();
      p.request.run = true;
      p.ticks(30);
      EXPECT_EQ(p.telemetry.activity, Activity::run);
    }
}

TYPED_TEST(Product, AWronglyWiredRotorFailsTheAlignment) {
  using S = TypeParam;
  Plant<S> p;
  p.config.align = {S(2 / base_A), 100, 10, 0};
  p.request.run = true;
  p.motor.theta_e = 1.5;  // where the pair of sector 0 pulls it to
  p.ticks(25);
  EXPECT_EQ(p.telemetry.activity, Activity::align);
  EXPECT_EQ(p.command.pair, positive_pair(0));
  EXPECT_TRUE(p.command.enabled);
  Plant<S> wrong = p;
  p.motor.theta_e = wrong.motor.theta_e = 1.5;
  for (int n = 0; n < 11; ++n) {
    p.motor.w = 0, p.motor.i = 0, p.motor.theta_e = 1.5;
    p.tick();
  }
  EXPECT_EQ(p.telemetry.activity, Activity::run);
  for (int n = 0; n < 105; ++n) {
    wrong.motor.w = 0, wrong.motor.i = 0, wrong.motor.theta_e = 4.5;
    wrong.tick();
  }
  EXPECT_EQ(wrong.telemetry.activity, Activity::fault);
  EXPECT_TRUE(wrong.telemetry.faults & (fault_align | fault_hall));
}

TYPED_TEST(Product, RunsOnOneShunt) {
  using S = TypeParam;
  Plant<S> p;
  p.config.sensing = CurrentSensing::one_shunt;
  p.config.shunt = {S(0.05), 0, S(0.9)};
  p.request.run = true;
  p.setpoint = 200 / base_rad_s;
  p.ticks(8000);
  double speed = 0, worst = 0;
  for (int n = 0; n < 8000; ++n) {
    const double i = p.motor.i;  // what the tick's sample sees
    p.tick();
    speed += p.motor.w / 8000;
    if (p.state.shunt.hidden == 0)
      worst =
          std::fmax(worst, std::fabs(static_cast<double>(p.telemetry.drive.motor_current_A) * base_A - i));
  }
  EXPECT_EQ(p.telemetry.faults, 0);
  EXPECT_NEAR(speed, 200, 0.41) << "as with phase currents";
  // Half a count of 9.8 mA in the sample, a sixteenth in the offset, two roundings of the scalar.
  EXPECT_LE(worst, 40.0 / 4096 * (0.5 + 0.0625) + 2 * digit<S>() * base_A);
}

TYPED_TEST(Product, AdvanceCommutatesBeforeTheEdge) {
  using S = TypeParam;
  Plant<S> p;
  p.request.run = true;
  p.setpoint = 200 / base_rad_s;
  p.ticks(6000);
  p.config.advance = {S(0.25), Gain<S>(0.0), S(0.4)};
  int early = 0, present = 0;
  for (int n = 0; n < 500; ++n) {
    const int s = p.motor.sector();
    const double way = p.motor.theta_e - s;
    p.motor.w = 200;  // held, as by a large inertia: the last sector then tells the present one
    p.tick();
    if (!p.command.enabled || p.motor.sector() != s) continue;
    const Pair pair = p.state.drive.reversed ? swapped(p.command.pair) : p.command.pair;
    // A tick is 5 % of a sector, and an edge's time is known to the tick's end in this plant.
    if (way > 0.8 && way < 0.95) {
      EXPECT_EQ(pair, positive_pair(static_cast<std::uint8_t>((s + 1) % 6)));
      ++early;
    } else if (way > 0.05 && way < 0.7) {
      EXPECT_EQ(pair, positive_pair(static_cast<std::uint8_t>(s % 6)));
      ++present;
    }
  }
  EXPECT_GT(early, 30);
  EXPECT_GT(present, 200);
}

template <class S>
bool is_number(S x) {
  return x == x && static_cast<double>(x) - static_cast<double>(x) == 0;
}

/// What must hold of every answer, whatever the registers said.
template <class S>
testing::AssertionResult lawful(const ProtectedConfig<S>& config, const ProtectedState<S>& state,
                                const ProtectedTelemetry<S>& t, const BridgeCommand<S>& c) {
  const auto no = [](const char* why) { return testing::AssertionFailure() << why; };
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
  return testing::AssertionSuccess();
}

/// What probes of the arrangement say (MODEL 3): each is high over half a turn.
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
  c.sensing = static_cast<CurrentSensing>(bits / 32768 % 2);
  c.shunt = {static_cast<S>(0.05), 20, static_cast<S>(0.9)};
  c.hall.stable_samples = static_cast<std::uint8_t>(bits / 65536 % 3);
  c.hall.arrangement = static_cast<HallArrangement>(bits / 262144 % 2);
  c.advance = {static_cast<S>(0.05), static_cast<Gain<S>>(0.2), static_cast<S>(0.4)};
  c.align.ticks = bits / 524288 % 2 ? 20 : 0;
  c.align.current_A = static_cast<S>(0.1);
  if (bits / 1048576 % 2) {  // let nearly everything through, to reach deeper states
    const S most = is_fixed<S> ? static_cast<S>(1.99) : static_cast<S>(1e6);
    c.faults = {most, most, -most, most, most, 0xffffffffu, 255};
  }
}

TYPED_TEST(Product, RandomRegistersNeverLeadToAnUnlawfulCommand) {
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
  // The fuzz is worth something only if it reaches both sides.
  EXPECT_GT(enabled, 10000) << "seed " << seed;
  EXPECT_GT(faulty, 10000) << "seed " << seed;
  std::printf("seed %llu: %ld ticks with the bridge on, %ld with a fault\n",
              static_cast<unsigned long long>(seed), enabled, faulty);
}

}  // namespace
