// SPDX-License-Identifier: GPL-3.0-or-later
// The chosen output device of the mixer, its additional sinks, and their errors.
#pragma once
#include "Live/Rig/Rig.h"
#include "Mixer/Desk/DeskListening.h"
#include <juce_core/juce_core.h>

namespace physvib {

/// Message thread only.
class DeskDevice {
public:
    /// Both references outlive it. `onChange` as for DeskListening.
    DeskDevice(Rig& rig, AudioDrivers drivers, const Mix& mix, std::function<void()> onChange)
        : rig_{rig}
        , drivers_{std::move(drivers)}
        , mix_{mix}
        , listening_{rig.output(), mix, choice_, std::move(onChange)} {}

    /// Opens a device. Empty, or an error, which troubles() has too.
    std::string open(const DeviceChoice& choice);

    /// The chosen device and the available ones. outputs(): number of its outputs.
    const DeviceChoice& choice() const noexcept { return choice_; }
    const AudioDrivers& drivers() const noexcept { return drivers_; }
    int outputs() const { return rig_.output().deviceOutputs(); }

    DeskListening& listening() noexcept { return listening_; }
    const DeskListening& listening() const noexcept { return listening_; }

    double outputLatencySeconds() const noexcept {
        const int rateHz = rig_.output().sampleRateHz();
        return rateHz > 0 ? static_cast<double>(rig_.session().timeline().outputLatencyFrames()) / rateHz
                          : 0.0;
    }

    /// Applies changed actuators or output assignments of the mixer state. Empty, or why that failed.
    std::string assign();

    /// Name of a sink that cannot play clips; empty if all can.
    juce::String withoutClips() const;
    /// Called if the choice has other sinks. They change the output latency, so the session must be
    /// restarted.
    std::function<void(const DeviceChoice&)> onSinksWanted;

    /// Checks the sinks; to be called often.
    void maintain();
    std::vector<RigTrouble> troubles() const; ///< see Rig
    /// Why the device, or else a sink, does not play, whatever message is shown; empty: it plays.
    juce::String trouble() const;

private:
    std::vector<int> outputMap() const;

    Rig& rig_;
    AudioDrivers drivers_;
    const Mix& mix_;
    DeviceChoice choice_;
    DeskListening listening_;
    double maintainedAtMs_ = 0.0;
};

} // namespace physvib
