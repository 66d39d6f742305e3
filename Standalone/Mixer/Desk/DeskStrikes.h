// SPDX-License-Identifier: GPL-3.0-or-later
// Events that the mixer plays apart from the world: test pulses and sweeps of one actuator, material
// auditions, and clips.
#pragma once
#include "Mixer/Desk/DeskClips.h"
#include "Mixer/Desk/DeskWorld.h"

namespace physvib {

/// Message thread only.
class DeskStrikes {
public:
    /// All references outlive it. `onStrike` is called for each event; `onClip` when a clip was read (as for
    /// DeskClips) or failed.
    DeskStrikes(Session& session, const AudioOutput& output, const Mix& mix, const DeskWorld& world,
                std::function<void()> onStrike, std::function<void(const Result<std::string>&)> onClip);

    /// A pulse of one actuator, or a sweep over its range.
    void testPulse(int enchanter);
    void testSweep(int enchanter);

    /// An impact of that material of the scene at a place of the field, at the level of a test pulse. Empty,
    /// or an error.
    std::string audition(int material, double shareX, double shareY);

    /// Plays a dropped clip at a place of the field, or on one actuator only, when it has been read.
    void feelAt(const juce::StringArray& files, double shareX, double shareY);
    void feelOn(const juce::StringArray& files, int enchanter);
    /// Plays a recording, each channel on the actuator of its number, when it has been read.
    void playTake(const juce::File& file) { clips_.play(file); }

private:
    bool strike(std::vector<CollisionEvent> strikes, const EnchanterPlace& at);
    EnchanterPlace onField(double shareX, double shareY) const;
    EnchanterPlace placeOf(int enchanter) const;
    void feel(const juce::StringArray& files, const EnchanterPlace& at, bool isAlone);

    Session& session_;
    const Mix& mix_;
    const DeskWorld& world_;
    std::function<void()> onStrike_;
    std::function<void(const Result<std::string>&)> onClip_;
    DeskClips clips_; // destroyed first, because its thread uses the other members
};

} // namespace physvib
