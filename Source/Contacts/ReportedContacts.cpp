// SPDX-License-Identifier: MIT
// Pairs in contact, from their first report to their end: what is new is a collision, the rest is load.
#include "Contacts/ReportedContacts.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace physvib {
ReportedContacts::ReportedContacts(const ImpactSettings& settings)
    : events_(bodies_, settings) {}

void ReportedContacts::beginStep(std::int64_t endNs, double gravityMetresPerSecond2) {
    lastStepSeconds_ = events_.stepSeconds();
    gravity_ = gravityMetresPerSecond2;
    events_.beginStep(endNs, {0.0F, -static_cast<float>(gravityMetresPerSecond2)}, bodies_.largestMassKg());
}

void ReportedContacts::remove(std::int32_t id) {
    const std::int32_t slot = slotOf(id);
    dropAllOf(slot);
    events_.vanish(slot);
    bodies_.remove(id);
}

void ReportedContacts::touch(const FedContact& contact) {
    Pair& pair = know(contact, true);
    pair.isNamed = true;
    const bool isNewPoint = this->isNewPoint(pair, contact);
    tell(pair, contact, pair.isNew || isNewPoint, isNewPoint);
}

void ReportedContacts::begin(const FedContact& contact) {
    Pair& pair = know(contact, false);
    isNewPoint(pair, contact); // the next step knows this point
    tell(pair, contact, true, false);
}

void ReportedContacts::push(const FedContact& contact) {
    Pair& pair = know(contact, false); // it may have touched before the first report
    const bool isNewPoint = this->isNewPoint(pair, contact) && !pair.isNew;
    tell(pair, contact, isNewPoint, isNewPoint);
}

bool ReportedContacts::end(std::int32_t a, std::int32_t b) {
    const std::int32_t pair = pairOf_.find(pairKey(slotOf(a), slotOf(b)));
    if (pair == IntegerMap::none) return false;
    // reported in this step, and not solved yet
    if (pairs_[static_cast<std::size_t>(pair)].waiting != FedPoints::none) {
        momentum_.solve();
        settle(pairs_[static_cast<std::size_t>(pair)]);
    }
    drop(static_cast<std::size_t>(pair));
    return true;
}

void ReportedContacts::endStep() {
    settleTogether();
    for (std::size_t i = pairs_.size(); i-- > 0;) {
        Pair& pair = pairs_[i];
        if (pair.isAsked && !pair.isNamed) {
            drop(i);
            continue;
        }
        pair.isNew = pair.isNamed = false;
        // Engines need a few steps to end an impact.
        pair.lastApproach = std::max(std::exchange(pair.approach, 0.0), 0.5 * pair.lastApproach);
        pair.lastLoad = std::exchange(pair.load, 0.0);
        pair.points = {.before = pair.points.now};
        pair.waiting = FedPoints::none;
    }
    points_.endStep();
    waiting_.clear();
    bodies_.endStep();
    rubs_.endStep(events_.stepSeconds(), events_.lasting());
    events_.endStep();
}

ReportedContacts::Pair& ReportedContacts::know(const FedContact& contact, bool isAsked) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    if (const std::int32_t known = pairOf_.find(pairKey(a, b)); known != IntegerMap::none)
        return pairs_[static_cast<std::size_t>(known)];
    pairOf_.set(pairKey(a, b), static_cast<std::int32_t>(pairs_.size()));
    pairs_.push_back({std::min(a, b), std::max(a, b), isAsked, true, false});
    events_.catcher().begin(a, b);
    return pairs_.back();
}

// The place of a contact at its end is only needed for release timing, which feeds do not have.
void ReportedContacts::drop(std::size_t pair) {
    Pair& hole = pairs_[pair];
    events_.catcher().end(hole.a, hole.b);
    pairOf_.erase(pairKey(hole.a, hole.b));
    if (&hole != &pairs_.back()) {
        hole = pairs_.back();
        pairOf_.set(pairKey(hole.a, hole.b), static_cast<std::int32_t>(pair));
    }
    pairs_.pop_back();
}

