// SPDX-License-Identifier: MIT
// A live rig: session, audio device, sinks, simulation driver, recording and journal, in one object that the
// command line, the live library and the mixer share.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Recordings/Recording.h"
#include "Live/Session/Session.h"
#include "Live/Session/SessionJournal.h"
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

/// A thread that steps a session from construction to destruction, or until `isEnded` (may be null) is true;
/// then at most one more step follows. It wakes when the device's blocks make a step due (threadGapSeconds),
/// at realtime priority where the system permits, because an ordinary thread may be late on a loaded machine.
/// One driver at a time per session. Created and destroyed on the message thread (M).
class ThreadDriver {
public:
    ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* isEnded = nullptr);
    ~ThreadDriver();
    ThreadDriver(const ThreadDriver&) = delete;
    ThreadDriver& operator=(const ThreadDriver&) = delete;

private:
    static constexpr std::int64_t pollNs = 250'000, maxAdvanceNs = 20'000'000, maxBlockNs = 500'000'000;
    void run();
    bool isOver() const noexcept { return isDestroyed_ || (isEnded_ != nullptr && *isEnded_); }

    Session& session_;
    const std::int64_t stepNs_;
    const std::atomic<bool>* const isEnded_;
    std::atomic<bool> isDestroyed_{false};
    std::thread thread_;
};

// A loop at a steady pace, for programs without a message loop.

/// Calls `tick()` once per period until it returns false. Ticks that a stall has missed are left out.
template <class Tick>
void repeatEvery(std::chrono::milliseconds period, Tick tick) {
    using Clock = std::chrono::steady_clock;
    for (auto next = Clock::now() + period;; next += period) {
        std::this_thread::sleep_until(next);
        if (!tick()) return;
        if (const auto now = Clock::now(); now > next + period) next = now;
    }
}

struct RigSettings {
    SessionSetup setup;
    AudioOutputSettings output{};
    std::vector<SinkName> sinks{}; ///< sinks that play in sync with the device
    bool awaitsSinks = true;  ///< open() waits until the sinks are ready; otherwise each joins when it is
    bool hasOwnThread = true; ///< a thread of its own steps the world; otherwise step() does
    std::string recordPath{}; ///< WAV file; empty: none
    std::string savePath{};   ///< session as JSON, with its event list beside it; empty: none
    Provenance provenance{};  ///< of the event list
};

/// A part of the rig that does not work, and its one-line error.
struct RigError {
    std::string source; ///< "device", "events", the name of a sink, "journal" or "recording"
    std::string text;
    bool operator==(const RigError&) const = default;
};

/// One line on events that were dropped because no device ran (DevicePulse); empty if there were none.
std::string droppedEventsText(std::uint64_t events);

/// All methods: M, except session(), whose own methods name their threads.
class Rig {
public:
    /// When `isEnded` (may be null; outlives the rig) becomes true, waits end and the world stops.
    Rig(RigSettings settings, AudioDrivers drivers, const std::atomic<bool>* isEnded = nullptr);
    ~Rig();
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    /// Opens sinks, device, recording and journal, in this order. Returns empty, or one line with the reason.
    std::string open();
    /// The first two steps alone, for programs whose user chooses the device. Empty, or the reason.
    std::string connectSinks();
    std::string openDevice(const AudioOutputSettings& output);

    /// Starts to step the world; the sinks follow the device from now on.
    void start();
    /// Steps the world if no thread of its own does; call every 10 ms (messageTimerGapSeconds).
    void step();

    Session& session() noexcept { return session_; }
    const Session& session() const noexcept { return session_; }
    AudioOutput& output() noexcept { return output_; }
    const AudioOutput& output() const noexcept { return output_; }
    const RigSettings& settings() const noexcept { return settings_; }
    InputTap* inputs() noexcept { return inputs_.get(); } ///< the device's audio input; null: not open
    const PlayedRecorder* recording() const noexcept { return recording_ ? &*recording_ : nullptr; }

    /// Passes the events played since the last call to the sinks, and each to `consume`.
    template <class Consume>
    void drainPlayed(Consume consume) {
        for (PlayedEvent played; session_.played().pop(played);) {
            session_.sinks().onPlayed(played, output_.sampleRateHz());
            consume(played);
        }
    }

    /// Supervises the device; call about once a second.
    void maintain();
    /// Present errors: of the device, of events dropped before the last maintain(), of the sinks, the journal
    /// and the recording.
    std::vector<RigError> errors() const;
    /// The same errors in one line; empty if there are none.
    std::string errorText() const;
    /// State of each sink.
    std::vector<SinkState> sinkStates() const;
    /// A report per sink, after stop(); waits up to a second for each. `sinkError`: set to the first sink
    /// that does not play.
    std::string summary(std::string& sinkError) const;

    /// Silences the device within two blocks. After it nothing is played, recorded or logged, and `consume`
    /// has received every event.
    template <class Consume>
    void stop(Consume consume) {
        output_.stop();
        drainPlayed(consume);
        endFiles();
    }
    /// Completes the files, after stop(); threads that use the session must have ended. Returns empty, or the
    /// reason. `isHurried`: a long session file stays a journal, which is read like a session file.
    std::string finish(bool isHurried);
    /// Closes the device, or abandons it to a driver that hangs, and detaches the sinks.
    void close();

private:
    static constexpr std::chrono::seconds sinkTimeOut{3}; // handshake, clock and Bluetooth take a second

    bool keepGoing() const noexcept { return isEnded_ == nullptr || !*isEnded_; }
    std::string beginRecording();
    std::string beginJournal();
    void endFiles();

    RigSettings settings_;
    const std::atomic<bool>* isEnded_;
    Sinks sinks_; // outlive the session, because the sinks follow the output
    Session session_;
    std::unique_ptr<InputTap> inputs_;
    std::optional<PlayedRecorder> recording_;
    std::optional<SessionJournal> journal_;
    AudioOutput output_;
    std::optional<ThreadDriver> driver_;
    std::chrono::steady_clock::time_point connectedAt_;
    std::string deviceError_, eventError_;
    std::string recordingError_; // why the recording is incomplete
    std::uint64_t reportedDropped_ = 0;
};

} // namespace physvib
