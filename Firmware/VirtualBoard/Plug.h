// SPDX-License-Identifier: MIT
// Connects and disconnects the virtual board's serial port, like pulling a USB cable.
#pragma once
#include "PseudoTerminal.h"
#include <filesystem>
#include <optional>

namespace physvib::virtualboard {

class Plug {
public:
    /// Connects. `link`: a symbolic link that stays the same between connections, or empty. Throws what
    /// PseudoTerminal and std::filesystem throw.
    explicit Plug(std::string link)
        : link_{std::move(link)} {
        move();
    }
    ~Plug() {
        if (line_) pull();
    }
    Plug(const Plug&) = delete;
    Plug& operator=(const Plug&) = delete;

    /// Disconnects if connected, and vice versa; returns whether it is connected now.
    bool move() {
        if (line_)
            pull();
        else
            putIn();
        return line_.has_value();
    }

    /// Path of the port.
    const std::string& path() const { return link_.empty() ? line_->path() : link_; }

    std::vector<std::uint8_t> read() { return line_ ? line_->read() : std::vector<std::uint8_t>{}; }
    void write(std::span<const std::uint8_t> bytes) {
        if (line_) line_->write(bytes);
    }

private:
    void putIn() {
        line_.emplace();
        if (link_.empty()) return;
        std::filesystem::remove(link_);
        std::filesystem::create_symlink(line_->path(), link_);
    }
    void pull() {
        if (!link_.empty()) std::filesystem::remove(link_);
        line_.reset();
    }

    std::string link_;
    std::optional<PseudoTerminal> line_;
};

} // namespace physvib::virtualboard
