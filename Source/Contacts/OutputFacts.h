// SPDX-License-Identifier: MIT
// What is known of the output that plays a world's events, to explain silence that the world cannot see.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib {

class PhantomPanner;
struct ContactCounts;

/// The owner of the renderer or device fills it in.
struct OutputFacts {
    bool isMissing = false;                ///< no device asks for samples
    bool isSilent = false;                 ///< silence is held
    std::string_view silentBy{};           ///< by whom, in words; empty: unknown
    std::string_view trouble{};            ///< error of the device, in one line
    int channels = 0;                      ///< that the device plays; 0: all of the layout
    double levelGain = 1.0;                ///< gain of all channels
    std::uint64_t mutedChannels = 0;       ///< bit j: channel j is muted, or its gain is 0
    std::uint64_t late = 0;                ///< events played after their time, since the last explanation
    std::uint64_t dropped = 0;             ///< events for which the queue had no room, since then
    std::uint64_t rejected = 0;            ///< events that cannot be played, since then
    const PhantomPanner* panner = nullptr; ///< layout and field of later events; null: unknown
};

/// Why events that were made are not felt, as one sentence with names of physvib.h; empty: no reason is
/// known. Any thread.
std::string outputReason(const ContactCounts& made, const OutputFacts& output);

} // namespace physvib
