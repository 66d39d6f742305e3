// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded into a program: its Nth call of PHYSVIB_FAILS ("fsync 2", "rename 1", "write 3") fails as on a
// disk that fails, and the file PHYSVIB_FAILED says that it did. Calls that write to the terminal's pipes and
// to folders are not counted.
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::atomic<int> calls;

bool fails(const char* name) {
    const char* const wanted = std::getenv("PHYSVIB_FAILS");
    const std::size_t length = std::strlen(name);
    if (wanted == nullptr || std::strncmp(wanted, name, length) != 0 || wanted[length] != ' ') return false;
    if (++calls != std::atoi(wanted + length + 1)) return false;
    const int mark = static_cast<int>(
        syscall(SYS_openat, AT_FDCWD, std::getenv("PHYSVIB_FAILED"), O_CREAT | O_WRONLY, 0600));
    if (mark >= 0) close(mark);
    return true;
}

bool isFile(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && descriptor > 2;
}

int failWith(int error) { return errno = error, -1; }

} // namespace

extern "C" {
int fsync(int descriptor) {
    return isFile(descriptor) && fails("fsync") ? failWith(EIO)
                                                : static_cast<int>(syscall(SYS_fsync, descriptor));
}
int rename(const char* from, const char* to) {
    return fails("rename") ? failWith(EIO)
                           : static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
ssize_t write(int descriptor, const void* bytes, std::size_t count) {
    return isFile(descriptor) && fails("write") ? failWith(ENOSPC)
                                                : syscall(SYS_write, descriptor, bytes, count);
}
ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t at) {
    return isFile(descriptor) && fails("write") ? failWith(ENOSPC)
                                                : syscall(SYS_pwrite64, descriptor, bytes, count, at);
}
ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off64_t at) {
    return pwrite(descriptor, bytes, count, at);
}
}
