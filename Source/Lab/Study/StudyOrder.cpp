// SPDX-License-Identifier: MIT
// Computes balanced Latin squares and shuffled orders.
#include "Lab/Study/StudyOrder.h"
#include <algorithm>
#include <numeric>

namespace physvib {
namespace {

/// Indices of the conditions of each group, groups in the order of their first condition. A condition without
/// a group forms its own.
std::vector<std::vector<std::size_t>> groupsOf(const Protocol& protocol) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i) {
        const std::string& name = protocol.conditions[i].group;
        const auto found = std::ranges::find_if(groups, [&](const auto& g) {
            return !name.empty() && protocol.conditions[g.front()].group == name;
        });
        if (found == groups.end())
            groups.push_back({i});
        else
            found->push_back(i);
    }
    return groups;
}

} // namespace

std::vector<std::size_t> latinSquareRow(std::size_t count, std::size_t row) {
    std::vector<std::size_t> order;
    const std::size_t shift = row % std::max<std::size_t>(count, 1);
    for (std::size_t i = 0; i < count; ++i) { // 0, 1, n-1, 2, n-2, ... shifted
        const std::size_t zigzag = i % 2 ? (i + 1) / 2 : (count - i / 2) % count;
        order.push_back((zigzag + shift) % count);
    }
    // with an odd count, the square and its mirror image are balanced together
    if (count % 2 && row / count % 2) std::ranges::reverse(order);
    return order;
}

std::vector<std::size_t> conditionOrder(const Protocol& protocol, int number) {
    const auto groups = groupsOf(protocol);
    const auto row = static_cast<std::size_t>(number - 1);
    std::vector<std::size_t> order;
    if (protocol.conditionOrder == Protocol::ConditionOrder::latinSquare) {
        // Participants with the same order of groups rotate through the orders inside the groups.
        for (const std::size_t g : latinSquareRow(groups.size(), row))
            for (const std::size_t c :
                 latinSquareRow(groups[g].size(), groups.size() > 1 ? row / groups.size() : row))
                order.push_back(groups[g][c]);
        return order;
    }
    order.resize(protocol.conditions.size());
    std::iota(order.begin(), order.end(), 0u);
    SeededRandom random{static_cast<std::uint64_t>(protocol.seed), "conditions of " + std::to_string(number)};
    if (protocol.conditionOrder == Protocol::ConditionOrder::random) random.shuffle(order);
    return order;
}

std::vector<PlannedTrial> sessionOrder(const SessionPlan& session, std::size_t stimuli,
                                       SeededRandom& random) {
    std::vector<PlannedTrial> all;
    for (int repetition = 0; repetition < session.repetitions; ++repetition) {
        std::vector<PlannedTrial> block;
        for (std::size_t s = 0; s < stimuli; ++s) {
            const bool isOfTwo = session.comparesPairs ||
                                 (session.alternatives.size() == 2 && session.answer() == AnswerKind::choice);
            block.push_back({s, !session.bothOrders && isOfTwo && random.chance(0.5)});
            if (session.bothOrders) block.push_back({s, true});
        }
        if (session.order == SessionPlan::Order::blocks) random.shuffle(block);
        all.insert(all.end(), block.begin(), block.end());
    }
    if (session.order == SessionPlan::Order::random) random.shuffle(all);
    return all;
}

} // namespace physvib
