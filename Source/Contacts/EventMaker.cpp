// SPDX-License-Identifier: MIT
// Computes an impact's events: sound and place once per pair, time and amplitude for each impact.
#include "Contacts/EventMaker.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>
#include <new>

namespace physvib {
namespace {

double massOf(const KnownFixture& camera, const BodyReader& bodies) {
    const BodyFacts body = bodies.facts(camera.body.body);
    return body.isDynamic ? body.massKg : camera.values.staticMassKg;
}

double handMassOf(const HapticFixture& camera, const ImpactModel& model) noexcept {
    return camera.handMassKg.value_or(model.handMassKg);
}

// The exponent of a strength is 1.5: between 1, the sum of vibrations in phase, and 2, of those that are not.
double powerOf(double strength) { return strength * std::sqrt(strength); }
double strengthOf(double power) { return portable::pow(power, 2.0 / 3.0); }

// Infinite if neither body can be moved: such an impact says nothing about speeds.
double lighterMassKg(const Impact& impact, const FixtureTable& table) {
    const double own = table[impact.camera].movableMassKg();
    return impact.other == FixtureTable::none ? own : std::min(own, table[impact.other].movableMassKg());
}

} // namespace

double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies,
                   const ImpactModel& model) {
    const KnownFixture& camera = table[impact.camera];
    ImpactModel own = model;
    own.handMassKg = handMassOf(camera.values, model);
    return camera.values.gain * own.amplitude(impact.newtonSeconds, massOf(camera, bodies));
}

EventMaker::EventMaker(const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies,
                       const ImpactModel& model, const ImpactSettings& settings, EventSorter& events,
                       ContactCounts& counts) noexcept
    : table_(table)
    , pairs_(pairs)
    , bodies_(bodies)
    , settings_(settings)
    , events_(events)
    , counts_(counts)
    , model_(model)
    , cos_(static_cast<float>(portable::cos(settings.fieldRadians)))
    , sin_(static_cast<float>(portable::sin(settings.fieldRadians)))
    , isAtContact_(settings.location == ImpactLocation::contact) {}

void EventMaker::addModesOf(const Impact& impact) {
    counts_.muted += isMuted_ ? 1 : 0;
    if (isMuted_) return;
    for (const Mode& mode : std::span{modes_.data(), static_cast<std::size_t>(modeCount_)}) {
        setMode(mode);
        sound(mode, impact, amplitudeOf(impact));
    }
}

void EventMaker::addAll(const GrainRuns& of) {
    other_ = FixtureTable::none - 1; // the event's is another
    // which zero is the least depends on their order
    const bool hasZero = of.least[0] * of.least[1] * of.most[0] * of.most[1] == 0.0;
    if (of.isUsual && !hasZero && events_.push(of, event_)) [[likely]]
        return made_.add(of.count, of.least, of.most);
    for (std::size_t i = 0; i < of.count; ++i) {
        event_.timeNs = of.timeNs[i];
        event_.amplitude = of.amplitude[i];
        event_.x = of.x[i];
        event_.y = of.y[i];
        event_.z = of.z[i];
        event_.source.other = of.runOf(i).otherId;
        event_.source.impulseNewtonSeconds = of.newtonSeconds[i];
        event_.source.kind = static_cast<ContactKind>(of.kinds[i]);
        if (event_.source.kind != ContactKind::hit) send(true);
    }
}

void EventMaker::setSource(std::int32_t camera) {
    camera_ = camera;
    hasMet_ = false;
    const KnownFixture& of = table_[camera];
    gain_ = of.values.gain;
    isMuted_ = settings_.isMuted || gain_ == 0.0;
    if (isMuted_) return;
    event_.source.fixture = of.id;
    event_.source.massKg = massOf(of, bodies_);
    const bool isScaled = model_.fullScaleNewtonSeconds > 0.0;
    perNewtonSecond_ = isScaled ? model_.driveGain : model_.driveGain * model_.normalisation;
    amplitudeDivisor_ =
        isScaled ? model_.fullScaleNewtonSeconds : event_.source.massKg + handMassOf(of.values, model_);
    event_.source.part = of.values.part;
    if (settings_.location == ImpactLocation::fixture) place(bodies_.toWorld(of.body.body, of.centre));
}

