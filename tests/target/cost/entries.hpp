// SPDX-License-Identifier: Apache-2.0
// The two entries of a drive, as in firmware. The configuration is a compile-time constant, and state and
// inputs are in static memory. TARGET_DRIVE is the name of the exported header and of its namespace.
#pragma once
#include "tests/target/cost/record.hpp"
#include "tests/target/walk/names.hpp"

#define TARGET_TEXT_OF(x) #x
#define TARGET_TEXT(x) TARGET_TEXT_OF(x)
#define TARGET_HEADER_OF(x) TARGET_TEXT(x.hpp)
#include TARGET_HEADER_OF(TARGET_DRIVE)

namespace target {

using Scalar = TARGET_SCALAR;
namespace exported = ::TARGET_DRIVE;

#if TARGET_FIELD
using Answer = LegCommands<Scalar>;
#else
using Answer = BridgeCommand<Scalar>;
#endif
extern const Answer* answer;  ///< the last entry's command to the bridge

#if TARGET_PRODUCT
using Record = ProductRecord<Scalar>;
#elif TARGET_FIELD
using Record = FieldRecord<Scalar>;
#else
using Record = LeanRecord<Scalar>;
#endif

void give(const Record& record);  ///< writes the inputs of the next entry

}  // namespace target

extern "C" {
void entry_tick();
void entry_hall();
}
