// SPDX-License-Identifier: GPL-3.0-or-later
// The world of a trial as it is felt now, with what hands do in it. No enchanters and no light of hits: what
// is to be felt is not shown.
#pragma once
#include "Mixer/Studies/StudyWorld.h"
#include "Mixer/World/TiltKnob.h"

namespace physvib {

/// M only.
class StudyWorldPane final : public juce::Component {
public:
    explicit StudyWorldPane(Desk& desk);

    std::function<void(const std::string& fault)> onFault; ///< a hand did what cannot be done

    /// See StudyWorld::begin.
    std::string begin(FeltWorld world, bool hasHands, const std::filesystem::path& file);
    /// How bodies look, and at which scale the next worlds are seen: see WorldView.
    void show(std::vector<MaterialPicture> pictures) { view_.showPictures(std::move(pictures)); }
    void setWorldScale(double metresPerMetre) {
        worldScale_ = metresPerMetre, view_.setWorldScale(metresPerMetre);
    }
    /// A scene as it will begin, before anything is felt.
    void preview(const Scene& scene);
    StudyWorld& world() noexcept { return world_; }
    const StudyWorld& world() const noexcept { return world_; }
    WorldView& view() noexcept { return view_; }
    bool isPlaying() const noexcept { return world_.isPlaying(); }
    void refresh();
    /// Arrows tilt, while it moves and has hands.
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
