// SPDX-License-Identifier: GPL-3.0-or-later
// Tab for the output: device, sample rate, block size and the resulting latency, and additional sinks.
#pragma once
#include "Mixer/Output/FactList.h"
#include "Mixer/Window/TabPanel.h"

namespace physvib {

class OutputTab final : public Tab {
public:
    explicit OutputTab(Desk& desk);
    ~OutputTab() override;
    void takeMix() override;
    void refresh(const DeskMoment& moment) override;
    void resized() override;
    int leastHeight(int) const override { return 470; } // all of its facts
    void visibilityChanged() override;
    /// Sets the receiver HOST:PORT as if typed; empty: none.
    void tellHits(const juce::String& receiver);

private:
    void scan();
    void open();

    Desk& desk_;
    struct SinkChoice;
    void list(SinkChoice& choice);
    void choose(SinkChoice& choice);
    void use(const SinkKind& kind, const std::string& where);
    void prepareOsc();
    void listen();
    void chooseReceiver();
    void useOsc(const OscChoice& choice, const juce::String& what);
    void showOsc();
    void ask(const juce::String& title, const juce::String& what, const juce::String& now,
             std::function<void(const juce::String&)> use);
    std::vector<Fact> sinkFacts() const;
    juce::String oscState(Shade& shade) const;
    void listHeard();
    void chooseMonitor();
    void chooseMarks();
    juce::String ownersOf(int output) const;
    juce::String heardWords() const;

    juce::ComboBox device_, rate_, block_, osc_, hits_, phone_, monitor_, monitorLevel_, marks_;
    juce::Label deviceName_, rateName_, blockName_, oscName_, hitsName_, phoneName_, monitorName_,
        monitorLevelName_, marksName_;
    std::unique_ptr<juce::TextButton> scan_;
    FactList facts_{"What follows from it", 1};
    std::vector<AudioDeviceName> found_;
    std::vector<std::unique_ptr<SinkChoice>> sinks_; // one per entry of the table of sinks
    bool isScanned_ = false;
};

} // namespace physvib
