// SPDX-License-Identifier: MIT
// Bytes as calls of the library with devices and sessions: any call, in any order, with any handle, number or
// pointer; on no device.
#pragma once
#include "Support/RandomCalls.h"
#include <physvib/physvib-live.h>

namespace physvib::test {

/// Handles stay from one call to the next, also those that have been closed or freed.
class RandomLiveCalls : BytesAsValues {
public:
    RandomLiveCalls() { physvib_world_create(nullptr, &world_); }
    ~RandomLiveCalls() {
        physvib_live_close(lives_[0]);
        for (const auto session : sessions_) physvib_session_free(session);
        physvib_world_free(world_);
    }

    /// How many calls they were.
    int run(const std::uint8_t* data, std::size_t size) {
        return BytesAsValues::run(
            data, size, physvib_live_error, [this](std::uint8_t which) { return call(which); },
            [](physvib_int64 result) {
                return result >= 0 || (result != PHYSVIB_ERROR_INTERNAL && result >= PHYSVIB_ERROR_DEVICE &&
                                       std::strlen(physvib_live_error()) > 0);
            });
    }

private:
    bool isVeryRare() { return isRare() && byte() % 64 == 0; }
    physvib_int64 impossible() {
        static constexpr physvib_int64 odd[] = {std::numeric_limits<physvib_int64>::min(),
                                                std::numeric_limits<physvib_int64>::max(), -1};
        return odd[byte() % std::size(odd)];
    }
    physvib_int64 ns() { return isRare() ? impossible() : 1'000'000LL * byte(); }
    double number() { return numberOr(-12.0); }
    physvib_live live() {
        return isRare()   ? reinterpret_cast<physvib_live>(ns())
               : isRare() ? reinterpret_cast<physvib_live>(world_)
                          : lives_[byte() % 16 == 0];
    }
    physvib_session session() {
        return isRare() ? reinterpret_cast<physvib_session>(ns()) : sessions_[byte() % 4];
    }
    physvib_world world() { return isRare() ? reinterpret_cast<physvib_world>(lives_[0]) : world_; }

    const physvib_event* events() {
        const std::size_t size = isRare() ? byte() : sizeof(physvib_event);
        for (physvib_event& event : events_) {
            event = {};
            event.size = isRare() ? byte() : size;
            event.time_ns = ns();
            event.frequency_hz = 100.0 * number();
            event.decay_per_s = 10.0 * number();
            event.amplitude = number();
            event.kind = isRare() ? small() : 0;
        }
        return isRare() ? nullptr : events_.data();
    }

    physvib_int64 call(std::uint8_t which) {
        switch (which % 29) {
        case 24: return physvib_live_impact(live(), number(), number(), number());
        case 25:
            return physvib_live_impact_of(live(),
                                          isRare()   ? nullptr
                                          : isRare() ? "jam"
                                                     : "steel plate",
                                          number(), number(), number());
        case 26: return sendEach();
        case 28:
            return physvib_live_left(live(), ns(), ns(), small(), of(receipt_, physvib_live_receipt_init));
        case 27: return physvib_live_explain(live(), world(), isRare() ? nullptr : text_.data(), byte());
        case 0: return open();
        case 1: return isVeryRare() ? close() : 0;
        case 2: return physvib_live_now_ns(live());
        case 3: return physvib_live_latency_ns(live());
        case 4:
        case 5: return physvib_live_strike(live(), events(), small());
        case 6: return step();
        case 7: return physvib_live_align(live(), world(), isRare() ? nullptr : &start_);
        case 8: return physvib_live_send(live(), world(), ns(), byte() % 2);
        case 9: return physvib_live_set_gain(live(), small(), number());
        case 10: return physvib_live_set_mute(live(), small(), byte());
        case 11: return physvib_live_set_layout(live(), of(renderer_, physvib_renderer_settings_init));
        case 12: return physvib_live_set_level(live(), number());
        case 13: return physvib_live_silence(live(), byte() % 2);
        case 14: return physvib_live_get_status(live(), of(status_, physvib_live_status_init));
        case 15:
            return physvib_session_load(isRare() ? nullptr : "/nowhere/session.json",
                                        isRare() ? nullptr : &sessions_[2]);
        case 16:
        case 17: return createSession();
        case 18: return isRare() ? physvib_session_free(session()) : 0;
        case 19: return physvib_session_save(session(), isRare() ? nullptr : "/nowhere/session.json");
        case 20: return physvib_session_length_ns(session());
        case 21:
            return physvib_session_get_renderer(session(), of(renderer_, physvib_renderer_settings_init));
        case 22: return physvib_session_events(session(), ns(), isRare() ? nullptr : events_.data(), small());
        default:
            return physvib_session_render(session(), 8000 * small(), isRare() ? impossible() : byte(),
                                          isRare() ? nullptr : samples_.data());
        }
    }

    physvib_int64 sendEach() {
        const std::array<physvib_live, 2> names{live(), live()};
        std::array<physvib_int64, 2> starts{ns(), 0};
        return physvib_live_send_each(isRare() ? nullptr : names.data(), isRare() ? small() % 3 : 2, world(),
                                      isRare() ? nullptr : starts.data());
    }

    // A tenth of a second each, so not often once it is open.
    physvib_int64 open() {
        if (lives_[0] != nullptr && !isVeryRare()) return 0;
        physvib_live made = nullptr;
        const char* devices[] = {"None:no device", "None:no device", "nobody:nothing", nullptr};
        const physvib_live_settings* const settings = of(settings_, physvib_live_settings_init);
        // without an end, or no file
        std::memset(settings_.save, isRare() ? 'x' : '\0', sizeof settings_.save);
        const int code = physvib_live_open(devices[byte() % 4], of(renderer_, physvib_renderer_settings_init),
                                           settings, isRare() ? nullptr : &made);
        if (made != nullptr) lives_[0] = made;
        return code;
    }
    physvib_int64 close() {
        lives_[1] = lives_[0];
        lives_[0] = nullptr;
        return physvib_live_close(lives_[1]);
    }
    physvib_int64 step() {
        physvib_world_begin_step(world_, 0.01 * byte(), 9.81);
        physvib_world_end_step(world_);
        return 0;
    }
    physvib_int64 createSession() {
        physvib_session& kept = sessions_[byte() % 2];
        sessions_[3] = kept;
        physvib_session_free(kept);
        return physvib_session_create(of(renderer_, physvib_renderer_settings_init), events(), small(), ns(),
                                      isRare() ? nullptr : &kept);
    }

    std::array<physvib_live, 2> lives_{};       // the one that is open, and one that has gone
    std::array<physvib_session, 4> sessions_{}; // two of ours, null, and one that has gone
    physvib_world world_ = nullptr;
    physvib_int64 start_ = 0;
    std::array<physvib_event, 8> events_{};
    std::vector<float> samples_ = std::vector<float>(64 * 256);
    physvib_renderer_settings renderer_{};
    physvib_live_settings settings_{};
    std::array<char, 256> text_{};
    physvib_live_status status_{};
    physvib_live_receipt receipt_{};
};

} // namespace physvib::test
