// SPDX-License-Identifier: MIT
// Pairs in contact, from their first report to their end: new contacts are collisions, all others load.
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
    dropPairsOf(slot);
    events_.handleDestruction(slot);
    bodies_.remove(id);
}

void ReportedContacts::touch(const FedContact& contact) {
    Pair& pair = findOrAdd(contact, true);
    pair.isListedNow = true;
    const bool isNewPoint = this->isNewPoint(pair, contact);
    addContact(pair, contact, pair.isNew || isNewPoint, isNewPoint);
}

void ReportedContacts::begin(const FedContact& contact) {
    Pair& pair = findOrAdd(contact, false);
    isNewPoint(pair, contact); // the next step knows this point
    addContact(pair, contact, true, false);
}

void ReportedContacts::push(const FedContact& contact) {
    Pair& pair = findOrAdd(contact, false); // it may have touched before the first report
    const bool isNewPoint = this->isNewPoint(pair, contact) && !pair.isNew;
    addContact(pair, contact, isNewPoint, isNewPoint);
}

bool ReportedContacts::end(std::int32_t a, std::int32_t b) {
    const std::int32_t pair = pairOf_.find(pairKey(slotOf(a), slotOf(b)));
    if (pair == IntegerMap::none) return false;
    // reported in this step, and not solved yet
    if (pairs_[static_cast<std::size_t>(pair)].newestPending != ReportedPoints::none) {
        momentum_.solve();
        solvePair(pairs_[static_cast<std::size_t>(pair)]);
    }
    drop(static_cast<std::size_t>(pair));
    return true;
}

void ReportedContacts::endStep() {
    solvePending();
    for (std::size_t i = pairs_.size(); i-- > 0;) {
        Pair& pair = pairs_[i];
        if (pair.isListed && !pair.isListedNow) {
            drop(i);
            continue;
        }
        pair.isNew = pair.isListedNow = false;
        // Engines need a few steps to end an impact.
        pair.lastApproach = std::max(std::exchange(pair.approach, 0.0), 0.5 * pair.lastApproach);
        pair.lastLoad = std::exchange(pair.load, 0.0);
        pair.points = {.before = pair.points.now};
        pair.newestPending = ReportedPoints::none;
    }
    points_.endStep();
    pendingContacts_.clear();
    bodies_.endStep();
    slides_.endStep(events_.stepSeconds(), events_.lasting());
    events_.endStep();
}

ReportedContacts::Pair& ReportedContacts::findOrAdd(const FedContact& contact, bool isListed) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    if (const std::int32_t known = pairOf_.find(pairKey(a, b)); known != IntegerMap::none)
        return pairs_[static_cast<std::size_t>(known)];
    pairOf_.set(pairKey(a, b), static_cast<std::int32_t>(pairs_.size()));
    pairs_.push_back({std::min(a, b), std::max(a, b), isListed, true, false});
    events_.recorder().begin(a, b);
    return pairs_.back();
}

// The place of a contact at its end is only needed for release timing, which feeds do not have.
void ReportedContacts::drop(std::size_t pair) {
    Pair& hole = pairs_[pair];
    events_.recorder().end(hole.a, hole.b);
    pairOf_.erase(pairKey(hole.a, hole.b));
    if (&hole != &pairs_.back()) {
        hole = pairs_.back();
        pairOf_.set(pairKey(hole.a, hole.b), static_cast<std::int32_t>(pair));
    }
    pairs_.pop_back();
}

void ReportedContacts::dropPairsOf(std::int32_t slot) {
    for (std::size_t i = pairs_.size(); i-- > 0;)
        if (pairs_[i].a == slot || pairs_[i].b == slot) drop(i);
    slides_.forget(slot);
}

// Points are followed even without haptic sources: a source that is added later must not take an old point
// for a new one.
bool ReportedContacts::isNewPoint(Pair& pair, const FedContact& contact) {
    if (contact.pointId == FedContact::noPoint) return false;
    constexpr double jitterMetres = 0.002;
    const double slide =
        bodies_.slide(contact.a, contact.b, contact.point, contact.normal) * events_.stepSeconds();
    return points_.isNew(pair.points, contact.pointId, contact.point, contact.normal,
                         jitterMetres + 1.5 * slide) &&
           // an impulse alone does not tell an impact from a load that shifts
           (pair.isNew || speedOf(contact) > 0.0);
}

