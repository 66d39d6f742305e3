// SPDX-License-Identifier: MIT
// Fixtures that have haptic values or touch something, their touching pairs, and the graph of contacts. They
// are kept beside the physics world, so the engine's user data remain the user's.
#pragma once
#include "Contacts/HapticFixture.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace physvib {
/// One fixture of the world.
struct FixtureEntry {
    std::uint64_t fixture = 0; ///< the engine's number; 0: the slot is free
    BodyFacts body;            ///< at the last contact that began
    std::int32_t id = 0;       ///< id in events; below -1: no haptic values
    HapticFixture values;
    Vector2 centre; ///< centre of mass in the body's frame; for fixtures with values

    bool isUsed() const noexcept { return fixture != 0; }
    bool hasHapticValues() const noexcept { return id >= 0; }
    bool isDynamic() const noexcept { return body.isDynamic; }
    /// m_i of Eq. 5.4, kg.
    double massKg() const noexcept { return isDynamic() ? body.massKg : values.staticMassKg; }
    /// Factor of the gravity that acts on it.
    float gravityScale() const noexcept { return isDynamic() ? std::abs(body.gravityScale) : 0.0F; }
    /// Mass that a collision can move, kg; infinite if the body is not dynamic.
    double movableMassKg() const noexcept {
        return isDynamic() ? body.massKg : std::numeric_limits<double>::infinity();
    }
};

/// Slots are small and reused; ids are not. A fixture is registered once it has values or has touched
/// another, so a step's cost does not grow with static geometry that nothing touches. Allocates only to grow.
/// World thread (M).
class FixtureTable {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// The slot of a fixture, a new one if necessary; `body` replaces what is stored of its body.
    std::int32_t findOrAdd(std::uint64_t fixture, const BodyFacts& body);
    /// Replaces what is stored of a registered fixture's body.
    void updateBody(std::int32_t slot, const BodyFacts& body) noexcept;

    /// Assigns values to a registered fixture, or replaces them. `id`: the caller's (>= 0), or `none`: its
    /// present one, else the next of 0, 1, 2... Returns the id; `none`, and nothing is changed, if another
    /// fixture has it.
    std::int32_t set(std::int32_t slot, const HapticFixture& values, Vector2 centre, std::int32_t id = none);

    /// Removes the values; the fixture stays registered, without an id.
    void removeValues(std::int32_t slot);

    void release(std::int32_t slot); ///< Frees the slot of a destroyed fixture.

    std::int32_t find(std::uint64_t fixture) const noexcept { return slots_.find(fixture); }
    const FixtureEntry& operator[](std::int32_t slot) const noexcept {
        return entries_[static_cast<std::size_t>(slot)];
    }
    /// Bits that decide in each step whether reports of a contact matter.
    enum Trait : std::uint8_t { source = 1, rough = 2 };
    unsigned traits(std::int32_t slot) const noexcept { return traits_[static_cast<std::size_t>(slot)]; }
    bool isSource(std::int32_t slot) const noexcept { return (traits(slot) & source) != 0; }
    /// By the engine's number, without a search. False is certain, true is not.
    bool mayBeSource(std::uint64_t fixture) const noexcept { return sourceFilter_.mayContain(fixture); }
    /// A number that changes whenever the values of a fixture change.
    std::uint32_t revision() const noexcept { return revision_; }
    bool isRough(std::int32_t slot) const noexcept { return (traits(slot) & rough) != 0; }

    /// Two properties of FixtureEntry that are read often.
    struct Mobility {
        double movableMassKg = std::numeric_limits<double>::infinity();
        float gravityScale = 0.0F;
    };
    const Mobility& mobility(std::int32_t slot) const noexcept {
        return mobility_[static_cast<std::size_t>(slot)];
    }
    bool hasSources() const noexcept { return sourceCount_ > 0; }
    /// Slots, free ones too.
    std::int32_t size() const noexcept { return static_cast<std::int32_t>(entries_.size()); }

    /// The largest staticMassKg of fixtures whose body is enabled and not dynamic, kg.
    double largestStaticMassKg(const BodyReader& bodies);

private:
    FixtureEntry& at(std::int32_t slot) noexcept { return entries_[static_cast<std::size_t>(slot)]; }
    void dropId(std::int32_t slot);
    void storeTraits(std::int32_t slot, bool isSource, bool isRough) noexcept;
    void addStaticMass(const FixtureEntry& entry);

