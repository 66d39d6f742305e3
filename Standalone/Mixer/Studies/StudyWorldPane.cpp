// SPDX-License-Identifier: GPL-3.0-or-later
// Converts mouse and key input to inputs of the session that is played.
#include "Mixer/Studies/StudyWorldPane.h"
#include "Io/Text/NumberText.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

StudyWorldPane::StudyWorldPane(Desk& desk)
    : desk_{desk}
    , world_{desk} {
    setTitle("World of the trial");
    view_.onPull = [this](const std::string& body, Vector screenMetres, Vector point) {
        if (hasHands_)
            act(ImpulseAction{body, {thesisDrag * screenMetres.x, thesisDrag * screenMetres.y}, point});
    };
    tilt_.onValueChange = [this] { act(TiltAction{tilt_.angleRadians()}); };
    view_.setMargin(8);        // there are no badges here
    view_.showMaterials(true); // materials are visible, as participants form expectations by them
    addAndMakeVisible(view_);
    addChildComponent(tilt_);
}

void StudyWorldPane::act(const Action& action) {
    if (const auto fault = world_.act(action); !fault.empty() && onFault) onFault(fault);
}

std::string StudyWorldPane::begin(FeltWorld world, bool hasHands, const std::filesystem::path& file) {
    preview(world.setup.scene);
    if (!view_.fits()) {
        const auto millimetres = [this](double metres) { return fixedNumber(1e3 * metres / worldScale_, 0); };
        const Scene& scene = world.setup.scene;
        return "display_scale: expected a larger window or display, as the world is " +
               millimetres(scene.fieldWidthMetres) + " x " + millimetres(scene.fieldHeightMetres) +
               " mm at 1:" + numberText(worldScale_);
    }
    if (auto fault = world_.begin(std::move(world), hasHands, file); !fault.empty()) return fault;
    hasHands_ = hasHands;
    tilt_.setVisible(hasHands);
    tilt_.setValue(0.0, juce::dontSendNotification);
    preview(world_.scene());
    return {};
}

void StudyWorldPane::preview(const Scene& scene) {
    view_.setDisplayWidth(desk_.displayWidthMetres());
    view_.show(Scene{}); // resets the view if the same scene starts again
    view_.show(scene);
}

void StudyWorldPane::refresh() {
    if (auto moment = world_.look(); !moment.poses.empty()) view_.update(std::move(moment));
}

void StudyWorldPane::paint(juce::Graphics& g) { drawPanel(g, *this); }

void StudyWorldPane::resized() {
    view_.setBounds(getLocalBounds().reduced(3));
    tilt_.setBounds(getLocalBounds().reduced(10).removeFromBottom(44).removeFromRight(44));
}

} // namespace physvib
