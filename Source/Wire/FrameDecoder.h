// SPDX-License-Identifier: MIT
// Receiving end of the board link: a decoder of bytes to checked payloads, which resynchronises at the next
// zero after an error, and a detector of events that were sent twice.
#pragma once
#include "Core/Limits.h"
#include "Wire/Messages.h"
#include <array>
#include <cstdint>
#include <span>

namespace physvib::wire {
/// Decodes the bytes of one line, for one reader. No heap; stores at most maxFrame bytes.
class FrameDecoder {
public:
    /// Type and fields if `byte` completes a valid frame (valid until the next call), else empty.
    constexpr std::span<const std::uint8_t> feed(std::uint8_t byte) noexcept {
        if (byte != 0) {
            if (size_ < frame_.size()) frame_[size_] = byte;
            size_ = std::min(size_ + 1, frame_.size() + 1); // one beyond the maximum: the frame is too long
            return {};
        }
        const std::size_t size = size_;
        size_ = 0;
        return size == 0 ? std::span<const std::uint8_t>{} : check(size);
    }

    std::uint32_t goodFrames() const noexcept { return goodFrames_; } ///< valid frames so far
    std::uint32_t badFrames() const noexcept { return badFrames_; }   ///< invalid frames so far

private:
    constexpr std::span<const std::uint8_t> check(std::size_t size) noexcept {
        const int length = size <= frame_.size() ? cobsDecode({frame_.data(), size}, payload_) : -1;
        if (length >= 3) {
            const auto n = static_cast<std::size_t>(length) - 2;
            if (crc16({payload_.data(), n}) == (payload_[n] | payload_[n + 1] << 8)) {
                ++goodFrames_;
                return {payload_.data(), n};
            }
        }
        ++badFrames_;
        return {};
    }

    std::array<std::uint8_t, maxFrame - 1> frame_{};
    std::array<std::uint8_t, maxPayload> payload_{};
    std::size_t size_ = 0;
    std::uint32_t goodFrames_ = 0, badFrames_ = 0;
};

/// Detects repeated events of one connection, so that the board plays none twice. One thread.
class DuplicateFilter {
public:
    /// A computer sends no event more than 50 ms after its onset; the rest is margin.
    static constexpr std::int32_t maxLateFrames = limits::board::sampleRateHz / 4;

    /// False if the event was received before. `frame`: its onset; `now`: the frame that is rendered next.
    bool isNew(std::uint8_t sequence, std::uint32_t frame, std::uint32_t now) noexcept {
        if (difference(frame, now) < -maxLateFrames) return false; // sequence numbers may have wrapped
        const auto gap = static_cast<std::uint8_t>(sequence - lastSequence_);
        const bool isBehind = gap == 0 || gap >= 128; // or over 127 were lost, but then its onset is later
                                                      // than all so far
        if (isBehind && hasNewest_ && difference(frame, newestFrame_) <= 0) return false;
        lost_ += static_cast<std::uint8_t>(gap - 1);
        lastSequence_ = sequence;
        if (!hasNewest_ || difference(frame, newestFrame_) > 0) newestFrame_ = frame;
        hasNewest_ = true;
        return true;
    }

    std::uint32_t lost() const noexcept { return lost_; } ///< gaps in the sequence

private:
    static constexpr std::int32_t difference(std::uint32_t a, std::uint32_t b) noexcept {
        return static_cast<std::int32_t>(a - b);
    }
    std::uint32_t lost_ = 0, newestFrame_ = 0;
    std::uint8_t lastSequence_ = 0xFF;
    bool hasNewest_ = false;
};

} // namespace physvib::wire
