// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of the mixer's window (MixerView): a bar that is always visible (TopBar: scene and time, device
// status, the silence button), world, tabs, scope and strips, and the arrangement of these panels.
#pragma once
#include "Host/Views/EmergencyStop.h"
#include "Mixer/Strips/StripsPanel.h"
#include "Mixer/Widgets/Typefaces.h"
#include "Mixer/Window/FirstStart.h"
#include "Mixer/World/WorldPanel.h"

namespace physvib {

/// The bar at the top: scene, time, recording, status, and the silence button. Message thread.
class TopBar final : public juce::Component {
public:
    explicit TopBar(MixerModel& model);

    void refresh(const MixerSnapshot& snapshot);
    void mixChanged(); ///< the mixer state changed
    void togglePause() { model_.setSlowness(model_.session().world().slowness() == 0 ? 1 : 0); }

    std::function<void(juce::Component& anchor)> onMenu = [](juce::Component&) {};
    std::function<void()> onRecord = [] {}, onSave = [] {}, onOpenScene = [] {}, onDevice = [] {};
    std::function<void(const juce::File&)> onOwnScene = [](const juce::File&) {};
    void setOwnScenes(const juce::Array<juce::File>& files); ///< listed after the built-in ones
    void setRecording(bool isRecording);                     ///< shows the seconds of a recording
    void setDocument(const juce::String& name) { save_.setTooltip("Save " + name + " (Ctrl+S)"); }
    /// Shows only the button that silences.
    void setShowMode(bool isShowMode);
    /// Hides the controls of the engineer mode.
    void setPlayMode(bool isPlayMode);
    std::function<void()> onMode = [] {}; ///< the user asks for the other mode

    static constexpr int lineHeight = 52, showWidth = WorldPanel::silenceWidth;
    /// Height in pixels: one line, or two in a narrow window, or where the status of a board needs it.
    int heightFor(int width) const {
        return isPlayMode_ || width >= (hasBoard_ ? minStatusWidth : minOneLineWidth)
                   ? lineHeight
                   : lineHeight + secondLineHeight;
    }

    void paint(juce::Graphics& g) override {
        if (!isShowMode_) g.fillAll(shade(*this, Shade::panel));
    }
    void resized() override;

private:
    static constexpr int minOneLineWidth = 1260, minStatusWidth = 1400,
                         secondLineHeight = 24; // pixels
    void placeStates(juce::Rectangle<int> area);
    void showControls();
    bool isShowMode_ = false, isPlayMode_ = false, warnsOfLoad_ = false;
    void chooseScene();
    void listScenes();
    juce::Array<juce::File> ownScenes_;

    MixerModel& model_;
    const bool hasBoard_;
    int updates_ = 0;
    struct Losses { // hits since the session began
        std::uint64_t late = 0, lost = 0;
        bool operator==(const Losses&) const = default;
    } losses_, seenLosses_; // the latter are no longer reported as new
    double lostAtMs_ = 0.0;
    bool isRecording_ = false;
    std::int64_t recordingStartNs_ = -1; // -1: not known yet
    juce::TextButton menu_{"Menu"}, slow_, record_, mode_, silence_{"SILENCE  Esc"};
    juce::ComboBox scene_;
    IconButton pause_{Icon::pause, "Pause the world"}, step_{Icon::step, "One step of the world"},
        restart_{Icon::restart, "Start the scene anew"}, save_{Icon::save, "Save the session (Ctrl+S)"},
        undo_{Icon::undo, "Undo"}, redo_{Icon::redo, "Redo"};
    juce::Label seed_, time_;
    TwoLineText device_{"Device state"}, board_{"Board state"}, load_{"Load"};
};

/// Places of the dividers as shares of the width or height that they divide; 0: automatic.
struct Dividers {
    double side = 0.0;   ///< width of the tabs beside the world
    double lower = 0.0;  ///< height of the lower panels
    double strips = 0.0; ///< width of the strips beside the scope
    bool operator==(const Dividers&) const = default;

    juce::String toText() const; ///< for the settings
    static Dividers fromText(const juce::String& text);
};

/// Widths for the strips, in pixels.
struct StripWidths {
    int minStrips = 0; ///< width at which all strips are in sight
    int maxStrips = 0; ///< width at which they are as wide as they may be
};

/// What the window shows: the world with the controls to play, or everything.
enum class Mode { play, engineer };

/// Which panels are unfolded: the drawer beside the world, and the strips with the pages below it. The
/// engineer mode shows the names of folded panels.
struct Panels {
    bool hasDrawer = false, hasLower = false;
    bool operator==(const Panels&) const = default;
};

/// Places of the window's panels below the bar, in pixels. Computed without a window, so that every size can
/// be tested.
struct Arrangement {
    juce::Rectangle<int> world, tabs, scope, strips;
    juce::Rectangle<int> sideDivider, lowerDivider, scopeDivider; ///< the dividers' handles

