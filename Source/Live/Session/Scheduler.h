// SPDX-License-Identifier: MIT
// Inputs to a session. CallbackInputs takes those of the render call (R is the render thread, M the message
// thread); Scheduler checks, times, logs and passes on all others; InputQueue connects two threads.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/ControlQueue.h"
#include "Core/RenderControl.h"
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/SessionSetup.h"
#include "Live/Session/Timeline.h"
#include "Live/Session/WorldRunner.h"
#include "Scene/Scene.h"
#include "Scene/World/InputCheck.h"
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

// Inputs that arrive in the render call itself (MIDI, automation), on their way to the renderer and the
// world.

class SessionWorld;

// Interface of a source of samples, such as incoming audio, that a session mixes with the rendered events.

/// Mixed before the actuators' own stages: level, equaliser, delay and limiter act on all samples alike.
class SampleSource {
public:
    /// The renderer's frames from `frame` on (session time in frames), at most limits::tileFrames. One
    /// pointer per channel of the session; null: silence. Valid until the next call. R, wait-free.
    virtual const float* const* samplesFrom(std::int64_t frame, int frames) noexcept = 0;

protected:
    ~SampleSource() = default;
};

/// The part of a session that queues inputs of the render call.
class CallbackInputs {
public:
    /// `frame`: frames into the block that is rendered next. The event is felt at an exact frame: the
    /// output latency later, or the renderer's latency later if the session is direct. False, and counted,
    /// if the queue is full. Render thread (R), wait-free.
    bool strike(CollisionEvent event, int frame) noexcept { return strike(event, frame, 0); }
    /// Strikes `afterNs` after that frame; the time may be in the past.
    bool strike(CollisionEvent event, int frame, std::int64_t afterNs) noexcept;
    /// Copies the control's panner; at most 16 panners can wait.
    bool control(RenderControl control, int frame) noexcept;
    bool postInput(RenderInput input, int frame) noexcept; ///< acts in the world's next step, if there is one

    /// Acts at once, without the output latency: sounding modes fade, and earlier events are no longer
    /// played. R, wait-free.
    bool silence(int frame) noexcept;

    /// Mixes in these samples from now on; they must outlive the session. M, not while rendering.
    void add(SampleSource& samples) noexcept { samples_ = &samples; }

private:
    friend class Session;
    friend class WorldRunner;

    /// Both outlive it; of `setup` it uses the shaping of events and the groups of actions.
    CallbackInputs(const Timeline& time, const SessionSetup& setup)
        : time_{time}
        , hasWorld_{setup.hasWorld}
        , shaping_{setup.shaping}
        , groups_{setup.groups} {}

    /// Discards everything queued and spawned. M, not while rendering, with the world mutex held.
    void clear() noexcept;

    /// The next item for the renderer; false: none. R, wait-free.
    bool popStrike(CollisionEvent& strike) noexcept { return strikes_.pop(strike); }
    bool popControl(RenderControl& control) noexcept { return controls_.pop(control); }

    /// Passes R's actions to the world. On the thread that holds the world mutex.
    void passInputsTo(SessionWorld& world);

    /// Items that did not fit the queues. Any thread, wait-free.
    std::uint64_t refused() const noexcept {
        return strikes_.overflows() + controls_.overflows() + inputs_.overflows();
    }

    void addBody(SessionWorld& world, std::int64_t timeNs, SpawnAction action);

    const Timeline& time_;
    const bool hasWorld_;
    const EventShaping shaping_;
    const std::vector<std::vector<Action>>& groups_;
    EventQueue<CollisionEvent, 1024> strikes_; // written and read by R: a dense chord in 8192 frames
    ControlQueue<128, 16> controls_;           // senders limit their rate
    EventQueue<RenderInput, 1024> inputs_;     // from R to the thread that steps the world
    SampleSource* samples_ = nullptr;
    std::uint64_t spawnCount_ = 0;          // the world mutex guards this and bodyNames_
    std::array<std::string, 64> bodyNames_; // of the newest bodies that R spawned
};

// The inputs to a session from outside: by mouse, text line, message, program or sequencer.

/// Events that no world produced (a test pulse, a material preview), at their own times after the input's.
/// The caller keeps them alive during the call.
struct Strikes {
    std::span<const CollisionEvent> events;
    bool canBeStopped = false; ///< events wait in the session until their time; a Stop can discard them
};

/// Fades out what sounds, and discards pending events from its time on.
struct Stop {};

/// Recordings that events play instead of modes; empty: modes. Sounding recordings fade out.
struct PlayedRecordings {
    std::vector<ContactRecording> recordings;
};

/// From now on gain lanes (automation) follow the scene's time, for each strip that has one itself or in its
/// group. They act at the world's steps like moved faders, and are logged. A gain that is set otherwise
/// holds until the scene time advances.
struct Lanes {
    std::shared_ptr<const Mix> mix; ///< null: no lanes
};

/// One input of any kind, and its time.
struct Input {
    static constexpr std::int64_t now = std::numeric_limits<std::int64_t>::min();

    /// An Action acts in the world; a RenderControl changes how later events are rendered. Of several
    /// edits, which the caller keeps alive during the call, all act or none.
    std::variant<Action, std::span<const Action>, RenderControl, PlayedRecordings, Strikes, Stop, Lanes> what;
    /// Session time at which it acts. Strikes and Stop may be in the future; if that time is past they are
    /// late. All other inputs act now.
    std::int64_t timeNs = now;
};

