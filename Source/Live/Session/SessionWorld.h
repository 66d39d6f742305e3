// SPDX-License-Identifier: MIT
// The world of a session, in session time: one take after the other, with stalls and live inputs, and the log
// of them.
#pragma once
#include "Core/EventShaping.h"
#include "Live/Session/SessionSetup.h"
#include "Scene/SceneTake.h"
#include "Scene/World/SceneRun.h"
#include "Scene/World/Simulation.h"
#include <cstdint>
#include <memory>
#include <vector>

namespace physvib {

/// Keeps of the past what nobody has read yet, and nothing if it is not logged. One thread at a time: Session
/// guards it by its mutex.
class SessionWorld {
public:
    /// `run` gives step rate, timing and location; the seed is each take's own.
    explicit SessionWorld(const SceneRun& run, const EventShaping& shaping = {}, bool isLogged = true)
        : run_{run}
        , shaper_{shaping}
        , isLogged_{isLogged} {}

    /// A new take from `sessionNs` on. Throws what Simulation throws; then all stays as it was.
    void start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed);

    /// The take that runs is the first again, at that session time; the log begins anew.
    void forget(std::int64_t sessionNs = 0);

    /// Session time up to which the world has been stepped.
    std::int64_t timeNs() const noexcept { return originNs_ + world_->timeNs(); }

    /// Time of the take's world itself.
    std::int64_t sceneNs() const noexcept { return world_->timeNs(); }

    /// One step; events are appended, shaped and in session time.
    void step(std::vector<CollisionEvent>& made);

    /// The world is `lengthNs` later from now on.
    void standStill(std::int64_t lengthNs);

    /// A valid input that acts at `sessionNs`, or in the next step if that is past.
    void addInput(std::int64_t sessionNs, Action action);

    /// the one that runs; of its inputs and stalls, what nobody has read
    const SceneTake& take() const noexcept { return take_; }
    std::size_t takeCount() const noexcept { return takeCount_; }
    /// In Box2D's world; inputs that wait, or that nobody has read.
    SessionSize size() const noexcept;
    void readPoses(std::vector<BodyPose>& poses) const; ///< see Session
    std::uint64_t drops() const noexcept { return dropsBefore_ + world_->drops(); }

    /// Moves to `log` what is new since the last call; at the first one it is empty. Costs as much as that.
    void moveLog(std::vector<SceneTake>& log);

private:
    SceneRun run_;
    EventShaper shaper_;
    bool isLogged_;
    std::vector<SceneTake> ended_; // not read to their ends
    SceneTake take_;               // its last stall stays when it is read: it may grow
    bool isBegun_ = false;         // the reader has the beginning of the oldest of them
    std::size_t takeCount_ = 0;
    std::unique_ptr<Simulation> world_;
    std::int64_t originNs_ = 0;                 // session time - world time
    std::int64_t steps_ = 0, stalledStep_ = -1; // of the take; the last one after which it stood still
    std::uint64_t dropsBefore_ = 0;
};

} // namespace physvib
