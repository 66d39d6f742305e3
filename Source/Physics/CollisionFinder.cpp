// SPDX-License-Identifier: MIT
// Evaluates Box2D's contact callbacks: new contact points that approach fast are collisions, all other
// impulses are load.
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

std::uint64_t partOf(const b2Contact& contact) noexcept {
    const auto child = [](int index) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(index));
    };
    return (child(contact.GetChildIndexA()) << 40U ^ child(contact.GetChildIndexB()) << 16U) *
           0x9E3779B97F4A7C15U;
}

bool isIn(unsigned mask, int point) noexcept { return (mask >> point & 1U) != 0; }

/// The larger factor of the two bodies, computed as in KnownFixture.
float gravityScaleOf(const b2Contact& contact) noexcept {
    const auto of = [](const b2Body& body) {
        return body.GetType() == b2_dynamicBody ? std::abs(body.GetGravityScale()) : 0.0F;
    };
    return std::max(of(bodyA(contact)), of(bodyB(contact)));
}

/// Speed at which B approaches A at a point; the normal points from A to B.
double approach(const b2Contact& contact, b2Vec2 point, b2Vec2 normal) {
    const b2Vec2 velocity = bodyB(contact).GetLinearVelocityFromWorldPoint(point) -
                            bodyA(contact).GetLinearVelocityFromWorldPoint(point);
    return -b2Dot(velocity, normal);
}

} // namespace

std::int32_t CollisionFinder::find(const b2Fixture& fixture) {
    const std::int32_t slot = events_.fixtures().find(idOf(fixture));
    if (slot == FixtureTable::none || events_.fixtures()[slot].body.body == idOf(*fixture.GetBody()))
        return slot;
    forgetContacts();
    events_.release(slot);
    return FixtureTable::none;
}

CollisionFinder::Known* CollisionFinder::search(const b2Contact& contact) {
    const std::int32_t a = find(*contact.GetFixtureA()), b = find(*contact.GetFixtureB());
    if (a == FixtureTable::none || b == FixtureTable::none) return nullptr;
    return &remember(contact, {.a = a, .b = b});
}

CollisionFinder::Known& CollisionFinder::remember(const b2Contact& contact, Pair pair) {
    std::int32_t at = knownAt_.find(idOf(contact));
    if (at == IntegerMap::none) {
        if (free_.empty()) addPlaces(2 * known_.size());
        at = free_.back();
        free_.pop_back();
        knownAt_.set(idOf(contact), at);
    }
    Known& known = known_[static_cast<std::size_t>(at)];
    known = {&contact, contact.GetFixtureA(),   contact.GetFixtureB(), pair,
             0,        pairKey(pair.a, pair.b), partOf(contact),       known.after};
    return known;
}

void CollisionFinder::forget(const b2Contact& contact) noexcept {
    const std::int32_t at = knownAt_.find(idOf(contact));
    if (at == IntegerMap::none) return;
    knownAt_.erase(idOf(contact));
    known_[static_cast<std::size_t>(at)].contact = nullptr;
    free_.push_back(at);
}

// The lowest place is taken first, so that those in use lie together.
void CollisionFinder::addPlaces(std::size_t all) {
    free_.reserve(all);
    for (std::size_t at = all; at > known_.size(); --at) free_.push_back(static_cast<std::int32_t>(at - 1));
    known_.resize(all);
    begun_ = nullptr; // it may have moved
}

void CollisionFinder::forgetContacts() noexcept {
    known_.clear();
    free_.clear();
    addPlaces(known_.capacity()); // nothing is allocated
    knownAt_.clear();
}

std::int32_t CollisionFinder::know(const b2Fixture& fixture) {
    const std::int32_t slot = find(fixture); // a fixture that reuses the address of a destroyed one gets new
                                             // state
    const BodyFacts body = factsOf(*fixture.GetBody());
    return slot == FixtureTable::none ? events_.know(idOf(fixture), body) : events_.know(slot, body);
}

CollisionFinder::Known& CollisionFinder::know(const b2Contact& contact) {
    const std::int32_t a = know(*contact.GetFixtureA()), b = know(*contact.GetFixtureB());
    return remember(contact, {.a = a, .b = b});
}

