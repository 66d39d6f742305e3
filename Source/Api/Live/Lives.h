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
    std::string open() {
        std::promise<std::string> opened;
        auto told = opened.get_future();
        messages_ = std::thread{[this, opened = std::move(opened)]() mutable { run(std::move(opened)); }};
        return told.get();
    }

    /// Silences and closes the device and waits. Returns empty, or why the session file is incomplete.
    std::string end() {
        isEnding_ = true;
        if (messages_.joinable()) messages_.join();
        return unsaved_;
    }

    /// Any thread, after open().
    Session& session() noexcept { return rig_->session(); }
    AudioOutput& output() noexcept { return rig_->output(); }
    LiveStatus status() const {
        const std::lock_guard lock{statusMutex_};
        return status_;
    }
    bool isOfThisProcess() const noexcept { return process_ == thisProcess(); }
    int stepsPerSecond() const noexcept { return rig_->settings().setup.stepsPerSecond; }

private:
    static constexpr int watchesPerSecond = 50;
    // The message thread, which owns the device.
    void run(std::promise<std::string> opened) {
        rig_.emplace(std::move(settings_), withNoDevice(systemAudioDrivers));
        if (std::string error = rig_->open(); error.empty()) {
            rig_->start();
            watch();
            opened.set_value({});
            repeatEvery(std::chrono::milliseconds{1000 / watchesPerSecond}, [this] { return watch(); });
            rig_->stop([](const PlayedEvent&) {});
            unsaved_ = rig_->finish(false); // before closing the device, which may hang
        } else {
            opened.set_value(std::move(error));
        }
        rig_.reset(); // on the thread that opened the device
    }
    bool watch() {
        rig_->takePlayed([](const PlayedEvent&) {});
        if (ticks_++ % watchesPerSecond == 0) {
            rig_->maintain();
            trouble_ = rig_->trouble();
        }
        LiveStatus now{rig_->output().status(),
                       rig_->session().status().render,
                       rig_->output().sampleRateHz(),
                       rig_->output().blockFrames(),
                       rig_->output().device(),
                       rig_->sinkStates(),
                       trouble_};
        const std::lock_guard lock{statusMutex_};
        status_ = std::move(now);
        return !isEnding_;
    }

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

using Lives = Handles<Live, physvib_live, 3>;

/// The open devices. Any thread.
std::vector<physvib_live> openLives();

/// Calls `call(live)`, or returns the error for an unknown handle.
template <class Call>
auto in(physvib_live name, Call call) noexcept {
    return Lives::all().in(name, [&](Live& live) -> decltype(call(live)) {
        if (!live.isOfThisProcess())
            return fail(PHYSVIB_ERROR_DEVICE, "live: the process that opened it plays on; expected a device "
                                              "that the child opens itself");
        return call(live);
    });
}

inline bool isLevel(double db) noexcept { return db >= -90.0 && db <= 0.0; } // not NaN
inline float gainOf(double db) noexcept { return static_cast<float>(fromDecibels(db)); }

/// Law, field and layout of a panner. Returns PHYSVIB_OK, or sets the error.
inline int writePanner(const PhantomPanner& panner, physvib_renderer_settings& to) noexcept {
    to.law = static_cast<int>(panner.requestedLaw()); // the law in use, unless the layout has parts
    to.exponent = panner.exponent();
    to.field_width_m = panner.fieldWidthMetres();
    to.field_height_m = panner.fieldHeightMetres();
    return writeLayout(panner.layout(), to.layout);
}

/// As takeRenderer; null: the defaults.
inline bool takeRendererOrUsual(const physvib_renderer_settings* from, RendererSettings& to) noexcept {
    physvib_renderer_settings usual;
    physvib_renderer_settings_init(&usual, sizeof usual);
    return takeRenderer(from == nullptr ? &usual : from, to);
}

} // namespace physvib::api
