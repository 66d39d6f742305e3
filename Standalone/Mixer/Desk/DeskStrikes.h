// SPDX-License-Identifier: GPL-3.0-or-later
// What the desk plays apart from the world: pulses and sweeps of one enchanter, a material to be felt, clips.
#pragma once
#include "Mixer/Desk/DeskClips.h"
#include "Mixer/Desk/DeskWorld.h"

namespace physvib {

/// M only.
class DeskStrikes {
public:
    /// All outlive it. `onStrike` is called for each; `onClip` when a clip has been read, as DeskClips does,
    /// or that it cannot be.
    DeskStrikes(Session& session, const AudioOutput& output, const Mix& mix, const DeskWorld& world,
                std::function<void()> onStrike, std::function<void(const Result<std::string>&)> onClip);

    /// A pulse of one enchanter, or a sweep of its range.
    void testPulse(int enchanter);
    void testSweep(int enchanter);

    /// A hit of that material of the world's scene at a place of the field, as strong as a test pulse. Empty,
    /// or why not.
    std::string audition(int material, double shareX, double shareY);

    /// A clip that is dropped, at a place of the field or on one enchanter alone: felt when it has been read.
    void feelAt(const juce::StringArray& files, double shareX, double shareY);
    void feelOn(const juce::StringArray& files, int enchanter);

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
    DeskClips clips_; // last: its thread uses the others
};

} // namespace physvib
