// SPDX-License-Identifier: MIT
// Steps the world, queues its events for the renderer, and applies new scenes between steps.
#include "Live/Session/WorldRunner.h"
#include "Live/Session/Scheduler.h"
#include "Scene/SceneValidation.h"
#include <iterator>

namespace physvib {
namespace {

constexpr int maxLockTries = 8; // a millisecond apart; most steps are shorter, and a display can wait

// moveLog() keeps the last stall of a run, because it may still grow. So the first stall of `source` may be
// the last one of `target` with a new length; then both begin at the same world time.
void moveRun(SceneRun& target, SceneRun& source) {
    std::ranges::move(source.inputs, std::back_inserter(target.inputs));
    source.inputs.clear();
    for (const WorldStall& stall : source.stalls) {
        if (!target.stalls.empty() && target.stalls.back().worldNs == stall.worldNs)
            target.stalls.back() = stall;
        else
            target.stalls.push_back(stall);
    }
    target.worldEndNs = source.worldEndNs;
}

} // namespace

WorldRunner::WorldRunner(const std::shared_ptr<const SessionSetup>& setup, const Timeline& time,
                         DevicePulse& pulse, CallbackInputs& callback, SinkSet& sinks)
    : setup_{*setup}
    , time_{time}
    , pulse_{pulse}
    , callback_{callback}
    , sinks_{sinks}
    , world_{setup_.run(), setup_.shaping, setup_.log != LogUse::none}
    , state_{{setup, &setup->scene}, setup_.seed} {
    if (setup_.hasWorld) unqueued_.reserve(32); // more than most steps make
    world_.start(0, state_.scene, state_.seed);
    publishPoses();
}

std::string WorldRunner::setState(SessionState state) {
    if (std::string error = validate(*state.scene); !error.empty()) return error;
    const std::lock_guard lock{stateMutex_};
    if (state == state_) return {};
    state_ = std::move(state);
    isStateNew_ = true;
    return {};
}

SessionState WorldRunner::state() const {
    const std::lock_guard lock{stateMutex_};
    return state_;
}

void WorldRunner::prepare() {
    restartFrame_ = -1;
    startRequestedRun();
    world_.reset(time_.nowNs());
    unqueued_.clear();
    firstUnqueued_ = 0;
    scheduled_ = {};
    startedEvents_.clear();
    for (CollisionEvent unplayed; queue_.pop(unplayed);) {
    }
    steppedNs_ = time_.nowNs();
    publishSceneTime();
    stalledNs_ = 0;
    slowness_ = 1;
    requestedSteps_ = 0;
    isOffline_ = false;
    hasStepped_ = !setup_.hasWorld;
    hasFailed_ = false;
    drops_ = world_.drops();
    publishPoses();
}

void WorldRunner::resume(const FrameClock& clock) {
    catchUp(time_.nowNs()); // the new output latency may allow less lag than the old
    if (restartFrame_ >= 0) restartFrame_ = clock.at(time_.sessionNs(restartFrame_)).frame;
}

int WorldRunner::advance(const StepWatch& keepGoing) {
    const std::lock_guard lock{mutex_};
    // R sets the mode of a block before its frames count: read after the time, an offline block, in which R
    // steps the world itself, is never taken for a stall
    const std::int64_t now = time_.nowNs();
    if (isOffline_.load(std::memory_order_acquire)) return 0;
    hasStepped_.store(true, std::memory_order_release);
    startRequestedRun();
    const int steps = catchUp(now, keepGoing);
    if (publishesPoses_.load(std::memory_order_relaxed)) publishPoses();
    return steps;
}

// Estimates the start of the block for which the next step is needed. A paused world handles its inputs as
// often as it would step.
std::int64_t WorldRunner::nextStepNs() const {
    const std::lock_guard lock{mutex_};
    const std::int64_t blockNs = time_.sessionNs(time_.law().blockFrames),
                       aheadNs = isPaused()
                                     ? static_cast<std::int64_t>(1e9 * time_.law().stepSeconds()) - blockNs
                                     : world_.timeNs() - time_.nowNs();
    return pulse_.lastNs() + (std::max<std::int64_t>(0, aheadNs) / blockNs + 1) * blockNs;
}

int WorldRunner::catchUp(std::int64_t nowNs, const StepWatch& keepGoing) {
    if (const std::int64_t lagNs = nowNs - world_.timeNs(); lagNs > time_.longestLagNs()) {
        stalledNs_ += lagNs - time_.law().safeLagNs();
        world_.addStall(lagNs - time_.law().safeLagNs());
    }
    moveDueEvents(nowNs);
    callback_.passInputsTo(world_); // inputs that R made before `nowNs` are in the queue already
    int steps = 0;
    for (; world_.timeNs() < nowNs && (steps == 0 || !keepGoing || keepGoing(world_.timeNs())); ++steps) {
        stepWorld(nowNs);
        queueEvents(); // the next block may begin before the last step
    }
    queueEvents();
    return steps;
}

// Makes one step, or a stall up to `untilNs` if the world is paused. Its time must be before `untilNs`.
void WorldRunner::stepWorld(std::int64_t untilNs) {
    if (isPaused()) return world_.addStall(untilNs - world_.timeNs());
    const int slowness = this->slowness();
    if (slowness == 0) requestedSteps_.fetch_sub(1, std::memory_order_relaxed);
    const std::int64_t startNs = world_.timeNs();
    world_.step(unqueued_);
    drops_.store(world_.drops(), std::memory_order_relaxed);
    if (slowness > 1) world_.addStall((slowness - 1) * (world_.timeNs() - startNs));
}

// Starts a new scene run if one is requested; the request is cleared only after the start.
void WorldRunner::startRequestedRun() {
    const std::int64_t frame = restartFrame_.exchange(-1, std::memory_order_acquire);
    const std::lock_guard lock{stateMutex_};
    if (frame < 0 && !isStateNew_) return;
    world_.start(frame < 0 ? time_.nowNs() : time_.sessionNs(frame), state_.scene, state_.seed);
    isStateNew_ = hasFailed_ = false;
    publishSceneTime();
    publishPoses();
}

// Queues the events of steps; true if all of them fitted.
bool WorldRunner::queueEvents() {
    dropScheduled();
    for (; firstUnqueued_ < unqueued_.size() && queue_.push(unqueued_[firstUnqueued_]); ++firstUnqueued_)
        sinks_.onCollision(unqueued_[firstUnqueued_]);
    if (firstUnqueued_ < unqueued_.size()) return false;
    unqueued_.clear();
    firstUnqueued_ = 0;
    publishSceneTime();
    steppedNs_.store(world_.timeNs(), std::memory_order_release);
    return true;
}

void WorldRunner::publishSceneTime() noexcept {
    sceneNs_.store(world_.sceneNs(), std::memory_order_relaxed);
    runNumber_.store(world_.runCount(), std::memory_order_relaxed);
}

// Drops the strikes that waited while the device paused, once it is back. A thread that has read a session
// time after the pause, and then calls this, sees the pause too.
void WorldRunner::dropScheduled() {
    const DevicePulse::PauseHistory current = pulse_.history(), last = std::exchange(seenPauses_, current);
    if (current.pauses == last.pauses) return;
    const WaitingEvents lateEvents{current.losses != last.losses ? INT64_MAX : current.untilNs,
                                   setup_.hasCallerEvents()};
    const auto first = unqueued_.begin() + static_cast<std::ptrdiff_t>(firstUnqueued_);
    const auto dropped = std::remove_if(first, unqueued_.end(), [=](const CollisionEvent& event) {
        return lateEvents.contain(event, event.timeNs);
    });
    std::vector<CollisionEvent> due;
    scheduled_.moveDue(lateEvents.untilNs, due);
    pulse_.drop(due.size() + static_cast<std::size_t>(unqueued_.end() - dropped));
    unqueued_.erase(dropped, unqueued_.end());
}

void WorldRunner::moveDueEvents(std::int64_t untilNs) {
    dropScheduled();
    std::vector<CollisionEvent> due;
    scheduled_.moveDue(untilNs, due);
    std::ranges::transform(due, std::back_inserter(unqueued_), setup_.shaping);
    if (setup_.log != LogUse::none) std::ranges::move(due, std::back_inserter(startedEvents_));
}

bool WorldRunner::beginBlock(RenderMode mode) noexcept {
    const bool isOffline = mode == RenderMode::offline;
    isOffline_.store(isOffline, std::memory_order_release);
    if (isOffline) hasStepped_.store(true, std::memory_order_release);
    return hasStepped_.load(std::memory_order_acquire);
}

void WorldRunner::beginOffline(std::int64_t endNs) {
    startRequestedRun();
    moveDueEvents(endNs);
    callback_.passInputsTo(world_);
}

// Steps the world whenever the queue is empty.
bool WorldRunner::popOrStep(CollisionEvent& event, std::int64_t endNs) noexcept {
    while (!queue_.pop(event)) {
        bool hasMore = false;
        tryTo([&] {
            hasMore = !queueEvents() || world_.timeNs() < endNs;
            if (world_.timeNs() < endNs) stepWorld(endNs);
        });
        if (!hasMore) return queue_.pop(event);
    }
    return true;
}

// Starts a requested scene run that is due, so that the caller's action goes to the new one.
std::shared_ptr<const Scene> WorldRunner::scene(std::size_t& number) {
    const std::lock_guard lock{mutex_};
    const std::int64_t restart = restartFrame_.load(std::memory_order_acquire);
    if (restart < 0 || time_.sessionNs(restart) <= time_.nowNs()) startRequestedRun();
    number = world_.runCount();
    return world_.currentRun().scene;
}

bool WorldRunner::addInputs(std::size_t number, std::span<const Action> actions) {
    const std::lock_guard lock{mutex_};
    if (number != world_.runCount()) return false;
    for (const Action& action : actions) world_.addInput(time_.nowNs(), action);
    return true;
}

void WorldRunner::strike(std::span<const CollisionEvent> events) {
    const std::lock_guard lock{mutex_};
    dropScheduled();
    std::ranges::transform(events, std::back_inserter(unqueued_), setup_.shaping);
    queueEvents();
}

bool WorldRunner::schedule(std::span<const CollisionEvent> events) {
    const std::lock_guard lock{mutex_};
    dropScheduled();
    if (!scheduled_.add(events)) return false;
    moveDueEvents(time_.nowNs());
    queueEvents();
    return true;
}

void WorldRunner::cancelScheduled(std::int64_t fromNs, std::int64_t nowNs) {
    const std::lock_guard lock{mutex_};
    moveDueEvents(nowNs);
    queueEvents();
    scheduled_.cancelFrom(fromNs);
}

std::int64_t WorldRunner::moveLog(SessionLog& log) {
    const std::lock_guard lock{mutex_};
    std::ranges::move(startedEvents_, std::back_inserter(log.strikes));
    startedEvents_.clear();
    world_.moveLog(log.runs);
    return std::min(time_.nowNs(), world_.timeNs());
}

SessionSize WorldRunner::size() const {
    const std::lock_guard lock{mutex_};
    SessionSize size = world_.size();
    size.strikes = scheduled_.size();
    return size;
}

void WorldRunner::publishPoses() const {
    const std::lock_guard lock{publishedMutex_};
    world_.readPoses(publishedPoses_);
    publishedNs_ = world_.timeNs();
}

// If a step lasts too long for a display, it gets the poses of the last complete step.
std::int64_t WorldRunner::readPoses(std::vector<BodyPose>& poses) const {
    std::unique_lock lock{mutex_, std::try_to_lock};
    for (int k = 0; !lock && k < maxLockTries && !publishesPoses_.load(std::memory_order_relaxed); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
        (void)lock.try_lock();
    }
    publishesPoses_.store(!lock, std::memory_order_relaxed);
    if (lock) {
        world_.readPoses(poses);
        return world_.timeNs();
    }
    const std::lock_guard publishedLock{publishedMutex_};
    poses = publishedPoses_;
    return publishedNs_;
}

void SessionWorld::start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed) {
    auto next = std::make_unique<Simulation>(*scene, seed, run_.stepsPerSecond, run_.timing, run_.location);
    if (world_) {
        dropsBefore_ += world_->drops();
        currentRun_.worldEndNs = world_->timeNs();
        if (isLogged_) endedRuns_.push_back(std::move(currentRun_));
    }
    world_ = std::move(next);
    originNs_ = sessionNs;
    steps_ = 0;
    stalledStep_ = -1;
    ++runCount_;
    currentRun_ = {sessionNs, 0, seed, std::move(scene), {}, {}};
}

