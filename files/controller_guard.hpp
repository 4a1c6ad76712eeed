// SPDX-License-Identifier: Apache-2.0
// Between the program and a controller of one's own: the same interface on both sides. Around each call the controller's bytes lie
// between pages that nobody may touch, what it leaves of the processor's way to round is put back, and the thread is known to be
// inside of it (controller_watch.hpp).
#pragma once
#include <functional>
#include <string>

#include "files/controller_watch.hpp"
#include "files/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/control/own/own_controller.h"

namespace files {

/// `work` in the code of `path`, as it is loaded.
void in_controller(const std::string& path, const std::function<void()>& work);

/// The controller as the program may call it; the same one for the same `real`. Called in_controller(): it reads what `real` points
/// at. A Problem where there are too many.
base::Result<const sixstep_controller*> guarded_controller(const std::string& path,
                                                           const sixstep_controller& real);

}  // namespace files
