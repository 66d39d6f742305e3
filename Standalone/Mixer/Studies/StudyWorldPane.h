// SPDX-License-Identifier: GPL-3.0-or-later
// View of a trial's world with user input. It shows neither actuators nor impact flashes, which would reveal
// the stimulus.
#pragma once
#include "Mixer/Studies/StudyWorld.h"
#include "Mixer/World/TiltKnob.h"

namespace physvib {

/// Message thread only.
class StudyWorldPane final : public juce::Component {
public:
    explicit StudyWorldPane(Desk& desk);

    std::function<void(const std::string& fault)> onFault; ///< reports invalid user input

    /// See StudyWorld::begin.
    std::string begin(FeltWorld world, bool hasHands, const std::filesystem::path& file);
    /// Pictures of materials, and the display scale of the next worlds: see WorldView.
    void show(std::vector<MaterialPicture> pictures) { view_.showPictures(std::move(pictures)); }
    void setWorldScale(double metresPerMetre) {
        worldScale_ = metresPerMetre, view_.setWorldScale(metresPerMetre);
    }
    /// Shows a scene at its start, before it is played.
    void preview(const Scene& scene);
    StudyWorld& world() noexcept { return world_; }
    const StudyWorld& world() const noexcept { return world_; }
    WorldView& view() noexcept { return view_; }
    bool isPlaying() const noexcept { return world_.isPlaying(); }
    void refresh();
    /// Arrow keys tilt an interactive world while it runs.
    bool takeKey(const juce::KeyPress& key) { return hasHands_ && world_.isMoving() && tilt_.takeKey(key); }

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void act(const Action& action);
    Desk& desk_;
    StudyWorld world_;
    WorldView view_;
    TiltKnob tilt_;
    bool hasHands_ = false;
    double worldScale_ = 0.0;
};

} // namespace physvib
