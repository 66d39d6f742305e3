// SPDX-License-Identifier: MIT
// What a session goes to beside the device that asks for its blocks: a board, a file, messages, a picture.
// Each takes what it has a use for; a session knows none of them by name.
#pragma once
#include "Core/Nonblocking.h"
#include "Core/RenderControl.h"
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace physvib {

class FeltOutput;

/// A block as it leaves the session, before the master level.
struct RenderedBlock {
    const float* const* channels;
    int frames;
    std::int64_t sessionFrame; ///< of its first one
    int sampleRateHz;
};

/// A moment of a sink, for people.
struct SinkState {
    struct Fact {
        std::string name, value;
        bool isWrong = false;
    };
    std::string name{};               ///< as "board"; empty: there is nothing to say
    bool isReady = false;             ///< it plays what is made now
    int channels = 0;                 ///< it plays the first so many enchanters; 0: all
    std::uint64_t sent = 0, lost = 0; ///< events
    std::string trouble{};            ///< one line; empty: all is well
    std::string where{};              ///< what it plays on, or how far it is, in a line
    std::vector<Fact> facts{};
    bool playsClips = true; ///< and recordings
};

class Sink {
public:
    virtual ~Sink() = default;

    /// Waits until it can play; empty, or why it cannot. M, before the session that it is attached to is
    /// prepared.
    virtual std::string awaitReady(const std::function<bool()>&) { return {}; }

    /// How long before it is felt it has to know an event: L covers the largest of all that are attached. M.
    virtual double latencySeconds() const noexcept { return 0.0; }

    /// From now on what it plays is felt together with that device: its blocks say when, its level and
    /// silence hold here as well, and whoever follows looks at them as often as it plays. Null: nobody; what
    /// plays stops, and no thread of its own is in the device when this returns. M.
    virtual void follow(FeltOutput*) {}

    /// What the world makes, at once, in time order; not what is born in the render call. Whoever holds the
    /// world, wait-free.
    virtual void made(const CollisionEvent&) noexcept {}
    /// What is posted, in order. Whoever holds the inputs, wait-free.
    virtual void posted(const RenderControl&) noexcept {}
    /// What was played, of a session at this rate. M.
    virtual void played(const PlayedEvent&, int) {}
    /// R, wait-free.
    virtual void rendered(const RenderedBlock&) noexcept PHYSVIB_NONBLOCKING {}

    /// M.
    virtual SinkState state() const { return {}; }
    /// What it has done, in lines, once nothing is played any more; may wait a second for it, as long as
    /// `goesOn`. M.
    virtual std::string summary(const std::function<bool()>&) const { return {}; }
};

} // namespace physvib
