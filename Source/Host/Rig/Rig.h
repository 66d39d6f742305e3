// SPDX-License-Identifier: GPL-3.0-or-later
// A live session with all that it takes: a device, what plays beside it, who steps the world, what is kept of
// it. Every program that plays has one.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Host/Devices/SimulationDriver.h"
#include "Host/Devices/SinkTable.h"
#include "Host/Recordings/PlayedRecorder.h"
#include "Live/Session/SessionJournal.h"
#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace physvib {

struct RigSettings {
    SessionSetup setup;
    AudioOutputSettings output{};
    std::vector<SinkName> sinks{}; ///< to be felt together with the device
    bool awaitsSinks = true;       ///< open() waits for them; else each comes when it comes
    bool ownThread = true;         ///< steps the world; else the message thread's timer
    std::string recordPath{};      ///< WAV; empty: none
    std::string savePath{};        ///< session as JSON, its events beside it; empty: none
    Provenance provenance{};       ///< of that list of events
};

/// All methods M only, session() and what any thread may call of it apart.
class Rig {
public:
    /// `isEnded`, which outlives the rig: what waits waits no more, and the world stands still.
    Rig(RigSettings settings, AudioDeviceTypes types, const std::atomic<bool>* isEnded = nullptr);
    ~Rig();
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    /// Sinks, device, recording and journal, in this order; empty, or one line with the reason.
    std::string open();
    /// The first part alone, for whoever opens devices as a user chooses them.
    std::string connectSinks();
    std::string openDevice(const AudioOutputSettings& wanted);

    /// From now on the world moves, and what is beside the device follows it.
    void start();

    Session& session() noexcept { return session_; }
    const Session& session() const noexcept { return session_; }
    AudioOutput& output() noexcept { return output_; }
    const AudioOutput& output() const noexcept { return output_; }
    const RigSettings& settings() const noexcept { return settings_; }
    InputTap* inputs() noexcept { return inputs_.get(); } ///< what the device hears; null: nothing is wanted
    const PlayedRecorder* recording() const noexcept { return recording_ ? &*recording_ : nullptr; }

    /// What was played since the last call goes to all that wants it, and each to `take`.
    template <class Take>
    void takePlayed(Take take) {
        for (PlayedEvent played; session_.played().pop(played);) {
            session_.sinks().played(played, output_.sampleRateHz());
            take(played);
        }
    }

    /// Looks after the device, about once a second.
    void maintain() { deviceTrouble_ = output_.maintain(); }
    /// What is wrong with the device, as maintain() found it, with what is beside it and with what is kept,
    /// in one line; empty: all is well.
    std::string trouble() const;
    /// Of what is beside the device.
    std::vector<SinkState> sinkStates() const;
    /// What each of them has done, in lines, once it has stopped; waits a second for it. `trouble`: of the
    /// first that does not play.
    std::string summary(std::string& trouble) const;

    /// Silent within two blocks. Then nothing is played, recorded or listed any more, and `take` has had all.
    template <class Take>
    void stop(Take take) {
        output_.stop();
        takePlayed(take);
        endFiles();
    }
    /// What is kept is whole; empty, or why not. After stop(); what has threads that use the session has
    /// ended before. `isHurried`: a long session file stays a journal, which is read alike.
    std::string finish(bool isHurried);
    /// The device is closed, or left to a driver that hangs; nothing is beside it.
    void close();

private:
    static constexpr std::chrono::seconds patience{3}; // greeting, clock and Bluetooth take a second

    bool goesOn() const noexcept { return isEnded_ == nullptr || !*isEnded_; }
    std::string beginRecording();
    std::string beginJournal();
    void endFiles();

    RigSettings settings_;
    const std::atomic<bool>* isEnded_;
    Sinks sinks_; // outlive the session, as what follows the output
    Session session_;
    std::unique_ptr<InputTap> inputs_;
    std::optional<PlayedRecorder> recording_;
    std::optional<SessionJournal> journal_;
    AudioOutput output_;
    std::unique_ptr<SimulationDriver> driver_;
    std::chrono::steady_clock::time_point connectedAt_;
    std::string deviceTrouble_, recorded_; // the latter: why the recording is not whole
};

} // namespace physvib
