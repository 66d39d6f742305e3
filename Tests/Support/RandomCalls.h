// SPDX-License-Identifier: MIT
// Bytes as calls of the library for other languages: any call, in any order, with any handle, number or
// pointer.
#pragma once
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <physvib/physvib.h>
#include <vector>

namespace physvib::test {

/// Values of the bytes from at_ to end_, then of zeros.
class BytesAsValues {
protected:
    /// Each byte that is left is a call. How many they were; each has to return what `isAnswer` says.
    template <class Call, class IsAnswer>
    int run(const std::uint8_t* data, std::size_t size, const char* (*error)(), Call call,
            IsAnswer isAnswer) {
        at_ = data;
        end_ = data + size;
        int calls = 0;
        for (; at_ < end_; ++calls)
            if (const physvib_int64 result = call(byte()); !isAnswer(result)) {
                std::fprintf(stderr, "result %lld: %s\n", result, error());
                std::abort();
            }
        return calls;
    }
    std::uint8_t byte() { return at_ < end_ ? *at_++ : std::uint8_t{0}; }
    int small() { return static_cast<int>(byte() % 8) - 1; }
    bool isRare() { return byte() % 32 == 0; }
    double numberOr(double own) {
        constexpr double inf = std::numeric_limits<double>::infinity(),
                         nan = std::numeric_limits<double>::quiet_NaN();
        const double odd[] = {0.0, -1.0, 1.0, inf, -inf, nan, 1.0e308, PHYSVIB_UNKNOWN, 1.0e-310, own};
        const std::uint8_t b = byte();
        return b % 4 == 0 ? odd[b / 4 % std::size(odd)] : b / 16.0;
    }

    /// Now and then none, one of another version, or one whose numbers are anything.
    template <class Struct>
    Struct* of(Struct& values, int (*init)(Struct*, std::size_t)) {
        init(&values, isRare() ? byte() : sizeof values);
        if (isRare()) return nullptr;
        if (isRare()) values.size = byte();
        if (isRare()) { // past the size; all members are numbers, for which every pattern is a value
            auto* bytes = reinterpret_cast<unsigned char*>(&values);
            for (std::size_t i = 0; i < 8; ++i)
                bytes[sizeof values.size + byte() * std::size_t{8} % (sizeof values - sizeof values.size)] =
                    byte();
        }
        return &values;
    }

    const std::uint8_t *at_ = nullptr, *end_ = nullptr;
};

/// Handles stay from one call to the next, also those that have been freed; at most two of a kind are alive.
class RandomCalls : BytesAsValues {
public:
    ~RandomCalls() {
        for (const auto renderer : renderers_) physvib_renderer_free(renderer);
        for (const auto world : worlds_) physvib_world_free(world);
        for (const auto pads : pads_) physvib_pads_free(pads);
    }

    /// How many calls they were.
    int run(const std::uint8_t* data, std::size_t size) {
        return BytesAsValues::run(
            data, size, physvib_error, [this](std::uint8_t which) { return call(which); },
            [](physvib_int64 result) {
                return result >= PHYSVIB_ERROR_BUSY && (result >= 0 || std::strlen(physvib_error()) < 640);
            });
    }

private:
    physvib_int64 ns() {
        return byte() % 16 == 0 ? std::numeric_limits<physvib_int64>::min() + byte() : 1000000LL * byte();
    }
    /// Of an event, rarely another one than ours.
    std::size_t size() { return isRare() ? byte() : std::size_t{0}; }
    double number() { return numberOr(0.01); }
    physvib_renderer renderer() {
        return isRare()   ? reinterpret_cast<physvib_renderer>(ns())
               : isRare() ? reinterpret_cast<physvib_renderer>(worlds_[0])
                          : renderers_[byte() % 4];
    }
    physvib_world world() { return isRare() ? reinterpret_cast<physvib_world>(ns()) : worlds_[byte() % 4]; }

