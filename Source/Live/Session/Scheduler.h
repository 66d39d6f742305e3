// SPDX-License-Identifier: MIT
// Processes all inputs to a session from outside: checks them, gives them a time, logs them, and passes them
// to the world or the renderer.
#pragma once
#include "Core/ControlQueue.h"
#include "Io/Result.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/Input.h"
#include "Live/Session/WorldRunner.h"
#include "Scene/World/InputCheck.h"
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

namespace physvib {

/// Part of a session; Session documents these methods. Its mutex is locked before the world's.
class Scheduler {
public:
    /// All must outlive it.
    Scheduler(const SessionSetup& setup, const Timeline& time, DevicePulse& pulse, WorldRunner& world,
              RenderedChannels& channels, SinkSet& sinks);

    Result<std::int64_t> submit(Input input);
    std::optional<int> keepClip(std::span<const ContactRecording> channels);
    PhantomPanner panner() const;
    std::int64_t readLog(SessionLog& log);

    /// Sends the lanes' gains at the world's time to the renderer. World driver (D).
    void followLanes();

    /// Sends the stops that are due to the renderer. Any thread but R in a realtime block.
    void takeDueStops();

    /// The next control for the renderer; false: none. R, wait-free.
    bool pop(RenderControl& control) noexcept { return controls_.pop(control); }

private:
    friend class Session;
    static constexpr std::int64_t never = INT64_MAX;
    static constexpr std::size_t mostStops = 256;

    // The mutex must be held.
    void prepare();
    RecordedContacts contactsAt(int sampleRateHz) { return recordings_.at(sampleRateHz, played_); }
    Result<std::int64_t> submit(const Action& action, std::int64_t timeNs) {
        return submit(std::span{&action, 1}, timeNs);
    }
    Result<std::int64_t> submit(std::span<const Action> actions, std::int64_t timeNs);
    Result<std::int64_t> submit(RenderControl& control, std::int64_t timeNs);
    Result<std::int64_t> submit(PlayedRecordings& recordings, std::int64_t timeNs);
    Result<std::int64_t> submit(const Strikes& strikes, std::int64_t timeNs);
    Result<std::int64_t> submit(const Stop&, std::int64_t timeNs);
    Result<std::int64_t> submit(Lanes& lanes, std::int64_t timeNs);
    std::int64_t toldNs() const noexcept { return std::max<std::int64_t>(0, time_.nowNs() - time_.leadNs()); }
    bool post(RenderControl& control);
    void postDueStops(std::int64_t untilNs);
    bool hasRoomFor(std::span<const ClipSound> channels) const;
    int logClip(std::span<const ContactRecording> channels);

    const SessionSetup& setup_;
    const bool isLogged_;
    const Timeline& time_;
    DevicePulse& pulse_;
    WorldRunner& world_;
    RenderedChannels& channels_;
    SinkSet& sinks_;
    ControlQueue<256> controls_;
    std::atomic<std::int64_t> nextStopNs_{never}; // the first of stops_; readable without the mutex
    std::atomic<bool> follows_{false};            // there are lanes; readable without the mutex

    mutable std::mutex mutex_; // guards the following members, and the producer's side of controls_
    std::optional<InputCheck> check_;
    std::size_t checkedTake_ = 0;
    RecordingSets recordings_;
    std::vector<ContactRecording> played_; // the recordings in use
    std::vector<ClipFile> clips_;          // in the order of recordings_
    SessionLog log_;                       // without scene runs; entries that have not been read
    PhantomPanner panner_;
    std::int64_t lastControlNs_ = 0;
    std::vector<std::int64_t> stops_; // in the future, in time order
    std::shared_ptr<const Mix> followed_;
    std::array<float, limits::maxEnchanters> followedGains_{}; // last value sent; NaN: set otherwise
    std::int64_t followedSceneNs_ = -1; // scene time up to which lanes have been followed
    std::size_t followedTake_ = 0;
};

} // namespace physvib
