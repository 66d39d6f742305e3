// SPDX-License-Identifier: GPL-3.0-or-later
// Where the enchanters are fed from: device, rate, block and the delay that follows from them; the board.
#pragma once
#include "Mixer/Output/FactList.h"
#include "Mixer/Window/TabPanel.h"

namespace physvib {

class OutputTab final : public Tab {
public:
    explicit OutputTab(Desk& desk);
    void takeMix() override;
    void refresh(const DeskMoment& moment) override;
    void resized() override;
    void visibilityChanged() override;

private:
    void scan();
    void open();

    Desk& desk_;
    void connectBoard();
    void askPort();
    void useBoard(const std::string& port);
    void listPorts();
    void listen();
    juce::String boardState(Shade& shade) const;
    juce::String oscState(Shade& shade) const;
    void listHeard();
    void chooseMonitor();
    void chooseMarks();
    juce::String heardWords() const;

    juce::ComboBox device_, rate_, block_, board_, osc_, monitor_, monitorLevel_, marks_;
    juce::Label deviceName_, rateName_, blockName_, boardName_, oscName_, monitorName_, monitorLevelName_, marksName_;
    std::unique_ptr<juce::TextButton> scan_;
    FactList facts_{"What follows from it", 1};
    std::vector<AudioDeviceName> found_;
    std::vector<std::string> ports_;
    bool isScanned_ = false;
};

} // namespace physvib
