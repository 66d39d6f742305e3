// SPDX-License-Identifier: GPL-3.0-or-later
// A session without a world of its own on a device, with a message thread for both: what a program that has none is lent.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Session/Session.h"
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
    std::string trouble;
};

/// One at a time in a process. Made and ended on any thread, the same for each.
class Live {
public:
    Live(const SessionSetup& setup, AudioOutputSettings output);
    ~Live();
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Empty, or one line with the reason; waits for the device.
    std::string open();

    /// Any thread, after open().
    Session& session() noexcept { return session_; }
    AudioOutput& output() noexcept { return *output_; }
    LiveStatus status() const;

private:
    class Watch;
    void run(std::promise<std::string> opened);

    Session session_;
    const AudioOutputSettings settings_;
    const int stepsPerSecond_;
    std::optional<AudioOutput> output_; // of the message thread
    std::atomic<bool> isEnding_{false};
    mutable std::mutex statusMutex_;
    LiveStatus status_;
    std::thread messages_;
};

} // namespace physvib::api
