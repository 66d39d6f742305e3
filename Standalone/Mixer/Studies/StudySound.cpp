// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a stimulus in the mixer's session: controls first, then its events slightly later.
#include "Mixer/Studies/StudySound.h"
#include "Live/Documents/StripGroups.h"
#include "Mixer/Window/Parts.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using Kind = RenderControl::Kind;
constexpr std::int64_t leadNs = 50'000'000; // controls of the same session time may be applied after an
                                            // event, and gains are ramped

constexpr double mostLateMs = 1000.0;

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
    post(Kind::panner, 0, 0.0f, mix.panner());
    desk_.exposure().use(mix.layout);
    useRecordings({});
    const auto felt = feltStrips(mix);
    for (int j = 0; j < mix.count(); ++j) {
        post(Kind::gain, j, channelGain(felt[static_cast<std::size_t>(j)]));
        post(Kind::mute, j, mix.isSilent(j) ? 1.0f : 0.0f);
    }
    desk_.setSlowness(slowness_);
}

void StudySound::post(Kind kind, int channel, float value, const PhantomPanner& panner) {
    RenderControl control;
    control.kind = kind;
    control.channel = channel;
    control.value = value;
    control.panner = panner;
    if (!desk_.session().take({control})) desk_.report(noControls);
}

void StudySound::useRecordings(const std::vector<ContactRecording>& recordings) {
    if (!desk_.session().take({PlayedRecordings{recordings}})) desk_.report(noControls);
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
    post(Kind::panner, 0, 0.0f, stimulus.stimulus.panner);
    useRecordings(stimulus.recordings);
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        const float gain = strips[j].isInverted ? -stimulus.gains[j] : stimulus.gains[j];
        if (gain != std::exchange(gains_[j], gain)) post(Kind::gain, static_cast<int>(j), gain);
    }
    auto strikes = stimulus.stimulus.events;
    for (auto& strike : strikes) strike.timeNs += leadNs;
    const auto taken = desk_.session().take({Strikes{strikes}});
    if (!taken) return taken.error;
    const int rate = desk_.output().sampleRateHz();
    const auto first = std::llround(1e-9 * static_cast<double>(taken.value + leadNs) * rate);
    desk_.exposure().restartLevels({first, first + std::llround(stimulus.stimulus.seconds * rate)});
    beganAtMs_ = nowMs() + 1e-6 * static_cast<double>(leadNs) + 1e3 * desk_.device().playOutSeconds();
    seconds_ = stimulus.stimulus.seconds;
    return {};
}

// A late device is waited for, one that has stopped is not.
bool StudySound::isPlaying() const {
    const double restMs = beganAtMs_ + 1e3 * seconds_ - nowMs();
    return seconds_ > 0.0 && restMs > (desk_.exposure().isComplete() ? 0.0 : -mostLateMs);
}

double StudySound::feltSeconds() const { return std::clamp(1e-3 * (nowMs() - beganAtMs_), 0.0, seconds_); }

double StudySound::startsInSeconds() const { return 1e-3 * (beganAtMs_ - nowMs()); }

void StudySound::stop() {
    post(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < desk_.mix().count(); ++j) post(Kind::mute, j, 1.0f);
}

} // namespace physvib
