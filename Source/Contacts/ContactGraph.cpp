// SPDX-License-Identifier: MIT
// Connected components of the contact graph by union-find over the live edges.
#include "Contacts/ContactGraph.h"
#include <algorithm>

namespace physvib {

ContactGraph::ContactGraph(std::size_t edges)
    : indices_(edges) {
    edges_.reserve(edges);
}

void ContactGraph::setPassing(std::int32_t node, bool isPassing) {
    make(node);
    if (at(node).isPassing == isPassing) return;
    at(node).isPassing = isPassing;
    isStale_ = true;
}

void ContactGraph::insert(std::int32_t a, std::int32_t b) {
    make(std::max(a, b));
    const std::int32_t known = indices_.find(pairKey(a, b));
    if (known != IntegerMap::none) {
        ++edges_[static_cast<std::size_t>(known)].contacts;
        return;
    }
    indices_.set(pairKey(a, b), static_cast<std::int32_t>(edges_.size()));
    edges_.push_back({a, b, 1});
    ++at(a).degree;
    ++at(b).degree;
    if (!isStale_) unite(edges_.back());
}

void ContactGraph::erase(std::int32_t a, std::int32_t b) {
    const std::int32_t known = indices_.find(pairKey(a, b));
    if (known == IntegerMap::none) return;
    const auto edge = static_cast<std::size_t>(known);
    if (--edges_[edge].contacts == 0) drop(edge);
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
    const auto add = [&](std::int32_t from) {
        const std::int32_t found = component(from);
        const bool isNew = std::find(components.begin(), components.end(), found) == components.end();
        if (found != noComponent && isNew) components.push_back(found);
    };
    if (isPassing(node))
        add(node);
    else
        forNeighbours(node, add);
}

bool ContactGraph::isTouching(std::int32_t a, std::int32_t b) const noexcept {
    return indices_.find(pairKey(a, b)) != IntegerMap::none;
}

void ContactGraph::drop(std::size_t edge) noexcept {
    const Edge gone = edges_[edge];
    for (const std::int32_t node : {gone.a, gone.b})
        if (--at(node).degree == 0) at(node).parent = node; // so that a rebuild visits only nodes with edges
    indices_.erase(pairKey(gone.a, gone.b));
    edges_[edge] = edges_.back();
    edges_.pop_back();
    if (edge < edges_.size())
        indices_.set(pairKey(edges_[edge].a, edges_[edge].b), static_cast<std::int32_t>(edge));
    if (at(gone.a).isPassing && at(gone.b).isPassing) isStale_ = true;
}

void ContactGraph::unite(const Edge& edge) noexcept {
    if (!at(edge.a).isPassing || !at(edge.b).isPassing) return;
    const std::int32_t a = root(edge.a), b = root(edge.b);
    at(std::max(a, b)).parent = std::min(a, b);
}

void ContactGraph::rebuild() noexcept {
    for (const Edge& edge : edges_) // nodes without edges are their own root already
        for (const std::int32_t node : {edge.a, edge.b}) at(node).parent = node;
    for (const Edge& edge : edges_) unite(edge);
    isStale_ = false;
}

} // namespace physvib
