// SPDX-License-Identifier: Apache-2.0
// Lists the existing temporary files, for code that must end the program at any moment.
#pragma once

namespace files {

/// Notes a file that is removed if the program ends before forget_temporary(). The pointer must stay valid until
/// then. At most 512 files at the same time are removed.
void note_temporary(const char* name);
void forget_temporary(const char* name);

/// Removes all noted files. Safe in a signal handler.
void remove_temporary_files();

}  // namespace files
