// SPDX-License-Identifier: MIT
// Converts sounding events to two tones per report by mean energy: decays are mostly longer than a report.
#include "Live/Pads/ToneFeed.h"
#include "Core/Pads/PadMotors.h"
#include "Core/PortableMath.h"

namespace physvib {
namespace {

constexpr std::size_t maxVoices = 512; // sounding or waiting events; the weakest are dropped
constexpr double minEnergy = 1e-6;     // of full scale, below the smallest step of a report

/// Mean square of the event's amplitude from `fromNs` on, for a report's length.
double meanEnergy(const CollisionEvent& event, std::int64_t fromNs) {
    const std::int64_t begin = std::max(fromNs, event.timeNs);
    std::int64_t end = fromNs + ToneFeed::reportNs;
    if (event.durationNs > 0) end = std::min(end, event.timeNs + event.durationNs);
    if (end <= begin) return 0.0;
    const double age = 1e-9 * static_cast<double>(begin - event.timeNs + event.course.toneAgeNs),
                 seconds = 1e-9 * static_cast<double>(end - begin), rate = 2.0 * event.decayPerSecond;
    const double mean = rate * seconds > 1e-9 ? -portable::expm1(-rate * seconds) / rate : seconds;
    return event.amplitude * event.amplitude * portable::exp(-rate * age) * mean /
           (1e-9 * static_cast<double>(ToneFeed::reportNs));
}

/// Lowest and highest pitch of a tone, and the actuator's resonance, as log2 of the frequency in Hz.
struct Band {
    double low, high, resonance;
};
const Band lowToneBand{portable::log2(40.9), portable::log2(626.0), portable::log2(160.0)},
    highToneBand{portable::log2(81.8), portable::log2(1252.0), portable::log2(320.0)};

/// Energy, pitch and squared pitch of some partials, summed.
struct PartialMoments {
    double energy = 0.0, pitch = 0.0, squaredPitch = 0.0;
    void add(const ToneFeed::Partial& partial) {
        const double p = portable::log2(partial.frequencyHz);
        energy += partial.energy, pitch += partial.energy * p, squaredPitch += partial.energy * p * p;
    }
    PartialMoments minus(const PartialMoments& other) const {
        return {energy - other.energy, pitch - other.pitch, squaredPitch - other.squaredPitch};
    }
    double meanHz() const { return portable::pow(2.0, pitch / energy); }
    /// How far the partials are from one tone of the band, squared; of two that fit, the one nearer to its
    /// resonance is better.
    double errorIn(const Band& band) const {
        if (!(energy > 0.0)) return 0.0;
        const double mean = pitch / energy, outside = mean - std::clamp(mean, band.low, band.high),
                     detuning = mean - band.resonance;
        return squaredPitch - pitch * mean + energy * (outside * outside + 1e-6 * detuning * detuning);
    }
};

} // namespace

TonePair ToneFeed::fitTones(std::vector<Partial> partials) {
    std::erase_if(partials, [](const Partial& partial) { return partial.energy < minEnergy; });
    std::ranges::sort(partials, {}, &Partial::frequencyHz);
    PartialMoments all, lows, low, high;
    for (const Partial& partial : partials) all.add(partial);
    double minError = INFINITY;
    for (std::size_t i = 0;; lows.add(partials[i++])) { // the first i are the low tone's
        const PartialMoments highs = i < partials.size() ? all.minus(lows) : PartialMoments{};
        if (const double error = lows.errorIn(lowToneBand) + highs.errorIn(highToneBand); error < minError)
            minError = error, low = lows, high = highs;
        if (i == partials.size()) break;
    }
    TonePair tones;
    const double scale = std::sqrt(1.0 / std::max(1.0, all.energy));
    if (low.energy > 0.0) tones.lowHz = low.meanHz(), tones.low = scale * std::sqrt(low.energy);
    if (high.energy > 0.0) tones.highHz = high.meanHz(), tones.high = scale * std::sqrt(high.energy);
    return tones;
}

ToneFeed::ToneFeed(const HidFeedKind& kind, const PhantomPanner& panner)
    : kind_{kind}
    , gripPanner_{PadMotors::makeGripPanner(panner)} {}

void ToneFeed::begin() {
    processQueues();
    if (!pendingPanners_.empty()) gripPanner_ = pendingPanners_.back().panner; // the session goes on with it
    pendingPanners_.clear();
    stopsNs_.clear();
    voices_.clear();
    dueNs_ = INT64_MIN / 2;
}

// A layout applies from the first event at its time, a stop from the time at which it is felt.
void ToneFeed::processQueues() {
    for (RenderControl control; controls_.pop(control); controls_.done(control)) {
        if (control.panner != nullptr)
            pendingPanners_.push_back({control.timeNs, PadMotors::makeGripPanner(*control.panner)});
        if (control.kind == RenderControl::Kind::stopAll) stopsNs_.push_back(control.timeNs);
    }
    for (CollisionEvent event; events_.pop(event);) {
        for (; !pendingPanners_.empty() && pendingPanners_.front().timeNs <= event.timeNs;
             pendingPanners_.erase(pendingPanners_.begin()))
            gripPanner_ = pendingPanners_.front().panner;
        if (!isPlayable(event) || isClip(event.sound)) continue;
        PhantomPanner::Gains gains{};
        gripPanner_.gainsAt(event, gains);
        voices_.push_back({event, {gains[0], gains[1]}});
    }
}

TonePair ToneFeed::computeTones(std::size_t side, std::int64_t fromNs, double level) const {
    std::vector<Partial> partials;
    for (const Voice& voice : voices_)
        partials.push_back({voice.event.frequencyHz, level * level * voice.gains[side] * voice.gains[side] *
                                                         meanEnergy(voice.event, fromNs)});
    return fitTones(std::move(partials));
}

std::optional<PadReport> ToneFeed::next(std::int64_t nowNs, std::int64_t sessionNs, float level) {
    if (nowNs < dueNs_) return {};
    processQueues();
    for (; !stopsNs_.empty() && stopsNs_.front() <= sessionNs; stopsNs_.erase(stopsNs_.begin()))
        std::erase_if(voices_, [&](const Voice& voice) { return voice.event.timeNs < stopsNs_.front(); });
    std::erase_if(voices_, [&](const Voice& voice) {
        return voice.event.timeNs <= sessionNs && meanEnergy(voice.event, sessionNs) < minEnergy;
    });
    if (voices_.size() > maxVoices) {
        std::ranges::nth_element(voices_, voices_.begin() + maxVoices, std::ranges::greater{},
                                 [&](const Voice& voice) {
                                     return meanEnergy(voice.event, std::max(sessionNs, voice.event.timeNs));
                                 });
        voices_.resize(maxVoices);
    }
    const TonePair left = computeTones(0, sessionNs, static_cast<double>(level)),
                   right = computeTones(1, sessionNs, static_cast<double>(level));
    const bool isSilent = left == TonePair{} && right == TonePair{};
    if (isSilent && silentReports_ >= silentReportCount) return {};
    silentReports_ = isSilent ? silentReports_ + 1 : 0;
    dueNs_ = nowNs - dueNs_ < reportNs ? dueNs_ + reportNs : nowNs + reportNs;
    return switchTones(left, right, reportNumber_++);
}

PadReport ToneFeed::silentReport() {
    silentReports_ = silentReportCount;
    return switchTones({}, {}, reportNumber_++);
}

} // namespace physvib
