// SPDX-License-Identifier: MIT
// Solves the points of a pair together at the end of a step, so that a flat landing is one impact.
#include "Contacts/FedContacts.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace physvib {

void FedContacts::settleTogether() {
    if (waiting_.empty()) return;
    momentum_.solve();
    for (const Pair& pair : pairs_)
        if (pair.waiting != FedPoints::none) settle(pair);
    momentum_.clear();
}

FedContact FedContacts::withMomentum(const Waiting& each) const {
    FedContact contact = each.contact;
    if (each.momentum == FedPoints::none) return contact;
    contact.impulseNewtonSeconds = momentum_.newtonSeconds(static_cast<std::size_t>(each.momentum));
    contact.tangentialNewtonSeconds = 0.0;
    contact.frictionNewtonSeconds = {};
    return contact;
}

double FedContacts::pushed(const Waiting& each) const {
    const FedContact& contact = each.contact;
    if (!contact.isSoft) return 0.0;
    const double told = contact.isPushWhole ? contact.impulseNewtonSeconds.value_or(0.0) : 0.0;
    return each.momentum == FedPoints::none
               ? told
               : std::max(told, momentum_.newtonSeconds(static_cast<std::size_t>(each.momentum)));
}

// Of contacts that are not soft: the impulse of the impact is that of the new points.
void FedContacts::strikeByMomentum() {
    meeting_.clear();
    for (const Waiting* each : together_) {
        const double newtonSeconds =
            each->isNew ? momentum_.newtonSeconds(static_cast<std::size_t>(each->momentum)) : 0.0;
        meeting_.push_back({each->contact.point, each->contact.normal, speedOf(each->contact), 0.0,
                            each->isNew, newtonSeconds});
    }
    strikeTogether();
}

void FedContacts::settle(const Pair& pair) {
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

// Below 0: all of them part.
double FedContacts::fastestOfNew() const {
    double fastest = -std::numeric_limits<double>::infinity();
    for (const Waiting* each : together_)
        if (each->isNew) fastest = std::max(fastest, speedOf(each->contact));
    return fastest;
}

// An impact at several points: place and impulse are those of all together, the time is that of the first.
void FedContacts::strikeTogether() {
    CollisionCatcher& catcher = events_.catcher();
    const FedContact& first = together_.front()->contact;
    const TouchingPairs::Name pair = nameOf(first);
    double all = 0.0, ofNew = 0.0, fastest = 0.0, fraction = FedContact::latestFraction, ofPush = 0.0;
    Vector3 point;
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
    const bool isCollision =
        impulse > 0.0 && std::isfinite(impulse) && catcher.isCollision(gravityScale, fastest);
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
