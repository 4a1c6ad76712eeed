// SPDX-License-Identifier: Apache-2.0
// What open-circuit voltages say, for a terminal, for programs and for files.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/frame_check.hpp"
#include "text/rooms.hpp"

namespace text {

/// A measured motor, and the sheet that it is held against.
struct MeasuredEmf {
  std::string name;  ///< of the recording
  const analysis::EmfResult& result;
  std::string sheet{};  ///< the motor's name; empty: held against none
  std::vector<analysis::FrameCheck> checks{};
  double tolerance = analysis::usual_emf_tolerance;
};

std::string emf_text(const MeasuredEmf& measured);
std::string emf_json(const MeasuredEmf& measured);

/// The lines of a motor's file that the recording gives: the shape in the plainest words that hold it, and the constant.
/// `shape_file` is named in them where the shape needs a table.
std::string emf_motor_lines(const MeasuredEmf& measured, const std::string& shape_file);

/// Rows of angle and value over an electrical turn, as back_emf_file reads them.
std::string emf_shape_csv(const MeasuredEmf& measured);

/// Half a wave like the other, upside down, and each like its mirror: what harmonic_sizes can say, or a sine.
enum class ShapeWords { sine, harmonics, table };
ShapeWords shape_words(const analysis::EmfResult& result);

}  // namespace text
