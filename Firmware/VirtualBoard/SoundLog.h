// SPDX-License-Identifier: MIT
// When a virtual board sounds, as a file that other programs can compare with theirs (SoundLog).
#pragma once
#include "Peripherals.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>

namespace physvib::virtualboard {

/// Logs when the converters leave and reach silence (20 ms), and notes, as a CSV file of `steady_ns,what`.
/// Other programs share the steady clock, so the log can be compared with devices that play beside the board.
class SoundLog {
public:
    /// With an empty path nothing is written. Throws std::runtime_error.
    explicit SoundLog(const std::string& path) {
        if (path.empty()) return;
        file_.open(path);
        if (!file_) throw std::runtime_error(path + ": cannot be written");
        file_ << "steady_ns,what" << std::endl;
    }

    /// Sets the time 0 of the board.
    void begin(std::chrono::steady_clock::time_point at) { start_ = at; }

    void write(const char* what, double seconds) {
        const auto at = start_.time_since_epoch() + std::chrono::nanoseconds(std::llround(seconds * 1e9));
        if (file_.is_open())
            file_ << std::chrono::duration_cast<std::chrono::nanoseconds>(at).count() << ',' << what
                  << std::endl;
    }

    /// Evaluates the frames since the last call.
    void writeFrames(const Peripherals& io) {
        for (; evaluatedFrames_ < io.frames.size(); ++evaluatedFrames_) {
            const bool isSilent =
                std::ranges::all_of(io.frames[evaluatedFrames_], [](int code) { return code == midScale; });
            if (!isSilent && silentFrames_ >= silenceFrames) write("sound", secondsAt(io, evaluatedFrames_));
            silentFrames_ = isSilent ? silentFrames_ + 1 : 0;
            if (silentFrames_ == silenceFrames)
                write("silence", secondsAt(io, evaluatedFrames_ + 1 - silenceFrames));
        }
    }

private:
    static constexpr std::size_t silenceFrames = 160;
    static constexpr int midScale = 128;
    static double secondsAt(const Peripherals& io, std::size_t frame) {
        return static_cast<double>(io.frameCycles[frame]) / io.hz();
    }

    std::ofstream file_;
    std::chrono::steady_clock::time_point start_;
    std::size_t evaluatedFrames_ = 0, silentFrames_ = silenceFrames;
};

} // namespace physvib::virtualboard
