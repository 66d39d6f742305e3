// SPDX-License-Identifier: MIT
// A live rig for programs without a message loop: session, audio device and sinks, with a message thread of
// their own. The session has no world of its own.
#pragma once
#include "Live/Devices/ThisThread.h"
#include "Live/Rig/Rig.h"
#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

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

    /// Silences and closes the device, and waits for both. Returns empty, or why the session file is
    /// incomplete.
    std::string end();

    /// Any thread, after open().
    Session& session() noexcept { return rig_->session(); }
    AudioOutput& output() noexcept { return rig_->output(); }
    LiveStatus status() const;
    bool isOfThisProcess() const noexcept { return process_ == thisProcess(); }
    double longestGapSeconds() const noexcept { return rig_->settings().setup.longestGapSeconds; }

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
    int ticks_ = 0;       // the message thread's, as the next
    std::string trouble_;
    std::thread messages_;
};

} // namespace physvib::api
