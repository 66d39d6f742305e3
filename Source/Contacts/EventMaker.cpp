// SPDX-License-Identifier: MIT
// Computes an impact's events: sound and place once per pair, time and amplitude for each impact.
#include "Contacts/EventMaker.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>
#include <new>

namespace physvib {
namespace {

double massOf(const FixtureEntry& source, const BodyReader& bodies) {
    const BodyFacts body = bodies.facts(source.body.body);
    return body.isDynamic ? body.massKg : source.values.staticMassKg;
}

double handMassOf(const HapticFixture& source, const ImpactModel& model) noexcept {
    return source.handMassKg.value_or(model.handMassKg);
}

// Strengths are summed to the power of 1.5: between 1, as vibrations in phase, and 2, as independent ones.
double powerOf(double strength) { return strength * std::sqrt(strength); }
double strengthOf(double power) { return portable::pow(power, 2.0 / 3.0); }

// Infinite if neither body can be moved: such an impact says nothing about speeds.
double lighterMassKg(const Impact& impact, const FixtureTable& table) {
    const double mass = table[impact.source].movableMassKg();
    return impact.other == FixtureTable::none ? mass : std::min(mass, table[impact.other].movableMassKg());
}

} // namespace

double amplitudeOf(const Impact& impact, const FixtureTable& table, const BodyReader& bodies,
                   const ImpactModel& model) {
    const FixtureEntry& source = table[impact.source];
    ImpactModel adapted = model;
    adapted.handMassKg = handMassOf(source.values, model);
    return source.values.gain * adapted.amplitude(impact.newtonSeconds, massOf(source, bodies));
}

EventMaker::EventMaker(const FixtureTable& table, const PairSounds& pairs, const BodyReader& bodies,
                       const ImpactModel& model, const ImpactSettings& settings, EventSorter& events,
                       ContactCounts& counts) noexcept
    : table_(table)
    , pairSounds_(pairs)
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
        addEvent(mode, impact, amplitudeOf(impact));
    }
}

void EventMaker::addGrains(const GrainRuns& runs) {
    partner_ = FixtureTable::none - 1; // the current pair is not that of event_
    // the sign of a bound of 0 depends on the order of the grains
    const bool hasZero = runs.minPlace[0] * runs.minPlace[1] * runs.maxPlace[0] * runs.maxPlace[1] == 0.0;
    if (runs.isPlayable && !hasZero && events_.push(runs, event_)) [[likely]]
        return eventBounds_.add(runs.count, runs.minPlace, runs.maxPlace);
    for (std::size_t i = 0; i < runs.count; ++i) {
        event_.timeNs = runs.timeNs[i];
        event_.amplitude = runs.amplitude[i];
        event_.x = runs.x[i];
        event_.y = runs.y[i];
        event_.z = runs.z[i];
        event_.source.other = runs.runOf(i).otherId;
        event_.source.impulseNewtonSeconds = runs.newtonSeconds[i];
        event_.source.kind = static_cast<ContactKind>(runs.kinds[i]);
        if (event_.source.kind != ContactKind::hit) send(true);
    }
}

void EventMaker::setSource(std::int32_t source) {
    source_ = source;
    hasPartner_ = false;
    const FixtureEntry& fixture = table_[source];
    gain_ = fixture.values.gain;
    isMuted_ = settings_.isMuted || gain_ == 0.0;
    if (isMuted_) return;
    event_.source.fixture = fixture.id;
    event_.source.massKg = massOf(fixture, bodies_);
    const bool isScaled = model_.fullScaleNewtonSeconds > 0.0;
    perNewtonSecond_ = isScaled ? model_.driveGain : model_.driveGain * model_.normalisation;
    amplitudeDivisor_ =
        isScaled ? model_.fullScaleNewtonSeconds : event_.source.massKg + handMassOf(fixture.values, model_);
    event_.source.part = fixture.values.part;
    if (settings_.location == ImpactLocation::fixture)
        setPlace(bodies_.toWorld(fixture.body.body, fixture.centre));
}

