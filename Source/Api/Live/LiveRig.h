// SPDX-License-Identifier: MIT
// LiveRig, an open device of physvib-live.h with its message thread; the table of its handles; and checks
// that the functions of physvib-live.h share.
#pragma once
#include "Api/C/Calls.h"
#include "Api/C/HandleTable.h"
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

/// Status of a live rig, updated 50 times a second.
struct LiveRigStatus {
    AudioOutputStatus output;
    RenderStatus render;
    int rateHz = 0, blockFrames = 0;
    std::string device; // driver:name
    std::vector<SinkState> sinks;
    std::string problem; // error of the device or a sink; empty: none
};

/// Session, audio device and sinks for programs without a message loop; the caller simulates the world.
/// open() and close() run on any thread, one call at a time. A forked child inherits the memory but not the
/// threads, so it neither uses nor destroys a rig of its parent.
class LiveRig {
public:
    explicit LiveRig(RigSettings settings)
        : settings_{std::move(settings)} {}
    ~LiveRig() { close(); }
    LiveRig(const LiveRig&) = delete;
    LiveRig& operator=(const LiveRig&) = delete;

    /// Waits until device and sinks are open. Returns empty, or the error in one line.
    std::string open();

    /// Silences and closes the device, and waits. Returns empty, or why the session file is incomplete.
    std::string close();

    /// Any thread, after open().
    Session& session() noexcept { return rig_->session(); }
    AudioOutput& output() noexcept { return rig_->output(); }
    LiveRigStatus status() const;
    bool isOfThisProcess() const noexcept { return processId_ == currentProcessId(); }
    int stepsPerSecond() const noexcept { return rig_->settings().setup.stepsPerSecond; }
    bool isSaved() const noexcept { return !rig_->settings().savePath.empty(); }

private:
    static constexpr int updatesPerSecond = 50;
    void serve(std::promise<std::string> opened);
    bool updateStatus();

    const int processId_ = currentProcessId();
    RigSettings settings_;   // until the rig is created
    std::optional<Rig> rig_; // owned by the message thread, which outlives every call
    std::atomic<bool> isClosing_{false};
    mutable std::mutex statusMutex_;
    LiveRigStatus status_;
    std::string saveError_; // written by the message thread; read after it has ended
    int updateCount_ = 0;   // used by the message thread only, like problem_
    std::string problem_;
    std::thread messageThread_;
};

inline HandleTable<LiveRig, liveKind>& liveRigs() {
    static auto* const table = new HandleTable<LiveRig, liveKind>; // never freed: threads may outlive main
    return *table;
}

inline std::uintptr_t handleNumber(physvib_live live) noexcept {
    return reinterpret_cast<std::uintptr_t>(live);
}

/// Handles of the open devices. Any thread.
std::vector<std::uintptr_t> openLiveHandles();

/// Calls `call(live)`, or returns the error for an unknown handle.
template <class Call>
auto withObject(physvib_live handle, Call call) noexcept -> decltype(call(std::declval<LiveRig&>())) {
    return catchExceptions([&]() -> decltype(call(std::declval<LiveRig&>())) {
        const auto live = liveRigs().borrow(handleNumber(handle));
        if (!live) return unknownHandleError();
        if (!live->isOfThisProcess())
            return fail(PHYSVIB_ERROR_DEVICE, "live: the process that opened it plays on; expected a device "
                                              "that the child opens itself");
        return call(*live);
    });
}

inline bool isValidLevelDb(double db) noexcept { return db >= -90.0 && db <= 0.0; } // not NaN
inline float gainFromDb(double db) noexcept { return static_cast<float>(fromDecibels(db)); }

/// Writes law, exponent, field and layout; returns PHYSVIB_OK, or sets the error.
inline int writePanner(const PhantomPanner& panner, physvib_renderer_settings& to) {
    to.law = static_cast<int>(panner.requestedLaw()); // parts may choose another
    to.exponent = panner.exponent();
    to.field_width_m = panner.fieldWidthMetres();
    to.field_height_m = panner.fieldHeightMetres();
    return writeLayout(panner.layout(), to.layout);
}

/// readRenderer(); null: the defaults.
inline bool readLiveRenderer(const physvib_renderer_settings* from, RendererSettings& to) {
    physvib_renderer_settings defaults;
    if (from == nullptr) physvib_renderer_settings_init(&defaults, sizeof defaults);
    return readRenderer(from == nullptr ? &defaults : from, to);
}

} // namespace physvib::api
