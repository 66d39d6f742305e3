// SPDX-License-Identifier: MIT
// Pseudo-terminals on POSIX: open, poll, termios.
#if !defined(_WIN32)
#include "Live/Session/PseudoTerminal.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace physvib {
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
    std::error_code none;
    return std::filesystem::weakly_canonical(path, none).string().starts_with("/dev/pts/");
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

} // namespace physvib
#endif