void EventMaker::setPartner(std::int32_t other) {
    const bool isSameSound = hasPartner_ && hasOwnSound_; // as of many that roll on one floor
    hasPartner_ = true;
    partner_ = other;
    const HapticFixture& source = table_[source_].values;
    event_.source.other = other == FixtureTable::none ? -1 : table_[other].id;
    hasOwnSound_ = other == FixtureTable::none || (source.voice == Voice::own && source.surface == 0);
    if (hasOwnSound_ && isSameSound) return;
    pairGain_ = 1.0;
    modeCount_ = 0;
    if (hasOwnSound_) return addModes(source);
    const HapticFixture& partner = table_[other].values;
    if (const PairSound* const pair = pairSounds_.find(source.surface, partner.surface)) {
        pairGain_ = pair->gain;
        return addModes(*pair);
    }
    const bool partnerSounds = source.voice != Voice::own && partner.frequencyHz > 0.0;
    if (source.voice != Voice::other || !partnerSounds) addModes(source);
    if (partnerSounds) addModes(partner);
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
    bool hasUnmuted = false;
    for (const Impact& impact : impacts) {
        if (table[impact.source].values.gain == 0.0) continue;
        hasUnmuted = true;
        if (impact.kind == ContactKind::hit) power += powerOf(impact.newtonSeconds);
        const double massKg = lighterMassKg(impact, table);
        if (std::isfinite(massKg)) heaviestKg = std::max(heaviestKg, massKg);
    }
    if (!hasUnmuted) return;
    const double seconds = static_cast<double>(step.endNs - learnedNs_) * 1.0e-9;
    learnedNs_ = step.endNs;
    strength_ = strengthOf(powerOf(strength_ * portable::exp(-fadePerSecond * seconds)) + power);
    const double decayedLevel = level_ * portable::exp(-std::min(seconds, longestPauseSeconds) / fallSeconds);
    const double thresholds = level_ > 0.0 ? minThresholds : firstThresholds;
    level_ = std::max({decayedLevel, strength_, thresholds * step.minThresholdMetresPerSecond * heaviestKg});
}

// Doubles the memory, so that later events of the same step need none.
bool EventSorter::grow() noexcept {
    constexpr std::size_t minCount = 64;
    if (slotCount_ == capacity_) return false;
    const std::size_t count = std::max(minCount, 2 * heldEvents_.size());
    try {
        for (auto* const list : {&order_, &sorted_}) list->resize(count);
        buckets_.resize(count);
        bucketEnds_.reserve(count + 2);
        std::vector<CollisionEvent> held(count);
        std::vector<HeldKey> keys(count);
        for (std::size_t i = 0; i < count_; ++i) {
            held[i] = heldEvents_[ringIndex(i)];
            keys[i] = keys_[ringIndex(i)];
        }
        heldEvents_.swap(held);
        keys_.swap(keys);
    } catch (const std::bad_alloc&) {
        return false;
    }
    first_ = 0;
    mask_ = count - 1;
    slotCount_ = std::min(capacity_, count);
    return true;
}

bool EventSorter::push(const GrainRuns& grains, const CollisionEvent& model) noexcept {
    while (count_ + grains.count > slotCount_)
        if (!grow()) return false;
    earliestNewNs_ = std::min(earliestNewNs_, grains.startNs);
    for (std::size_t i = 0; i < grains.count;) { // first to the end of the ring, then from its beginning
        const std::size_t slot = ringIndex(count_), end = i + std::min(grains.count - i, mask_ + 1 - slot);
        grains.write(i, end, model, heldEvents_.data() + slot);
        count_ += end - i;
        for (HeldKey* key = keys_.data() + slot; i < end; ++i, ++key)
            *key = {grains.timeNs[i], model.source.fixture, grains.runOf(i).otherId};
    }
    return true;
}

// Removes events among the first `count`. Those that stay move to the end of this range; usually none does.
template <class IsRemoved>
void EventSorter::removeIf(std::size_t count, IsRemoved isRemoved) noexcept {
    earliestNewNs_ = std::numeric_limits<std::int64_t>::min(); // it is no longer known which events are new
    std::size_t target = count;
    for (std::size_t i = count; i-- > 0;) {
        if (isRemoved(keys_[ringIndex(i)])) continue;
        --target;
        heldEvents_[ringIndex(target)] = heldEvents_[ringIndex(i)];
        keys_[ringIndex(target)] = keys_[ringIndex(i)];
    }
    first_ = ringIndex(target);
    count_ -= target;
}

bool EventSorter::dropWeakest(double amplitude) noexcept {
    ++drops_;
    const auto amplitudeAt = [this](std::size_t i) { return std::abs(heldEvents_[ringIndex(i)].amplitude); };
    std::size_t weakest = 0;
    for (std::size_t i = 1; i < count_; ++i)
        if (amplitudeAt(i) < amplitudeAt(weakest)) weakest = i;
    if (count_ == 0 || !(amplitudeAt(weakest) < std::abs(amplitude))) return false;
    const HeldKey* const dropped = &keys_[ringIndex(weakest)];
    removeIf(weakest + 1, [dropped](const HeldKey& key) { return &key == dropped; });
    return true;
}

