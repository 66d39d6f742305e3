// SPDX-License-Identifier: MIT
// PhysVib for any physics engine: tell which bodies there are and which of them touch, step by step; take
// events.
#pragma once
#include "Contacts/ContactCounts.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/ImpactModel.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/PairSounds.h"
#include "Contacts/Vector2.h"
#include "Core/CollisionEvent.h"
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace physvib {

class FedContacts;

/// What is told of a body, once.
struct FedBody {
    double massKg = 0.0;                ///< 0: what strikes it does not move it (a floor, a wall, a platform)
    double inertiaKgSquareMetres = 0.0; ///< about its centre of mass and the axis across the plane; 0: blows
                                        ///< are taken as if they went through the centre
    double gravityScale = 1.0;          ///< how much of the world's gravity pulls it
};

/// What is wrong with it, and what was expected; empty if it can be used. Any thread.
std::string_view faultOf(const FedBody& body) noexcept;

/// Two bodies touch. Either the impulse is told, or how fast they near each other; if both are, the impulse
/// counts (unless contacts are soft), and the speed says whether it is a blow at all, and when. With neither,
/// the speed is that of the motions told.
struct FedContact {
    static constexpr std::int32_t noPoint = -1; ///< as pointId: the pair is told as a whole
    static constexpr std::int32_t byPlace = -2; ///< as pointId: of an engine that does not number its points

    std::int32_t a = -1;                           ///< a body
    std::int32_t b = -1;                           ///< the other
    Vector2 point;                                 ///< m, in the plane of the field
    Vector2 normal{0.0F, 1.0F};                    ///< of length 1, from a to b
    std::optional<double> impulseNewtonSeconds;    ///< along the normal, in this step
    double tangentialNewtonSeconds = 0.0;          ///< to the left of the normal; only with an impulse
    std::optional<double> approachMetresPerSecond; ///< before the engine's solver
    double restitution = 0.0;                      ///< 0 to 1, of the pair; where no impulse is told
    std::optional<double> effectiveMassKg; ///< where no impulse is told; else by the masses, inertias and
                                           ///< centres told

    /// When they touched, in steps after the start of this one: -1 (start of the step before) to 1. If it is
    /// not told, it follows from the gap between the surfaces (m, less than 0: they overlap) at the moment
    /// when the engine looked, and from the speed.
    std::optional<double> fraction;
    double gapMetres = 0.0;   ///< between the surfaces; below 0: they overlap
    double gapFraction = 0.0; ///< that moment in steps: 0 (before bodies are moved) to 1 (after)

    /// Of an engine whose contacts take several steps to turn a body round, or push overlaps apart: what it
    /// pushes in a step is no measure of a blow. Speed and restitution are; the impulse is what a pair that
    /// goes on touching hands on.
    bool isSoft = false;
    /// Of a soft one: all that the engine gave the bodies in this step is told as its impulse. Where that is
    /// clearly more than speed and masses say (what is struck stands on something, hangs in joints, or
    /// carries others), it is the blow.
    bool isPushWhole = false;

    /// Of what goes on touching a rough surface (HapticFixture::texture), with its impulse: how fast the
    /// point of contact moves along each of the two surfaces, m/s. Rolling: both alike; sliding: 0 along what
    /// drags its own point. Both, or it is not felt; nullopt: unknown.
    std::optional<double> alongAMetresPerSecond, alongBMetresPerSecond; ///< along its own surface

    /// Which point of its pair it is: a number of the engine's (>= 0), `byPlace`, or `noPoint`. A point that
    /// was not there in the step before and nears fast is a blow even while its pair touches (a pole that
    /// topples, a crate that rocks).
    std::int32_t pointId = noPoint;

    /// The impulses are those of the whole pair, told with each of its points: what new points have of it
    /// follows from their speeds.
    bool isImpulseOfPair = false;
};

/// The catcher for engines that we do not know; bodies are numbers (>= 0), and stand in events as such. Each
/// step: beginStep, move() whatever moved (only where speeds, places or turning blows are to follow from it),
/// touch() every pair that touches, or begin, push and end it, endStep; then take. Impulses as for Box2D (see
/// CollisionCatcher), by onset; points of a pair whose impulses are not told are solved together, so that a
/// flat landing is one blow however many points it has. Nothing is changed by what is refused. All methods:
/// the world's thread (M). None allocates once it has seen as much as it will, but where the caller's vector
/// grows. None throws but for the constructor, configure and want of memory.
class ContactFeed final {
public:
    /// Throws std::invalid_argument if a setting is out of range; the timing is onset.
    explicit ContactFeed(const ImpactSettings& settings = {});
    ~ContactFeed();
    ContactFeed(const ContactFeed&) = delete;
    ContactFeed& operator=(const ContactFeed&) = delete;

    /// Takes effect with the next step. Throws as the constructor does.
    void configure(const ImpactSettings& settings);
    /// Any thread but while it is stepped.
    const ImpactSettings& settings() const noexcept;

    /// A body, at first or again. What is wrong with it; empty: it is set. Each of the following says so.
    std::string_view set(std::int32_t id, const FedBody& body, const HapticFixture& values);

    /// Centre of mass, and motion before the engine's solver.
    std::string_view move(std::int32_t id, Vector2 centre, const BodyMotion& motion);

    /// Motion behind the engine's solver, within a step and before its contacts are told, for engines that do
    /// not tell impulses: where both bodies of a soft contact, or of one without an impulse, tell it, the
    /// impulses follow from their momentum (a blow of a soft one from its speed, as ever). `move` has the
    /// velocity then that the body would have without contacts, so with what gravity adds in the step.
    std::string_view moved(std::int32_t id, const BodyMotion& motion);

    /// A body that goes: what it felt and gave so far stays, or not (ImpactSettings::keepsHitsOfDestroyed).
    /// Not within a step.
    std::string_view remove(std::int32_t id);

    /// Empty, or what is wrong with it: see PairSounds.
    std::string_view setPair(int surface, int other, const PairSound& sound);

    /// The step ends at `endNs` (not before timeNs()); gravity, m/s^2, says what a resting body is pushed by.
    std::string_view beginStep(std::int64_t endNs, double gravityMetresPerSecond2);

    /// For engines that are asked in each step what touches: a pair that did not in the step before begins,
    /// one that is not named again has ended. Several points of a pair are several calls.
    std::string_view touch(const FedContact& contact);

    /// For engines that tell: parts that were apart meet. A pair may do so again while it touches, with
    /// another corner.
    std::string_view begin(const FedContact& contact);
    /// What a pair that goes on touching pushes in this step: how blows are handed on.
    std::string_view push(const FedContact& contact);
    std::string_view end(std::int32_t a, std::int32_t b); ///< A pair has parted.

    std::string_view endStep(); ///< All that touches has been told.

    std::int64_t timeNs() const noexcept; ///< After the steps done.
    /// No event before it is still to come.
    std::int64_t settledNs() const noexcept;
    /// Those before settledNs(), in time order, to the end of `events`.
    void take(std::vector<CollisionEvent>& events);
    void flush(std::vector<CollisionEvent>& events); ///< All of them.
    /// Hits lost because more came in a step than there is room for.
    std::uint64_t drops() const noexcept;
    /// Hits left out by ImpactSettings::hitsPerStep.
    std::uint64_t overBudget() const noexcept;
    /// Grains left out, their power being in the others.
    std::uint64_t thinned() const noexcept;
    /// What became of all contacts so far; see explain().
    ContactCounts counts() const noexcept;
    /// How hard a hit is felt.
    const ImpactModel& impactModel() const noexcept;

private:
    std::unique_ptr<FedContacts> contacts_; // what it is made of, which is not installed
};

} // namespace physvib