void CollisionFinder::begin(const b2Contact& contact, bool isFollowed) {
    if (!isSolid(contact) || !contact.IsTouching()) return;
    Known& known = know(contact);
    known.pair.number = events_.catcher().begin(known.pair.a, known.pair.b);
    begun_ = isFollowed ? &known : nullptr;
}

void CollisionFinder::end(const b2Contact& contact) {
    fresh_.forget(contact);
    Known* const found = find(contact);
    const Pair pair = found != nullptr ? pairOf(*found) : Pair{};
    forget(contact);
    if (found == nullptr) return;
    const BodyMotion motionA = motionOf(bodyA(contact)), motionB = motionOf(bodyB(contact));
    if (!bodyA(contact).GetWorld()->IsLocked()) {
        events_.cut(pair.a, pair.b, motionA, motionB);
    } else if (ContactEnd* const end = events_.catcher().end(pair)) {
        end->fraction = fractionOf(contact);
        end->motionA = motionA;
        end->motionB = motionB;
    }
}

void CollisionFinder::look(const b2Contact& contact, const b2Manifold& before) {
    Known* const begun = std::exchange(begun_, nullptr);
    if (const unsigned fresh = fresh_.look(contact, before, events_.catcher().isStepping()); fresh != 0)
        meet(contact, fresh, begun != nullptr && begun->contact == &contact ? begun : nullptr);
}

// `begun`: the contact's entry if it began just now; else null.
void CollisionFinder::meet(const b2Contact& contact, unsigned fresh, Known* begun) {
    if (!contact.IsEnabled() || !events_.catcher().hasSources()) return;
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    double fastest = 0.0;
    for (int i = 0; i < contact.GetManifold()->pointCount; ++i)
        if (isIn(fresh, i))
            fastest = std::max(fastest, approach(contact, manifold.points[i], manifold.normal));
    if (!events_.catcher().isCollision(gravityScaleOf(contact), fastest)) return passOver(contact, fastest);
    const Pair& pair = pairOf(begun != nullptr ? *begun : know(contact));
    if (events_.catcher().collision(pair) != nullptr) return;
    if (Collision* collision = events_.catcher().strike(pair, fastest))
        describe(contact, manifold, fresh, *collision);
}

void CollisionFinder::passOver(const b2Contact& contact, double approachMetresPerSecond) {
    if (!events_.catcher().mayBeRelevant(idOf(*contact.GetFixtureA()), idOf(*contact.GetFixtureB()))) return;
    if (const Known* const known = find(contact)) // two thirds of the threshold let it pass
        events_.catcher().passOver(known->pair.a, known->pair.b, 1.5 * approachMetresPerSecond);
}

void CollisionFinder::describe(const b2Contact& contact, const b2WorldManifold& manifold, unsigned fresh,
                               Collision& collision) const {
    const int count = contact.GetManifold()->pointCount;
    int deepest = isIn(fresh, 0) ? 0 : 1;
    const bool isFlat = count > 1 && isIn(fresh, 0) && isIn(fresh, 1);
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
    collision.fraction = momentOf(contact, speed > 0.0 ? depth / speed : 0.0);
}

// Surfaces sink into each other in the step before, so its length counts. Outside a reported step there is no
// time.
double CollisionFinder::momentOf(const b2Contact& contact, double secondsAgo) const noexcept {
    if (!events_.catcher().isStepping()) return 0.0;
    const double now = sweeps_.stepSeconds(), before = sweeps_.lastStepSeconds();
    // deeper: the contact was made at its start
    const double seconds = fractionOf(contact) * now - std::min(secondsAgo, std::max(now, before));
    const double length = seconds < 0.0 ? before : now;
    return length > 0.0 ? std::max(-1.0, seconds / length) : 0.0;
}

