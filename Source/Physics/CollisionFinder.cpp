// SPDX-License-Identifier: MIT
// Evaluates Box2D's contact callbacks: new contact points that approach fast make a collision, and all other
// impulses are loads.
#include "Physics/CollisionFinder.h"
#include "Physics/WorldBodies.h"
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace physvib {
namespace {

bool isSolid(const b2Contact& contact) {
    return !contact.GetFixtureA()->IsSensor() && !contact.GetFixtureB()->IsSensor();
}

const b2Body& bodyA(const b2Contact& contact) { return *contact.GetFixtureA()->GetBody(); }
const b2Body& bodyB(const b2Contact& contact) { return *contact.GetFixtureB()->GetBody(); }

std::uint64_t partHash(const b2Contact& contact) noexcept {
    const auto child = [](int index) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(index));
    };
    return (child(contact.GetChildIndexA()) << 40U ^ child(contact.GetChildIndexB()) << 16U) *
           0x9E3779B97F4A7C15U;
}

bool isIn(unsigned mask, int point) noexcept { return (mask >> point & 1U) != 0; }

/// The larger factor of the two bodies, computed as in FixtureEntry.
float gravityScaleOf(const b2Contact& contact) noexcept {
    const auto scaleOf = [](const b2Body& body) {
        return body.GetType() == b2_dynamicBody ? std::abs(body.GetGravityScale()) : 0.0F;
    };
    return std::max(scaleOf(bodyA(contact)), scaleOf(bodyB(contact)));
}

/// Speed at which B approaches A at a point; the normal points from A to B.
double approach(const b2Contact& contact, b2Vec2 point, b2Vec2 normal) {
    const b2Vec2 velocity = bodyB(contact).GetLinearVelocityFromWorldPoint(point) -
                            bodyA(contact).GetLinearVelocityFromWorldPoint(point);
    return -b2Dot(velocity, normal);
}

} // namespace

std::int32_t CollisionFinder::findSlot(const b2Fixture& fixture) {
    const std::int32_t slot = events_.fixtures().find(idOf(fixture));
    if (slot == FixtureTable::none || events_.fixtures()[slot].body.body == idOf(*fixture.GetBody()))
        return slot;
    clearCache();
    events_.release(slot);
    return FixtureTable::none;
}

CollisionFinder::CachedContact* CollisionFinder::cacheRegistered(const b2Contact& contact) {
    const std::int32_t a = findSlot(*contact.GetFixtureA()), b = findSlot(*contact.GetFixtureB());
    if (a == FixtureTable::none || b == FixtureTable::none) return nullptr;
    return &cacheEntry(contact, {.a = a, .b = b});
}

CollisionFinder::CachedContact& CollisionFinder::cacheEntry(const b2Contact& contact, Pair pair) {
    std::int32_t index = cacheIndexOf_.find(idOf(contact));
    if (index == IntegerMap::none) {
        if (freeIndices_.empty()) growCache(2 * cachedContacts_.size());
        index = freeIndices_.back();
        freeIndices_.pop_back();
        cacheIndexOf_.set(idOf(contact), index);
    }
    CachedContact& entry = cachedContacts_[static_cast<std::size_t>(index)];
    entry = {&contact, contact.GetFixtureA(),   contact.GetFixtureB(), pair,
             0,        pairKey(pair.a, pair.b), partHash(contact),     entry.nextIndex};
    return entry;
}

void CollisionFinder::dropEntry(const b2Contact& contact) noexcept {
    const std::int32_t index = cacheIndexOf_.find(idOf(contact));
    if (index == IntegerMap::none) return;
    cacheIndexOf_.erase(idOf(contact));
    cachedContacts_[static_cast<std::size_t>(index)].contact = nullptr;
    freeIndices_.push_back(index);
}

// The lowest place is taken first, so that those in use lie together.
void CollisionFinder::growCache(std::size_t capacity) {
    freeIndices_.reserve(capacity);
    for (std::size_t index = capacity; index > cachedContacts_.size(); --index)
        freeIndices_.push_back(static_cast<std::int32_t>(index - 1));
    cachedContacts_.resize(capacity);
    justBegun_ = nullptr; // it may have moved
}