// True for a kick: a body that already touches is struck faster than gravity explains, as by a flipper under
// a resting ball. Only the first step counts, since what drives it may push on, or a later one that is more
// than twice as fast, since some engines spread an impact over several steps. A gap that does not close in
// this step is no kick yet, and ground gives no second impact to a body that was struck.
bool ReportedContacts::isKick(Pair& pair, const FedContact& contact, bool isNew) {
    if (contact.impulseNewtonSeconds && !contact.isSoft)
        pair.load = contact.isImpulseOfPair ? *contact.impulseNewtonSeconds
                                            : pair.load + std::max(0.0, *contact.impulseNewtonSeconds);
    const double speed = speedOf(contact), seconds = events_.stepSeconds();
    if (!(speed > 0.0) || (!isNew && contact.gapMetres > speed * seconds)) return false;
    constexpr double margin = 2.5; // excludes a starting elevator and the end of an earlier impact
    const double excessSpeed =
        speed - gravity_ * seconds * static_cast<double>(std::abs(gravityScaleOf(pair.a, pair.b)));
    if (!isImpact(pair.a, pair.b, excessSpeed / margin)) return false;
    pair.approach = std::max(pair.approach, speed);
    return !isNew && speed > 2.0 * pair.lastApproach && !isOnGround(contact.a, contact.b) &&
           !isOnGround(contact.b, contact.a);
}

// An engine that solves each contact once lets a struck body reach the ground a step later.
bool ReportedContacts::isOnGround(std::int32_t struck, std::int32_t ground) {
    return bodies_.isFixedAtRest(ground) && !events_.fixtures().isSource(slotOf(ground)) &&
           events_.recorder().collidedInLastStep(slotOf(struck));
}

// Subtracts the impulse that the pair transmitted in the step before.
FedContact ReportedContacts::withoutLoad(Pair& pair, FedContact contact) {
    if (!contact.impulseNewtonSeconds || contact.isSoft) return contact;
    const double load = std::min(pair.lastLoad, std::max(0.0, *contact.impulseNewtonSeconds));
    *contact.impulseNewtonSeconds -= load;
    if (!contact.isImpulseOfPair) pair.lastLoad -= load; // several points share it
    return contact;
}

void ReportedContacts::addContact(Pair& pair, const FedContact& contact, bool isNew, bool isNewPoint) {
    if (!events_.recorder().hasSources()) {
        if (isNewPoint && !pair.isNew) events_.recorder().countContact(pair.a, pair.b);
        return;
    }
    const bool isKick = this->isKick(pair, contact, isNew);
    if ((isNewPoint || isKick) && !pair.isNew) events_.recorder().countContact(pair.a, pair.b);
    if (isSolvedAtStepEnd(contact)) {
        const bool isByMomentum = this->isByMomentum(contact);
        const auto momentum = isByMomentum
                                  ? static_cast<std::int32_t>(momentum_.add(bodies_, contact.a, contact.b,
                                                                            contact.point, contact.normal))
                                  : ReportedPoints::none;
        pendingContacts_.push_back({contact, isNew || isKick, isKick, pair.newestPending, momentum});
        pair.newestPending = static_cast<std::int32_t>(pendingContacts_.size()) - 1;
        if (isNew || isKick || contact.isImpulseOfPair || isByMomentum) return;
    }
    if (isNew)
        addCollision(contact);
    else if (isKick)
        addCollision(withoutLoad(pair, contact));
    else
        addLoad(contact);
}

// An impact's impulse, from speed and masses (`bySpeed`) and from the engine (`push`). The latter is larger
// if a struck body stands on something, hangs in joints or carries others; what gravity adds after they met
// is a load. It is smaller, and little is left to later steps, where the impact was weaker, as over an edge.
double ReportedContacts::supportedNewtonSeconds(double bySpeed, Push push, double gainedMetresPerSecond,
                                                double fraction) const {
    constexpr double margin = 1.2; // the impulse of a step also moves overlaps apart
    const double gravitySpeed = gravity_ * events_.stepSeconds() * (1.0 - std::clamp(fraction, 0.0, 1.0));
    const double impactImpulse = push.first * gainedMetresPerSecond / (gainedMetresPerSecond + gravitySpeed);
    if (impactImpulse > margin * bySpeed) return impactImpulse;
    return bySpeed > margin * push.second ? push.second : bySpeed;
}

float ReportedContacts::gravityScaleOf(std::int32_t a, std::int32_t b) const {
    return std::max(events_.fixtures()[a].gravityScale(), events_.fixtures()[b].gravityScale());
}

