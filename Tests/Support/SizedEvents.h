// SPDX-License-Identifier: MIT
// Structures of a program that was built with another header: shorter, or longer, than ours.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <span>
#include <string>
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

/// Room for events that say their size.
template <std::size_t Count>
std::array<physvib_event, Count> places() {
    std::array<physvib_event, Count> all{};
    all.front().size = sizeof all.front();
    return all;
}

/// All of it but its size, to the last bit.
inline std::string wordsOf(const physvib_event& e) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), "%lld %lld %a %a %a %a %a %a %a %d %d %d %d %a %d\n",
                  static_cast<long long>(e.time_ns), static_cast<long long>(e.duration_ns), e.frequency_hz,
                  e.decay_per_s, e.amplitude, e.x_m, e.y_m, e.impulse_n_s, e.mass_kg, e.fixture, e.other,
                  e.kind, e.sound, e.z_m, e.part);
    return text.data();
}

inline physvib_renderer
rendererOf(const physvib_renderer_settings& settings = begun(physvib_renderer_settings_init)) {
    physvib_renderer made = nullptr;
    EXPECT_EQ(physvib_renderer_create(&settings, &made), PHYSVIB_OK) << physvib_error();
    return made;
}

/// What rings at 200 Hz in the corner of the field.
inline physvib_event hitAt(physvib_int64 timeNs, double amplitude = 0.5) {
    auto event = begun(physvib_event_init);
    event.time_ns = timeNs;
    event.frequency_hz = 200.0;
    event.decay_per_s = 30.0;
    event.amplitude = amplitude;
    return event;
}

/// What a ball of that mass is, which is felt.
inline physvib_body feltBall(double massKg = 2.0) {
    auto body = begun(physvib_body_init);
    body.mass_kg = massKg;
    body.is_camera = 1;
    body.frequency_hz = 200.0;
    body.decay_per_s = 30.0;
    return body;
}

/// A floor (body 0) and such a ball (body 1).
inline physvib_world worldOfABall(const physvib_world_settings* settings = nullptr, double massKg = 2.0) {
    physvib_world world = nullptr;
    EXPECT_EQ(physvib_world_create(settings, &world), PHYSVIB_OK) << physvib_error();
    const physvib_body floor = begun(physvib_body_init), ball = feltBall(massKg);
    EXPECT_EQ(physvib_world_set_body(world, 0, &floor), PHYSVIB_OK) << physvib_error();
    EXPECT_EQ(physvib_world_set_body(world, 1, &ball), PHYSVIB_OK) << physvib_error();
    return world;
}

/// The ball on the floor.
inline physvib_contact touching(double impulse = PHYSVIB_UNKNOWN) {
    auto contact = begun(physvib_contact_init);
    contact.a = 0;
    contact.b = 1;
    contact.impulse_n_s = impulse;
    return contact;
}

/// A step of 10 ms with that contact, if there is one; its code.
inline int step(physvib_world world, const physvib_contact* contact = nullptr) {
    EXPECT_EQ(physvib_world_begin_step(world, 0.01, 9.81), PHYSVIB_OK);
    const int code = contact == nullptr ? PHYSVIB_OK : physvib_world_touch(world, contact);
    EXPECT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
    return code;
}

/// That world, which has made an event in every other one of twice `steps` steps.
inline physvib_world worldWithEvents(int steps) {
    const physvib_world world = worldOfABall();
    for (int i = 0; i < 2 * steps; i += 2) {
        const physvib_contact contact = touching(1.0 + i);
        EXPECT_EQ(step(world, &contact), PHYSVIB_OK) << physvib_error();
        step(world);
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

/// Of every length that an older program may have had: filled as far as it goes, and no further. `inner`:
/// where the size of a structure at its end is, which is what fits; 0: none.
template <class Struct>
void expectBegunWithin(int (*init)(Struct*, std::size_t), std::size_t inner = 0) {
    Struct whole;
    ASSERT_EQ(init(&whole, sizeof whole), PHYSVIB_OK);
    for (std::size_t size = sizeof(std::size_t); size <= sizeof whole; ++size) {
        Struct part;
        std::memset(&part, 0xAB, sizeof part);
        ASSERT_EQ(init(&part, size), PHYSVIB_OK);
        ASSERT_EQ(part.size, size);
        part.size = sizeof whole;
        const auto *got = reinterpret_cast<const unsigned char*>(&part),
                   *full = reinterpret_cast<const unsigned char*>(&whole);
        for (std::size_t i = 0; i < size; ++i)
            ASSERT_TRUE(got[i] == full[i] || (inner > 0 && i >= inner && i < inner + sizeof size)) << size;
        ASSERT_TRUE(std::all_of(got + size, got + sizeof whole, [](unsigned char byte) {
            return byte == 0xAB;
        })) << size;
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, sizeof whole + 1})
        EXPECT_EQ(init(&whole, size), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(init(nullptr, sizeof whole), PHYSVIB_ERROR_ARGUMENT);
}

} // namespace physvib::test
