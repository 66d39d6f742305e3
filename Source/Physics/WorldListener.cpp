// SPDX-License-Identifier: MIT
// From contact callbacks to records.
#include "Physics/WorldListener.h"
#include "Physics/WorldNames.h"
#include <algorithm>

namespace physvib {

namespace {

/// The slots of a contact's fixtures.
struct Ends {
    Ends(const b2Contact& contact, const FixtureTable& table) noexcept
        : a(table.find(nameOf(*contact.GetFixtureA())))
        , b(table.find(nameOf(*contact.GetFixtureB()))) {}
    bool areKnown() const noexcept { return a != FixtureTable::none && b != FixtureTable::none; }
    const std::int32_t a, b;
};

bool isSolid(const b2Contact& contact) {
    return !contact.GetFixtureA()->IsSensor() && !contact.GetFixtureB()->IsSensor();
}

} // namespace

void WorldListener::meet(const b2Contact& contact) {
    if (const Ends ends{contact, table_}; isSolid(contact) && contact.IsTouching() && ends.areKnown()) catcher_.meet(ends.a, ends.b);
}

void WorldListener::BeginContact(b2Contact* contact) {
    if (const Ends ends{*contact, table_}; isSolid(*contact) && ends.areKnown())
        if (ContactRecord* record = catcher_.begin(nameOf(*contact), ends.a, ends.b)) describe(*contact, *record);
    chained_.BeginContact(contact);
}

void WorldListener::EndContact(b2Contact* contact) {
    if (const Ends ends{*contact, table_}; ends.areKnown())
        if (ContactEnd* end = catcher_.end(ends.a, ends.b)) {
            end->fraction = catcher_.isStepping() ? fractionOf(ends.a, ends.b) : 0.0;
            end->motionA = motionOf(*contact->GetFixtureA()->GetBody());
            end->motionB = motionOf(*contact->GetFixtureB()->GetBody());
        }
    chained_.EndContact(contact);
}

void WorldListener::PreSolve(b2Contact* contact, const b2Manifold* oldManifold) {
    chained_.PreSolve(contact, oldManifold);
}

void WorldListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    if (const Ends ends{*contact, table_}; catcher_.isStepping() && ends.areKnown()) {
        for (const std::int32_t end : {ends.a, ends.b})
            if (table_[end].isDynamic()) sweeps_.solved(table_[end].facts.bodyIndex, bodyOf(table_[end]));
        push(*contact, *impulse, ends.a, ends.b);
    }
    chained_.PostSolve(contact, impulse);
}

void WorldListener::describe(const b2Contact& contact, ContactRecord& record) const noexcept {
    const KnownFixture& a = table_[record.a];
    const KnownFixture& b = table_[record.b];
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const int count = contact.GetManifold()->pointCount;
    const int deepest = count > 1 && manifold.separations[1] < manifold.separations[0] ? 1 : 0;
    const b2Vec2 touch = manifold.points[deepest];
    const b2Vec2 velocity = bodyOf(b).GetLinearVelocityFromWorldPoint(touch) - bodyOf(a).GetLinearVelocityFromWorldPoint(touch);

    // A flat landing touches along a line: its middle, not whichever end is deeper by a rounding.
    record.point = toVector(count > 1 ? 0.5F * (manifold.points[0] + manifold.points[1]) : touch);
    record.lighterMassKg = std::min(a.movableMassKg(), b.movableMassKg());
    record.motionA = motionOf(bodyOf(a));
    record.motionB = motionOf(bodyOf(b));
    record.armA = record.point - toVector(bodyOf(a).GetWorldCenter());
    record.armB = record.point - toVector(bodyOf(b).GetWorldCenter());

    const double approach = -b2Dot(velocity, manifold.normal); // the normal points from A to B
    const double perStep = approach * sweeps_.stepSeconds();
    const double depth = std::max(0.0, -static_cast<double>(manifold.separations[deepest]));
    const double stepsAgo = perStep > 0.0 ? std::min(1.0, depth / perStep) : 0.0;
    record.fraction = fractionOf(record.a, record.b) - stepsAgo;
}

double WorldListener::fractionOf(std::int32_t a, std::int32_t b) const noexcept {
    const bool aIsFaster = bodyOf(table_[a]).GetLinearVelocity().LengthSquared() > bodyOf(table_[b]).GetLinearVelocity().LengthSquared();
    const KnownFixture& faster = table_[aIsFaster ? a : b];
    return sweeps_.fraction(faster.facts.bodyIndex, bodyOf(faster));
}

void WorldListener::push(const b2Contact& contact, const b2ContactImpulse& impulse, std::int32_t a, std::int32_t b) {
    if (ContactRecord* record = catcher_.begun(nameOf(contact))) {
        for (int i = 0; i < impulse.count; ++i) {
            record->normalImpulse += static_cast<double>(impulse.normalImpulses[i]);
            record->tangentialImpulse += static_cast<double>(impulse.tangentImpulses[i]);
        }
        return;
    }
    if (!catcher_.isFelt(a, b)) return;
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const b2Vec2 along = b2Cross(manifold.normal, 1.0F);
    b2Vec2 onB{0.0F, 0.0F};
    for (int i = 0; i < impulse.count; ++i)
        onB += impulse.normalImpulses[i] * manifold.normal + impulse.tangentImpulses[i] * along;
    catcher_.push(a, b, toVector(onB), toVector(manifold.points[0]));
}

} // namespace physvib
