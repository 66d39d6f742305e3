// SPDX-License-Identifier: GPL-3.0-or-later
// Orderly and timely end of playback on Ctrl-C, `kill` or a closed terminal.
#pragma once
#include <atomic>

namespace physvib {

inline std::atomic<bool> interrupted{false}; // read in every block by the device callback, so that output
                                             // becomes silent before anything else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// Installs handlers after which these signals only set `interrupted`. A second signal, or 0.8 s without an
/// end after the first, terminates the program as that signal does. Recorded files do not depend on this,
/// since they are complete at any moment. A closed reader of standard output does not end the program,
/// because the end of playback must still be reported. Message thread.
void heedInterrupts();

} // namespace physvib
