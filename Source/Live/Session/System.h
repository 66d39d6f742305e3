// SPDX-License-Identifier: MIT
// What sessions ask of the system: its rules for threads that drive devices and worlds, and for their
// process; libraries at run time.
#pragma once

namespace physvib {

/// Real-time priority for the calling thread, where the system permits; otherwise nothing changes. A thread
/// of audio comes before one that steps a world.
void raiseThreadPriority(bool isAudio) noexcept;

/// Processor time of the calling thread since it began, s: without waiting and other programs. Any thread but
/// the render thread (R).
double threadSeconds() noexcept;

/// Whether the thread that creates a driver must make all its calls.
bool areDriversBoundToTheirThread() noexcept;

/// Number of the calling thread's process: another one in a forked child, where no other thread is left.
int thisProcess() noexcept;

// Loads libraries of the system at run time: a program starts without them, and runs where they are missing.

/// System calls: opens the library of that name, and finds a function in it; or null. Any thread.
void* openLibrary(const char* name);
void* functionIn(void* library, const char* name);

} // namespace physvib
