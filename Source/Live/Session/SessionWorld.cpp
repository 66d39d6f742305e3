// SPDX-License-Identifier: MIT
// Runs scenes one after the other, and converts world time to session time.
#include "Live/Session/SessionWorld.h"
#include <algorithm>
#include <iterator>
#include <utility>

namespace physvib {

namespace {

// The first stall of `from` may be the last of `to`, grown since it was read: then both begin at the same
// world time.
void moveTo(SceneRun& to, SceneRun& from) {
    std::ranges::move(from.inputs, std::back_inserter(to.inputs));
    from.inputs.clear();
    for (const WorldStall& stall : from.stalls) {
        if (!to.stalls.empty() && to.stalls.back().worldNs == stall.worldNs)
            to.stalls.back() = stall;
        else
            to.stalls.push_back(stall);
    }
    to.worldEndNs = from.worldEndNs;
}

} // namespace

void SessionWorld::start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed) {
    auto next = std::make_unique<Simulation>(*scene, seed, run_.stepsPerSecond, run_.timing, run_.location);
    if (world_) {
        dropsBefore_ += world_->drops();
        take_.worldEndNs = world_->timeNs();
        if (isLogged_) ended_.push_back(std::move(take_));
    }
    world_ = std::move(next);
    originNs_ = sessionNs;
    steps_ = 0;
    stalledStep_ = -1;
    ++takeCount_;
    take_ = {sessionNs, 0, seed, std::move(scene), {}, {}};
}

void SessionWorld::forget(std::int64_t sessionNs) {
    const SceneRun last = std::move(take_);
    ended_.clear();
    isBegun_ = false;
    takeCount_ = 0;
    world_.reset();
    dropsBefore_ = 0;
    shaper_.forget();
    start(sessionNs, last.scene, last.seed);
}

void SessionWorld::step(std::vector<CollisionEvent>& made) {
    const std::size_t before = made.size();
    world_->step(made);
    world_->forgetDone();
    ++steps_;
    for (std::size_t i = before; i < made.size(); ++i) {
        made[i].timeNs += originNs_;
        made[i] = shaper_(made[i]);
    }
}

void SessionWorld::standStill(std::int64_t lengthNs) {
    originNs_ += lengthNs;
    if (!isLogged_) return;
    auto& stalls = take_.stalls;
    const bool isSameMoment = stalledStep_ == steps_ && stalls.back().steps == 1;
    const bool isSlowMotion =
        stalledStep_ == steps_ - 1 && !stalls.empty() && stalls.back().lengthNs == lengthNs;
    if (isSameMoment)
        stalls.back().lengthNs += lengthNs;
    else if (isSlowMotion)
        ++stalls.back().steps;
    else
        stalls.push_back({world_->timeNs(), lengthNs});
    stalledStep_ = steps_;
}

void SessionWorld::addInput(std::int64_t sessionNs, Action action) {
    world_->addInput(static_cast<double>(std::max<std::int64_t>(0, sessionNs - originNs_)) * 1e-9,
                     std::move(action));
    if (isLogged_) take_.inputs.push_back(world_->scene().inputs.back());
}

void SessionWorld::readPoses(std::vector<BodyPose>& poses) const {
    constexpr BodyPose gone{0.0, 0.0, 0.0, false};
    poses.clear();
    world_->forAllBodies([&](std::size_t number, const BodyPose& pose) {
        if (isLogged_) poses.resize(number, gone);
        poses.push_back(pose);
    });
    if (isLogged_) poses.resize(world_->bodyCount(), gone);
}

SessionSize SessionWorld::size() const noexcept {
    SessionSize size{world_->bodiesInBox2d(), world_->scene().inputs.size() + take_.inputs.size()};
    for (const SceneRun& ended : ended_) size.inputs += ended.inputs.size();
    return size;
}

void SessionWorld::moveLog(std::vector<SceneRun>& log) {
    take_.worldEndNs = world_->timeNs();
    const auto append = [&](SceneRun& from) {
        if (!std::exchange(isBegun_, true)) log.push_back({from.startNs, 0, from.seed, from.scene, {}, {}});
        moveTo(log.back(), from);
    };
    for (SceneRun& ended : ended_) {
        append(ended);
        isBegun_ = false;
    }
    ended_.clear();
    append(take_);
    if (take_.stalls.size() > 1) take_.stalls.erase(take_.stalls.begin(), take_.stalls.end() - 1);
}

} // namespace physvib
