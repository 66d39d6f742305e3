// SPDX-License-Identifier: MIT
// A game controller of SDL's own making, which notes what its motors are told: a judge without hardware; and
// a device of which it follows the clock.
#pragma once
#include "Live/Pads/PadOutput.h"
#include "Live/Session/System.h"

namespace physvib {

class VirtualPad {
public:
    struct Told {
        std::int64_t steadyNs;
        double low, high;
    };

    /// GamePads that knows of it lives in the test. A pad of SDL's is gone when the last of these goes.
    explicit VirtualPad(std::string name)
        : name_{std::move(name)} {
        attach();
    }
    ~VirtualPad() { detach(); }

    void attach() {
        SDL_VirtualJoystickDesc description{};
        description.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
        description.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
        description.naxes = 6;
        description.nbuttons = 15;
        description.name = name_.c_str();
        description.userdata = this;
        description.Rumble = [](void* self, Uint16 low, Uint16 high) {
            return static_cast<VirtualPad*>(self)->note(low, high);
        };
        const auto attachNow =
            reinterpret_cast<decltype(&SDL_JoystickAttachVirtualEx)>(of("SDL_JoystickAttachVirtualEx"));
        const auto idOf = reinterpret_cast<decltype(&SDL_JoystickGetDeviceInstanceID)>(
            of("SDL_JoystickGetDeviceInstanceID"));
        id_ = idOf(attachNow(&description));
    }
    void detach() {
        const auto count = reinterpret_cast<decltype(&SDL_NumJoysticks)>(of("SDL_NumJoysticks"))();
        const auto idOf = reinterpret_cast<decltype(&SDL_JoystickGetDeviceInstanceID)>(
            of("SDL_JoystickGetDeviceInstanceID"));
        for (int i = 0; i < count; ++i)
            if (idOf(i) == id_)
                reinterpret_cast<decltype(&SDL_JoystickDetachVirtual)>(of("SDL_JoystickDetachVirtual"))(i);
        id_ = -1;
    }
    std::vector<Told> told() const {
        const std::lock_guard lock{mutex_};
        return told_;
    }
    bool isAtRest() const {
        const auto all = told();
        return all.empty() || (all.back().low == 0.0 && all.back().high == 0.0);
    }

    std::atomic<bool> hangs{false}, isHanging{false}; ///< a command of the motors does not return

private:
    static void* of(const char* function) { return findFunction(openLibrary("libSDL2-2.0.so.0"), function); }
    int note(std::uint16_t low, std::uint16_t high) {
        while (hangs) isHanging = true, std::this_thread::sleep_for(std::chrono::milliseconds{1});
        const std::lock_guard lock{mutex_};
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        told_.push_back({std::chrono::duration_cast<std::chrono::nanoseconds>(now).count(), low / 65535.0,
                         high / 65535.0});
        SDL_version version{};
        reinterpret_cast<decltype(&SDL_GetVersion)>(of("SDL_GetVersion"))(&version);
        return version.patch < 50 ? 0 : 1; // sdl2-compat asks SDL 3, to which 0 is a failure
    }

    const std::string name_;
    SDL_JoystickID id_ = -1;
    mutable std::mutex mutex_;
    std::vector<Told> told_;
};

/// Until it is so, or three seconds have passed.
template <class Condition>
bool soon(Condition condition) {
    for (int i = 0; i < 3000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    return condition();
}

namespace pads_testing {
constexpr std::int64_t ms = 1'000'000;

inline PhantomPanner phone() {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    return {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
}

inline CollisionEvent hit(std::int64_t timeNs, double frequencyHz, double amplitude, double x) {
    return {timeNs, frequencyHz, 20.0, amplitude, x, 0.5};
}

/// A device that asks for a block every 5 ms, of a session that began with it.
class PacedDevice final : public OutputClock {
public:
    PacedDevice() { setLevel(1.0f); }
    std::int64_t sessionNs() const { return now() - beganNs; }
    void block() { publish({sessionNs(), now(), 40 * ms, 48000}); }
    /// `atBlock(sessionNs)` at each.
    template <class AtBlock>
    void run(std::int64_t untilNs, AtBlock atBlock) {
        for (; sessionNs() < untilNs; std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
            block();
            atBlock(sessionNs());
        }
    }
    void run(std::int64_t untilNs) {
        run(untilNs, [](std::int64_t) {});
    }

    static std::int64_t now() { return std::chrono::steady_clock::now().time_since_epoch().count(); }
    std::int64_t beganNs = now();
};
} // namespace pads_testing
} // namespace physvib