    std::vector<FixtureEntry> entries_;
    std::vector<std::uint8_t> traits_; // by slot, as mobility_; compact, since each step reads them
    std::vector<Mobility> mobility_;
    std::int32_t sourceCount_ = 0;
    std::uint32_t revision_ = 0;
    CountingFilter sourceFilter_;
    std::vector<std::int32_t> freeSlots_;
    IntegerMap slots_;    // by the engine's fixture number
    IntegerMap slotOfId_; // by id + 1
    std::int32_t nextId_ = 0;
    std::int32_t nextUnnamedId_ = -2;

    struct StaticBody { // has a static mass; whether it stands is asked in each step, as no contact tells it
        std::uint64_t body;
        double massKg; // the largest of its fixtures
    };
    std::vector<StaticBody> staticBodies_;
    IntegerMap staticBodyOf_; // by body
    bool areStaticMassesStale_ = false;
};

/// A pair of slots has a number, under which its data are found without a search, while it touches or while
/// one of its fields is set; later matches() checks it. Allocates only to grow. World thread (M).
class TouchingPairs {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// Two slots in the order of their contact, and their number.
    struct Handle {
        std::int32_t a = none, b = none, number = none;
    };

    struct Pair {
        std::int32_t a = none, b = none;    ///< slots in any order; none: the number is free
        std::int32_t contacts = 0;          ///< that touch
        std::int32_t edgeIndex = none;      ///< the graph's; none: nothing touches
        std::int32_t collisionIndex = none; ///< index of its collision in this step
        std::int32_t lastIndex = none;      ///< index of its collision in the last step
        std::int32_t loadIndex = none;      ///< index of its resting load

        bool isTouching() const noexcept { return edgeIndex != none; }
    };

    explicit TouchingPairs(std::size_t pairs)
        : numbers_(pairs) {
        pairs_.reserve(pairs);
        freeNumbers_.reserve(pairs);
        releaseCandidates_.reserve(pairs);
    }

    /// The number of a pair, or `none`.
    std::int32_t find(std::int32_t a, std::int32_t b) const noexcept { return numbers_.find(pairKey(a, b)); }

    /// The number of a pair, a new one if necessary.
    std::int32_t findOrAdd(std::int32_t a, std::int32_t b) {
        if (const std::int32_t known = find(a, b); known != none) return known;
        if (freeNumbers_.empty()) {
            freeNumbers_.push_back(static_cast<std::int32_t>(pairs_.size()));
            pairs_.emplace_back();
        }
        const std::int32_t number = freeNumbers_.back();
        freeNumbers_.pop_back();
        numbers_.set(pairKey(a, b), number);
        (*this)[number] = {.a = a, .b = b};
        releaseWhenUnused(number);
        return number;
    }

    bool matches(const Handle& handle) const noexcept {
        if (handle.number == none) return false;
        const Pair& pair = (*this)[handle.number];
        return (pair.a == handle.a && pair.b == handle.b) || (pair.a == handle.b && pair.b == handle.a);
    }

    Pair& operator[](std::int32_t number) noexcept { return pairs_[static_cast<std::size_t>(number)]; }
    const Pair& operator[](std::int32_t number) const noexcept {
        return pairs_[static_cast<std::size_t>(number)];
    }

    /// All contacts of a pair have ended: the number is freed once no field is set.
    void releaseWhenUnused(std::int32_t number) { releaseCandidates_.push_back(number); }

    /// Calls visit(pair) for pairs that may have ended, some of them twice.
    template <class Visit>
    void forEachReleaseCandidate(Visit visit) const {
        for (const std::int32_t number : releaseCandidates_) visit((*this)[number]);
    }

    /// Call at the end of a step: frees numbers.
    void endStep() {
        std::erase_if(releaseCandidates_, [&](std::int32_t number) {
            Pair& pair = (*this)[number];
            if (pair.a == none || pair.isTouching()) return true;
            if (pair.collisionIndex != none || pair.lastIndex != none || pair.loadIndex != none) return false;
            numbers_.erase(pairKey(pair.a, pair.b));
            pair = {};
            freeNumbers_.push_back(number);
            return true;
        });
    }

private:
    std::vector<Pair> pairs_;
    IntegerMap numbers_; // by the pair
    std::vector<std::int32_t> freeNumbers_;
    std::vector<std::int32_t> releaseCandidates_; // candidates to be freed
};