    physvib_pads pads() { return isRare() ? reinterpret_cast<physvib_pads>(ns()) : pads_[byte() % 4]; }
    const char* name() {
        static constexpr const char* names[] = {"steel plate", "wooden board", "jam", "", nullptr};
        return names[byte() % std::size(names)];
    }
    physvib_output_facts* outputFacts() { // its pointers are the caller's duty
        physvib_output_facts_init(&facts_, sizeof facts_);
        facts_.is_silent = byte() % 2;
        facts_.channels = small();
        facts_.level = number();
        facts_.muted_channels = ns();
        facts_.late = ns();
        facts_.trouble = isRare() ? "gone" : nullptr;
        facts_.renderer = isRare() ? of(rendererSettings_, physvib_renderer_settings_init) : nullptr;
        return isRare() ? nullptr : &facts_;
    }
    physvib_int64 createPads() {
        if (!isRare()) return 0;
        physvib_pads& kept = pads_[byte() % 2];
        pads_[3] = kept;
        physvib_pads_free(kept);
        kept = nullptr;
        return physvib_pads_create(small(), number(), number(), isRare() ? name() : nullptr,
                                   isRare() ? nullptr : &kept);
    }

    physvib_contact* contact() {
        physvib_contact* const values = of(contact_, physvib_contact_init);
        contact_.a = small();
        contact_.b = small();
        contact_.x_m = number();
        contact_.gap_m = number();
        if (byte() % 2 == 0) contact_.impulse_n_s = number();
        if (byte() % 2 == 0) contact_.approach_m_per_s = number();
        if (const std::uint8_t more = byte(); more % 4 == 0) {
            contact_.point_id = more / 4 % 8 - 3;
            contact_.is_impulse_of_pair = more / 32 % 2;
            contact_.is_soft = more / 64 % 2;
        }
        return values;
    }
    physvib_event* event() {
        event_ = {};
        event_.size = size();
        event_.time_ns = ns();
        event_.frequency_hz = 100.0 * number();
        event_.decay_per_s = 10.0 * number();
        event_.amplitude = number();
        event_.x_m = number();
        event_.kind = small();
        return isRare() ? nullptr : &event_;
    }

    physvib_int64 call(std::uint8_t which) {
        switch (which % 48) {
        case 32: return physvib_world_note(world(), small(), small());
        case 33: return physvib_world_explain(world(), isRare() ? nullptr : text_.data(), byte());
        case 34:
            return physvib_renderer_explain(renderer(), world(), isRare() ? nullptr : text_.data(), byte());
        case 35:
            return physvib_world_explain_output(world(), outputFacts(), isRare() ? nullptr : text_.data(),
                                                byte());
        case 36: return physvib_world_device(world(), small());
        case 37: return physvib_material(name(), of(body_, physvib_body_init));
        case 38:
            return physvib_material_load(isRare() ? nullptr : "/nowhere/materials.json", name(),
                                         of(body_, physvib_body_init));
        case 39: return physvib_sound(name()), 0;
        case 40: return physvib_event_of(name(), number(), number(), number(), isRare() ? nullptr : &event_);
        case 41: return physvib_renderer_impact(renderer(), number(), number(), number());
        case 42: return physvib_renderer_impact_of(renderer(), name(), number(), number(), number());
        case 43: return createPads();
        case 44: return physvib_pads_strike(pads(), small(), event());
        case 45: return physvib_pads_send(pads(), small(), world(), ns(), byte() % 2);
        case 46: return physvib_pads_pull(pads(), ns(), isRare() ? nullptr : motors_.data(), small());
        case 47: return isRare() ? physvib_pads_stop(pads()) : physvib_pads_set_level(pads(), number());
        case 0: return createRenderer();
        case 1: return createWorld();
        case 2: return isRare() ? physvib_renderer_free(renderer()) : 0;
        case 3: return isRare() ? physvib_world_free(world()) : 0;
        case 4:
        case 5: return physvib_renderer_strike(renderer(), event());
        case 6:
        case 7: return pull();
        case 8:
            return physvib_renderer_pull_interleaved(renderer(), isRare() ? nullptr : samples_.data(), 4,
                                                     1 + byte());
        case 9: return physvib_renderer_set_gain(renderer(), ns(), small(), number());
        case 10: return physvib_renderer_set_mute(renderer(), ns(), small(), byte());
        case 11: return physvib_renderer_set_level(renderer(), ns(), number());
        case 12:
            return physvib_renderer_set_layout(renderer(), ns(),
                                               of(rendererSettings_, physvib_renderer_settings_init));
        case 13: return physvib_renderer_silence(renderer(), ns(), ns());
        case 14: return physvib_renderer_latency_frames(renderer());
        case 15: return physvib_renderer_get_status(renderer(), of(status_, physvib_renderer_status_init));
        case 16: return physvib_world_configure(world(), of(worldSettings_, physvib_world_settings_init));
        case 17:
        case 18: return setBody();
        case 19: return physvib_world_remove_body(world(), small());
        case 20:
            return physvib_world_move(world(), small(), number(), number(), number(), number(), number());
        case 21: return physvib_world_pair(world(), small(), small(), 100.0 * number(), number(), number());
        case 22: return physvib_world_begin_step(world(), number() / 100.0, number());
        case 23:
        case 24: return physvib_world_touch(world(), contact());
        case 25: return physvib_world_begin(world(), contact());
        case 26: return physvib_world_push(world(), contact());
        case 27: return physvib_world_end(world(), small(), small());
        case 28: return physvib_world_end_step(world());
        case 29:
            events_[0].size = size();
            return physvib_world_take(world(), isRare() ? nullptr : events_.data(), small(), byte() % 2);
        case 30: return physvib_world_send(world(), renderer(), ns(), byte() % 2);
        default:
            return physvib_world_time_ns(world()) < 0
                       ? 0
                       : physvib_play_out_ns(48000 * small(), byte(), byte(), number());
        }
    }