double CollisionFinder::fractionOf(const b2Contact& contact) const noexcept {
    if (!events_.catcher().isStepping()) return 0.0;
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
/// each when it is asked for.
class SolvedContact {
public:
    explicit SolvedContact(const b2Contact& contact) noexcept
        : manifold_{*contact.GetManifold()}
        , isTurned_{manifold_.type == b2Manifold::e_faceB}
        , first_{isTurned_ ? *contact.GetFixtureB() : *contact.GetFixtureA()}
        , second_{isTurned_ ? *contact.GetFixtureA() : *contact.GetFixtureB()} {
        if (manifold_.type != b2Manifold::e_circles) {
            normal_ = b2Mul(first_.GetBody()->GetTransform().q, manifold_.localNormal);
            return;
        }
        normal_.Set(1.0F, 0.0F);
        const b2Vec2 one = centreA(), other = centreB();
        if (b2DistanceSquared(one, other) <= b2_epsilon * b2_epsilon) return;
        normal_ = other - one;
        normal_.Normalize();
    }

    b2Vec2 normal() const noexcept { return isTurned_ ? -normal_ : normal_; } ///< from A to B
    bool isDiscs() const noexcept { return manifold_.type == b2Manifold::e_circles; }
    bool isTurned() const noexcept { return isTurned_; } ///< the face is B's
    const b2Fixture& first() const noexcept { return first_; }
    const b2Fixture& second() const noexcept { return second_; }

    /// Of two discs, or of a disc and a corner; and the point between them.
    b2Vec2 centreA() const noexcept { return b2Mul(first_.GetBody()->GetTransform(), manifold_.localPoint); }
    b2Vec2 centreB() const noexcept {
        return b2Mul(second_.GetBody()->GetTransform(), manifold_.points[0].localPoint);
    }
    b2Vec2 pointOfDiscs() const noexcept {
        const b2Vec2 onA = centreA() + first_.GetShape()->m_radius * normal_,
                     onB = centreB() - second_.GetShape()->m_radius * normal_;
        return 0.5F * (onA + onB);
    }
    /// Fills in a point on a face, whose place is computed when it is asked for.
    void note(int i, FaceTouch& touch) const noexcept {
        touch.face = frameOf(first_);
        touch.other = frameOf(second_);
        touch.normal = toVector(manifold_.localNormal);
        touch.onFace = toVector(manifold_.localPoint);
        touch.corner = toVector(manifold_.points[i].localPoint);
        touch.faceRadius = first_.GetShape()->m_radius;
        touch.otherRadius = second_.GetShape()->m_radius;
    }
    /// The impulse on B, N s, of all points except those in the mask `without`.
    [[gnu::always_inline]] Vector2 push(const b2ContactImpulse& impulse, unsigned without) const noexcept {
        static_assert(b2_maxManifoldPoints == 2);
        const b2Vec2 out = normal(), tangent = b2Cross(out, 1.0F);
        b2Vec2 onB{0.0F, 0.0F};
        const auto add = [&](int i) {
            if (!isIn(without, i))
                onB += impulse.normalImpulses[i] * out + impulse.tangentImpulses[i] * tangent;
        };
        add(0);
        if (impulse.count > 1) add(1);
        return toVector(onB);
    }

private:
    const b2Manifold& manifold_;
    bool isTurned_;
    const b2Fixture &first_, &second_; // the face and what touches it, or A and B
    b2Vec2 normal_;
};

/// Position of the point on a disc's circumference in that direction, and its speed if the direction rotates
/// at `radiansPerSecond`; 0 on a corner.
SurfacePath around(const b2Fixture& disc, b2Vec2 direction, float radiansPerSecond) {
    const b2Shape& shape = *disc.GetShape();
    if (shape.m_type != b2Shape::e_circle) return {};
    return aroundDisc(shape.m_radius, frameOf(disc).turnedBack(toVector(direction)),
                      radiansPerSecond - disc.GetBody()->GetAngularVelocity());
}

} // namespace

