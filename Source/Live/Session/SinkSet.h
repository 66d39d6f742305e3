// SPDX-License-Identifier: MIT
// The sinks of a session, which can be attached and detached while it plays.
#pragma once
#include "Live/Session/Sink.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

namespace physvib {

class SinkSet {
public:
    static constexpr std::size_t maxSinks = 16; ///< at once; a further one is not attached

    /// Attaches a sink, which must outlive the set or be detached before. Attach one with a latency before
    /// the session is prepared. Message thread (M), as the next ones.
    void attach(Sink& sink) {
        const std::lock_guard lock{mutex_};
        if (const auto place = std::ranges::find(sinks_, nullptr, at); place != sinks_.end())
            place->store(&sink, std::memory_order_release);
    }
    /// On return only the render thread (R) may still be inside the sink, until the next block, or while the
    /// output does not run.
    void detach(Sink& sink) {
        const std::lock_guard lock{mutex_};
        if (const auto place = std::ranges::find(sinks_, &sink, at); place != sinks_.end())
            place->store(nullptr, std::memory_order_release);
    }
    double latencySeconds() const noexcept {
        double largest = 0.0;
        each([&](const Sink& sink) { largest = std::max(largest, sink.latencySeconds()); });
        return largest;
    }
    void follow(OutputClock* device) {
        each([=](Sink& sink) { sink.follow(device); });
    }
    void played(const PlayedEvent& event, int sampleRateHz) {
        each([&](Sink& sink) { sink.played(event, sampleRateHz); });
    }
    /// Of all sinks that have something to display.
    std::vector<SinkState> states() const {
        std::vector<SinkState> all;
        each([&](const Sink& sink) {
            if (auto state = sink.state(); !state.name.empty()) all.push_back(std::move(state));
        });
        return all;
    }

    /// Any thread but R, unless its block is non-realtime.
    void made(const CollisionEvent& event) noexcept {
        const std::lock_guard lock{mutex_};
        each([&](Sink& sink) { sink.made(event); });
    }
    void posted(const RenderControl& control) noexcept {
        const std::lock_guard lock{mutex_};
        each([&](Sink& sink) { sink.posted(control); });
    }

    /// R, wait-free.
    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING {
        for (const auto& place : sinks_)
            if (Sink* sink = at(place)) sink->rendered(block);
    }

private:
    static Sink* at(const std::atomic<Sink*>& place) noexcept {
        return place.load(std::memory_order_acquire);
    }
    template <class Use>
    void each(Use use) const {
        for (const auto& place : sinks_)
            if (Sink* sink = at(place)) use(*sink);
    }

    std::mutex mutex_; // held by all callers of sinks except M and R
    std::array<std::atomic<Sink*>, maxSinks> sinks_{};
};

/// While it exists, the sinks follow the device, which must outlive it. M.
class Following {
public:
    Following(SinkSet& sinks, OutputClock& device)
        : sinks_{sinks} {
        sinks_.follow(&device);
    }
    ~Following() { sinks_.follow(nullptr); }
    Following(const Following&) = delete;
    Following& operator=(const Following&) = delete;

private:
    SinkSet& sinks_;
};

} // namespace physvib
