// SPDX-License-Identifier: GPL-3.0-or-later
// Editor panel of the plug-in's mixer: a strip per actuator, then the total level and the limiter.
#pragma once
#include "Host/Views/StripParts.h"
#include "PluginProcessor.h"
#include <functional>
#include <memory>
#include <vector>

namespace physvib {

/// Tells what a person has done with the state; what cannot be done is a line for them.
struct MixHands {
    std::function<void(const std::function<void(PluginState&)>&)> edit;
    std::function<void(const juce::String&)> report;
};

/// M only.
class MixStrip final : public StripParts {
public:
    static constexpr int width = 80;

    MixStrip(const MixHands& hands, int strip, const juce::String& label);
    void take(const PluginState& state);
    void update(float peak, bool isConnected);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void change(const juce::String&, const std::function<void(Strip&)>& how) override;
    void askActuator();
    void chooseActuator(const std::string& nameOrPath);
    void equalise(bool on);

    const MixHands& hands_;
    const std::size_t index_;
    const juce::String label_;
    EnchanterDescription enchanter_;
    bool isSilent_ = false, isEqualised_ = false, isConnected_ = true;
    float hold_ = 0.0f;
    double holdUntilMs_ = 0.0;
    juce::TextButton actuator_;
    std::unique_ptr<juce::FileChooser> chooser_;
};

class MixPanel final : public juce::Component {
public:
    MixPanel(PluginProcessor& plugin, MixHands hands);
    void take(const PluginState& state);
    void update(const ChannelMeters& meters);
    int wishedWidth() const;      ///< that shows all strips
    std::function<void()> onMenu; ///< a right click on the level
    void mouseDown(const juce::MouseEvent& e) override {
        if (e.eventComponent == &level_ && e.mods.isPopupMenu()) onMenu();
    }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const MixHands hands_;
    juce::Viewport viewport_;
    juce::Component row_;
    std::vector<std::unique_ptr<MixStrip>> strips_;
    juce::StringArray labels_;
    Fader level_;
    juce::SliderParameterAttachment levelAttachment_;
    juce::TextButton limiter_{"Limiter"};
    LimiterBar limiterBar_;
    juce::Rectangle<int> levelName_, levelValue_, limiterValue_;
};

} // namespace physvib