void SessionWorld::reset(std::int64_t sessionNs) {
    const SceneRun last = std::move(currentRun_);
    endedRuns_.clear();
    isStartRead_ = false;
    runCount_ = 0;
    world_.reset();
    dropsBefore_ = 0;
    shaper_.reset();
    start(sessionNs, last.scene, last.seed);
}

void SessionWorld::step(std::vector<CollisionEvent>& events) {
    const std::size_t oldSize = events.size();
    try {
        world_->step(events);
        world_->dropExecutedInputs();
        ++steps_;
        for (std::size_t i = oldSize; i < events.size(); ++i) events[i].timeNs += originNs_;
        shaper_.shape(events, oldSize);
    } catch (...) {
        events.resize(oldSize); // half of a step is not played
        throw;
    }
}

void SessionWorld::addStall(std::int64_t lengthNs) {
    originNs_ += lengthNs;
    if (!isLogged_) return;
    auto& stalls = currentRun_.stalls;
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
    if (isLogged_) currentRun_.inputs.push_back(world_->scene().inputs.back());
}

void SessionWorld::setPace(std::int64_t sessionNs, double scriptSeconds, double rate) {
    world_->addPace({static_cast<double>(sessionNs - originNs_) * 1e-9, scriptSeconds, rate});
}

void SessionWorld::readPoses(std::vector<BodyPose>& poses) const {
    constexpr BodyPose absent{0.0, 0.0, 0.0, false};
    poses.clear();
    world_->forEachBody([&](std::size_t number, const BodyPose& pose) {
        if (isLogged_) poses.resize(number, absent);
        poses.push_back(pose);
    });
    if (isLogged_) poses.resize(world_->bodyCount(), absent);
}

SessionSize SessionWorld::size() const noexcept {
    SessionSize size{world_->bodiesInBox2d(), world_->scene().inputs.size() + currentRun_.inputs.size()};
    for (const SceneRun& ended : endedRuns_) size.inputs += ended.inputs.size();
    return size;
}

void SessionWorld::moveLog(std::vector<SceneRun>& log) {
    currentRun_.worldEndNs = world_->timeNs();
    const auto append = [&](SceneRun& run) {
        if (!std::exchange(isStartRead_, true)) log.push_back({run.startNs, 0, run.seed, run.scene, {}, {}});
        moveRun(log.back(), run);
    };
    for (SceneRun& ended : endedRuns_) {
        append(ended);
        isStartRead_ = false;
    }
    endedRuns_.clear();
    append(currentRun_);
    if (currentRun_.stalls.size() > 1)
        currentRun_.stalls.erase(currentRun_.stalls.begin(), currentRun_.stalls.end() - 1);
}

} // namespace physvib
