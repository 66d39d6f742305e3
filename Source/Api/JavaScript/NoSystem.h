// SPDX-License-Identifier: MIT
// Included before all else: what a C++ library without threads and files lacks. An instance has one thread,
// so nobody is ever waited for; what would ask for a file is compiled, and linked away.
#pragma once
#include <filesystem>
#include <mutex>

namespace std { // NOLINT(cert-dcl58-cpp): this library declares none of these

struct mutex {
    void lock() noexcept {}
    void unlock() noexcept {}
};

namespace this_thread {
inline void yield() noexcept { __builtin_trap(); } // a wait that could never end
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
