// SPDX-License-Identifier: Apache-2.0
// Keeps the reason why the drive was stopped before the last reset.
#pragma once
#include "faces/firmware/example/fault_reason.hpp"

namespace firmware {

extern KeptReason kept_reason;  // in memory that begin() does not clear

}  // namespace firmware
