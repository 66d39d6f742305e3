// SPDX-License-Identifier: GPL-3.0-or-later
// Audio on the mixer's device for ears and machines (monitor, noise, markers), on outputs without an
// actuator.
#pragma once
#include "Live/Documents/Mix.h"
#include "Mixer/Desk/DeskMoment.h"
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// Message thread only.
class DeskListening {
public:
    /// All references outlive it. Requested settings are stored in `choice`, and `onChange` is called when
    /// they change.
    DeskListening(AudioOutput& output, const Mix& mix, DeviceChoice& choice, std::function<void()> onChange)
        : output_{output}
        , mix_{mix}
        , choice_{choice}
        , onChange_{std::move(onChange)} {}

    const ListeningSettings& settings() const noexcept { return told_; } ///< settings sent to the output

    /// Sets the outputs of the contact sound (left and right), or the marker output. Outputs with an actuator
    /// are not allowed. Empty, or an error, and then nothing changes.
    std::string monitor(std::vector<int> outputs, double db);
    std::string mark(int output);

    /// Starts a study: noise on headphones, and no monitor, which would reveal the stimuli by ear. Result as
    /// monitor().
    std::string hear(const ListeningSettings& ofStudy);
    void endStudy();

    /// Settings of a study only; applied first, because the actuators have priority.
    const ListeningSettings& least() { return told_ = ofStudy_.value_or(ListeningSettings{}); }
    std::string hearWanted(); ///< then applies the settings for which there are outputs

    bool isFree(int output) const;

private:
    ListeningSettings wanted() const;
    std::string listen(const ListeningSettings& wanted, const DeviceChoice& choice);

    AudioOutput& output_;
    const Mix& mix_;
    DeviceChoice& choice_;
    std::function<void()> onChange_;
    std::optional<ListeningSettings> ofStudy_;
    ListeningSettings told_;
};

} // namespace physvib
