// SPDX-License-Identifier: Apache-2.0
// Runs every block of sixstep/control, and the exported drives of scenarios, with random inputs. Prints a
// digest of all outputs. The source is the same for every processor. There is one program for each scalar:
// TARGET_SCALAR is q15, q14, q31, q30, float, or whole for the blocks without a scalar. Other macros select
// other blocks. These are separate programs, so that the compiled code of the first program does not change:
//   TARGET_OF_ROTOR          sensing/ and sensorless/
//   TARGET_OF_OBSERVERS      the back-EMF observers
//   TARGET_OF_COMMISSIONING  commissioning/ without the pulses
//   TARGET_OF_PULSES         the pulses of commissioning/
//   TARGET_OF_FIELD          field/
#include "tests/target/platform/print.hpp"
#include "tests/target/walk/names.hpp"

#if defined TARGET_OF_ROTOR && TARGET_IS_WHOLE
#include "tests/target/walk/crossings.hpp"
#include "tests/target/walk/encoders.hpp"
#elif defined TARGET_OF_ROTOR
#include "tests/target/walk/angles.hpp"
#include "tests/target/walk/sensorless.hpp"
#elif defined TARGET_OF_OBSERVERS
#include "tests/target/walk/observers.hpp"
#elif defined TARGET_OF_COMMISSIONING && TARGET_IS_WHOLE
#include "tests/target/walk/surveys.hpp"
#elif defined TARGET_OF_COMMISSIONING
#include "tests/target/walk/commissioning.hpp"
#elif defined TARGET_OF_PULSES
#include "tests/target/walk/pulses.hpp"
#elif defined TARGET_OF_FIELD && TARGET_IS_WHOLE
#include "tests/target/walk/magnet.hpp"
#elif defined TARGET_OF_FIELD
#include "tests/target/walk/estimator.hpp"
#elif TARGET_IS_WHOLE
#include "tests/target/walk/whole.hpp"
#else
#include "tests/target/walk/loops.hpp"
#ifndef TARGET_COUNTED
#include "current.hpp"
#include "guarded.hpp"
#include "hysteresis.hpp"
#include "one_shunt.hpp"
#include "position.hpp"
#include "product.hpp"
#include "speed.hpp"
#include "tests/target/walk/drawn_drive.hpp"
#include "tests/target/walk/exported_drives.hpp"
#else
#include "tests/target/walk/legs.hpp"
#include "tests/target/walk/sensing.hpp"
#endif
#endif

