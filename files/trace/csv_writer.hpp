// SPDX-License-Identifier: Apache-2.0
// Writes a trace as text: comment lines that begin with #, one line of column names, then rows of numbers. A
// number that is read back has the same bits.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace files {

class CsvWriter {
 public:
  /// Creates the file. Each comment is one line.
  static base::Result<CsvWriter> create(const Destination& to, std::span<const study::Column> columns,
                                        std::span<const std::string> comments = {});

  void row(std::span<const double> numbers);
  bool failed() const { return file_.failed(); }
  base::Problems commit();
  base::Problems commit_partial();

 private:
  explicit CsvWriter(AtomicFile file) : file_(std::move(file)) {}
  void flush();

  AtomicFile file_;
  std::string pending_;
};

/// Appends a number with the fewest digits that read back as the same number, at most 17.
void append_number(std::string& text, double x);

}  // namespace files
