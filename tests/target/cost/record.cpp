// SPDX-License-Identifier: Apache-2.0
// record SCENARIO.toml ARITHMETIC RECORDS: runs a scenario and writes its firmware's inputs, tick by tick and
// Hall edge by Hall edge (record.hpp). It prints `run DIGEST` of the run and `answers CALLS DIGEST` of the
// firmware's answers.
//
// The firmware classes of this file have the parts of the classes in rig/firmware.hpp and record their
// inputs. The digest of the run must be equal to the digest of study::run(): recording changes nothing.
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <vector>

#include "files/scenario_on_disk.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/measure/digest.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/target/cost/record.hpp"
#include "tests/target/walk/legs.hpp"

namespace target {
namespace {

using namespace sixstep;

/// The results of one run. The rig constructs its firmware itself, so a caller cannot pass this object to the
/// firmware.
struct Tape {
  std::vector<std::uint8_t> bytes;
  std::uint32_t calls = 0;
  Digest answers;

  template <class Record, class Answer>
  void note(Record record, const Answer& answer) {
    bytes.resize(bytes.size() + Record::bytes);
    record.fields(Writer{bytes.data() + bytes.size() - Record::bytes});
    if constexpr (requires { answer.leg; })
      mix_legs(answers, answer);
    else
      mix_command(answers, answer);
    ++calls;
  }
} tape;

template <class Scalar>
class LeanRecorder {
 public:
  using Number = Scalar;
  using Command = BridgeCommand<Scalar>;
  using Config = DriveConfig<Scalar>;
  static constexpr bool fault_ends_run = true;

  LeanRecorder(const Config& config, const rig::BoardConfig& board, const rig::PowerUp& up)
      : drive_(config, board, up), sensors_(board.sensors, board.bases, up), bases_(board.bases) {}

  template <class Real>
  Command tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    LeanRecord<Scalar> record{};
    record.measured = rig::ideal_measurement<Scalar>(instant, bases_);
    sensors_.sense(record.measured, rig::sample_of(instant));
    record.setpoint.value = rig::from_si<Scalar>(setpoint, bases_.setpoint);
    const Command answer = drive_.step(record.measured, setpoint);
    tape.note(record, answer);
    return answer;
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { sensors_.hall_edge(pins, at); }
  Command hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    LeanRecord<Scalar> record{};
    record.kind = static_cast<std::uint8_t>(Kind::hall);
    record.measured.hall = pins;
    const Command answer = drive_.hall_interrupt(pins, at);
    if (answer.enabled) sensors_.commutated();
    tape.note(record, answer);
    return answer;
  }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const rig::Tuning<Config>& tuning) { drive_.retune(tuning); }
  bool reversed() const { return drive_.reversed(); }
  bool open_loop() const { return drive_.open_loop(); }
  bool follows_setpoint_at_once() const { return drive_.follows_setpoint_at_once(); }
  const Telemetry<Scalar>& telemetry() const { return drive_.telemetry(); }
  Mode mode() const { return drive_.mode(); }
  rig::Diagnosis diagnosis() const { return {}; }

 private:
  rig::LeanDrive<Scalar> drive_;
  rig::Sensors<Scalar> sensors_;
  rig::Bases bases_;
};

template <class Scalar>
class ProductRecorder {
 public:
  using Number = Scalar;
  using Command = BridgeCommand<Scalar>;
  using Config = ProtectedConfig<Scalar>;
  static constexpr bool fault_ends_run = false;

  ProductRecorder(const Config& config, const rig::BoardConfig& board, const rig::PowerUp& up)
      : config_(config), registers_(board.sensors), bases_(board.bases) {
    state_.position.sectors = static_cast<std::int32_t>(up.sector);
  }

  template <class Real>
  Command tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    const rig::Sample s = rig::sample_of(instant);
    ProductRecord<Scalar> record{};
    record.input = {
        .bus_counts = registers_.bus_counts(s), .hall_pins = instant.pins, .now = registers_.counter(s.at)};
    for (std::size_t k = 0; k < 3; ++k)
      record.input.current_counts[k] = registers_.current_counts(k, s.i_A[k], s.number);
    record.request = request_;
    record.setpoint.value = rig::from_si<Scalar>(setpoint, bases_.setpoint);
    const Command answer =
        protected_step(config_, state_, record.input, request_, record.setpoint, telemetry_);
    request_.clear = false;
    tape.note(record, answer);
    return answer;
  }
  void captured(std::uint8_t, const sim::Instant&) {}
  Command hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    ProductRecord<Scalar> record{};
    record.kind = static_cast<std::uint8_t>(Kind::hall);
    record.input = {.hall_pins = pins, .now = registers_.counter(at)};
    const Command answer = protected_on_hall(config_, state_, pins, record.input.now);
    tape.note(record, answer);
    return answer;
  }
  void request_run(bool run) { request_.run = run; }
  void request_clear() { request_.clear = true; }
  void retune(const rig::Tuning<Config>& tuning) { control::retune(config_, state_, tuning.config); }
  bool reversed() const { return state_.drive.reversed; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  const Telemetry<Scalar>& telemetry() const { return telemetry_.drive; }
  Mode mode() const { return config_.drive.mode; }
  rig::Diagnosis diagnosis() const { return {}; }

 private:
  Config config_;
  rig::Registers registers_;
  rig::Bases bases_;
  Request request_{};
  ProtectedState<Scalar> state_{};
  ProtectedTelemetry<Scalar> telemetry_{};
};

