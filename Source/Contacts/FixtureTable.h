// SPDX-License-Identifier: MIT
// Fixtures that have haptic values or touch something, their touching pairs, and the graph of contacts. They
// are kept beside the physics world, so the engine's user data remain the user's.
#pragma once
#include "Contacts/HapticFixture.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace physvib {
/// One fixture of the world.
struct KnownFixture {
    std::uint64_t fixture = 0; ///< the engine's number; 0: the slot is free
    BodyFacts body;            ///< at the last contact that began
    std::int32_t id = 0;       ///< id in events; below -1: no haptic values
    HapticFixture values;
    Vector2 centre; ///< centre of mass in the body's frame; for fixtures with values

    bool isUsed() const noexcept { return fixture != 0; }
    bool isNamed() const noexcept { return id >= 0; }
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
    std::int32_t know(std::uint64_t fixture, const BodyFacts& body);
    void know(std::int32_t slot, const BodyFacts& body); ///< updates a registered fixture

    /// Assigns values to a registered fixture, or replaces them. `id`: the caller's (>= 0), or `none`: its
    /// present one, else the next of 0, 1, 2... Returns the id; `none`, and nothing is changed, if another
    /// fixture has it.
    std::int32_t set(std::int32_t slot, const HapticFixture& values, Vector2 centre, std::int32_t id = none);

    /// Removes the values; the fixture stays registered, without an id.
    void unset(std::int32_t slot);

    /// Frees the slot of a destroyed fixture.
    void release(std::int32_t slot);

    std::int32_t find(std::uint64_t fixture) const noexcept { return slots_.find(fixture); }
    const KnownFixture& operator[](std::int32_t slot) const noexcept {
        return known_[static_cast<std::size_t>(slot)];
    }
    /// Bits that decide in each step whether reports of a contact matter.
    enum Trait : std::uint8_t { source = 1, rough = 2 };
    unsigned traits(std::int32_t slot) const noexcept { return traits_[static_cast<std::size_t>(slot)]; }
    bool isCamera(std::int32_t slot) const noexcept { return (traits(slot) & source) != 0; }
    /// By the engine's number, without a search; false is certain.
    bool mayBeCamera(std::uint64_t fixture) const noexcept { return cameraNames_.mayHave(fixture); }
    /// A number that changes whenever the values of a fixture change.
    std::uint32_t revision() const noexcept { return revision_; }
    bool isRough(std::int32_t slot) const noexcept { return (traits(slot) & rough) != 0; }

    /// Two properties of KnownFixture that are read often.
    struct Mobility {
        double movableMassKg = std::numeric_limits<double>::infinity();
        float gravityScale = 0.0F;
    };
    const Mobility& mobility(std::int32_t slot) const noexcept {
        return mobility_[static_cast<std::size_t>(slot)];
    }
    bool hasCameras() const noexcept { return cameras_ > 0; }
    std::int32_t size() const noexcept {
        return static_cast<std::int32_t>(known_.size());
    } ///< slots, free ones too

    /// The largest staticMassKg of fixtures whose body is enabled and not dynamic, kg.
    double largestStaticMassKg(const BodyReader& bodies);

private:
    KnownFixture& at(std::int32_t slot) noexcept { return known_[static_cast<std::size_t>(slot)]; }
    void lose(std::int32_t slot);
    void noteBody(std::int32_t slot, const BodyFacts& body) noexcept;
    void noteTraits(std::int32_t slot, bool isCamera, bool isRough) noexcept;
    void weigh(const KnownFixture& known);

    std::vector<KnownFixture> known_;
    std::vector<std::uint8_t> traits_; // by slot, as the next: read for each contact in each step, so compact
    std::vector<Mobility> mobility_;
    std::int32_t cameras_ = 0;
    std::uint32_t revision_ = 0;
    NameSketch cameraNames_;
    std::vector<std::int32_t> free_;
    IntegerMap slots_;    // by the engine's fixture number
    IntegerMap slotOfId_; // by id + 1
    std::int32_t nextId_ = 0;
    std::int32_t nextNameless_ = -2;

    struct StaticBody {
        std::uint64_t body;
        double massKg; // the largest of its fixtures
    };
    std::vector<StaticBody> staticBodies_;
    IntegerMap staticBodyOf_; // by body
    bool isWeightStale_ = false;
};

/// A pair of slots has a number, under which its data are found without a search, while it touches or while
/// one of its fields is set. Check a number kept for longer with `is`. Allocates only to grow. World thread
/// (M).
class TouchingPairs {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// Two slots in the order of their contact, and their number.
    struct Name {
        std::int32_t a = none, b = none, number = none;
    };