/// Which fixtures are connected through touching ones (the thesis' contact-state graph, 5.1.3): an undirected
/// graph over small indices, updated edge by edge as contacts begin and end. The thesis searches
/// breadth-first from both nodes of a new contact (v1, v2). Both trees cross the new edge, so together they
/// visit exactly component(v1). Therefore union-find replaces the search; it is rebuilt at most once between
/// a removal and the next query. A node that is not passing (an immovable body, which absorbs an impulse
/// without transmitting it) may end a path but not continue one. Allocates only to grow. World thread (M)
/// only.
class ContactGraph {
public:
    static constexpr std::int32_t noComponent = -1;

    /// Capacity in pairs without an allocation.
    explicit ContactGraph(std::size_t edges = 128);

    /// Numbers of the pairs that touch, and of others that were registered.
    TouchingPairs& pairs() noexcept { return pairs_; }

    /// Nodes are passing by default. A change costs a rebuild.
    void setPassing(std::int32_t node, bool isPassing) {
        ensureNode(node);
        if (at(node).isPassing != isPassing) togglePassing(node);
    }

    /// Adds a contact between two different nodes (>= 0); two fixtures can have several (chains). Returns the
    /// number of the pair.
    std::int32_t insert(std::int32_t a, std::int32_t b);

    /// Removes one contact of that pair, or of the pair of that number; no effect if there is none.
    void erase(std::int32_t a, std::int32_t b) { erase(pairs_.find(a, b)); }
    void erase(std::int32_t pair);

    /// Removes all contacts of a node, and makes it passing.
    void isolate(std::int32_t node);

    /// Equal for nodes that are connected through passing ones; noComponent for a node that is not passing.
    /// Valid until the next change.
    std::int32_t component(std::int32_t node) {
        prepare(node + 1);
        return preparedComponent(node);
    }
    /// Call before preparedComponent() for nodes below `nodes`: one rebuild for many queries.
    void prepare(std::int32_t nodes) {
        ensureNode(nodes - 1);
        if (isStale_) rebuild();
    }
    std::int32_t preparedComponent(std::int32_t node) noexcept {
        return at(node).isPassing ? findRoot(node) : noComponent;
    }

    /// The components connected to `node`: its own, or, if it is not passing, those of its neighbours.
    /// Allocates if `components` must grow.
    void findComponents(std::int32_t node, std::vector<std::int32_t>& components);

    bool isPassing(std::int32_t node) const noexcept {
        const auto index = static_cast<std::size_t>(node);
        return index >= nodes_.size() || nodes_[index].isPassing;
    }
    bool isTouching(std::int32_t a, std::int32_t b) const noexcept {
        const std::int32_t pair = pairs_.find(a, b);
        return pair != TouchingPairs::none && pairs_[pair].isTouching();
    }

    /// Calls visit(neighbour) for each node that touches `node`. Iterates over all edges.
    template <class Visit>
    void forEachNeighbour(std::int32_t node, Visit visit) const {
        for (const Edge& edge : edges_) {
            if (edge.a == node) visit(edge.b);
            if (edge.b == node) visit(edge.a);
        }
    }

    /// Calls visit(node) once for each node that touches another. Iterates over all edges.
    template <class Visit>
    void forEachTouching(Visit visit) {
        ++visits_;
        for (const Edge& edge : edges_)
            for (const std::int32_t node : {edge.a, edge.b})
                if (std::exchange(at(node).visit, visits_) != visits_) visit(node);
    }

private:
    struct Edge {
        std::int32_t a, b;
        std::int32_t pair;
        bool unites; // both are passing
    };
    struct Node {
        std::int32_t parent = 0;
        std::int32_t degree = 0;
        bool isPassing = true;
        std::uint32_t visit = 0; // number of the last iteration that visited it
    };

    Node& at(std::int32_t node) { return nodes_[static_cast<std::size_t>(node)]; }
    void ensureNode(std::int32_t node) {
        while (static_cast<std::int32_t>(nodes_.size()) <= node)
            nodes_.push_back({static_cast<std::int32_t>(nodes_.size())});
    }
    [[gnu::noinline]] void togglePassing(std::int32_t node) noexcept;
    bool unites(std::int32_t a, std::int32_t b) noexcept { return at(a).isPassing && at(b).isPassing; }
    void drop(std::size_t edge);
    std::int32_t findRoot(std::int32_t node) noexcept {
        while (at(node).parent != node) {
            at(node).parent = at(at(node).parent).parent; // path halving
            node = at(node).parent;
        }
        return node;
    }
    void unite(const Edge& edge) noexcept;
    void rebuild() noexcept;

    std::vector<Node> nodes_;
    std::vector<Edge> edges_;
    TouchingPairs pairs_; // each that touches has the index of its edge
    bool isStale_ = false;
    std::uint32_t visits_ = 0;
};

} // namespace physvib