void CollisionFinder::clearCache() noexcept {
    cachedContacts_.clear();
    freeIndices_.clear();
    growCache(cachedContacts_.capacity()); // nothing is allocated
    cacheIndexOf_.clear();
}

std::int32_t CollisionFinder::registeredSlot(const b2Fixture& fixture) {
    const std::int32_t slot = findSlot(fixture); // a fixture that reuses the address of a destroyed one gets
                                                 // new state
    const BodyFacts body = factsOf(*fixture.GetBody());
    return slot == FixtureTable::none ? events_.findOrAdd(idOf(fixture), body)
                                      : events_.updateBody(slot, body);
}

CollisionFinder::CachedContact& CollisionFinder::registeredEntry(const b2Contact& contact) {
    const std::int32_t a = registeredSlot(*contact.GetFixtureA()), b = registeredSlot(*contact.GetFixtureB());
    return cacheEntry(contact, {.a = a, .b = b});
}

void CollisionFinder::begin(const b2Contact& contact, bool isPreSolveNext) {
    if (!isSolid(contact) || !contact.IsTouching()) return;
    CachedContact& entry = registeredEntry(contact);
    entry.pair.number = events_.recorder().begin(entry.pair.a, entry.pair.b);
    justBegun_ = isPreSolveNext ? &entry : nullptr;
}

void CollisionFinder::end(const b2Contact& contact) {
    newPoints_.forget(contact);
    CachedContact* const entry = findEntry(contact);
    const Pair pair = entry != nullptr ? numberedPair(*entry) : Pair{};
    dropEntry(contact);
    if (entry == nullptr) return;
    const BodyMotion motionA = motionOf(bodyA(contact)), motionB = motionOf(bodyB(contact));
    if (!bodyA(contact).GetWorld()->IsLocked()) {
        events_.endOutsideStep(pair.a, pair.b, motionA, motionB);
    } else if (ContactEnd* const end = events_.recorder().end(pair)) {
        end->fraction = fractionOf(contact);
        end->motionA = motionA;
        end->motionB = motionB;
    }
}

void CollisionFinder::updateNewPoints(const b2Contact& contact, const b2Manifold& oldManifold) {
    CachedContact* const newEntry = std::exchange(justBegun_, nullptr);
    if (const unsigned newMask = newPoints_.update(contact, oldManifold, events_.recorder().isStepping());
        newMask != 0)
        checkApproach(contact, newMask,
                      newEntry != nullptr && newEntry->contact == &contact ? newEntry : nullptr);
}

// `newEntry`: the contact's entry if it began just now; else null.
void CollisionFinder::checkApproach(const b2Contact& contact, unsigned newMask, CachedContact* newEntry) {
    if (!contact.IsEnabled() || !events_.recorder().hasSources()) return;
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    double fastest = 0.0;
    for (int i = 0; i < contact.GetManifold()->pointCount; ++i)
        if (isIn(newMask, i))
            fastest = std::max(fastest, approach(contact, manifold.points[i], manifold.normal));
    if (!events_.recorder().isCollision(gravityScaleOf(contact), fastest))
        return countBelowThreshold(contact, fastest);
    const Pair& pair = numberedPair(newEntry != nullptr ? *newEntry : registeredEntry(contact));
    if (events_.recorder().findCollision(pair) != nullptr) return;
    if (Collision* collision = events_.recorder().addCollision(pair, fastest))
        describe(contact, manifold, newMask, *collision);
}

void CollisionFinder::countBelowThreshold(const b2Contact& contact, double approachMetresPerSecond) {
    if (!events_.recorder().mayBeRelevant(idOf(*contact.GetFixtureA()), idOf(*contact.GetFixtureB()))) return;
    if (const CachedContact* const entry = findEntry(contact)) // two thirds of it make a collision
        events_.recorder().countBelowThreshold(entry->pair.a, entry->pair.b, 1.5 * approachMetresPerSecond);
}

