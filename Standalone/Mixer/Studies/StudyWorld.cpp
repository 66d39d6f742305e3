// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a session of its own on the borrowed output, and keeps its journal.
#include "Mixer/Studies/StudyWorld.h"
#include "Io/Disk/FileClash.h"
#include "Scene/SceneEdits.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

constexpr std::int64_t fadeNs = 100'000'000;  // longer than the fade-out of any mode, by
                                              // limits::stealFadePerSecond
constexpr std::int64_t askedNs = 500'000'000; // of receipts at a time, which are kept for a minute

} // namespace

std::string StudyWorld::refusal(const Desk& desk, const FeltWorld& world) {
    const int wanted = world.layout.geometry.count, there = desk.mix().count();
    if (const auto beside = desk.session().sinks().states(); !beside.empty())
        return "a world: expected a mixer without the " + beside.front().name +
               ", which follows one session only";
    if (wanted <= there) return {};
    return world.layout.name + ": expected " + std::to_string(wanted) + " actuators in the mixer, found " +
           std::to_string(there);
}

std::string StudyWorld::begin(FeltWorld world, bool hasHands, const std::filesystem::path& file) {
    finish();
    if (auto fault = refusal(desk_, world); !fault.empty()) return fault;
    setup_ = std::move(world.setup);
    if (hasHands) setup_.scene = sceneForHands(std::move(setup_.scene));
    setup_.longestGapSeconds = Desk::gapSeconds;
    setup_.log = LogUse::stream;
    setup_.marks = MarkedOnsets::all;
    seconds_ = hasHands ? 0.0 : world.seconds;
    feltNs_ = seenNs_ = checkedNs_ = 0;
    actuators_ = world.layout.geometry.count;
    course_ = Course::none;
    stoppedNs_ = -1;
    fault_.clear();
    std::error_code none;
    const auto folder = file.parent_path();
    std::filesystem::create_directories(folder, none);
    if (!isWithin(folder.parent_path(), folder)) return folder.string() + ": " + leadsElsewhere;
    session_ = std::make_unique<Session>(setup_);
    desk_.exposure().use(world.layout);
    desk_.exposure().restartLevels(
        {0, hasHands ? SampleSpan{}.to : std::llround(seconds_ * desk_.output().sampleRateHz())});
    if (!desk_.output().playInstead(session_.get())) return session_.reset(), "expected a device that plays";
    number_ = desk_.output().playedSession();
    tellStrips();
    journal_ = std::make_unique<SessionJournal>(
        file, *session_, setup_,
        Provenance{PHYSVIB_VERSION, {{"scene", setup_.scene.name}, {"seed", std::to_string(setup_.seed)}}});
    if (auto fault = journal_->error(); !fault.empty()) return finish(), fault;
    driver_ = std::make_unique<ThreadDriver>(*session_, setup_.stepsPerSecond); // starts its time
    course_ = Course::plays;
    return {};
}

/// The world is lost as soon as one actuator of its layout missed a frame.
void StudyWorld::askReceipts(std::int64_t untilNs) {
    if (!desk_.output().isPlaying()) course_ = Course::lost;
    if (course_ != Course::plays || untilNs <= checkedNs_) return;
    for (int j = 0; j < actuators_; ++j) {
        const Receipt receipt = desk_.output().left(checkedNs_, untilNs, j, number_);
        if (!receipt.isOver) return; // a block is between the session and its receipt
        if (!receipt.isRunning) course_ = Course::lost;
    }
    checkedNs_ = untilNs;
}

void StudyWorld::tellStrips() {
    auto strips = desk_.mix().strips;
    strips.resize(static_cast<std::size_t>(setup_.channels));
    for (Strip& strip : strips) strip.gainDb = 0.0, strip.isMuted = strip.isSolo = false;
    std::array<ToldStrip, limits::maxEnchanters> told{};
    physvib::tellStrips(told, strips, [this](const RenderControl& control) {
        return session_->submit({control}).error.empty();
    });
}

void StudyWorld::end() {
    if (!isMoving()) return;
    RenderControl stop;
    stop.kind = RenderControl::Kind::stopAll;
    session_->world().setSlowness(0);
    // queue full: the world continues, and end() is called again by the next look()
    if (const auto stopped = session_->submit({stop})) stoppedNs_ = stopped.value;
}

std::string StudyWorld::act(const Action& action) {
    return isMoving() ? session_->submit({action}).error : std::string{};
}

WorldMoment StudyWorld::look() {
    WorldMoment moment;
    if (!session_) return moment;
    for (PlayedEvent played; session_->played().pop(played);)
        journal_->played(played, session_->timeline().sampleRateHz());
    moment.sessionNs = session_->world().readPoses(moment.poses);
    moment.aheadNs = session_->timeline().outputLatencyFrames() * 1'000'000'000 /
                     std::max(1, desk_.output().sampleRateHz());
    const std::int64_t now = session_->status().sessionNs, felt = session_->timeline().nextFeltNs();
    if (felt >= checkedNs_ + askedNs || !desk_.output().isPlaying()) askReceipts(felt);
    if (course_ == Course::lost) return finish(), moment; // a device that is gone plays no end
    if (isMoving()) {
        session_->world().setSlowness(desk_.isSilent() ? 0 : 1); // pause the display too while output is
                                                                 // silent
        if (!desk_.isSilent())
            feltNs_ = std::min(feltNs_ + now - seenNs_, std::max<std::int64_t>(0, now - moment.aheadNs));
        if (seconds_ > 0.0 && feltSeconds() >= seconds_) end();
    } else if (felt >= stoppedNs_ + fadeNs) { // the latency may have grown
        askReceipts(stoppedNs_);
        if (course_ == Course::plays) course_ = Course::left;
        finish();
    }
    seenNs_ = now;
    return moment;
}

void StudyWorld::finish() {
    if (!session_) return;
    if (course_ == Course::plays) course_ = Course::none;
    desk_.output().playInstead(nullptr);
    driver_.reset();
    session_->advance(); // simulates up to the end of time, from which a later render would continue
    // Impacts of the last step are known one step later, which does not exist here. A render that ended at
    // the pause would include them.
    const std::int64_t endNs = stoppedNs_ < 0 ? session_->status().sessionNs : stoppedNs_ + fadeNs;
    if (journal_ && journal_->error().empty()) {
        for (PlayedEvent played; session_->played().pop(played);)
            journal_->played(played, session_->timeline().sampleRateHz());
        journal_->end(endNs);
        fault_ = journal_->finish(SessionJournal::quickBytes); // limited, because the window waits
    }
    journal_.reset();
    session_.reset();
}

} // namespace physvib
