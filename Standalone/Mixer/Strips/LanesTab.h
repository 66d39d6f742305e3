// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with the gain lanes of all strips and groups over the scene's time.
#pragma once
#include "Mixer/Strips/LaneRow.h"
#include "Mixer/Window/TabPanel.h"

namespace physvib {

class LanesTab final : public Tab {
public:
    explicit LanesTab(Desk& desk);

    void takeMix() override;
    void refresh(const DeskMoment&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    /// Labels beside the lanes; scrolls with them.
    class Rows final : public juce::Component {
    public:
        explicit Rows(Desk& desk)
            : desk_{desk} {}
        void paint(juce::Graphics& g) override;

        std::vector<std::unique_ptr<LaneRow>> lanes;

    private:
        Desk& desk_;
    };
    double spanSeconds() const;

    Desk& desk_;
    juce::Viewport viewport_;
    Rows rows_{desk_};
    double shownSeconds_ = -1.0, spanSeconds_ = 0.0;
    juce::Rectangle<int> foot_;
};

} // namespace physvib
