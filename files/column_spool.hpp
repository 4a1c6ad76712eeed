// SPDX-License-Identifier: Apache-2.0
// Stores rows and returns columns, with only one block of rows in memory. The other rows are in an unnamed
// file in the folder of the final file.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "files/rooms.hpp"

namespace files {

class ColumnSpool {
 public:
  static constexpr std::size_t block_rows = 2048;

  /// The unnamed file is in the folder of `path`, because the same disk must have space for the final file.
  /// If `path` is empty, it is in the folder of temporary files.
  ColumnSpool(const std::string& path, std::size_t columns);

  /// Adds a row. If a row does not fit on the disk, this row and all later rows are lost. Earlier rows are
  /// kept.
  void row(std::span<const double> numbers);
  bool failed() const { return error_ != 0; }
  /// errno of the first failure; 0: no error.
  int error() const { return error_; }

  std::size_t rows() const { return blocks_ * block_rows + held_; }
  std::size_t columns() const { return columns_; }

  /// Passes the column's numbers to `take` in order, in pieces. Returns false if `take` or the disk fails.
  bool column(std::size_t which, const std::function<bool(std::span<const double>)>& take);

 private:
  struct Close {
    void operator()(int* descriptor) const;
  };
  void spill();

  std::size_t columns_;
  std::unique_ptr<int, Close> descriptor_;
  std::vector<double> block_;  // one column after the other, block_rows numbers each
  std::size_t held_ = 0, blocks_ = 0;
  int error_ = 0;
};

}  // namespace files
