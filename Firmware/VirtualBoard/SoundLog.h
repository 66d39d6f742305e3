// SPDX-License-Identifier: MIT
// Logs when the converters leave and reach silence, in time of the steady clock. All programs of a machine
// share that clock, so the log can be compared with devices that play beside the board.
#pragma once
#include "Peripherals.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

namespace physvib::virtualboard {

/// A CSV file of `steady_ns,what`, written line by line; `what`: sound, silence (of at least 20 ms), or a
/// note.
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
    void begin(std::chrono::steady_clock::time_point at) { began_ = at; }

    void note(const char* what, double seconds) {
        const auto at = began_.time_since_epoch() + std::chrono::nanoseconds(std::llround(seconds * 1e9));
        if (file_.is_open())
            file_ << std::chrono::duration_cast<std::chrono::nanoseconds>(at).count() << ',' << what
                  << std::endl;
    }

    /// Evaluates the frames since the last call.
    void follow(const Peripherals& io) {
        for (; seen_ < io.frames.size(); ++seen_) {
            const bool isSilent =
                std::ranges::all_of(io.frames[seen_], [](int code) { return code == midScale; });
            if (!isSilent && silent_ >= pause) note("sound", secondsOf(io, seen_));
            silent_ = isSilent ? silent_ + 1 : 0;
            if (silent_ == pause) note("silence", secondsOf(io, seen_ + 1 - pause));
        }
    }

private:
    static constexpr std::size_t pause = 160; // frames
    static constexpr int midScale = 128;
    static double secondsOf(const Peripherals& io, std::size_t frame) {
        return static_cast<double>(io.frameCycles[frame]) / io.hz();
    }

    std::ofstream file_;
    std::chrono::steady_clock::time_point began_;
    std::size_t seen_ = 0, silent_ = pause;
};

} // namespace physvib::virtualboard
