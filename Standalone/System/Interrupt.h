// SPDX-License-Identifier: GPL-3.0-or-later
// The user's wish to stop, from Ctrl-C, `kill` or a terminal that is closed: what plays ends in order, and in
// time.
#pragma once
#include <atomic>

namespace physvib {

inline std::atomic<bool> interrupted{
    false}; // what plays on a device reads it in every block: silence comes before all else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// From now on these signals set `interrupted` and end nothing by themselves. A program that has not ended
/// 0.8 s after the first is ended as by that signal: something in it hangs (FilesFirst says when it may last
/// longer). So is one that gets a second. A reader of standard output that goes away ends nothing either:
/// what was recorded is still to be put in its place. M.
void heedInterrupts();

/// Files that are promised: while there are any, a program that does not end is given three seconds more. M.
class FilesFirst {
public:
    FilesFirst() noexcept;
    ~FilesFirst();
    FilesFirst(const FilesFirst&) = delete;
    FilesFirst& operator=(const FilesFirst&) = delete;

    /// They are being put in their places, which takes as long as the disk takes.
    void finish() noexcept;

private:
    bool isFinishing_ = false;
};

} // namespace physvib
