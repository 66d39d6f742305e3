// SPDX-License-Identifier: GPL-3.0-or-later
// The device that the desk is felt on, as it was chosen, and what is wrong with it and what is beside it.
#pragma once
#include "Host/Rig/Rig.h"
#include "Mixer/Desk/DeskListening.h"

namespace physvib {

/// M only.
class DeskDevice {
public:
    /// Both outlive it. `onChange` as of DeskListening.
    DeskDevice(Rig& rig, AudioDeviceTypes types, const Mix& mix, std::function<void()> onChange)
        : rig_{rig}
        , types_{std::move(types)}
        , mix_{mix}
        , listening_{rig.output(), mix, choice_, std::move(onChange)} {}

    /// Empty, or why not: trouble() as well.
    std::string open(const DeviceChoice& choice);

    /// What was chosen, of which devices; and how many outputs there are.
    const DeviceChoice& choice() const noexcept { return choice_; }
    const AudioDeviceTypes& types() const noexcept { return types_; }
    int outputs() const { return rig_.output().deviceOutputs(); }

    DeskListening& listening() noexcept { return listening_; }
    const DeskListening& listening() const noexcept { return listening_; }

    double playOutSeconds() const noexcept {
        const int rateHz = rig_.output().sampleRateHz();
        return rateHz > 0 ? static_cast<double>(rig_.session().timeline().playOutFrames()) / rateHz : 0.0;
    }

    /// The mix has other enchanters, or other outputs for them. Empty, or why they cannot be.
    std::string assign();

    /// What is beside the device and plays no clips, by its name; empty: all plays them.
    juce::String withoutClips() const;
    /// The choice has other sinks: L is another then, so the session has to begin anew.
    std::function<void(const DeviceChoice&)> onSinksWanted;

    /// Looks after them, often; and one line on what is wrong.
    void maintain();
    juce::String trouble() const;

private:
    std::vector<int> outputMap() const;

    Rig& rig_;
    AudioDeviceTypes types_;
    const Mix& mix_;
    DeviceChoice choice_;
    DeskListening listening_;
    double maintainedAtMs_ = 0.0;
};

} // namespace physvib
