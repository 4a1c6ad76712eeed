// SPDX-License-Identifier: Apache-2.0
#include "files/trace/mat_writer.hpp"

#include <fmt/format.h>

#include <cerrno>

#include "files/trace/mat5.hpp"
#include "files/trace/mat73.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace files {
namespace {

constexpr std::size_t header_bytes = 128;

std::string_view bytes_of(std::span<const double> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

}  // namespace

base::Result<MatWriter> MatWriter::create(const Destination& to, std::span<const study::Column> columns,
                                          MatVersion version, TraceOrigin origin,
                                          std::size_t most_rows_of_v5) {
  base::Result<AtomicFile> file = AtomicFile::create(to);
  if (!file) return file.problems();
  return MatWriter(std::move(*file), columns, version, std::move(origin), most_rows_of_v5);
}

MatWriter::MatWriter(AtomicFile file, std::span<const study::Column> columns, MatVersion version,
                     TraceOrigin origin, std::size_t most_rows_of_v5)
    : file_(std::move(file)),
      columns_(columns.begin(), columns.end()),
      version_(version),
      origin_(std::move(origin)),
      most_rows_(most_rows_of_v5),
      spool_(file_.temporary(), columns.size()) {}

void MatWriter::row(std::span<const double> numbers) {
  if (failed()) return;
  if (spool_.rows() % ColumnSpool::block_rows == 0) reserve();
  if (failed()) return;
  spool_.row(numbers);
}

/// Reserves space for the final file before a block of rows is accepted. If the disk is full, the run stops
/// while there is still space for all accepted rows.
void MatWriter::reserve() {
  constexpr std::size_t per_column = 4096;  // for headers, units and meanings; in HDF5 also for tables
  const std::size_t rows = spool_.rows() + ColumnSpool::block_rows;
  too_long_ = version_ == MatVersion::v5 && rows > most_rows_;
  if (!too_long_)
    error_ = file_.reserve(header_bytes + columns_.size() * (per_column + rows * sizeof(double)));
}

std::vector<std::pair<std::string, MatFields>> MatWriter::structs(std::uint64_t digest) const {
  MatFields units, meanings;
  for (const study::Column& c : columns_) {
    units.emplace_back(c.name, c.unit);
    meanings.emplace_back(c.name, c.frame.empty() ? c.meaning : c.meaning + "; " + c.frame);
  }
  return {{"sixstep",
           {{"version", SIXSTEP_VERSION},
            {"title", origin_.title},
            {"motor", origin_.motor},
            {"scenario", origin_.scenario},
            {"scenario_digest", base::written_hex(origin_.digest)},
            {"digest", base::written_hex(digest)},
            {"command", origin_.command}}},
          {"units", std::move(units)},
          {"meanings", std::move(meanings)}};
}

/// Writes the small parts, then the columns: in version 5 each column after its header, in version 7.3 only
/// the numbers.
bool MatWriter::assemble(std::uint64_t digest) {
  file_.begin_again();
  std::vector<std::string> names;
  for (const study::Column& c : columns_) names.push_back(c.name);
  const bool is_5 = version_ == MatVersion::v5;
  if (is_5) {
    file_.write(mat5_begin());
    for (const auto& [name, fields] : structs(digest)) file_.write(mat5_texts(name, fields));
  } else {
    file_.write(mat73_head(structs(digest), names, spool_.rows()));
  }
  for (std::size_t c = 0; c < columns_.size() && !file_.failed(); ++c) {
    if (is_5) file_.write(mat5_column_head(names[c], spool_.rows()));
    if (!spool_.column(c, [this](std::span<const double> numbers) {
          file_.write(bytes_of(numbers));
          return !file_.failed();
        }))
      return false;
  }
  return !file_.failed();
}

base::Problems MatWriter::commit(std::uint64_t digest) {
  if (failed() || !assemble(digest)) return save_what_fits(digest);
  return file_.commit();
}

base::Problems MatWriter::commit_partial(std::uint64_t digest) {
  if (failed() || !assemble(digest)) return save_what_fits(digest);
  return file_.commit_partial();
}

base::Problems MatWriter::save_what_fits(std::uint64_t digest) {
  if (file_.reader_is_gone()) return {};
  const int reason = error_ != 0 ? error_ : file_.error() != 0 ? file_.error() : spool_.error();
  base::Problem problem = unwritable(file_.path(), reason);
  if (too_long_) {
    problem.limit = fmt::format("has {} rows, but a column of MAT 5 has at most 2 GiB", spool_.rows());
    problem.cure = "use --mat73, or record fewer rows";
  }
  if (!assemble(digest) || !file_.commit_partial().empty()) return {problem};
  problem.cure = too_long_
                     ? fmt::format("{}; the finished part is in {}", problem.cure, partial_name(file_.path()))
                     : saved_instead(file_.path());
  return {problem};
}

}  // namespace files