void ReportedContacts::dropAllOf(std::int32_t slot) {
    for (std::size_t i = pairs_.size(); i-- > 0;)
        if (pairs_[i].a == slot || pairs_[i].b == slot) drop(i);
    rubs_.forget(slot);
}

// Points are followed even without haptic sources: a source that is added later must not take an old point
// for a new one.
bool ReportedContacts::isNewPoint(Pair& pair, const FedContact& contact) {
    if (contact.pointId == FedContact::noPoint) return false;
    constexpr double trembleMetres = 0.002;
    const double slide =
        bodies_.slide(contact.a, contact.b, contact.point, contact.normal) * events_.stepSeconds();
    return points_.isNew(pair.points, contact.pointId, contact.point, contact.normal,
                         trembleMetres + 1.5 * slide) &&
           // an impulse alone does not tell an impact from a load that shifts
           (pair.isNew || speedOf(contact) > 0.0);
}

// A flipper under a resting ball, a platform that jerks: what touches is struck without having parted, faster
// than gravity explains. In its first step, since what drives it may push on, unless that was a small part,
// as where an engine passes an impact on over several; what still has to come there is no kick yet. Ground
// gives back no second impact.
bool ReportedContacts::isKick(Pair& pair, const FedContact& contact, bool isNew) {
    if (contact.impulseNewtonSeconds && !contact.isSoft)
        pair.load = contact.isImpulseOfPair ? *contact.impulseNewtonSeconds
                                            : pair.load + std::max(0.0, *contact.impulseNewtonSeconds);
    const double speed = speedOf(contact), seconds = events_.stepSeconds();
    if (!(speed > 0.0) || (!isNew && contact.gapMetres > speed * seconds)) return false;
    constexpr double clearly = 2.5; // no elevator that starts, no rest of an impact before
    const double beyond =
        speed - gravity_ * seconds * static_cast<double>(std::abs(gravityScaleOf(pair.a, pair.b)));
    if (!isImpact(pair.a, pair.b, beyond / clearly)) return false;
    pair.approach = std::max(pair.approach, speed);
    return !isNew && speed > 2.0 * pair.lastApproach && !isHeldUp(contact.a, contact.b) &&
           !isHeldUp(contact.b, contact.a);
}

// An engine that solves each contact once lets what was struck reach the ground a step later.
bool ReportedContacts::isHeldUp(std::int32_t struck, std::int32_t ground) {
    return bodies_.stands(ground) && !events_.fixtures().isCamera(slotOf(ground)) &&
           events_.catcher().wasStruck(slotOf(struck));
}

// Subtracts the impulse that the pair transmitted in the step before.
FedContact ReportedContacts::beyondLoad(Pair& pair, FedContact contact) {
    if (!contact.impulseNewtonSeconds || contact.isSoft) return contact;
    const double load = std::min(pair.lastLoad, std::max(0.0, *contact.impulseNewtonSeconds));
    *contact.impulseNewtonSeconds -= load;
    if (!contact.isImpulseOfPair) pair.lastLoad -= load; // several points share it
    return contact;
}

void ReportedContacts::tell(Pair& pair, const FedContact& contact, bool isNew, bool isNewPoint) {
    if (!events_.catcher().hasSources()) {
        if (isNewPoint && !pair.isNew) events_.catcher().meet(pair.a, pair.b);
        return;
    }
    const bool isKick = this->isKick(pair, contact, isNew);
    if ((isNewPoint || isKick) && !pair.isNew) events_.catcher().meet(pair.a, pair.b);
    if (waits(contact)) {
        const bool isByMomentum = this->isByMomentum(contact);
        const auto momentum = isByMomentum
                                  ? static_cast<std::int32_t>(momentum_.add(bodies_, contact.a, contact.b,
                                                                            contact.point, contact.normal))
                                  : FedPoints::none;
        waiting_.push_back({contact, isNew || isKick, isKick, pair.waiting, momentum});
        pair.waiting = static_cast<std::int32_t>(waiting_.size()) - 1;
        if (isNew || isKick || contact.isImpulseOfPair || isByMomentum) return;
    }
    if (isNew)
        strike(contact);
    else if (isKick)
        strike(beyondLoad(pair, contact));
    else
        load(contact);
}

