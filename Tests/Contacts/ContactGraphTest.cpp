// SPDX-License-Identifier: MIT
// Components and reach against a plain breadth-first search, as the thesis has it; and whom what comes
// through contacts reaches.
#include "Contacts/CollisionRecorder.h"
#include "Contacts/FixtureTable.h"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace physvib::contact_graph_test {

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
        graph.findComponents(node, components);
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
    graph.findComponents(0, reached);
    EXPECT_EQ(reached.size(), 2U);
    graph.setPassing(0, true); // the wall has become a movable body
    EXPECT_EQ(graph.component(1), graph.component(2));
}

/// Of two contacts that rest on a source one pushes more by the last binary digit of an impulse so small that
/// its square is 0, the other by much.
TEST(ChainLoads, ASourceReceivesOnceHoweverWeakItsFirstImpulseIs) {
    constexpr float weak = 1.0e-16F;
    FixtureTable table;
    ContactGraph graph;
    std::array<std::int32_t, 3> slots{};
    for (std::size_t i = 0; i < slots.size(); ++i)
        slots[i] = table.findOrAdd(11 + i, {21 + i, 1.0, 1.0F, true, true});
    table.set(slots[0], {.isCamera = true}, {});
    TransmittedImpulses loads{table, graph.pairs()};
    std::vector<TouchingPairs::Handle> contacts;
    for (const std::int32_t other : {slots[1], slots[2]}) {
        contacts.push_back({other, slots[0], graph.insert(other, slots[0])});
        loads.begin(contacts.back());
    }
    const auto push = [&](float one, float other) {
        loads.add(contacts[0], graph.pairs()[contacts[0].number].loadIndex, {one, 0.0F, 0.0F});
        loads.add(contacts[1], graph.pairs()[contacts[1].number].loadIndex, {other, 0.0F, 0.0F});
        loads.endReports();
    };
    for (int step = 0; step < 4; ++step) {
        push(weak, weak);
        loads.endStep();
    }
    push(std::nextafter(weak, 1.0F), 1.0F);
    EXPECT_EQ(loads.receivers(), std::vector{slots[0]});
    EXPECT_EQ(loads.transmittedTo(slots[0]).strongest, 1.0F);
    EXPECT_EQ(loads.transmittedTo(slots[0]).other, slots[2]);
}

} // namespace physvib::contact_graph_test