    physvib_int64 createRenderer() { // megabytes: not often
        if (!isRare()) return 0;
        physvib_renderer& kept = renderers_[byte() % 2];
        renderers_[3] = kept;
        physvib_renderer_free(kept);
        return physvib_renderer_create(of(rendererSettings_, physvib_renderer_settings_init),
                                       isRare() ? nullptr : &kept);
    }
    physvib_int64 createWorld() {
        physvib_world& kept = worlds_[byte() % 2];
        if (kept != nullptr && !isRare()) return 0;
        worlds_[3] = kept;
        physvib_world_free(kept);
        return physvib_world_create(of(worldSettings_, physvib_world_settings_init),
                                    isRare() ? nullptr : &kept);
    }

    physvib_int64 setBody() {
        physvib_body* const values = of(body_, physvib_body_init);
        body_.is_camera = byte() % 2;
        body_.frequency_hz = 100.0 * number();
        body_.decay_per_s = 10.0 * number();
        body_.mass_kg = number();
        body_.voice = small();
        body_.device = small();
        return physvib_world_set_body(world(), small(), values);
    }
    physvib_int64 pull() {
        std::array<float*, 4> channels{};
        for (std::size_t j = 0; j < channels.size(); ++j) channels[j] = samples_.data() + j * 256;
        if (isRare()) channels[byte() % 4] = nullptr;
        return physvib_renderer_pull(renderer(), channels.data(), isRare() ? small() : 4, 1 + byte());
    }

    std::array<physvib_renderer, 4> renderers_{}; // two of ours, null, and one that has gone
    std::array<physvib_world, 4> worlds_{};
    std::array<physvib_pads, 4> pads_{};
    std::array<physvib_motors, 8> motors_{};
    std::array<char, 256> text_{};
    physvib_output_facts facts_{};
    std::vector<float> samples_ = std::vector<float>(64 * 257);
    std::array<physvib_event, 8> events_{};
    physvib_renderer_settings rendererSettings_{};
    physvib_world_settings worldSettings_{};
    physvib_renderer_status status_{};
    physvib_body body_{};
    physvib_contact contact_{};
    physvib_event event_{};
};

} // namespace physvib::test
