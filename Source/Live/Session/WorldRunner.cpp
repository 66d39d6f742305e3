// SPDX-License-Identifier: MIT
// Steps the world, queues its events for the renderer, and applies new scenes between steps.
#include "Live/Session/WorldRunner.h"
#include "Live/Session/Scheduler.h"
#include "Scene/SceneValidation.h"
#include <iterator>

namespace physvib {
namespace {

constexpr int posesTries = 8; // a millisecond apart: most steps are shorter, and a display can wait that long

// moveLog() keeps the last stall of a run, because it may still grow. So the first stall of `from` may be the
// last one of `to` with a new length; then both begin at the same world time.
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

WorldRunner::WorldRunner(const std::shared_ptr<const SessionSetup>& setup, const Timeline& time,
                         DevicePulse& pulse, CallbackInputs& callback, SinkSet& sinks)
    : setup_{*setup}
    , time_{time}
    , pulse_{pulse}
    , callback_{callback}
    , sinks_{sinks}
    , world_{setup_.run(), setup_.shaping, setup_.log != LogUse::none}
    , state_{{setup, &setup->scene}, setup_.seed} {
    if (setup_.hasWorld) made_.reserve(32); // more than most steps make
    world_.start(0, state_.scene, state_.seed);
    showPoses();
}

std::string WorldRunner::setState(SessionState state) {
    if (std::string fault = validate(*state.scene); !fault.empty()) return fault;
    const std::lock_guard lock{stateMutex_};
    if (state == state_) return {};
    state_ = std::move(state);
    isNew_ = true;
    return {};
}

SessionState WorldRunner::state() const {
    const std::lock_guard lock{stateMutex_};
    return state_;
}

void WorldRunner::prepare() {
    restartFrame_ = -1;
    startRequestedRun();
    world_.forget(time_.nowNs());
    made_.clear();
    handed_ = 0;
    waiting_ = {};
    begun_.clear();
    for (CollisionEvent unplayed; queue_.pop(unplayed);) {
    }
    steppedNs_ = time_.nowNs();
    publishScene();
    slippedNs_ = 0;
    slowness_ = 1;
    stepsWanted_ = 0;
    offline_ = false;
    isDriven_ = !setup_.hasWorld;
    drops_ = world_.drops();
    showPoses();
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
    if (offline_.load(std::memory_order_acquire)) return 0;
    isDriven_.store(true, std::memory_order_release);
    startRequestedRun();
    const int steps = catchUp(now, keepGoing);
    if (isShown_.load(std::memory_order_relaxed)) showPoses();
    return steps;
}

// Estimates the start of the block for which the next step is needed. A paused world handles its inputs as
// often as it would step.
std::int64_t WorldRunner::nextStepNs() const {
    const std::lock_guard lock{mutex_};
    const std::int64_t blockNs = time_.sessionNs(time_.law().blockFrames),
                       ahead = isStill()
                                   ? static_cast<std::int64_t>(1e9 * time_.law().stepSeconds()) - blockNs
                                   : world_.timeNs() - time_.nowNs();
    return pulse_.lastNs() + (std::max<std::int64_t>(0, ahead) / blockNs + 1) * blockNs;
}

int WorldRunner::catchUp(std::int64_t nowNs, const StepWatch& keepGoing) {
    if (const std::int64_t lag = nowNs - world_.timeNs(); lag > time_.longestLagNs()) {
        slippedNs_ += lag - time_.law().safeLagNs();
        world_.standStill(lag - time_.law().safeLagNs());
    }
    takeDue(nowNs);
    callback_.handTo(world_); // inputs that R made before `nowNs` are in the queue already
    int steps = 0;
    for (; world_.timeNs() < nowNs && (steps == 0 || !keepGoing || keepGoing(world_.timeNs())); ++steps) {
        moveWorld(nowNs);
        handOver(); // the next block may begin before the last step
    }
    handOver();
    return steps;
}

// Makes one step, or a stall up to `untilNs` if the world is paused. Its time must be before `untilNs`.
void WorldRunner::moveWorld(std::int64_t untilNs) {
    if (isStill()) return world_.standStill(untilNs - world_.timeNs());
    const int slowness = this->slowness();
    if (slowness == 0) stepsWanted_.fetch_sub(1, std::memory_order_relaxed);
    const std::int64_t before = world_.timeNs();
    world_.step(made_);
    drops_.store(world_.drops(), std::memory_order_relaxed);
    if (slowness > 1) world_.standStill((slowness - 1) * (world_.timeNs() - before));
}

// Starts a new scene run if one is requested; the request is cleared only after the start.
void WorldRunner::startRequestedRun() {
    const std::int64_t frame = restartFrame_.exchange(-1, std::memory_order_acquire);
    const std::lock_guard lock{stateMutex_};
    if (frame < 0 && !isNew_) return;
    world_.start(frame < 0 ? time_.nowNs() : time_.sessionNs(frame), state_.scene, state_.seed);
    isNew_ = false;
    publishScene();
    showPoses();
}

// Queues the created events; true if none is left.
bool WorldRunner::handOver() {
    dropWaiting();
    for (; handed_ < made_.size() && queue_.push(made_[handed_]); ++handed_) sinks_.made(made_[handed_]);
    if (handed_ < made_.size()) return false;
    made_.clear();
    handed_ = 0;
    publishScene();
    steppedNs_.store(world_.timeNs(), std::memory_order_release);
    return true;
}

void WorldRunner::publishScene() noexcept {
    sceneNs_.store(world_.sceneNs(), std::memory_order_relaxed);
    take_.store(world_.takeCount(), std::memory_order_relaxed);
}

// Drops the strikes that waited while the device paused, once it is back. A thread that has read a session
// time after the pause, and then calls this, sees the pause too.
void WorldRunner::dropWaiting() {
    const DevicePulse::Return now = pulse_.returns(), before = std::exchange(returns_, now);
    if (now.pauses == before.pauses) return;
    const WaitingEvents late{now.losses != before.losses ? INT64_MAX : now.untilNs,
                             setup_.areEventsOfCaller()};
    const auto made = made_.begin() + static_cast<std::ptrdiff_t>(handed_);
    const auto dropped = std::remove_if(
        made, made_.end(), [=](const CollisionEvent& event) { return late.contain(event, event.timeNs); });
    std::vector<CollisionEvent> due;
    waiting_.take(late.untilNs, due);
    pulse_.drop(due.size() + static_cast<std::size_t>(made_.end() - dropped));
    made_.erase(dropped, made_.end());
}

void WorldRunner::takeDue(std::int64_t untilNs) {
    dropWaiting();
    std::vector<CollisionEvent> due;
    waiting_.take(untilNs, due);
    std::ranges::transform(due, std::back_inserter(made_), setup_.shaping);
    if (setup_.log != LogUse::none) std::ranges::move(due, std::back_inserter(begun_));
}

bool WorldRunner::beginBlock(RenderMode mode) noexcept {
    const bool isOffline = mode == RenderMode::offline;
    offline_.store(isOffline, std::memory_order_release);
    if (isOffline) isDriven_.store(true, std::memory_order_release);
    return isDriven_.load(std::memory_order_acquire);
}

void WorldRunner::beginOffline(std::int64_t endNs) {
    startRequestedRun();
    takeDue(endNs);
    callback_.handTo(world_);
}

// Steps the world whenever the queue is empty.
bool WorldRunner::popOrStep(CollisionEvent& event, std::int64_t endNs) {
    while (!queue_.pop(event)) {
        const bool hasMore = !handOver() || world_.timeNs() < endNs;
        if (!hasMore) return queue_.pop(event);
        if (world_.timeNs() < endNs) moveWorld(endNs);
    }
    return true;
}

// Starts a requested scene run that is due, so that the caller's action goes to the new one.
std::shared_ptr<const Scene> WorldRunner::scene(std::size_t& take) {
    const std::lock_guard lock{mutex_};
    const std::int64_t restart = restartFrame_.load(std::memory_order_acquire);
    if (restart < 0 || time_.sessionNs(restart) <= time_.nowNs()) startRequestedRun();
    take = world_.takeCount();
    return world_.take().scene;
}

bool WorldRunner::addInputs(std::size_t take, std::span<const Action> actions) {
    const std::lock_guard lock{mutex_};
    if (take != world_.takeCount()) return false;
    for (const Action& action : actions) world_.addInput(time_.nowNs(), action);
    return true;
}

void WorldRunner::strike(std::span<const CollisionEvent> events) {
    const std::lock_guard lock{mutex_};
    dropWaiting();
    std::ranges::transform(events, std::back_inserter(made_), setup_.shaping);
    handOver();
}

bool WorldRunner::schedule(std::span<const CollisionEvent> events) {
    const std::lock_guard lock{mutex_};
    dropWaiting();
    if (!waiting_.add(events)) return false;
    takeDue(time_.nowNs());
    handOver();
    return true;
}

void WorldRunner::forgetScheduled(std::int64_t fromNs, std::int64_t nowNs) {
    const std::lock_guard lock{mutex_};
    takeDue(nowNs);
    handOver();
    waiting_.forget(fromNs);
}

std::int64_t WorldRunner::moveLog(SessionLog& log) {
    const std::lock_guard lock{mutex_};
    std::ranges::move(begun_, std::back_inserter(log.strikes));
    begun_.clear();
    world_.moveLog(log.takes);
    return std::min(time_.nowNs(), world_.timeNs());
}

SessionSize WorldRunner::size() const {
    const std::lock_guard lock{mutex_};
    SessionSize size = world_.size();
    size.strikes = waiting_.size();
    return size;
}

void WorldRunner::showPoses() const {
    const std::lock_guard lock{shownMutex_};
    world_.readPoses(shown_);
    shownNs_ = world_.timeNs();
}

// If the world is too slow for a display, the display gets the last complete step's poses, without blocking.
std::int64_t WorldRunner::readPoses(std::vector<BodyPose>& poses) const {
    std::unique_lock lock{mutex_, std::try_to_lock};
    for (int k = 0; !lock && k < posesTries && !isShown_.load(std::memory_order_relaxed); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
        (void)lock.try_lock();
    }
    isShown_.store(!lock, std::memory_order_relaxed);
    if (lock) {
        world_.readPoses(poses);
        return world_.timeNs();
    }
    const std::lock_guard shown{shownMutex_};
    poses = shown_;
    return shownNs_;
}

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
    for (std::size_t i = before; i < made.size(); ++i) made[i].timeNs += originNs_;
    shaper_.shape(made, before);
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

void SessionWorld::pace(std::int64_t sessionNs, double scriptSeconds, double rate) {
    world_->pace({static_cast<double>(sessionNs - originNs_) * 1e-9, scriptSeconds, rate});
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
