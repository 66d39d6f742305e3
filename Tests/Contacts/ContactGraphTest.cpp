// SPDX-License-Identifier: MIT
// Components and reach against a plain breadth-first search, as the thesis has it.
#include "Contacts/FixtureTable.h"
#include <array>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace physvib {
namespace {

constexpr int nodes = 40;

/// Adjacency counts and a queue.
struct Reference {
    std::array<std::array<int, nodes>, nodes> contacts{};
    std::array<bool, nodes> isPassing{};

    /// Nodes that a breadth-first search from `start` visits: those not passing are visited, and not left.
    std::set<std::int32_t> tree(int start) const {
        std::set<std::int32_t> visited{start};
        std::vector<int> queue{start};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            if (!isPassing[static_cast<std::size_t>(queue[i])]) continue;
            for (int next = 0; next < nodes; ++next)
                if (contacts[static_cast<std::size_t>(queue[i])][static_cast<std::size_t>(next)] > 0 &&
                    visited.insert(next).second)
                    queue.push_back(next);
        }
        return visited;
    }
    void change(int a, int b, int by) {
        contacts[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] += by;
        contacts[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)] += by;
    }
};

/// The nodes that an impulse on `start` reaches by the graph's answers.
std::set<std::int32_t> reachedFrom(ContactGraph& graph, std::int32_t start) {
    std::set<std::int32_t> reached{start};
    std::vector<std::int32_t> components;
    for (std::int32_t node = 0; node < nodes; ++node) {
        graph.reach(node, components);
        for (const std::int32_t component : components)
            if (component == graph.component(start)) reached.insert(node);
    }
    return reached;
}

struct Edits {
    int walls;       // nodes that do not pass
    int perQuestion; // edits
};
class ContactGraphEdits : public testing::TestWithParam<Edits> {};

TEST_P(ContactGraphEdits, EqualABreadthFirstSearch) {
    std::mt19937 random(7);
    ContactGraph graph(4);
    Reference reference;
    reference.isPassing.fill(true);
    for (int wall = 0; wall < GetParam().walls; ++wall) {
        graph.setPassing(wall, false);
        reference.isPassing[static_cast<std::size_t>(wall)] = false;
    }
    std::vector<std::pair<int, int>> edges;
    for (int edit = 0; edit < 100'000; ++edit) {
        const bool adds = edges.empty() || (edges.size() < 60 && random() % 2 == 0);
        if (adds) {
            const int a = static_cast<int>(random() % nodes);
            const int b = (a + 1 + static_cast<int>(random() % (nodes - 1))) % nodes;
            graph.insert(a, b);
            reference.change(a, b, 1);
            edges.emplace_back(a, b);
        } else {
            std::swap(edges[random() % edges.size()], edges.back());
            graph.erase(edges.back().second, edges.back().first);
            reference.change(edges.back().first, edges.back().second, -1);
            edges.pop_back();
        }
        if (edit % GetParam().perQuestion != 0) continue; // several edits between two questions, too
        const int start = static_cast<int>(random() % nodes);
        if (graph.isPassing(start)) {
            ASSERT_EQ(reachedFrom(graph, start), reference.tree(start)) << "edit " << edit;
        } else {
            ASSERT_EQ(graph.component(start), ContactGraph::noComponent);
        }
    }
}
INSTANTIATE_TEST_SUITE_P(WallsAndPace, ContactGraphEdits,
                         testing::Values(Edits{0, 1}, Edits{0, 7}, Edits{6, 1}, Edits{6, 5}));

TEST(ContactGraph, PairOfSeveralContactsIsConnectedUntilTheLastEnds) {
    ContactGraph graph;
    graph.insert(1, 2);
    graph.insert(2, 1);
    graph.erase(1, 2);
    EXPECT_EQ(graph.component(1), graph.component(2));
    graph.erase(1, 2);
    EXPECT_NE(graph.component(1), graph.component(2));
    graph.erase(1, 2); // one too many
    EXPECT_FALSE(graph.isTouching(1, 2));
}

TEST(ContactGraph, IsolatedNodeLosesAllItsContacts) {
    ContactGraph graph;
    for (const int other : {0, 2, 3}) graph.insert(1, other);
    graph.insert(2, 3);
    graph.setPassing(1, false);
    graph.isolate(1);
    EXPECT_TRUE(graph.isPassing(1));
    for (const int other : {0, 2, 3}) EXPECT_FALSE(graph.isTouching(1, other));
    EXPECT_TRUE(graph.isTouching(2, 3));
    EXPECT_EQ(graph.component(2), graph.component(3));
    EXPECT_NE(graph.component(0), graph.component(2));
}

TEST(ContactGraph, WallIsReachedButHandsNothingOn) {
    ContactGraph graph;
    graph.setPassing(0, false);
    graph.insert(0, 1);
    graph.insert(0, 2);
    EXPECT_NE(graph.component(1), graph.component(2));
    std::vector<std::int32_t> reached;
    graph.reach(0, reached);
    EXPECT_EQ(reached.size(), 2U);
    graph.setPassing(0, true); // the wall has become a movable body
    EXPECT_EQ(graph.component(1), graph.component(2));
}

} // namespace
} // namespace physvib
