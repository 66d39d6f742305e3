// SPDX-License-Identifier: MIT
// Events of a program that was built with another header: their structures are shorter, or longer, than ours.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <span>
#include <vector>

namespace physvib::test {

/// All 0, but its size.
template <class Struct>
Struct sized() {
    Struct empty{};
    empty.size = sizeof empty;
    return empty;
}

/// As its init leaves it.
template <class Struct>
Struct begun(int (*init)(Struct* place, std::size_t size)) {
    Struct made;
    EXPECT_EQ(init(&made, sizeof made), PHYSVIB_OK);
    return made;
}

/// A world that has made an event in every other one of twice `steps` steps, of a ball on a floor.
inline physvib_world worldWithEvents(int steps) {
    physvib_world world = nullptr;
    EXPECT_EQ(physvib_world_create(nullptr, &world), PHYSVIB_OK);
    auto body = begun(physvib_body_init);
    EXPECT_EQ(physvib_world_set_body(world, 0, &body), PHYSVIB_OK);
    body.mass_kg = 2.0, body.is_camera = 1, body.frequency_hz = 200.0, body.decay_per_s = 30.0;
    EXPECT_EQ(physvib_world_set_body(world, 1, &body), PHYSVIB_OK);
    auto contact = begun(physvib_contact_init);
    contact.a = 0, contact.b = 1;
    for (int step = 0; step < 2 * steps; ++step) {
        EXPECT_EQ(physvib_world_begin_step(world, 0.01, 9.81), PHYSVIB_OK);
        contact.impulse_n_s = 1.0 + step;
        if (step % 2 == 0) EXPECT_EQ(physvib_world_touch(world, &contact), PHYSVIB_OK) << physvib_error();
        EXPECT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
    }
    return world;
}

/// What a program may say: without z_m and what follows, without part, all of it.
inline constexpr std::array<std::size_t, 3> eventSizes{offsetof(physvib_event, z_m),
                                                       offsetof(physvib_event, part), sizeof(physvib_event)};

/// A list in such a program's memory, and what lies behind it.
class SizedEvents {
public:
    /// `count` places for events, of which each says its size.
    SizedEvents(std::size_t size, std::size_t count)
        : size_{size}
        , count_{count}
        , memory_(count * size + guard, 0xAB) {
        say(size);
    }
    SizedEvents(std::size_t size, std::span<const physvib_event> list)
        : SizedEvents{size, list.size()} {
        for (std::size_t i = 0; i < count_; ++i) {
            physvib_event event = list[i];
            event.size = size;
            std::memcpy(at(i), &event, std::min(size, sizeof event));
        }
    }

    /// Each says another size, while the bytes from one to the next stay.
    void say(std::size_t size) {
        for (std::size_t i = 0; i < count_; ++i) std::memcpy(at(i), &size, sizeof size);
    }

    physvib_event* data() { return reinterpret_cast<physvib_event*>(memory_.data()); }
    physvib_int64 count() const { return static_cast<physvib_int64>(count_); }

    /// An event as this header has it; what the program's lacks is as init has it.
    physvib_event operator[](std::size_t i) {
        auto event = begun(physvib_event_init);
        std::memcpy(&event, at(i), std::min(size_, sizeof event));
        return event;
    }

    /// No byte behind the first `written` events has changed, but the size that each says.
    bool isKeptBehind(std::size_t written) const {
        for (std::size_t i = written * size_; i < memory_.size(); ++i) {
            const bool isSize = i < count_ * size_ && i % size_ < sizeof(std::size_t);
            if (!isSize && memory_[i] != 0xAB) return false;
        }
        return true;
    }

private:
    static constexpr std::size_t guard = 4 * sizeof(physvib_event);
    unsigned char* at(std::size_t i) { return memory_.data() + i * size_; }

    std::size_t size_;
    std::size_t count_;
    std::vector<unsigned char> memory_;
};

} // namespace physvib::test
