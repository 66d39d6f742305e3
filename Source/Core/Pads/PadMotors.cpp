// SPDX-License-Identifier: MIT
// Implementation of the conversion from events to motor commands: the energy of modes is shared between two
// motors, and each motor's command is computed from its model.
#include "Core/Pads/PadMotors.h"
#include <algorithm>

namespace physvib {
namespace {

double secondsOf(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }
// rounded up, so that a command does not fall below a threshold
double inHundredths(double command) noexcept {
    return std::clamp(std::ceil(100.0 * command - 1e-9) / 100.0, 0.0, 1.0) + 0.0;
}
constexpr double nearEnough = 0.03; // of full strength: an imperceptible difference that would cost a command

/// 0: all in the left grip, 1: all in the right one.
double sideOf(const CollisionEvent& event, const PhantomPanner& grips) noexcept {
    PhantomPanner::Gains gains{};
    grips.gainsAt(event, gains);
    const double left = gains[0] * gains[0], right = gains[1] * gains[1];
    return left + right > 0.0 ? right / (left + right) : 0.5;
}

} // namespace

PhantomPanner PadMotors::gripsOf(const PhantomPanner& field) noexcept {
    EnchanterLayout layout{field.layout().extentWidthMetres, field.layout().extentHeightMetres, 2, {}};
    layout.places[0] = {0.0, 0.5 * layout.extentHeightMetres};
    layout.places[1] = {layout.extentWidthMetres, 0.5 * layout.extentHeightMetres};
    return {layout, PanningLaw::energy, 1.0, field.fieldWidthMetres(), field.fieldHeightMetres()};
}

bool PadMotors::strike(const CollisionEvent& event, const PhantomPanner& grips) noexcept {
    if (!isPlayable(event) || isClip(event.sound) || event.amplitude == 0.0) return true;
    Voice voice;
    voice.startNs = std::max<std::int64_t>(0, event.timeNs - leadNs());
    voice.endNs = event.durationNs > 0 ? voice.startNs + event.durationNs : 0;
    voice.decayPerSecond = event.decayPerSecond;
    voice.energy = event.amplitude * event.amplitude;
    voice.heavyShare = 1.0 / (1.0 + portable::pow(event.frequencyHz / law_.splitHz, 4.0));
    voice.travelNs = event.course.travelNs;
    voice.fromSide = sideOf(event, grips);
    voice.toSide = voice.travelNs > 0 ? sideOf(movedAlong(event, 1.0), grips) : voice.fromSide;
    const Energies energies = shared(voice.energy, voice.heavyShare, voice.fromSide);
    voice.low = energies.low, voice.high = energies.high;
    if (waits_ == waiting_.size()) { // the weakest is lost
        ++lost_;
        const auto weakest = std::ranges::min_element(waiting_, {}, &Voice::energy);
        if (weakest->energy >= voice.energy) return false;
        std::move(weakest + 1, waiting_.end(), weakest);
        --waits_;
    }
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(waits_);
    const auto place = std::upper_bound(waiting_.begin(), end, voice.startNs,
                                        [](std::int64_t ns, const Voice& v) { return ns < v.startNs; });
    std::move_backward(place, end, end + 1);
    *place = voice;
    ++waits_;
    return true;
}

void PadMotors::stop(std::int64_t atNs) noexcept {
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(waits_);
    const auto later = std::find_if(waiting_.begin(), end,
                                    [&](const Voice& voice) { return voice.startNs + leadNs() >= atNs; });
    waits_ = static_cast<std::size_t>(std::move(later, end, waiting_.begin()) - waiting_.begin());
    ringing_ = 0;
    low_.kick = high_.kick = 0.0;
    stopNs_ = atNs;
}

std::int64_t PadMotors::dueNs() const noexcept {
    const std::int64_t soonest = std::max(lastNs_ + intervalNs(), stopNs_);
    if (!isAtRest()) return soonest;
    return waits_ > 0 ? std::max(soonest, waiting_.front().startNs) : never;
}

// Frequency determines the energy's split at the centre; place moves it to one grip. The sum is kept.
PadMotors::Energies PadMotors::shared(double energy, double heavyShare, double side) const noexcept {
    const double low = heavyShare * (1.0 - law_.side + 2.0 * law_.side * (1.0 - side)),
                 high = (1.0 - heavyShare) * (1.0 - law_.side + 2.0 * law_.side * side);
    const double sum = low + high;
    return sum > 0.0 ? Energies{energy * low / sum, energy * high / sum}
                     : Energies{energy * heavyShare, energy * (1.0 - heavyShare)};
}

PadMotors::Energies PadMotors::energiesAt(const Voice& voice, std::int64_t timeNs) const noexcept {
    if (voice.endNs != 0 && timeNs >= voice.endNs) return {};
    const std::int64_t sinceNs = std::max<std::int64_t>(0, timeNs - voice.startNs);
    const double left = portable::exp(-2.0 * voice.decayPerSecond * secondsOf(sinceNs));
    if (voice.travelNs == 0) return {voice.low * left, voice.high * left};
    const double way = std::min(1.0, secondsOf(sinceNs) / secondsOf(voice.travelNs));
    return shared(voice.energy * left, voice.heavyShare,
                  voice.fromSide + way * (voice.toSide - voice.fromSide));
}

double PadMotors::wanted(double amplitude) const noexcept {
    if (amplitude < law_.floor) return 0.0;
    return leastFelt + (1.0 - leastFelt) * portable::pow(std::min(1.0, amplitude), law_.exponent);
}

// An impact above the perception floor drives at least the motor with the larger share.
void PadMotors::begin(const Voice& voice, double level) noexcept {
    const double whole = std::sqrt(voice.low + voice.high) * level;
    double low = std::sqrt(voice.low) * level, high = std::sqrt(voice.high) * level;
    if (whole >= law_.floor) (low > high ? low : high) = std::max(law_.floor, low > high ? low : high);
    const auto kick = [&](State& state, double amplitude) {
        const double strength = wanted(amplitude);
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
    for (std::size_t i = 0; i < ringing_ && voice.mayMerge(); ++i) {
        Voice& there = voices_[i];
        if (!there.mayMerge() || there.decayPerSecond != voice.decayPerSecond) continue;
        const std::int64_t startNs = std::max(there.startNs, voice.startNs);
        const Energies before = energiesAt(there, startNs), more = energiesAt(voice, startNs);
        there.startNs = startNs;
        there.low = before.low + more.low, there.high = before.high + more.high;
        return;
    }
    if (ringing_ < voices_.size()) {
        voices_[ringing_++] = voice;
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

double PadMotors::drive(State& state, const PadMotor& motor, double amplitude,
                        double seconds) const noexcept {
    const double strength = std::max(wanted(amplitude), state.kick);
    if (strength <= 0.0) return 0.0;
    if (state.command > 0.0 &&
        std::abs(motor.strengthAfter(state.strength, state.command, seconds) - strength) < nearEnough)
        return state.command;
    const double share = motor.shareOfWay(seconds, strength > state.strength);
    return std::max(motor.threshold, motor.commandOf((strength - state.strength * (1.0 - share)) / share));
}

void PadMotors::beginUntil(std::int64_t nowNs, double level) noexcept {
    std::size_t begun = 0;
    for (; begun < waits_ && waiting_[begun].startNs <= nowNs; ++begun) begin(waiting_[begun], level);
    const auto first = waiting_.begin();
    std::move(first + static_cast<std::ptrdiff_t>(begun), first + static_cast<std::ptrdiff_t>(waits_), first);
    waits_ -= begun;
}

PadMotors::Energies PadMotors::ringingAt(std::int64_t nowNs) noexcept {
    Energies sum;
    for (std::size_t i = 0; i < ringing_;) {
        const Energies energies = energiesAt(voices_[i], nowNs);
        sum.low += energies.low, sum.high += energies.high;
        if (std::sqrt(energies.low + energies.high) < 0.1 * law_.floor)
            voices_[i] = voices_[--ringing_];
        else
            ++i;
    }
    return sum;
}

PadCommand PadMotors::next(double level) noexcept {
    const std::int64_t nowNs = dueNs();
    const double passed = secondsOf(nowNs - lastNs_);
    low_.strength = law_.low.strengthAfter(low_.strength, low_.command, passed);
    high_.strength = law_.high.strengthAfter(high_.strength, high_.command, passed);
    beginUntil(nowNs, level);
    for (State* state : {&low_, &high_})
        if (level <= 0.0 || nowNs >= state->kickEndNs || state->strength >= 0.95 * state->kick)
            state->kick = 0.0;
    const Energies sum = ringingAt(nowNs);
    lastNs_ = nowNs;
    const double interval = 1.0 / law_.commandsPerSecond;
    low_.command = inHundredths(drive(low_, law_.low, std::sqrt(sum.low) * level, interval));
    high_.command = inHundredths(drive(high_, law_.high, std::sqrt(sum.high) * level, interval));
    return {nowNs, low_.command, high_.command};
}

PadMotors::Due PadMotors::nextUntil(std::int64_t untilNs, double level) noexcept {
    constexpr int most = 1000;
    Due due;
    for (; due.count < most && dueNs() <= untilNs; ++due.count) {
        due.last = next(level);
        due.strongest = {due.last.timeNs, std::max(due.strongest.low, due.last.low),
                         std::max(due.strongest.high, due.last.high)};
    }
    return due;
}

} // namespace physvib
