// SPDX-License-Identifier: MIT
// Threads, pseudo-terminals and libraries on Windows.
#if defined(_WIN32)
#include "Live/Session/BoardLink.h"
#include "Live/Session/System.h"

#include "Io/Disk/SystemWindows.h" // last, because of its macros

namespace physvib {

void raiseThreadPriority(bool isAudio) noexcept {
    SetThreadPriority(GetCurrentThread(), isAudio ? THREAD_PRIORITY_TIME_CRITICAL : THREAD_PRIORITY_HIGHEST);
}

// drivers need the COM apartment of the thread that created them
bool needsOneThreadPerDriver() noexcept { return true; }

double threadCpuSeconds() noexcept {
    const auto toSeconds = [](const FILETIME& time) {
        return 1e-7 * (4294967296.0 * time.dwHighDateTime + time.dwLowDateTime);
    };
    FILETIME creationTime{}, exitTime{}, kernelTime{}, userTime{};
    GetThreadTimes(GetCurrentThread(), &creationTime, &exitTime, &kernelTime, &userTime);
    return toSeconds(kernelTime) + toSeconds(userTime);
}

int currentProcessId() noexcept { return static_cast<int>(GetCurrentProcessId()); }

// There are no pseudo-terminals that a program can open by name: all lines are serial ports.

bool isPseudoTerminal(const std::string&) { return false; }

std::unique_ptr<SerialLine> openPseudoTerminal(const std::string& path, std::string& error) {
    error = path + ": expected a serial port";
    return nullptr;
}

void* openLibrary(const char* name) { return reinterpret_cast<void*>(LoadLibraryA(name)); }
void* findFunction(void* library, const char* name) {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

} // namespace physvib
#endif
