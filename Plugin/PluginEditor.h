// SPDX-License-Identifier: GPL-3.0-or-later
// The plug-in's window: the world, the enchanters' meters, scene and layout, a knob per parameter, what went wrong.
#pragma once
#include "Host/Views/MeterView.h"
#include "Host/Views/WorldView.h"
#include "PluginProcessor.h"
#include <memory>
#include <vector>

namespace physvib {

/// A knob (or, for a switch, a button) of one parameter, with its name.
class ParameterControl final : public juce::Component {
public:
    explicit ParameterControl(HostParameter& parameter);
    void resized() override;

private:
    juce::Label name_;
    juce::Slider knob_;
    juce::TextButton button_;
    std::unique_ptr<juce::SliderParameterAttachment> knobAttachment_;
    std::unique_ptr<juce::ButtonParameterAttachment> buttonAttachment_;
};

class PluginEditor final : public juce::AudioProcessorEditor, private juce::Timer {
public:
    explicit PluginEditor(PluginProcessor& plugin);
    ~PluginEditor() override;

    void paint(juce::Graphics& g) override;
    void resized() override;

    /// One picture of what is going on; the timer calls it, at most 25 times a second.
    void refresh();
    juce::String statusText() const { return status_.getText(); }

private:
    void timerCallback() override { refresh(); }
    void takeState();
    void fillChoices();
    template <class Change>
    void edit(Change change);
    juce::String statusLine(const TakesStatus& status, const ChannelMeters& meters) const;

    PluginProcessor& plugin_;
    Look look_;
    juce::Label title_, status_, seedName_;
    juce::ComboBox scene_, layout_;
    juce::TextEditor seed_;
    juce::ToggleButton restart_{"Restart on play"};
    WorldView world_;
    MeterView meters_;
    std::vector<std::unique_ptr<ParameterControl>> controls_;
    std::uint64_t shown_ = 0; // the processor's count of states
    std::uint64_t played_ = 0;
    PluginState state_;
};

} // namespace physvib
