// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mixer/World/Rain.h"
#include "Mixer/Model/MixerMessages.h"
#include "Mixer/Widgets/Parts.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr const char* rainStep = "Let it rain";
constexpr double rise = 0.5;     // height of a fountain, of the field's
constexpr double spread = 0.25;  // of its speed, to both sides
constexpr int differentJets = 7; // balls of one jet would follow each other exactly

/// All from the middle of where they would fall from, upwards.
void makeFountain(std::vector<BodyDescription>& bodies, const Scene& scene) {
    Vector middle;
    for (const BodyDescription& body : bodies) {
        middle.x += body.positionMetres.x / static_cast<double>(bodies.size());
        middle.y += body.positionMetres.y / static_cast<double>(bodies.size());
    }
    const double gravity = std::hypot(scene.gravityMetresPerSecond2.x, scene.gravityMetresPerSecond2.y),
                 up = std::sqrt(2.0 * gravity * rise * scene.fieldHeightMetres);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const int jet = static_cast<int>(3 * k) % differentJets - differentJets / 2; // neighbours differ
        bodies[k].positionMetres = middle;
        bodies[k].velocityMetresPerSecond = {2.0 * spread * up * jet / (differentJets - 1), up};
    }
}

} // namespace

void Rain::begin(std::vector<BodyDescription> bodies) {
    if (pattern_.isFountain) makeFountain(bodies, model_.world().drawing().drawn());
    std::ranges::reverse(bodies);
    falling_ = std::move(bodies);
    fromNs_ = model_.session().world().sceneNs();
    spawned_ = 0;
    model_.undoManager().beginNewTransaction(rainStep);
    spawnDueBodies();
}

// By the time of the world: it waits in a pause, and ends when the scene starts anew or the rain is undone.
void Rain::spawnDueBodies() {
    if (falling_.empty()) return;
    const auto passed = model_.session().world().sceneNs() - fromNs_;
    const bool isUndone = model_.undoManager().getRedoDescription() == rainStep;
    if (passed < 0 || isUndone) return falling_.clear();
    const auto due = 1 + passed * pattern_.perSecond / 1'000'000'000;
    const bool isFirst = spawned_ == 0;
    std::vector<Action> actions;
    std::string name;
    for (; spawned_ < due && !falling_.empty(); ++spawned_) {
        if (!isFirst) // another rain may have taken its name
            falling_.back().name = model_.world().drawing().freeNames("rain", actions.size() + 1).back();
        name = falling_.back().name;
        actions.push_back(SpawnAction{std::move(falling_.back()), {}});
        falling_.pop_back();
    }
    if (actions.empty()) return;
    if (const auto error = model_.world().edit(rainStep, std::move(actions), true); !error.empty()) {
        falling_.clear();
        return model_.report(utf8(error));
    }
    if (isFirst) hintOnBody(model_, name);
}

} // namespace physvib
