// SPDX-License-Identifier: Apache-2.0
// Wraps a user's own controller in the same interface. During each call the controller's data lie between
// protected pages, afterwards the floating-point mode is restored, and the thread is marked as inside the
// controller (controller_watch.hpp).
#pragma once
#include <functional>
#include <string>

#include "files/controller_watch.hpp"
#include "files/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/control/own/own_controller.h"

namespace files {

/// Runs `work` as code of the controller in `path`, for loading it.
void in_controller(const std::string& path, const std::function<void()>& work);

/// The wrapped controller; the same wrapper for the same `real`. Call it in_controller(), because it reads
/// the data of `real`. Problem: too many controllers.
base::Result<const sixstep_controller*> guarded_controller(const std::string& path,
                                                           const sixstep_controller& real);

}  // namespace files
