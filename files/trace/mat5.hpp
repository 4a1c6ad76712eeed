// SPDX-License-Identifier: Apache-2.0
// Variables of MAT version 5 as bytes, one after the other behind mat5_begin(): "MAT-File Format" of MathWorks.
#pragma once
#include <span>
#include <string>

#include "files/trace/mat_text.hpp"

namespace files {

std::string mat5_begin();
/// Columns one after the other, as MATLAB has them.
std::string mat5_numbers(const std::string& name, std::span<const double> values, std::size_t rows,
                         std::size_t columns);
std::string mat5_text(const std::string& name, const std::string& words);
std::string mat5_texts(const std::string& name, const MatFields& fields);
/// What stands before the numbers of a column; they follow, and nothing else before the next variable.
std::string mat5_column_head(const std::string& name, std::size_t rows);

}  // namespace files
