// SPDX-License-Identifier: MIT
// Serial port at the board's speed, by libserialport, or a pseudo-terminal, which that library does not open.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// A serial port of the system.
struct SerialPortName {
    std::string path, description;
    bool isLikelyBoard = false; ///< its USB vendor is that of an ST-Link
};

/// Message thread (M) or link thread.
std::vector<SerialPortName> listSerialPorts();

/// One thread at a time.
class SerialLine {
public:
    virtual ~SerialLine() = default;

    /// Waits up to `milliseconds` for bytes. Returns the number received, at most bytes.size(); -1 if the
    /// line is gone.
    virtual int read(std::span<std::uint8_t> bytes, int milliseconds) = 0;

    /// False if the line is gone or does not accept the bytes.
    virtual bool write(std::span<const std::uint8_t> bytes) = 0;
};

/// The opened line, or nullptr with a one-line reason in `error`.
std::unique_ptr<SerialLine> openSerialLine(const std::string& path, std::string& error);

} // namespace physvib