    struct Pair {
        std::int32_t a = none, b = none; ///< slots in any order; none: the number is free
        std::int32_t contacts = 0;       ///< that touch
        std::int32_t edge = none;        ///< the graph's; none: nothing touches
        std::int32_t collision = none;   ///< index of its collision in this step
        std::int32_t last = none;        ///< index of its collision in the last step
        std::int32_t load = none;        ///< index of its resting load

        bool isTouching() const noexcept { return edge != none; }
    };

    explicit TouchingPairs(std::size_t pairs)
        : numbers_(pairs) {
        pairs_.reserve(pairs);
        free_.reserve(pairs);
        loose_.reserve(pairs);
    }

    /// The number of a pair, or `none`.
    std::int32_t find(std::int32_t a, std::int32_t b) const noexcept { return numbers_.find(pairKey(a, b)); }

    /// The number of a pair, a new one if necessary.
    std::int32_t know(std::int32_t a, std::int32_t b) {
        if (const std::int32_t known = find(a, b); known != none) return known;
        if (free_.empty()) {
            free_.push_back(static_cast<std::int32_t>(pairs_.size()));
            pairs_.emplace_back();
        }
        const std::int32_t number = free_.back();
        free_.pop_back();
        numbers_.set(pairKey(a, b), number);
        (*this)[number] = {.a = a, .b = b};
        loosen(number);
        return number;
    }

    bool is(const Name& name) const noexcept {
        if (name.number == none) return false;
        const Pair& pair = (*this)[name.number];
        return (pair.a == name.a && pair.b == name.b) || (pair.a == name.b && pair.b == name.a);
    }

    Pair& operator[](std::int32_t number) noexcept { return pairs_[static_cast<std::size_t>(number)]; }
    const Pair& operator[](std::int32_t number) const noexcept {
        return pairs_[static_cast<std::size_t>(number)];
    }

    /// All contacts of a pair have ended: the number is freed once no field is set.
    void loosen(std::int32_t number) { loose_.push_back(number); }

    /// Calls see(pair) for pairs that may have ended, some of them twice.
    template <class See>
    void forLoose(See see) const {
        for (const std::int32_t number : loose_) see((*this)[number]);
    }

    /// Call at the end of a step: frees numbers.
    void endStep() {
        std::erase_if(loose_, [&](std::int32_t number) {
            Pair& pair = (*this)[number];
            if (pair.a == none || pair.isTouching()) return true;
            if (pair.collision != none || pair.last != none || pair.load != none) return false;
            numbers_.erase(pairKey(pair.a, pair.b));
            pair = {};
            free_.push_back(number);
            return true;
        });
    }

private:
    std::vector<Pair> pairs_;
    IntegerMap numbers_; // by the pair
    std::vector<std::int32_t> free_;
    std::vector<std::int32_t> loose_; // candidates to be freed
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
        make(node);
        if (at(node).isPassing != isPassing) changePassing(node);
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
    /// The same of nodes below `nodes`, for many at once.
    void prepare(std::int32_t nodes) {
        make(nodes - 1);
        if (isStale_) rebuild();
    }
    std::int32_t preparedComponent(std::int32_t node) noexcept {
        return at(node).isPassing ? root(node) : noComponent;
    }

    /// The components connected to `node`: its own, or, if it is not passing, those of its neighbours.
    /// Allocates if `components` must grow.
    void reach(std::int32_t node, std::vector<std::int32_t>& components);

    bool isPassing(std::int32_t node) const noexcept {
        const auto index = static_cast<std::size_t>(node);
        return index >= nodes_.size() || nodes_[index].isPassing;
    }
    bool isTouching(std::int32_t a, std::int32_t b) const noexcept {
        const std::int32_t pair = pairs_.find(a, b);
        return pair != TouchingPairs::none && pairs_[pair].isTouching();
    }

    /// Calls see(neighbour) for each node that touches `node`. Iterates over all edges.
    template <class See>
    void forNeighbours(std::int32_t node, See see) const {
        for (const Edge& edge : edges_) {
            if (edge.a == node) see(edge.b);
            if (edge.b == node) see(edge.a);
        }
    }

    /// Calls see(node) once for each node that touches another. Iterates over all edges.
    template <class See>
    void forTouching(See see) {
        ++visits_;
        for (const Edge& edge : edges_)
            for (const std::int32_t node : {edge.a, edge.b})
                if (std::exchange(at(node).visit, visits_) != visits_) see(node);
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
    void make(std::int32_t node) {
        while (static_cast<std::int32_t>(nodes_.size()) <= node)
            nodes_.push_back({static_cast<std::int32_t>(nodes_.size())});
    }
    [[gnu::noinline]] void changePassing(std::int32_t node) noexcept;
    bool unites(std::int32_t a, std::int32_t b) noexcept { return at(a).isPassing && at(b).isPassing; }
    void drop(std::size_t edge);
    std::int32_t root(std::int32_t node) noexcept {
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
