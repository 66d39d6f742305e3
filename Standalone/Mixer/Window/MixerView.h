// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of the mixer's window: a bar that is always visible (scene and time, device status, the silence
// button), world, tabs, scope and strips.
#pragma once
#include "Host/Views/EmergencyStop.h"
#include "Mixer/Strips/StripsPanel.h"
#include "Mixer/Widgets/Typefaces.h"
#include "Mixer/Window/FirstStart.h"
#include "Mixer/World/WorldPanel.h"

namespace physvib {

class TopBar final : public juce::Component {
public:
    explicit TopBar(MixerModel& model);

    void refresh(const MixerMoment& moment);
    void mixChanged(); ///< the mixer state changed
    void togglePause() { model_.setSlowness(model_.session().world().slowness() == 0 ? 1 : 0); }

    std::function<void(juce::Component& from)> onMenu = [](juce::Component&) {};
    std::function<void()> onRecord = [] {}, onSave = [] {}, onOpenScene = [] {}, onDevice = [] {};
    std::function<void(const juce::File&)> onOwnScene = [](const juce::File&) {};
    void setOwnScenes(const juce::Array<juce::File>& files); ///< listed below the built-in ones
    void setRecording(bool isRecording);                     ///< counts its seconds
    void setDocument(const juce::String& name) { save_.setTooltip("Save " + name + " (Ctrl+S)"); }
    /// Only the button that silences is left.
    void setShow(bool isShow);
    /// Hides the controls of the engineer mode.
    void setPlay(bool isPlay);
    std::function<void()> onMode = [] {}; ///< the other mode is wanted

    static constexpr int lineHeight = 52, showWidth = WorldPanel::silenceWidth;
    /// One line, or two in a narrow window, or where a board has something to say there.
    int heightFor(int width) const {
        return isPlay_ || width >= (hasBoard_ ? minFacts : minOneLine) ? lineHeight : lineHeight + secondLine;
    }

    void paint(juce::Graphics& g) override {
        if (!isShow_) g.fillAll(shade(*this, Shade::panel));
    }
    void resized() override;

private:
    static constexpr int minOneLine = 1260, minFacts = 1400, secondLine = 24; // facts: load and board, too
    void placeStates(juce::Rectangle<int> area);
    void showControls();
    bool isShow_ = false, isPlay_ = false, isToldOfLoad_ = false;
    void chooseScene();
    void listScenes();
    juce::Array<juce::File> own_;

    MixerModel& model_;
    const bool hasBoard_;
    int looks_ = 0;
    struct Lost { // in all
        std::uint64_t late = 0, lost = 0;
        bool operator==(const Lost&) const = default;
    } lost_, lostBefore_; // before it was last fine
    double lostAtMs_ = 0.0;
    bool isRecording_ = false;
    std::int64_t recordedFromNs_ = -1; // not seen yet
    juce::TextButton menu_{"Menu"}, slow_, record_, mode_, silence_{"SILENCE  Esc"};
    juce::ComboBox scene_;
    SignButton pause_{Sign::pause, "Pause the world"}, step_{Sign::step, "One step of the world"},
        restart_{Sign::restart, "Start the scene anew"}, save_{Sign::save, "Save the session (Ctrl+S)"},
        undo_{Sign::undo, "Undo"}, redo_{Sign::redo, "Redo"};
    juce::Label seed_, time_;
    TwoLines device_{"Device state"}, board_{"Board state"}, load_{"Load"};
};

/// Places of the dividers as shares of the width or height that they divide; 0: automatic.
struct Dividers {
    double side = 0.0;   ///< width of the tabs beside the world
    double lower = 0.0;  ///< height of the lower panels
    double strips = 0.0; ///< width of the strips beside the scope
    bool operator==(const Dividers&) const = default;

    juce::String text() const; ///< for the settings
    static Dividers of(const juce::String& text);
};

/// Widths for the strips, in pixels.
struct Wanted {
    int minStrips = 0; ///< width at which all strips are in sight
    int maxStrips = 0; ///< width at which they are as wide as they may be
};

/// What the window shows: the world with the controls to play, or everything.
enum class Mode { play, engineer };

/// Which panels are unfolded: the drawer beside the world, and the strips with their pages below it. Of
/// folded ones, the engineer mode shows the names.
struct Panels {
    bool hasDrawer = false, hasLower = false;
    bool operator==(const Panels&) const = default;
};

/// Places of the window's panels in pixels, below the bar: pure arithmetic, so that every size can be tested
/// without a window.
struct Arrangement {
    juce::Rectangle<int> world, tabs, scope, strips;
    juce::Rectangle<int> side, lower, between; ///< the dividers' handles