// Impacts of single points: impulse and time of each. A point without an impact is a load of its pair.

// A struck body may stand on something, hang in joints or carry others. Then the engine's impulse of the step
// is larger than speed and mass of the two bodies say. What gravity adds after they met is a load. Where it
// is smaller, and little is left to later steps, as over an edge, so was the impact.
double ReportedContacts::supported(double bySpeed, Push push, double gainedMetresPerSecond,
                                   double fraction) const {
    constexpr double clearly = 1.2; // the impulse of a step also moves overlaps apart
    const double falls = gravity_ * events_.stepSeconds() * (1.0 - std::clamp(fraction, 0.0, 1.0));
    const double ofCollision = push.first * gainedMetresPerSecond / (gainedMetresPerSecond + falls);
    if (ofCollision > clearly * bySpeed) return ofCollision;
    return bySpeed > clearly * push.second ? push.second : bySpeed;
}

float ReportedContacts::gravityScaleOf(std::int32_t a, std::int32_t b) const {
    return std::max(events_.fixtures()[a].gravityScale(), events_.fixtures()[b].gravityScale());
}

bool ReportedContacts::isImpact(std::int32_t a, std::int32_t b, double metresPerSecond) {
    return events_.catcher().isCollision(gravityScaleOf(a, b), metresPerSecond);
}

double ReportedContacts::speedOf(const FedContact& contact) const {
    return contact.approachMetresPerSecond.value_or(
        bodies_.approach(contact.a, contact.b, contact.point, contact.normal));
}

// Only counts. A threshold is passed if two thirds of it are approached and all of it is the change of the
// lighter body's velocity. Surfaces that part no faster than resting bodies do are at rest.
void ReportedContacts::passOver(const TouchingPairs::Name& pair, const FedContact& contact, double speed,
                                double impulse) {
    CollisionCatcher& catcher = events_.catcher();
    const KnownFixture &a = events_.fixtures()[pair.a], &b = events_.fixtures()[pair.b];
    const double lighter = std::min(a.movableMassKg(), b.movableMassKg());
    const double change = std::isfinite(impulse) ? impulse / lighter : 0.0;
    catcher.passOver(pair.a, pair.b, std::max(0.0, std::min(1.5 * speed, change)));
    if (!std::isfinite(lighter) || !catcher.touchesSource(pair.a, pair.b)) return;
    ContactCounts& tally = catcher.tally();
    if (isImpact(pair.a, pair.b, -speed)) {
        ++tally.parting;
        tally.fastestParting = std::max(tally.fastestParting, -speed);
    } else if (speed == 0.0 && !contact.approachMetresPerSecond && !(impulse > 0.0)) {
        ++tally.motionless;
    }
}

void ReportedContacts::strike(const FedContact& contact, Push push) {
    CollisionCatcher& catcher = events_.catcher();
    const TouchingPairs::Name pair = nameOf(contact);
    const KnownFixture &a = events_.fixtures()[pair.a], &b = events_.fixtures()[pair.b];
    const double told = speedOf(contact);
    const double mass = contact.effectiveMassKg.value_or(
        bodies_.effectiveMassKg(contact.a, contact.b, contact.point, contact.normal, dragOf(contact)));
    const bool isImpulseTold = contact.impulseNewtonSeconds && !contact.isSoft;
    double impulse = isImpulseTold ? *contact.impulseNewtonSeconds
                                   : mass * std::max(0.0, told) * (1.0 + contact.restitution);
    if (told > 0.0)
        impulse = supported(impulse, push, told * (1.0 + contact.restitution), fractionOf(contact, told));
    if (!(impulse > 0.0 && std::isfinite(impulse))) { // they separate, or neither can be moved
        passOver(pair, contact, told, 0.0);
        return contact.isSoft ? load(contact) : void();
    }
    // With an impulse alone, the speed is the change of the lighter body's velocity, which is at least the
    // speed before.
    const bool isSpeedKnown = contact.approachMetresPerSecond || !isImpulseTold || told > 0.0;
    const double speed = isSpeedKnown ? told : impulse / std::min(a.movableMassKg(), b.movableMassKg());
    if (!isImpact(pair.a, pair.b, speed)) {
        passOver(pair, contact, speed, impulse);
        return load(contact);
    }

    Collision* collision = catcher.collision(pair);
    const bool isFirst = collision == nullptr;
    if (isFirst && (collision = catcher.strike(pair, speed)) == nullptr) return;
    const double fraction = fractionOf(contact, isSpeedKnown ? speed : 0.0);
    collision->fraction = isFirst ? fraction : std::min(collision->fraction, fraction);
    if (isImpulseTold || isFirst) { // impulses of points add up; a speed gives that of the whole impact
        const double sum = collision->normalImpulse + impulse;
        collision->point += static_cast<float>(impulse / sum) * (contact.point - collision->point);
        collision->normalImpulse = sum;
        collision->tangentialImpulse += isImpulseTold ? contact.tangentialNewtonSeconds : 0.0;
        if (isImpulseTold) addFriction(*collision, contact, pair.a, 1.0F);
    } else if (impulse > collision->normalImpulse) {
        collision->normalImpulse = impulse;
        collision->point = contact.point;
    }
}