template <class Scalar>
class FieldRecorder {
 public:
  using Number = Scalar;
  using Command = LegCommands<Scalar>;
  using Config = SensorlessFieldConfig<Scalar>;  // the rig's configuration; here a sensor supplies the angle
  static constexpr bool fault_ends_run = true;

  FieldRecorder(const Config& config, const rig::BoardConfig& board, const rig::PowerUp& up)
      : config_(config.field), sensors_(board.sensors, board.bases, up), bases_(board.bases) {}

  template <class Real>
  const Command& tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    FieldRecord<Scalar> record{};
    record.measured = rig::ideal_measurement<Scalar>(instant, bases_);
    sensors_.sense(record.measured, rig::sample_of(instant));
    record.setpoint.value = rig::from_si<Scalar>(setpoint, bases_.setpoint);
    record.electrical = sensors_.electrical_angle();
    const FieldDriveInput<Scalar> input{
        record.measured, field_directions(config_.advance, record.electrical, record.measured.speed_rad_s)};
    const Command& answer = field_drive_step(config_, state_, input, record.setpoint, telemetry_);
    tape.note(record, answer);
    return answer;
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { sensors_.hall_edge(pins, at); }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const rig::Tuning<Config>& tuning) { control::retune(config_, state_, tuning.config.field); }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  const Telemetry<Scalar>& telemetry() const { return telemetry_; }
  Mode mode() const { return config_.drive.mode; }
  rig::Diagnosis diagnosis() const { return {}; }
  rig::ShaftPorts& shaft_ports() { return sensors_.shaft_ports(); }
  const rig::ShaftPorts& shaft_ports() const { return sensors_.shaft_ports(); }
  rig::Registers& registers() { return sensors_.registers(); }
  bool follows_shaft() const { return sensors_.follows_shaft(); }
  template <class Real>
  void follow(const rig::ShaftMotion<Real>& motion) {
    sensors_.follow(motion);
  }

 private:
  FieldDriveConfig<Scalar> config_;
  rig::Sensors<Scalar> sensors_;
  rig::Bases bases_;
  FieldDriveState<Scalar> state_{};
  Telemetry<Scalar> telemetry_{};
};

struct Watch {
  study::Digest digest;
  template <class Rig>
  void segment(const Rig& rig, double s) {
    digest.segment(rig, s);
  }
  template <class Rig>
  bool done(const Rig&) {
    return false;
  }
};

template <class Recorder, class Firmware>
std::uint64_t digest_of(const study::Scenario& s, const study::Compiled& c) {
  const auto chip = study::chip_of<Firmware>(s, c);
  if (!chip) return 0;
  const study::Chip<Recorder> own{chip->config, chip->bases, {}};
  auto rig = study::rig_of<Recorder>(c, own, c.timeline);
  Watch watch;
  sim::run(rig, c.end, watch);
  return watch.digest.after(rig);
}

template <class Scalar>
std::uint64_t digest_in(const study::Scenario& s, const study::Compiled& c) {
  if (s.control.drive == study::FirmwareKind::product)
    return digest_of<ProductRecorder<Scalar>, rig::ProductDrive<Scalar>>(s, c);
  if constexpr (std::is_floating_point_v<Scalar>)
    if (s.control.drive == study::FirmwareKind::field)
      return digest_of<FieldRecorder<Scalar>, rig::FieldDrive<Scalar>>(s, c);
  return digest_of<LeanRecorder<Scalar>, rig::SensedDrive<Scalar>>(s, c);
}

std::uint64_t digest_of_run(const study::Scenario& s, const study::Compiled& c) {
  switch (s.control.arithmetic) {
    case study::Arithmetic::q15:
      return digest_in<Q15>(s, c);
    case study::Arithmetic::q31:
      return digest_in<Q31>(s, c);
    case study::Arithmetic::float32:
      return digest_in<float>(s, c);
    default:
      return 0;
  }
}

int complain(const base::Problems& problems) {
  for (const base::Problem& p : problems)
    std::fprintf(stderr, "%s %s: %s\n", p.where.c_str(), p.value.c_str(), p.limit.c_str());
  return 2;
}

int record(const char* file, const char* arithmetic, const char* out) {
  const auto scenario = files::read_scenario(
      file, {.data_dir = TARGET_DATA, .overrides = {{"control.arithmetic", arithmetic}}});
  if (!scenario) return complain(scenario.problems());
  const auto compiled = study::compile(*scenario);
  if (!compiled) return complain(compiled.problems());
  const std::uint64_t digest = digest_of_run(*scenario, *compiled);
  const auto outcome = study::run(*scenario);
  if (!outcome) return complain(outcome.problems());
  if (outcome->digest != digest) {
    std::fprintf(stderr, "%s: the recording firmware ran otherwise than the rig's\n", file);
    return 3;
  }
  std::FILE* to = std::fopen(out, "wb");
  if (!to || std::fwrite(tape.bytes.data(), 1, tape.bytes.size(), to) != tape.bytes.size() ||
      std::fclose(to) != 0)
    return 4;
  std::printf("run %016" PRIx64 "\nanswers %" PRIu32 " %08" PRIx32 "\n", digest, tape.calls,
              tape.answers.value());
  return 0;
}

}  // namespace
}  // namespace target

int main(int argc, char** argv) { return argc == 4 ? target::record(argv[1], argv[2], argv[3]) : 2; }
