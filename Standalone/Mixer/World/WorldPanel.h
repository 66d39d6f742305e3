// SPDX-License-Identifier: GPL-3.0-or-later
// Panel of the world with its controls: a sentence on the strongest impact, tilt, drag strength and panning
// law.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Desk/DeskCompare.h"
#include "Mixer/Window/Parts.h"
#include "Mixer/World/DrawBar.h"
#include "Mixer/World/ScriptStrip.h"
#include "Mixer/World/TiltKnob.h"
#include "Scene/World/ScenePlayer.h"
#include <optional>

namespace physvib {

class WorldPanel final : public juce::Component {
public:
    explicit WorldPanel(Desk& desk);

    void refresh(const DeskMoment& moment);
    void takeMix();
    WorldView& view() noexcept { return view_; }
    DrawPane& drawing() noexcept { return pane_; }
    DeskCompare& compare() noexcept { return ab_; }
    void tilt(double degrees) { tilt_.turnTo(degrees); } ///< turns gravity to that angle
    /// The field and its actuators alone.
    void setShow(bool isShow);
    /// What a right click there offers. `place` in pixels of the view.
    juce::PopupMenu menuAt(juce::Point<float> place);
    double fieldAspect() const; ///< width by height
    /// Where a message lies over this panel: beside the tools, above the field.
    juce::Rectangle<int> bannerArea() const;

    static constexpr int silenceWidth = 174; ///< of the button that silences, in the corner of a show
    /// Pixels of the panel that the field does not fill.
    static constexpr int besideField = 104, aboveAndBelowField = 134;

    // Menu commands on an actuator that other panels carry out.
    std::function<void(int enchanter)> onOutput, onProfile;

    bool keyPressed(const juce::KeyPress& key) override;
    bool keyStateChanged(bool isDown) override;
    void mouseDown(const juce::MouseEvent&) override { isMoving_ = false; }
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void pull(const std::string& body, Vector screenMetres, Vector point);
    void hold(const std::string& body, Vector point, Vector to);
    void letGo(const std::string& body);
    void moveHand();
    void showMenu(juce::Point<float> place);
    void addActuatorItems(juce::PopupMenu& menu, int enchanter);
    void addBodyItems(juce::PopupMenu& menu, const std::string& body, Vector place);
    void addEmptyItems(juce::PopupMenu& menu, FieldShare at, Vector place);
    void placeInspector();
    void showTools();
    void edit(const juce::String& name, const Action& action);
    void play(const std::vector<Action>& actions);
    void lookAfterPlayer();
    std::optional<double> playersPlace();
    juce::String sentenceOn(const CollisionEvent& hit) const;
    juce::String inLines(const juce::StringArray& parts) const;

    Desk& desk_;
    WorldView view_;
    DrawPane pane_{desk_, view_};
    DrawBar bar_{pane_};
    MaterialPalette palette_{desk_, pane_};
    BodyPanel body_{desk_, pane_};
    ScriptStrip script_{desk_};
    juce::Label sentence_, law_, tiltName_, dragName_;
    juce::TextButton compare_{"A/B"};
    DeskCompare ab_{desk_};
    TiltKnob tilt_;
    juce::Slider drag_;
    std::optional<ScenePlayer> player_; // for a scene with a player
    std::optional<double> pointed_;     // place of the held mouse on the field, m
    std::vector<Action> first_;      // input that takes over from the script, until the world has restarted
    std::size_t takesBefore_ = 0;    // number of scene runs at that time
    std::optional<GripAction> hand_; // position since the last moveHand()
    double handAtMs_ = 0.0;
    bool isMoving_ = false; // a badge is being moved since the mouse was pressed
    bool isShow_ = false;
    double hitAtMs_ = 0.0;
    CollisionEvent told_;
    std::shared_ptr<const Scene> shown_;
    std::uint64_t shownEdits_ = 0;
};

} // namespace physvib
