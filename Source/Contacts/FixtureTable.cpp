// SPDX-License-Identifier: MIT
// Implementation of the table of fixtures, and of the graph of contacts.
#include "Contacts/FixtureTable.h"
#include <algorithm>

namespace physvib {
namespace {

std::uint64_t keyOf(std::int32_t id) noexcept { return static_cast<std::uint64_t>(id) + 1; } // 0 is no key

} // namespace

std::int32_t FixtureTable::know(std::uint64_t fixture, const BodyFacts& body) {
    if (const std::int32_t slot = find(fixture); slot != none) {
        know(slot, body);
        return slot;
    }
    if (free_.empty()) {
        free_.push_back(size());
        known_.emplace_back();
        traits_.push_back(0);
        mobility_.emplace_back();
        free_.reserve(known_.capacity()); // so that releasing a slot never allocates
    }
    const std::int32_t slot = free_.back();
    free_.pop_back();
    at(slot).fixture = fixture;
    noteBody(slot, body);
    at(slot).id = nextNameless_--;
    slots_.set(fixture, slot);
    return slot;
}

void FixtureTable::know(std::int32_t slot, const BodyFacts& body) {
    if (at(slot).isNamed() && at(slot).isDynamic() != body.isDynamic) isWeightStale_ = true;
    noteBody(slot, body);
}

std::int32_t FixtureTable::set(std::int32_t slot, const HapticFixture& values, Vector2 centre,
                               std::int32_t id) {
    KnownFixture& known = at(slot);
    if (id == none) id = known.isNamed() ? known.id : nextId_;
    if (const std::int32_t owner = slotOfId_.find(keyOf(id)); owner != none && owner != slot) return none;
    lose(slot);
    known.id = id;
    known.values = values;
    known.centre = centre;
    slotOfId_.set(keyOf(id), slot);
    nextId_ = std::max(nextId_, id + 1);
    weigh(known);
    noteTraits(slot, values.isCamera, values.texture.isRough());
    return id;
}

void FixtureTable::unset(std::int32_t slot) {
    lose(slot);
    at(slot).id = nextNameless_--;
    at(slot).values = {};
    noteTraits(slot, false, false);
}

void FixtureTable::release(std::int32_t slot) {
    lose(slot);
    slots_.erase(at(slot).fixture);
    noteTraits(slot, false, false);
    at(slot) = {};
    noteBody(slot, {});
    free_.push_back(slot);
}

void FixtureTable::noteBody(std::int32_t slot, const BodyFacts& body) noexcept {
    at(slot).body = body;
    mobility_[static_cast<std::size_t>(slot)] = {at(slot).movableMassKg(), at(slot).gravityScale()};
}

void FixtureTable::noteTraits(std::int32_t slot, bool isCamera, bool isRough) noexcept {
    std::uint8_t& traits = traits_[static_cast<std::size_t>(slot)];
    const bool wasCamera = (traits & source) != 0;
    ++revision_;
    traits = static_cast<std::uint8_t>((isCamera ? source : 0) | (isRough ? rough : 0));
    if (isCamera == wasCamera) return;
    cameras_ += isCamera ? 1 : -1;
    if (isCamera)
        cameraNames_.add(at(slot).fixture);
    else
        cameraNames_.remove(at(slot).fixture);
}

// Drops the slot's id, and its share in the cached static mass.
void FixtureTable::lose(std::int32_t slot) {
    const KnownFixture& known = at(slot);
    if (!known.isNamed()) return;
    slotOfId_.erase(keyOf(known.id));
    if (!known.isDynamic()) isWeightStale_ = true;
}

void FixtureTable::weigh(const KnownFixture& known) {
    if (!known.isUsed() || known.isDynamic() || known.values.staticMassKg <= 0.0) return;
    const std::int32_t i = staticBodyOf_.find(known.body.body);
    if (i == IntegerMap::none) {
        staticBodyOf_.set(known.body.body, static_cast<std::int32_t>(staticBodies_.size()));
        staticBodies_.push_back({known.body.body, known.values.staticMassKg});
    } else {
        double& mass = staticBodies_[static_cast<std::size_t>(i)].massKg;
        mass = std::max(mass, known.values.staticMassKg);
    }
}

double FixtureTable::largestStaticMassKg(const BodyReader& bodies) {
    if (isWeightStale_) {
        staticBodies_.clear();
        staticBodyOf_.clear();
        for (const KnownFixture& known : known_) weigh(known);
        isWeightStale_ = false;
    }
    double largest = 0.0;
    for (const StaticBody& each : staticBodies_)
        if (each.massKg > largest && bodies.facts(each.body).isEnabled) largest = each.massKg;
    return largest;
}

inline void ContactGraph::unite(const Edge& edge) noexcept {
    if (!edge.unites) return;
    const std::int32_t a = root(edge.a), b = root(edge.b);
    at(std::max(a, b)).parent = std::min(a, b);
}

ContactGraph::ContactGraph(std::size_t edges)
    : pairs_(edges) {
    edges_.reserve(edges);
}

void ContactGraph::changePassing(std::int32_t node) noexcept {
    at(node).isPassing = !at(node).isPassing;
    for (Edge& edge : edges_) edge.unites = unites(edge.a, edge.b);
    isStale_ = true;
}

std::int32_t ContactGraph::insert(std::int32_t a, std::int32_t b) {
    make(std::max(a, b));
    const std::int32_t number = pairs_.know(a, b);
    TouchingPairs::Pair& pair = pairs_[number];
    ++pair.contacts;
    if (pair.isTouching()) return number;
    pair.edge = static_cast<std::int32_t>(edges_.size());
    edges_.push_back({a, b, number, unites(a, b)});
    ++at(a).degree;
    ++at(b).degree;
    if (!isStale_) unite(edges_.back());
    return number;
}

void ContactGraph::erase(std::int32_t pair) {
    if (pair == TouchingPairs::none || !pairs_[pair].isTouching()) return;
    if (--pairs_[pair].contacts == 0) drop(static_cast<std::size_t>(pairs_[pair].edge));
}

void ContactGraph::isolate(std::int32_t node) {
    make(node);
    for (std::size_t i = edges_.size(); i-- > 0 && at(node).degree > 0;)
        if (edges_[i].a == node || edges_[i].b == node)
            drop(i); // the edge moved to index i has been checked already
    setPassing(node, true);
}

void ContactGraph::reach(std::int32_t node, std::vector<std::int32_t>& components) {
    components.clear();
    prepare(node + 1);
    const auto add = [&](std::int32_t from) {
        const std::int32_t found = preparedComponent(from);
        if (found == noComponent) return;
        for (const std::int32_t earlier : components)
            if (earlier == found) return;
        components.push_back(found);
    };
    if (isPassing(node))
        add(node);
    else
        forNeighbours(node, add);
}

void ContactGraph::drop(std::size_t edge) {
    const Edge gone = edges_[edge];
    for (const std::int32_t node : {gone.a, gone.b})
        if (--at(node).degree == 0) at(node).parent = node; // so that a rebuild visits only nodes with edges
    pairs_[edges_.back().pair].edge = static_cast<std::int32_t>(edge);
    edges_[edge] = edges_.back();
    edges_.pop_back();
    pairs_[gone.pair].edge = TouchingPairs::none;
    pairs_[gone.pair].contacts = 0;
    pairs_.loosen(gone.pair);
    isStale_ = isStale_ || gone.unites;
}

void ContactGraph::rebuild() noexcept {
    // all nodes, or those of edges, whichever are fewer: others are their own root already
    if (nodes_.size() < 2 * edges_.size())
        for (std::int32_t node = 0; Node & each : nodes_) each.parent = node++;
    else
        for (const Edge& edge : edges_)
            for (const std::int32_t node : {edge.a, edge.b}) at(node).parent = node;
    for (const Edge& edge : edges_) unite(edge);
    isStale_ = false;
}

} // namespace physvib
