// SPDX-License-Identifier: MIT
// Interface of the outputs that a session feeds beside its audio device (a board, a file, messages, a
// display), and the set of them. Each output overrides the methods that it needs.
#pragma once
#include "Core/Nonblocking.h"
#include "Core/RenderControl.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {
class OutputClock;

/// A block as the session renders it, before the master level.
struct RenderedBlock {
    const float* const* channels;
    int frames;
    std::int64_t sessionFrame; ///< of its first frame
    int sampleRateHz;
    int count = 0; ///< of the channels, those that no actuator has now included
};

/// Status of a sink, for display.
struct SinkState {
    struct Detail {
        std::string name, value;
        bool isError = false;
    };
    std::string name{};               ///< e.g. "board"; empty: nothing to display
    bool isReady = false;             ///< true: the sink can play events now
    int channels = 0;                 ///< number of actuators that it plays, from the first on; 0: all
    std::uint64_t sent = 0, lost = 0; ///< events
    std::string error{};              ///< one-line error; empty: none
    std::string label{};              ///< one line: port or device, or how far connecting has got
    std::vector<Detail> details{};
    bool playsClips = true; ///< plays clips and recordings
};

/// An output beside the device. By default its methods do nothing.
class Sink {
public:
    virtual ~Sink() = default;

    /// Waits until it can play. Empty, or the error. Message thread (M), before the session is prepared.
    virtual std::string awaitReady(const std::function<bool()>&) { return {}; }

    /// Time by which it needs an event before it is felt; the output latency covers the maximum over all
    /// attached sinks. M.
    virtual double latencySeconds() const noexcept { return 0.0; }

    /// From now on it plays in sync with that device: the device's blocks give the time, and its level and
    /// mute apply here too. Null: none; it stops playing, and on return its threads no longer use the device.
    /// M.
    virtual void follow(OutputClock*) {}

    /// Collisions of the world, at once and in time order; not events of the render call. On the thread that
    /// holds the world mutex, wait-free.
    virtual void onCollision(const CollisionEvent&) noexcept {}
    /// Posted controls, in order; their panners stay only during the call. On the thread that holds the input
    /// mutex; it may allocate.
    virtual void onControl(const RenderControl&) noexcept {}
    /// An event that was played, of a session at this sample rate. M.
    virtual void onPlayed(const PlayedEvent&, int) {}
    /// Render thread (R), wait-free.
    virtual void onBlock(const RenderedBlock&) noexcept PHYSVIB_NONBLOCKING {}

    /// The status for display. M.
    virtual SinkState state() const { return {}; }
    /// Lines on what it has done, after playing. May wait a second for data while `keepGoing` is true. M.
    virtual std::string summary(const std::function<bool()>&) const { return {}; }
};

// The sinks of a session, which can be attached and detached while it plays.

class SinkSet {
public:
    static constexpr std::size_t maxSinks = 16; ///< at once; a further one is not attached

    /// Attaches a sink, which must outlive the set or be detached before. Attach one with a latency before
    /// the session is prepared. Message thread (M), as the next ones.
    void attach(Sink& sink) {
        const std::lock_guard lock{mutex_};
        if (const auto slot = std::ranges::find(sinks_, nullptr, load); slot != sinks_.end())
            slot->store(&sink, std::memory_order_release);
    }
    /// When this returns, no thread but the render thread (R) is inside the sink; R leaves it before its next
    /// block.
    void detach(Sink& sink) {
        const std::lock_guard lock{mutex_};
        if (const auto slot = std::ranges::find(sinks_, &sink, load); slot != sinks_.end())
            slot->store(nullptr, std::memory_order_release);
    }
    double latencySeconds() const noexcept {
        double maxSeconds = 0.0;
        forEach([&](const Sink& sink) { maxSeconds = std::max(maxSeconds, sink.latencySeconds()); });
        return maxSeconds;
    }
    void follow(OutputClock* device) {
        forEach([=](Sink& sink) { sink.follow(device); });
    }
    void onPlayed(const PlayedEvent& event, int sampleRateHz) {
        forEach([&](Sink& sink) { sink.onPlayed(event, sampleRateHz); });
    }
    /// States of all sinks that have something to display.
    std::vector<SinkState> states() const {
        std::vector<SinkState> all;
        forEach([&](const Sink& sink) {
            if (auto state = sink.state(); !state.name.empty()) all.push_back(std::move(state));
        });
        return all;
    }

    /// Any thread but R, unless its block is non-realtime.
    void onCollision(const CollisionEvent& event) noexcept {
        const std::lock_guard lock{mutex_};
        forEach([&](Sink& sink) { sink.onCollision(event); });
    }
    void onControl(const RenderControl& control) noexcept {
        const std::lock_guard lock{mutex_};
        forEach([&](Sink& sink) { sink.onControl(control); });
    }

    /// R, wait-free.
    void onBlock(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING {
        for (const auto& slot : sinks_)
            if (Sink* sink = load(slot)) sink->onBlock(block);
    }

private:
    static Sink* load(const std::atomic<Sink*>& slot) noexcept {
        return slot.load(std::memory_order_acquire);
    }
    template <class Use>
    void forEach(Use use) const {
        for (const auto& slot : sinks_)
            if (Sink* sink = load(slot)) use(*sink);
    }

    std::mutex mutex_; // held by all callers of sinks except M and R
    std::array<std::atomic<Sink*>, maxSinks> sinks_{};
};

/// Makes the sinks follow the device, which must outlive this object, until its destruction. M.
class ScopedFollow {
public:
    ScopedFollow(SinkSet& sinks, OutputClock& device)
        : sinks_{sinks} {
        sinks_.follow(&device);
    }
    ~ScopedFollow() { sinks_.follow(nullptr); }
    ScopedFollow(const ScopedFollow&) = delete;
    ScopedFollow& operator=(const ScopedFollow&) = delete;

private:
    SinkSet& sinks_;
};

} // namespace physvib
