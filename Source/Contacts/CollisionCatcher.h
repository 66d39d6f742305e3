// SPDX-License-Identifier: MIT
// The thesis' collision catcher (5.1.3): what a physics engine tells of its contacts during a step, in fixed
// arrays.
#pragma once
#include "Contacts/ChainLoads.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/NameSketch.h"
#include "Contacts/TouchingPairs.h"
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Keeps the contact graph up to date, and notes for each step what struck what: a blow is what goes beyond
/// load. It needs parts of two surfaces that were apart and near each other faster than a resting body does;
/// what they push is the blow. What is pushed elsewhere, by bodies that rest, lean, roll over a seam, or are
/// created at rest, is a load. A pair of fixtures has at most one blow in a step, however many contacts and
/// points it has. Fixtures are slots of the table. M only.
class CollisionCatcher {
public:
    /// Blows in one step: those at cameras, and others, which may be handed on to cameras. A world that has
    /// more of them is a noise, not a touch.
    static constexpr std::size_t maxDirectBlows = 1024;
    static constexpr std::size_t maxDistantBlows = 4096;

    CollisionCatcher(const FixtureTable& table, ContactGraph& graph);

    /// Right before the engine's step.
    void beginStep(const StepSpan& span) noexcept;

    /// Right after it: what was noted is complete.
    void settle();

    /// When all that was noted has been used.
    void endStep();

    /// The slot has another owner from now on: drops what was noted of it.
    void forget(std::int32_t slot) noexcept;

    bool isStepping() const noexcept { return isStepping_; }

    /// Whether the engine has told anything of a felt contact, or of a blow, in this step.
    bool hasHeard() const noexcept { return hasHeard_; }

    /// A contact of two solid fixtures begins; there may be several of a pair (the links of a chain).
    void begin(std::int32_t a, std::int32_t b);

    /// One of them ends. What is returned is to be filled in with when and how; nullptr: without room, and it
    /// is felt as if it had not ended in time.
    ContactEnd* end(std::int32_t a, std::int32_t b);

    /// Parts of two fixtures meet, told apart from others of a pair that touches: it is counted, and no more.
    void meet(std::int32_t a, std::int32_t b) noexcept {
        ++contacts_;
        withoutSource_ += isFelt(a, b) ? 0 : 1;
    }
    /// Parts of two fixtures met, and too slowly for a blow: counted if a camera is one of them.
    void passOver(std::int32_t a, std::int32_t b) noexcept { tooSlow_ += isFelt(a, b) ? 1 : 0; }

    /// The number of a pair of known fixtures, by which all of the following is asked. It may be kept: see
    /// TouchingPairs.
    std::int32_t know(std::int32_t a, std::int32_t b) { return pairs_.know(a, b); }
    bool isKnown(const TouchingPairs::Name& pair) const noexcept { return pairs_.is(pair); }

    /// Whether parts that near each other so fast, before the solver, are a blow; of two bodies, the larger
    /// gravity scale.
    bool isBlow(float gravityScale, double approachMetresPerSecond) const noexcept {
        return approachMetresPerSecond >= span_.leastApproach(gravityScale);
    }

    /// The blow of a pair in this step, if there is one. `strike` makes it, to be filled in (its fixtures,
    /// mass and place in the order are). Without room the weakest goes, by mass and approach, and is counted:
    /// nullptr, if that is this one.
    Blow* strike(const TouchingPairs::Name& pair, double approachMetresPerSecond);
    Blow* blow(const TouchingPairs::Name& pair) noexcept {
        const std::int32_t known = pairs_[pair.number].blow;
        return known == TouchingPairs::none ? nullptr : &blows_[static_cast<std::size_t>(known)];
    }

    /// Whether anybody could feel anything. A camera that comes later feels from the step after on.
    bool isHearing() const noexcept { return table_.hasCameras(); }

    /// Whether a camera is one of the two.
    bool isFelt(std::int32_t a, std::int32_t b) const noexcept {
        return table_.isCamera(a) || table_.isCamera(b);
    }

    /// Whether a pair's load matters: it is felt, or goes on with a blow of the last step.
    bool isHeard(const TouchingPairs::Name& pair) const noexcept {
        return isFelt(pair.a, pair.b) || pairs_[pair.number].last != TouchingPairs::none;
    }

    /// Whether it may matter, by the engine's names of the two fixtures: false is certain, and spares most
    /// contacts of a world with few cameras the search for their pair.
    bool mayBeHeard(std::uint64_t a, std::uint64_t b) const noexcept {
        return table_.mayBeCamera(a) || table_.mayBeCamera(b) ||
               (struckNames_.mayHave(a) && struckNames_.mayHave(b));
    }

    /// What parts of a heard pair that are no blow have pushed b by, and a by its opposite, N s in the world.
    void push(const TouchingPairs::Name& pair, Vector2 newtonSeconds, Vector2 point) {
        hasHeard_ = true;
        if (const std::int32_t last = pairs_[pair.number].last; last != TouchingPairs::none)
            last_[static_cast<std::size_t>(last)].newtonSeconds += newtonSeconds;
        if (isFelt(pair.a, pair.b)) loads_.add(pair, newtonSeconds, point);
    }

    const std::vector<Blow>& blows() const noexcept { return blows_; }
    /// N s that the pair of a blow of the last step has gone on to push in this one: engines spread a blow
    /// over two.
    double aftermath(std::int32_t pair) const noexcept;
    /// Contacts that ended in the step or since the one before it.
    const std::vector<ContactEnd>& ends() const noexcept { return ends_; }
    const ChainLoads& loads() const noexcept { return loads_; }

    /// Blows that found no room so far.
    std::uint64_t drops() const noexcept { return drops_; }
    /// Contacts so far; those without a camera; those of cameras that were no blows.
    std::uint64_t contacts() const noexcept { return contacts_; }
    std::uint64_t withoutSource() const noexcept { return withoutSource_; }
    std::uint64_t tooSlow() const noexcept { return tooSlow_; }

private:
    struct Aftermath { // of a blow of the last step: what its pair has pushed in this one
        std::int32_t pair;
        Vector2 newtonSeconds;
    };
    Blow* weakest(bool isDirect) noexcept;

    const FixtureTable& table_;
    ContactGraph& graph_;
    TouchingPairs pairs_;
    ChainLoads loads_{table_, pairs_};
    StepSpan span_;
    std::vector<Blow> blows_; // of the present step
    std::vector<ContactEnd> ends_;
    std::vector<Aftermath> last_;
    std::vector<std::uint64_t> struck_; // the engine's names, of the blows of the last step
    NameSketch struckNames_;
    std::size_t directBlows_ = 0;
    std::int32_t order_ = 0;
    bool isStepping_ = false, hasHeard_ = false;
    std::uint64_t drops_ = 0, contacts_ = 0, withoutSource_ = 0, tooSlow_ = 0;
};

} // namespace physvib
