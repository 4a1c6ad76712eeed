// SPDX-License-Identifier: Apache-2.0
// Which temporary files are there now, for whoever has to end the program in the middle of whatever it does.
#pragma once

namespace files {

/// A file that is to be removed where the program ends before forget_temporary(). The name stays where it is until then. Of more
/// than 512 at once the rest stays behind.
void note_temporary(const char* name);
void forget_temporary(const char* name);

/// Of all that are noted. May be called in a signal handler.
void remove_temporary_files();

}  // namespace files