bool ReportedContacts::isImpact(std::int32_t a, std::int32_t b, double metresPerSecond) {
    return events_.recorder().isCollision(gravityScaleOf(a, b), metresPerSecond);
}

double ReportedContacts::speedOf(const FedContact& contact) const {
    return contact.approachMetresPerSecond.value_or(
        bodies_.approach(contact.a, contact.b, contact.point, contact.normal));
}

// Only counts. An impact needs two thirds of the threshold as approach, and all of it as change of the
// lighter body's velocity. Surfaces that part no faster than resting bodies do are at rest.
void ReportedContacts::countBelowThreshold(const TouchingPairs::Handle& pair, const FedContact& contact,
                                           double speed, double impulse) {
    CollisionRecorder& recorder = events_.recorder();
    const FixtureEntry &a = events_.fixtures()[pair.a], &b = events_.fixtures()[pair.b];
    const double lighter = std::min(a.movableMassKg(), b.movableMassKg());
    const double change = std::isfinite(impulse) ? impulse / lighter : 0.0;
    recorder.countBelowThreshold(pair.a, pair.b, std::max(0.0, std::min(1.5 * speed, change)));
    if (!std::isfinite(lighter) || !recorder.touchesSource(pair.a, pair.b)) return;
    ContactCounts& tally = recorder.tally();
    if (isImpact(pair.a, pair.b, -speed)) {
        ++tally.parting;
        tally.fastestPartingMetresPerSecond = std::max(tally.fastestPartingMetresPerSecond, -speed);
    } else if (speed == 0.0 && !contact.approachMetresPerSecond && !(impulse > 0.0)) {
        ++tally.motionless;
    }
}

// Adds the impact of one point to its pair's collision. A contact that is no impact is counted, and is a
// load.
void ReportedContacts::addCollision(const FedContact& contact, Push push) {
    CollisionRecorder& recorder = events_.recorder();
    const TouchingPairs::Handle pair = handleOf(contact);
    const FixtureEntry &a = events_.fixtures()[pair.a], &b = events_.fixtures()[pair.b];
    const double reportedSpeed = speedOf(contact);
    const double mass = contact.effectiveMassKg.value_or(
        bodies_.effectiveMassKg(contact.a, contact.b, contact.point, contact.normal, dragOf(contact)));
    const bool hasImpulse = contact.impulseNewtonSeconds && !contact.isSoft;
    double impulse = hasImpulse ? *contact.impulseNewtonSeconds
                                : mass * std::max(0.0, reportedSpeed) * (1.0 + contact.restitution);
    if (reportedSpeed > 0.0)
        impulse = supportedNewtonSeconds(impulse, push, reportedSpeed * (1.0 + contact.restitution),
                                         fractionOf(contact, reportedSpeed));
    if (!(impulse > 0.0 && std::isfinite(impulse))) { // they separate, or neither can be moved
        countBelowThreshold(pair, contact, reportedSpeed, 0.0);
        return contact.isSoft ? addLoad(contact) : void();
    }
    // With an impulse alone, the speed is the change of the lighter body's velocity, which is at least the
    // speed before.
    const bool isSpeedKnown = contact.approachMetresPerSecond || !hasImpulse || reportedSpeed > 0.0;
    const double speed =
        isSpeedKnown ? reportedSpeed : impulse / std::min(a.movableMassKg(), b.movableMassKg());
    if (!isImpact(pair.a, pair.b, speed)) {
        countBelowThreshold(pair, contact, speed, impulse);
        return addLoad(contact);
    }

    Collision* collision = recorder.findCollision(pair);
    const bool isFirst = collision == nullptr;
    if (isFirst && (collision = recorder.addCollision(pair, speed)) == nullptr) return;
    const double fraction = fractionOf(contact, isSpeedKnown ? speed : 0.0);
    collision->fraction = isFirst ? fraction : std::min(collision->fraction, fraction);
    if (hasImpulse || isFirst) { // impulses of points add up; a speed gives that of the whole impact
        const double sum = collision->normalNewtonSeconds + impulse;
        collision->point += static_cast<float>(impulse / sum) * (contact.point - collision->point);
        collision->normalNewtonSeconds = sum;
        collision->tangentialNewtonSeconds += hasImpulse ? contact.tangentialNewtonSeconds : 0.0;
        if (hasImpulse) addFriction(*collision, contact, pair.a, 1.0F);
    } else if (impulse > collision->normalNewtonSeconds) {
        collision->normalNewtonSeconds = impulse;
        collision->point = contact.point;
    }
}

