// SPDX-License-Identifier: Apache-2.0
// Rows in, columns out, with memory for one block of rows: the rest waits in a file without a name beside the
// one that will be written.
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

  /// Beside `path`, as the disk that takes the one must take the other; empty: among the temporary files.
  ColumnSpool(const std::string& path, std::size_t columns);

  /// True once a row did not fit on the disk: it and all that follow are lost, those before are not.
  void row(std::span<const double> numbers);
  bool failed() const { return error_ != 0; }
  /// What errno says; 0 where all went well.
  int error() const { return error_; }

  std::size_t rows() const { return blocks_ * block_rows + held_; }
  std::size_t columns() const { return columns_; }

  /// The column's numbers in order, in pieces; false where `take` or the disk refuses.
  bool column(std::size_t which, const std::function<bool(std::span<const double>)>& take);

 private:
  struct Close {
    void operator()(int* descriptor) const;
  };
  void spill();

  std::size_t columns_;
  std::unique_ptr<int, Close> descriptor_;
  std::vector<double> block_;  // column after column, block_rows each
  std::size_t held_ = 0, blocks_ = 0;
  int error_ = 0;
};

}  // namespace files
