// SPDX-License-Identifier: Apache-2.0
#include "io/csv_writer.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace io {
namespace {
constexpr std::size_t block = 1 << 16;
}

void append_number(std::string& text, double x) {
  fmt::format_to(std::back_inserter(text), FMT_COMPILE("{:.17g}"), x);
}

base::Result<CsvWriter> CsvWriter::create(const std::string& path, std::span<const study::Column> columns) {
  base::Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.problems();
  CsvWriter writer(std::move(*file));
  for (const study::Column& column : columns) writer.pending_ += column.name + ',';
  if (!writer.pending_.empty()) writer.pending_.back() = '\n';
  return writer;
}

void CsvWriter::row(std::span<const double> numbers) {
  for (const double x : numbers) {
    append_number(pending_, x);
    pending_ += ',';
  }
  if (!numbers.empty()) pending_.back() = '\n';
  if (pending_.size() >= block) flush();
}

void CsvWriter::flush() {
  file_.write(pending_);
  pending_.clear();
}

base::Problems CsvWriter::commit() {
  flush();
  return file_.commit();
}

base::Problems CsvWriter::commit_partial() {
  flush();
  return file_.commit_partial();
}

}  // namespace io
