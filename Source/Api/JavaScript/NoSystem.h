// SPDX-License-Identifier: MIT
// Included first in the WebAssembly build: replaces what its C++ library lacks, which has no threads and
// files. An instance has one thread, so locks are empty. File functions are only declared; the linker drops
// their callers.
#pragma once
#include <filesystem>
#include <mutex>

namespace std { // this library declares none of these

struct mutex {
    void lock() noexcept {}
    void unlock() noexcept {}
};

namespace this_thread {
inline void yield() noexcept { __builtin_trap(); } // a wait on one thread would never end
} // namespace this_thread

namespace filesystem {
file_status status(const path&, error_code&);
bool exists(file_status);
bool exists(const path&, error_code&);
bool is_regular_file(file_status);
bool is_regular_file(const path&, error_code&);
uintmax_t file_size(const path&, error_code&);
} // namespace filesystem

} // namespace std
