// SPDX-License-Identifier: MIT
// Implementation of the renderer: preparation, controls, starting of events, and the processing of one part
// of a block.
#include "Core/HapticRenderer.h"
#include "Core/Modes/ModeIncrements.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace physvib {

bool HapticRenderer::areValid(const RendererSettings& settings) noexcept {
    const int outputs = settings.outputs();
    if (!isSampleRate(settings.sampleRateHz) || settings.channels < 0 || settings.modes < 0 ||
        settings.modes > limits::maxModes || outputs < 1 || outputs > limits::maxActuators)
        return false;
    if (settings.panner.channels() < 0 || settings.panner.channels() > outputs) return false;
    return std::all_of(settings.ceilings.begin(), settings.ceilings.begin() + outputs,
                       [](float ceiling) { return ceiling > 0.0f && std::isfinite(ceiling); });
}

bool HapticRenderer::prepare(const RendererSettings& settings) noexcept {
    isPrepared_ = areValid(settings);
    position_ = 0;
    played_ = late_ = rejected_ = withoutPart_ = 0;
    channels_ = std::clamp(settings.outputs(), 0, limits::maxActuators);
    if (!isPrepared_) return false;
    settings_ = settings;
    clock_ = FrameClock{settings.sampleRateHz};
    panners_ = settings.panner;
    gains_.fill(0.0);
    guard_.prepare(settings.sampleRateHz, channels_, GuardPlace::rendered, settings.instructions);
    silentUntilNs_ = worldlessSilentUntilNs_ = INT64_MIN;
    return isPrepared_ = allocate();
}

bool HapticRenderer::allocate() noexcept {
    const auto share = [this](int full, int min) {
        return settings_.scaledToModes(full, limits::maxModes, std::min(full, min));
    };
    return bank_.prepare(settings_.sampleRateHz, channels_, settings_.instructions,
                         share(limits::maxModes, 1), share(limits::maxGates, 256)) &&
           actuators_.prepare(settings_.sampleRateHz, channels_, settings_.equalised) && prepareAtRate() &&
           pending_.resize(share(limits::maxPending, 512)) &&
           playedQueue_.resize(std::bit_ceil(static_cast<unsigned>(share(limits::playedQueueSize, 512)))) &&
           panners_.prepare(channels_) && controls_.resize(share(limits::maxControls, 64));
}

bool HapticRenderer::prepareAtRate() noexcept {
    const bool hasMemory =
        limiter_.prepare(settings_.sampleRateHz, channels_, settings_.limiterEnabled, settings_.instructions);
    for (int j = 0; j < channels_; ++j)
        limiter_.setCeiling(j, settings_.ceilings[static_cast<std::size_t>(j)]);
    return hasMemory && player_.prepare(settings_.sampleRateHz, channels_) &&
           moving_.prepare(settings_.sampleRateHz, channels_);
}

void HapticRenderer::setContacts(const RecordedContacts& contacts) noexcept {
    player_.setContacts(contacts.list);
    othersAreModes_ = contacts.othersAreModes;
}

bool HapticRenderer::moveTo(int sampleRateHz, std::int64_t frame) noexcept {
    if (!isPrepared_ || !isSampleRate(sampleRateHz)) return false;
    bank_.moveTo(position_, sampleRateHz, frame);
    settings_.sampleRateHz = sampleRateHz;
    clock_ = FrameClock{sampleRateHz};
    guard_.changeRate(sampleRateHz);
    position_ = frame;
    return isPrepared_ = actuators_.changeRate(sampleRateHz) && prepareAtRate();
}