// A contact may name its bodies in the other order than the collision does.
void ReportedContacts::addFriction(Collision& collision, const FedContact& contact, std::int32_t a,
                                   float share) noexcept {
    collision.frictionNewtonSeconds += (collision.a == a ? share : -share) * contact.frictionNewtonSeconds;
}

void ReportedContacts::addLoad(const FedContact& contact) {
    if (!contact.impulseNewtonSeconds || !events_.recorder().hasSources()) return;
    const TouchingPairs::Handle pair = handleOf(contact);
    reportSlide(contact, pair);
    if (!events_.recorder().isRelevant(pair)) return;
    const auto along = static_cast<float>(*contact.impulseNewtonSeconds),
               across = static_cast<float>(contact.tangentialNewtonSeconds);
    const Vector3 inPlane = along * contact.normal + across * physvib::inPlane(contact.normal).turnedLeft();
    events_.recorder().push(pair, inPlane + contact.frictionNewtonSeconds, contact.point);
}

void ReportedContacts::reportSlide(const FedContact& contact, const TouchingPairs::Handle& pair) {
    if (!contact.alongAMetresPerSecond || !contact.alongBMetresPerSecond ||
        !events_.lasting().isRelevant(pair.a, pair.b))
        return;
    slides_.report({pair.a, pair.b, *contact.impulseNewtonSeconds, contact.point,
                    *contact.alongAMetresPerSecond, *contact.alongBMetresPerSecond});
}

// When surfaces meet, in steps after the start of this one: the gap closes, or has closed, at their approach.
double ReportedContacts::fractionOf(const FedContact& contact,
                                    double approachMetresPerSecond) const noexcept {
    if (contact.fraction) return *contact.fraction;
    const double ahead = approachMetresPerSecond > 0.0 ? contact.gapMetres / approachMetresPerSecond : 0.0;
    const double now = events_.stepSeconds();
    const double seconds = contact.gapFraction * now + ahead;
    const double length = seconds < 0.0 ? lastStepSeconds_ : now;
    return length > 0.0 ? std::clamp(seconds / length, -1.0, 1.0) : 0.0;
}

TouchingPairs::Handle ReportedContacts::handleOf(const FedContact& contact) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    return {a, b, events_.recorder().pairNumber(a, b)};
}

void ReportedContacts::solvePending() {
    if (pendingContacts_.empty()) return;
    momentum_.solve();
    bool isAnyStruck = false;
    for (const PendingContact& item : pendingContacts_) {
        if (!item.isNew || item.momentum == ReportedPoints::none ||
            !isImpact(slotOf(item.contact.a), slotOf(item.contact.b), speedOf(item.contact)))
            continue;
        momentum_.markStruck(static_cast<std::size_t>(item.momentum));
        isAnyStruck = true;
    }
    if (isAnyStruck) momentum_.solveFriction(bodies_);
    for (Pair& pair : pairs_)
        if (pair.newestPending != ReportedPoints::none) solvePair(pair);
    momentum_.clear();
}

FedContact ReportedContacts::withMomentumImpulse(const PendingContact& item) const {
    FedContact contact = item.contact;
    if (item.momentum == ReportedPoints::none) return contact;
    contact.impulseNewtonSeconds = momentum_.newtonSeconds(static_cast<std::size_t>(item.momentum));
    contact.tangentialNewtonSeconds = 0.0;
    contact.frictionNewtonSeconds = momentum_.friction(static_cast<std::size_t>(item.momentum));
    return contact;
}

// The friction of a soft contact per N s along the normal, from the engine's own impulse; else 0.
Vector3 ReportedContacts::dragOf(const FedContact& contact) const {
    const double along = contact.impulseNewtonSeconds.value_or(0.0);
    if (!contact.isSoft || !(along > 0.0)) return {};
    const Vector3 left = inPlane(contact.normal).turnedLeft();
    const Vector3 friction =
        contact.frictionNewtonSeconds + static_cast<float>(contact.tangentialNewtonSeconds) * left;
    return bodies_.limitedDrag(contact.a, contact.b, contact.point, contact.normal,
                               static_cast<float>(1.0 / along) * friction);
}

