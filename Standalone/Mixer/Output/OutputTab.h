// SPDX-License-Identifier: GPL-3.0-or-later
// Tab for the output: device, sample rate, block size and the resulting latency, and additional sinks.
#pragma once
#include "Mixer/Output/TelemetryTab.h"
#include "Mixer/Widgets/Parts.h"

namespace physvib {

class OutputTab final : public Tab {
public:
    explicit OutputTab(MixerModel& model);
    ~OutputTab() override;
    void mixChanged() override;
    void refresh(const MixerMoment& moment) override;
    void resized() override;
    int minHeight(int width) const override {
        constexpr int controls = 18 + rowHeight + 3 * (28 + rowHeight) + 12;
        return controls + facts_.heightFor(width);
    }
    void visibilityChanged() override;
    /// Sets the receiver HOST:PORT as if typed; empty: none.
    void sendHitsTo(const juce::String& receiver);

private:
    void scan();
    void open();

    MixerModel& model_;
    struct SinkRow { // of the list of outputs
        const SinkKind& kind;
        std::string where; ///< empty: to be typed
        bool isThere, isUsed;
    };
    void findSinks();
    void listSinks();
    void choose(const SinkRow& row);
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
    juce::String ownersOf(int output, bool isMuteTold = false) const;
    juce::String heardWords() const;

    juce::ComboBox device_, rate_, block_, osc_, hits_, phone_, monitor_, monitorLevel_, marks_;
    Caption deviceName_{"Outputs"}, rateName_{"Rate"}, blockName_{"Block of"}, oscName_{"Messages by OSC"},
        hitsName_{"Hits by OSC to"}, phoneName_{"A phone's top is"}, monitorName_{"Monitor outputs"},
        monitorLevelName_{"Monitor level"}, marksName_{"Trigger output"};
    std::unique_ptr<juce::TextButton> scan_;
    FactList facts_{"What follows from it", 1};
    std::vector<AudioDeviceName> found_;
    std::string worn_; // what headphones are on: the device last played, else the first that has two outputs
    std::vector<std::vector<SinkPlace>> sinks_; // that are there, of each entry of the table of sinks
    std::vector<SinkRow> rows_;
    std::ptrdiff_t ready_ = 0; // how many sinks are there
    bool isScanned_ = false;
};

} // namespace physvib
