// SPDX-License-Identifier: Apache-2.0
// What the build has exported.
#pragma once
#include "current.hpp"
#include "current_q15.hpp"
#include "duty.hpp"
#include "hysteresis.hpp"
#include "hysteresis_q31.hpp"
#include "position.hpp"
#include "position_float.hpp"
#include "position_q14.hpp"
#include "position_q15.hpp"
#include "position_q30.hpp"
#include "position_q31.hpp"
#include "speed.hpp"
#include "speed_float.hpp"
#include "speed_q15.hpp"
#include "speed_stated.hpp"
