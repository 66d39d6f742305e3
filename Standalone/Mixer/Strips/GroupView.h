// SPDX-License-Identifier: GPL-3.0-or-later
// View of a strip group: name, fader, mute, and members.
#pragma once
#include "Host/Views/StripParts.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

class GroupView final : public juce::Component {
public:
    static constexpr int width = 92;

    GroupView(Desk& desk, int group);
    void takeMix();
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const StripGroup& group() const { return desk_.mix().groups[index_]; }
    template <class Change>
    void change(const juce::String& name, Change change, bool goesOn = false);
    void rename();
    void remove();

    Desk& desk_;
    const std::size_t index_;
    juce::Label name_, level_;
    Fader fader_;
    juce::TextButton mute_{"M"};
    std::unique_ptr<juce::TextButton> remove_;
};

/// Menu of groups for a strip, including a new one. Message thread.
void showGroupMenu(Desk& desk, std::size_t strip, juce::Component& from);

} // namespace physvib
