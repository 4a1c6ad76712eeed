// SPDX-License-Identifier: Apache-2.0
// Wraps a user's controller in the same interface. During each call, the controller's data are between
// protected pages, and the thread is marked as inside the controller (controller_watch.hpp). After the call,
// the floating-point mode is restored.
#pragma once
#include <functional>
#include <string>

#include "files/controller_watch.hpp"
#include "files/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/control/own/own_controller.h"

namespace files {

/// Runs `work`, which loads the controller of the file `path`. A crash in `work` counts as a crash of this
/// controller.
void in_controller(const std::string& path, const std::function<void()>& work);

/// Returns the wrapped controller; the same `real` always has the same wrapper. Call this function within
/// in_controller(), because it reads the data of `real`. Problem: too many controllers.
base::Result<const sixstep_controller*> guarded_controller(const std::string& path,
                                                           const sixstep_controller& real);

}  // namespace files
