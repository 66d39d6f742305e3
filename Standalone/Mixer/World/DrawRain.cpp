// SPDX-License-Identifier: GPL-3.0-or-later
// Rain that comes ball by ball, and fountains.
#include "Mixer/Desk/DeskWords.h"
#include "Mixer/World/DrawPane.h"
#include "Mixer/World/FeltHint.h"
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

void DrawPane::setRainWay(const RainWay& way) {
    rainWay_ = way;
    if (onChange) onChange();
}

void DrawPane::beginRain(Result<std::vector<BodyDescription>> bodies) {
    if (!bodies) return desk_.report(utf8(bodies.error));
    if (!prepare(bodies.value)) return;
    if (rainWay_.isFountain) makeFountain(bodies.value, desk_.world().drawing().drawn());
    std::ranges::reverse(bodies.value);
    falling_ = std::move(bodies.value);
    rainFromNs_ = desk_.session().world().sceneNs();
    rained_ = 0;
    desk_.undoManager().beginNewTransaction(rainStep);
    letItRain();
}

// By the time of the world: it waits in a pause, and ends when the scene starts anew or the rain is undone.
void DrawPane::letItRain() {
    if (falling_.empty()) return;
    const auto passed = desk_.session().world().sceneNs() - rainFromNs_;
    const bool isUndone = desk_.undoManager().getRedoDescription() == rainStep;
    if (passed < 0 || isUndone) return falling_.clear();
    const auto due = 1 + passed * rainWay_.perSecond / 1'000'000'000;
    const bool isFirst = rained_ == 0;
    std::vector<Action> actions;
    std::string name;
    for (; rained_ < due && !falling_.empty(); ++rained_) {
        if (!isFirst) // another rain may have taken its name
            falling_.back().name = desk_.world().drawing().freeNames("rain", actions.size() + 1).back();
        name = falling_.back().name;
        actions.push_back(SpawnAction{std::move(falling_.back()), {}});
        falling_.pop_back();
    }
    if (actions.empty()) return;
    if (const auto error = desk_.world().edit(rainStep, std::move(actions), true); !error.empty()) {
        falling_.clear();
        return desk_.report(utf8(error));
    }
    if (isFirst) hintOnBody(desk_, name);
}

} // namespace physvib
