// SPDX-License-Identifier: Apache-2.0
// Makes a motor file of another program's parameter file: VESC mcconf XML, ODrive JSON, moteus configuration,
// SimpleFOC sketch, struct of MATLAB's Motor Control Blockset.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// Returns the motor file's text. Each value has the other program's key as its source, and its frame. A
/// value that the file lacks is `nan`, which the reader of motor files refuses. The meaning of some values is
/// not certain. `answers` are texts such as "resistance=phase" that state it.
/// Problems:
/// - the file is unknown or damaged;
/// - a number is outside its key's range;
/// - an answer is missing; the cure begins with "answer " and lists the possible answers;
/// - an answer belongs to no question of the file.
base::Result<std::string> motor_of_foreign_file(const std::string& file, std::string_view text,
                                                const std::string& name,
                                                const std::vector<std::string>& answers = {});

}  // namespace text
