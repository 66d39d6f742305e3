// SPDX-License-Identifier: GPL-3.0-or-later
// A session without a world of its own on a device and sinks beside it, with a message thread for it: what a
// program that has none is lent.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Host/Devices/SinkTable.h"
#include "Live/Session/Session.h"
#include <atomic>
#include <future>
#include <memory>
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

/// What it plays on, and what it keeps.
struct LiveSettings {
    SessionSetup setup;
    AudioOutputSettings output;
    Sinks sinks{};          ///< ready
    std::string savePath{}; ///< of the session as a file, beside which a list of its events stands; empty:
                            ///< none
};

/// One at a time in a process. Made and ended on any thread, the same for each.
class Live {
public:
    explicit Live(LiveSettings settings);
    ~Live() { end(); }
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Empty, or one line with the reason; waits for the device.
    std::string open();

    /// Silent, and closed; empty, or why the session is not saved whole. Waits for both.
    std::string end();

    /// Any thread, after open().
    Session& session() noexcept { return session_; }
    AudioOutput& output() noexcept { return *output_; }
    LiveStatus status() const;
    double longestGapSeconds() const noexcept { return settings_.setup.longestGapSeconds; }

private:
    class Watch;
    void run(std::promise<std::string> opened);
    void play(std::promise<std::string>& opened);

    const LiveSettings settings_;
    Session session_;
    std::optional<AudioOutput> output_; // of the message thread
    std::atomic<bool> isEnding_{false};
    mutable std::mutex statusMutex_;
    LiveStatus status_;
    std::string unsaved_; // of the message thread, until it has ended
    std::thread messages_;
};

} // namespace physvib::api
