// SPDX-License-Identifier: GPL-3.0-or-later
// Panel with tabs: a row of names, and the page of the selected one.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

/// Base class of a page. To add one, derive from it and name it in MixerView's constructor.
class Tab : public juce::Component {
public:
    virtual void takeMix() {}                        ///< the mixer state changed
    virtual void refresh(const DeskMoment&) {}       ///< while visible, at most about 30 times a second
    virtual int leastHeight(int) const { return 0; } ///< at a width; a panel that has less lets it scroll
};

class TabPanel final : public juce::Component {
public:
    /// `title` for screen readers.
    explicit TabPanel(const juce::String& title);
    void add(const juce::String& name, std::unique_ptr<Tab> tab);
    void choose(const juce::String& name);
    juce::StringArray names() const;
    Tab* find(const juce::String& name) const; ///< null if there is none
    void takeMix();
    void refresh(const DeskMoment& moment);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    class Name;
    struct Page {
        std::unique_ptr<Name> name;
        std::unique_ptr<Tab> tab;
        std::unique_ptr<juce::Viewport> view; // of the tab
        int least = 0;                        // its height when it was placed
    };
    std::vector<Page> pages_;
    std::size_t chosen_ = 0;

public:
    ~TabPanel() override;
};

} // namespace physvib