ReportedContacts::Push ReportedContacts::pushOf(const PendingContact& item) const {
    const FedContact& contact = item.contact;
    if (!contact.isSoft) return unboundedPush;
    const double reportedNewtonSeconds =
        contact.isPushWhole ? contact.impulseNewtonSeconds.value_or(0.0) : 0.0;
    if (item.momentum == ReportedPoints::none) return {reportedNewtonSeconds, unboundedPush.second};
    const double pushed =
        std::max(reportedNewtonSeconds, momentum_.newtonSeconds(static_cast<std::size_t>(item.momentum)));
    const double gap = contact.gapMetres > 0.0 ? contact.gapMetres / events_.stepSeconds() : HUGE_VAL;
    const double speedAfter = bodies_.approach(contact.a, contact.b, contact.point, contact.normal, true);
    const double remaining = std::clamp(speedAfter, 0.0, gap), speed = speedOf(contact);
    const double mass = bodies_.effectiveMassKg(contact.a, contact.b, contact.point, contact.normal);
    // a body that has nearly stopped may bounce in the next step; over an edge most of the speed remains
    const double bounceSpeed = speedAfter < 0.5 * speed
                                   ? std::max(0.0, contact.restitution * speed + std::min(speedAfter, gap))
                                   : (1.0 + contact.restitution) * remaining;
    // An engine that looks ahead leaves the speed that closes the gap; the next step stops it.
    const double stopped = bodies_.approach(contact.a, contact.b, contact.point, contact.normal) - remaining;
    const bool isPartial =
        contact.gapMetres > 0.0 && !item.isKick && remaining > 0.0 && stopped > 0.05 * speed;
    return {isPartial ? pushed * speed / stopped : pushed, pushed + bounceSpeed * mass};
}

// For contacts that are not soft: the impact's impulse is that of the new points.
void ReportedContacts::addMomentumCollision() {
    solverPoints_.clear();
    for (const PendingContact* item : pairContacts_) {
        const double newtonSeconds =
            item->isNew ? momentum_.newtonSeconds(static_cast<std::size_t>(item->momentum)) : 0.0;
        solverPoints_.push_back({item->contact.point, item->contact.normal, speedOf(item->contact), 0.0,
                                 item->isNew, newtonSeconds});
    }
    addSharedCollision();
}

// If the pair has a new point, that is the impact, and old points that were struck are load.
void ReportedContacts::resolveKicks(Pair& pair) {
    bool isAnyNew = false;
    const auto next = [this](std::int32_t i) { return pendingContacts_[static_cast<std::size_t>(i)].next; };
    for (std::int32_t index = pair.newestPending; index != ReportedPoints::none; index = next(index))
        if (const PendingContact& item = pendingContacts_[static_cast<std::size_t>(index)];
            item.isNew && !item.isKick)
            isAnyNew = true;
    for (std::int32_t index = pair.newestPending; index != ReportedPoints::none; index = next(index)) {
        PendingContact& item = pendingContacts_[static_cast<std::size_t>(index)];
        if (!item.isKick) continue;
        item.isNew = !isAnyNew;
        if (!isAnyNew)
            item.contact = withoutLoad(pair, item.contact);
        else if (item.momentum == ReportedPoints::none && !item.contact.isImpulseOfPair)
            addLoad(item.contact);
    }
}

// Sorts a pair's pending contacts: those that are not new are loads, the others impacts of single points, or
// one impact at several points, whose impulses are solved together.
void ReportedContacts::solvePair(Pair& pair) {
    resolveKicks(pair);
    pairContacts_.clear();
    for (std::int32_t index = pair.newestPending; index != ReportedPoints::none;
         index = pendingContacts_[static_cast<std::size_t>(index)].next)
        // a point that was reported as begun and pushed counts once
        if (const PendingContact& item = pendingContacts_[static_cast<std::size_t>(index)];
            item.isNew || pair.isListed)
            pairContacts_.push_back(&item);
    if (pairContacts_.empty()) return;
    std::reverse(pairContacts_.begin(), pairContacts_.end());
    const FedContact& first = pairContacts_.front()->contact;
    const auto hasMass = [](const PendingContact* item) { return item->contact.effectiveMassKg.has_value(); };
    const auto isNew = [](const PendingContact* item) { return item->isNew; };
    const bool isByMomentum = std::ranges::all_of(
        pairContacts_, [](const PendingContact* item) { return item->momentum != ReportedPoints::none; });
    for (const PendingContact* item : pairContacts_)
        if (isByMomentum && !item->isNew) addLoad(withMomentumImpulse(*item));
    if (isByMomentum && !first.isSoft && std::ranges::any_of(pairContacts_, isNew))
        return addMomentumCollision();
    if (std::ranges::none_of(pairContacts_, isNew)) { // other loads were added when reported
        if (first.isImpulseOfPair) addLoad(first);
        return;
    }
    if (pairContacts_.size() == 1 || std::ranges::any_of(pairContacts_, hasMass)) {
        for (const PendingContact* item : pairContacts_)
            if (item->isNew)
                addCollision(withMomentumImpulse(*item), hasMass(item) ? unboundedPush : pushOf(*item));
        return;
    }
    solverPoints_.clear();
    for (const PendingContact* item : pairContacts_) {
        const FedContact& contact = item->contact;
        const bool isTurned = contact.a != first.a;
        const Vector3 drag = dragOf(withMomentumImpulse(*item));
        solverPoints_.push_back({contact.point, isTurned ? -contact.normal : contact.normal, speedOf(contact),
                                 contact.restitution, item->isNew, 0.0, isTurned ? -drag : drag});
    }
    solve(bodies_, first.a, first.b, solverPoints_);
    addSharedCollision();
}