// Fills in place, motions and time of a collision, from the deepest of its new points.
void CollisionFinder::describe(const b2Contact& contact, const b2WorldManifold& manifold, unsigned newMask,
                               Collision& collision) const {
    const int count = contact.GetManifold()->pointCount;
    int deepest = isIn(newMask, 0) ? 0 : 1;
    const bool isFlat = count > 1 && isIn(newMask, 0) && isIn(newMask, 1);
    if (isFlat && manifold.separations[1] < manifold.separations[0]) deepest = 1;
    const b2Vec2 touch = manifold.points[deepest];
    // A flat impact touches along a line. Its middle is used, because rounding decides which end is deeper.
    const Vector2 point = toVector(isFlat ? 0.5F * (manifold.points[0] + manifold.points[1]) : touch);
    collision.point = point;
    collision.motionA = motionOf(bodyA(contact));
    collision.motionB = motionOf(bodyB(contact));
    collision.armA = point - toVector(bodyA(contact).GetWorldCenter());
    collision.armB = point - toVector(bodyB(contact).GetWorldCenter());

    const double speed = approach(contact, touch, manifold.normal);
    const double depth = std::max(0.0, -static_cast<double>(manifold.separations[deepest]));
    collision.fraction = touchFractionOf(contact, speed > 0.0 ? depth / speed : 0.0);
}

// The time of touch, in steps after the start of this one. Below 0 it lies in the step before, and counts in
// lengths of that one. Outside a reported step the time is not known: 0.
double CollisionFinder::touchFractionOf(const b2Contact& contact, double secondsAgo) const noexcept {
    if (!events_.recorder().isStepping()) return 0.0;
    const double step = sweeps_.stepSeconds(), lastStep = sweeps_.lastStepSeconds();
    // no contact is older than a step
    const double seconds = fractionOf(contact) * step - std::min(secondsAgo, std::max(step, lastStep));
    const double length = seconds < 0.0 ? lastStep : step;
    return length > 0.0 ? std::max(-1.0, seconds / length) : 0.0;
}

double CollisionFinder::fractionOf(const b2Contact& contact) const noexcept {
    if (!events_.recorder().isStepping()) return 0.0;
    const bool aIsFaster = bodyA(contact).GetLinearVelocity().LengthSquared() >
                           bodyB(contact).GetLinearVelocity().LengthSquared();
    return sweeps_.fraction(aIsFaster ? bodyA(contact) : bodyB(contact));
}

namespace {

Frame frameOf(const b2Fixture& fixture) noexcept {
    static_assert(offsetof(b2Transform, q) == offsetof(Frame, sine) && offsetof(b2Rot, c) == sizeof(float));
    Frame frame;
    float __attribute__((vector_size(sizeof frame))) bits; // a single copy, which a bit_cast is not
    std::memcpy(&bits, &fixture.GetBody()->GetTransform(), sizeof bits);
    std::memcpy(static_cast<void*>(&frame), &bits, sizeof bits);
    return frame;
}

/// Where a contact's bodies touch after the solver: normal and point as b2WorldManifold has them, to the bit,
/// each computed on demand.
class SolvedContact {
public:
    explicit SolvedContact(const b2Contact& contact) noexcept
        : manifold_{*contact.GetManifold()}
        , isFaceOfB_{manifold_.type == b2Manifold::e_faceB}
        , first_{isFaceOfB_ ? *contact.GetFixtureB() : *contact.GetFixtureA()}
        , second_{isFaceOfB_ ? *contact.GetFixtureA() : *contact.GetFixtureB()} {
        if (manifold_.type != b2Manifold::e_circles) {
            normal_ = b2Mul(first_.GetBody()->GetTransform().q, manifold_.localNormal);
            return;
        }
        normal_.Set(1.0F, 0.0F);
        const b2Vec2 a = centreA(), b = centreB();
        if (b2DistanceSquared(a, b) <= b2_epsilon * b2_epsilon) return;
        normal_ = b - a;
        normal_.Normalize();
    }

    b2Vec2 normal() const noexcept { return isFaceOfB_ ? -normal_ : normal_; } ///< from A to B
    bool isDiscs() const noexcept { return manifold_.type == b2Manifold::e_circles; }
    bool isFaceOfB() const noexcept { return isFaceOfB_; } ///< the face is B's
    const b2Fixture& first() const noexcept { return first_; }
    const b2Fixture& second() const noexcept { return second_; }

