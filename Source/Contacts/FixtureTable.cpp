// SPDX-License-Identifier: MIT
// Implementation of the table of fixtures, and of the graph of contacts.
#include "Contacts/FixtureTable.h"
#include <algorithm>

namespace physvib {
namespace {

std::uint64_t keyOf(std::int32_t id) noexcept { return static_cast<std::uint64_t>(id) + 1; } // 0 is no key

} // namespace

std::int32_t FixtureTable::findOrAdd(std::uint64_t fixture, const BodyFacts& body) {
    if (const std::int32_t slot = find(fixture); slot != none) {
        updateBody(slot, body);
        return slot;
    }
    if (freeSlots_.empty()) {
        freeSlots_.push_back(size());
        entries_.emplace_back();
        traits_.push_back(0);
        mobility_.emplace_back();
        freeSlots_.reserve(entries_.capacity()); // so that releasing a slot never allocates
    }
    const std::int32_t slot = freeSlots_.back();
    freeSlots_.pop_back();
    at(slot).fixture = fixture;
    updateBody(slot, body);
    at(slot).id = nextUnnamedId_--;
    slots_.set(fixture, slot);
    return slot;
}

std::int32_t FixtureTable::set(std::int32_t slot, const HapticFixture& values, Vector2 centre,
                               std::int32_t id) {
    FixtureEntry& entry = at(slot);
    if (id == none) id = entry.hasHapticValues() ? entry.id : nextId_;
    if (const std::int32_t owner = slotOfId_.find(keyOf(id)); owner != none && owner != slot) return none;
    dropId(slot);
    entry.id = id;
    entry.values = values;
    entry.centre = centre;
    slotOfId_.set(keyOf(id), slot);
    nextId_ = std::max(nextId_, id + 1);
    addStaticMass(entry);
    storeTraits(slot, values.isCamera, values.texture.isRough());
    return id;
}

void FixtureTable::removeValues(std::int32_t slot) {
    dropId(slot);
    at(slot).id = nextUnnamedId_--;
    at(slot).values = {};
    storeTraits(slot, false, false);
}

void FixtureTable::release(std::int32_t slot) {
    dropId(slot);
    slots_.erase(at(slot).fixture);
    storeTraits(slot, false, false);
    at(slot) = {};
    updateBody(slot, {});
    freeSlots_.push_back(slot);
}

void FixtureTable::updateBody(std::int32_t slot, const BodyFacts& body) noexcept {
    at(slot).body = body;
    mobility_[static_cast<std::size_t>(slot)] = {at(slot).movableMassKg(), at(slot).gravityScale()};
}

void FixtureTable::storeTraits(std::int32_t slot, bool isSource, bool isRough) noexcept {
    std::uint8_t& traits = traits_[static_cast<std::size_t>(slot)];
    const bool wasSource = (traits & source) != 0;
    ++revision_;
    traits = static_cast<std::uint8_t>((isSource ? source : 0) | (isRough ? rough : 0));
    if (isSource == wasSource) return;
    sourceCount_ += isSource ? 1 : -1;
    if (isSource)
        sourceFilter_.add(at(slot).fixture);
    else
        sourceFilter_.remove(at(slot).fixture);
}

// Drops the slot's id, and its share in the cached static mass.
void FixtureTable::dropId(std::int32_t slot) {
    const FixtureEntry& entry = at(slot);
    if (!entry.hasHapticValues()) return;
    slotOfId_.erase(keyOf(entry.id));
    if (entry.values.staticMassKg > 0.0) areStaticMassesStale_ = true;
}

void FixtureTable::addStaticMass(const FixtureEntry& entry) {
    if (!entry.isUsed() || entry.values.staticMassKg <= 0.0) return;
    const std::int32_t i = staticBodyOf_.find(entry.body.body);
    if (i == IntegerMap::none) {
        staticBodyOf_.set(entry.body.body, static_cast<std::int32_t>(staticBodies_.size()));
        staticBodies_.push_back({entry.body.body, entry.values.staticMassKg});
    } else {
        double& mass = staticBodies_[static_cast<std::size_t>(i)].massKg;
        mass = std::max(mass, entry.values.staticMassKg);
    }
}

double FixtureTable::largestStaticMassKg(const BodyReader& bodies) {
    if (areStaticMassesStale_) {
        staticBodies_.clear();
        staticBodyOf_.clear();
        for (const FixtureEntry& entry : entries_) addStaticMass(entry);
        areStaticMassesStale_ = false;
    }
    double largest = 0.0;
    for (const StaticBody& candidate : staticBodies_) {
        if (candidate.massKg <= largest) continue;
        // the engine may have freed it, or made it stand, since its last contact
        if (const BodyFacts now = bodies.facts(candidate.body); now.isEnabled && !now.isDynamic)
            largest = candidate.massKg;
    }
    return largest;
}

inline void ContactGraph::unite(const Edge& edge) noexcept {
    if (!edge.unites) return;
    const std::int32_t a = findRoot(edge.a), b = findRoot(edge.b);
    at(std::max(a, b)).parent = std::min(a, b);
}

ContactGraph::ContactGraph(std::size_t edges)
    : pairs_(edges) {
    edges_.reserve(edges);
}

void ContactGraph::togglePassing(std::int32_t node) noexcept {
    at(node).isPassing = !at(node).isPassing;
    for (Edge& edge : edges_) edge.unites = unites(edge.a, edge.b);
    isStale_ = true;
}

std::int32_t ContactGraph::insert(std::int32_t a, std::int32_t b) {
    ensureNode(std::max(a, b));
    const std::int32_t number = pairs_.findOrAdd(a, b);
    TouchingPairs::Pair& pair = pairs_[number];
    ++pair.contacts;
    if (pair.isTouching()) return number;
    pair.edgeIndex = static_cast<std::int32_t>(edges_.size());
    edges_.push_back({a, b, number, unites(a, b)});
    ++at(a).degree;
    ++at(b).degree;
    if (!isStale_) unite(edges_.back());
    return number;
}

void ContactGraph::erase(std::int32_t pair) {
    if (pair == TouchingPairs::none || !pairs_[pair].isTouching()) return;
    if (--pairs_[pair].contacts == 0) drop(static_cast<std::size_t>(pairs_[pair].edgeIndex));
}

void ContactGraph::isolate(std::int32_t node) {
    ensureNode(node);
    for (std::size_t i = edges_.size(); i-- > 0 && at(node).degree > 0;)
        if (edges_[i].a == node || edges_[i].b == node)
            drop(i); // the edge moved to index i has been checked already
    setPassing(node, true);
}

void ContactGraph::findComponents(std::int32_t node, std::vector<std::int32_t>& components) {
    components.clear();
    prepare(node + 1);
    const auto add = [&](std::int32_t from) {
        const std::int32_t reached = preparedComponent(from);
        if (reached == noComponent) return;
        for (const std::int32_t earlier : components)
            if (earlier == reached) return;
        components.push_back(reached);
    };
    if (isPassing(node))
        add(node);
    else
        forEachNeighbour(node, add);
}

void ContactGraph::drop(std::size_t edge) {
    const Edge removed = edges_[edge];
    for (const std::int32_t node : {removed.a, removed.b})
        if (--at(node).degree == 0) at(node).parent = node; // so that a rebuild visits only nodes with edges
    pairs_[edges_.back().pair].edgeIndex = static_cast<std::int32_t>(edge);
    edges_[edge] = edges_.back();
    edges_.pop_back();
    pairs_[removed.pair].edgeIndex = TouchingPairs::none;
    pairs_[removed.pair].contacts = 0;
    pairs_.releaseWhenUnused(removed.pair);
    isStale_ = isStale_ || removed.unites;
}

void ContactGraph::rebuild() noexcept {
    // all nodes, or those of edges, whichever are fewer: others are their own root already
    if (nodes_.size() < 2 * edges_.size())
        for (std::int32_t node = 0; Node & entry : nodes_) entry.parent = node++;
    else
        for (const Edge& edge : edges_)
            for (const std::int32_t node : {edge.a, edge.b}) at(node).parent = node;
    for (const Edge& edge : edges_) unite(edge);
    isStale_ = false;
}

} // namespace physvib
