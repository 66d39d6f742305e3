// SPDX-License-Identifier: GPL-3.0-or-later
// The device that the desk is felt on, the board and the controller beside it, and what is wrong with either.
#pragma once
#include "Live/Pads/PadOutput.h"
#include "Mixer/Desk/DeskBoard.h"
#include "Mixer/Desk/DeskListening.h"
#include <memory>

namespace physvib {

/// M only.
class DeskDevice {
public:
    /// Both outlive it. `onChange` as of DeskListening.
    DeskDevice(Session& session, AudioDeviceTypes types, const Mix& mix, std::function<void()> onChange)
        : types_{std::move(types)}
        , mix_{mix}
        , session_{session}
        , output_{session, types_}
        , listening_{output_, mix, choice_, std::move(onChange)} {}

    /// Empty, or why not: trouble() as well.
    std::string open(const DeviceChoice& choice);

    /// What was chosen, of which devices; and how many outputs there are.
    const DeviceChoice& choice() const noexcept { return choice_; }
    const AudioDeviceTypes& types() const noexcept { return types_; }
    int outputs() const { return output_.deviceOutputs(); }

    AudioOutput& output() noexcept { return output_; }
    const AudioOutput& output() const noexcept { return output_; }
    DeskListening& listening() noexcept { return listening_; }
    const DeskListening& listening() const noexcept { return listening_; }

    double playOutSeconds() const noexcept {
        return output_.sampleRateHz() > 0
                   ? static_cast<double>(session_.timeline().playOutFrames()) / output_.sampleRateHz()
                   : 0.0;
    }

    /// The mix has other enchanters, or other outputs for them. Empty, or why they cannot be.
    std::string assign();

    /// What the four-channel board says, if one is wanted.
    std::optional<BoardLinkStatus> board() const {
        return board_ ? std::optional{board_->status()} : std::nullopt;
    }
    /// The choice asks for a board or a controller, or for none: L is another then, so the session has to
    /// begin anew.
    std::function<void(const DeviceChoice&)> onBoardWanted;
    void connectBoard(const std::string& port); ///< before open(); empty: there is none
    void connectPad(const std::string& name);   ///< the same of a game controller
    void close();                               ///< all

    /// Looks after them, often; and one line on what is wrong.
    void maintain();
    juce::String trouble();

private:
    std::vector<int> outputMap() const;
    juce::String padTrouble() const;

    AudioDeviceTypes types_;
    const Mix& mix_;
    Session& session_;
    DeviceChoice choice_;
    AudioOutput output_;
    DeskListening listening_;
    std::unique_ptr<DeskBoard> board_;
    std::unique_ptr<PadOutput> pad_;
    juce::String trouble_; // the device's
    double maintainedAtMs_ = 0.0, padWantedAtMs_ = 0.0;
};

} // namespace physvib