    /// Centres of two discs, or of a disc and a corner, world; and the point between them.
    b2Vec2 centreA() const noexcept { return b2Mul(first_.GetBody()->GetTransform(), manifold_.localPoint); }
    b2Vec2 centreB() const noexcept {
        return b2Mul(second_.GetBody()->GetTransform(), manifold_.points[0].localPoint);
    }
    b2Vec2 discPoint() const noexcept {
        const b2Vec2 onA = centreA() + first_.GetShape()->m_radius * normal_,
                     onB = centreB() - second_.GetShape()->m_radius * normal_;
        return 0.5F * (onA + onB);
    }
    /// Fills in a point on a face, whose place is computed when it is asked for.
    void fillTouch(int i, FaceTouch& touch) const noexcept {
        touch.face = frameOf(first_);
        touch.other = frameOf(second_);
        touch.normal = toVector(manifold_.localNormal);
        touch.onFace = toVector(manifold_.localPoint);
        touch.corner = toVector(manifold_.points[i].localPoint);
        touch.faceRadius = first_.GetShape()->m_radius;
        touch.otherRadius = second_.GetShape()->m_radius;
    }
    /// The impulse on B, N s, of all points except those in the mask `excluded`.
    [[gnu::always_inline]] Vector2 push(const b2ContactImpulse& impulse, unsigned excluded) const noexcept {
        static_assert(b2_maxManifoldPoints == 2);
        const b2Vec2 out = normal(), tangent = b2Cross(out, 1.0F);
        b2Vec2 onB{0.0F, 0.0F};
        const auto add = [&](int i) {
            if (!isIn(excluded, i))
                onB += impulse.normalImpulses[i] * out + impulse.tangentImpulses[i] * tangent;
        };
        add(0);
        if (impulse.count > 1) add(1);
        return toVector(onB);
    }

private:
    const b2Manifold& manifold_;
    bool isFaceOfB_;
    const b2Fixture &first_, &second_; // the face and what touches it, or A and B
    b2Vec2 normal_;
};

/// Position of the point on a disc's circumference in that direction, and its speed if the direction rotates
/// at `radiansPerSecond`; 0 on a corner.
SurfacePath rimPath(const b2Fixture& disc, b2Vec2 direction, float radiansPerSecond) {
    const b2Shape& shape = *disc.GetShape();
    if (shape.m_type != b2Shape::e_circle) return {};
    return discPath(shape.m_radius, frameOf(disc).turnedBack(toVector(direction)),
                    radiansPerSecond - disc.GetBody()->GetAngularVelocity());
}

} // namespace

// Impulses at new points belong to the collision, if there is one; all others are load.
void CollisionFinder::record(const b2Contact& contact, const b2ContactImpulse& impulse,
                             CachedContact& entry) {
    CollisionRecorder& recorder = events_.recorder();
    const unsigned newMask = newPoints_.markSolved(contact); // the points are old from the next step on
    const Pair& pair = numberedPair(entry);
    const TouchingPairs::Pair& stored = recorder[pair];
    entry.loadIndex = std::max(stored.loadIndex, 0);
    const unsigned traits = events_.fixtures().traits(pair.a) | events_.fixtures().traits(pair.b);
    const bool hasSource = (traits & FixtureTable::source) != 0;
    const bool isRelevant = hasSource || stored.lastIndex != TouchingPairs::none;
    Collision* const collision = newMask != 0 ? recorder.findCollision(pair) : nullptr;
    if (!isRelevant && collision == nullptr) return;
    const unsigned collisionMask = collision != nullptr ? newMask : 0U;
    bool isLoaded = false;
    for (int i = 0; i < impulse.count; ++i) {
        isLoaded = isLoaded || !isIn(collisionMask, i);
        if (!isIn(collisionMask, i)) continue;
        collision->normalNewtonSeconds += static_cast<double>(impulse.normalImpulses[i]);
        collision->tangentialNewtonSeconds += static_cast<double>(impulse.tangentImpulses[i]);
    }
    const SolvedContact solved{contact};
    if (isLoaded && isRelevant)
        if (auto* place = recorder.push(pair, stored, hasSource, solved.push(impulse, collisionMask))) {
            if (solved.isDiscs())
                place->set(toVector(solved.discPoint()));
            else
                solved.fillTouch(0, place->setFace());
        }
    if (LastingContacts::isRelevant(traits)) // a source touches a rough surface
        reportPoints(contact, impulse, collisionMask, entry);
}