// Impulses at new points belong to the collision, if there is one; all others are load.
void CollisionFinder::solve(const b2Contact& contact, const b2ContactImpulse& impulse, Known& known) {
    CollisionCatcher& catcher = events_.catcher();
    const unsigned fresh = fresh_.solved(contact); // the points are old from the next step on
    const Pair& pair = pairOf(known);
    const TouchingPairs::Pair& stored = catcher[pair];
    known.load = std::max(stored.load, 0);
    const unsigned traits = events_.fixtures().traits(pair.a) | events_.fixtures().traits(pair.b);
    const bool isOfSource = (traits & FixtureTable::source) != 0;
    const bool isRelevant = isOfSource || stored.last != TouchingPairs::none;
    Collision* const collision = fresh != 0 ? catcher.collision(pair) : nullptr;
    if (!isRelevant && collision == nullptr) return;
    const unsigned collisions = collision != nullptr ? fresh : 0U;
    bool isLoaded = false;
    for (int i = 0; i < impulse.count; ++i) {
        isLoaded = isLoaded || !isIn(collisions, i);
        if (!isIn(collisions, i)) continue;
        collision->normalImpulse += static_cast<double>(impulse.normalImpulses[i]);
        collision->tangentialImpulse += static_cast<double>(impulse.tangentImpulses[i]);
    }
    const SolvedContact solved{contact};
    if (isLoaded && isRelevant)
        if (auto* place = catcher.push(pair, stored, isOfSource, solved.push(impulse, collisions))) {
            if (solved.isDiscs())
                place->set(toVector(solved.pointOfDiscs()));
            else
                solved.note(0, place->setFace());
        }
    if (LastingContacts::isRelevant(traits)) // only pairs whose load matters
        tell(contact, impulse, collisions, known);
}

/// One point on a face, which touches there.
inline void CollisionFinder::tellFace(const b2Contact& contact, const b2ContactImpulse& impulse, int i,
                                      const Known& known, const FaceTouch& touch) {
    FacePoint& told = events_.lasting().touchFace();
    const SolvedContact solved{contact};
    const bool isTurned = solved.isTurned();
    const b2Body &face = *solved.first().GetBody(), &other = *solved.second().GetBody();
    told.touch = touch;
    told.face = {toVector(face.GetLinearVelocity()), toVector(face.GetWorldCenter())};
    told.other = {toVector(other.GetLinearVelocity()), toVector(other.GetWorldCenter())};
    told.faceRadiansPerSecond = face.GetAngularVelocity();
    told.otherRadiansPerSecond = other.GetAngularVelocity();
    told.normalNewtonSeconds = impulse.normalImpulses[i];
    told.isTurned = isTurned;
    told.isDiscRough = events_.fixtures().isRough(isTurned ? known.pair.a : known.pair.b) &&
                       solved.second().GetType() == b2Shape::e_circle;
    told.a = known.pair.a;
    told.b = known.pair.b;
    told.pairsKey = known.key;
    told.feature = known.part ^ contact.GetManifold()->points[i].id.key;
}

// Bodies that rest or roll are solved in the order of the last step, so that no search is needed; of a shaken
// box of a hundred, half of the contacts are searched. What is unusual is left to functions that are called
// last, so that the usual contact saves no registers.
void CollisionFinder::onPostSolve(const b2Contact& contact, const b2ContactImpulse& impulse) {
    Known& next = known_.data()[next_];
    if (!next.isOf(contact) || fresh_.mayHave(contact)) [[unlikely]]
        return solveOutOfTurn(contact, impulse);
    last_ = std::exchange(next_, next.after);
    solveKnown(contact, impulse, next);
}

void CollisionFinder::solveOutOfTurn(const b2Contact& contact, const b2ContactImpulse& impulse) {
    if (fresh_.mayHave(contact)) [[unlikely]]
        return solveNew(contact, impulse);
    const CollisionCatcher& catcher = events_.catcher();
    if (!catcher.hasSources() ||
        !catcher.mayBeRelevant(idOf(*contact.GetFixtureA()), idOf(*contact.GetFixtureB())))
        return;
    const std::int32_t at = knownAt_.find(idOf(contact));
    if (at == IntegerMap::none || !known_.data()[at].isOf(contact)) [[unlikely]]
        return solveUnknown(contact, impulse);
    Known& known = known_.data()[at];
    known_.data()[last_].after = static_cast<std::uint32_t>(at);
    last_ = static_cast<std::uint32_t>(at);
    next_ = known.after;
    solveKnown(contact, impulse, known);
}

void CollisionFinder::solveNew(const b2Contact& contact, const b2ContactImpulse& impulse) {
    Known* const known = events_.catcher().hasSources() ? find(contact) : nullptr;
    if (known == nullptr) {
        fresh_.solved(contact);
        return;
    }
    const auto at = static_cast<std::uint32_t>(known - known_.data());
    known->after = std::exchange(known_[last_].after, at); // it comes between two others
    next_ = known->after;
    last_ = at;
    solve(contact, impulse, *known);
}

