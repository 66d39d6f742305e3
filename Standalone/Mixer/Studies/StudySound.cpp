// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a stimulus in the mixer's session: controls first, then its events slightly later.
#include "Mixer/Studies/StudySound.h"
#include "Core/Units.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OfflineRender.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using Kind = RenderControl::Kind;
constexpr std::int64_t leadNs = 50'000'000; // controls of the same session time may be applied after an
                                            // event, and gains are ramped

// What is compared with the plan: actuators at most so far below the loudest one, above what a float keeps.
constexpr double comparedShare = 0.01, leastCompared = 1e-4, toleranceDb = 1.0;
constexpr double longestPauseMs = 1e-6 * DevicePulse::goneNs + 500.0; // a device that returns later plays
                                                                      // nothing of before
constexpr double mostPlannedSeconds = 60.0; // receipts are kept that long, and a plan is rendered while one
                                            // waits

constexpr const char* noControls = "The session took no more controls: expected a device that plays";

} // namespace

StudySound::StudySound(Desk& desk)
    : desk_{desk}
    , slowness_{desk.session().world().slowness()} {
    desk_.setSlowness(0);
    post(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < desk_.mix().count(); ++j) post(Kind::mute, j, 0.0f);
}

StudySound::~StudySound() {
    const Mix& mix = desk_.mix();
    if (isPlaying()) post(Kind::stopAll, 0, 0.0f);
    const PhantomPanner panner = mix.panner();
    post(Kind::panner, 0, 0.0f, &panner);
    desk_.exposure().use(mix.layout);
    useRecordings({});
    const auto felt = feltStrips(mix);
    for (int j = 0; j < mix.count(); ++j) {
        post(Kind::gain, j, channelGain(felt[static_cast<std::size_t>(j)]));
        post(Kind::mute, j, mix.isSilent(j) ? 1.0f : 0.0f);
    }
    desk_.setSlowness(slowness_);
}

void StudySound::post(Kind kind, int channel, float value, const PhantomPanner* panner) {
    RenderControl control;
    control.kind = kind;
    control.channel = channel;
    control.value = value;
    control.panner = panner;
    if (!desk_.session().submit({control})) desk_.report(noControls);
}

void StudySound::useRecordings(const std::vector<ContactRecording>& recordings) {
    if (!desk_.session().submit({PlayedRecordings{recordings}})) desk_.report(noControls);
}

Result<FeltStimulus> StudySound::make(Desk& desk, const TrialJob& job, const std::string& folder) {
    auto stimulus =
        feltStimulus(job, desk.output().sampleRateHz() > 0 ? desk.output().sampleRateHz() : 48000, folder);
    if (!stimulus) return stimulus;
    if (auto fault = refusal(desk, stimulus.value); !fault.empty()) return Failure{fault};
    return stimulus;
}

std::string StudySound::refusal(const Desk& desk, const FeltStimulus& stimulus) {
    const int wanted = stimulus.layout.geometry.count, there = desk.mix().count();
    if (const auto mute = desk.device().withoutClips(); !stimulus.recordings.empty() && mute.isNotEmpty())
        return "--method SV: expected a mixer without the " + mute.toStdString() +
               ", which plays no recordings";
    if (wanted <= there) return {};
    return stimulus.layout.name + ": expected " + std::to_string(wanted) + " actuators in the mixer, found " +
           std::to_string(there);
}

std::string StudySound::play(const FeltStimulus& stimulus) {
    if (auto fault = refusal(desk_, stimulus); !fault.empty()) return fault;
    const auto& strips = desk_.mix().strips;
    gains_.resize(strips.size());
    desk_.exposure().use(stimulus.layout);
    post(Kind::panner, 0, 0.0f, &stimulus.stimulus.panner);
    useRecordings(stimulus.recordings);
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        const float gain = strips[j].isInverted ? -stimulus.gains[j] : stimulus.gains[j];
        if (gain != std::exchange(gains_[j], gain)) post(Kind::gain, static_cast<int>(j), gain);
    }
    if (std::exchange(isMuted_, false))
        for (std::size_t j = 0; j < strips.size(); ++j) post(Kind::mute, static_cast<int>(j), 0.0f);
    auto strikes = stimulus.stimulus.events;
    for (auto& strike : strikes) strike.timeNs += leadNs;
    const auto taken = desk_.session().submit({Strikes{strikes}});
    if (!taken) return taken.error;
    fromNs_ = taken.value + leadNs;
    untilNs_ = fromNs_ + std::llround(1e9 * stimulus.stimulus.seconds);
    session_ = desk_.output().playedSession();
    desk_.output().expect(fromNs_, untilNs_);
    planned_ = plannedPeaks(stimulus);
    actuators_ = stimulus.layout.enchanters;
    course_ = Course::plays;
    wasSilent_ = false;
    ranAtMs_ = nowMs();
    beganAtMs_ = nowMs() + 1e-6 * static_cast<double>(leadNs) + 1e3 * desk_.device().outputLatencySeconds();
    seconds_ = stimulus.stimulus.seconds;
    return {};
}