    static constexpr int dividerWidth = 8, minLower = 232, minWorldHeight = 240, minSide = 400,
                         minStrips = 300, minScope = 360;
};

/// Divides `area`; the world gets what the unfolded panels leave. Any thread.
Arrangement arrange(juce::Rectangle<int> area, const StripWidths& widths, const Dividers& dividers, Mode mode,
                    const Panels& panels);

struct StudySelection;

/// The contents of the window, which updates all panels by a timer and handles keys. Message thread.
class MixerView final : public juce::Component,
                        public juce::DragAndDropContainer,
                        public CardHost,
                        private juce::ChangeListener,
                        private juce::Timer {
public:
    static constexpr int framesPerSecond = 60, idleFramesPerSecond = 5, minWidth = 1000, minHeight = 640;
    static constexpr int worldUpdatesPerPanelUpdate = 3; ///< the other panels need fewer updates

    double errorShownMs = 20e3; ///< how long errors are shown once the user is active

    explicit MixerView(MixerModel& model);
    ~MixerView() override;

    /// Updates the display; called by the timer.
    void refresh();
    const MixerSnapshot& snapshot() const noexcept { return snapshot_; } ///< displayed state
    void setTheme(Theme theme);
    Theme theme() const noexcept { return look_.theme(); }
    const Dividers& dividers() const noexcept { return dividers_; }
    void setDividers(const Dividers& dividers);
    /// Each mode has its own panels. Not to be called while a study has the screen.
    void setMode(Mode mode);
    Mode mode() const noexcept { return mode_; }
    Panels panels() const;                ///< set by the user, or else by the window's height
    void setPanels(const Panels& panels); ///< of the current mode
    juce::String panelLayout() const;     ///< mode and panels, for the settings
    void setPanelLayout(const juce::String& text);
    /// Shows the world alone, with the button that silences.
    void setShowMode(bool isShowMode);
    bool isShowMode() const noexcept { return isShowMode_; }

    TopBar& topBar() noexcept { return bar_; }
    WorldPanel& world() noexcept { return world_; }
    TabPanel& tabs() noexcept { return tabs_; }
    TabPanel& scope() noexcept { return scope_; }
    /// Shows the tab *Studies* with these selections; it displays errors in the protocol.
    void chooseStudy(const StudySelection& study);
    /// Pauses or leaves a study on the screen before the window closes. False if there is none.
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

    void mouseMove(const juce::MouseEvent&) override { recordUserActivity(); }
    void mouseDown(const juce::MouseEvent& e) override {
        releaseButtonAtRightClick(e), updateOverlay(), recordUserActivity();
    }
    void mouseUp(const juce::MouseEvent&) override { updateOverlay(); }
    void mouseDrag(const juce::MouseEvent& e) override { releaseButtonAtRightClick(e); }
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override { g.fillAll(shade(*this, Shade::background)); }
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;

private:
    void changeListenerCallback(juce::ChangeBroadcaster*) override { mixChanged(); }
    void timerCallback() override;
    void updateWorld();
    void recordUserActivity();
    void moveDivider(double Dividers::*share, int pixels, int totalPixels, int currentPixels);
    static void releaseButtonAtRightClick(const juce::MouseEvent& e);
    bool escapeOnlyCloses();
    void showOpenCard();
    void updateOverlay();
    void showPanels();
    void placeCards();
    void layOutMessage(juce::Rectangle<int> banner);
    void mixChanged();
    void updateTypeface();
    void adaptFrameRate();

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
    Divider sideDivider_{"Divider of world and tabs", true},
        lowerDivider_{"Divider of upper and lower panels", false},
        scopeDivider_{"Divider of scope and strips", true};
    juce::Label messageLabel_; // drawn over the world
    std::unique_ptr<juce::TextButton> dismiss_, action_;
    ModalOverlay overlay_;
    std::unique_ptr<FirstStart> firstStart_;
    std::unique_ptr<juce::Component> card_;
    CardFocus cardFocus_;
    juce::Component::SafePointer<juce::Component> progress_, screen_;
    std::vector<juce::Component::SafePointer<juce::Component>> hiddenByScreen_; // shown again after it
    DisplayTypeface typeface_;
    std::uint64_t checkedEditCount_ = ~std::uint64_t{0}; // edit count of the world at the last check
    juce::String silenceReason_;                         // as last reported
    bool isDropShown_ = false, isShowMode_ = false;
    MixerSnapshot snapshot_;
    int idleUpdates_ = 0, updates_ = 0, lastShownCount_ = 0;
    double messageAtMs_ = 0.0, activityAtMs_ = 0.0;   // the latter: first user activity since then; 0: none
    std::array<float, limits::maxActuators> peaks_{}; // maxima since the last update of the strips
    TooltipHost tooltips_{*this};
    EmergencyStop stop_{*this, [this] { model_.setSilent(true); }, [this] { return escapeOnlyCloses(); }};
};

} // namespace physvib