/// Reports one point on a face to LastingContacts, with the motion of both bodies.
inline void CollisionFinder::reportFace(const b2Contact& contact, const b2ContactImpulse& impulse, int i,
                                        const CachedContact& entry, const FaceTouch& touch) {
    FacePoint& facePoint = events_.lasting().touchFace();
    const SolvedContact solved{contact};
    const bool isFaceOfB = solved.isFaceOfB();
    const b2Body &face = *solved.first().GetBody(), &other = *solved.second().GetBody();
    facePoint.touch = touch;
    facePoint.face = {toVector(face.GetLinearVelocity()), toVector(face.GetWorldCenter())};
    facePoint.other = {toVector(other.GetLinearVelocity()), toVector(other.GetWorldCenter())};
    facePoint.faceRadiansPerSecond = face.GetAngularVelocity();
    facePoint.otherRadiansPerSecond = other.GetAngularVelocity();
    facePoint.normalNewtonSeconds = impulse.normalImpulses[i];
    facePoint.isFaceOfB = isFaceOfB;
    facePoint.isDiscRough = events_.fixtures().isRough(isFaceOfB ? entry.pair.a : entry.pair.b) &&
                            solved.second().GetType() == b2Shape::e_circle;
    facePoint.a = entry.pair.a;
    facePoint.b = entry.pair.b;
    facePoint.pairsKey = entry.key;
    facePoint.feature = entry.part ^ contact.GetManifold()->points[i].id.key;
}

// Box2D solves the contacts of resting and rolling bodies in the order of the last step, so that no search is
// needed; in a shaken box of a hundred bodies, half of the contacts need one. Rare cases are tail calls, so
// that the common case saves no registers.
void CollisionFinder::onPostSolve(const b2Contact& contact, const b2ContactImpulse& impulse) {
    CachedContact& expected = cachedContacts_.data()[expectedIndex_];
    if (!expected.matches(contact) || newPoints_.mayContain(contact)) [[unlikely]]
        return recordOutOfOrder(contact, impulse);
    solvedIndex_ = std::exchange(expectedIndex_, expected.nextIndex);
    recordCached(contact, impulse, expected);
}

void CollisionFinder::recordOutOfOrder(const b2Contact& contact, const b2ContactImpulse& impulse) {
    if (newPoints_.mayContain(contact)) [[unlikely]]
        return recordNew(contact, impulse);
    const CollisionRecorder& recorder = events_.recorder();
    if (!recorder.hasSources() ||
        !recorder.mayBeRelevant(idOf(*contact.GetFixtureA()), idOf(*contact.GetFixtureB())))
        return;
    const std::int32_t index = cacheIndexOf_.find(idOf(contact));
    if (index == IntegerMap::none || !cachedContacts_.data()[index].matches(contact)) [[unlikely]]
        return recordUncached(contact, impulse);
    CachedContact& entry = cachedContacts_.data()[index];
    cachedContacts_.data()[solvedIndex_].nextIndex = static_cast<std::uint32_t>(index);
    solvedIndex_ = static_cast<std::uint32_t>(index);
    expectedIndex_ = entry.nextIndex;
    recordCached(contact, impulse, entry);
}

void CollisionFinder::recordNew(const b2Contact& contact, const b2ContactImpulse& impulse) {
    CachedContact* const entry = events_.recorder().hasSources() ? findEntry(contact) : nullptr;
    if (entry == nullptr) {
        newPoints_.markSolved(contact);
        return;
    }
    const auto index = static_cast<std::uint32_t>(entry - cachedContacts_.data());
    entry->nextIndex = std::exchange(cachedContacts_[solvedIndex_].nextIndex, index); // between two others
    expectedIndex_ = entry->nextIndex;
    solvedIndex_ = index;
    record(contact, impulse, *entry);
}

void CollisionFinder::recordUncached(const b2Contact& contact, const b2ContactImpulse& impulse) {
    if (CachedContact* const entry = cacheRegistered(contact)) record(contact, impulse, *entry);
}