void EventMaker::setPartner(std::int32_t other) {
    const bool isSameSound = hasMet_ && hasOwnSound_; // as of many that roll on one floor
    hasMet_ = true;
    other_ = other;
    const HapticFixture& own = table_[camera_].values;
    event_.source.other = other == FixtureTable::none ? -1 : table_[other].id;
    hasOwnSound_ = other == FixtureTable::none || (own.voice == Voice::own && own.surface == 0);
    if (hasOwnSound_ && isSameSound) return;
    pairGain_ = 1.0;
    modeCount_ = 0;
    if (hasOwnSound_) return addModes(own);
    const HapticFixture& others = table_[other].values;
    if (const PairSound* const pair = pairs_.find(own.surface, others.surface)) {
        pairGain_ = pair->gain;
        return addModes(*pair);
    }
    const bool othersSounds = own.voice != Voice::own && others.frequencyHz > 0.0;
    if (own.voice != Voice::other || !othersSounds) addModes(own);
    if (othersSounds) addModes(others);
}

/// `sound`: a HapticFixture or a PairSound.
template <class Sound>
void EventMaker::addModes(const Sound& sound) noexcept {
    const auto add = [this](double frequencyHz, double decayPerSecond, double relativeAmplitude,
                            SoundNumber number) {
        CollisionEvent event;
        event.frequencyHz = frequencyHz;
        event.decayPerSecond = decayPerSecond;
        event.sound = number;
        modes_[static_cast<std::size_t>(modeCount_++)] = {frequencyHz, decayPerSecond, relativeAmplitude,
                                                          number, isPlayable(event)};
        setMode(modes_[0]); // the only one of most sounds
    };
    add(sound.frequencyHz, sound.decayPerSecond, 1.0, sound.sound);
    for (const Overtone& mode : sound.overtones)
        if (mode.frequencyHz > 0.0) add(mode.frequencyHz, mode.decayPerSecond, mode.relativeAmplitude, 0);
}

void FullScale::learn(std::span<const Impact> impacts, const StepSpan& step, const FixtureTable& table) {
    double power = 0.0, heaviestKg = 0.0;
    bool isHeard = false;
    for (const Impact& impact : impacts) {
        if (table[impact.camera].values.gain == 0.0) continue;
        isHeard = true;
        if (impact.kind == ContactKind::hit) power += powerOf(impact.newtonSeconds);
        const double massKg = lighterMassKg(impact, table);
        if (std::isfinite(massKg)) heaviestKg = std::max(heaviestKg, massKg);
    }
    if (!isHeard) return;
    const double seconds = static_cast<double>(step.endNs - learnedNs_) * 1.0e-9;
    learnedNs_ = step.endNs;
    sounding_ = strengthOf(powerOf(sounding_ * portable::exp(-fadePerSecond * seconds)) + power);
    const double fallen = level_ * portable::exp(-std::min(seconds, longestPauseSeconds) / fallSeconds);
    const double thresholds = level_ > 0.0 ? leastThresholds : firstThresholds;
    level_ = std::max({fallen, sounding_, thresholds * step.leastMetresPerSecond * heaviestKg});
}

// Doubles. What follows in the same step then needs no memory.
bool EventSorter::grow() noexcept {
    constexpr std::size_t least = 64;
    if (places_ == capacity_) return false;
    const std::size_t count = std::max(least, 2 * held_.size());
    try {
        for (auto* const list : {&turns_, &other_}) list->resize(count);
        shares_.resize(count);
        ends_.reserve(count + 2);
        std::vector<CollisionEvent> held(count);
        std::vector<Waiting> waiting(count);
        for (std::size_t i = 0; i < count_; ++i) {
            held[i] = held_[place(i)];
            waiting[i] = waiting_[place(i)];
        }
        held_.swap(held);
        waiting_.swap(waiting);
    } catch (const std::bad_alloc&) {
        return false;
    }
    first_ = 0;
    mask_ = count - 1;
    places_ = std::min(capacity_, count);
    return true;
}

bool EventSorter::push(const GrainRuns& grains, const CollisionEvent& model) noexcept {
    while (count_ + grains.count > places_)
        if (!grow()) return false;
    leastNewNs_ = std::min(leastNewNs_, grains.startNs);
    for (std::size_t i = 0; i < grains.count;) { // to the end of the ring, and from its beginning
        const std::size_t at = place(count_), end = i + std::min(grains.count - i, mask_ + 1 - at);
        grains.write(i, end, model, held_.data() + at);
        count_ += end - i;
        for (Waiting* to = waiting_.data() + at; i < end; ++i, ++to)
            *to = {grains.timeNs[i], model.source.fixture, grains.runOf(i).otherId};
    }
    return true;
}

// Those that stay move behind the last one that leaves: of grains none has to.
template <class IsLeft>
void EventSorter::leave(std::size_t count, IsLeft isLeft) noexcept {
    leastNewNs_ = std::numeric_limits<std::int64_t>::min(); // which are new is not known any more
    std::size_t to = count;
    for (std::size_t i = count; i-- > 0;) {
        if (isLeft(waiting_[place(i)])) continue;
        --to;
        held_[place(to)] = held_[place(i)];
        waiting_[place(to)] = waiting_[place(i)];
    }
    first_ = place(to);
    count_ -= to;
}

