// SPDX-License-Identifier: MIT
// Functions of the operating system that sessions need: priority and processor time of threads, the process
// id, and libraries that are loaded at run time.
#pragma once

namespace physvib {

/// Real-time priority for the calling thread, where the system permits; otherwise nothing changes. A thread
/// of audio comes before one that steps a world.
void raiseThreadPriority(bool isAudio) noexcept;

/// Processor time of the calling thread since it began, s: without waiting and other programs. Any thread but
/// the render thread (R).
double threadCpuSeconds() noexcept;

/// Whether all calls of an audio driver must come from the thread that created it.
bool needsOneThreadPerDriver() noexcept;

/// Id of this process. It differs in a forked child, in which no other thread runs.
int currentProcessId() noexcept;

// Loads libraries of the system at run time: a program starts without them, and runs where they are missing.

/// Opens a library by name; finds a function in a library. Null if it does not exist. Any thread.
void* openLibrary(const char* name);
void* findFunction(void* library, const char* name);

} // namespace physvib