// Bounded queue from a thread that reads input to a thread that acts on it. The reader is never blocked, so
// it can react to a request for silence further behind.

/// One thread pushes, another pops. Neither may be the render thread (R).
template <class Item>
class InputQueue {
public:
    static constexpr std::size_t maxBytes = 16 << 20; ///< limit for pending items
    static constexpr std::size_t itemBytes = 256;     ///< counted per item beside its text

    /// False, and nothing changes, while the queue is full.
    bool push(Item&& item, std::size_t textBytes) {
        const std::size_t bytes = textBytes + itemBytes;
        {
            const std::lock_guard lock{mutex_};
            if (bytes_ + bytes > maxBytes) return false;
            items_.emplace_back(std::move(item), bytes);
            bytes_ += bytes;
        }
        itemAdded_.notify_one();
        return true;
    }

    /// Waits for an item; false after the time-out.
    bool wait(std::chrono::milliseconds timeOut) {
        std::unique_lock lock{mutex_};
        return itemAdded_.wait_for(lock, timeOut, [this] { return !items_.empty(); });
    }

    /// The first item, if any.
    std::optional<Item> pop() {
        const std::lock_guard lock{mutex_};
        if (items_.empty()) return std::nullopt;
        std::optional<Item> item{std::move(items_.front().first)};
        bytes_ -= items_.front().second;
        items_.pop_front();
        return item;
    }

private:
    std::mutex mutex_; // guards the following members
    std::condition_variable itemAdded_;
    std::deque<std::pair<Item, std::size_t>> items_; // with their sizes in bytes
    std::size_t bytes_ = 0;
};

/// Takes inputs from outside the render call, as Session documents. Its mutex is locked before the world's.
class Scheduler {
public:
    /// All must outlive it.
    Scheduler(const SessionSetup& setup, const Timeline& time, DevicePulse& pulse, WorldRunner& world,
              RenderedChannels& channels, SinkSet& sinks);

    Result<std::int64_t> submit(Input input);
    std::optional<int> addClip(std::span<const ContactRecording> channels);
    PhantomPanner panner() const;
    std::int64_t readLog(SessionLog& log);

    /// Sends the lanes' gains at the world's time to the renderer. World driver (D).
    void followLanes();

    /// Sends the stops that are due to the renderer. Any thread but R in a realtime block.
    void sendDueStops();

    /// The next control for the renderer; false: none. R, wait-free.
    bool pop(RenderControl& control) noexcept { return controls_.pop(control); }

private:
    friend class Session;
    static constexpr std::int64_t never = INT64_MAX;
    static constexpr std::size_t maxStops = 256;

    // The mutex must be held.
    void prepare();
    RecordedContacts contactsAt(int sampleRateHz) { return recordings_.contacts(sampleRateHz, activeSet_); }
    Result<std::int64_t> submit(const Action& action, std::int64_t timeNs) {
        return submit(std::span{&action, 1}, timeNs);
    }
    Result<std::int64_t> submit(std::span<const Action> actions, std::int64_t timeNs);
    Result<std::int64_t> submit(RenderControl& control, std::int64_t timeNs);
    Result<std::int64_t> submit(PlayedRecordings& recordings, std::int64_t timeNs);
    Result<std::int64_t> submit(const Strikes& strikes, std::int64_t timeNs);
    Result<std::int64_t> submit(const Stop&, std::int64_t timeNs);
    Result<std::int64_t> submit(Lanes& lanes, std::int64_t timeNs);
    std::int64_t earliestNs() const noexcept {
        return std::max<std::int64_t>(0, time_.nowNs() - time_.leadNs());
    }
    bool post(RenderControl& control);
    void postDueStops(std::int64_t untilNs);
    bool hasRoomFor(std::span<const ClipSound> channels) const;

    const SessionSetup& setup_;
    const bool isLogged_;
    const Timeline& time_;
    DevicePulse& pulse_;
    WorldRunner& world_;
    RenderedChannels& channels_;
    SinkSet& sinks_;
    ControlQueue<256> controls_;
    std::atomic<std::int64_t> nextStopNs_{never}; // the first of stops_; readable without the mutex
    std::atomic<bool> hasLanes_{false};           // there are lanes; readable without the mutex

    mutable std::mutex mutex_; // guards the following members, and the producer's side of controls_
    std::optional<InputCheck> check_;
    std::size_t checkedRun_ = 0;
    RecordingSets recordings_;
    std::vector<ContactRecording> activeSet_; // the recordings in use
    std::vector<ClipFile> clips_;             // in the order of recordings_
    SessionLog log_;                          // without scene runs; entries that have not been read
    PhantomPanner panner_;
    std::int64_t lastControlNs_ = 0;
    std::vector<std::int64_t> stops_; // times of future stops, in order
    std::shared_ptr<const Mix> lanesMix_;
    std::array<float, limits::maxActuators> followedGains_{}; // last value sent; NaN: set otherwise
    std::int64_t followedSceneNs_ = -1; // scene time up to which lanes have been followed
    std::size_t followedRun_ = 0;
};

} // namespace physvib
