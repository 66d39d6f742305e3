// SPDX-License-Identifier: MIT
// The newest value from one thread to another, whole and never torn: a wait-free triple buffer for telemetry.
#pragma once
#include "Core/Nonblocking.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace physvib {

/// One writer, one reader; the reader sees the newest value written, values between may be skipped.
/// Never carries anything audible: what is heard needs a time and travels as an event.
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
