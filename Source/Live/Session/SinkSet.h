// SPDX-License-Identifier: MIT
// The sinks of a session, each at its own time attached and taken off.
#pragma once
#include "Live/Session/Sink.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

namespace physvib {

class SinkSet {
public:
    static constexpr std::size_t most = 16; ///< at once; one more is not attached

    /// It outlives the set, or is taken off before. One whose latency counts comes before the session is
    /// prepared. M, as what follows.
    void attach(Sink& sink) {
        const std::lock_guard lock{mutex_};
        if (const auto place = std::ranges::find(sinks_, nullptr, at); place != sinks_.end())
            place->store(&sink, std::memory_order_release);
    }
    /// Only R may still be in it when this returns: until a further block has come, or the output does not
    /// run.
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
    void follow(FeltOutput* device) {
        each([=](Sink& sink) { sink.follow(device); });
    }
    void played(const PlayedEvent& event, int sampleRateHz) {
        each([&](Sink& sink) { sink.played(event, sampleRateHz); });
    }
    /// Of all that have something to say.
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

    std::mutex mutex_; // nobody but M and R is in a sink without it
    std::array<std::atomic<Sink*>, most> sinks_{};
};

/// While it lives, the sinks follow the device, which outlives it. M.
class Following {
public:
    Following(SinkSet& sinks, FeltOutput& device)
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
