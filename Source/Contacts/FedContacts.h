// SPDX-License-Identifier: MIT
// The implementation of ContactFeed: reported bodies and touching pairs, and what they give to the stages
// that make events.
#pragma once
#include "Contacts/ContactEvents.h"
#include "Contacts/ContactFeed.h"
#include "Contacts/FedPoints.h"
#include "Contacts/IntegerMap.h"
#include "Contacts/MeetingPoints.h"
#include "Contacts/MomentumImpulses.h"
#include "Contacts/ReportedBodies.h"
#include "Contacts/ReportedSlides.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Its arguments are valid: ContactFeed has checked that bodies are known, that contacts have no errors, and
/// that the call is allowed now. M only.
class FedContacts {
public:
    explicit FedContacts(const ImpactSettings& settings);
    FedContacts(const FedContacts&) = delete;
    FedContacts& operator=(const FedContacts&) = delete;

    ReportedBodies& bodies() noexcept { return bodies_; }
    ContactEvents& events() noexcept { return events_; }
    bool isStepping() noexcept { return events_.catcher().isStepping(); }

    void remove(std::int32_t id);
    void beginStep(std::int64_t endNs, double gravityMetresPerSecond2);
    void touch(const FedContact& contact);
    void begin(const FedContact& contact);
    void push(const FedContact& contact);
    bool end(std::int32_t a, std::int32_t b); ///< False: the pair does not touch.
    void endStep();

private:
    struct Pair {
        std::int32_t a, b; // slots, the lower one first
        bool isAsked;      // it was reported by touch(), and ends when touch() leaves it out
        bool isNew, isNamed;
        FedPoints::Chain points{};              // of this step and the one before, if the engine names points
        std::int32_t waiting = FedPoints::none; // the newest of its contacts that are solved at the end of
                                                // the step
    };
    struct Waiting {
        FedContact contact;
        bool isNew;
        std::int32_t next;
        std::int32_t momentum; // its number there, or none
    };
    bool isByMomentum(const FedContact& contact) const {
        return bodies_.isAnyAfter() && bodies_.hasAfter(contact.a) && bodies_.hasAfter(contact.b);
    }
    void strikeByMomentum();
    FedContact withMomentum(const Waiting& each) const;
    double pushed(const Waiting& each) const;
    double supported(double bySpeed, double pushed, double gainedMetresPerSecond, double fraction) const;
    static bool waits(const FedContact& contact) noexcept {
        return contact.isSoft || contact.isImpulseOfPair || !contact.impulseNewtonSeconds;
    }
    bool isNewPoint(Pair& pair, const FedContact& contact);
    void tell(Pair& pair, const FedContact& contact, bool isNew);
    void settle(const Pair& pair);
    void settleTogether();
    double speedOf(const FedContact& contact) const;
    std::int32_t slotOf(std::int32_t id) const noexcept {
        return events_.fixtures().find(ReportedBodies::idOf(id));
    }
    TouchingPairs::Name nameOf(const FedContact& contact);
    Pair& know(const FedContact& contact, bool isAsked);
    void drop(std::size_t pair);
    void dropAllOf(std::int32_t slot);
    void strike(const FedContact& contact, double pushed = 0.0);
    void passOver(const TouchingPairs::Name& pair, const FedContact& contact, double speed, double impulse);
    void strikeTogether();
    double fastestOfNew() const;
    static void addFriction(Collision& collision, const FedContact& contact, std::int32_t a,
                            float share) noexcept;
    void load(const FedContact& contact);
    void rub(const FedContact& contact, const TouchingPairs::Name& pair);
    double fractionOf(const FedContact& contact, double approachMetresPerSecond) const noexcept;

    ReportedBodies bodies_;
    ContactEvents events_;
    ReportedSlides rubs_;
    FedPoints points_;
    std::vector<Waiting> waiting_;
    MomentumImpulses momentum_;
    std::vector<const Waiting*> together_; // of one pair, in the order in which they were reported
    std::vector<MeetingPoint> meeting_;    // the same for the solver
    std::vector<Pair> pairs_;
    IntegerMap pairOf_;
    double lastStepSeconds_ = 0.0, gravity_ = 0.0;
};

} // namespace physvib
