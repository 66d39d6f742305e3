// SPDX-License-Identifier: GPL-3.0-or-later
// What the desk's device plays for ears and machines, on outputs where no enchanter is.
#pragma once
#include "Live/Documents/Mix.h"
#include "Mixer/Desk/DeskMoment.h"
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// M only.
class DeskListening {
public:
    /// All outlive it; it keeps in `choice` what is wanted. `onChange` is called when that is another.
    DeskListening(AudioOutput& output, const Mix& mix, DeviceChoice& choice, std::function<void()> onChange)
        : output_{output}
        , mix_{mix}
        , choice_{choice}
        , onChange_{std::move(onChange)} {}

    const ListeningSettings& settings() const noexcept { return told_; } ///< what the output has been told

    /// Left and right, contacts are heard as they are felt; and the output of marks. Where enchanters are,
    /// neither is. Empty, or why not, and all is as before.
    std::string monitor(std::vector<int> outputs, double db);
    std::string mark(int output);

    /// A study begins: noise on headphones, and no monitor, which would tell the ears what hands are asked.
    /// As monitor().
    std::string hear(const ListeningSettings& ofStudy);
    void endStudy();

    /// Nothing but a study's; what the output is to be told first, since hands come first.
    const ListeningSettings& least() { return told_ = ofStudy_.value_or(ListeningSettings{}); }
    std::string hearWanted(); ///< and then what there is room for

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