bool EventSorter::dropWeakest(double amplitude) noexcept {
    ++drops_;
    const auto amplitudeAt = [this](std::size_t i) { return std::abs(held_[place(i)].amplitude); };
    std::size_t weakest = 0;
    for (std::size_t i = 1; i < count_; ++i)
        if (amplitudeAt(i) < amplitudeAt(weakest)) weakest = i;
    if (count_ == 0 || !(amplitudeAt(weakest) < std::abs(amplitude))) return false;
    const Waiting* const left = &waiting_[place(weakest)];
    leave(weakest + 1, [left](const Waiting& each) { return &each == left; });
    return true;
}

void EventSorter::release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished) {
    const std::size_t among = leastNewNs_ < beforeNs ? count_ : old_; // none of the new ones is released
    // By time into as many buckets as there may be events: grains arrive by hundreds per step, evenly
    // distributed, so each bucket has few.
    std::int64_t toNs = beforeNs;
    if (beforeNs == std::numeric_limits<std::int64_t>::max()) { // all
        toNs = releasedNs_;
        for (std::size_t i = 0; i < among; ++i) toNs = std::max(toNs, waiting_[place(i)].timeNs);
    }
    const std::int64_t fromNs = std::exchange(releasedNs_, toNs);
    const double sharesPerNs = static_cast<double>(among) / std::max(1.0, static_cast<double>(toNs - fromNs));
    ends_.assign(among + 2, 0);
    std::size_t end = 0;
    Turn *const turns = turns_.data(), *turn = turns;
    std::uint32_t *const shares = shares_.data(), *const ends = ends_.data(), *share = shares;
    const Waiting* const waiting = waiting_.data();
    for (std::size_t i = 0, mask = mask_, first = first_; i < among; ++i) {
        const Waiting& each = waiting[(first + i) & mask];
        if (each.timeNs >= beforeNs) continue;
        const auto fixture = static_cast<std::uint32_t>(each.fixture) ^ 0x80000000U; // in order as unsigned
        *turn++ = {each.timeNs, static_cast<std::uint64_t>(fixture) << 32U | i};
        const auto bucket =
            static_cast<std::int64_t>(static_cast<double>(each.timeNs - fromNs) * sharesPerNs);
        *share++ = static_cast<std::uint32_t>(std::max<std::int64_t>(0, bucket));
        ++ends[share[-1] + 1];
        end = i + 1;
    }
    const auto count = static_cast<std::size_t>(turn - turns);
    if (count > 0) {
        for (std::size_t i = 1; i < ends_.size(); ++i) ends[i] += ends[i - 1];
        Turn* const other = other_.data();
        for (std::size_t i = 0; i < count; ++i) other[ends[shares[i]]++] = turns[i]; // begins become ends
        turns_.swap(other_);
        sort(count);
        if (finished.capacity() - finished.size() < count)
            finished.reserve(std::max(finished.size() + count, 2 * finished.capacity()));
        const CollisionEvent* const held = held_.data();
        const std::size_t first = first_, mask = mask_;
        for (const Turn& each : std::span{turns_.data(), count})
            finished.push_back(held[(first + (each.rank & 0xFFFFFFFFU)) & mask]);
        if (count < end) {
            leave(end, [beforeNs](const Waiting& each) { return each.timeNs < beforeNs; });
        } else {
            first_ = place(count);
            count_ -= count;
        }
    }
    old_ = count_;
    leastNewNs_ = std::numeric_limits<std::int64_t>::max();
}

// Moves each behind those before it: few steps once they are in buckets. Where most have one time, as hits at
// the start of a step, it gives up.
void EventSorter::sort(std::size_t count) noexcept {
    std::size_t steps = 128 + 8 * count;
    Turn* const turns = turns_.data();
    for (std::size_t i = 1; i < count; ++i) {
        if (!(turns[i] < turns[i - 1])) continue;
        const Turn moved = turns[i];
        std::size_t hole = i;
        do {
            turns[hole] = turns[hole - 1];
            --hole;
        } while (hole > 0 && moved < turns[hole - 1]);
        turns[hole] = moved;
        if (i - hole > steps) return std::sort(turns, turns + count);
        steps -= i - hole;
    }
}

void EventSorter::withdraw(std::int32_t fixture, bool asOther) noexcept {
    leave(count_,
          [=](const Waiting& each) { return each.fixture == fixture || (asOther && each.other == fixture); });
}

} // namespace physvib
