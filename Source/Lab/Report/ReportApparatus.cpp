// SPDX-License-Identifier: MIT
// Report sections that need only the rows of the trials, not the protocol: apparatus, levels and exposure,
// orders of conditions.
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/ReportBuilder.h"
#include <array>

namespace physvib {
namespace {

namespace columns = trialColumns;

/// Trials that had the same apparatus; those that play nothing, as a questionnaire's, are not counted.
struct ApparatusUse {
    std::size_t trials = 0, delivered = 0, limited = 0; ///< delivered: every part left as planned
    double maxLimitedDb = 0.0;
};

/// Key: device, master level, noise and version.
using ApparatusUses = std::map<std::vector<std::string>, ApparatusUse>;

} // namespace

void addApparatusSection(ReportBuilder& report) {
    const CsvTable& all = report.trials.all;
    const Cells cell{all};
    report.page.addSubheading("Apparatus");
    ApparatusUses uses;
    std::size_t unknown = 0;
    for (const CsvRow& row : all.rows) {
        if (report.trials.hasTasks() && cell(row, columns::delivered).empty() &&
            cell(row, "stimulus").empty() && cell(row, "parts").empty())
            continue;
        if (cell(row, columns::version).empty()) {
            ++unknown;
            continue;
        }
        ApparatusUse& usage = uses[{cell(row, columns::device), cell(row, columns::masterDb),
                                    cell(row, columns::noiseDb), cell(row, columns::version)}];
        const double db = parseNumber<double>(cell(row, columns::limiterDb)).value_or(0.0);
        ++usage.trials;
        usage.delivered += cell(row, columns::delivered) == "1";
        usage.limited += db > 0.05 ? 1 : 0;
        usage.maxLimitedDb = std::max(usage.maxLimitedDb, db);
    }
    if (unknown > 0) report.page.addNote(plural(unknown, "trial") + " without a record of device and levels");
    if (uses.empty()) return;
    ExportTable table{
        "apparatus", report.isSimulated(),
        "device,master_db,noise_db,version,trials,trials_known_to_leave,trials_with_the_limiter,most_"
        "limiter_db"};
    for (const auto& [settings, usage] : uses) {
        for (const std::string& setting : settings) table.cell(setting);
        table.row(usage.trials, usage.delivered, usage.limited, usage.maxLimitedDb);
    }
    report.show("apparatus.csv", table);
}

// Report section on levels and exposure, from the columns level_db, peak_g, rms_g and a8_m_per_s2.

namespace {

/// Numbers of a cell such as "0.5|0.3", which has two parts.
std::vector<double> parseNumbers(std::string_view cell) {
    std::vector<double> numbers;
    while (!cell.empty())
        if (const auto number = parseNumber<double>(takeUntil('|', cell))) numbers.push_back(*number);
    return numbers;
}

struct NumericOrder {
    bool operator()(const auto& a, const auto& b) const {
        return std::ranges::lexicographical_compare(a, b, NaturalOrder{});
    }
};

/// Numbers of a column by condition and session; `isByStimulus`: and by stimulus and part.
using Levels = std::map<std::array<std::string, 4>, std::vector<double>, NumericOrder>;

Levels collectLevels(const CsvTable& all, std::string_view column, bool isByStimulus) {
    const Cells cell{all};
    Levels levels;
    for (const CsvRow& row : all.rows) {
        std::string_view parts = cell(row, "parts");
        for (const double value : parseNumbers(cell(row, column)))
            levels[{cell(row, "condition"), cell(row, "session"), isByStimulus ? cell(row, "stimulus") : "",
                    std::string{isByStimulus ? takeUntil('|', parts) : ""}}]
                .push_back(value);
    }
    return levels;
}

/// Table of the levels of every part of every stimulus, where they are in the rows.
void addStimulusLevels(ReportBuilder& report) {
    ExportTable table{"levels-by-stimulus", report.isSimulated(),
                      "condition,session,stimulus,part,measure,values,least,mean,most"};
    const std::string empty = table.text();
    for (const std::string_view column : {trialColumns::peakG, trialColumns::rmsG})
        for (const auto& [key, numbers] : collectLevels(report.trials.all, column, true))
            table.row(key[0], key[1], key[2], key[3], column, numbers.size(),
                      *std::ranges::min_element(numbers), Moments(numbers).mean,
                      *std::ranges::max_element(numbers));
    if (table.text() == empty) return;
    report.show("levels-by-stimulus.csv", table, 200, true);
}

} // namespace

void addExposureSection(ReportBuilder& report) {
    if (!report.trials.hasTasks()) return; // units of other programs are unknown
    const CsvTable& all = report.trials.all;
    ExportTable table{"levels-and-exposure", report.isSimulated(),
                      "condition,session,measure,values,least,mean,most"};
    std::vector<std::string> meanings;
    for (const std::string& column : all.columns) {
        if (column != "level_db" && !trialColumns::isMeasured(column)) continue;
        const auto values = collectLevels(all, column, false);
        if (column == "level_db" && std::ranges::all_of(values, [](const auto& v) {
                return std::ranges::all_of(v.second, [](double db) { return db == 0.0; });
            }))
            continue;
        if (!values.empty()) meanings.push_back(column + ": " + columnMeaning(column));
        for (const auto& [key, numbers] : values) {
            // means of adaptive levels and accumulated exposure have no meaning
            const bool hasMean = column == trialColumns::peakG || column == trialColumns::rmsG;
            table.row(key[0], key[1], column, numbers.size(), *std::ranges::min_element(numbers),
                      valueIf(hasMean, Moments(numbers).mean), *std::ranges::max_element(numbers));
        }
    }
    if (meanings.empty()) return;
    report.page.addSubheading("Levels and exposure");
    report.page.addList(meanings);
    report.show("levels-and-exposure.csv", table);
    addStimulusLevels(report);
}

// Report section on the condition orders as run.

namespace {

/// Conditions of each participant in the order of first main trials; participants in file order.
using Orders = std::vector<std::pair<std::string, std::vector<std::string>>>;

Orders findOrders(const CsvTable& all) {
    Orders orders;
    const Cells cell{all};
    for (const CsvRow& row : all.rows) {
        if (cell(row, trialColumns::phase) == trialColumns::training) continue;
        const std::string& participant = cell(row, "participant");
        auto found = std::ranges::find(orders, participant, &Orders::value_type::first);
        if (found == orders.end()) found = orders.insert(orders.end(), {participant, {}});
        if (const std::string& condition = cell(row, "condition");
            std::ranges::find(found->second, condition) == found->second.end())
            found->second.push_back(condition);
    }
    return orders;
}

} // namespace

void addOrdersSection(ReportBuilder& report) {
    // rows of other programs may be sorted, so their order is unknown
    if (!report.trials.hasTasks() || !report.trials.all.column("trial")) return;
    const Orders orders = findOrders(report.trials.all);
    std::map<std::string, std::map<std::size_t, std::size_t>> counts; // by condition and place
    std::size_t maxPlaces = 0;
    for (const auto& [participant, order] : orders) {
        maxPlaces = std::max(maxPlaces, order.size());
        for (std::size_t place = 0; place < order.size(); ++place) ++counts[order[place]][place];
    }
    if (maxPlaces < 2) return;
    std::string header = "condition";
    for (std::size_t place = 1; place <= maxPlaces; ++place) header += ",place " + std::to_string(place);
    ExportTable balance{"orders", report.isSimulated(), header};
    for (auto& [condition, places] : counts) {
        balance.cell(condition);
        for (std::size_t place = 0; place < maxPlaces; ++place) balance.cell(places[place]);
        balance.endRow();
    }
    ExportTable table{"orders", report.isSimulated(), "participant,place,condition"};
    for (const auto& [participant, order] : orders)
        for (std::size_t place = 0; place < order.size(); ++place)
            table.row(participant, place + 1, order[place]);
    report.page.addSubheading("Orders of the conditions");
    report.page.addTable(balance.text(), "participants by place");
    report.show("orders.csv", table, 200, true);
}

} // namespace physvib
