// SPDX-License-Identifier: MIT
// The list of touching pairs: a pair is added when it is first reported, and removed when it ends.
#include "Contacts/FedContacts.h"
#include <algorithm>

namespace physvib {

FedContacts::FedContacts(const ImpactSettings& settings)
    : events_(bodies_, settings) {}

void FedContacts::beginStep(std::int64_t endNs, double gravityMetresPerSecond2) {
    lastStepSeconds_ = events_.stepSeconds();
    gravity_ = gravityMetresPerSecond2;
    events_.beginStep(endNs, {0.0F, -static_cast<float>(gravityMetresPerSecond2)}, bodies_.largestMassKg());
}

void FedContacts::remove(std::int32_t id) {
    const std::int32_t slot = slotOf(id);
    dropAllOf(slot);
    events_.vanish(slot);
    bodies_.remove(id);
}

void FedContacts::touch(const FedContact& contact) {
    Pair& pair = know(contact, true);
    pair.isNamed = true;
    const bool isNewPoint = this->isNewPoint(pair, contact);
    if (isNewPoint && !pair.isNew) events_.catcher().meet(pair.a, pair.b);
    tell(pair, contact, pair.isNew || isNewPoint);
}

void FedContacts::begin(const FedContact& contact) {
    Pair& pair = know(contact, false);
    isNewPoint(pair, contact); // the next step knows this point
    tell(pair, contact, true);
}

void FedContacts::push(const FedContact& contact) {
    Pair& pair = know(contact, false); // it may have touched before the first report
    const bool isNewPoint = this->isNewPoint(pair, contact) && !pair.isNew;
    if (isNewPoint) events_.catcher().meet(pair.a, pair.b);
    tell(pair, contact, isNewPoint);
}

bool FedContacts::end(std::int32_t a, std::int32_t b) {
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

void FedContacts::endStep() {
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
}

FedContacts::Pair& FedContacts::know(const FedContact& contact, bool isAsked) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    if (const std::int32_t known = pairOf_.find(pairKey(a, b)); known != IntegerMap::none)
        return pairs_[static_cast<std::size_t>(known)];
    pairOf_.set(pairKey(a, b), static_cast<std::int32_t>(pairs_.size()));
    pairs_.push_back({std::min(a, b), std::max(a, b), isAsked, true, false});
    events_.catcher().begin(a, b);
    return pairs_.back();
}

// The place of a contact at its end is only needed for release timing, which feeds do not have.
void FedContacts::drop(std::size_t pair) {
    Pair& hole = pairs_[pair];
    events_.catcher().end(hole.a, hole.b);
    pairOf_.erase(pairKey(hole.a, hole.b));
    if (&hole != &pairs_.back()) {
        hole = pairs_.back();
        pairOf_.set(pairKey(hole.a, hole.b), static_cast<std::int32_t>(pair));
    }
    pairs_.pop_back();
}

void FedContacts::dropAllOf(std::int32_t slot) {
    for (std::size_t i = pairs_.size(); i-- > 0;)
        if (pairs_[i].a == slot || pairs_[i].b == slot) drop(i);
    rubs_.forget(slot);
}

// Points are followed even without haptic sources: a source that is added later must not take an old point
// for a new one.
bool FedContacts::isNewPoint(Pair& pair, const FedContact& contact) {
    if (contact.pointId == FedContact::noPoint) return false;
    constexpr double trembleMetres = 0.002;
    const double slide =
        bodies_.slide(contact.a, contact.b, contact.point, contact.normal) * events_.stepSeconds();
    return points_.isNew(pair.points, contact.pointId, contact.point, contact.normal,
                         trembleMetres + 1.5 * slide) &&
           // an impulse alone does not tell an impact from a load that shifts
           (pair.isNew || speedOf(contact) > 0.0);
}

void FedContacts::tell(Pair& pair, const FedContact& contact, bool isNew) {
    if (!events_.catcher().hasSources()) return;
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

} // namespace physvib