// The common contact, without a call: its points are old, one of its fixtures is a source, a face touches.
inline void CollisionFinder::recordCached(const b2Contact& contact, const b2ContactImpulse& impulse,
                                          CachedContact& entry) {
    CollisionRecorder& recorder = events_.recorder();
    TransmittedImpulses::Contact* const steady = recorder.impulses().findSteady(entry.pair, entry.loadIndex);
    const unsigned traits = events_.fixtures().traits(entry.pair.a) | events_.fixtures().traits(entry.pair.b);
    if (steady == nullptr || (traits & FixtureTable::source) == 0) return record(contact, impulse, entry);
    if (contact.GetManifold()->type == b2Manifold::e_circles)
        return recordDiscs(contact, impulse, entry, *steady);
    const SolvedContact solved{contact};
    FaceTouch& touch = recorder.push(*steady, solved.push(impulse, 0U)).setFace();
    solved.fillTouch(0, touch);
    if (LastingContacts::isRelevant(traits)) reportSteadyPoints(contact, impulse, entry, touch);
}

// recordCached() for two discs, or for a disc and a corner.
void CollisionFinder::recordDiscs(const b2Contact& contact, const b2ContactImpulse& impulse,
                                  const CachedContact& entry, TransmittedImpulses::Contact& steady) {
    const SolvedContact solved{contact};
    events_.recorder().push(steady, solved.push(impulse, 0U)).set(toVector(solved.discPoint()));
    if (events_.lasting().isRelevant(entry.pair.a, entry.pair.b)) reportDiscs(contact, impulse, entry);
}

void CollisionFinder::reportSteadyPoints(const b2Contact& contact, const b2ContactImpulse& impulse,
                                         const CachedContact& entry, const FaceTouch& touch) {
    reportFace(contact, impulse, 0, entry, touch);
    if (impulse.count > 1) [[unlikely]]
        reportPoints(contact, impulse, 1U, entry);
}

/// Reports the points to LastingContacts, except those in `collisionMask` (a bit each), which belong to a
/// collision.
void CollisionFinder::reportPoints(const b2Contact& contact, const b2ContactImpulse& impulse,
                                   unsigned collisionMask, const CachedContact& entry) {
    const SolvedContact solved{contact};
    for (int i = 0; i < impulse.count; ++i) {
        if (isIn(collisionMask, i)) continue;
        if (solved.isDiscs()) return reportDiscs(contact, impulse, entry);
        FaceTouch touch;
        solved.fillTouch(i, touch);
        reportFace(contact, impulse, i, entry, touch);
    }
}

/// The point between two discs, or a disc and a corner, lies on the line between the centres.
void CollisionFinder::reportDiscs(const b2Contact& contact, const b2ContactImpulse& impulse,
                                  const CachedContact& entry) {
    LastingContacts& lasting = events_.lasting();
    const SolvedContact solved{contact};
    const b2Fixture &discA = solved.first(), &discB = solved.second();
    const b2Body &a = *discA.GetBody(), &b = *discB.GetBody();
    const b2Vec2 normal = solved.normal(), centreA = solved.centreA(), centreB = solved.centreB(),
                 velocityA = a.GetLinearVelocityFromWorldPoint(centreA),
                 velocityB = b.GetLinearVelocityFromWorldPoint(centreB), point = solved.discPoint(),
                 slip = b.GetLinearVelocityFromWorldPoint(point) - a.GetLinearVelocityFromWorldPoint(point);
    const float distance = b2Distance(centreA, centreB);
    const float spin = distance > b2_epsilon ? b2Cross(normal, velocityB - velocityA) / distance : 0.0F;
    const b2Vec2 moved = velocityA + discA.GetShape()->m_radius * b2Cross(spin, normal);
    lasting.touch({entry.pair.a, entry.pair.b, entry.part ^ contact.GetManifold()->points[0].id.key,
                   static_cast<double>(impulse.normalImpulses[0]),
                   static_cast<double>(b2Dot(slip, b2Cross(normal, 1.0F))), toVector(point), toVector(moved),
                   lasting.isRough(entry.pair.a) ? rimPath(discA, normal, spin) : SurfacePath{},
                   lasting.isRough(entry.pair.b) ? rimPath(discB, -normal, spin) : SurfacePath{}},
                  entry.key);
}

} // namespace physvib