void HapticRenderer::apply(const RenderControl& control) noexcept {
    using Kind = RenderControl::Kind;
    const bool isChannel = control.channel >= 0 && control.channel < channels_;
    if (control.kind == Kind::panner && control.panner != nullptr && control.panner->channels() <= channels_)
        panners_ = *control.panner;
    if (control.kind == Kind::gain && isChannel) actuators_.setGain(control.channel, control.value);
    if (control.kind == Kind::level) actuators_.setLevel(control.value);
    if (control.kind == Kind::mute && isChannel) actuators_.setMuted(control.channel, control.value != 0.0f);
    if (control.kind == Kind::delay && isChannel) actuators_.setDelay(control.channel, control.value);
    if (control.kind == Kind::ceiling && isChannel && control.value > 0.0f && std::isfinite(control.value)) {
        settings_.ceilings[static_cast<std::size_t>(control.channel)] = control.value;
        limiter_.setCeiling(control.channel, control.value);
    }
    if (control.kind == Kind::recordings) setContacts(control.recordings);
    const bool isSilence = control.kind == Kind::silence;
    if (isSilence) {
        silentUntilNs_ = std::max(silentUntilNs_, control.untilNs);
        worldlessSilentUntilNs_ =
            std::max(worldlessSilentUntilNs_, control.value != 0.0f ? control.timeNs : control.untilNs);
    }
    if (isSilence || control.kind == Kind::stopAll) {
        bank_.fadeAll(position_, isSilence ? limits::silenceFadePerSecond : limits::stealFadePerSecond);
        moving_.fadeAll(position_);
    }
    if (isSilence || control.kind == Kind::stopAll || control.kind == Kind::recordings)
        player_.fadeAll(position_);
}

int HapticRenderer::discardPending(const WaitingEvents& selection) noexcept {
    constexpr std::int64_t first = INT64_MIN;
    const int before = pending_.size();
    pending_.retime([=](std::int64_t time, const CollisionEvent& event) {
        return selection.contain(event, time) ? first : time;
    });
    while (!pending_.empty() && pending_.nextTime() == first) pending_.pop();
    return before - pending_.size();
}

bool HapticRenderer::isSilenced(const CollisionEvent& event) const noexcept {
    return event.timeNs < (event.source.fixture < 0 ? worldlessSilentUntilNs_ : silentUntilNs_);
}

// Starts an event at its onset, or at once if that has passed. False: it could not be played.
bool HapticRenderer::strike(const CollisionEvent& event, FramePosition onset) noexcept {
    const std::int64_t delay = position_ - onset.frame;
    if (delay > 0) onset = {position_, 0.0}; // a late event starts at its first frame now, uncut
    const bool isGated = event.durationNs > 0;
    const std::int64_t end =
        isGated ? clock_.at(event.timeNs + event.durationNs).frame + std::max<std::int64_t>(delay, 0)
                : Strike::never;
    const bool isStarted = event.course.travelNs > 0 ? end <= onset.frame || moving_.strike(event, onset, end)
                                                     : strikeStill(event, onset, end);
    if (isStarted)
        playedQueue_.pushInPlace([&](PlayedEvent& record) noexcept {
            record.event = event;
            record.frame = onset.frame;
            record.isLate = delay > 0;
        });
    played_ += isStarted ? 1 : 0;
    late_ += isStarted && delay > 0 ? 1 : 0;
    rejected_ += isStarted ? 0 : 1;
    withoutPart_ += isStarted && panners_.base().lacksPartOf(event) ? 1 : 0;
    return isStarted;
}

bool HapticRenderer::strikeStill(const CollisionEvent& event, FramePosition onset,
                                 std::int64_t closeFrame) noexcept {
    panners_.gainsAt(event, gains_);
    std::fill(gains_.begin() + panners_.base().channels(), gains_.begin() + channels_, 0.0);
    Strike s{event.frequencyHz, event.decayPerSecond, event.amplitude, onset, closeFrame};
    if (event.course.toneAgeNs > 0) {
        const double seconds = static_cast<double>(event.course.toneAgeNs) * 1e-9;
        s.phase = phaseAfter(event.frequencyHz * seconds);
        s.amplitude *= shareLeft(event.decayPerSecond, seconds);
    }
    if (const RecordedContact* const contact = player_.find(event.sound, event.frequencyHz))
        return player_.strike(*contact, s.amplitude, onset.frame, closeFrame, gains_.data());
    if (isClip(event.sound) || (player_.isOn() && !othersAreModes_)) return false; // needs a recording
    return isCoupled() ? strikeCoupled(s) : bank_.strike(s, gains_.data());
}

void HapticRenderer::driveAt(const CollisionEvent& event, double* inPhase, double* quadrature) noexcept {
    panners_.gainsAt(event, gains_);
    if (isCoupled())
        settings_.drives.apply(event.frequencyHz, gains_.data(), inPhase, quadrature);
    else
        std::copy_n(gains_.begin(), panners_.base().channels(), inPhase);
}