void CollisionFinder::solveUnknown(const b2Contact& contact, const b2ContactImpulse& impulse) {
    if (Known* const known = search(contact)) solve(contact, impulse, *known);
}

// The usual contact, without a call: its points are old, one of its fixtures is a source, a face touches.
inline void CollisionFinder::solveKnown(const b2Contact& contact, const b2ContactImpulse& impulse,
                                        Known& known) {
    CollisionCatcher& catcher = events_.catcher();
    ChainLoads::Contact* const usual = catcher.loads().usual(known.pair, known.load);
    const unsigned traits = events_.fixtures().traits(known.pair.a) | events_.fixtures().traits(known.pair.b);
    if (usual == nullptr || (traits & FixtureTable::source) == 0) return solve(contact, impulse, known);
    if (contact.GetManifold()->type == b2Manifold::e_circles)
        return solveDiscs(contact, impulse, known, *usual);
    const SolvedContact solved{contact};
    FaceTouch& touch = catcher.push(*usual, solved.push(impulse, 0U)).setFace();
    solved.note(0, touch);
    if (LastingContacts::isRelevant(traits)) tellUsual(contact, impulse, known, touch);
}

// The same of two discs, or a disc and a corner.
void CollisionFinder::solveDiscs(const b2Contact& contact, const b2ContactImpulse& impulse,
                                 const Known& known, ChainLoads::Contact& usual) {
    const SolvedContact solved{contact};
    events_.catcher().push(usual, solved.push(impulse, 0U)).set(toVector(solved.pointOfDiscs()));
    if (events_.lasting().isRelevant(known.pair.a, known.pair.b)) tellDiscs(contact, impulse, known);
}

void CollisionFinder::tellUsual(const b2Contact& contact, const b2ContactImpulse& impulse, const Known& known,
                                const FaceTouch& touch) {
    tellFace(contact, impulse, 0, known, touch);
    if (impulse.count > 1) [[unlikely]]
        tell(contact, impulse, 1U, known);
}

/// Reports the points to LastingContacts, except those in `collisions` (a bit each), which belong to a
/// collision.
void CollisionFinder::tell(const b2Contact& contact, const b2ContactImpulse& impulse, unsigned collisions,
                           const Known& known) {
    const SolvedContact solved{contact};
    for (int i = 0; i < impulse.count; ++i) {
        if (isIn(collisions, i)) continue;
        if (solved.isDiscs()) return tellDiscs(contact, impulse, known);
        FaceTouch touch;
        solved.note(i, touch);
        tellFace(contact, impulse, i, known, touch);
    }
}

/// The point between two discs, or a disc and a corner, lies on the line between the centres.
void CollisionFinder::tellDiscs(const b2Contact& contact, const b2ContactImpulse& impulse,
                                const Known& known) {
    LastingContacts& lasting = events_.lasting();
    const SolvedContact solved{contact};
    const b2Fixture &discA = solved.first(), &discB = solved.second();
    const b2Body &a = *discA.GetBody(), &b = *discB.GetBody();
    const b2Vec2 normal = solved.normal(), centreA = solved.centreA(), centreB = solved.centreB(),
                 velocityA = a.GetLinearVelocityFromWorldPoint(centreA),
                 velocityB = b.GetLinearVelocityFromWorldPoint(centreB), point = solved.pointOfDiscs(),
                 slip = b.GetLinearVelocityFromWorldPoint(point) - a.GetLinearVelocityFromWorldPoint(point);
    const float distance = b2Distance(centreA, centreB);
    const float turn = distance > b2_epsilon ? b2Cross(normal, velocityB - velocityA) / distance : 0.0F;
    const b2Vec2 moved = velocityA + discA.GetShape()->m_radius * b2Cross(turn, normal);
    lasting.touch({known.pair.a, known.pair.b, known.part ^ contact.GetManifold()->points[0].id.key,
                   static_cast<double>(impulse.normalImpulses[0]),
                   static_cast<double>(b2Dot(slip, b2Cross(normal, 1.0F))), toVector(point), toVector(moved),
                   lasting.isRough(known.pair.a) ? around(discA, normal, turn) : SurfacePath{},
                   lasting.isRough(known.pair.b) ? around(discB, -normal, turn) : SurfacePath{}},
                  known.key);
}

} // namespace physvib
