// SPDX-License-Identifier: Apache-2.0
// The trace as a MAT file: each column a vector of its name, `units` and `meanings` by column, `sixstep` with
// where it comes from. Rows wait on the disk (ColumnSpool), so memory does not grow with the run.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/column_spool.hpp"
#include "io/mat_file.hpp"
#include "io/trace_origin.hpp"
#include "sixstep/study/outcome.hpp"

namespace io {

class MatWriter {
 public:
  /// Version 7.3 needs a file that can be written to and fro: a pipe is refused.
  static base::Result<MatWriter> create(const std::string& path, std::span<const study::Column> columns,
                                        MatVersion version, TraceOrigin origin);

  void row(std::span<const double> numbers);
  bool failed() const { return error_ != 0 || spool_.failed() || file_.failed(); }

  /// `digest`: of the run, which only its end knows.
  base::Problems commit(std::uint64_t digest);
  base::Problems commit_partial(std::uint64_t digest);

 private:
  MatWriter(AtomicFile file, std::span<const study::Column> columns, MatVersion version, TraceOrigin origin);
  void reserve();
  void describe_trace(MatFile& mat, std::uint64_t digest) const;
  bool assemble(std::uint64_t digest);
  bool assemble_v5(std::uint64_t digest);
  bool assemble_v7_3(std::uint64_t digest);
  base::Problems save_what_fits(std::uint64_t digest);

  AtomicFile file_;
  std::vector<study::Column> columns_;
  MatVersion version_;
  TraceOrigin origin_;
  ColumnSpool spool_;
  int error_ = 0;  // what errno said when room was asked for
};

}  // namespace io
