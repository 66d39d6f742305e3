// SPDX-License-Identifier: GPL-3.0-or-later
// All of the mixer's window: the bar, the world, the tabs, the scope and the strips.
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

    /// One picture of what is going on; the timer calls it.
    void refresh();
    const DeskMoment& latest() const noexcept { return latest_; } ///< what it shows
    void setGround(Ground ground);
    Ground ground() const noexcept { return look_.ground(); }

    TopBar& topBar() noexcept { return bar_; }
    WorldPanel& world() noexcept { return world_; }
    TabPanel& tabs() noexcept { return tabs_; }
    TabPanel& scope() noexcept { return scope_; }
    /// Three lines for those who see the mixer for the first time; a click or a key takes them away.
    void setHint(bool isShown);
    /// A card over the world; null: none. It has the keyboard.
    void setFirstStart(std::unique_ptr<FirstStart> card);
    FirstStart* firstStart() noexcept { return firstStart_.get(); }
    /// Another card, in the middle; null: none.
    void setQuestion(std::unique_ptr<QuestionCard> card);
    QuestionCard* question() noexcept { return question_.get(); }
    /// A file that is dragged over the window may be dropped here.
    void setDropShown(bool isShown);
    /// What leaves the window by a drag: files, if it is what was played.
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
    std::uint64_t lettersOf_ = ~std::uint64_t{0}; // edits of the world that were looked at
    bool isHintShown_ = false, isDropShown_ = false;
    DeskMoment latest_;
    int restedLooks_ = 0;
    juce::TooltipWindow tooltips_{this, 600};
    EmergencyStop stop_{*this, [this] { desk_.stop(); }};
};

} // namespace physvib
