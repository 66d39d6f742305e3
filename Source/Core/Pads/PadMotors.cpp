// SPDX-License-Identifier: MIT
// Implementation of the conversion from events to motor commands: the energy of modes is shared between two
// motors, and each motor's command is computed from its model.
#include "Core/Pads/PadMotors.h"
#include <algorithm>

namespace physvib {
namespace {

double secondsOf(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }
// rounded up, so that a command does not fall below a threshold
double roundUpToHundredth(double command) noexcept {
    return std::clamp(std::ceil(100.0 * command - 1e-9) / 100.0, 0.0, 1.0) + 0.0;
}
constexpr double negligibleStrength = 0.03; // of full strength: an imperceptible difference that would cost a
                                            // command

/// 0: all in the left grip, 1: all in the right one.
double sideOf(const CollisionEvent& event, const PhantomPanner& gripPanner) noexcept {
    PhantomPanner::Gains gains{};
    gripPanner.gainsAt(event, gains);
    const double left = gains[0] * gains[0], right = gains[1] * gains[1];
    return left + right > 0.0 ? right / (left + right) : 0.5;
}

} // namespace

PhantomPanner PadMotors::makeGripPanner(const PhantomPanner& field) noexcept {
    ActuatorLayout layout{field.layout().extentWidthMetres, field.layout().extentHeightMetres, 2, {}};
    layout.places[0] = {0.0, 0.5 * layout.extentHeightMetres};
    layout.places[1] = {layout.extentWidthMetres, 0.5 * layout.extentHeightMetres};
    return {layout, PanningLaw::energy, 1.0, field.fieldWidthMetres(), field.fieldHeightMetres()};
}

bool PadMotors::strike(const CollisionEvent& event, const PhantomPanner& gripPanner) noexcept {
    if (!isPlayable(event) || isClip(event.sound) || event.amplitude == 0.0) return true;
    Voice voice;
    voice.startNs = std::max<std::int64_t>(0, event.timeNs - leadNs());
    voice.endNs = event.durationNs > 0 ? voice.startNs + event.durationNs : 0;
    voice.decayPerSecond = event.decayPerSecond;
    voice.energy = event.amplitude * event.amplitude *
                   portable::exp(-2.0 * event.decayPerSecond * secondsOf(event.course.toneAgeNs));
    voice.heavyShare = 1.0 / (1.0 + portable::pow(event.frequencyHz / pad_.splitHz, 4.0));
    voice.travelNs = event.course.travelNs;
    voice.fromSide = sideOf(event, gripPanner);
    voice.toSide = voice.travelNs > 0 ? sideOf(movedAlong(event, 1.0), gripPanner) : voice.fromSide;
    const Energies energies = shareEnergy(voice.energy, voice.heavyShare, voice.fromSide);
    voice.low = energies.low, voice.high = energies.high;
    if (pendingCount_ == pending_.size()) { // the weakest is lost
        ++lost_;
        const auto weakest = std::ranges::min_element(pending_, {}, &Voice::energy);
        if (weakest->energy >= voice.energy) return false;
        std::move(weakest + 1, pending_.end(), weakest);
        --pendingCount_;
    }
    const auto end = pending_.begin() + static_cast<std::ptrdiff_t>(pendingCount_);
    const auto place = std::upper_bound(pending_.begin(), end, voice.startNs,
                                        [](std::int64_t ns, const Voice& v) { return ns < v.startNs; });
    std::move_backward(place, end, end + 1);
    *place = voice;
    ++pendingCount_;
    return true;
}

void PadMotors::stop(std::int64_t atNs) noexcept {
    const auto end = pending_.begin() + static_cast<std::ptrdiff_t>(pendingCount_);
    const auto later = std::find_if(pending_.begin(), end,
                                    [&](const Voice& voice) { return voice.startNs + leadNs() >= atNs; });
    pendingCount_ = static_cast<std::size_t>(std::move(later, end, pending_.begin()) - pending_.begin());
    soundingCount_ = 0;
    low_.kick = high_.kick = 0.0;
    stopNs_ = atNs;
}

std::int64_t PadMotors::dueNs() const noexcept {
    const std::int64_t soonest = std::max(lastNs_ + intervalNs(), stopNs_);
    if (!isAtRest()) return soonest;
    return pendingCount_ > 0 ? std::max(soonest, pending_.front().startNs) : never;
}

// Frequency determines the energy's split at the centre; place moves it to one grip. The sum is kept.
PadMotors::Energies PadMotors::shareEnergy(double energy, double heavyShare, double side) const noexcept {
    const double low = heavyShare * (1.0 - pad_.placeWeight + 2.0 * pad_.placeWeight * (1.0 - side)),
                 high = (1.0 - heavyShare) * (1.0 - pad_.placeWeight + 2.0 * pad_.placeWeight * side);
    const double sum = low + high;
    return sum > 0.0 ? Energies{energy * low / sum, energy * high / sum}
                     : Energies{energy * heavyShare, energy * (1.0 - heavyShare)};
}

PadMotors::Energies PadMotors::energiesAt(const Voice& voice, std::int64_t timeNs) const noexcept {
    if (voice.endNs != 0 && timeNs >= voice.endNs) return {};
    const std::int64_t ageNs = std::max<std::int64_t>(0, timeNs - voice.startNs);
    const double remaining = portable::exp(-2.0 * voice.decayPerSecond * secondsOf(ageNs));
    if (voice.travelNs == 0) return {voice.low * remaining, voice.high * remaining};
    const double share = std::min(1.0, secondsOf(ageNs) / secondsOf(voice.travelNs));
    return shareEnergy(voice.energy * remaining, voice.heavyShare,
                       voice.fromSide + share * (voice.toSide - voice.fromSide));
}

double PadMotors::strengthFor(double amplitude) const noexcept {
    if (amplitude < pad_.floor) return 0.0;
    return minPerceptibleStrength +
           (1.0 - minPerceptibleStrength) * portable::pow(std::min(1.0, amplitude), pad_.exponent);
}

// An impact above the perception floor drives at least the motor with the larger share.
void PadMotors::begin(const Voice& voice, double level) noexcept {
    const double amplitudeSum = std::sqrt(voice.low + voice.high) * level;
    double low = std::sqrt(voice.low) * level, high = std::sqrt(voice.high) * level;
    if (amplitudeSum >= pad_.floor) (low > high ? low : high) = std::max(pad_.floor, low > high ? low : high);
    const auto kick = [&](MotorState& state, double amplitude) {
        const double strength = strengthFor(amplitude);
        if (strength <= 0.0 || strength < state.kick) return;
        state.kick = strength;
        state.kickEndNs = voice.startNs + kickNs;
    };
    kick(low_, low);
    kick(high_, high);
    add(voice);
}

// Modes of equal decay are merged; a full store drops its weakest.
void PadMotors::add(const Voice& voice) noexcept {
    for (std::size_t i = 0; i < soundingCount_ && voice.mayMerge(); ++i) {
        Voice& known = voices_[i];
        if (!known.mayMerge() || known.decayPerSecond != voice.decayPerSecond) continue;
        const std::int64_t startNs = std::max(known.startNs, voice.startNs);
        const Energies earlier = energiesAt(known, startNs), added = energiesAt(voice, startNs);
        known.startNs = startNs;
        known.low = earlier.low + added.low, known.high = earlier.high + added.high;
        return;
    }
    if (soundingCount_ < voices_.size()) {
        voices_[soundingCount_++] = voice;
        return;
    }
    ++lost_;
    const auto energyOf = [&](const Voice& v) {
        const Energies e = energiesAt(v, voice.startNs);
        return e.low + e.high;
    };
    auto& weakest = *std::min_element(voices_.begin(), voices_.end(), [&](const Voice& a, const Voice& b) {
        return energyOf(a) < energyOf(b);
    });
    if (energyOf(weakest) < energyOf(voice)) weakest = voice;
}

double PadMotors::drive(MotorState& state, const PadMotor& motor, double amplitude,
                        double seconds) const noexcept {
    const double strength = std::max(strengthFor(amplitude), state.kick);
    if (strength <= 0.0) return 0.0;
    if (state.command > 0.0 &&
        std::abs(motor.strengthAfter(state.strength, state.command, seconds) - strength) < negligibleStrength)
        return state.command;
    const double share = motor.shareOfChange(seconds, strength > state.strength);
    return std::max(motor.threshold, motor.commandOf((strength - state.strength * (1.0 - share)) / share));
}

void PadMotors::beginUntil(std::int64_t nowNs, double level) noexcept {
    std::size_t count = 0;
    for (; count < pendingCount_ && pending_[count].startNs <= nowNs; ++count) begin(pending_[count], level);
    const auto first = pending_.begin();
    std::move(first + static_cast<std::ptrdiff_t>(count), first + static_cast<std::ptrdiff_t>(pendingCount_),
              first);
    pendingCount_ -= count;
}

PadMotors::Energies PadMotors::soundingEnergiesAt(std::int64_t nowNs) noexcept {
    Energies sum;
    for (std::size_t i = 0; i < soundingCount_;) {
        const Energies energies = energiesAt(voices_[i], nowNs);
        sum.low += energies.low, sum.high += energies.high;
        if (std::sqrt(energies.low + energies.high) < 0.1 * pad_.floor)
            voices_[i] = voices_[--soundingCount_];
        else
            ++i;
    }
    return sum;
}

PadCommand PadMotors::next(double level) noexcept {
    const std::int64_t nowNs = dueNs();
    const double seconds = secondsOf(nowNs - lastNs_);
    low_.strength = pad_.low.strengthAfter(low_.strength, low_.command, seconds);
    high_.strength = pad_.high.strengthAfter(high_.strength, high_.command, seconds);
    beginUntil(nowNs, level);
    for (MotorState* state : {&low_, &high_})
        if (level <= 0.0 || nowNs >= state->kickEndNs || state->strength >= 0.95 * state->kick)
            state->kick = 0.0;
    const Energies sum = soundingEnergiesAt(nowNs);
    lastNs_ = nowNs;
    const double interval = 1.0 / pad_.commandsPerSecond;
    low_.command = roundUpToHundredth(drive(low_, pad_.low, std::sqrt(sum.low) * level, interval));
    high_.command = roundUpToHundredth(drive(high_, pad_.high, std::sqrt(sum.high) * level, interval));
    return {nowNs, low_.command, high_.command};
}

PadMotors::DueCommands PadMotors::nextUntil(std::int64_t untilNs, double level) noexcept {
    constexpr int maxCommands = 1000;
    DueCommands due;
    for (; due.count < maxCommands && dueNs() <= untilNs; ++due.count) {
        due.last = next(level);
        due.strongest = {due.last.timeNs, std::max(due.strongest.low, due.last.low),
                         std::max(due.strongest.high, due.last.high)};
    }
    return due;
}

} // namespace physvib
