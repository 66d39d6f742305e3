// SPDX-License-Identifier: MIT
// PhysVib for any physics engine: callers report bodies and contacts, step by step, and get events.
#pragma once
#include "Contacts/ContactCounts.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/ImpactSettings.h"
#include "Contacts/Vectors.h"
#include "Core/CollisionEvent.h"
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace physvib {

class ReportedContacts;

/// What the caller reports of a body, once.
struct FedBody {
    double massKg = 0.0;                ///< 0: what strikes it does not move it (a floor, a wall, a platform)
    double inertiaKgSquareMetres = 0.0; ///< about its centre of mass and the axis across the plane; in space
                                        ///< about every axis, unless moveInSpace() says more; 0: impacts
                                        ///< count as if they went through the centre
    double gravityScale = 1.0;          ///< how much of the world's gravity pulls it
};

/// The error of a value, with what was expected; empty if all are valid. Any thread.
std::string_view errorOf(const FedBody& body) noexcept;

/// Two bodies touch. Report the impulse, or the speed at which they approach each other. With both, the
/// impulse says how hard the impact is (unless contacts are soft), and the speed says whether it is an impact
/// at all, and when. With neither, the speed follows from the reported motions.
struct FedContact {
    static constexpr std::int32_t noPoint = -1; ///< as pointId: the pair is reported as a whole
    static constexpr std::int32_t byPlace = -2; ///< as pointId: of an engine that does not number its points
    static constexpr double latestFraction = 2.0; ///< see fraction

    std::int32_t a = -1;                        ///< a body
    std::int32_t b = -1;                        ///< the other
    Vector3 point;                              ///< m; z: across the plane of the field
    Vector3 normal{0.0F, 1.0F, 0.0F};           ///< of length 1, from a to b
    std::optional<double> impulseNewtonSeconds; ///< along the normal, in this step
    double tangentialNewtonSeconds = 0.0;       ///< to the left of the normal, of engines in the plane;
                                                ///< only with an impulse
    Vector3 frictionNewtonSeconds;              ///< on b, across the normal, of engines in space, instead of
                                                ///< tangentialNewtonSeconds; only with an impulse
    std::optional<double> approachMetresPerSecond; ///< before the engine's solver
    double restitution = 0.0;                      ///< 0 to 1, of the pair; used where no impulse is reported
    std::optional<double> effectiveMassKg; ///< used where no impulse is reported; without it, it follows
                                           ///< from the reported masses, inertias and centres

    /// When they touch, in steps after the start of this one: -1 (start of the step before) to 2 (an engine
    /// that looks ahead pushes before they meet). Without it, the moment follows from the gap between the
    /// surfaces when the engine measured it, and the speed.
    std::optional<double> fraction;
    double gapMetres = 0.0;   ///< between the surfaces; below 0: they overlap
    double gapFraction = 0.0; ///< when gapMetres counts, in steps: 0 (before bodies are moved) to 1 (after)

    /// True if contacts of the engine take several steps to reverse a body, or push overlaps apart. Its
    /// impulse of one step does not say how hard an impact is; speed and restitution do. The impulse is then
    /// the load that a pair passes on while it goes on touching.
    bool isSoft = false;
    /// True for a soft contact whose reported impulse is all that the engine gave in this step. Where
    /// that is clearly more than speed and masses say (the struck body stands on something, hangs in joints,
    /// or carries others), it is the impulse of the impact.
    bool isPushWhole = false;

    /// For contacts that last on a rough surface (HapticFixture::texture), with their impulse: how fast the
    /// point of contact moves along each of the two surfaces, m/s. Rolling: both are equal. Sliding: 0 along
    /// the surface that drags its own point. Without both numbers the texture is not felt.
    std::optional<double> alongAMetresPerSecond, alongBMetresPerSecond; ///< along its own surface

    /// Which point of its pair it is: a number of the engine's (>= 0), `byPlace`, or `noPoint`. A new
    /// point that approaches fast is an impact even while its pair touches (a pole that topples, a crate that
    /// rocks). So is one that lasts and is suddenly approached (a flipper under a resting ball).
    std::int32_t pointId = noPoint;

    /// The impulses are those of the whole pair, reported with each of its points. The share of new points
    /// follows from their speeds.
    bool isImpulseOfPair = false;
};

/// Turns reported contacts into events. Bodies are numbers (>= 0), which stand in the events. Each step:
/// beginStep; move() for each body that moved (needed only where speeds, places or rotation are to follow
/// from it); touch() for each pair that touches, or begin, push and end; endStep; then take. Impulses are
/// those of the onset. Points of a pair without reported impulses are solved together, so that a flat landing
/// is one impact, however many points it has. A refused call changes nothing.
///
/// All methods: world thread (M). None allocates after a step with as many bodies and contacts, except where
/// the caller's vector grows. Only the constructor and configure throw, except for lack of memory.
class ContactFeed final {
public:
    /// Throws std::invalid_argument if a setting is out of range; the timing is onset.
    explicit ContactFeed(const ImpactSettings& settings = {});
    ~ContactFeed();
    ContactFeed(const ContactFeed&) = delete;
    ContactFeed& operator=(const ContactFeed&) = delete;

    /// Takes effect with the next step. Throws as the constructor does.
    void configure(const ImpactSettings& settings);
    /// Any thread, but not while the feed is stepped.
    const ImpactSettings& settings() const noexcept;

    /// Adds a body, or changes it. Returns the error, or an empty text, as all calls that return one.
    std::string_view set(std::int32_t id, const FedBody& body, const HapticFixture& values);

    /// The mass of a body as it is now, kg; its inertia changes by as much.
    std::string_view setMass(std::int32_t id, double massKg);

    /// Centre of mass, and motion before the engine's solver.
    std::string_view move(std::int32_t id, Vector2 centre, const BodyMotion& motion);
    /// move() in space. `inverse`: of its moments of inertia as it is turned now; without it,
    /// FedBody::inertiaKgSquareMetres counts about every axis, as of a ball.
    std::string_view moveInSpace(std::int32_t id, Vector3 centre, const SpaceMotion& motion,
                                 const std::optional<InverseInertia>& inverse = {});

    /// Motion after the engine's solver, for engines that report no impulses; call it within a step, before
    /// the step's contacts. Where both bodies of a soft contact, or of one without an impulse, have it, the
    /// impulses follow from their momentum; how hard a soft impact is still follows from its speed. `move`
    /// then has the velocity without contacts: with what gravity adds in the step.
    std::string_view moved(std::int32_t id, const BodyMotion& motion);
    /// moved() in space.
    std::string_view movedInSpace(std::int32_t id, const SpaceMotion& motion);

    /// Removes a body, not within a step. Its events so far stay, or not
    /// (ImpactSettings::keepsHitsOfDestroyed).
    std::string_view remove(std::int32_t id);

    /// Sets the sound of a pair of surface kinds, see PairSounds. Returns the error, or empty.
    std::string_view setPair(int surface, int other, const PairSound& sound);

    /// The step ends at `endNs` (not before timeNs()). Gravity, m/s^2, tells resting contacts from impacts.
    std::string_view beginStep(std::int64_t endNs, double gravityMetresPerSecond2);

    /// For engines that list what touches in each step. A pair that is new in the list begins, one that is
    /// missing has ended. Several points of a pair are several calls.
    std::string_view touch(const FedContact& contact);

    /// For engines that report changes: a pair begins to touch. Call it again for another of its corners.
    std::string_view begin(const FedContact& contact);
    /// The impulse of this step of a pair that goes on touching: how impacts pass through it.
    std::string_view push(const FedContact& contact);
    std::string_view end(std::int32_t a, std::int32_t b); ///< The pair no longer touches.

    std::string_view endStep(); ///< All contacts of the step were reported.

    std::int64_t timeNs() const noexcept; ///< World time after the last step.
    /// Time before which all events are final, ns.
    std::int64_t settledNs() const noexcept;
    /// Appends the events before settledNs(), in time order.
    void take(std::vector<CollisionEvent>& events);
    void flush(std::vector<CollisionEvent>& events); ///< Appends all events.
    /// Impacts lost because more came in a step than there is room for.
    std::uint64_t drops() const noexcept;
    /// Impacts left out by ImpactSettings::hitsPerStep.
    std::uint64_t overBudget() const noexcept;
    /// Grains left out so far by thinning; the others carry their power.
    std::uint64_t thinned() const noexcept;
    /// Counts of all contacts so far; see explain().
    ContactCounts counts() const noexcept;
    /// Counts since the last call of this, or since the beginning: explain(takeRecent(), counts()).
    ContactCounts takeRecent() noexcept;
    /// Notes why the engine lets a body touch nothing, for the next explanation if it is a haptic source.
    std::string_view note(std::int32_t id, EngineNote kind);
    /// From an impulse to an amplitude: the constants of Eq. 5.4.
    const ImpactModel& impactModel() const noexcept;

private:
    std::unique_ptr<ReportedContacts> contacts_; // the implementation, whose header is not installed
};

} // namespace physvib