// A contact may name its bodies in the other order than the collision does.
void ReportedContacts::addFriction(Collision& collision, const FedContact& contact, std::int32_t a,
                                   float share) noexcept {
    collision.frictionNewtonSeconds += (collision.a == a ? share : -share) * contact.frictionNewtonSeconds;
}

void ReportedContacts::load(const FedContact& contact) {
    if (!contact.impulseNewtonSeconds || !events_.catcher().hasSources()) return;
    const TouchingPairs::Name pair = nameOf(contact);
    rub(contact, pair);
    if (!events_.catcher().isRelevant(pair)) return;
    const auto along = static_cast<float>(*contact.impulseNewtonSeconds),
               across = static_cast<float>(contact.tangentialNewtonSeconds);
    const Vector3 inPlane = along * contact.normal + across * physvib::inPlane(contact.normal).turnedLeft();
    events_.catcher().push(pair, inPlane + contact.frictionNewtonSeconds, contact.point);
}

void ReportedContacts::rub(const FedContact& contact, const TouchingPairs::Name& pair) {
    if (!contact.alongAMetresPerSecond || !contact.alongBMetresPerSecond ||
        !events_.lasting().isRelevant(pair.a, pair.b))
        return;
    rubs_.tell({pair.a, pair.b, *contact.impulseNewtonSeconds, contact.point, *contact.alongAMetresPerSecond,
                *contact.alongBMetresPerSecond});
}

// The gap between the surfaces closes, or has closed, at the speed at which they approach.
double ReportedContacts::fractionOf(const FedContact& contact,
                                    double approachMetresPerSecond) const noexcept {
    if (contact.fraction) return *contact.fraction;
    const double ahead = approachMetresPerSecond > 0.0 ? contact.gapMetres / approachMetresPerSecond : 0.0;
    const double now = events_.stepSeconds();
    const double seconds = contact.gapFraction * now + ahead;
    const double length = seconds < 0.0 ? lastStepSeconds_ : now;
    return length > 0.0 ? std::clamp(seconds / length, -1.0, 1.0) : 0.0;
}

TouchingPairs::Name ReportedContacts::nameOf(const FedContact& contact) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    return {a, b, events_.catcher().know(a, b)};
}

void ReportedContacts::settleTogether() {
    if (waiting_.empty()) return;
    momentum_.solve();
    bool isAnyStruck = false;
    for (const Waiting& each : waiting_) {
        if (!each.isNew || each.momentum == FedPoints::none ||
            !isImpact(slotOf(each.contact.a), slotOf(each.contact.b), speedOf(each.contact)))
            continue;
        momentum_.strike(static_cast<std::size_t>(each.momentum));
        isAnyStruck = true;
    }
    if (isAnyStruck) momentum_.solveFriction(bodies_);
    for (Pair& pair : pairs_)
        if (pair.waiting != FedPoints::none) settle(pair);
    momentum_.clear();
}

