// SPDX-License-Identifier: MIT
// A live rig with a thread of its own, its handles, and checks that the functions of physvib-live.h share.
#pragma once
#include "Api/C/Calls.h"
#include "Api/C/Handles.h"
#include "Api/Live/physvib-live.h"
#include "Core/Units.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/System.h"
#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace physvib::api {

/// Status of the rig.
struct LiveStatus {
    AudioOutputStatus output;
    RenderStatus render;
    int rateHz = 0, blockFrames = 0;
    std::string device; // driver:name
    std::vector<SinkState> sinks;
    std::string trouble;
};

/// Session, audio device and sinks for programs without a message loop; the caller simulates the world.
/// Created and ended on any thread, one call at a time. A forked child has its memory and none of its
/// threads: there it is neither used nor destroyed.
class Live {
public:
    explicit Live(RigSettings settings)
        : settings_{std::move(settings)} {}
    ~Live() { end(); }
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Waits for device and sinks. Returns empty, or one line with the reason.
    std::string open();

    /// Silences and closes the device, and waits for both. Empty, or why the session file is incomplete.
    std::string end();

    /// Any thread, after open().
    Session& session() noexcept { return rig_->session(); }
    AudioOutput& output() noexcept { return rig_->output(); }
    LiveStatus status() const;
    bool isOfThisProcess() const noexcept { return process_ == thisProcess(); }
    int stepsPerSecond() const noexcept { return rig_->settings().setup.stepsPerSecond; }

private:
    static constexpr int watchesPerSecond = 50;
    void run(std::promise<std::string> opened);
    bool watch();

    const int process_ = thisProcess();
    RigSettings settings_;   // until the rig is created
    std::optional<Rig> rig_; // owned by the message thread, which outlives every call
    std::atomic<bool> isEnding_{false};
    mutable std::mutex statusMutex_;
    LiveStatus status_;
    std::string unsaved_; // written by the message thread; read after it has ended
    int ticks_ = 0;       // this and trouble_: message thread only
    std::string trouble_;
    std::thread messages_;
};

inline Handles<Live, 3>& lives() {
    static auto* const all = new Handles<Live, 3>; // never destroyed: threads may outlive main
    return *all;
}

inline std::uintptr_t nameOf(physvib_live live) noexcept { return reinterpret_cast<std::uintptr_t>(live); }

/// The open devices. Any thread.
std::vector<std::uintptr_t> openLives();

/// Calls `call(live)`, or returns the error for an unknown handle.
template <class Call>
auto in(physvib_live name, Call call) noexcept -> decltype(call(std::declval<Live&>())) {
    return guarded([&]() -> decltype(call(std::declval<Live&>())) {
        const auto live = lives().use(nameOf(name));
        if (!live) return unknownHandle();
        if (!live->isOfThisProcess())
            return fail(PHYSVIB_ERROR_DEVICE, "live: the process that opened it plays on; expected a device "
                                              "that the child opens itself");
        return call(*live);
    });
}

inline bool isLevel(double db) noexcept { return db >= -90.0 && db <= 0.0; } // not NaN
inline float gainOf(double db) noexcept { return static_cast<float>(fromDecibels(db)); }

/// Reads renderer settings; null: the defaults. Sets the error and returns false if they are invalid.
inline bool takeRenderer(const physvib_renderer_settings* from, RendererSettings& to) {
    physvib_renderer_settings taken;
    if (from == nullptr)
        physvib_renderer_settings_init(&taken, sizeof taken);
    else if (!take(from, taken, physvib_renderer_settings_init))
        return false;
    const std::string_view fault = convert(taken, to);
    return fault.empty() || (nothingThere(fault), false);
}

} // namespace physvib::api
