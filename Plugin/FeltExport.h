// SPDX-License-Identifier: GPL-3.0-or-later
// Export of played events for other programs: MIDI, an event list, or a haptic file.
#pragma once
#include "Takes.h"
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct PluginState;

/// The events of the newest run, as many as are worth a file. M only.
class FeltEvents {
public:
    static constexpr std::size_t mostKept = 65536; ///< events; beyond that the oldest are dropped

    /// Appends what drainLog() returned; runs count from 1 after each of `prepares` preparations.
    void add(std::uint64_t prepares, std::span<const TakeEvent> events);

    /// Playable, in time order, the first at 0 if `fromFirst`, else from the run's beginning.
    std::vector<CollisionEvent> events(bool fromFirst) const;
    /// How many earlier events of that run were dropped.
    std::uint64_t leftOut() const noexcept { return told_ - events_.size(); }
    bool areThere() const noexcept { return !events_.empty(); }

private:
    std::vector<CollisionEvent> events_;
    std::uint64_t prepares_ = 0, told_ = 0;
    int run_ = 0;
};

/// Events and how they are spread over the actuators.
struct FeltExport {
    std::span<const CollisionEvent> events; ///< playable, in time order
    const PluginState& state;
    PhantomPanner panner;
};

/// File endings that exportFelt writes. M only.
std::vector<std::string_view> feltEndings();

/// The file, or files (a format of one channel has one for each actuator), by the ending of `path`. A line
/// for people on what was written, or one line with the reason, and nothing is written. Levels are as struck:
/// strips and level are not in them. M only.
Result<std::string> exportFelt(const FeltExport& felt, const std::string& path);

/// The same as a MIDI file: the nearest note, the actuator that feels it most as the channel (from 1),
/// amplitudes as velocities of the largest. Of a held note's row of strikes one note is made. M only.
std::string midiOf(const FeltExport& felt);

} // namespace physvib
