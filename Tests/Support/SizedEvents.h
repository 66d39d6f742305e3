// SPDX-License-Identifier: MIT
// Events of a program that was built with another header: their structures are shorter, or longer, than ours.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <physvib/physvib.h>
#include <span>
#include <vector>

namespace physvib::test {

/// What a program may say, and the bytes from one event to the next: without z_m and what follows, without
/// part, all of it, and version 1.0's by a 0.
struct EventSize {
    std::size_t said, bytes;
};
inline constexpr std::array<EventSize, 4> eventSizes{
    {{offsetof(physvib_event, z_m), offsetof(physvib_event, z_m)},
     {offsetof(physvib_event, part), offsetof(physvib_event, part)},
     {sizeof(physvib_event), sizeof(physvib_event)},
     {0, offsetof(physvib_event, unused) + sizeof(int)}}};

/// A list in such a program's memory, and what lies behind it.
class SizedEvents {
public:
    /// `count` places for events, of which each says its size.
    SizedEvents(EventSize size, std::size_t count)
        : size_{size}
        , count_{count}
        , memory_(count * size.bytes + guard, 0xAB) {
        for (std::size_t i = 0; i < count; ++i) std::memcpy(at(i), &size.said, sizeof size.said);
    }
    SizedEvents(EventSize size, std::span<const physvib_event> list)
        : SizedEvents{size, list.size()} {
        for (std::size_t i = 0; i < count_; ++i) {
            physvib_event event = list[i];
            event.size = size.said;
            std::memcpy(at(i), &event, std::min(size.bytes, sizeof event));
        }
    }

    physvib_event* data() { return reinterpret_cast<physvib_event*>(memory_.data()); }
    physvib_int64 count() const { return static_cast<physvib_int64>(count_); }

    /// An event as this header has it; what the program's lacks is as init has it.
    physvib_event operator[](std::size_t i) {
        physvib_event event;
        physvib_event_init(&event, sizeof event);
        std::memcpy(&event, at(i), std::min(size_.bytes, sizeof event));
        return event;
    }

    /// No byte behind the first `written` events has changed, but the size that each says.
    bool isKeptBehind(std::size_t written) const {
        for (std::size_t i = written * size_.bytes; i < memory_.size(); ++i) {
            const bool isSize = i < count_ * size_.bytes && i % size_.bytes < sizeof(std::size_t);
            if (!isSize && memory_[i] != 0xAB) return false;
        }
        return true;
    }

private:
    static constexpr std::size_t guard = 4 * sizeof(physvib_event);
    unsigned char* at(std::size_t i) { return memory_.data() + i * size_.bytes; }

    EventSize size_;
    std::size_t count_;
    std::vector<unsigned char> memory_;
};

} // namespace physvib::test
