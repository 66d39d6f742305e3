// SPDX-License-Identifier: MIT
// The objects behind the handles of the C library (Renderer, World, PadSet) with their tables, and Pad, which
// computes the motor commands of one controller.
#pragma once
#include "Api/C/Calls.h"
#include "Api/C/HandleTable.h"
#include "Api/C/physvib.h"
#include "Contacts/ContactFeed.h"
#include "Core/ControlQueue.h"
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Core/Pads/PadMotors.h"
#include "Core/RenderControl.h"
#include <atomic>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace physvib::api {

/// Turns events into commands for the motors of one game controller; the program sends the commands itself.
/// Neither allocates nor blocks. One thread at a time.
class Pad {
public:
    Pad(const PadModel& law, double fieldWidthMetres, double fieldHeightMetres) noexcept
        : law_{law}
        , panner_{PadMotors::makeGripPanner({ActuatorLayout{fieldWidthMetres, fieldHeightMetres, 1, {}},
                                             PanningLaw::linear, 1.0, fieldWidthMetres, fieldHeightMetres})}
        , motors_{law} {}

    /// Adds an event; false if too many are pending. An event whose command is already due starts with the
    /// next pull(), so that the motor model knows the real start.
    bool strike(const CollisionEvent& event) noexcept {
        if (event.timeNs >= lastPullNs_ + leadNs()) return motors_.strike(event, panner_);
        if (lateCount_ == lateEvents_.size()) return false;
        lateEvents_[lateCount_++] = event;
        return true;
    }

    /// Returns the command for the frame that ends at `untilNs`: per motor the strongest that became due
    /// since the last pull, so that no impact between two frames is lost; if none did, the last one again.
    PadCommand pull(std::int64_t untilNs, double level) noexcept {
        lastPullNs_ = untilNs;
        for (; lateCount_ > 0; motors_.strike(lateEvents_[lateCount_], panner_))
            lateEvents_[--lateCount_].timeNs = untilNs + leadNs();
        const PadMotors::DueCommands due = motors_.nextUntil(untilNs, level);
        if (due.count == 0) return lastCommand_;
        lastCommand_ = due.last;
        return due.strongest;
    }

    /// Discards all events and lets the motors rest. Times may begin again at 0.
    void reset() noexcept { *this = Pad{law_, panner_.fieldWidthMetres(), panner_.fieldHeightMetres()}; }

    std::int64_t lastPullNs() const noexcept { return lastPullNs_; }
    const PadModel& law() const noexcept { return law_; }
    PadMotors& motors() noexcept { return motors_; } ///< for a program with a timer per command, not frames

private:
    std::int64_t leadNs() const noexcept { return static_cast<std::int64_t>(1e9 * law_.leadSeconds); }

    PadModel law_;
    PhantomPanner panner_; // gains of the two grips, which lie at the left and right end of the field
    PadMotors motors_;
    PadCommand lastCommand_;
    std::array<CollisionEvent, 256> lateEvents_; // start with the next pull; in any order
    std::size_t lateCount_ = 0;
    std::int64_t lastPullNs_ = INT64_MIN / 2;
};

/// A renderer with its input queues. The audio thread uses `renderer`, producers `source` and `changes`.
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
    std::mutex producerMutex, readerMutex; // never locked by the audio thread
    LastChanges changes;                   // under `producerMutex`
    LatestValue<RenderStatus> status;
    std::atomic_flag isRendering; // set while a thread renders
};

/// A world with the events that it has computed.
struct World {
    explicit World(const ImpactSettings& settings)
        : feed(settings) {}
    std::mutex mutex;
    ContactFeed feed;
    std::vector<CollisionEvent> pendingEvents; // physvib_world_take() has not returned them yet
    // Device by body, if not the first; an entry outlives its body, whose events may still be pending.
    std::unordered_map<int, int> devices;
    std::uint64_t late = 0, dropped = 0, rejected = 0, withoutPart = 0; // totals up to the last explanation
};

/// Controllers of a program that sends the motor commands itself.
struct PadSet {
    std::mutex mutex;
    std::vector<Pad> pads;  // at least one
    double levelGain = 1.0; // linear
    bool has(int pad) const noexcept { return pad >= 0 && pad < std::ssize(pads); }
    Pad& at(int pad) noexcept { return pads[static_cast<std::size_t>(pad)]; }
};

inline HandleTable<Renderer, rendererKind>& renderers() {
    static auto* const table = new HandleTable<Renderer, rendererKind>; // never freed: threads outlive main
    return *table;
}
inline HandleTable<World, worldKind>& worlds() {
    static auto* const table = new HandleTable<World, worldKind>;
    return *table;
}
inline HandleTable<PadSet, padSetKind>& padSets() {
    static auto* const table = new HandleTable<PadSet, padSetKind>;
    return *table;
}

inline auto borrow(physvib_renderer renderer) noexcept {
    return renderers().borrow(reinterpret_cast<std::uintptr_t>(renderer));
}
inline auto borrow(physvib_world world) noexcept {
    return worlds().borrow(reinterpret_cast<std::uintptr_t>(world));
}
inline auto borrow(physvib_pads pads) noexcept {
    return padSets().borrow(reinterpret_cast<std::uintptr_t>(pads));
}

/// Locks the world or controllers of that handle and returns the result of `call`, a code or a count.
template <class Handle, class Call>
auto withObject(Handle handle, Call call) noexcept -> decltype(call(*borrow(handle))) {
    return catchExceptions([&]() -> decltype(call(*borrow(handle))) {
        const auto object = borrow(handle);
        if (!object) return unknownHandleError();
        const std::lock_guard lock{object->mutex};
        return call(*object);
    });
}

} // namespace physvib::api
