// SPDX-License-Identifier: MIT
// Converts sounding events to two tones per report by their mean energy, as most decays are longer.
#include "Live/Pads/ToneFeed.h"
#include "Core/Pads/PadMotors.h"
#include "Core/PortableMath.h"

namespace physvib {
namespace {

constexpr std::size_t maxVoices = 512;   // what rings or waits; the weakest of more is dropped
constexpr double inaudibleEnergy = 1e-6; // of full scale, below the smallest step of a report

/// Mean square of the event's amplitude from `fromNs` on, for a report's length.
double energyOf(const CollisionEvent& event, std::int64_t fromNs) {
    const std::int64_t begin = std::max(fromNs, event.timeNs);
    std::int64_t end = fromNs + ToneFeed::reportNs;
    if (event.durationNs > 0) end = std::min(end, event.timeNs + event.durationNs);
    if (end <= begin) return 0.0;
    const double age = 1e-9 * static_cast<double>(begin - event.timeNs + event.course.sinceNs),
                 seconds = 1e-9 * static_cast<double>(end - begin), rate = 2.0 * event.decayPerSecond;
    const double mean = rate * seconds > 1e-9 ? -portable::expm1(-rate * seconds) / rate : seconds;
    return event.amplitude * event.amplitude * portable::exp(-rate * age) * mean /
           (1e-9 * static_cast<double>(ToneFeed::reportNs));
}

/// What one tone can play, in octaves: pitches, and the one at which the actuator is strongest.
struct Band {
    double low, high, resonance;
};
const Band lowBand{portable::log2(40.9), portable::log2(626.0), portable::log2(160.0)},
    highBand{portable::log2(81.8), portable::log2(1252.0), portable::log2(320.0)};

/// Energy, pitch and squared pitch of some partials, summed.
struct Part {
    double energy = 0.0, pitch = 0.0, square = 0.0;
    void add(const ToneFeed::Partial& partial) {
        const double p = portable::log2(partial.frequencyHz);
        energy += partial.energy, pitch += partial.energy * p, square += partial.energy * p * p;
    }
    Part without(const Part& other) const {
        return {energy - other.energy, pitch - other.pitch, square - other.square};
    }
    double hertz() const { return portable::pow(2.0, pitch / energy); }
    /// How far the partials are from one tone of the band, squared; of two that fit, the one nearer to its
    /// resonance is better.
    double errorIn(const Band& band) const {
        if (!(energy > 0.0)) return 0.0;
        const double mean = pitch / energy, off = mean - std::clamp(mean, band.low, band.high),
                     away = mean - band.resonance;
        return square - pitch * mean + energy * (off * off + 1e-6 * away * away);
    }
};

} // namespace

TonePair ToneFeed::fitted(std::vector<Partial> partials) {
    std::erase_if(partials, [](const Partial& partial) { return partial.energy < inaudibleEnergy; });
    std::ranges::sort(partials, {}, &Partial::frequencyHz);
    Part all, below, low, high;
    for (const Partial& partial : partials) all.add(partial);
    double least = INFINITY;
    for (std::size_t i = 0;; below.add(partials[i++])) { // the first i are the low tone's
        const Part above = i < partials.size() ? all.without(below) : Part{};
        if (const double error = below.errorIn(lowBand) + above.errorIn(highBand); error < least)
            least = error, low = below, high = above;
        if (i == partials.size()) break;
    }
    TonePair tones;
    const double scale = std::sqrt(1.0 / std::max(1.0, all.energy));
    if (low.energy > 0.0) tones.lowHz = low.hertz(), tones.low = scale * std::sqrt(low.energy);
    if (high.energy > 0.0) tones.highHz = high.hertz(), tones.high = scale * std::sqrt(high.energy);
    return tones;
}

ToneFeed::ToneFeed(const HidFeedKind& kind, const PhantomPanner& panner)
    : kind_{kind}
    , first_{panner}
    , grips_{PadMotors::gripsOf(panner)} {}

void ToneFeed::begin() {
    for (CollisionEvent event; events_.pop(event);) {
    }
    for (RenderControl control; controls_.pop(control);) controls_.done(control);
    grips_ = PadMotors::gripsOf(first_);
    layouts_.clear();
    stopsNs_.clear();
    voices_.clear();
    dueNs_ = INT64_MIN / 2;
}

// A layout applies from the first event at its time, a stop from the time at which it is felt.
void ToneFeed::takeAll() {
    for (RenderControl control; controls_.pop(control); controls_.done(control)) {
        if (control.panner != nullptr)
            layouts_.push_back({control.timeNs, PadMotors::gripsOf(*control.panner)});
        if (control.kind == RenderControl::Kind::stopAll) stopsNs_.push_back(control.timeNs);
    }
    for (CollisionEvent event; events_.pop(event);) {
        for (; !layouts_.empty() && layouts_.front().timeNs <= event.timeNs; layouts_.erase(layouts_.begin()))
            grips_ = layouts_.front().panner;
        if (!isPlayable(event) || isClip(event.sound)) continue;
        PhantomPanner::Gains gains{};
        grips_.gainsAt(event, gains);
        voices_.push_back({event, {gains[0], gains[1]}});
    }
}

TonePair ToneFeed::tonesOf(std::size_t side, std::int64_t fromNs, double level) const {
    std::vector<Partial> partials;
    for (const Voice& voice : voices_)
        partials.push_back({voice.event.frequencyHz, level * level * voice.gains[side] * voice.gains[side] *
                                                         energyOf(voice.event, fromNs)});
    return fitted(std::move(partials));
}

std::optional<PadReport> ToneFeed::next(std::int64_t nowNs, std::int64_t sessionNs, float level) {
    if (nowNs < dueNs_) return {};
    takeAll();
    for (; !stopsNs_.empty() && stopsNs_.front() <= sessionNs; stopsNs_.erase(stopsNs_.begin()))
        std::erase_if(voices_, [&](const Voice& voice) { return voice.event.timeNs < stopsNs_.front(); });
    std::erase_if(voices_, [&](const Voice& voice) {
        return voice.event.timeNs <= sessionNs && energyOf(voice.event, sessionNs) < inaudibleEnergy;
    });
    if (voices_.size() > maxVoices) {
        std::ranges::nth_element(voices_, voices_.begin() + maxVoices, std::ranges::greater{},
                                 [](const Voice& voice) { return std::abs(voice.event.amplitude); });
        voices_.resize(maxVoices);
    }
    const TonePair left = tonesOf(0, sessionNs, static_cast<double>(level)),
                   right = tonesOf(1, sessionNs, static_cast<double>(level));
    const bool rests = left == TonePair{} && right == TonePair{};
    if (rests && silent_ >= silentReports) return {};
    silent_ = rests ? silent_ + 1 : 0;
    dueNs_ = nowNs - dueNs_ < reportNs ? dueNs_ + reportNs : nowNs + reportNs;
    return switchTones(left, right, number_++);
}

PadReport ToneFeed::rest() {
    silent_ = silentReports;
    return switchTones({}, {}, number_++);
}

} // namespace physvib
