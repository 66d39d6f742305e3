// SPDX-License-Identifier: GPL-3.0-or-later
// What was played, hit by hit, the newest first.
#pragma once
#include "Mixer/Window/TabPanel.h"

namespace physvib {

class EventsTab final : public Tab {
public:
    explicit EventsTab(Desk& desk);
    void refresh(const DeskMoment& moment) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    class Rows final : public juce::ListBoxModel {
    public:
        explicit Rows(EventsTab& tab)
            : tab_{tab} {}
        int getNumRows() override { return static_cast<int>(tab_.shown_.size()); }
        void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
        juce::String getNameForRow(int row) override;

    private:
        EventsTab& tab_;
    };

    Desk& desk_;
    std::vector<RecentContact> shown_;
    Rows rows_{*this};
    juce::ListBox list_{"Events", &rows_};
    std::uint64_t seen_ = 0;
    double shownAtMs_ = 0.0;
};

} // namespace physvib
