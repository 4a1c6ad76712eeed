// SPDX-License-Identifier: Apache-2.0
// Writes variables of MAT version 5 as bytes, according to "MAT-File Format" of MathWorks. The variables
// follow mat5_begin() one after the other.
#pragma once
#include <span>
#include <string>

#include "files/trace/mat_text.hpp"

namespace files {

std::string mat5_begin();
/// A matrix of numbers. `values` are in columns, as in MATLAB.
std::string mat5_numbers(const std::string& name, std::span<const double> values, std::size_t rows,
                         std::size_t columns);
std::string mat5_text(const std::string& name, const std::string& words);
std::string mat5_texts(const std::string& name, const MatFields& fields);
/// The bytes before a column's numbers. After the numbers, the next variable follows.
std::string mat5_column_head(const std::string& name, std::size_t rows);

}  // namespace files
