// SPDX-License-Identifier: MIT
// From what others tell to what the stages want to know.
#include "Contacts/ContactFeed.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace physvib {

namespace {

constexpr std::string_view unknownBody = "body: expected one that has been told";
constexpr std::string_view outsideStep = "step: expected to be within one";
constexpr std::string_view withinStep = "step: expected not to be within one";

bool isFinite(Vector2 v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y); }

// not NaN
bool isWithin(double value, double least, double most) noexcept { return value >= least && value <= most; }

bool isUnit(Vector2 v) noexcept { return std::abs(v.length() - 1.0F) < 0.01F; } // not NaN; engines round

const ImpactSettings& onsetAlone(const ImpactSettings& settings) {
    if (settings.timing != ImpactTiming::onset)
        throw std::invalid_argument("timing: expected onset: others' contacts are not told to their end");
    return settings;
}

} // namespace

ContactFeed::ContactFeed(const ImpactSettings& settings)
    : events_(bodies_, onsetAlone(settings)) {}

void ContactFeed::configure(const ImpactSettings& settings) { events_.configure(onsetAlone(settings)); }

std::string_view ContactFeed::set(std::int32_t id, const FedBody& body, const HapticFixture& values) {
    if (id < 0) return "body: expected a number from 0 on";
    if (const std::string_view fault = physvib::faultOf(body); !fault.empty()) return fault;
    if (const std::string_view fault = physvib::faultOf(values); !fault.empty()) return fault;
    bodies_.set(id, body);
    return events_.set(FedBodies::nameOf(id), bodies_.facts(FedBodies::nameOf(id)), {}, values, id).refusal;
}

std::string_view ContactFeed::move(std::int32_t id, Vector2 centre, const BodyMotion& motion) {
    if (!bodies_.has(id)) return unknownBody;
    if (!isFinite(centre)) return "place: expected numbers";
    if (!isFinite(motion.metresPerSecond) || !std::isfinite(motion.radiansPerSecond))
        return "velocity: expected numbers";
    bodies_.move(id, centre, motion);
    return {};
}

std::string_view ContactFeed::moved(std::int32_t id, const BodyMotion& motion) {
    if (!bodies_.has(id)) return unknownBody;
    if (!events_.catcher().isStepping()) return outsideStep;
    if (!isFinite(motion.metresPerSecond) || !std::isfinite(motion.radiansPerSecond))
        return "velocity: expected numbers";
    bodies_.moveAfter(id, motion);
    return {};
}

std::string_view ContactFeed::remove(std::int32_t id) {
    if (!bodies_.has(id)) return unknownBody;
    if (events_.catcher().isStepping()) return withinStep;
    const std::int32_t slot = slotOf(id);
    dropAllOf(slot);
    events_.vanish(slot);
    bodies_.remove(id);
    return {};
}

std::string_view ContactFeed::beginStep(std::int64_t endNs, double gravityMetresPerSecond2) {
    if (events_.catcher().isStepping()) return withinStep;
    if (endNs < timeNs() || endNs > limits::maxTimeNs)
        return "time: expected not to go back, and less than 10^17 ns";
    if (!isWithin(gravityMetresPerSecond2, 0.0, 1.0e6)) return "gravity: expected 0 to 10^6 m/s^2";
    lastStepSeconds_ = events_.stepSeconds();
    gravity_ = gravityMetresPerSecond2;
    events_.beginStep(endNs, {0.0F, -static_cast<float>(gravityMetresPerSecond2)}, bodies_.largestMassKg());
    return {};
}

