// SPDX-License-Identifier: MIT
// Objects behind the handles of the C library: controllers, renderers and worlds, and their tables.
#pragma once
#include "Api/C/Calls.h"
#include "Api/C/Handles.h"
#include "Api/C/physvib.h"
#include "Contacts/ContactFeed.h"
#include "Core/ControlQueue.h"
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Core/Pads/PadMotors.h"
#include "Core/RenderControl.h"
#include <algorithm>
#include <atomic>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace physvib::api {

/// Motors of one controller, for a program that sends the commands itself. Neither allocates nor blocks. One
/// thread at a time.
class Pad {
public:
    Pad(const PadLaw& law, double fieldWidthMetres, double fieldHeightMetres) noexcept
        : law_{law}
        , grips_{PadMotors::gripsOf({EnchanterLayout{fieldWidthMetres, fieldHeightMetres, 1, {}},
                                     PanningLaw::linear, 1.0, fieldWidthMetres, fieldHeightMetres})}
        , motors_{law} {}

    /// False if too many events are pending. An event that comes too late for its command begins at the next
    /// pull: the model has to know when its motor really starts.
    bool strike(const CollisionEvent& event) noexcept {
        if (event.timeNs >= pulledNs_ + leadNs()) return motors_.strike(event, grips_);
        if (lateCount_ == late_.size()) return false;
        late_[lateCount_++] = event;
        return true;
    }

    /// The command for the frame that ends at `untilNs`. Of several that became due since the last pull it is
    /// the strongest, per motor, so that no impact between two frames is lost. If none, the last holds.
    PadCommand pull(std::int64_t untilNs, double level) noexcept {
        pulledNs_ = untilNs;
        for (; lateCount_ > 0; motors_.strike(late_[lateCount_], grips_))
            late_[--lateCount_].timeNs = untilNs + leadNs();
        const PadMotors::Due due = motors_.nextUntil(untilNs, level);
        if (due.count == 0) return last_;
        last_ = due.last;
        return due.strongest;
    }

    /// Discards all events and lets the motors rest. Times may begin again at 0.
    void reset() noexcept { *this = Pad{law_, grips_.fieldWidthMetres(), grips_.fieldHeightMetres()}; }

    std::int64_t pulledNs() const noexcept { return pulledNs_; }
    const PadLaw& law() const noexcept { return law_; }
    PadMotors& motors() noexcept { return motors_; } ///< for a program with a timer per command, not frames

private:
    std::int64_t leadNs() const noexcept { return static_cast<std::int64_t>(1e9 * law_.leadSeconds); }

    PadLaw law_;
    PhantomPanner grips_; // the left and the right end of the field
    PadMotors motors_;
    PadCommand last_;
    std::array<CollisionEvent, 256> late_; // until the next pull, in any order
    std::size_t lateCount_ = 0;
    std::int64_t pulledNs_ = INT64_MIN / 2;
};

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
    std::mutex producers, readers; // never locked by the audio thread
    LastChanges changes;           // under `producers`
    LatestValue<RenderStatus> status;
    std::atomic_flag isPulled; // set while a thread renders
};

struct World {
    explicit World(const ImpactSettings& settings)
        : feed(settings) {}
    std::mutex mutex;
    ContactFeed feed;
    std::vector<CollisionEvent> taken; // events not yet handed out
    // Bodies that do not play on the first device; kept when a body is removed, since events may still come.
    std::unordered_map<int, int> devices;
    std::uint64_t late = 0, dropped = 0, rejected = 0, withoutPart = 0; // of the output explained last
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

/// Calls `call` with the world or the controllers of that handle, under their mutex; returns its code or
/// count.
template <class Handle, class Call>
auto in(Handle name, Call call) noexcept -> decltype(call(*use(name))) {
    return guarded([&]() -> decltype(call(*use(name))) {
        const auto object = use(name);
        if (!object) return unknownHandle();
        const std::lock_guard lock{object->mutex};
        return call(*object);
    });
}

} // namespace physvib::api
