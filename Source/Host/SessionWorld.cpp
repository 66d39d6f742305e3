// SPDX-License-Identifier: GPL-3.0-or-later
// Takes, and the step from world time to session time.
#include "Host/SessionWorld.h"
#include <algorithm>

namespace physvib {

void SessionWorld::start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed) {
    auto next = std::make_unique<Simulation>(*scene, seed, run_.stepsPerSecond, run_.timing, run_.location);
    if (world_) {
        dropsBefore_ += world_->drops();
        const auto inputs = inputsOf(takes_.size() - 1);
        takes_.back().inputs.assign(inputs.begin(), inputs.end());
        takes_.back().worldEndNs = world_->timeNs();
    }
    world_ = std::move(next);
    originNs_ = sessionNs;
    steps_ = 0;
    stalledStep_ = -1;
    takes_.push_back({sessionNs, 0, seed, std::move(scene), {}, {}});
}

void SessionWorld::forget() {
    const SceneTake last = takes_.back();
    takes_.clear();
    world_.reset();
    dropsBefore_ = 0;
    start(0, last.scene, last.seed);
}

void SessionWorld::step(std::vector<CollisionEvent>& made) {
    const std::size_t before = made.size();
    world_->step(made);
    ++steps_;
    for (std::size_t i = before; i < made.size(); ++i) {
        made[i] = shaping_(made[i]);
        made[i].timeNs += originNs_;
    }
}

void SessionWorld::standStill(std::int64_t lengthNs) {
    auto& stalls = takes_.back().stalls;
    const bool isSameMoment = stalledStep_ == steps_ && stalls.back().steps == 1;
    const bool isSlowMotion = stalledStep_ == steps_ - 1 && !stalls.empty() && stalls.back().lengthNs == lengthNs;
    if (isSameMoment) stalls.back().lengthNs += lengthNs;
    else if (isSlowMotion) ++stalls.back().steps;
    else stalls.push_back({world_->timeNs(), lengthNs});
    stalledStep_ = steps_;
    originNs_ += lengthNs;
}

void SessionWorld::addInput(std::int64_t sessionNs, Action action) {
    world_->addInput(static_cast<double>(std::max<std::int64_t>(0, sessionNs - originNs_)) * 1e-9, std::move(action));
}

// A take that has ended is stored whole; the one that runs keeps its inputs in its world.
std::span<const LiveInput> SessionWorld::inputsOf(std::size_t take) const {
    if (take + 1 < takes_.size()) return takes_[take].inputs;
    return std::span(sceneNow().inputs).subspan(takes_[take].scene->inputs.size());
}

void SessionWorld::bringUpToDate(std::vector<SceneTake>& log) const {
    for (std::size_t i = log.empty() ? 0 : log.size() - 1; i < takes_.size(); ++i) {
        const SceneTake& take = takes_[i];
        if (i == log.size()) log.push_back({take.startNs, 0, take.seed, take.scene, {}, {}});
        const auto inputs = inputsOf(i);
        log[i].inputs.insert(log[i].inputs.end(), inputs.begin() + static_cast<std::ptrdiff_t>(log[i].inputs.size()), inputs.end());
        log[i].stalls = take.stalls;
        log[i].worldEndNs = i + 1 < takes_.size() ? take.worldEndNs : world_->timeNs();
    }
}

} // namespace physvib
