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

/// A thread that wakes when the next step is due, by the blocks of the device (threadGapSeconds). It runs at
/// realtime priority where the system permits, because an ordinary thread is sometimes late on a loaded
/// machine. It steps the session from construction to destruction, or until `ends` (may be null) is true;
/// then at most one more step follows. One driver at a time per session. Created and destroyed on M.
class ThreadDriver {
public:
    ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends = nullptr);
    ~ThreadDriver();
    ThreadDriver(const ThreadDriver&) = delete;
    ThreadDriver& operator=(const ThreadDriver&) = delete;

private:
    static constexpr std::int64_t poll = 250'000, mostHold = 20'000'000, longestBlock = 500'000'000; // ns
    void run();
    bool isOver() const noexcept { return isDestroyed_ || (ends_ != nullptr && *ends_); }

    Session& session_;
    const std::int64_t stepNs_;
    const std::atomic<bool>* const ends_;
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
    bool ownThread = true;    ///< a thread of its own steps the world; otherwise step() does
    std::string recordPath{}; ///< WAV file; empty: none
    std::string savePath{};   ///< session as JSON, with its event list beside it; empty: none
    Provenance provenance{};  ///< of the event list
};

/// A part of the rig that does not work, and its one-line error.
struct RigTrouble {
    std::string source; ///< "device", "events", the name of a sink, "journal" or "recording"
    std::string words;
    bool operator==(const RigTrouble&) const = default;
};

/// One line on events that were dropped because no device ran (DevicePulse); empty if there were none.
std::string droppedWords(std::uint64_t events);

/// All methods M only, except session() and those methods of it that any thread may call.
class Rig {
public:
    /// When `isEnded` (may be null; outlives the rig) becomes true, waits end and the world stops.
    Rig(RigSettings settings, AudioDrivers drivers, const std::atomic<bool>* isEnded = nullptr);
    ~Rig();
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    /// Opens sinks, device, recording and journal, in this order. Returns empty, or one line with the reason.
    std::string open();
    /// Only the first step, for programs that open devices when a user chooses them.
    std::string connectSinks();
    std::string openDevice(const AudioOutputSettings& wanted);

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

    /// Passes the events played since the last call to the sinks, and each to `take`.
    template <class Take>
    void takePlayed(Take take) {
        for (PlayedEvent played; session_.played().pop(played);) {
            session_.sinks().played(played, output_.sampleRateHz());
            take(played);
        }
    }

    /// Supervises the device; call about once a second.
    void maintain();
    /// Errors of the device and events that it did not run for (from the last maintain()), the sinks, the
    /// journal and the recording.
    std::vector<RigTrouble> troubles() const;
    /// All errors in one line; empty if there are none.
    std::string trouble() const;
    /// State of each sink.
    std::vector<SinkState> sinkStates() const;
    /// A report per sink, after stop(); waits up to a second for each. `trouble`: set to the first sink that
    /// does not play.
    std::string summary(std::string& trouble) const;

    /// Silences the device within two blocks. Then nothing is played, recorded or logged any more, and `take`
    /// has received every event.
    template <class Take>
    void stop(Take take) {
        output_.stop();
        takePlayed(take);
        endFiles();
    }
    /// Completes the files, after stop(); threads that use the session must have ended. Returns empty, or the
    /// reason. `isHurried`: a long session file stays a journal, which is read like a session file.
    std::string finish(bool isHurried);
    /// Closes the device, or abandons it to a driver that hangs, and detaches the sinks.
    void close();

private:
    static constexpr std::chrono::seconds patience{3}; // handshake, clock and Bluetooth take a second

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
    std::string deviceTrouble_, eventTrouble_;
    std::string recorded_; // why the recording is incomplete
    std::uint64_t toldDropped_ = 0;
};

} // namespace physvib
