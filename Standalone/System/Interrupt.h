// SPDX-License-Identifier: GPL-3.0-or-later
// The user's wish to stop, from Ctrl-C, `kill` or a terminal that is closed: what plays ends in order, and in
// time.
#pragma once
#include <atomic>

namespace physvib {

inline std::atomic<bool> interrupted{false}; // what plays on a device reads it in every block: silence comes
                                             // before all else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// From now on these signals set `interrupted` and end nothing by themselves. A program that has not ended
/// 0.8 s after the first is ended as by that signal: something in it hangs. So is one that gets a second. No
/// file waits for that: what is recorded or kept while it plays is whole at any moment. A reader of standard
/// output that goes away ends nothing either: the end of what plays is still to be told. M.
void heedInterrupts();

} // namespace physvib