namespace target {
namespace {

constexpr std::uint32_t short_walk = 10000;

void tell(const char* block, std::uint32_t steps, std::uint32_t digest) {
  print(block);
  print(" " TARGET_SCALAR_NAME " ");
  print_number(steps);
  print(" ");
  print_hex(digest);
  print("\n");
}

/// Draws a new configuration every 64 steps. A long walk begins with the steps of the short walk.
template <class Block>
__attribute__((noinline)) void walk(const char* name) {
  static Block block{};
  Random random{};
  Digest digest{};
  const std::uint32_t steps = steps_wanted();
  begins(name);
  for (std::uint32_t n = 0; n < steps;) {
    if (n % 64 == 0) block.draw(random);
    block.step(random, digest);
    if (++n == short_walk || n == steps) tell(name, n, digest.value());
  }
  tell_counted(name);
}

/// Measures the cost of the marks and of the call itself.
struct NothingWalk {
  void draw(Random&) {}
  void step(Random&, Digest&) {
    counted<0>("nothing", [] {});
  }
};

#if defined TARGET_OF_ROTOR
void walk_all() {
#ifdef TARGET_COUNTED
  walk<NothingWalk>("nothing");
#endif
#if TARGET_IS_WHOLE
  walk<HallCalibrationWalk>("sensing/hall_calibration");
  walk<QuadratureWalk>("sensing/quadrature");
  walk<TrackingWalk>("sensing/tracking");
  walk<ZeroCrossingWalk>("sensorless/zero_crossing");
  walk<CapturedCrossingWalk>("sensorless/captured_crossing");
  walk<CommutationClockWalk>("sensorless/commutation_clock");
  walk<SpinWalk>("sensorless/spin");
  walk<LockWalk>("sensorless/lock");
#else
  using Scalar = TARGET_SCALAR;
  walk<HallAngleWalk<Scalar> >("sensing/hall_angle");
  walk<PulseSpeedWalk<Scalar> >("sensing/pulse_speed");
  walk<GrayWalk<Scalar> >("sensing/gray");
  walk<SineWalk<Scalar> >("sensing/sine");
  walk<ResolverWalk<Scalar> >("sensing/resolver");
  walk<StartUpWalk<Scalar> >("sensorless/start_up");
  walk<SensorlessWalk<Scalar> >("sensorless/sensorless");
  walk<SensorlessDriveWalk<Scalar> >("sensorless/sensorless_drive");
#endif
}
#elif defined TARGET_OF_OBSERVERS
void walk_all() {
#ifdef TARGET_COUNTED
  walk<NothingWalk>("nothing");
#endif
#if TARGET_IS_WHOLE
  walk<ObservedCrossingWalk>("sensorless/observer");
#else
  using Scalar = TARGET_SCALAR;
  walk<LuenbergerWalk<Scalar> >("sensorless/luenberger");
  walk<SlidingModeWalk<Scalar> >("sensorless/sliding_mode");
  walk<FluxLinkageWalk<Scalar> >("sensorless/flux_linkage");
  walk<ObserverWalk<Scalar> >("sensorless/observer");
#endif
}
#elif defined TARGET_OF_COMMISSIONING
void walk_all() {
#ifdef TARGET_COUNTED
  walk<NothingWalk>("nothing");
#endif
#if TARGET_IS_WHOLE
  walk<VectorAngleWalk>("commissioning/vector_angle");
  walk<SeenVectorWalk>("commissioning/field_vector");
  walk<LevelStepsWalk>("commissioning/level_steps");
  walk<FluxTurnWalk>("commissioning/flux_turn");
  walk<HallSurveyWalk>("commissioning/hall_survey");
#else
  using Scalar = TARGET_SCALAR;
  walk<FieldVectorWalk<Scalar> >("commissioning/field_vector");
  walk<CommissioningResultWalk<Scalar> >("commissioning/commissioning_result");
  walk<CommissioningWalk<Scalar> >("commissioning/commissioning");
#endif
}
#elif defined TARGET_OF_PULSES
void walk_all() {
#ifdef TARGET_COUNTED
  walk<NothingWalk>("nothing");
#endif
#if TARGET_IS_WHOLE
  walk<PulsePositionWalk>("commissioning/pulse_position");
#else
  walk<PulsedDriveWalk<TARGET_SCALAR> >("commissioning/pulse_start");
#endif
}
#elif defined TARGET_OF_FIELD
#if !TARGET_IS_WHOLE
template <class Scalar>
void walk_floating() {
  if constexpr (__is_same(Scalar, float)) {
    walk<InjectionWalk<Scalar> >("field/injection");
    walk<NorthWalk<Scalar> >("field/polarity");
    walk<ActiveFluxWalk<Scalar> >("field/active_flux");
    walk<HarmonicCurrentWalk<Scalar> >("field/harmonic_current");
    walk<FiniteSetWalk<Scalar> >("field/finite_set");
    walk<SensorlessFieldWalk<Scalar> >("field/sensorless_field_drive");
    walk<JerkProfileWalk<Scalar> >("jerk_profile");
  }
}
#endif
void walk_all() {
#ifdef TARGET_COUNTED
  walk<NothingWalk>("nothing");
#endif
#if TARGET_IS_WHOLE
  walk<MagnetAngleWalk>("field/field_direction");
#else
  using Scalar = TARGET_SCALAR;
  walk<FieldCurrentWalk<Scalar> >("field/field_current");
  walk<ReachableCurrentWalk<Scalar> >("field/reachable_current");
  walk<FieldDirectionWalk<Scalar> >("field/field_direction");
  walk<FieldWeakeningWalk<Scalar> >("field/field_weakening");
  walk<TorquePerAmpereWalk<Scalar> >("field/torque_per_ampere");
  walk<FieldDriveWalk<Scalar> >("field/field_drive");
  walk_floating<Scalar>();
#endif
}
#elif TARGET_IS_WHOLE
void walk_all() {
#ifdef TARGET_COUNTED
  walk<NothingWalk>("nothing");
#endif
  walk<HallWalk>("hall");
  walk<StateMachineWalk>("state_machine");
}
#else
using Scalar = TARGET_SCALAR;

[[maybe_unused]] void walk_blocks() {
  walk<ArithmeticWalk<Scalar> >("arithmetic");
  walk<PiWalk<Scalar> >("pi");
  walk<PiPositionalWalk<Scalar> >("pi_positional");
  walk<DerivativeWalk<Scalar> >("derivative");
  walk<SlewWalk<Scalar> >("slew");
  walk<HysteresisWalk<Scalar> >("hysteresis");
  walk<FeedForwardWalk<Scalar> >("feed_forward");
  walk<SmoothChoppingWalk<Scalar> >("smooth_chopping");
  walk<ProfileWalk<Scalar> >("profile");
  walk<AdcWalk<Scalar> >("adc");
  walk<OneShuntWalk<Scalar> >("one_shunt");
  walk<HallSpeedWalk<Scalar> >("hall_speed");
  walk<AdvanceWalk<Scalar> >("advance");
  walk<LimitsWalk<Scalar> >("limits");
  walk<FaultsWalk<Scalar> >("faults");
  walk<CommutationWalk<Scalar> >("commutation");
  walk<FramesWalk<Scalar> >("frames");
  walk<ThreePhasePwmWalk<Scalar> >("three_phase_pwm");
  walk<PwmPatternWalk<Scalar> >("pwm_pattern");
  walk<CommutationStepWalk<Scalar> >("commutation_step");
  walk<DeadbeatWalk<Scalar> >("deadbeat");
}

#ifndef TARGET_COUNTED
[[maybe_unused]] void walk_drives() {
  walk<DrawnDriveWalk<Scalar> >("drive+retune");
  walk<LeanWalk<Scalar, current::drive> >("drive:current");
  walk<LeanWalk<Scalar, hysteresis::drive> >("drive:hysteresis");
  walk<LeanWalk<Scalar, speed::drive> >("drive:speed");
  walk<LeanWalk<Scalar, position::drive> >("drive:position");
  walk<ProductWalk<Scalar, product::product> >("product:speed");
  walk<ProductWalk<Scalar, guarded::product> >("product:guarded");
  walk<ProductWalk<Scalar, one_shunt::product> >("product:one_shunt");
}
#endif

void walk_all() {
#if defined TARGET_COUNTED
  walk<NothingWalk>("nothing");
  walk_blocks();
#elif defined TARGET_PROOF_ALONE
  walk<ArithmeticWalk<Scalar> >("arithmetic");
  walk<PiWalk<Scalar> >("pi");
  walk<DrawnDriveWalk<Scalar> >("drive+retune");
#else
  walk_blocks();
  walk_drives();
#endif
}
#endif

}  // namespace

void run() { walk_all(); }

}  // namespace target