std::string_view ContactFeed::faultOf(const FedContact& contact) {
    constexpr double most = 1.0e12;
    if (!events_.catcher().isStepping()) return outsideStep;
    if (!bodies_.has(contact.a) || !bodies_.has(contact.b)) return unknownBody;
    if (contact.a == contact.b) return "bodies: expected two";
    if (!isFinite(contact.point)) return "point: expected numbers";
    if (!isUnit(contact.normal)) return "normal: expected a length of 1";
    if (!isWithin(contact.impulseNewtonSeconds.value_or(0.0), -most, most) ||
        !isWithin(contact.tangentialNewtonSeconds, -most, most))
        return "impulse: expected a number of N s";
    if (!isWithin(contact.approachMetresPerSecond.value_or(0.0), -most, most))
        return "approach: expected a number of m/s";
    if (!isWithin(contact.restitution, 0.0, 1.0)) return "restitution: expected 0 to 1";
    if (!isWithin(contact.effectiveMassKg.value_or(0.0), 0.0, most))
        return "effective mass: expected 0 to 10^12 kg";
    if (!isWithin(contact.fraction.value_or(0.0), -1.0, 1.0)) return "fraction: expected -1 to 1";
    if (!std::isfinite(contact.gapMetres)) return "gap: expected a number of metres";
    if (!isWithin(contact.gapFraction, 0.0, 1.0)) return "fraction of the gap: expected 0 to 1";
    for (const auto& along : {contact.alongAMetresPerSecond, contact.alongBMetresPerSecond})
        if (!isWithin(along.value_or(0.0), -most, most))
            return "speed along a surface: expected a number of m/s";
    if (contact.pointId < FedPoints::byPlace)
        return "point: expected a number from 0 on, -1 (none) or -2 (by place)";
    if (contact.isImpulseOfPair && !contact.impulseNewtonSeconds)
        return "impulse: expected one, as it is said to be the pair's";
    return {};
}

std::string_view ContactFeed::touch(const FedContact& contact) {
    if (const std::string_view fault = faultOf(contact); !fault.empty()) return fault;
    Pair& pair = know(contact, true);
    pair.isNamed = true;
    const bool isNewPoint = this->isNewPoint(pair, contact);
    if (isNewPoint && !pair.isNew) events_.catcher().meet(pair.a, pair.b);
    tell(pair, contact, pair.isNew || isNewPoint);
    return {};
}

std::string_view ContactFeed::begin(const FedContact& contact) {
    if (const std::string_view fault = faultOf(contact); !fault.empty()) return fault;
    Pair& pair = know(contact, false);
    isNewPoint(pair, contact); // from now on it is old
    tell(pair, contact, true);
    return {};
}

std::string_view ContactFeed::push(const FedContact& contact) {
    if (const std::string_view fault = faultOf(contact); !fault.empty()) return fault;
    Pair& pair = know(contact, false); // perhaps one that was there before anybody told
    const bool isNewPoint = this->isNewPoint(pair, contact) && !pair.isNew;
    if (isNewPoint) events_.catcher().meet(pair.a, pair.b);
    tell(pair, contact, isNewPoint);
    return {};
}

std::string_view ContactFeed::end(std::int32_t a, std::int32_t b) {
    if (!bodies_.has(a) || !bodies_.has(b) || a == b) return unknownBody;
    const std::int32_t pair = pairOf_.find(pairKey(slotOf(a), slotOf(b)));
    if (pair == IntegerMap::none) return "contact: expected one that has begun";
    if (pairs_[static_cast<std::size_t>(pair)].waiting != FedPoints::none) { // it has begun in this step
        momentum_.solve();
        settle(pairs_[static_cast<std::size_t>(pair)]);
    }
    drop(static_cast<std::size_t>(pair));
    return {};
}

std::string_view ContactFeed::endStep() {
    if (!events_.catcher().isStepping()) return outsideStep;
    settleTogether();
    for (std::size_t i = pairs_.size(); i-- > 0;) {
        Pair& pair = pairs_[i];
        if (pair.isAsked && !pair.isNamed) {
            drop(i);
            continue;
        }
        pair.isNew = pair.isNamed = false;
        pair.points = {.before = pair.points.now};
        pair.waiting = FedPoints::none;
    }
    points_.endStep();
    waiting_.clear();
    bodies_.endStep();
    rubs_.endStep(events_.stepSeconds(), events_.lasting());
    events_.endStep();
    return {};
}

TouchingPairs::Name ContactFeed::nameOf(const FedContact& contact) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    return {a, b, events_.catcher().know(a, b)};
}

ContactFeed::Pair& ContactFeed::know(const FedContact& contact, bool isAsked) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    if (const std::int32_t known = pairOf_.find(pairKey(a, b)); known != IntegerMap::none)
        return pairs_[static_cast<std::size_t>(known)];
    pairOf_.set(pairKey(a, b), static_cast<std::int32_t>(pairs_.size()));
    pairs_.push_back({std::min(a, b), std::max(a, b), isAsked, true, false});
    events_.catcher().begin(a, b);
    return pairs_.back();
}

