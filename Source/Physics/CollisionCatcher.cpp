// SPDX-License-Identifier: MIT
// From contact callbacks to records.
#include "Physics/CollisionCatcher.h"
#include <algorithm>

namespace physvib {

namespace {

std::uint64_t keyOf(const b2Contact& contact) {
    return reinterpret_cast<std::uintptr_t>(&contact);
}

bool isSolid(const b2Contact& contact) {
    return !contact.GetFixtureA()->IsSensor() && !contact.GetFixtureB()->IsSensor();
}

} // namespace

CollisionCatcher::CollisionCatcher(const FixtureTable& table, ContactGraph& graph, b2ContactListener& chained)
    : table_(table)
    , graph_(graph)
    , chained_(chained) {
    records_.reserve(maxDirectRecords + maxDistantRecords);
    ends_.reserve(maxDirectRecords + maxDistantRecords);
}

void CollisionCatcher::meet(const b2Contact& contact) {
    const Ends ends = slotsOf(contact);
    if (isSolid(contact) && contact.IsTouching() && ends.areKnown()) graph_.insert(ends.a, ends.b);
}

void CollisionCatcher::beginStep(const b2World& world, double stepSeconds) {
    stepSeconds_ = stepSeconds;
    loads_.resize(table_.size());
    sweeps_.beginStep(world, stepSeconds);
    isStepping_ = true;
}

void CollisionCatcher::settle() noexcept {
    isStepping_ = false;
    loads_.settle();
}

void CollisionCatcher::endStep() {
    for (const ContactRecord& record : records_) {
        recordOf_.erase(keyOf(*record.contact));
        if (isFelt({record.a, record.b})) loads_.begin(record.a, record.b);
    }
    loads_.endStep(graph_);
    records_.clear();
    ends_.clear();
    directRecords_ = 0;
    order_ = 0;
}

void CollisionCatcher::forget(std::int32_t slot) noexcept {
    const auto isOf = [slot](const auto& noted) { return noted.a == slot || noted.b == slot; };
    for (const ContactRecord& record : records_)
        if (isOf(record)) recordOf_.erase(keyOf(*record.contact));
    std::erase_if(records_, isOf);
    std::erase_if(ends_, isOf);
    loads_.forget(slot);
}

void CollisionCatcher::BeginContact(b2Contact* contact) {
    const Ends ends = slotsOf(*contact);
    if (isSolid(*contact) && ends.areKnown()) {
        graph_.insert(ends.a, ends.b);
        if (isStepping_) note(*contact, ends);
    }
    chained_.BeginContact(contact);
}

void CollisionCatcher::EndContact(b2Contact* contact) {
    const Ends ends = slotsOf(*contact);
    if (ends.areKnown()) {
        graph_.erase(ends.a, ends.b);
        const double fraction = isStepping_ ? fractionOf(ends) : 0.0;
        if (ends_.size() < ends_.capacity()) // without room: felt as if it had not ended in time
            ends_.push_back({ends.a, ends.b, order_++, fraction, motionOf(*contact->GetFixtureA()->GetBody()),
                             motionOf(*contact->GetFixtureB()->GetBody())});
    }
    chained_.EndContact(contact);
}

void CollisionCatcher::PreSolve(b2Contact* contact, const b2Manifold* oldManifold) {
    chained_.PreSolve(contact, oldManifold);
}

void CollisionCatcher::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    const Ends ends = slotsOf(*contact);
    if (isStepping_ && ends.areKnown()) {
        for (const std::int32_t end : {ends.a, ends.b})
            if (table_[end].isDynamic()) sweeps_.solved(table_[end].bodyIndex, *table_[end].body);
        load(*contact, *impulse, ends);
    }
    chained_.PostSolve(contact, impulse);
}

CollisionCatcher::Ends CollisionCatcher::slotsOf(const b2Contact& contact) const noexcept {
    return {table_.find(*contact.GetFixtureA()), table_.find(*contact.GetFixtureB())};
}

