// SPDX-License-Identifier: Apache-2.0
// Measures the possible gain of SIMD lanes for batches. It computes the Taylor recurrence of one motor, and
// of 2, 4 and 8 independent motors in the lanes of a vector. Each segment begins at the end of the previous
// segment. All lanes have the same segments and the same degree. In real runs, each run has its own events,
// connected legs and degree. The result is therefore an upper bound, and only for the recurrence.
//
// It is built with the project's flags and, on x86-64, also for AVX2 and AVX-512:
//   build/dev/benchmarks/lanes_benchmark{,_avx2,_avx512}
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "benchmarks/lanes.hpp"
#include "sixstep/plant/recurrences.hpp"

namespace {

using namespace benchmarks;
namespace plant = sixstep::plant;
using plant::Connection;
using plant::detail::FlatPair;
using plant::detail::TwoCurrents;

/// In R6, a segment lasts 13 us and needs a degree of 7.5 on average.
constexpr int degree = 8;
constexpr double length_s = 13e-6;

/// The reference motor (maxon 251601) at 24 V. Motor n has n per cent more resistance.
template <class Real>
plant::Constants<Real> motors(std::size_t width) {
  plant::Constants<Real> c{};
  for (std::size_t n = 0; n < width; ++n) set_lane(c.R, n, 0.515 * (1.0 + 0.01 * static_cast<double>(n)));
  c.inv_L = 1.0 / 0.286e-3;
  c.inv_J = 1.0 / 1.35e-5;
  c.B = 7.3e-6;
  c.pole_pairs = 8.0;
  c.inv_pole_pairs = 1.0 / 8.0;
  return c;
}

/// Sector 0, with phase a on the upper switch and b on the lower switch. If c conducts through a diode, two
/// currents are independent. In this sector, the back-EMF of c falls from 1 to -1 over 60 degrees.
struct Segment {
  plant::Mode mode;
  explicit Segment(bool all_legs)
      : mode{.legs = {Connection::high_switch, Connection::low_switch,
                      all_legs ? Connection::low_diode : Connection::floating}} {}
  template <class Real>
  plant::EmfPiece<Real> emf() const {
    constexpr double K_e = 16.75e-3;
    plant::EmfPiece<Real> piece;
    piece.alpha = {Real(K_e), Real(-K_e), Real(K_e)};
    piece.beta = {Real(0.0), Real(0.0), Real(-1.9098593171027440 * K_e)};
    return piece;
  }
};

template <class Real>
struct Motor {
  plant::Constants<Real> constants;
  plant::Expansion<Real> y;

  explicit Motor(std::size_t width) : constants(motors<Real>(width)) {
    for (auto& i : y.i) i = {};
    y.w = y.x = y.bus = y.torque = {};
    y.h = Real(length_s);
    y.i[0][0] = Real(4.0);
    y.i[1][0] = Real(-3.0);
    y.i[2][0] = Real(-1.0);
    y.w[0] = Real(100.0);
    y.bus[0] = Real(24.0);
  }

  template <class Currents>
  [[gnu::noinline]] void take_segment(const Segment& segment) {
    using namespace plant::detail;
    y.x[0] = Real(0.3);  // every segment begins at the same angle in the sector
    const plant::LegsLaw<Real> law = plant::legs_law(segment.mode.legs, {}, constants.R, constants.inv_L);
    const Rotor<Real> rotor(constants, segment.mode.motion);
    Currents currents(rotor, constants, law, ShapeLine<false, Real>(segment.emf<Real>(), y.x[0]));
    SeriesBuilder<Real> growing;
    growing.w[0] = y.w[0];
    growing.x[0] = y.x[0];
    growing.bus[0] = y.bus[0];
    growing.h = y.h;
    currents.start(y, growing);
    const auto take_order = [&]<int n>(std::integral_constant<int, n>) __attribute__((always_inline)) {
      currents.template step<n, false>(rotor, growing, growing.h * Real(1.0L / (n + 1)));
      currents.write(y, n + 1, growing);
      y.w[n + 1] = growing.w[n + 1];
      y.x[n + 1] = growing.x[n + 1];
      y.torque[n] = growing.torque[n];
    };
    [&]<int... n>(std::integer_sequence<int, n...>) __attribute__((always_inline)) {
      (take_order(std::integral_constant<int, n>{}), ...);
    }
    (std::make_integer_sequence<int, degree>{});
    // Advances to the segment's end. The factor 0.9 keeps the currents in their range over many segments.
    for (auto& i : y.i) i[0] = Real(0.9) * end_of(i);
    y.w[0] = Real(0.9) * end_of(y.w) + Real(10.0);
  }

 private:
  static Real end_of(const sixstep::series::Coefficients<Real>& c) {
    return c[0] + sixstep::series::increment(c, degree, Real(1.0));
  }
};

template <class Real, class Currents>
void run_lanes(benchmark::State& state, int width, bool all_legs) {
  const Segment segment(all_legs);
  Motor<Real> motor(static_cast<std::size_t>(width));
  for (auto _ : state) {
    motor.template take_segment<Currents>(segment);
    benchmark::ClobberMemory();
  }
  state.counters["per_motor"] =
      benchmark::Counter(static_cast<double>(width) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Whether each lane gives the same bits as its motor alone. Otherwise lanes cannot be used.
template <int width, template <class> class Currents>
bool same_bits(bool all_legs) {
  const Segment segment(all_legs);
  Motor<Lanes<width>> together(width);
  for (int s = 0; s < 100; ++s) together.template take_segment<Currents<Lanes<width>>>(segment);
  for (std::size_t n = 0; n < width; ++n) {
    Motor<double> alone(1);
    alone.constants.R = lane(together.constants.R, n);
    for (int s = 0; s < 100; ++s) alone.template take_segment<Currents<double>>(segment);
    if (alone.y.i[0][0] != lane(together.y.i[0][0], n) || alone.y.w[0] != lane(together.y.w[0], n))
      return false;
  }
  return true;
}

template <class Real>
using StarTrapezoid = TwoCurrents<false, Real>;

bool supported() {
#if defined(__AVX512F__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
#elif defined(__AVX2__)
  return __builtin_cpu_supports("avx2");
#else
  return true;
#endif
}

template <template <class> class Currents>
void declare(const std::string& name, bool all_legs) {
  const auto add = [&]<class Real>(const char* lanes, int width, Real) {
    benchmark::RegisterBenchmark((name + "/" + lanes).c_str(), run_lanes<Real, Currents<Real>>, width,
                                 all_legs);
  };
  add("1", 1, double{});
  add("2", 2, Lanes<2>{});
  add("4", 4, Lanes<4>{});
  add("8", 8, Lanes<8>{});
  if (same_bits<2, Currents>(all_legs) && same_bits<4, Currents>(all_legs) &&
      same_bits<8, Currents>(all_legs))
    return;
  std::fprintf(stderr, "%s: a lane does not have its motor's bits\n", name.c_str());
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (!supported()) {
    std::fprintf(stderr, "this processor lacks the instructions this program was built for\n");
    return 0;
  }
  declare<StarTrapezoid>("two currents", true);
  declare<FlatPair>("flat pair", false);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