void EventSorter::release(std::int64_t beforeNs, std::vector<CollisionEvent>& finished) {
    const std::size_t total = earliestNewNs_ < beforeNs ? count_ : oldCount_; // none of the new ones is
                                                                              // released
    // A bucket sort by time, with as many buckets as events: grains arrive by hundreds per step, evenly
    // distributed, so each bucket has few.
    std::int64_t toNs = beforeNs;
    if (beforeNs == std::numeric_limits<std::int64_t>::max()) { // all
        toNs = releasedNs_;
        for (std::size_t i = 0; i < total; ++i) toNs = std::max(toNs, keys_[ringIndex(i)].timeNs);
    }
    const std::int64_t fromNs = std::exchange(releasedNs_, toNs);
    const double bucketsPerNs =
        static_cast<double>(total) / std::max(1.0, static_cast<double>(toNs - fromNs));
    bucketEnds_.assign(total + 2, 0);
    std::size_t end = 0;
    ReleaseOrder *const orders = order_.data(), *nextOrder = orders;
    std::uint32_t *const bucketOf = buckets_.data(), *const ends = bucketEnds_.data(), *nextBucket = bucketOf;
    const HeldKey* const keys = keys_.data();
    for (std::size_t i = 0, mask = mask_, first = first_; i < total; ++i) {
        const HeldKey& key = keys[(first + i) & mask];
        if (key.timeNs >= beforeNs) continue;
        const auto fixture = static_cast<std::uint32_t>(key.fixture) ^ 0x80000000U; // in order as unsigned
        *nextOrder++ = {key.timeNs, static_cast<std::uint64_t>(fixture) << 32U | i};
        const auto bucket =
            static_cast<std::int64_t>(static_cast<double>(key.timeNs - fromNs) * bucketsPerNs);
        *nextBucket++ = static_cast<std::uint32_t>(std::max<std::int64_t>(0, bucket));
        ++ends[nextBucket[-1] + 1];
        end = i + 1;
    }
    const auto count = static_cast<std::size_t>(nextOrder - orders);
    if (count > 0) {
        for (std::size_t i = 1; i < bucketEnds_.size(); ++i) ends[i] += ends[i - 1];
        ReleaseOrder* const sorted = sorted_.data();
        for (std::size_t i = 0; i < count; ++i)
            sorted[ends[bucketOf[i]]++] = orders[i]; // each bucket's begin advances to its end
        order_.swap(sorted_);
        sort(count);
        if (finished.capacity() - finished.size() < count)
            finished.reserve(std::max(finished.size() + count, 2 * finished.capacity()));
        const CollisionEvent* const held = heldEvents_.data();
        const std::size_t first = first_, mask = mask_;
        for (const ReleaseOrder& entry : std::span{order_.data(), count})
            finished.push_back(held[(first + (entry.rank & 0xFFFFFFFFU)) & mask]);
        if (count < end) {
            removeIf(end, [beforeNs](const HeldKey& key) { return key.timeNs < beforeNs; });
        } else {
            first_ = ringIndex(count);
            count_ -= count;
        }
    }
    oldCount_ = count_;
    earliestNewNs_ = std::numeric_limits<std::int64_t>::max();
}

// Insertion sort, which needs few moves after the bucket sort. Where most events have the same time, as hits
// at the start of a step, it would need too many and leaves the work to std::sort.
void EventSorter::sort(std::size_t count) noexcept {
    std::size_t steps = 128 + 8 * count;
    ReleaseOrder* const orders = order_.data();
    for (std::size_t i = 1; i < count; ++i) {
        if (!(orders[i] < orders[i - 1])) continue;
        const ReleaseOrder moved = orders[i];
        std::size_t hole = i;
        do {
            orders[hole] = orders[hole - 1];
            --hole;
        } while (hole > 0 && moved < orders[hole - 1]);
        orders[hole] = moved;
        if (i - hole > steps) return std::sort(orders, orders + count);
        steps -= i - hole;
    }
}

void EventSorter::removeEventsOf(std::int32_t fixture, bool dropsCaused) noexcept {
    removeIf(count_, [=](const HeldKey& key) {
        return key.fixture == fixture || (dropsCaused && key.other == fixture);
    });
}

} // namespace physvib
