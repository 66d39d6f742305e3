// SPDX-License-Identifier: MIT
// Report sections on the design as run: condition orders, and the differences that its number of participants
// can detect.
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Report/ReportSections.h"
#include "Lab/Statistics/PowerSimulation.h"
#include "Lab/Study/StudyTasks.h"
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

/// Minimum number of two-alternative, fixed-level choice trials per participant; 0 if the study has none.
std::size_t choiceTrialsOf(const CsvTable& all) {
    const Cells cell{all};
    std::map<std::string, std::size_t> counts;
    std::set<std::string> alternatives;
    eachMainTrial(all, [&](const std::string& participant, const std::string&, const CsvRow& row) {
        const std::string &choice = cell(row, "choice"), &task = cell(row, trialColumns::task);
        if (choice.empty() || !cell(row, "correct").empty() ||
            (cell.has(trialColumns::task) && answerOf(task) != AnswerKind::choice))
            return;
        ++counts[participant];
        alternatives.insert(choice);
    });
    if (counts.empty() || alternatives.size() != 2) return 0;
    return std::ranges::min_element(counts, {}, [](const auto& count) { return count.second; })->second;
}

std::string orNever(std::optional<double> effect, int decimals) {
    return effect ? fixedNumber(*effect, decimals) : std::string{"more than was tried"};
}

/// Numbers of pairs for which this report's tests are corrected.
std::set<std::size_t> pairsTested(const ReportBuilder& report) {
    std::set<std::size_t> pairs;
    for (const ReportTest& test : report.tests())
        if (test.analysis == "pairs" && test.lines > 1) pairs.insert(test.lines);
    return pairs;
}

std::string correctedWords(const PairedPower& power, const std::set<std::size_t>& pairs) {
    std::string words;
    for (const std::size_t count : pairs)
        words.append(words.empty() ? "; with Bonferroni's correction for " : ", for ")
            .append(std::to_string(count) + " pairs as tested here, d = ")
            .append(orNever(power.smallestEffect(0.8, 0.05 / static_cast<double>(count)), 2));
    return words;
}

void tellPairedPower(ReportBuilder& report, std::size_t people, ExportTable& table) {
    const std::set<std::size_t> pairs = pairsTested(report);
    const PairedPower power{people};
    report.page.paragraph(
        "By simulation (" + std::to_string(PairedPower::studies) + " studies of " + std::to_string(people) +
        " participants, normal differences, seed 1): a paired t test at p < 0.05 finds a mean difference of "
        "two conditions or stimuli in 80 % of the studies if it is at least d = " +
        orNever(power.smallestEffect(0.8, 0.05), 2) + " of the differences' standard deviation" +
        correctedWords(power, pairs) +
        ". A smaller difference that was not found is no evidence that there is none.");
    const double most = pairs.empty() ? 1.0 : static_cast<double>(*pairs.rbegin());
    for (const double effect : {0.2, 0.3, 0.5, 0.8, 1.0, 1.2, 1.5, 2.0}) {
        table.row("paired t, d", effect, power.at(effect, 0.05), power.at(effect, 0.05 / most));
    }
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

void tellPower(ReportBuilder& report) {
    const Orders orders = ordersOf(report.trials.all);
    const std::size_t people = orders.size(), trials = choiceTrialsOf(report.trials.all);
    if (people < 3 || (report.tests().empty() && trials == 0)) return;
    report.page.heading("Power of the design as it was run");
    ExportTable table{"power", report.isSimulated(), "test,effect,power,power_corrected"};
    if (!report.tests().empty()) tellPairedPower(report, people, table);
    if (trials > 0) {
        const SharePower shares{people, trials};
        report.page.paragraph(
            "Of forced choices between two (" + std::to_string(trials) +
            " trials of each participant, all with the same true share; signed ranks "
            "against one half at p < 0.05): " +
            (shares.smallestShare(0.8)
                 ? "a share of " + fixedNumber(100.0 * *shares.smallestShare(0.8), 0) + " % or more"
                 : std::string{"no share up to 95 %"}) +
            " is found in 80 % of the studies. Participants who differ need more.");
        for (const double share : {0.52, 0.55, 0.6, 0.65, 0.7, 0.8}) {
            table.row("signed ranks, share", share, shares.at(share), "");
        }
    }
    report.addTable("power.csv", table.text());
    report.page.table(table.text(), "power.csv");
}

} // namespace physvib
