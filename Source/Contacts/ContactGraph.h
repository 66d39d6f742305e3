// SPDX-License-Identifier: MIT
// Contact graph: which fixtures are connected through touching ones (the thesis' contact-state graph, 5.1.3).
#pragma once
#include "Contacts/IndexMaps.h"
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace physvib {

/// Undirected graph over small indices, updated edge by edge as contacts begin and end. The thesis searches
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

    /// Nodes are passing by default. A change costs a rebuild.
    void setPassing(std::int32_t node, bool isPassing);

    /// Adds a contact between two different nodes (>= 0); two fixtures can have several (chains).
    void insert(std::int32_t a, std::int32_t b);

    /// Removes one contact; no effect if there is none.
    void erase(std::int32_t a, std::int32_t b);

    /// Removes all contacts of a node, and makes it passing.
    void isolate(std::int32_t node);

    /// Equal for nodes that are connected through passing ones; noComponent for a node that is not passing.
    /// Valid until the next change.
    std::int32_t component(std::int32_t node) {
        make(node);
        if (isStale_) rebuild();
        return at(node).isPassing ? root(node) : noComponent;
    }

    /// The components connected to `node`: its own, or, if it is not passing, those of its neighbours.
    /// Allocates if `components` must grow.
    void reach(std::int32_t node, std::vector<std::int32_t>& components);

    bool isPassing(std::int32_t node) const noexcept {
        const auto index = static_cast<std::size_t>(node);
        return index >= nodes_.size() || nodes_[index].isPassing;
    }
    bool isTouching(std::int32_t a, std::int32_t b) const noexcept;

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
        std::int32_t contacts;
    };
    struct Node {
        std::int32_t parent = 0;
        std::int32_t degree = 0;
        bool isPassing = true;
        std::uint32_t visit = 0; // number of the last iteration that visited it
    };

    Node& at(std::int32_t node) { return nodes_[static_cast<std::size_t>(node)]; }
    void make(std::int32_t node) {
        while (nodes_.size() <= static_cast<std::size_t>(node))
            nodes_.push_back({static_cast<std::int32_t>(nodes_.size())});
    }
    void drop(std::size_t edge) noexcept;
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
    IntegerMap indices_; // edges by pair of nodes
    bool isStale_ = false;
    std::uint32_t visits_ = 0;
};

} // namespace physvib