// A complex drive is two strikes of one mode, a quarter turn apart. They merge, so they use one mode. Either
// both are struck or none.
bool HapticRenderer::strikeCoupled(Strike strike) noexcept {
    if (strike.closeFrame != Strike::never && bank_.freeGates() < 2) return false;
    std::array<double, static_cast<std::size_t>(limits::maxActuators)> inPhase{}, quadrature{};
    settings_.drives.apply(strike.frequencyHz, gains_.data(), inPhase.data(), quadrature.data());
    bank_.strike(strike, inPhase.data());
    strike.phase += std::uint64_t{1} << 62;
    return bank_.strike(strike, quadrature.data());
}

// Fast path for modes alone that reach the limiter unchanged. The limiter reads them where they were summed,
// and the delay lines keep a copy in case a delay is set later. False: the general path is needed.
bool HapticRenderer::renderModesOnly(const Channels& out, int frames) noexcept {
    Channels delayInputs;
    std::array<const float*, static_cast<std::size_t>(limits::maxActuators)> sums;
    const bool hasOnlyModes =
        bank_.liveModes() > 0 && limiter_.hasKernel() && player_.voices() == 0 && moving_.count() == 0;
    if (!hasOnlyModes || !actuators_.canBypass(delayInputs.data(), frames)) return false;
    if (!bank_.findSums(sums.data(), position_)) {
        if (!bank_.render(out.data(), position_, frames)) return false;
        std::copy_n(out.begin(), channels_, sums.begin());
    }
    actuators_.bypass(frames);
    limiter_.processInto(sums.data(), out.data(), frames, delayInputs.data());
    applyGuard(out, frames, false);
    return true;
}

void HapticRenderer::renderAll(const Channels& out, int frames, const float* const* added) noexcept {
    const bool modesSound = bank_.render(out.data(), position_, frames),
               recordingsSound = player_.render(out.data(), position_, frames);
    const bool movingSounds =
        moving_.count() > 0 &&
        moving_.render(out.data(), position_, frames, [this](const auto&... drive) { driveAt(drive...); });
    for (int j = 0; added && j < channels_; ++j)
        std::transform(added[j], added[j] + frames, out[static_cast<std::size_t>(j)],
                       out[static_cast<std::size_t>(j)], [](float a, float b) { return a + b; });
    const bool isSilent =
        actuators_.process(out.data(), frames, !modesSound && !recordingsSound && !movingSounds && !added);
    applyGuard(out, frames, limiter_.process(out.data(), frames, isSilent));
}

// Without the limiter samples are unbounded, so the guard does not act; that of the device still does.
void HapticRenderer::applyGuard(const Channels& out, int frames, bool isSilent) noexcept {
    if (!settings_.limiterEnabled) return;
    guard_.moveTo(position_);
    guard_.process(out.data(), frames, isSilent);
}

void HapticRenderer::normalise(float* const* out, int frames) const noexcept {
    for (int j = 0; j < channels_; ++j) {
        const float ceiling = settings_.ceilings[static_cast<std::size_t>(j)];
        float peak = ceiling;
        for (int n = 0; n < frames; ++n) peak = std::max(peak, std::abs(out[j][n]));
        for (int n = 0; peak > ceiling && n < frames; ++n) out[j][n] *= ceiling / peak;
    }
}

// First frame at which processing has to stop: the end of the tile, the next gate or the next control; at
// most `maxFrames` away.
std::int64_t HapticRenderer::nextChange(int maxFrames) const noexcept {
    constexpr int tile = limits::tileFrames;
    std::int64_t end = std::min(position_ + maxFrames, position_ - position_ % tile + tile);
    end = std::min(end, bank_.nextGateFrame());
    if (!controls_.empty()) end = std::min(end, clock_.at(controls_.nextTime()).frame);
    return end;
}

RenderStatus HapticRenderer::status() const noexcept {
    return {.framesRendered = position_,
            .played = played_,
            .late = late_,
            .rejected = rejected_,
            .withoutPart = withoutPart_,
            .stolen = bank_.stolenModes(),
            .nonFinite = limiter_.nonFiniteSamples(),
            .unsent = playedQueue_.overflows(),
            .liveModes = bank_.liveModes(),
            .pending = pending_.size(),
            .limiterGain = limiter_.gain(),
            .guardGain = guard_.gain(),
            .guarded = guard_.episodes()};
}

} // namespace physvib
