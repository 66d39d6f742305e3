// SPDX-License-Identifier: MIT
// Validates reported bodies and contacts, and passes valid ones to ReportedContacts.
#include "Contacts/ContactFeed.h"
#include "Contacts/ReportedContacts.h"
#include <cmath>
#include <stdexcept>

namespace physvib {

namespace {

constexpr std::string_view unknownBody = "body: expected one that was set";
constexpr std::string_view outsideStep = "step: expected to be within one";
constexpr std::string_view withinStep = "step: expected not to be within one";

bool isFinite(Vector3 v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isFinite(const SpaceMotion& motion) noexcept {
    return isFinite(motion.metresPerSecond) && isFinite(motion.radiansPerSecond);
}

SpaceMotion toSpaceMotion(const BodyMotion& motion) noexcept {
    return {motion.metresPerSecond, {0.0F, 0.0F, motion.radiansPerSecond}};
}

// False for NaN.
bool isWithin(double value, double min, double max) noexcept { return value >= min && value <= max; }

// False for NaN. The tolerance is for engines that round.
bool isUnit(Vector3 v) noexcept { return std::abs(v.length() - 1.0F) < 0.01F; }

const ImpactSettings& requireOnsetTiming(const ImpactSettings& settings) {
    if (settings.timing != ImpactTiming::onset)
        throw std::invalid_argument("timing: expected onset: the end of a reported contact is not known");
    return settings;
}

// Checks the contact's own numbers; the next function looks up its bodies.
std::string_view errorOf(const FedContact& contact) noexcept {
    constexpr double bound = 1.0e12;
    if (contact.a == contact.b) return "bodies: expected two";
    if (!isFinite(contact.point)) return "point: expected numbers";
    if (!isUnit(contact.normal)) return "normal: expected a length of 1";
    if (!isWithin(contact.impulseNewtonSeconds.value_or(0.0), -bound, bound) ||
        !isWithin(contact.tangentialNewtonSeconds, -bound, bound) || !isFinite(contact.frictionNewtonSeconds))
        return "impulse: expected a number of N s";
    if (!isWithin(contact.approachMetresPerSecond.value_or(0.0), -bound, bound))
        return "approach: expected a number of m/s";
    if (!isWithin(contact.restitution, 0.0, 1.0)) return "restitution: expected 0 to 1";
    if (!isWithin(contact.effectiveMassKg.value_or(0.0), 0.0, bound))
        return "effective mass: expected 0 to 10^12 kg";
    if (!isWithin(contact.fraction.value_or(0.0), -1.0, FedContact::latestFraction))
        return "fraction: expected -1 to 2";
    if (!std::isfinite(contact.gapMetres)) return "gap: expected a number of metres";
    if (!isWithin(contact.gapFraction, 0.0, 1.0)) return "fraction of the gap: expected 0 to 1";
    for (const auto& speed : {contact.alongAMetresPerSecond, contact.alongBMetresPerSecond})
        if (!isWithin(speed.value_or(0.0), -bound, bound))
            return "speed along a surface: expected a number of m/s";
    if (contact.pointId < FedContact::byPlace)
        return "point: expected a number from 0 on, -1 (none) or -2 (by place)";
    if (contact.isImpulseOfPair && !contact.impulseNewtonSeconds)
        return "impulse: expected one, as it is said to be the pair's";
    return {};
}

std::string_view errorOf(ReportedContacts& contacts, const FedContact& contact) {
    ContactCounts& tally = contacts.events().recorder().tally();
    if (!contacts.isStepping()) return ++tally.outsideSteps, outsideStep;
    for (const std::int32_t body : {contact.a, contact.b})
        if (!contacts.bodies().has(body)) {
            ++tally.unknownBodies;
            tally.unknownBody = body;
            return unknownBody;
        }
    return errorOf(contact);
}

using Reported = ReportedContacts;
std::string_view report(Reported& contacts, const FedContact& contact,
                        void (Reported::*method)(const FedContact&)) {
    const std::string_view error = errorOf(contacts, contact);
    if (error.empty()) (contacts.*method)(contact);
    return error;
}

} // namespace

std::string_view errorOf(const FedBody& body) noexcept {
    constexpr auto isMass = [](double value) { return value >= 0.0 && value <= 1.0e12; }; // not NaN
    if (!isMass(body.massKg)) return "mass: expected 0 to 10^12 kg";
    if (!isMass(body.inertiaKgSquareMetres)) return "inertia: expected 0 to 10^12 kg m^2";
    if (!(std::abs(body.gravityScale) <= 1.0e6)) return "gravity scale: expected -10^6 to 10^6";
    return {};
}

ContactFeed::ContactFeed(const ImpactSettings& settings)
    : contacts_(std::make_unique<ReportedContacts>(requireOnsetTiming(settings))) {}
ContactFeed::~ContactFeed() = default;

void ContactFeed::configure(const ImpactSettings& settings) {
    contacts_->events().configure(requireOnsetTiming(settings));
}
const ImpactSettings& ContactFeed::settings() const noexcept { return contacts_->events().settings(); }

std::string_view ContactFeed::set(std::int32_t id, const FedBody& body, const HapticFixture& values) {
    if (id < 0) return "body: expected a number from 0 on";
    if (const std::string_view error = physvib::errorOf(body); !error.empty()) return error;
    if (const std::string_view error = physvib::errorOf(values); !error.empty()) return error;
    ReportedBodies& bodies = contacts_->bodies();
    bodies.set(id, body);
    const std::uint64_t fixture = ReportedBodies::idOf(id);
    return contacts_->events().set(fixture, bodies.facts(fixture), {}, values, id).refusal;
}

std::string_view ContactFeed::setMass(std::int32_t id, double massKg) {
    ReportedBodies& bodies = contacts_->bodies();
    if (!bodies.has(id)) return unknownBody;
    FedBody body = bodies.reported(id);
    if (massKg == body.massKg) return {};
    const double inertiaMassKg = bodies.inertiaMassKg(id); // also of a body that stands meanwhile
    if (inertiaMassKg > 0.0 && massKg > 0.0) body.inertiaKgSquareMetres *= massKg / inertiaMassKg;
    body.massKg = massKg;
    if (const std::string_view error = physvib::errorOf(body); !error.empty()) return error;
    bodies.set(id, body, massKg > 0.0 ? massKg : inertiaMassKg);
    const std::uint64_t fixture = ReportedBodies::idOf(id);
    if (const auto slot = contacts_->events().fixtures().find(fixture); slot != FixtureTable::none)
        contacts_->events().updateBody(slot, bodies.facts(fixture));
    return {};
}

std::string_view ContactFeed::move(std::int32_t id, Vector2 centre, const BodyMotion& motion) {
    return moveInSpace(id, centre, toSpaceMotion(motion));
}

std::string_view ContactFeed::moveInSpace(std::int32_t id, Vector3 centre, const SpaceMotion& motion,
                                          const std::optional<InverseInertia>& inverse) {
    if (!contacts_->bodies().has(id)) return unknownBody;
    if (!isFinite(centre)) return "place: expected numbers";
    if (!isFinite(motion)) return "velocity: expected numbers";
    if (inverse && !inverse->isValid())
        return "inverse inertia: expected that of a body (xx, yy, zz, xy, xz, yz; 0 where it cannot turn)";
    contacts_->bodies().move(id, centre, motion, inverse);
    return {};
}

std::string_view ContactFeed::moved(std::int32_t id, const BodyMotion& motion) {
    return movedInSpace(id, toSpaceMotion(motion));
}

std::string_view ContactFeed::movedInSpace(std::int32_t id, const SpaceMotion& motion) {
    if (!contacts_->bodies().has(id)) return unknownBody;
    if (!contacts_->isStepping()) return outsideStep;
    if (!isFinite(motion)) return "velocity: expected numbers";
    contacts_->bodies().setMotionAfter(id, motion);
    return {};
}

std::string_view ContactFeed::remove(std::int32_t id) {
    if (!contacts_->bodies().has(id)) return unknownBody;
    if (contacts_->isStepping()) return withinStep;
    contacts_->remove(id);
    return {};
}

std::string_view ContactFeed::setPair(int surface, int other, const PairSound& sound) {
    return contacts_->events().setPair(surface, other, sound);
}

std::string_view ContactFeed::beginStep(std::int64_t endNs, double gravityMetresPerSecond2) {
    if (contacts_->isStepping()) return withinStep;
    if (endNs < timeNs() || endNs > limits::maxTimeNs)
        return "time: expected not to go back, and less than 10^17 ns";
    if (!isWithin(gravityMetresPerSecond2, 0.0, 1.0e6)) return "gravity: expected 0 to 10^6 m/s^2";
    contacts_->beginStep(endNs, gravityMetresPerSecond2);
    return {};
}

std::string_view ContactFeed::touch(const FedContact& contact) {
    return report(*contacts_, contact, &Reported::touch);
}
std::string_view ContactFeed::begin(const FedContact& contact) {
    return report(*contacts_, contact, &Reported::begin);
}
std::string_view ContactFeed::push(const FedContact& contact) {
    return report(*contacts_, contact, &Reported::push);
}

std::string_view ContactFeed::end(std::int32_t a, std::int32_t b) {
    if (!contacts_->bodies().has(a) || !contacts_->bodies().has(b) || a == b) return unknownBody;
    return contacts_->end(a, b) ? std::string_view{} : "contact: expected one that has begun";
}

std::string_view ContactFeed::endStep() {
    if (!contacts_->isStepping()) return outsideStep;
    contacts_->endStep();
    return {};
}

std::int64_t ContactFeed::timeNs() const noexcept { return contacts_->events().timeNs(); }
std::int64_t ContactFeed::settledNs() const noexcept { return contacts_->events().settledNs(); }
void ContactFeed::take(std::vector<CollisionEvent>& events) { contacts_->events().appendFinal(events); }
void ContactFeed::flush(std::vector<CollisionEvent>& events) { contacts_->events().flush(events); }
std::uint64_t ContactFeed::drops() const noexcept { return contacts_->events().drops(); }
std::uint64_t ContactFeed::overBudget() const noexcept { return contacts_->events().overBudget(); }
std::uint64_t ContactFeed::thinned() const noexcept { return contacts_->events().thinned(); }
ContactCounts ContactFeed::counts() const noexcept { return contacts_->events().counts(); }
ContactCounts ContactFeed::takeRecent() noexcept { return contacts_->events().takeRecent(); }

std::string_view ContactFeed::note(std::int32_t id, EngineNote kind) {
    if (!contacts_->bodies().has(id)) return unknownBody;
    ContactEvents& events = contacts_->events();
    if (events.fixtures().isSource(events.fixtures().find(ReportedBodies::idOf(id))))
        events.recorder().tally().note(kind, id);
    return {};
}

const ImpactModel& ContactFeed::impactModel() const noexcept { return contacts_->events().impactModel(); }

} // namespace physvib
