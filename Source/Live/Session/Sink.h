// SPDX-License-Identifier: MIT
// Interface of outputs that a session feeds beside its audio device: a board, a file, messages, a display.
// Each overrides the methods that it needs.
#pragma once
#include "Core/Nonblocking.h"
#include "Core/RenderControl.h"
#include <cstdint>
#include <functional>
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
};

/// Status of a sink, for display.
struct SinkState {
    struct Fact {
        std::string name, value;
        bool isWrong = false;
    };
    std::string name{};               ///< e.g. "board"; empty: nothing to display
    bool isReady = false;             ///< it can play new events now
    int channels = 0;                 ///< number of actuators that it plays, from the first on; 0: all
    std::uint64_t sent = 0, lost = 0; ///< events
    std::string trouble{};            ///< one-line error; empty: none
    std::string where{};              ///< one line: the port or device, or the progress of connecting
    std::vector<Fact> facts{};
    bool playsClips = true; ///< and recordings
};

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
    virtual void made(const CollisionEvent&) noexcept {}
    /// Posted controls, in order; their panners stay only during the call. On the thread that holds the input
    /// mutex; it may allocate.
    virtual void posted(const RenderControl&) noexcept {}
    /// An event that was played, of a session at this sample rate. M.
    virtual void played(const PlayedEvent&, int) {}
    /// Render thread (R), wait-free.
    virtual void rendered(const RenderedBlock&) noexcept PHYSVIB_NONBLOCKING {}

    /// M.
    virtual SinkState state() const { return {}; }
    /// Lines on what it has done, after the end of playing. May wait a second for data while `keepGoing`
    /// returns true. M.
    virtual std::string summary(const std::function<bool()>&) const { return {}; }
};

} // namespace physvib