// Where a contact lay when it ended matters to the other timing only.
void ContactFeed::drop(std::size_t pair) {
    Pair& hole = pairs_[pair];
    events_.catcher().end(hole.a, hole.b);
    pairOf_.erase(pairKey(hole.a, hole.b));
    if (&hole != &pairs_.back()) {
        hole = pairs_.back();
        pairOf_.set(pairKey(hole.a, hole.b), static_cast<std::int32_t>(pair));
    }
    pairs_.pop_back();
}

void ContactFeed::dropAllOf(std::int32_t slot) {
    for (std::size_t i = pairs_.size(); i-- > 0;)
        if (pairs_[i].a == slot || pairs_[i].b == slot) drop(i);
    rubs_.forget(slot);
}

// Points are followed even while nobody feels: who comes later must not take an old one for a new one.
bool ContactFeed::isNewPoint(Pair& pair, const FedContact& contact) {
    if (contact.pointId == FedPoints::none) return false;
    constexpr double trembleMetres = 0.002;
    const double slide =
        bodies_.slide(contact.a, contact.b, contact.point, contact.normal) * events_.stepSeconds();
    return points_.isNew(pair.points, contact.pointId, contact.point, contact.normal,
                         trembleMetres + 1.5 * slide) &&
           // by an impulse alone nobody can tell a blow from a load that shifts
           (pair.isNew || speedOf(contact) > 0.0);
}

void ContactFeed::tell(Pair& pair, const FedContact& contact, bool isNew) {
    if (!events_.catcher().isHearing()) return;
    if (waits(contact)) {
        const bool isByMomentum = this->isByMomentum(contact);
        const auto momentum = isByMomentum
                                  ? static_cast<std::int32_t>(momentum_.add(bodies_, contact.a, contact.b,
                                                                            contact.point, contact.normal))
                                  : FedPoints::none;
        waiting_.push_back({contact, isNew, pair.waiting, momentum});
        pair.waiting = static_cast<std::int32_t>(waiting_.size()) - 1;
        if (isNew || contact.isImpulseOfPair || isByMomentum) return;
    }
    if (isNew)
        strike(contact);
    else
        load(contact);
}

void ContactFeed::settleTogether() {
    if (waiting_.empty()) return;
    momentum_.solve();
    for (const Pair& pair : pairs_)
        if (pair.waiting != FedPoints::none) settle(pair);
    momentum_.clear();
}

FedContact ContactFeed::withMomentum(const Waiting& each) const {
    FedContact contact = each.contact;
    if (each.momentum == FedPoints::none) return contact;
    contact.impulseNewtonSeconds = momentum_.newtonSeconds(static_cast<std::size_t>(each.momentum));
    contact.tangentialNewtonSeconds = 0.0;
    return contact;
}

double ContactFeed::pushed(const Waiting& each) const {
    const FedContact& contact = each.contact;
    if (!contact.isSoft) return 0.0;
    const double told = contact.isPushWhole ? contact.impulseNewtonSeconds.value_or(0.0) : 0.0;
    return each.momentum == FedPoints::none
               ? told
               : std::max(told, momentum_.newtonSeconds(static_cast<std::size_t>(each.momentum)));
}

// What is struck may stand on something, hang in joints or carry others: then the engine pushes more in one
// step than the speed and the mass of the two bodies say. What gravity adds after they met is a load.
double ContactFeed::supported(double bySpeed, double pushed, double gainedMetresPerSecond,
                              double fraction) const {
    constexpr double clearly = 1.2; // pushes of one step also move overlaps apart
    const double falls = gravity_ * events_.stepSeconds() * (1.0 - std::clamp(fraction, 0.0, 1.0));
    const double ofBlow = pushed * gainedMetresPerSecond / (gainedMetresPerSecond + falls);
    return ofBlow > clearly * bySpeed ? ofBlow : bySpeed;
}

// The blow of a pair that is no spring is what its new points have changed.
void ContactFeed::strikeByMomentum() {
    meeting_.clear();
    for (const Waiting* each : together_) {
        const double newtonSeconds =
            each->isNew ? momentum_.newtonSeconds(static_cast<std::size_t>(each->momentum)) : 0.0;
        meeting_.push_back({each->contact.point, each->contact.normal, speedOf(each->contact), 0.0,
                            each->isNew, newtonSeconds});
    }
    strikeTogether();
}

