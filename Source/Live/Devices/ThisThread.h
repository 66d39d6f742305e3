// SPDX-License-Identifier: MIT
// The system's rules for threads that drive devices and worlds, and for their process.
#pragma once

namespace physvib {

/// Realtime priority for the calling thread, where the system permits; otherwise nothing changes.
void raiseThreadPriority() noexcept;

/// Whether the thread that creates a driver must make all its calls.
bool areDriversBoundToTheirThread() noexcept;

/// Number of the calling thread's process: another one in a forked child, where no other thread is left.
int thisProcess() noexcept;

} // namespace physvib
