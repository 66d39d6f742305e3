// SPDX-License-Identifier: MIT
// Decodes the bytes of the link to checked payloads, and resynchronises at the next zero after an error.
#pragma once
#include "Wire/Messages.h"
#include <array>
#include <cstdint>
#include <span>

namespace physvib::wire {

/// One reader of one line. No heap; stores at most maxFrame bytes.
class FrameDecoder {
public:
    /// Type and fields if `byte` completes a valid frame (valid until the next call), else empty.
    constexpr std::span<const std::uint8_t> feed(std::uint8_t byte) noexcept {
        if (byte != 0) {
            if (size_ < frame_.size()) frame_[size_] = byte;
            size_ = std::min(size_ + 1, frame_.size() + 1); // one beyond the maximum marks a frame that is
                                                            // too long
            return {};
        }
        const std::size_t size = size_;
        size_ = 0;
        return size == 0 ? std::span<const std::uint8_t>{} : check(size);
    }

    std::uint32_t good() const noexcept { return good_; }
    std::uint32_t bad() const noexcept { return bad_; }

private:
    constexpr std::span<const std::uint8_t> check(std::size_t size) noexcept {
        const int length = size <= frame_.size() ? cobsDecode({frame_.data(), size}, payload_) : -1;
        if (length >= 3) {
            const auto n = static_cast<std::size_t>(length) - 2;
            if (crc16({payload_.data(), n}) == (payload_[n] | payload_[n + 1] << 8)) {
                ++good_;
                return {payload_.data(), n};
            }
        }
        ++bad_;
        return {};
    }

    std::array<std::uint8_t, maxFrame - 1> frame_{};
    std::array<std::uint8_t, maxPayload> payload_{};
    std::size_t size_ = 0;
    std::uint32_t good_ = 0, bad_ = 0;
};

} // namespace physvib::wire
