// SPDX-License-Identifier: MIT
// Processes external inputs while a session plays (actions, controls, recordings, events, stops, lanes), and
// logs them.
#include "Live/Session/Scheduler.h"
#include "Io/Disk/ReadFile.h"
#include <iterator>

namespace physvib {

namespace {

/// Number of events that are felt once each. Changes of state, of which only the last one counts, have none.
std::size_t countEvents(const Input& input) noexcept {
    if (const auto* strikes = std::get_if<Strikes>(&input.what)) return strikes->events.size();
    const auto* action = std::get_if<Action>(&input.what);
    return action != nullptr && std::holds_alternative<ImpulseAction>(*action) ? 1 : 0;
}

} // namespace

Scheduler::Scheduler(const SessionSetup& setup, const Timeline& time, DevicePulse& pulse, WorldRunner& world,
                     RenderedChannels& channels, SinkSet& sinks)
    : setup_{setup}
    , isLogged_{setup.log != LogUse::none}
    , time_{time}
    , pulse_{pulse}
    , world_{world}
    , channels_{channels}
    , sinks_{sinks}
    , activeSet_{setup.recordings} {}

void Scheduler::prepare() {
    controls_.clear();
    check_.reset();
    log_ = {};
    panner_ = setup_.panner;
    lastControlNs_ = 0;
    stops_.clear();
    nextStopNs_ = never;
    followedSceneNs_ = -1;
    followedGains_.fill(std::numeric_limits<float>::quiet_NaN());
    if (!isLogged_) return;
    if (!activeSet_.empty()) log_.recordings.push_back({0, recordingFiles(activeSet_)});
    log_.clips = clips_;
}

Result<std::int64_t> Scheduler::submit(Input input) {
    const std::lock_guard lock{mutex_};
    const bool mayWait =
        std::holds_alternative<Strikes>(input.what) || std::holds_alternative<Stop>(input.what);
    if (!mayWait && input.timeNs != Input::now)
        return Failure{"expected strikes or a stop at a time of their own; anything else acts now"};
    if (const std::size_t events = countEvents(input); events > 0 && pulse_.dropIfPaused(events))
        return Failure{DevicePulse::droppedError};
    return std::visit([&](auto& what) { return submit(what, input.timeNs); }, input.what);
}

Result<std::int64_t> Scheduler::submit(std::span<const Action> actions, std::int64_t) {
    for (;;) { // repeated if a new scene run began since the check
        std::size_t number = 0;
        const auto scene = world_.scene(number);
        if (!check_ || checkedRun_ != number)
            check_.emplace(*scene, setup_.log == LogUse::document ? sceneLimits::maxLiveInputs
                                                                  : InputCheck::unlimited);
        checkedRun_ = number;
        if (std::string error = check_->accept(actions); !error.empty()) return Failure{std::move(error)};
        if (world_.addInputs(number, actions)) return time_.nowNs();
    }
}

Result<std::int64_t> Scheduler::submit(RenderControl& control, std::int64_t) {
    if ((control.kind == RenderControl::Kind::panner) != (control.panner != nullptr))
        return Failure{"expected a panner with the control that sets it, and with no other"};
    postDueStops(time_.nowNs());
    control.timeNs = earliestNs();
    if (!post(control)) return Failure{"too many controls at once"};
    return control.timeNs;
}

// Sends a control at its own time, but not before that of an earlier control.
bool Scheduler::post(RenderControl& control) {
    control.timeNs = std::max(control.timeNs, lastControlNs_); // a later stop may have been posted before
    if (!controls_.push(control)) return false;
    lastControlNs_ = control.timeNs;
    sinks_.onControl(control);
    channels_.updateMutes(control);
    if (control.kind == RenderControl::Kind::ceiling) channels_.raiseCeiling(control.channel, control.value);
    if (control.panner != nullptr) panner_ = *control.panner;
    if (control.kind == RenderControl::Kind::gain && control.channel >= 0 &&
        control.channel < limits::maxActuators)
        followedGains_[static_cast<std::size_t>(control.channel)] = std::numeric_limits<float>::quiet_NaN();
    if (!isLogged_) return true;
    if (control.panner != nullptr)
        log_.panners.push_back({control.timeNs, *control.panner});
    else
        log_.channels.push_back({control.timeNs, control.kind, control.channel, control.value});
    return true;
}

Result<std::int64_t> Scheduler::submit(PlayedRecordings& requested, std::int64_t) {
    RenderControl control;
    control.timeNs = earliestNs();
    if (requested.recordings == activeSet_) return control.timeNs;
    control.kind = RenderControl::Kind::recordings;
    control.recordings = recordings_.contacts(time_.law().sampleRateHz, requested.recordings);
    if (!controls_.push(control)) return Failure{"too many controls at once"};
    activeSet_ = std::move(requested.recordings);
    if (isLogged_) log_.recordings.push_back({control.timeNs, recordingFiles(activeSet_)});
    return control.timeNs;
}

Result<std::int64_t> Scheduler::submit(const Strikes& strikes, std::int64_t timeNs) {
    const auto isValid = [&](const CollisionEvent& e) {
        return isPlayable(e) && (strikes.canBeStopped || e.timeNs < limits::maxTimeNs / 2);
    };
    if (!std::ranges::all_of(strikes.events, isValid)) return Failure{"expected strikes that can be played"};
    const std::int64_t start = timeNs == Input::now ? earliestNs() : timeNs;
    std::vector<CollisionEvent> events{strikes.events.begin(), strikes.events.end()};
    for (CollisionEvent& event : events) event.timeNs += start;
    if (strikes.canBeStopped) {
        if (!world_.schedule(events))
            return Failure{"too many strikes wait: at most " + std::to_string(ScheduledEvents::maxEvents)};
        return start;
    }
    world_.strike(events);
    if (isLogged_) std::ranges::move(events, std::back_inserter(log_.strikes));
    return start;
}

Result<std::int64_t> Scheduler::submit(const Stop&, std::int64_t timeNs) {
    const std::int64_t now = time_.nowNs();
    timeNs = std::max(timeNs, earliestNs());
    // one that is due is posted below, and never refused
    if (stops_.size() >= maxStops && timeNs > now) return Failure{"too many stops wait"};
    world_.cancelScheduled(timeNs, now);
    if (const auto next = std::ranges::lower_bound(stops_, timeNs); next == stops_.end() || *next != timeNs)
        stops_.insert(next, timeNs);
    postDueStops(now);
    return timeNs;
}

// Posts stops that are due, so that no later control is logged before them.
void Scheduler::postDueStops(std::int64_t untilNs) {
    RenderControl stop;
    stop.kind = RenderControl::Kind::stopAll;
    while (!stops_.empty() && stops_.front() <= untilNs) {
        stop.timeNs = stops_.front();
        if (!post(stop)) break; // the queue is full: retried with the next call
        stops_.erase(stops_.begin());
    }
    nextStopNs_ = stops_.empty() ? never : stops_.front();
}

void Scheduler::sendDueStops() {
    const std::int64_t now = time_.nowNs();
    if (nextStopNs_ > now) return;
    const std::lock_guard lock{mutex_};
    postDueStops(now);
}

Result<std::int64_t> Scheduler::submit(Lanes& lanes, std::int64_t) {
    lanesMix_ = std::move(lanes.mix);
    hasLanes_ = lanesMix_ != nullptr;
    followedSceneNs_ = -1;
    return time_.nowNs();
}

// Acts like a fader that is moved at the time of the step. The gains are logged, so that a later render does
// not depend on the lane.
void Scheduler::followLanes() {
    if (!hasLanes_.load(std::memory_order_relaxed)) return;
    const std::lock_guard lock{mutex_};
    const std::int64_t sceneNs = world_.sceneNs(),
                       steppedNs = world_.steppedNs_.load(std::memory_order_acquire);
    const std::size_t run = world_.runNumber();
    if (!lanesMix_ || (sceneNs == followedSceneNs_ && run == followedRun_))
        return; // gains set otherwise hold while the world is paused
    postDueStops(steppedNs);
    for (std::size_t j = 0; j < lanesMix_->strips.size(); ++j) {
        if (!hasLane(*lanesMix_, j)) continue;
        Strip strip = lanesMix_->strips[j];
        strip.gainDb = gainDbAt(*lanesMix_, j, static_cast<double>(sceneNs) * 1e-9);
        RenderControl control{std::max<std::int64_t>(0, steppedNs - time_.leadNs()),
                              RenderControl::Kind::gain,
                              static_cast<int>(j),
                              channelGain(strip),
                              {}};
        if (control.value == followedGains_[j]) continue;
        if (!post(control)) return; // the queue is full: retried with the next call
        followedGains_[j] = control.value;
    }
    followedSceneNs_ = sceneNs;
    followedRun_ = run;
}

bool Scheduler::hasRoomFor(std::span<const ClipSound> channels) const {
    const auto rates = recordings_.rates();
    double samples = 0.0;
    const auto add = [&](const ClipSound& sound) { samples += sound.maxSampleCount(rates); };
    std::ranges::for_each(channels, add);
    std::ranges::for_each(recordings_.clips(), add);
    return samples <= limits::maxRecordingSamples && clips_.size() + channels.size() <= maxClips;
}

// Resamples without the mutex, because that takes long.
std::optional<int> Scheduler::addClip(std::span<const ContactRecording> channels) {
    std::vector<ClipSound> sounds(channels.begin(), channels.end());
    for (std::vector<int> rates;;) {
        for (ClipSound& sound : sounds) std::ranges::for_each(rates, [&](int rate) { sound.resample(rate); });
        const std::lock_guard lock{mutex_};
        const auto isFirst = [&](const ClipFile& clip) {
            return clip.channel == 0 && clip.file.path == channels[0].file.path &&
                   clip.file.hash == channels[0].file.hash;
        };
        const auto existing = std::ranges::find_if(clips_, isFirst);
        if (existing != clips_.end()) return static_cast<int>(existing - clips_.begin());
        if (!hasRoomFor(sounds)) return std::nullopt;
        rates = recordings_.rates();
        if (!std::ranges::all_of(rates, [&](int rate) { return sounds.back().hasRate(rate); })) continue;
        for (ClipSound& sound : sounds) recordings_.add(std::move(sound));
        const auto first = static_cast<int>(clips_.size());
        for (int j = 0; j < std::ssize(channels); ++j) {
            const auto& clip = clips_.emplace_back(ClipFile{channels[static_cast<std::size_t>(j)].file, j});
            if (isLogged_) log_.clips.push_back(clip);
        }
        return first;
    }
}

PhantomPanner Scheduler::panner() const {
    const std::lock_guard lock{mutex_};
    return panner_;
}

std::int64_t Scheduler::readLog(SessionLog& log) {
    const std::lock_guard lock{mutex_};
    const std::int64_t now = time_.nowNs();
    if (!isLogged_) return now;
    postDueStops(now);
    const auto move = [](auto& source, auto& target) {
        std::ranges::move(source, std::back_inserter(target));
        source.clear();
    };
    move(log_.panners, log.panners);
    move(log_.channels, log.channels);
    move(log_.recordings, log.recordings);
    move(log_.clips, log.clips);
    move(log_.strikes, log.strikes);
    return world_.moveLog(log);
}

// Gives inputs of the render call their session time and queues them for the renderer and the world.

bool CallbackInputs::strike(CollisionEvent event, int frame, std::int64_t afterNs) noexcept {
    event = shaping_(event);
    event.timeNs = time_.nextInputNs(frame) + afterNs;
    return strikes_.push(event);
}

bool CallbackInputs::control(RenderControl control, int frame) noexcept {
    control.timeNs = time_.nextInputNs(frame);
    return controls_.push(control);
}

bool CallbackInputs::silence(int frame) noexcept {
    RenderControl control;
    control.kind = RenderControl::Kind::silence;
    control.timeNs = time_.nextRenderedNs(frame); // the samples that leave now
    control.untilNs = time_.nextNs(frame);
    // then events of the render call are earlier in session time than the world's events of the same frame
    control.value = time_.isDirectFromStart() ? 1.0f : 0.0f;
    return controls_.push(control);
}

bool CallbackInputs::postInput(RenderInput input, int frame) noexcept {
    if (!hasWorld_) return true; // no world would take it from the queue
    input.timeNs = time_.nextNs(frame);
    return inputs_.push(input);
}

void CallbackInputs::clear() noexcept {
    for (CollisionEvent unplayed; strikes_.pop(unplayed);) {
    }
    controls_.clear();
    for (RenderInput undone; inputs_.pop(undone);) {
    }
    spawnCount_ = 0;
    bodyNames_.fill({});
}

void CallbackInputs::passInputsTo(SessionWorld& world) {
    for (RenderInput input; inputs_.pop(input);) {
        if (input.group == RenderInput::script) world.setPace(input.timeNs, input.scriptSeconds, input.scale);
        if (input.group == RenderInput::device) world.addInput(input.timeNs, input.hold);
        if (input.group < 0 || input.group >= static_cast<int>(groups_.size())) continue;
        for (Action action : groups_[static_cast<std::size_t>(input.group)]) {
            const auto scale = [&input](Vector& v) { v = {v.x * input.scale, v.y * input.scale}; };
            if (auto* impulse = std::get_if<ImpulseAction>(&action)) scale(impulse->impulseNewtonSeconds);
            if (auto* spawn = std::get_if<SpawnAction>(&action)) {
                scale(spawn->body.velocityMetresPerSecond);
                addBody(world, input.timeNs, *spawn);
            } else {
                world.addInput(input.timeNs, std::move(action));
            }
        }
    }
}

// Each spawned body has a new name; the oldest is removed when there are too many.
void CallbackInputs::addBody(SessionWorld& world, std::int64_t timeNs, SpawnAction action) {
    std::string& name = bodyNames_[spawnCount_ % bodyNames_.size()];
    if (!name.empty()) world.addInput(timeNs, RemoveAction{name});
    name = action.body.name += " #" + std::to_string(++spawnCount_);
    world.addInput(timeNs, std::move(action));
}

} // namespace physvib
