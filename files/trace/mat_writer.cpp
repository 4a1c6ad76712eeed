// SPDX-License-Identifier: Apache-2.0
#include "files/trace/mat_writer.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>

#include "files/text_file.hpp"
#include "files/trace/mat_file.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace files {
namespace {

// "MAT-File Format" of MathWorks, table 1-1 and "miMATRIX": an element is a tag of type and bytes, then the
// bytes.
enum : std::uint32_t { mi_int8 = 1, mi_int32 = 5, mi_uint32 = 6, mi_double = 9, mi_matrix = 14 };
constexpr std::uint32_t class_double = 6;
constexpr std::size_t header_bytes = 128;

/// What stands before the numbers of one column, in this machine's order of bytes, as the file's header says.
std::string column_head(const std::string& name, std::size_t rows) {
  const std::size_t padded_name = (name.size() + 7) / 8 * 8, data = rows * sizeof(double);
  const auto n32 = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
  const std::size_t all = 16 + 16 + 8 + padded_name + 8 + data;
  std::string text;
  const auto words = [&text](auto... w) {
    for (const std::uint32_t word : {w...}) text.append(reinterpret_cast<const char*>(&word), sizeof word);
  };
  words(+mi_matrix, n32(all));
  words(+mi_uint32, n32(8), class_double, n32(0));
  words(+mi_int32, n32(8), n32(rows), n32(1));
  words(+mi_int8, n32(name.size()));
  text += name;
  text.append(padded_name - name.size(), '\0');
  words(+mi_double, n32(data));
  return text;
}

std::string_view bytes_of(std::span<const double> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

base::Problem told_of(const std::string& path, base::Problem problem) {
  problem.where = path + ":";
  return problem;
}

}  // namespace

base::Result<MatWriter> MatWriter::create(const Destination& to, std::span<const study::Column> columns,
                                          MatVersion version, TraceOrigin origin,
                                          std::size_t most_rows_of_v5) {
  if (!matio()) return told_of(to.path, matio().problems().front());
  base::Result<AtomicFile> file = AtomicFile::create(to);
  if (!file) return file.problems();
  if (version == MatVersion::v7_3 && file->temporary().empty())
    return base::Problem{.where = to.path + ":",
                         .limit = "is no regular file, and HDF5 writes to and fro",
                         .cure = "name a file, or take --mat, which writes straight on"};
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

/// Room for the file itself before a block of rows is kept: a disk that fills up stops the run while all that
/// it has kept still fits.
void MatWriter::reserve() {
  constexpr std::size_t per_column = 4096;  // heads, units and meanings; in HDF5 also its tables
  const std::size_t rows = spool_.rows() + ColumnSpool::block_rows;
  too_long_ = version_ == MatVersion::v5 && rows > most_rows_;
  if (!too_long_)
    error_ = file_.reserve(header_bytes + columns_.size() * (per_column + rows * sizeof(double)));
}

void MatWriter::describe_trace(MatFile& mat, std::uint64_t digest) const {
  mat.texts("sixstep", {{"version", SIXSTEP_VERSION},
                        {"title", origin_.title},
                        {"motor", origin_.motor},
                        {"scenario", origin_.scenario},
                        {"scenario_digest", base::written_hex(origin_.digest)},
                        {"digest", base::written_hex(digest)},
                        {"command", origin_.command}});
  std::vector<std::pair<std::string, std::string>> units, meanings;
  for (const study::Column& c : columns_) {
    units.emplace_back(c.name, c.unit);
    meanings.emplace_back(c.name, c.frame.empty() ? c.meaning : c.meaning + "; " + c.frame);
  }
  mat.texts("units", units);
  mat.texts("meanings", meanings);
}

/// libmatio cannot append to a column of version 5: it writes what is small, the columns follow it.
bool MatWriter::assemble_v5(std::uint64_t digest) {
  const Scratch scratch;
  MatFile mat(*matio(), scratch.path(), version_);
  describe_trace(mat, digest);
  base::Result<std::string> small = mat.close() ? read_text(scratch.path()) : base::Problem{};
  if (!small) return false;
  file_.write(*small);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    file_.write(column_head(columns_[c].name, spool_.rows()));
    if (!spool_.column(c, [this](std::span<const double> numbers) {
          file_.write(bytes_of(numbers));
          return !file_.failed();
        }))
      return false;
  }
  return true;
}

bool MatWriter::assemble_v7_3(std::uint64_t digest) {
  MatFile mat(*matio(), file_.temporary(), version_);
  describe_trace(mat, digest);
  bool read = true;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (spool_.rows() == 0) mat.numbers(columns_[c].name, {}, 0, 1);
    read = read && spool_.column(c, [&](std::span<const double> numbers) {
      mat.append(columns_[c].name, numbers);
      return true;
    });
  }
  file_.written_elsewhere();
  return mat.close() && read;
}

bool MatWriter::assemble(std::uint64_t digest) {
  return version_ == MatVersion::v5 ? assemble_v5(digest) : assemble_v7_3(digest);
}

base::Problems MatWriter::commit(std::uint64_t digest) {
  if (failed()) return save_what_fits(digest);
  return assemble(digest) ? file_.commit() : base::Problems{unwritable(file_.path(), ENOSPC)};
}

base::Problems MatWriter::commit_partial(std::uint64_t digest) {
  if (failed()) return save_what_fits(digest);
  return assemble(digest) ? file_.commit_partial() : base::Problems{unwritable(file_.path(), ENOSPC)};
}

base::Problems MatWriter::save_what_fits(std::uint64_t digest) {
  base::Problem problem = unwritable(file_.path(), error_ != 0 ? error_ : spool_.error());
  if (too_long_) {
    problem.limit = fmt::format("has {} rows, and a column of MAT 5 ends at 2 GiB", spool_.rows());
    problem.cure = "take --mat73, or record less";
  }
  if (!assemble(digest) || !file_.commit_partial().empty()) return {problem};
  problem.cure = too_long_
                     ? fmt::format("{}; what was finished is in {}", problem.cure, partial_name(file_.path()))
                     : saved_instead(file_.path());
  return {problem};
}

}  // namespace files
