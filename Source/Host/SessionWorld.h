// SPDX-License-Identifier: GPL-3.0-or-later
// The world of a session, in session time: one take after the other, with stalls and live inputs, and the log of them.
#pragma once
#include "Core/EventShaping.h"
#include "Physics/SceneRun.h"
#include "Physics/SceneTake.h"
#include "Physics/Simulation.h"
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace physvib {

/// One thread at a time: Session guards it by its mutex.
class SessionWorld {
public:
    /// `run` gives step rate, timing and location; the seed is each take's own.
    explicit SessionWorld(const SceneRun& run, const EventShaping& shaping = {})
        : run_{run}
        , shaping_{shaping} {}

    /// A new take from `sessionNs` on. Throws what Simulation throws; then all stays as it was.
    void start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed);

    /// The take that runs is the first again, at session time 0.
    void forget();

    /// Session time up to which the world has been stepped.
    std::int64_t timeNs() const noexcept { return originNs_ + world_->timeNs(); }

    /// One step; events are appended, shaped and in session time.
    void step(std::vector<CollisionEvent>& made);

    /// The world is `lengthNs` later from now on.
    void standStill(std::int64_t lengthNs);

    /// A valid input that acts at `sessionNs`, or in the next step if that is past.
    void addInput(std::int64_t sessionNs, Action action);

    const SceneTake& take() const noexcept { return takes_.back(); } ///< the one that runs; without its inputs
    const Scene& sceneNow() const noexcept { return world_->scene(); } ///< with its inputs
    std::size_t takeCount() const noexcept { return takes_.size(); }
    std::size_t bodyCount() const noexcept { return world_->bodyCount(); }
    BodyPose pose(std::size_t body) const noexcept { return world_->pose(body); }
    std::uint64_t drops() const noexcept { return dropsBefore_ + world_->drops(); }

    /// Adds to `log`, which is empty or filled by this function, what is new since: costs as much as that.
    void bringUpToDate(std::vector<SceneTake>& log) const;

private:
    std::span<const LiveInput> inputsOf(std::size_t take) const;

    SceneRun run_;
    EventShaping shaping_;
    std::vector<SceneTake> takes_;
    std::unique_ptr<Simulation> world_;
    std::int64_t originNs_ = 0; // session time - world time
    std::int64_t steps_ = 0, stalledStep_ = -1; // of the take; the last one after which it stood still
    std::uint64_t dropsBefore_ = 0;
};

} // namespace physvib
