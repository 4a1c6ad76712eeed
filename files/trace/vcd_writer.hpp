// SPDX-License-Identifier: Apache-2.0
// Writes logic signals as a value change dump (IEEE 1364, clause 18), for GTKWave, PulseView and Surfer.
// Times are whole picoseconds, as in the rig.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"
#include "files/trace/trace_origin.hpp"
#include "sixstep/study/measure/logic.hpp"

namespace files {

class VcdWriter {
 public:
  static base::Result<VcdWriter> create(const Destination& to, std::span<const study::LogicSignal> signals,
                                        const TraceOrigin& origin);

  /// Adds the signals' values at an instant. Instants must not decrease.
  void change(std::int64_t ps, std::span<const std::uint32_t> row);
  bool failed() const { return file_.failed(); }
  base::Problems commit();
  base::Problems commit_partial();

 private:
  VcdWriter(AtomicFile file, std::span<const study::LogicSignal> signals)
      : file_(std::move(file)), signals_(signals.begin(), signals.end()) {}
  void value(std::size_t signal, std::uint32_t v);
  void first_row(std::span<const std::uint32_t> row);
  void flush();

  AtomicFile file_;
  std::vector<study::LogicSignal> signals_;
  std::vector<std::uint32_t> last_;
  std::int64_t last_ps_ = 0;
  std::string pending_;
};

}  // namespace files