/// The peak of each actuator behind gains, ceilings, limiter, guard and master level.
std::vector<double> StudySound::plannedPeaks(const FeltStimulus& stimulus) const {
    if (stimulus.stimulus.seconds > mostPlannedSeconds) return {};
    const int rate = desk_.output().sampleRateHz();
    const ContactSounds sounds{stimulus.recordings, rate};
    OfflineSettings settings{.renderer = {.sampleRateHz = rate, .panner = stimulus.stimulus.panner},
                             .frames = std::llround(stimulus.stimulus.seconds * rate),
                             .contacts = {sounds.contacts()}};
    std::vector<RenderControl> controls;
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        settings.renderer.ceilings[j] = ceilingOf(desk_.mix().strips[j]);
        controls.push_back({0, Kind::gain, static_cast<int>(j), stimulus.gains[j], {}});
    }
    settings.controls = controls;
    std::vector<double> peaks(stimulus.gains.size());
    renderOffline(stimulus.stimulus.events, settings, [&](const float* const* blocks, int frames) {
        for (std::size_t j = 0; j < peaks.size(); ++j)
            for (int n = 0; n < frames; ++n)
                peaks[j] = std::max(peaks[j], std::abs(static_cast<double>(blocks[j][n])));
        return true;
    });
    for (double& peak : peaks) peak *= static_cast<double>(desk_.output().level());
    return peaks;
}

// After a short pause of the device, what was posted goes on: so the end is awaited, though it is lost
// already.
void StudySound::update() {
    if (course_ != Course::plays) return;
    wasSilent_ = wasSilent_ || desk_.isSilent();
    if (desk_.output().isPlaying()) ranAtMs_ = nowMs();
    const bool isOver = desk_.output().left(fromNs_, untilNs_, 0, session_).isOver;
    if (isOver)
        course_ = wasSilent_ ? Course::lost : judged();
    else if (nowMs() - ranAtMs_ > longestPauseMs)
        course_ = Course::lost;
    if (course_ != Course::plays)
        heldSeconds_ = isOver ? seconds_ : std::clamp(1e-3 * (nowMs() - beganAtMs_), 0.0, seconds_);
}

/// The level is of the receipts, too: they know the session's times whatever rate the device had before.
Course StudySound::judged() {
    felt_ = {};
    const double loudest = planned_.empty() ? 0.0 : std::ranges::max(planned_);
    Course course = Course::left;
    for (std::size_t j = 0; j < actuators_.size(); ++j) {
        const Receipt receipt = desk_.output().left(fromNs_, untilNs_, static_cast<int>(j), session_);
        felt_.peakG = std::max(felt_.peakG, receipt.peak * actuators_[j].fullScaleG);
        felt_.rmsG = std::max(felt_.rmsG, std::sqrt(receipt.meanSquare) * actuators_[j].fullScaleG);
        if (!receipt.isKept || !receipt.isRunning) return Course::lost;
        const double planned = j < planned_.size() ? planned_[j] : 0.0;
        if (planned < std::max(leastCompared, comparedShare * loudest)) continue;
        if (std::abs(toDecibels(std::max(receipt.peak, 1e-9) / planned)) > toleranceDb)
            course = Course::unlike;
    }
    return course;
}

double StudySound::feltSeconds() const {
    return course_ == Course::plays ? std::clamp(1e-3 * (nowMs() - beganAtMs_), 0.0, seconds_) : heldSeconds_;
}

double StudySound::startsInSeconds() const { return 1e-3 * (beganAtMs_ - nowMs()); }

void StudySound::stop() {
    course_ = Course::none;
    isMuted_ = true;
    post(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < desk_.mix().count(); ++j) post(Kind::mute, j, 1.0f);
}

} // namespace physvib