// The fastest approach of new points, m/s; below 0 if all of them part.
double ReportedContacts::fastestNewSpeed() const {
    double fastest = -std::numeric_limits<double>::infinity();
    for (const PendingContact* item : pairContacts_)
        if (item->isNew) fastest = std::max(fastest, speedOf(item->contact));
    return fastest;
}

// An impact at several points: place and impulse are those of all together, the time is that of the first.
void ReportedContacts::addSharedCollision() {
    CollisionRecorder& recorder = events_.recorder();
    const FedContact& first = pairContacts_.front()->contact;
    const TouchingPairs::Handle pair = handleOf(first);
    double total = 0.0, newImpulse = 0.0, fastest = 0.0, fraction = FedContact::latestFraction;
    Push push{0.0, 0.0};
    Vector3 point;
    for (std::size_t i = 0; i < solverPoints_.size(); ++i) {
        const SolverPoint& item = solverPoints_[i];
        total += item.newtonSeconds;
        if (const auto [newtonSeconds, maxNewtonSeconds] = pushOf(*pairContacts_[i]); item.isNew)
            push.first += newtonSeconds, push.second += maxNewtonSeconds;
        if (!item.isNew || !(item.newtonSeconds > 0.0)) continue;
        newImpulse += item.newtonSeconds;
        point += static_cast<float>(item.newtonSeconds / newImpulse) * (item.point - point);
        fastest = std::max(fastest, item.approach);
        fraction = std::min(fraction, fractionOf(pairContacts_[i]->contact, item.approach));
    }
    const double share = total > 0.0 ? newImpulse / total : 0.0;
    if (fastest > 0.0)
        newImpulse = supportedNewtonSeconds(newImpulse, push, (1.0 + first.restitution) * fastest, fraction);
    const double impulse = first.isImpulseOfPair ? share * *first.impulseNewtonSeconds : newImpulse;
    const bool isCollision = impulse > 0.0 && std::isfinite(impulse) && isImpact(pair.a, pair.b, fastest);
    if (!isCollision) countBelowThreshold(pair, first, fastest > 0.0 ? fastest : fastestNewSpeed(), impulse);
    if (!isCollision && first.isImpulseOfPair) return addLoad(first);
    if (!isCollision) {
        for (const PendingContact* item : pairContacts_)
            if (item->isNew && (item->contact.isSoft || speedOf(item->contact) > 0.0))
                addLoad(withMomentumImpulse(*item));
        return;
    }
    Collision* collision = recorder.findCollision(pair);
    const bool isFirst = collision == nullptr;
    if (isFirst && (collision = recorder.addCollision(pair, fastest)) == nullptr) return;
    const double sum = collision->normalNewtonSeconds + impulse;
    collision->fraction = isFirst ? fraction : std::min(collision->fraction, fraction);
    collision->point += static_cast<float>(impulse / sum) * (point - collision->point);
    collision->normalNewtonSeconds = sum;
    if (!first.isImpulseOfPair) return;
    collision->tangentialNewtonSeconds += share * first.tangentialNewtonSeconds;
    addFriction(*collision, first, pair.a, static_cast<float>(share));
    FedContact load = first; // the impulse of old points is a load
    load.impulseNewtonSeconds = (1.0 - share) * *first.impulseNewtonSeconds;
    load.tangentialNewtonSeconds = (1.0 - share) * first.tangentialNewtonSeconds;
    load.frictionNewtonSeconds = static_cast<float>(1.0 - share) * first.frictionNewtonSeconds;
    if (share < 1.0) addLoad(load);
}

} // namespace physvib
