// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of the mixer's window: top bar, world, tabs, scope and strips.
#pragma once
#include "Host/Views/EmergencyStop.h"
#include "Mixer/Strips/StripsPanel.h"
#include "Mixer/Window/FirstStart.h"
#include "Mixer/Window/QuestionCard.h"
#include "Mixer/Window/ShownLetters.h"
#include "Mixer/Window/TabPanel.h"
#include "Mixer/Window/TopBar.h"
#include "Mixer/World/WorldPanel.h"

namespace physvib {

class MixerView final : public juce::Component,
                        public juce::DragAndDropContainer,
                        private juce::ChangeListener,
                        private juce::Timer {
public:
    static constexpr int framesPerSecond = 30, restFramesPerSecond = 5, leastWidth = 1040, leastHeight = 640;

    explicit MixerView(Desk& desk);
    ~MixerView() override;

    /// Updates the display; called by the timer.
    void refresh();
    const DeskMoment& latest() const noexcept { return latest_; } ///< displayed state
    void setGround(Ground ground);
    Ground ground() const noexcept { return look_.ground(); }

    TopBar& topBar() noexcept { return bar_; }
    WorldPanel& world() noexcept { return world_; }
    TabPanel& tabs() noexcept { return tabs_; }
    TabPanel& scope() noexcept { return scope_; }
    /// Three lines of help for new users; a click or key closes them.
    void setHint(bool isShown);
    /// Shows a card over the world, which gets the keyboard; null: none.
    void setFirstStart(std::unique_ptr<FirstStart> card);
    FirstStart* firstStart() noexcept { return firstStart_.get(); }
    /// Shows a question in the centre; null: none.
    void setQuestion(std::unique_ptr<QuestionCard> card);
    QuestionCard* question() noexcept { return question_.get(); }
    /// Highlights the window while an acceptable file is dragged over it.
    void setDropShown(bool isShown);
    /// Files of a drag that leaves the window, if it contains played events.
    bool shouldDropFilesWhenDraggedExternally(const juce::DragAndDropTarget::SourceDetails& details,
                                              juce::StringArray& files, bool& canMoveFiles) override;

    void mouseDown(const juce::MouseEvent&) override { setHint(false); }
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;

private:
    void changeListenerCallback(juce::ChangeBroadcaster*) override { takeMix(); }
    void timerCallback() override { refresh(); }
    bool covered(const juce::KeyPress& key);
    void takeMix();
    void showLetters();
    void keepPace();

    Desk& desk_;
    Look look_;
    TopBar bar_;
    WorldPanel world_;
    TabPanel tabs_{"Tabs"}, scope_{"Scope"};
    StripsPanel strips_;
    juce::Label trouble_;
    std::unique_ptr<juce::TextButton> dismiss_;
    std::unique_ptr<FirstStart> firstStart_;
    std::unique_ptr<QuestionCard> question_;
    ShownLetters letters_;
    std::uint64_t lettersOf_ = ~std::uint64_t{0}; // edit count of the world at the last check
    bool isHintShown_ = false, isDropShown_ = false;
    DeskMoment latest_;
    int restedLooks_ = 0;
    juce::TooltipWindow tooltips_{this, 600};
    EmergencyStop stop_{*this, [this] { desk_.stop(); }};
};

} // namespace physvib