void ContactFeed::settle(const Pair& pair) {
    together_.clear();
    for (std::int32_t at = pair.waiting; at != FedPoints::none;
         at = waiting_[static_cast<std::size_t>(at)].next)
        // who tells may tell of one point twice
        if (const Waiting& each = waiting_[static_cast<std::size_t>(at)]; each.isNew || pair.isAsked)
            together_.push_back(&each);
    if (together_.empty()) return;
    std::reverse(together_.begin(), together_.end());
    const FedContact& first = together_.front()->contact;
    const auto hasMass = [](const Waiting* each) { return each->contact.effectiveMassKg.has_value(); };
    const auto isNew = [](const Waiting* each) { return each->isNew; };
    const bool isByMomentum =
        std::ranges::all_of(together_, [](const Waiting* each) { return each->momentum != FedPoints::none; });
    for (const Waiting* each : together_)
        if (isByMomentum && !each->isNew) load(withMomentum(*each));
    if (isByMomentum && !first.isSoft && std::ranges::any_of(together_, isNew)) return strikeByMomentum();
    if (std::ranges::none_of(together_, isNew)) { // the others have been loaded where they were told
        if (first.isImpulseOfPair) load(first);
        return;
    }
    if (together_.size() == 1 || std::ranges::any_of(together_, hasMass)) {
        for (const Waiting* each : together_)
            if (each->isNew) strike(withMomentum(*each), hasMass(each) ? 0.0 : pushed(*each));
        return;
    }
    meeting_.clear();
    for (const Waiting* each : together_) {
        const FedContact& contact = each->contact;
        const bool isTurned = contact.a != first.a;
        meeting_.push_back({contact.point, isTurned ? -contact.normal : contact.normal, speedOf(contact),
                            contact.restitution, each->isNew});
    }
    solve(bodies_, first.a, first.b, meeting_);
    strikeTogether();
}

// A blow at several points: where and how hard is what they do together, when is when the first of them
// meets.
void ContactFeed::strikeTogether() {
    CollisionCatcher& catcher = events_.catcher();
    const FedContact& first = together_.front()->contact;
    const TouchingPairs::Name pair = nameOf(first);
    double all = 0.0, ofNew = 0.0, fastest = 0.0, fraction = 1.0, ofPush = 0.0;
    Vector2 point;
    for (std::size_t i = 0; i < meeting_.size(); ++i) {
        const MeetingPoint& each = meeting_[i];
        all += each.newtonSeconds;
        if (each.isNew) ofPush += pushed(*together_[i]);
        if (!each.isNew || !(each.newtonSeconds > 0.0)) continue;
        ofNew += each.newtonSeconds;
        point += static_cast<float>(each.newtonSeconds / ofNew) * (each.point - point);
        fastest = std::max(fastest, each.approach);
        fraction = std::min(fraction, fractionOf(together_[i]->contact, each.approach));
    }
    const float gravityScale =
        std::max(events_.fixtures()[pair.a].gravityScale(), events_.fixtures()[pair.b].gravityScale());
    const double share = all > 0.0 ? ofNew / all : 0.0;
    if (ofPush > 0.0 && fastest > 0.0)
        ofNew = supported(ofNew, ofPush, (1.0 + first.restitution) * fastest, fraction);
    const double impulse = first.isImpulseOfPair ? share * *first.impulseNewtonSeconds : ofNew;
    const bool isBlow = impulse > 0.0 && std::isfinite(impulse) && catcher.isBlow(gravityScale, fastest);
    if (!isBlow) catcher.passOver(pair.a, pair.b);
    if (!isBlow && first.isImpulseOfPair) return load(first);
    if (!isBlow) {
        for (const Waiting* each : together_)
            if (each->isNew && (each->contact.isSoft || speedOf(each->contact) > 0.0))
                load(withMomentum(*each));
        return;
    }
    Blow* blow = catcher.blow(pair);
    const bool isFirst = blow == nullptr;
    if (isFirst && (blow = catcher.strike(pair, fastest)) == nullptr) return;
    const double sum = blow->normalImpulse + impulse;
    blow->fraction = isFirst ? fraction : std::min(blow->fraction, fraction);
    blow->point += static_cast<float>(impulse / sum) * (point - blow->point);
    blow->normalImpulse = sum;
    if (!first.isImpulseOfPair) return;
    blow->tangentialImpulse += share * first.tangentialNewtonSeconds;
    FedContact rest = first; // what old points push goes on as a load
    rest.impulseNewtonSeconds = (1.0 - share) * *first.impulseNewtonSeconds;
    rest.tangentialNewtonSeconds = (1.0 - share) * first.tangentialNewtonSeconds;
    if (share < 1.0) load(rest);
}

