// SPDX-License-Identifier: MIT
// Wait-free triple buffer that hands the newest value from one thread to another without tearing, for
// telemetry.
#pragma once
#include "Core/Nonblocking.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace physvib {

/// One writer, one reader. The reader gets the newest value; values in between may be skipped. Do not use it
/// for anything audible: that needs a time and travels as an event.
template <class T>
class LatestValue {
    static_assert(std::is_trivially_copyable_v<T>, "values are copied across threads");

public:
    /// Writer only, wait-free.
    void write(const T& value) noexcept PHYSVIB_NONBLOCKING {
        slots_[writing_].value = value;
        writing_ =
            shared_.exchange(static_cast<std::uint8_t>(writing_ | fresh), std::memory_order_acq_rel) & index;
    }

    /// The newest value; T{} before the first write. Reader only, wait-free.
    const T& read() noexcept PHYSVIB_NONBLOCKING {
        if (shared_.load(std::memory_order_relaxed) & fresh)
            reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & index;
        return slots_[reading_].value;
    }

private:
    static constexpr std::uint8_t index = 3;
    static constexpr std::uint8_t fresh = 4; // set by the writer, cleared when the reader takes the slot
    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) std::atomic<std::uint8_t> shared_{1};
    alignas(64) std::uint8_t writing_ = 0;
    alignas(64) std::uint8_t reading_ = 2;
};

} // namespace physvib