    static constexpr int seam = 8, minLower = 232, minWorldHeight = 240, minSide = 400, minStrips = 300,
                         minScope = 360;
};

/// Divides `area`. The world gets what the unfolded panels leave. Any thread.
Arrangement arrange(juce::Rectangle<int> area, const Wanted& wanted, const Dividers& dividers, Mode mode,
                    const Panels& panels);

struct StudyCall;

class MixerView final : public juce::Component,
                        public juce::DragAndDropContainer,
                        public CardHost,
                        private juce::ChangeListener,
                        private juce::Timer {
public:
    static constexpr int framesPerSecond = 60, restFramesPerSecond = 5, minWidth = 1000, minHeight = 640;
    static constexpr int worldsPerPanel = 3; ///< updates of the world per update of the other panels

    double faultMs = 20e3; ///< how long errors are shown once the user is active

    explicit MixerView(MixerModel& model);
    ~MixerView() override;

    /// Updates the display; called by the timer.
    void refresh();
    const MixerMoment& latest() const noexcept { return latest_; } ///< displayed state
    void setTheme(Theme theme);
    Theme theme() const noexcept { return look_.theme(); }
    const Dividers& dividers() const noexcept { return dividers_; }
    void setDividers(const Dividers& dividers);
    /// Each mode keeps its own panels. Not while a study has the screen.
    void setMode(Mode mode);
    Mode mode() const noexcept { return mode_; }
    Panels panels() const;                ///< as they were set; before, by the window's height
    void setPanels(const Panels& panels); ///< of the present mode
    juce::String order() const;           ///< mode and panels, for the settings
    void setOrder(const juce::String& order);
    /// Shows the world alone, with the button that silences.
    void setShow(bool isShow);
    bool isShow() const noexcept { return isShow_; }

    TopBar& topBar() noexcept { return bar_; }
    WorldPanel& world() noexcept { return world_; }
    TabPanel& tabs() noexcept { return tabs_; }
    TabPanel& scope() noexcept { return scope_; }
    /// Shows the tab *Studies* with these selections; it displays errors in the protocol.
    void chooseStudy(const StudyCall& call);
    /// The window is to be closed: pauses or leaves a study on its screen. False if there is none.
    bool pauseStudy();
    /// Shows a card over the world, which gets the keyboard; null: none.
    void setFirstStart(std::unique_ptr<FirstStart> card);
    FirstStart* firstStart() noexcept { return firstStart_.get(); }
    /// Shows a question or a choice of files in the centre; null: none.
    void setCard(std::unique_ptr<juce::Component> card) override;
    void setScreen(juce::Component* screen) override;
    juce::Component* card() noexcept { return card_.get(); }
    /// The open card, which gets all keys; the mouse reaches it and the silence button only. Null: none.
    juce::Component* openCard() noexcept {
        return card_ ? card_.get() : static_cast<juce::Component*>(firstStart_.get());
    }
    void setQuestion(std::unique_ptr<QuestionCard> card) { setCard(std::move(card)); }
    QuestionCard* question() noexcept { return dynamic_cast<QuestionCard*>(card_.get()); }
    /// Shows a small card over a corner of the world, which does not take the keyboard; null: none.
    void setProgress(juce::Component* card);
    /// Highlights the window while an acceptable file is dragged over it.
    void setDropShown(bool isShown);
    /// Files of a drag that leaves the window, if it contains played events.
    bool shouldDropFilesWhenDraggedExternally(const juce::DragAndDropTarget::SourceDetails& details,
                                              juce::StringArray& files, bool& canMoveFiles) override;

    void mouseMove(const juce::MouseEvent&) override { attend(); }
    void mouseDown(const juce::MouseEvent& e) override { releaseAtRightClick(e), drawCurtain(), attend(); }
    void mouseUp(const juce::MouseEvent&) override { drawCurtain(); }
    void mouseDrag(const juce::MouseEvent& e) override { releaseAtRightClick(e); }
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override { g.fillAll(shade(*this, Shade::ground)); }
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;

private:
    void changeListenerCallback(juce::ChangeBroadcaster*) override { mixChanged(); }
    void timerCallback() override;
    void look();
    void attend();
    void moveDivider(double Dividers::*which, int pixels, int whole, int now);
    static void releaseAtRightClick(const juce::MouseEvent& e);
    bool onlyCloses();
    void raiseCard();
    void drawCurtain();
    void showPanels();
    void placeCards();
    void placeTrouble(juce::Rectangle<int> banner);
    void mixChanged();
    void showLetters();
    void keepPace();

    MixerModel& model_;
    Look look_;
    TopBar bar_;
    WorldPanel world_;
    TabPanel tabs_{"Tabs"}, scope_{"Scope"};
    StripsPanel strips_;
    Dividers dividers_;
    Mode mode_ = Mode::engineer;
    std::array<std::optional<Panels>, 2> panels_; // of each mode; none: automatic
    Panels shownPanels_;
    Divider side_{"Divider of world and tabs", true}, lower_{"Divider of upper and lower panels", false},
        between_{"Divider of scope and strips", true};
    juce::Label trouble_; // over the world
    std::unique_ptr<juce::TextButton> dismiss_, act_;
    Curtain curtain_;
    std::unique_ptr<FirstStart> firstStart_;
    std::unique_ptr<juce::Component> card_;
    CardFocus cardFocus_;
    juce::Component::SafePointer<juce::Component> progress_, screen_;
    std::vector<juce::Component::SafePointer<juce::Component>> hidden_; // behind the screen
    ShownLetters letters_;
    std::uint64_t lettersOf_ = ~std::uint64_t{0}; // edit count of the world at the last check
    juce::String whySilent_;                      // as shown
    bool isDropShown_ = false, isShow_ = false;
    MixerMoment latest_;
    int restedLooks_ = 0, looks_ = 0, told_ = 0;
    double newsAtMs_ = 0.0, seenAtMs_ = 0.0; // when the message came, and when somebody was there; 0: not yet
    std::array<float, limits::maxEnchanters> peaks_{}; // since the strips were updated
    Tips tooltips_{*this};
    EmergencyStop stop_{*this, [this] { model_.setSilent(true); }, [this] { return onlyCloses(); }};
};

} // namespace physvib
