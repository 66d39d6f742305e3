// SPDX-License-Identifier: GPL-3.0-or-later
// The panel with the world, its drawing tools and knobs, and the strip above it that trims recorded scripts.
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

    void refresh(bool isHandTool); ///< call it a few times a second; `isHandTool`: the hand tool is active
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void resized() override;

private:
    juce::Rectangle<int> track() const { return getLocalBounds().reduced(12, 8).removeFromBottom(22); }
    float toPixelX(double seconds) const;
    void showScript();
    void applyTrim();

    MixerModel& model_;
    juce::Label status_;
    juce::Slider fromSlider_, toSlider_;
    juce::ToggleButton repeatToggle_{"repeat"};
    juce::TextButton endButton_{"End"}, restartButton_{"From the start"}, closeButton_{"Close"};
    static constexpr int fullHeight = 92, recordingHeight = 40;
    std::shared_ptr<const Scene> shownScene_,
        closedScene_; // scene of the displayed script; scene whose strip was closed
    juce::Slider* draggedSlider_ = nullptr;
    bool isRecordingShown_ = false;
};

/// View of the world with drawing tools, tilt, drag strength, law, master and hit text. Message thread.
class WorldPanel final : public juce::Component {
public:
    explicit WorldPanel(MixerModel& model);

    void refresh(const MixerSnapshot& snapshot);
    void mixChanged();
    WorldView& view() noexcept { return view_; }
    DrawPane& drawing() noexcept { return pane_; }
    MixerCompare& compare() noexcept { return comparison_; }
    void tilt(double degrees) { tilt_.turnTo(degrees); } ///< turns gravity to that angle
    /// Shows only the field and its actuators, for an audience.
    void setShowMode(bool isShow);
    /// Hides figures and knobs for engineers; shows the master if there are no channel strips.
    void setPlayMode(bool isPlay, bool hasMaster);
    /// The context menu at `place`, in pixels of the view.
    juce::PopupMenu makeMenu(juce::Point<float> place);
    /// Area of a message over this panel: its bottom row, without the master. In pixels of the panel.
    juce::Rectangle<int> bannerArea() const;

    static constexpr int silenceWidth = 174; ///< of the silence button in show mode, px

    // Menu commands on an actuator that other panels carry out.
    std::function<void(int actuator)> onOutput, onProfile;
    OpenMaterialPage onMaterial; ///< opens the page of a material

    bool isDragging() const { return view_.isDragging() || pane_.isDrawing(); }
    void cancelDrag(); ///< restores the state before the drag

    bool keyPressed(const juce::KeyPress& key) override;
    bool keyStateChanged(bool isDown) override;
    void mouseDown(const juce::MouseEvent&) override { isBadgeMoving_ = false; }
    void mouseDrag(const juce::MouseEvent& e) override {
        if (player_ && player_->moves() && e.eventComponent == &view_ && !view_.isHolding())
            pointerXMetres_ = fieldXMetres(e.position.x);
    }
    void mouseUp(const juce::MouseEvent&) override;
    void paint(juce::Graphics& g) override { drawPanel(g, *this); }
    void resized() override;

private:
    void sendGrip(); ///< sends the newest grip, at most every 10 ms
    void addActuatorItems(juce::PopupMenu& menu, int actuator);
    void addBodyItems(juce::PopupMenu& menu, const std::string& body, Vector place);
    void addFieldItems(juce::PopupMenu& menu, FieldShare share, Vector place);
    void placeBodyPanel(); ///< lays the body panel beside, above or in the field
    juce::Rectangle<int> bodyPanelAreaInField(int width, int height) const;
    void showTools(); ///< updates all controls of drawing
    void sendInput(const std::vector<Action>& actions);
    void updatePlayer();                ///< moves the player towards the pointer, and keeps it in the field
    double fieldXMetres(float x) const; ///< x on the field, m, from pixels of the view
    juce::String hitText(const CollisionEvent& hit) const;
    juce::String fitInLines(const juce::StringArray& parts) const;
    juce::String muteReason() const { return model_.isSilent() ? "silent" : silenceReason(model_); }
    juce::String findNothingFeltReason(double nowMs, bool isRunning) const;
    void showHit();

    MixerModel& model_;
    WorldView view_;
    DrawPane pane_{model_, view_};
    DrawBar toolBar_{pane_};
    MaterialPalette palette_{model_, pane_, onMaterial};
    BodyPanel bodyPanel_{model_, pane_, onMaterial};
    ScriptStrip scriptStrip_{model_};
    Caption hitLabel_{{}, Shade::highlight}, lawLabel_, tiltLabel_, dragLabel_;
    juce::TextButton abButton_{"A/B"};
    MixerCompare comparison_{model_};
    TiltKnob tilt_;
    juce::Slider drag_;
    MasterStrip master_{model_, true};
    std::optional<ScenePlayer> player_;     // for a scene with a player
    std::optional<double> pointerXMetres_;  // x of the pressed mouse on the field, m
    std::vector<Action> pendingInputs_;     // replace the script; sent after the restart of the world
    std::size_t previousRunCount_ = 0;      // number of scene runs before that restart
    std::optional<GripAction> pendingGrip_; // not sent yet; see sendGrip()
    double lastGripMs_ = 0.0;
    bool isBadgeMoving_ = false; // a badge is being moved since the mouse was pressed
    bool isShowMode_ = false, isPlayMode_ = false, hasMaster_ = false;
    double hitTimeMs_ = 0.0;
    CollisionEvent shownHit_;               // described in hitLabel_; amplitude 0: none yet
    std::shared_ptr<const Scene> hitScene_; // scene of shownHit_
    juce::String nothingFeltReason_;        // in hitLabel_; empty: something is felt
    std::shared_ptr<const Scene> shownScene_;
    std::uint64_t shownEditCount_ = 0;
};

} // namespace physvib
