// SPDX-License-Identifier: GPL-3.0-or-later
// How far long work is, on a terminal; nothing anywhere else.
#pragma once
#include "System/Process.h"
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

namespace physvib {

/// "[#########           ] 450 of 1000, 12 s left", rewritten in place on standard error; gone at the end. M
/// only.
class ProgressBar {
public:
    explicit ProgressBar(std::uint64_t whole)
        : whole_{whole} {}
    ~ProgressBar() {
        if (isShown_) std::fputs("\r\x1b[K", stderr);
    }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `hadToBeDone`: what was there before says nothing of how long the rest takes.
    void add(bool hadToBeDone) {
        ++done_;
        worked_ += hadToBeDone ? 1 : 0;
        const auto now = Clock::now();
        if (!isTerminal_ || now - shown_ < std::chrono::milliseconds{100}) return;
        shown_ = now;
        isShown_ = true;
        std::fprintf(stderr, "\r%s\x1b[K",
                     words(std::chrono::duration<double>(now - begin_).count()).c_str());
    }

    std::string words(double seconds) const {
        constexpr std::uint64_t width = 20;
        const std::uint64_t marks = done_ * width / whole_;
        std::string text = "[";
        text.append(marks, '#')
            .append(width - marks, ' ')
            .append("] ")
            .append(std::to_string(done_))
            .append(" of ")
            .append(std::to_string(whole_));
        if (worked_ == 0) return text;
        const auto left = static_cast<long long>(
            std::ceil(seconds * static_cast<double>(whole_ - done_) / static_cast<double>(worked_)));
        return text + ", " +
               (left < 120 ? std::to_string(left) + " s left" : std::to_string(left / 60) + " min left");
    }

private:
    using Clock = std::chrono::steady_clock;
    std::uint64_t whole_, done_ = 0, worked_ = 0;
    bool isTerminal_ = isErrorTerminal(), isShown_ = false;
    Clock::time_point begin_ = Clock::now(), shown_{};
};

} // namespace physvib