double ContactFeed::speedOf(const FedContact& contact) const {
    return contact.approachMetresPerSecond.value_or(
        bodies_.approach(contact.a, contact.b, contact.point, contact.normal));
}

void ContactFeed::strike(const FedContact& contact, double pushed) {
    CollisionCatcher& catcher = events_.catcher();
    const TouchingPairs::Name pair = nameOf(contact);
    const KnownFixture &a = events_.fixtures()[pair.a], &b = events_.fixtures()[pair.b];
    const double told = speedOf(contact);
    const double mass = contact.effectiveMassKg.value_or(
        bodies_.effectiveMassKg(contact.a, contact.b, contact.point, contact.normal));
    const bool isImpulseTold = contact.impulseNewtonSeconds && !contact.isSoft;
    double impulse = isImpulseTold ? *contact.impulseNewtonSeconds
                                   : mass * std::max(0.0, told) * (1.0 + contact.restitution);
    if (pushed > 0.0 && told > 0.0)
        impulse = supported(impulse, pushed, told * (1.0 + contact.restitution), fractionOf(contact, told));
    if (!(impulse > 0.0 && std::isfinite(impulse))) { // they part, or cannot be moved
        catcher.passOver(pair.a, pair.b);
        return contact.isSoft ? load(contact) : void();
    }
    // Of an impulse alone: what it changes of the lighter body's velocity, which is at least the speed before
    // it.
    const bool isSpeedKnown = contact.approachMetresPerSecond || !isImpulseTold || told > 0.0;
    const double speed = isSpeedKnown ? told : impulse / std::min(a.movableMassKg(), b.movableMassKg());
    if (!catcher.isBlow(std::max(a.gravityScale(), b.gravityScale()), speed)) {
        catcher.passOver(pair.a, pair.b);
        return load(contact);
    }

    Blow* blow = catcher.blow(pair);
    const bool isFirst = blow == nullptr;
    if (isFirst && (blow = catcher.strike(pair, speed)) == nullptr) return;
    const double fraction = fractionOf(contact, isSpeedKnown ? speed : 0.0);
    blow->fraction = isFirst ? fraction : std::min(blow->fraction, fraction);
    if (isImpulseTold || isFirst) { // points push together; a speed tells of the whole blow
        const double sum = blow->normalImpulse + impulse;
        blow->point += static_cast<float>(impulse / sum) * (contact.point - blow->point);
        blow->normalImpulse = sum;
        blow->tangentialImpulse += isImpulseTold ? contact.tangentialNewtonSeconds : 0.0;
    } else if (impulse > blow->normalImpulse) {
        blow->normalImpulse = impulse;
        blow->point = contact.point;
    }
}

void ContactFeed::load(const FedContact& contact) {
    if (!contact.impulseNewtonSeconds || !events_.catcher().isHearing()) return;
    const TouchingPairs::Name pair = nameOf(contact);
    rub(contact, pair);
    if (!events_.catcher().isHeard(pair)) return;
    const auto along = static_cast<float>(*contact.impulseNewtonSeconds),
               across = static_cast<float>(contact.tangentialNewtonSeconds);
    events_.catcher().push(pair, along * contact.normal + across * contact.normal.turnedLeft(),
                           contact.point);
}

void ContactFeed::rub(const FedContact& contact, const TouchingPairs::Name& pair) {
    if (!contact.alongAMetresPerSecond || !contact.alongBMetresPerSecond ||
        !events_.lasting().isHeard(pair.a, pair.b))
        return;
    rubs_.tell({pair.a, pair.b, *contact.impulseNewtonSeconds, contact.point, *contact.alongAMetresPerSecond,
                *contact.alongBMetresPerSecond});
}

// Surfaces close a gap, or have closed it, at the speed at which they meet.
double ContactFeed::fractionOf(const FedContact& contact, double approachMetresPerSecond) const noexcept {
    if (contact.fraction) return *contact.fraction;
    const double ahead = approachMetresPerSecond > 0.0 ? contact.gapMetres / approachMetresPerSecond : 0.0;
    const double now = events_.stepSeconds();
    const double seconds = contact.gapFraction * now + ahead;
    const double length = seconds < 0.0 ? lastStepSeconds_ : now;
    return length > 0.0 ? std::clamp(seconds / length, -1.0, 1.0) : 0.0;
}

} // namespace physvib
