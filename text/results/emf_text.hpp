// SPDX-License-Identifier: Apache-2.0
// Prints the analysis of open-circuit voltages: for a terminal, as JSON and as files.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/frame_check.hpp"
#include "text/rooms.hpp"

namespace text {

/// A measured motor, and the sheet with which it is compared.
struct MeasuredEmf {
  std::string name;  ///< name of the recording
  const analysis::EmfResult& result;
  std::string sheet{};  ///< name of the motor whose sheet is compared; empty: no comparison
  std::vector<analysis::FrameCheck> checks{};
  double tolerance = analysis::usual_emf_tolerance;
};

std::string emf_text(const MeasuredEmf& measured);
std::string emf_json(const MeasuredEmf& measured);

/// The lines of a motor's file that follow from the recording: the shape in its simplest form, and the
/// constant. If the shape needs a table, the lines name `shape_file`.
std::string emf_motor_lines(const MeasuredEmf& measured, const std::string& shape_file);

/// Rows of angle and value over an electrical turn, in the format of back_emf_file.
std::string emf_shape_csv(const MeasuredEmf& measured);

/// The forms in which a shape can be written. harmonics (harmonic_sizes): the negative half wave mirrors the
/// positive half wave, and each half wave is symmetric about its middle. table: any other shape.
enum class ShapeWords { sine, harmonics, table };
ShapeWords shape_words(const analysis::EmfResult& result);

}  // namespace text
