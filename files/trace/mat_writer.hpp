// SPDX-License-Identifier: Apache-2.0
// Writes a trace as a MAT file: each column as a vector with its name, the structs `units` and `meanings` by
// column, and `sixstep` with the trace's origin. Until the end of the run, rows are stored on the disk
// (ColumnSpool), so that memory does not increase with the run.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"
#include "files/column_spool.hpp"
#include "files/trace/mat_text.hpp"
#include "files/trace/mat_version.hpp"
#include "files/trace/trace_origin.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace files {

class MatWriter {
 public:
  /// Largest number of rows in version 5. A variable must be smaller than 2 GiB, because many readers read
  /// its size as a signed number.
  static constexpr std::size_t v5_most_rows = ((std::size_t{1} << 31U) - 1024) / sizeof(double);

  static base::Result<MatWriter> create(const Destination& to, std::span<const study::Column> columns,
                                        MatVersion version, TraceOrigin origin,
                                        std::size_t most_rows_of_v5 = v5_most_rows);

  void row(std::span<const double> numbers);
  bool failed() const { return too_long_ || error_ != 0 || spool_.failed() || file_.failed(); }

  /// `digest` is the run's digest, which is known only at the run's end.
  base::Problems commit(std::uint64_t digest);
  base::Problems commit_partial(std::uint64_t digest);

 private:
  MatWriter(AtomicFile file, std::span<const study::Column> columns, MatVersion version, TraceOrigin origin,
            std::size_t most_rows_of_v5);
  void reserve();
  std::vector<std::pair<std::string, MatFields>> structs(std::uint64_t digest) const;
  /// Writes the file from its beginning. After a failure, nothing of the new content is kept.
  bool assemble(std::uint64_t digest);
  base::Problems save_what_fits(std::uint64_t digest);

  AtomicFile file_;
  std::vector<study::Column> columns_;
  MatVersion version_;
  TraceOrigin origin_;
  std::size_t most_rows_;
  ColumnSpool spool_;
  bool too_long_ = false;
  int error_ = 0;  // errno of the reservation
};

}  // namespace files
