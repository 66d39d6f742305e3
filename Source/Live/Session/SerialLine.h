// SPDX-License-Identifier: MIT
// A serial port at the board's speed, by libserialport; or a pseudo-terminal, which that library does not
// open.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// A port that the system has, and what it says about it.
struct SerialPortName {
    std::string path, description;
    bool isLikelyBoard = false; ///< an ST-Link
};

/// M or L.
std::vector<SerialPortName> listSerialPorts();

/// One thread at a time.
class SerialLine {
public:
    virtual ~SerialLine() = default;

    /// Waits up to `milliseconds` for bytes; as many as came, at most bytes.size(); -1 if the line is gone.
    virtual int read(std::span<std::uint8_t> bytes, int milliseconds) = 0;

    /// False if the line is gone or does not take them.
    virtual bool write(std::span<const std::uint8_t> bytes) = 0;
};

/// The line, or nullptr with one line on why in `error`.
std::unique_ptr<SerialLine> openSerialLine(const std::string& path, std::string& error);

} // namespace physvib
