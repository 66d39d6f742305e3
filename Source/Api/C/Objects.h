// SPDX-License-Identifier: MIT
// Objects behind the handles of the C library.
#pragma once
#include "Api/C/Calls.h"
#include "Api/C/Handles.h"
#include "Api/C/Pad.h"
#include "Api/C/physvib.h"
#include "Contacts/ContactFeed.h"
#include "Core/ControlQueue.h"
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Core/RenderControl.h"
#include <atomic>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace physvib::api {

/// A renderer with its input queues.
struct Renderer {
    struct Source {
        EventQueue<CollisionEvent, 8192> events;
        ControlQueue<256> controls;
        bool pop(CollisionEvent& event) noexcept { return events.pop(event); }
        bool pop(RenderControl& control) noexcept { return controls.pop(control); }
        void done(const RenderControl& control) noexcept { controls.done(control); }
    };
    HapticRenderer renderer;
    Source source;
    int rateHz = 0, channels = 0;
    std::mutex producers, readers; // any thread but R
    LastChanges changes;           // under `producers`
    LatestValue<RenderStatus> status;
    std::atomic_flag isPulled; // set while R renders
};

struct World {
    explicit World(const ImpactSettings& settings)
        : feed(settings) {}
    std::mutex mutex;
    ContactFeed feed;
    std::vector<CollisionEvent> taken; // events not yet handed out
    // of bodies that are felt elsewhere than on the first device; their last events may come after they are
    // removed
    std::unordered_map<int, int> devices;
    std::uint64_t late = 0, dropped = 0, rejected = 0, withoutPart = 0; // of the output, at the last
                                                                        // explanation
};

/// Controllers of a program that sends the motor commands itself.
struct Pads {
    std::mutex mutex;
    std::vector<Pad> pads; // 1 or more
    double level = 1.0;
    bool has(int pad) const noexcept { return pad >= 0 && pad < std::ssize(pads); }
    Pad& at(int pad) noexcept { return pads[static_cast<std::size_t>(pad)]; }
};

inline Handles<Renderer, 1>& renderers() {
    static auto* const all = new Handles<Renderer, 1>; // never destroyed: threads may outlive main
    return *all;
}
inline Handles<World, 2>& worlds() {
    static auto* const all = new Handles<World, 2>;
    return *all;
}
inline Handles<Pads, 7>& allPads() {
    static auto* const all = new Handles<Pads, 7>;
    return *all;
}

inline auto use(physvib_renderer renderer) noexcept {
    return renderers().use(reinterpret_cast<std::uintptr_t>(renderer));
}
inline auto use(physvib_world world) noexcept {
    return worlds().use(reinterpret_cast<std::uintptr_t>(world));
}
inline auto use(physvib_pads pads) noexcept { return allPads().use(reinterpret_cast<std::uintptr_t>(pads)); }

/// Calls `call(World&)` with the world of that handle, under its mutex; returns its code or count.
template <class Call>
auto in(physvib_world name, Call call) noexcept -> decltype(call(std::declval<World&>())) {
    return guarded([&]() -> decltype(call(std::declval<World&>())) {
        const auto world = use(name);
        if (!world) return unknownHandle();
        const std::lock_guard lock{world->mutex};
        return call(*world);
    });
}

} // namespace physvib::api