FedContact ReportedContacts::withMomentum(const Waiting& each) const {
    FedContact contact = each.contact;
    if (each.momentum == FedPoints::none) return contact;
    contact.impulseNewtonSeconds = momentum_.newtonSeconds(static_cast<std::size_t>(each.momentum));
    contact.tangentialNewtonSeconds = 0.0;
    contact.frictionNewtonSeconds = momentum_.friction(static_cast<std::size_t>(each.momentum));
    return contact;
}

// The friction of a soft contact per N s along the normal, from the engine's own impulse; else 0.
Vector3 ReportedContacts::dragOf(const FedContact& of) const {
    const double along = of.impulseNewtonSeconds.value_or(0.0);
    if (!of.isSoft || !(along > 0.0)) return {};
    const Vector3 left = inPlane(of.normal).turnedLeft();
    const Vector3 friction = of.frictionNewtonSeconds + static_cast<float>(of.tangentialNewtonSeconds) * left;
    return bodies_.held(of.a, of.b, of.point, of.normal, static_cast<float>(1.0 / along) * friction);
}

ReportedContacts::Push ReportedContacts::pushed(const Waiting& each) const {
    const FedContact& of = each.contact;
    if (!of.isSoft) return anyPush;
    const double told = of.isPushWhole ? of.impulseNewtonSeconds.value_or(0.0) : 0.0;
    if (each.momentum == FedPoints::none) return {told, anyPush.second};
    const double pushed = std::max(told, momentum_.newtonSeconds(static_cast<std::size_t>(each.momentum)));
    const double gap = of.gapMetres > 0.0 ? of.gapMetres / events_.stepSeconds() : HUGE_VAL;
    const double after = bodies_.approach(of.a, of.b, of.point, of.normal, true);
    const double left = std::clamp(after, 0.0, gap), speed = speedOf(of);
    const double mass = bodies_.effectiveMassKg(of.a, of.b, of.point, of.normal);
    // what has nearly stopped is perhaps to bounce in the next step; over an edge most of the speed is left
    const double owed = after < 0.5 * speed ? std::max(0.0, of.restitution * speed + std::min(after, gap))
                                            : (1.0 + of.restitution) * left;
    // An engine that saw the surface coming leaves what closes the gap; the next step stops that likewise.
    const double taken = bodies_.approach(of.a, of.b, of.point, of.normal) - left;
    const bool goesOn = of.gapMetres > 0.0 && !each.isKick && left > 0.0 && taken > 0.05 * speed;
    return {goesOn ? pushed * speed / taken : pushed, pushed + owed * mass};
}

// For contacts that are not soft: the impact's impulse is that of the new points.
void ReportedContacts::strikeByMomentum() {
    meeting_.clear();
    for (const Waiting* each : together_) {
        const double newtonSeconds =
            each->isNew ? momentum_.newtonSeconds(static_cast<std::size_t>(each->momentum)) : 0.0;
        meeting_.push_back({each->contact.point, each->contact.normal, speedOf(each->contact), 0.0,
                            each->isNew, newtonSeconds});
    }
    strikeTogether();
}

// If the pair has a new point, that is the impact, and old points that were struck are load.
void ReportedContacts::judgeKicks(Pair& pair) {
    bool isAnyNew = false;
    const auto next = [this](std::int32_t at) { return waiting_[static_cast<std::size_t>(at)].next; };
    for (std::int32_t at = pair.waiting; at != FedPoints::none; at = next(at))
        if (const Waiting& each = waiting_[static_cast<std::size_t>(at)]; each.isNew && !each.isKick)
            isAnyNew = true;
    for (std::int32_t at = pair.waiting; at != FedPoints::none; at = next(at)) {
        Waiting& each = waiting_[static_cast<std::size_t>(at)];
        if (!each.isKick) continue;
        each.isNew = !isAnyNew;
        if (!isAnyNew)
            each.contact = beyondLoad(pair, each.contact);
        else if (each.momentum == FedPoints::none && !each.contact.isImpulseOfPair)
            load(each.contact);
    }
}

