// SPDX-License-Identifier: Apache-2.0
#include "files/trace/csv_writer.hpp"
#include "sixstep/study/measure/trace.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <utility>

namespace files {
namespace {
constexpr std::size_t block = 1 << 16;
constexpr std::size_t longest = 32;  // the longest number with its comma has 25 characters:
                                     // -2.2250738585072014e-308,
}  // namespace

void append_number(std::string& text, double x) {
  char digits[longest];
  text.append(digits, fmt::format_to(digits, FMT_COMPILE("{}"), x));
}

base::Result<CsvWriter> CsvWriter::create(const Destination& to, std::span<const study::Column> columns,
                                          std::span<const std::string> comments) {
  base::Result<AtomicFile> file = AtomicFile::create(to);
  if (!file) return file.problems();
  CsvWriter writer(std::move(*file));
  for (const std::string& comment : comments) writer.pending_ += "# " + comment + "\n";
  for (const study::Column& column : columns) writer.pending_ += column.name + ',';
  if (!columns.empty()) writer.pending_.back() = '\n';
  return writer;
}

void CsvWriter::row(std::span<const double> numbers) {
  const std::size_t used = pending_.size();
  pending_.resize(used + longest * numbers.size());
  char* end = pending_.data() + used;
  for (const double x : numbers) {
    if (x - x == 0.0)
      end = fmt::format_to(end, FMT_COMPILE("{},"), x);
    else
      *end++ = ',';  // the cell of a NaN is empty
  }
  pending_.resize(static_cast<std::size_t>(end - pending_.data()));
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

}  // namespace files
