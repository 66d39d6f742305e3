// SPDX-License-Identifier: GPL-3.0-or-later
// Panel of the world with its controls: the strongest impact in words, tilt, drag strength, panning law.
#pragma once
#include "Mixer/World/DrawBar.h"
#include "Scene/World/ScenePlayer.h"

namespace physvib {

/// Strip above the world that shows recorded user input, and trims it as the scene's script.
/// Visible while input is recorded, and while the scene has the recorded script and the hand tool is active.
/// Message thread.
class ScriptStrip final : public juce::Component {
public:
    explicit ScriptStrip(MixerModel& model);

    void refresh(bool isHand); ///< a few times a second; true if the hand is the active tool
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void resized() override;

private:
    juce::Rectangle<int> lane() const { return getLocalBounds().reduced(12, 8).removeFromBottom(22); }
    float placeOf(double seconds) const;
    void show();
    void use();

    MixerModel& model_;
    juce::Label words_;
    juce::Slider from_, to_;
    juce::ToggleButton repeats_{"repeat"};
    juce::TextButton end_{"End"}, again_{"From the start"}, close_{"Close"};
    static constexpr int high = 92, recordingHigh = 40;
    std::shared_ptr<const Scene> shown_,
        closed_; // scene of the displayed script; scene whose strip was closed
    juce::Slider* dragged_ = nullptr;
    bool wasRecording_ = false;
};

class WorldPanel final : public juce::Component {
public:
    explicit WorldPanel(MixerModel& model);

    void refresh(const MixerMoment& moment);
    void mixChanged();
    WorldView& view() noexcept { return view_; }
    DrawPane& drawing() noexcept { return pane_; }
    MixerCompare& compare() noexcept { return ab_; }
    void tilt(double degrees) { tilt_.turnTo(degrees); } ///< turns gravity to that angle
    /// Shows only the field and its actuators, for an audience.
    void setShow(bool isShow);
    /// Hides figures and knobs for engineers; shows the master if there are no channel strips.
    void setPlay(bool isPlay, bool hasMaster);
    /// The context menu at `place`, in pixels of the view.
    juce::PopupMenu menuAt(juce::Point<float> place);
    /// Area of a message over this panel: its bottom row, without the master. In pixels of the panel.
    juce::Rectangle<int> bannerArea() const;

    static constexpr int silenceWidth = 174; ///< of the silence button in show mode, px

    // Menu commands on an actuator that other panels carry out.
    std::function<void(int enchanter)> onOutput, onProfile;
    MaterialPage onMaterial; ///< and on a material

    bool isDragging() const { return view_.isDragging() || pane_.isDrawing(); }
    void cancelDrag(); ///< restores the state before the drag

    bool keyPressed(const juce::KeyPress& key) override;
    bool keyStateChanged(bool isDown) override;
    void mouseDown(const juce::MouseEvent&) override { isMoving_ = false; }
    void mouseDrag(const juce::MouseEvent& e) override {
        if (player_ && player_->moves() && e.eventComponent == &view_ && !view_.isHolding())
            pointed_ = metresAt(e.position.x);
    }
    void mouseUp(const juce::MouseEvent&) override;
    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
    void resized() override;

private:
    void moveHand(); ///< sends the grip of the hand, if it is time
    void addActuatorItems(juce::PopupMenu& menu, int enchanter);
    void addBodyItems(juce::PopupMenu& menu, const std::string& body, Vector place);
    void addEmptyItems(juce::PopupMenu& menu, FieldShare at, Vector place);
    void placeInspector(); ///< lays the body panel beside, above or in the field
    juce::Rectangle<int> withinField(int wide, int high) const;
    void showTools(); ///< updates all controls of drawing
    void play(const std::vector<Action>& actions);
    void lookAfterPlayer(); ///< moves it towards the pointer, and keeps it in the field
    double metresAt(float x) const;
    juce::String sentenceOn(const CollisionEvent& hit) const;
    juce::String inLines(const juce::StringArray& parts) const;
    juce::String whyMuted() const { return model_.isSilent() ? "silent" : whySilent(model_); }
    juce::String whyNothing(double nowMs, bool isRunning) const;
    void showSentence();

    MixerModel& model_;
    WorldView view_;
    DrawPane pane_{model_, view_};
    DrawBar bar_{pane_};
    MaterialPalette palette_{model_, pane_, onMaterial};
    BodyPanel body_{model_, pane_, onMaterial};
    ScriptStrip script_{model_};
    Caption sentence_{{}, Shade::now}, law_, tiltName_, dragName_;
    juce::TextButton compare_{"A/B"};
    MixerCompare ab_{model_};
    TiltKnob tilt_;
    juce::Slider drag_;
    MasterStrip master_{model_, true};
    std::optional<ScenePlayer> player_; // for a scene with a player
    std::optional<double> pointed_;     // place of the held mouse on the field, m
    std::vector<Action> first_;      // input that takes over from the script, until the world has restarted
    std::size_t runsBefore_ = 0;     // number of scene runs at that time
    std::optional<GripAction> hand_; // position since the last moveHand()
    double handAtMs_ = 0.0;
    bool isMoving_ = false; // a badge is being moved since the mouse was pressed
    bool isShow_ = false, isPlay_ = false, hasMaster_ = false;
    double hitAtMs_ = 0.0;
    CollisionEvent shownHit_;               // of amplitude 0: none yet
    std::shared_ptr<const Scene> hitScene_; // scene of shownHit_
    juce::String why_;                      // as displayed
    std::shared_ptr<const Scene> shown_;
    std::uint64_t shownEdits_ = 0;
};

} // namespace physvib
