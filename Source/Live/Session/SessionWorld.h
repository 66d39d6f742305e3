// SPDX-License-Identifier: MIT
// The physics world of a session in session time: consecutive scene runs with stalls and live inputs, and
// their log.
#pragma once
#include "Core/EventShaping.h"
#include "Live/Session/SessionSetup.h"
#include "Scene/SceneRun.h"
#include "Scene/World/Simulation.h"
#include <cstdint>
#include <memory>
#include <vector>

namespace physvib {

/// Keeps log entries until they are read, and none if not logged. One thread at a time, by Session's mutex.
class SessionWorld {
public:
    /// `run` sets step rate, timing and location; each scene run has its own seed.
    explicit SessionWorld(const RunSettings& run, const EventShaping& shaping = {}, bool isLogged = true)
        : run_{run}
        , shaper_{shaping}
        , isLogged_{isLogged} {}

    /// Starts a new scene run at `sessionNs`. Throws what Simulation throws; then nothing has changed.
    void start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed);

    /// Restarts the current scene as the first run, at that session time, with an empty log.
    void forget(std::int64_t sessionNs = 0);

    /// Session time up to which the world has been stepped.
    std::int64_t timeNs() const noexcept { return originNs_ + world_->timeNs(); }

    /// World time of the current run.
    std::int64_t sceneNs() const noexcept { return world_->timeNs(); }

    /// One step; appends its events, shaped and in session time.
    void step(std::vector<CollisionEvent>& made);

    /// Delays the world by `lengthNs` of session time.
    void standStill(std::int64_t lengthNs);

    /// Adds a valid input that acts at `sessionNs`, or in the next step if that is past.
    void addInput(std::int64_t sessionNs, Action action);

    /// Where the script is at that time, and its rate (ScriptPace). In no log.
    void pace(std::int64_t sessionNs, double scriptSeconds, double rate);

    /// the current run, with inputs and stalls that have not been read
    const SceneRun& take() const noexcept { return take_; }
    std::size_t takeCount() const noexcept { return takeCount_; }
    /// Bodies in Box2D's world; inputs that are pending or have not been read.
    SessionSize size() const noexcept;
    void readPoses(std::vector<BodyPose>& poses) const; ///< see WorldRunner
    std::uint64_t drops() const noexcept { return dropsBefore_ + world_->drops(); }

    /// Moves new log entries to `log`, which is empty at the first call. Costs as many as are new.
    void moveLog(std::vector<SceneRun>& log);

private:
    RunSettings run_;
    EventShaper shaper_;
    bool isLogged_;
    std::vector<SceneRun> ended_; // not completely read
    SceneRun take_;               // its last stall stays after reading, because it may grow
    bool isBegun_ = false;        // the reader has the beginning of the oldest run
    std::size_t takeCount_ = 0;
    std::unique_ptr<Simulation> world_;
    std::int64_t originNs_ = 0;                 // session time - world time
    std::int64_t steps_ = 0, stalledStep_ = -1; // steps of the run; step after which it was last stalled
    std::uint64_t dropsBefore_ = 0;
};

} // namespace physvib
