// SPDX-License-Identifier: GPL-3.0-or-later
// A session without a world of its own on a device and sinks beside it, with a message thread for it: what a
// program that has none is lent.
#pragma once
#include "Host/Rig/Rig.h"
#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace physvib::api {

/// What is told of it.
struct LiveStatus {
    AudioOutputStatus output;
    RenderStatus render;
    int rateHz = 0, blockFrames = 0;
    std::vector<SinkState> sinks;
    std::string trouble;
};

/// One at a time in a process. Made and ended on any thread, the same for each.
class Live {
public:
    explicit Live(RigSettings settings)
        : settings_{std::move(settings)} {}
    ~Live() { end(); }
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Empty, or one line with the reason; waits for the device and what is beside it.
    std::string open();

    /// Silent, and closed; empty, or why the session is not saved whole. Waits for both.
    std::string end();

    /// Any thread, after open().
    Session& session() noexcept { return rig_->session(); }
    AudioOutput& output() noexcept { return rig_->output(); }
    LiveStatus status() const;
    double longestGapSeconds() const noexcept { return rig_->settings().setup.longestGapSeconds; }

private:
    class Watch;
    void run(std::promise<std::string> opened);

    RigSettings settings_;   // until the rig has them
    std::optional<Rig> rig_; // of the message thread, which nobody else's call outlasts
    std::atomic<bool> isEnding_{false};
    mutable std::mutex statusMutex_;
    LiveStatus status_;
    std::string unsaved_; // of the message thread, until it has ended
    std::thread messages_;
};

} // namespace physvib::api
