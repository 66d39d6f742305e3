// SPDX-License-Identifier: MIT
// When the converters leave silence and come back to it, in time of the steady clock, which all programs of a
// machine share: what plays beside the board can be compared with it.
#pragma once
#include "Peripherals.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

namespace physvib::virtualboard {

/// A CSV of `steady_ns,what`, a line at a time; `what`: sound, silence (for 20 ms at least), or a note.
class SoundLog {
public:
    /// Empty: nothing is written. Throws std::runtime_error.
    explicit SoundLog(const std::string& path) {
        if (path.empty()) return;
        file_.open(path);
        if (!file_) throw std::runtime_error(path + ": cannot be written");
        file_ << "steady_ns,what" << std::endl;
    }

    /// The board's time 0.
    void begin(std::chrono::steady_clock::time_point at) { began_ = at; }

    void note(const char* what, double seconds) {
        const auto at = began_.time_since_epoch() + std::chrono::nanoseconds(std::llround(seconds * 1e9));
        if (file_.is_open())
            file_ << std::chrono::duration_cast<std::chrono::nanoseconds>(at).count() << ',' << what
                  << std::endl;
    }

    /// Looks at the frames since the last call.
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
