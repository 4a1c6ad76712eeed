// SPDX-License-Identifier: Apache-2.0
// Lists the existing temporary files for code that ends the program at an arbitrary instant.
#pragma once

namespace files {

/// Notes a file that is removed if the program ends before a call of forget_temporary(). The pointer must
/// stay valid until this call. At most 512 files are noted at the same time.
void note_temporary(const char* name);
void forget_temporary(const char* name);

/// Removes all noted files. Safe in a signal handler.
void remove_temporary_files();

}  // namespace files
