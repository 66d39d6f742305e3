// SPDX-License-Identifier: GPL-3.0-or-later
// A file as JUCE's decoders read it: they cannot read more of it than it is worth, and it tells whether they wanted to.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <juce_core/juce_core.h>

namespace physvib {

class RecordingStream final : public juce::InputStream {
public:
    RecordingStream(std::FILE& file, std::int64_t bytes)
        : file_{file}
        , size_{bytes}
        , left_{mostRounds * bytes + (1 << 20)} {}

    /// Whether a decoder has asked for more than there is (or too often for the same), since forget().
    bool isAskedTooMuch() const noexcept { return isAskedTooMuch_; }
    void forget() noexcept { isAskedTooMuch_ = false; }

    juce::int64 getTotalLength() override { return size_; }
    juce::int64 getPosition() override { return position_; }
    bool setPosition(juce::int64 wanted) override {
        position_ = std::clamp<std::int64_t>(wanted, 0, size_);
        return std::fseek(&file_, static_cast<long>(position_), SEEK_SET) == 0;
    }
    bool isExhausted() override { return noteIf(position_ >= size_ || left_ <= 0); }
    int read(void* to, int wanted) override {
        const auto count = std::min<std::int64_t>({wanted, size_ - position_, left_});
        if (noteIf(count <= 0)) return 0;
        const auto taken = static_cast<int>(std::fread(to, 1, static_cast<std::size_t>(count), &file_));
        position_ += taken;
        left_ -= taken;
        return taken;
    }

private:
    static constexpr std::int64_t mostRounds = 4; // a decoder looks for the end, goes back, and reads once

    bool noteIf(bool isTooMuch) noexcept {
        isAskedTooMuch_ = isAskedTooMuch_ || isTooMuch;
        return isTooMuch;
    }

    std::FILE& file_;
    std::int64_t size_, position_ = 0, left_;
    bool isAskedTooMuch_ = false;
};

} // namespace physvib