bool CollisionCatcher::isFelt(Ends ends) const noexcept {
    return table_[ends.a].values.isCamera || table_[ends.b].values.isCamera;
}

void CollisionCatcher::note(const b2Contact& contact, Ends ends) {
    const bool isDirect = isFelt(ends);
    const std::size_t count = isDirect ? directRecords_ : records_.size() - directRecords_;
    if (count == (isDirect ? maxDirectRecords : maxDistantRecords)) {
        ++drops_;
        return;
    }
    directRecords_ += isDirect ? 1 : 0;
    // The first record of a contact gets all its impulses: one that opens and closes again between the passes
    // of a step is still one hit.
    if (recordOf_.find(keyOf(contact)) == IntegerMap::none)
        recordOf_.set(keyOf(contact), static_cast<std::int32_t>(records_.size()));
    records_.push_back(describe(contact, ends));
    records_.back().order = order_++;
}

ContactRecord CollisionCatcher::describe(const b2Contact& contact, Ends ends) const noexcept {
    const KnownFixture& a = table_[ends.a];
    const KnownFixture& b = table_[ends.b];
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const int count = contact.GetManifold()->pointCount;
    const int deepest = count > 1 && manifold.separations[1] < manifold.separations[0] ? 1 : 0;
    const b2Vec2 touch = manifold.points[deepest];
    const b2Vec2 velocity =
        b.body->GetLinearVelocityFromWorldPoint(touch) - a.body->GetLinearVelocityFromWorldPoint(touch);

    ContactRecord record{};
    record.contact = &contact;
    record.a = ends.a;
    record.b = ends.b;
    // A flat landing touches along a line: its middle, not whichever end is deeper by a rounding.
    record.point = count > 1 ? 0.5F * (manifold.points[0] + manifold.points[1]) : touch;
    record.lighterMassKg = std::min(a.movableMassKg(), b.movableMassKg());
    record.motionA = motionOf(*a.body);
    record.motionB = motionOf(*b.body);
    record.armA = record.point - a.body->GetWorldCenter();
    record.armB = record.point - b.body->GetWorldCenter();

    const double approach = -b2Dot(velocity, manifold.normal); // the normal points from A to B
    const double perStep = approach * stepSeconds_;
    const double depth = std::max(0.0, -static_cast<double>(manifold.separations[deepest]));
    const double stepsAgo = perStep > 0.0 ? std::min(1.0, depth / perStep) : 0.0;
    record.fraction = fractionOf(ends) - stepsAgo;
    return record;
}

double CollisionCatcher::fractionOf(Ends ends) const noexcept {
    const b2Body& a = *table_[ends.a].body;
    const b2Body& b = *table_[ends.b].body;
    const bool aIsFaster = a.GetLinearVelocity().LengthSquared() > b.GetLinearVelocity().LengthSquared();
    const KnownFixture& faster = table_[aIsFaster ? ends.a : ends.b];
    return sweeps_.fraction(faster.bodyIndex, *faster.body);
}

void CollisionCatcher::load(const b2Contact& contact, const b2ContactImpulse& impulse, Ends ends) noexcept {
    if (const std::int32_t known = recordOf_.find(keyOf(contact)); known != IntegerMap::none) {
        ContactRecord& record = records_[static_cast<std::size_t>(known)];
        for (int i = 0; i < impulse.count; ++i) {
            record.normalImpulse += static_cast<double>(impulse.normalImpulses[i]);
            record.tangentialImpulse += static_cast<double>(impulse.tangentImpulses[i]);
        }
        return;
    }
    if (!isFelt(ends)) return;
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const b2Vec2 along = b2Cross(manifold.normal, 1.0F);
    b2Vec2 onB{0.0F, 0.0F};
    for (int i = 0; i < impulse.count; ++i)
        onB += impulse.normalImpulses[i] * manifold.normal + impulse.tangentImpulses[i] * along;
    loads_.add(ends.a, ends.b, onB, manifold.points[0]);
}

} // namespace physvib
