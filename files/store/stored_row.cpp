// SPDX-License-Identifier: Apache-2.0
#include "files/store/stored_row.hpp"

#include <bit>
#include <charconv>
#include <limits>
#include <utility>

#include "files/text_file.hpp"
#include "sixstep/base/hash.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/decimal_number.hpp"

namespace files {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t fixed_cells = 6;

/// The cell of a number. SQLite cannot store NaN, which becomes null, or the sign of zero, which is dropped.
Cell number_cell(double x) { return x == x ? Cell(x + 0.0) : Cell(); }

/// The cell of a value: a number as a number, a word without its quotes.
Cell value_cell(const std::string& written) {
  if (const std::optional<double> x = text::number_alone(written)) return number_cell(*x);
  return text::visible(analysis::bare(written));
}

/// The remarks, one per line. A line end inside a remark is made visible.
std::string remarks_cell(const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += text::visible(remark) + "\n";
  return text;
}
std::vector<std::string> remarks_of(std::string_view cell) {
  std::vector<std::string> remarks;
  for (std::size_t end = cell.find('\n'); end != cell.npos; end = cell.find('\n')) {
    remarks.emplace_back(cell.substr(0, end));
    cell.remove_prefix(end + 1);
  }
  return remarks;
}

/// Reads cells one after the other. After a cell of an unexpected kind, reads no further cells.
class CellReader {
 public:
  explicit CellReader(const std::vector<Cell>& cells) : cells_(cells) {}

  template <class T>
  T take() {
    const T* value = at_ < cells_.size() ? std::get_if<T>(&cells_[at_++]) : nullptr;
    failed_ = failed_ || value == nullptr;
    return value ? *value : T{};
  }
  double number() {
    if (at_ < cells_.size() && std::holds_alternative<std::monostate>(cells_[at_])) return ++at_, none;
    return take<double>();
  }
  std::string written() {
    if (at_ < cells_.size() && std::holds_alternative<double>(cells_[at_]))
      return base::written(take<double>());
    return take<std::string>();
  }
  bool all_read() const { return !failed_ && at_ == cells_.size(); }

 private:
  const std::vector<Cell>& cells_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

std::optional<std::uint64_t> from_hex(const std::string& text) {
  std::uint64_t bits = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), bits, 16);
  if (read.ec != std::errc() || base::written_hex(bits) != text) return {};
  return bits;
}

std::optional<analysis::RunEnd> end_of(const std::string& word) {
  for (const auto& choice : analysis::run_ends)
    if (choice.word == word) return choice.value;
  return {};
}

base::Problem not_as_written() {
  return {
      .where = {}, .value = {}, .limit = "contains a row that does not fit this store's columns", .cure = {}};
}

}  // namespace

std::uint64_t checksum_of(const std::vector<Cell>& cells, std::uint64_t before) {
  base::Hash hash;
  hash.word(before);
  for (const Cell& cell : cells) {
    hash.word(cell.index());
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) hash.word(static_cast<std::uint64_t>(*whole));
    if (const auto* number = std::get_if<double>(&cell)) hash.number(*number);
    if (const auto* text = std::get_if<std::string>(&cell)) hash.word(text_digest(*text));
  }
  return hash.value();
}

std::vector<Cell> cells_of(const analysis::RunRecord& record) {
  std::vector<Cell> cells{static_cast<std::int64_t>(record->number),
                          std::string(base::word(analysis::run_ends, record->end)),
                          std::int64_t{analysis::passed(record)},
                          text::visible(record->problem),
                          remarks_cell(record->remarks),
                          base::written_hex(record->digest)};
  cells.reserve(cells_in_row(record.columns()));
  for (const std::string& value : record->point) cells.push_back(value_cell(value));
  for (const double x : record->strayed) cells.push_back(number_cell(x));
  for (const double x : record->figures) cells.push_back(number_cell(x));
  return cells;
}

std::size_t cells_in_row(const analysis::PlanColumns& c) {
  return fixed_cells + c.keys.size() + c.strayed.size() + c.figures.size();
}

base::Result<analysis::RunRecord> record_of_cells(const std::vector<Cell>& cells,
                                                  const analysis::TableColumns& columns) {
  CellReader reader(cells);
  analysis::RunValues values;
  const auto number = reader.take<std::int64_t>();
  const std::optional<analysis::RunEnd> end = end_of(reader.take<std::string>());
  const auto passed = reader.take<std::int64_t>();
  values.problem = reader.take<std::string>();
  values.remarks = remarks_of(reader.take<std::string>());
  const std::optional<std::uint64_t> digest = from_hex(reader.take<std::string>());
  for (std::size_t n = 0; n < columns->keys.size(); ++n) values.point.push_back(reader.written());
  for (std::size_t n = 0; n < columns->strayed.size(); ++n) values.strayed.push_back(reader.number());
  for (std::size_t n = 0; n < columns->figures.size(); ++n) values.figures.push_back(reader.number());
  if (!reader.all_read() || number < 0 || !end || !digest) return not_as_written();
  values.number = static_cast<std::size_t>(number);
  values.end = *end;
  values.digest = *digest;
  base::Result<analysis::RunRecord> record = analysis::RunRecord::of(columns, std::move(values));
  if (record && analysis::passed(*record) != (passed != 0)) return not_as_written();
  return record;
}

}  // namespace files
