// SPDX-License-Identifier: GPL-3.0-or-later
// Export of played events for other programs: MIDI, an event list, or a haptic file.
#pragma once
#include "PluginRuns.h"
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct PluginState;

/// The played events of the newest run, at most `maxEvents` of them. M only.
class PlayedEvents {
public:
    static constexpr std::size_t maxEvents = 65536; ///< events; beyond that the oldest are dropped

    /// Appends what drainLog() returned. `prepareCount` counts the calls of prepare(), where runs begin at 1.
    void add(std::uint64_t prepareCount, std::span<const RunEvent> events);

    /// Playable events in time order. Time 0 is the first event if `fromFirst`, else the run's beginning.
    std::vector<CollisionEvent> events(bool fromFirst) const;
    /// How many earlier events of that run were dropped.
    std::uint64_t droppedCount() const noexcept { return totalEvents_ - events_.size(); }
    bool hasEvents() const noexcept { return !events_.empty(); }
    /// Drops them if they were played with other settings than those.
    void keepOnly(std::uint64_t generation) {
        if (generation != generation_) *this = {};
    }

private:
    std::vector<CollisionEvent> events_;
    std::uint64_t prepareCount_ = 0, totalEvents_ = 0, generation_ = 0;
    int run_ = 0;
};

/// Events and how they are spread over the actuators.
struct PlayedExport {
    std::span<const CollisionEvent> events; ///< playable, in time order
    const PluginState& state;
    PhantomPanner panner;
};

/// Endings of files that exportPlayed() can write. M only.
std::vector<std::string_view> playedEndings();

/// Writes a file by the ending of `path`, or one for each actuator if the format has one channel. Returns a
/// line for the user, or an error, and then nothing is written. Strips and level are not applied. M only.
Result<std::string> exportPlayed(const PlayedExport& source, const std::string& path);

/// The events as a MIDI file: the nearest note, the loudest actuator as the channel (from 1), amplitudes as
/// velocities relative to the largest. The strikes of a held note become one note. M only.
std::string midiFileBytes(const PlayedExport& source);

} // namespace physvib