void ReportedContacts::settle(Pair& pair) {
    judgeKicks(pair);
    together_.clear();
    for (std::int32_t at = pair.waiting; at != FedPoints::none;
         at = waiting_[static_cast<std::size_t>(at)].next)
        // a point that was reported as begun and pushed counts once
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
    if (std::ranges::none_of(together_, isNew)) { // loads of the others were added when they were reported
        if (first.isImpulseOfPair) load(first);
        return;
    }
    if (together_.size() == 1 || std::ranges::any_of(together_, hasMass)) {
        for (const Waiting* each : together_)
            if (each->isNew) strike(withMomentum(*each), hasMass(each) ? anyPush : pushed(*each));
        return;
    }
    meeting_.clear();
    for (const Waiting* each : together_) {
        const FedContact& contact = each->contact;
        const bool isTurned = contact.a != first.a;
        meeting_.push_back({contact.point, isTurned ? -contact.normal : contact.normal, speedOf(contact),
                            contact.restitution, each->isNew, 0.0, dragOf(withMomentum(*each))});
    }
    solve(bodies_, first.a, first.b, meeting_);
    strikeTogether();
}

// The fastest approach of new points, m/s; below 0 if all of them part.
double ReportedContacts::fastestOfNew() const {
    double fastest = -std::numeric_limits<double>::infinity();
    for (const Waiting* each : together_)
        if (each->isNew) fastest = std::max(fastest, speedOf(each->contact));
    return fastest;
}

// An impact at several points: place and impulse are those of all together, the time is that of the first.
void ReportedContacts::strikeTogether() {
    CollisionCatcher& catcher = events_.catcher();
    const FedContact& first = together_.front()->contact;
    const TouchingPairs::Name pair = nameOf(first);
    double all = 0.0, ofNew = 0.0, fastest = 0.0, fraction = FedContact::latestFraction;
    Push push{0.0, 0.0};
    Vector3 point;
    for (std::size_t i = 0; i < meeting_.size(); ++i) {
        const MeetingPoint& each = meeting_[i];
        all += each.newtonSeconds;
        if (const auto [now, most] = pushed(*together_[i]); each.isNew)
            push.first += now, push.second += most;
        if (!each.isNew || !(each.newtonSeconds > 0.0)) continue;
        ofNew += each.newtonSeconds;
        point += static_cast<float>(each.newtonSeconds / ofNew) * (each.point - point);
        fastest = std::max(fastest, each.approach);
        fraction = std::min(fraction, fractionOf(together_[i]->contact, each.approach));
    }
    const double share = all > 0.0 ? ofNew / all : 0.0;
    if (fastest > 0.0) ofNew = supported(ofNew, push, (1.0 + first.restitution) * fastest, fraction);
    const double impulse = first.isImpulseOfPair ? share * *first.impulseNewtonSeconds : ofNew;
    const bool isCollision = impulse > 0.0 && std::isfinite(impulse) && isImpact(pair.a, pair.b, fastest);
    if (!isCollision) passOver(pair, first, fastest > 0.0 ? fastest : fastestOfNew(), impulse);
    if (!isCollision && first.isImpulseOfPair) return load(first);
    if (!isCollision) {
        for (const Waiting* each : together_)
            if (each->isNew && (each->contact.isSoft || speedOf(each->contact) > 0.0))
                load(withMomentum(*each));
        return;
    }
    Collision* collision = catcher.collision(pair);
    const bool isFirst = collision == nullptr;
    if (isFirst && (collision = catcher.strike(pair, fastest)) == nullptr) return;
    const double sum = collision->normalImpulse + impulse;
    collision->fraction = isFirst ? fraction : std::min(collision->fraction, fraction);
    collision->point += static_cast<float>(impulse / sum) * (point - collision->point);
    collision->normalImpulse = sum;
    if (!first.isImpulseOfPair) return;
    collision->tangentialImpulse += share * first.tangentialNewtonSeconds;
    addFriction(*collision, first, pair.a, static_cast<float>(share));
    FedContact rest = first; // the impulse of old points is a load
    rest.impulseNewtonSeconds = (1.0 - share) * *first.impulseNewtonSeconds;
    rest.tangentialNewtonSeconds = (1.0 - share) * first.tangentialNewtonSeconds;
    rest.frictionNewtonSeconds = static_cast<float>(1.0 - share) * first.frictionNewtonSeconds;
    if (share < 1.0) load(rest);
}

} // namespace physvib
