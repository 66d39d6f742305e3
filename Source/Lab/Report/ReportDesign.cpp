// SPDX-License-Identifier: MIT
// Report section on the condition orders as run.
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Report/ReportSections.h"
#include <algorithm>
#include <map>
#include <set>

namespace physvib {
namespace {

/// Conditions of each participant in the order of first main trials; participants in file order.
using Orders = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Calls `take` with participant and condition of each main trial.
template <class Take>
void eachMainTrial(const CsvTable& all, Take take) {
    const Cells cell{all};
    for (const CsvRow& row : all.rows)
        if (cell(row, trialColumns::phase) != trialColumns::training)
            take(cell(row, "participant"), cell(row, "condition"), row);
}

Orders ordersOf(const CsvTable& all) {
    Orders orders;
    eachMainTrial(all, [&](const std::string& participant, const std::string& condition, const CsvRow&) {
        auto found = std::ranges::find(orders, participant, &Orders::value_type::first);
        if (found == orders.end()) found = orders.insert(orders.end(), {participant, {}});
        if (std::ranges::find(found->second, condition) == found->second.end())
            found->second.push_back(condition);
    });
    return orders;
}

std::string balanceWords(const Orders& orders, const std::set<std::string>& conditions) {
    std::map<std::pair<std::string, std::size_t>, std::size_t> atPlace;
    std::set<std::pair<std::string, std::string>> successions;
    for (const auto& [participant, order] : orders)
        for (std::size_t place = 0; place < order.size(); ++place) {
            ++atPlace[{order[place], place}];
            if (place > 0) successions.emplace(order[place - 1], order[place]);
        }
    std::size_t fewest = orders.size(), most = 0;
    for (const std::string& condition : conditions)
        for (std::size_t place = 0; place < conditions.size(); ++place) {
            const std::size_t count = atPlace[{condition, place}];
            fewest = std::min(fewest, count), most = std::max(most, count);
        }
    return "A condition was at one place of the order " + std::to_string(fewest) + " to " +
           std::to_string(most) + " times; " + std::to_string(successions.size()) + " of " +
           std::to_string(conditions.size() * (conditions.size() - 1)) +
           " successions of two conditions occurred.";
}

std::set<std::string> orderedConditions(const Orders& orders) {
    std::set<std::string> all;
    for (const auto& [participant, order] : orders) all.insert(order.begin(), order.end());
    return all;
}

} // namespace

void tellOrders(ReportBuilder& report) {
    if (!report.trials.knowTasks()) return; // rows of other programs may be sorted, so their order is unknown
    const Orders orders = ordersOf(report.trials.all);
    const auto conditions = orderedConditions(orders);
    if (conditions.size() < 2) return;
    ExportTable table{"orders", report.isSimulated(), "participant,place,condition"};
    for (const auto& [participant, order] : orders)
        for (std::size_t place = 0; place < order.size(); ++place) {
            table.row(participant, place + 1, order[place]);
        }
    report.addTable("orders.csv", table.text());
    report.page.subheading("Orders of the conditions");
    report.page.paragraph(balanceWords(orders, conditions));
    report.page.table(table.text(), "orders.csv", 200, true);
}

} // namespace physvib
