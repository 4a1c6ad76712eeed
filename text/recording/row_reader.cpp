// SPDX-License-Identifier: Apache-2.0
#include "text/recording/row_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "text/keys/bounded.hpp"
#include "text/keys/units.hpp"
#include "text/recording/cells.hpp"
#include "text/recording/table_head.hpp"

namespace text {
namespace {

/// Largest number of lines above the rows: oscilloscopes write their settings there.
constexpr std::size_t most_lines_above = 100;
/// Largest number of values: 160 MB, more than the memory of any oscilloscope that a bench needs.
constexpr std::size_t most_values = 20'000'000;
/// Largest number of wrong cells per column that are quoted.
constexpr std::size_t most_quoted = 6;

bool is_remark(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos || line[first] == '#' || line[first] == '%';
}

/// Whether a cell such as "001" is the part after a decimal comma.
bool begins_with_zeros(std::string_view cell) {
  return cell.size() > 1 && cell[0] == '0' &&
         std::all_of(cell.begin(), cell.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::size_t leading_empty(const std::vector<std::string_view>& cells) {
  std::size_t n = 0;
  while (n < cells.size() && cells[n].empty()) ++n;
  return n;
}

base::Problem told(std::string where, std::string limit, std::string cure) {
  return bounded(
      {.where = std::move(where), .value = "", .limit = std::move(limit), .cure = std::move(cure)});
}

}  // namespace

std::optional<RowsBeside> rows_beside(std::string_view text) {
  constexpr int looked_at = 20, enough = 3;
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::optional<RowsBeside> found;
  int rows = 0;
  for (; rows < looked_at && !text.empty(); ++rows) {
    const std::size_t begin = text.rfind('\n') + 1;  // 0 if no line precedes it
    const std::string_view line = text.substr(begin);
    RowsBeside here;
    for (const char c : {';', '\t', ','})
      if (here.separator == 0 && line.starts_with(c)) here.separator = c;
    const std::vector<std::string_view> cells = cells_of_line(line, here.separator);
    here.cells = leading_empty(cells);
    const bool is_row =
        here.separator != 0 && here.cells < cells.size() && number_in(cells[here.cells]).has_value();
    if (!is_row || (found && (found->separator != here.separator || found->cells != here.cells))) break;
    found = here;
    text = text.substr(0, begin > 0 ? begin - 1 : 0);
  }
  return rows >= enough ? found : std::nullopt;
}

RowReader::RowReader(std::string name, std::size_t line, std::optional<RowsBeside> beside)
    : beside_(beside), number_(line) {
  out_.name = std::move(name);
}

bool RowReader::line(std::string_view text) {
  ++number_;
  if (is_remark(text)) {
    remark(text);
    return true;
  }
  if (beside_) return row_beside(text);
  if (separator_ == 0 && !begins_rows(text)) {
    above_.emplace_back(text);
    return above_.size() <= most_lines_above;
  }
  row(cells_of_line(text, separator_));
  return values_ <= most_values;
}

void RowReader::remark(std::string_view text) {
  if (separator_ == 0) {
    if (remarks_.size() < most_lines_above) remarks_.emplace_back(text);
    return;
  }
  constexpr std::size_t longest_remark = 100;
  const std::size_t first = text.find_first_not_of(" \t#%");
  if (first == std::string_view::npos) return;
  const std::string said = bounded(std::string(bare_cell(text.substr(first))), longest_remark);
  std::vector<Remark>& all = out_.remarks;
  const auto same = std::find_if(all.begin(), all.end(), [&](const Remark& r) { return r.text == said; });
  if (same != all.end())
    ++same->times;
  else if (all.size() < most_remarks)
    all.push_back({said, number_});
}

bool RowReader::begins_rows(std::string_view text) {
  const std::optional<char> separator = separator_of_row(text);
  if (!separator) return false;
  separator_ = *separator;
  begin(cells_of_line(text, separator_).size());
  return true;
}

/// Keeps the cells next to the first rows as lines above the rows.
bool RowReader::row_beside(std::string_view text) {
  std::vector<std::string_view> cells = cells_of_line(text, beside_->separator);
  const bool is_row = beside_->cells < cells.size() && number_in(cells[beside_->cells]).has_value();
  const bool has_more = !cells.empty() && !cells[0].empty();
  if (has_more || !is_row) {
    above_.emplace_back(text);
    if (above_.size() > most_lines_above) return false;
  }
  if (!is_row || (has_more && beside_->cells == 1)) {  // a line above the rows
    out_.columns.clear();
    marks_ = {};
    out_.lines.clear();
    separator_ = 0;
    wide_line_ = 0;
    return true;
  }
  cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(beside_->cells));
  if (separator_ == 0) {
    separator_ = beside_->separator;
    first_cells_ = cells.size();
    first_line_ = number_;
    out_.columns.resize(cells.size());  // names follow when all cells next to the rows are read
    tens_.assign(cells.size(), 0);
  }
  row(cells);
  return values_ <= most_values;
}

void RowReader::begin(std::size_t cells) {
  names_ = take_head({above_, remarks_, separator_}, cells, out_);
  first_cells_ = cells;
  first_line_ = number_;
  for (const RecordedColumn& column : out_.columns)
    tens_.push_back(column.unit.empty() ? 0 : unit_of(column.unit)->ten);
}

void RowReader::row(const std::vector<std::string_view>& cells) {
  if (cells.size() > out_.columns.size() && wide_line_ == 0) {
    wide_line_ = number_;
    wide_cells_ = cells.size();
  }
  const std::size_t rows = out_.rows();
  if (out_.lines.empty() || out_.line_of(rows) != number_) out_.lines.emplace_back(rows, number_);
  for (std::size_t n = 0; n < out_.columns.size(); ++n) {
    RecordedColumn& column = out_.columns[n];
    const std::string_view cell = n < cells.size() ? cells[n] : std::string_view();
    const std::optional<double> x = number_in(cell, tens_[n]);
    if (!x) {
      if (column.bad.size() < most_quoted) column.bad.push_back({number_, std::string(cell.substr(0, 200))});
      ++column.bad_cells;
    } else {
      marks_.see(number_, n, cell);
    }
    column.filled |= !cell.empty();
    column.values.push_back(x.value_or(std::numeric_limits<double>::quiet_NaN()));
    ++values_;
    if (separator_ == ',') {
      has_point_ |= cell.find('.') != std::string_view::npos;
      has_leading_zero_ |= begins_with_zeros(cell);
    }
  }
}

/// A row with more cells than columns is a problem, because the meaning of the further cells is unknown.
std::optional<base::Problem> RowReader::wrong_cells() const {
  const bool more_than_names = names_ > 0 && first_cells_ > names_;
  if (separator_ == ',' && !has_point_ && (more_than_names || (names_ == 0 && has_leading_zero_)))
    return told(
        fmt::format("{}:{}:", out_.name, first_line_),
        more_than_names
            ? fmt::format(
                  "has {} cells below {} headings, because commas are both decimal marks and separators",
                  first_cells_, names_)
            : "has cells like \"001\", because commas are both decimal marks and separators",
        "export the file with semicolons or tabs between cells, or with decimal points");
  if (wide_line_ == 0) return {};
  return told(fmt::format("{}:{}:", out_.name, wide_line_),
              fmt::format("has {} cells, but the table has {} columns", wide_cells_, out_.columns.size()),
              "correct that line, or give each column a heading");
}

base::Result<Recording> RowReader::result() {
  if (values_ > most_values)
    return told(fmt::format("{}:{}:", out_.name, number_),
                fmt::format("has more than {} million values", most_values / 1'000'000),
                "shorten the recording, remove columns, or keep every tenth row");
  if (out_.columns.empty() || out_.rows() == 0)
    return told(number_ > 1 ? out_.name + ":" : fmt::format("{}:{}:", out_.name, number_),
                "contains no row of numbers",
                "export the recording as text: headings, then rows of numbers separated by commas");
  if (beside_) {
    Recording head;
    take_head({above_, remarks_, separator_, beside_->cells}, out_.columns.size(), head);
    out_.clock = head.clock;
    out_.has_headings = head.has_headings;
    for (std::size_t n = 0; n < out_.columns.size(); ++n) {
      RecordedColumn &column = out_.columns[n], &named = head.columns[n];
      named.values = std::move(column.values);
      named.bad = std::move(column.bad);
      named.bad_cells = column.bad_cells;
      named.filled = column.filled;
      const int ten = named.unit.empty() ? 0 : unit_of(named.unit)->ten;
      for (double& x : named.values) x = ten < 0 ? x / std::pow(10.0, -ten) : x * std::pow(10.0, ten);
      column = std::move(named);
    }
  }
  if (std::optional<base::Problem> wrong = wrong_cells()) return *wrong;
  if (std::optional<base::Problem> doubt = marks_.doubt(out_.name, separator_)) return *doubt;
  return std::move(out_);
}

}  // namespace text
