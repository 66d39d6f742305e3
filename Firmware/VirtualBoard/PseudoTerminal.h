// SPDX-License-Identifier: MIT
// Pseudo-terminal that other programs open as a serial port.
#pragma once
#include <cstdint>
#include <fcntl.h>
#include <span>
#include <stdexcept>
#include <string>
#include <termios.h>
#include <unistd.h>
#include <vector>

namespace physvib::virtualboard {

class PseudoTerminal {
public:
    /// Throws std::runtime_error if the system provides none.
    PseudoTerminal()
        : master_{posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)} {
        if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0)
            throw std::runtime_error("no pseudo-terminal");
        path_ = ptsname(master_);
        slave_ = open(path_.c_str(), O_RDWR | O_NOCTTY); // kept open: programs open and close the port
        termios raw{};
        tcgetattr(slave_, &raw);
        cfmakeraw(&raw);
        tcsetattr(slave_, TCSANOW, &raw);
    }
    ~PseudoTerminal() {
        close(slave_);
        close(master_);
    }
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;

    const std::string& path() const { return path_; }

    std::vector<std::uint8_t> read() {
        std::vector<std::uint8_t> bytes(4096);
        const auto n = ::read(master_, bytes.data(), bytes.size());
        bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
        return bytes;
    }

    /// Bytes that no program reads are lost, as on a serial line.
    void write(std::span<const std::uint8_t> bytes) {
        if (::write(master_, bytes.data(), bytes.size()) < 0) return;
    }

private:
    int master_ = -1, slave_ = -1;
    std::string path_;
};

} // namespace physvib::virtualboard
