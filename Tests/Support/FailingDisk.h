// SPDX-License-Identifier: MIT
// A disk that fails: replaces fsync, rename and pwrite of the test program that includes it, in one file of
// it. The nth call of one kind fails, all others are the system's.
#pragma once
#include "Support/FileTesting.h"
#include "Support/Sanitizers.h"
#include <cerrno>
#include <fcntl.h>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <sys/syscall.h>
#include <unistd.h>

namespace physvib::test {

struct DiskFault {
    std::string_view call; ///< empty: none
    int nth = 1, seen = 0;
    bool hasFailed = false;

    bool fails(std::string_view name) {
        if (call != name || ++seen != nth) return false;
        return hasFailed = true;
    }
};
inline DiskFault disk;
inline std::function<int(int descriptor)> syncWatcher; ///< in the place of fsync, if there is one

/// Files of a folder and what is in them.
inline std::map<std::string, std::string> contentsOf(const std::filesystem::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file()) all[entry.path().filename().string()] = contentOf(entry.path());
    return all;
}

/// Does `act`, which writes into `folder` and returns what went wrong, once for each of its calls with that
/// one failing; `prepare` makes the folder as it is before. Each time something is told, and each file is as
/// it was or as it was to be, unless `isGrowing`: a log, which keeps what it has.
inline void expectToldByEachFault(const std::filesystem::path& folder, const std::function<void()>& prepare,
                                  const std::function<std::string()>& act, bool isGrowing = false) {
    const auto begin = [&] {
        for (const auto& [name, text] : contentsOf(folder)) std::filesystem::remove(folder / name);
        prepare();
    };
    begin();
    const auto before = contentsOf(folder);
    ASSERT_EQ(act(), "");
    const auto whole = contentsOf(folder);
    ASSERT_NE(before, whole);
    int tried = 0;
    for (const std::string_view call : {"write", "fsync", "rename"})
        for (int nth = 1; nth <= 40; ++nth) {
            begin();
            disk = {call, nth};
            const std::string error = act();
            const bool hasFailed = disk.hasFailed;
            disk = {};
            if (!hasFailed) break;
            ++tried;
            EXPECT_NE(error, "") << call << ' ' << nth << " failed, and nothing is told";
            EXPECT_EQ(error.find('\n'), std::string::npos) << error;
            for (const auto& [name, text] : contentsOf(folder)) {
                const bool isOld = before.contains(name) && before.at(name) == text;
                EXPECT_TRUE(isOld || isGrowing || (whole.contains(name) && whole.at(name) == text))
                    << name << " is neither old nor whole where " << call << ' ' << nth << " failed";
            }
        }
    EXPECT_GE(tried, 2);
}

} // namespace physvib::test

// One of them is enough in a program; under sanitizers, which have their own, each program has only one.
#if defined(PHYSVIB_ADDRESS_SANITIZER) || defined(PHYSVIB_THREAD_SANITIZER)
#define PHYSVIB_ONE_OF_THEM
#else
#define PHYSVIB_ONE_OF_THEM __attribute__((weak))
#endif

extern "C" {
inline int failingDisk(int error) { return errno = error, -1; }
PHYSVIB_ONE_OF_THEM int fsync(int descriptor) {
    if (physvib::test::syncWatcher) return physvib::test::syncWatcher(descriptor);
    return physvib::test::disk.fails("fsync") ? failingDisk(EIO)
                                              : static_cast<int>(syscall(SYS_fsync, descriptor));
}
PHYSVIB_ONE_OF_THEM int rename(const char* from, const char* to) noexcept {
    return physvib::test::disk.fails("rename")
               ? failingDisk(EIO)
               : static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
PHYSVIB_ONE_OF_THEM ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t at) {
    return physvib::test::disk.fails("write") ? failingDisk(ENOSPC)
                                              : syscall(SYS_pwrite64, descriptor, bytes, count, at);
}
PHYSVIB_ONE_OF_THEM ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off64_t at) {
    return pwrite(descriptor, bytes, count, at);
}
}
