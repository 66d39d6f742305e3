// SPDX-License-Identifier: MIT
// Threads, pseudo-terminals and libraries on POSIX systems.
#if !defined(_WIN32)
#include "Live/Session/BoardLink.h"
#include "Live/Session/System.h"
#include <cerrno>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

namespace physvib {

void raiseThreadPriority(bool isAudio) noexcept {
    // half of the range, as other programs that play sound: below the threads of audio servers
    const int lowest = sched_get_priority_min(SCHED_RR), highest = sched_get_priority_max(SCHED_RR);
    sched_param parameters{};
    parameters.sched_priority = (lowest + highest) / 2 - (isAudio ? 0 : 1);
    pthread_setschedparam(pthread_self(), SCHED_RR, &parameters); // fails without the privilege
}

bool needsOneThreadPerDriver() noexcept { return false; }

double threadCpuSeconds() noexcept {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int currentProcessId() noexcept { return getpid(); }

namespace {

class TerminalLine final : public SerialLine {
public:
    explicit TerminalLine(int file)
        : file_{file} {}
    ~TerminalLine() override { close(file_); }
    int read(std::span<std::uint8_t> bytes, int milliseconds) override {
        pollfd wait{file_, POLLIN, 0};
        if (poll(&wait, 1, milliseconds) <= 0) return 0;
        const auto n = ::read(file_, bytes.data(), bytes.size());
        if (n < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
        return n > 0 ? static_cast<int>(n) : -1;
    }
    bool write(std::span<const std::uint8_t> bytes) override {
        return ::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
    }

private:
    int file_;
};

} // namespace

bool isPseudoTerminal(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(path, ignored).string().starts_with("/dev/pts/");
}

std::unique_ptr<SerialLine> openPseudoTerminal(const std::string& path, std::string& error) {
    const int file = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    termios raw{};
    if (file < 0 || tcgetattr(file, &raw) != 0) {
        error = path + ": " + std::strerror(errno);
        if (file >= 0) close(file);
        return nullptr;
    }
    cfmakeraw(&raw);
    tcsetattr(file, TCSANOW, &raw);
    return std::make_unique<TerminalLine>(file);
}

void* openLibrary(const char* name) { return dlopen(name, RTLD_NOW | RTLD_LOCAL); }
void* findFunction(void* library, const char* name) { return dlsym(library, name); }

} // namespace physvib
#endif
