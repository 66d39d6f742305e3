// SPDX-License-Identifier: MIT
// Impacts of single points: impulse and time of each. A point without an impact is a load of its pair.
#include "Contacts/FedContacts.h"
#include <algorithm>
#include <cmath>

namespace physvib {

// A struck body may stand on something, hang in joints or carry others. Then the engine's impulse of the step
// is larger than speed and mass of the two bodies say. What gravity adds after they met is a load.
double FedContacts::supported(double bySpeed, double pushed, double gainedMetresPerSecond,
                              double fraction) const {
    constexpr double clearly = 1.2; // the impulse of a step also moves overlaps apart
    const double falls = gravity_ * events_.stepSeconds() * (1.0 - std::clamp(fraction, 0.0, 1.0));
    const double ofCollision = pushed * gainedMetresPerSecond / (gainedMetresPerSecond + falls);
    return ofCollision > clearly * bySpeed ? ofCollision : bySpeed;
}

double FedContacts::speedOf(const FedContact& contact) const {
    return contact.approachMetresPerSecond.value_or(
        bodies_.approach(contact.a, contact.b, contact.point, contact.normal));
}

// Only counts. A threshold is passed if two thirds of it are approached and all of it is the change of the
// lighter body's velocity. Surfaces that part no faster than resting bodies do are at rest.
void FedContacts::passOver(const TouchingPairs::Name& pair, const FedContact& contact, double speed,
                           double impulse) {
    CollisionCatcher& catcher = events_.catcher();
    const KnownFixture &a = events_.fixtures()[pair.a], &b = events_.fixtures()[pair.b];
    const double lighter = std::min(a.movableMassKg(), b.movableMassKg());
    const double change = std::isfinite(impulse) ? impulse / lighter : 0.0;
    catcher.passOver(pair.a, pair.b, std::max(0.0, std::min(1.5 * speed, change)));
    if (!std::isfinite(lighter) || !catcher.touchesSource(pair.a, pair.b)) return;
    ContactCounts& tally = catcher.tally();
    if (catcher.isCollision(std::max(a.gravityScale(), b.gravityScale()), -speed)) {
        ++tally.parting;
        tally.fastestParting = std::max(tally.fastestParting, -speed);
    } else if (speed == 0.0 && !contact.approachMetresPerSecond && !(impulse > 0.0)) {
        ++tally.motionless;
    }
}

void FedContacts::strike(const FedContact& contact, double pushed) {
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
    if (!(impulse > 0.0 && std::isfinite(impulse))) { // they separate, or neither can be moved
        passOver(pair, contact, told, 0.0);
        return contact.isSoft ? load(contact) : void();
    }
    // With an impulse alone, the speed is the change of the lighter body's velocity, which is at least the
    // speed before.
    const bool isSpeedKnown = contact.approachMetresPerSecond || !isImpulseTold || told > 0.0;
    const double speed = isSpeedKnown ? told : impulse / std::min(a.movableMassKg(), b.movableMassKg());
    if (!catcher.isCollision(std::max(a.gravityScale(), b.gravityScale()), speed)) {
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
void FedContacts::addFriction(Collision& collision, const FedContact& contact, std::int32_t a,
                              float share) noexcept {
    collision.frictionNewtonSeconds += (collision.a == a ? share : -share) * contact.frictionNewtonSeconds;
}

void FedContacts::load(const FedContact& contact) {
    if (!contact.impulseNewtonSeconds || !events_.catcher().hasSources()) return;
    const TouchingPairs::Name pair = nameOf(contact);
    rub(contact, pair);
    if (!events_.catcher().isRelevant(pair)) return;
    const auto along = static_cast<float>(*contact.impulseNewtonSeconds),
               across = static_cast<float>(contact.tangentialNewtonSeconds);
    const Vector3 inPlane = along * contact.normal + across * physvib::inPlane(contact.normal).turnedLeft();
    events_.catcher().push(pair, inPlane + contact.frictionNewtonSeconds, contact.point);
}

void FedContacts::rub(const FedContact& contact, const TouchingPairs::Name& pair) {
    if (!contact.alongAMetresPerSecond || !contact.alongBMetresPerSecond ||
        !events_.lasting().isRelevant(pair.a, pair.b))
        return;
    rubs_.tell({pair.a, pair.b, *contact.impulseNewtonSeconds, contact.point, *contact.alongAMetresPerSecond,
                *contact.alongBMetresPerSecond});
}

// The gap between the surfaces closes, or has closed, at the speed at which they approach.
double FedContacts::fractionOf(const FedContact& contact, double approachMetresPerSecond) const noexcept {
    if (contact.fraction) return *contact.fraction;
    const double ahead = approachMetresPerSecond > 0.0 ? contact.gapMetres / approachMetresPerSecond : 0.0;
    const double now = events_.stepSeconds();
    const double seconds = contact.gapFraction * now + ahead;
    const double length = seconds < 0.0 ? lastStepSeconds_ : now;
    return length > 0.0 ? std::clamp(seconds / length, -1.0, 1.0) : 0.0;
}

TouchingPairs::Name FedContacts::nameOf(const FedContact& contact) {
    const std::int32_t a = slotOf(contact.a), b = slotOf(contact.b);
    return {a, b, events_.catcher().know(a, b)};
}

} // namespace physvib
