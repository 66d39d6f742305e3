// SPDX-License-Identifier: MIT
// Report sections on what the rows of the trials say, whatever the protocol says: apparatus, levels and
// exposure, orders of conditions.
#include "Io/Text/CsvText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/BidsDataset.h"
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/StudyPlan.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace physvib {
namespace {

namespace columns = trialColumns;

/// Trials that had the same apparatus.
struct Felt {
    std::size_t trials = 0, known = 0, limited = 0; ///< known: every part left, by the column left
    double mostLimitedDb = 0.0;
};

/// Key: device, master level, noise and version.
using Kinds = std::map<std::vector<std::string>, Felt>;

bool isNoise(const std::string& cell) { return cell != columns::noNoise && !cell.empty(); }

std::vector<std::string> sentencesOf(const Kinds& kinds) {
    std::vector<std::string> sentences;
    for (const auto& [kind, felt] : kinds) {
        const bool hasNoise = isNoise(kind[2]);
        const std::string trials = counted(felt.trials, "trial");
        if (kind[0].starts_with("None:")) {
            sentences.push_back(trials + " had no device: nobody felt anything.");
            continue;
        }
        sentences.push_back(
            (felt.known == felt.trials
                 ? trials + " left through the device " + kind[0] + ", every part within 1 dB of its plan,"
                 : trials + " named the device " + kind[0] + ", but whether all parts left is known of " +
                       std::to_string(felt.known) + " alone;") +
            " at a master level of " + kind[1] + " dB, " +
            (hasNoise ? "with pink noise of " + kind[2] + " dB of full scale (root mean square)"
                      : std::string{"without pink noise"}) +
            "; " +
            (felt.limited > 0 ? "the limiter lowered " + std::to_string(felt.limited) +
                                    " of them, by at most " + fixedNumber(felt.mostLimitedDb, 1) + " dB."
                              : std::string{"the limiter lowered none of them."}));
    }
    return sentences;
}

/// The noise level at the ear is not in the rows; it comes from a microphone measurement.
void tellNoise(ReportBuilder& report, const Kinds& kinds) {
    const std::string& noise = report.trials.facts.noise;
    if (!noise.empty())
        report.page.paragraph("Noise: " + noise);
    else if (std::ranges::any_of(kinds, [](const auto& kind) { return isNoise(kind.first[2]); }))
        report.page.note(
            "to be filled in: the noise as the participants heard it, e.g. its level in dB(A) (--noise)");
}

} // namespace

void tellApparatus(ReportBuilder& report) {
    const CsvTable& all = report.trials.all;
    const Cells cell{all};
    report.page.subheading("Apparatus");
    Kinds kinds;
    std::size_t unknown = 0;
    for (const CsvRow& row : all.rows) {
        if (cell(row, columns::version).empty()) {
            ++unknown;
            continue;
        }
        Felt& felt = kinds[{cell(row, columns::device), cell(row, columns::masterDb),
                            cell(row, columns::noiseDb), cell(row, columns::version)}];
        const double db = parseNumber<double>(cell(row, columns::limiterDb)).value_or(0.0);
        ++felt.trials;
        felt.known += cell(row, columns::left) == "1";
        felt.limited += db > 0.05 ? 1 : 0;
        felt.mostLimitedDb = std::max(felt.mostLimitedDb, db);
    }
    if (unknown > 0)
        report.page.note(std::to_string(unknown) +
                         " trials do not say on which device, at which level and with which noise they were "
                         "felt: nothing is claimed about that");
    if (kinds.empty()) return tellNoise(report, kinds);
    ExportTable table{"apparatus", report.isSimulated(),
                      "device,master_db,noise_db,version,trials,trials_with_the_limiter,most_limiter_db"};
    for (const auto& [kind, felt] : kinds) {
        for (const std::string& word : kind) table.cell(word);
        table.row(felt.trials, felt.limited, felt.mostLimitedDb);
    }
    report.addTable("apparatus.csv", table.text());
    for (const std::string& sentence : sentencesOf(kinds)) report.page.paragraph(sentence);
    tellNoise(report, kinds);
}

// Report section on levels and exposure, from the columns level_db, peak_g, rms_g and a8_m_per_s2.

namespace {

/// Numbers of a cell such as "0.5|0.3", which has two parts.
std::vector<double> numbersOf(std::string_view cell) {
    std::vector<double> numbers;
    while (!cell.empty())
        if (const auto number = parseNumber<double>(takeUntil('|', cell))) numbers.push_back(*number);
    return numbers;
}

/// A sentence on a column of the table of tellDoses(), followed by a space.
std::string meaningOf(std::string_view column, const Moved& all) {
    if (column == "level_db") {
        std::string words = "level_db: ";
        for (const auto& [moved, conditions] : all)
            words.append(words.size() > 10 ? "; " : "")
                .append(all.size() > 1 ? "of " + listed(conditions) + " " : std::string{})
                .append(isLevelItself(moved) ? "what {level_db} is in the call"
                        : moved.empty()
                            ? "in dB of the condition's own level, of what its variable is at 0 dB, or of a "
                              "call's full scale"
                            : "in dB of " + listed(moved) + " at 0 dB (a ratio: 20 dB is 10 times as much)");
        return words + "; where participants set a level, that at the start. ";
    }
    const std::string words{column};
    return words + ": " + columnMeaning(column) + (column == trialColumns::peakG ? ", in g. " : ". ");
}

/// How the columns in g come about.
std::string chainOf(const ReportTrials& trials) {
    if (trials.protocol) return levelChain(*trials.protocol, "as the program counted them when they left");
    return "Levels in g are samples as the program counted them when they left, times a full scale that is "
           "assumed, as the "
           "layouts are not known here: no accelerometer measured them.";
}

/// Numbers of a column by condition and session; `isFine`: and by stimulus and part.
std::map<std::array<std::string, 4>, std::vector<double>> levelsIn(const CsvTable& all,
                                                                   std::string_view column, bool isFine) {
    const Cells cell{all};
    std::map<std::array<std::string, 4>, std::vector<double>> levels;
    for (const CsvRow& row : all.rows) {
        std::string_view parts = cell(row, "parts");
        for (const double value : numbersOf(cell(row, column)))
            levels[{cell(row, "condition"), cell(row, "session"), isFine ? cell(row, "stimulus") : "",
                    std::string{isFine ? takeUntil('|', parts) : ""}}]
                .push_back(value);
    }
    return levels;
}

/// Table of the levels of every part of every stimulus, where they are in the rows.
void tellStimuli(ReportBuilder& report) {
    ExportTable table{"levels-by-stimulus", report.isSimulated(),
                      "condition,session,stimulus,part,measure,values,least,mean,most"};
    const std::string empty = table.text();
    for (const std::string_view column : {trialColumns::peakG, trialColumns::rmsG})
        for (const auto& [key, own] : levelsIn(report.trials.all, column, true))
            table.row(key[0], key[1], key[2], key[3], column, own.size(), *std::ranges::min_element(own),
                      Moments(own).mean, *std::ranges::max_element(own));
    if (table.text() == empty) return;
    report.addTable("levels-by-stimulus.csv", table.text());
    report.page.table(table.text(), "levels-by-stimulus.csv", 200, true);
}

} // namespace

void tellDoses(ReportBuilder& report) {
    if (!report.trials.knowTasks()) return; // units of other programs are unknown
    const CsvTable& all = report.trials.all;
    ExportTable table{"levels-and-exposure", report.isSimulated(),
                      "condition,session,measure,values,least,mean,most"};
    std::string meanings;
    const auto moved = report.trials.protocol ? movedIn(*report.trials.protocol) : Moved{{}};
    for (const std::string& column : all.columns) {
        if (column != "level_db" && !trialColumns::isMeasured(column)) continue;
        const auto values = levelsIn(all, column, false);
        if (column == "level_db" && std::ranges::all_of(values, [](const auto& v) {
                return std::ranges::all_of(v.second, [](double db) { return db == 0.0; });
            }))
            continue;
        if (!values.empty()) meanings += meaningOf(column, moved);
        for (const auto& [key, own] : values) {
            // means of adaptive levels and accumulated exposure have no meaning
            const bool hasMean = column == trialColumns::peakG || column == trialColumns::rmsG;
            table.row(key[0], key[1], column, own.size(), *std::ranges::min_element(own),
                      hasMean ? std::optional{Moments(own).mean} : std::nullopt,
                      *std::ranges::max_element(own));
        }
    }
    if (meanings.empty() && std::ranges::any_of(all.rows, [cell = Cells{all}](const CsvRow& row) {
            return cell(row, columns::render).empty() ||
                   answerOf(cell(row, columns::task)) == AnswerKind::level;
        }))
        return;
    report.page.subheading("Levels and exposure");
    if (meanings.empty())
        return report.page.paragraph("Every trial had the level of its call; nobody measured what was felt.");
    report.addTable("levels-and-exposure.csv", table.text());
    if (meanings.find(trialColumns::peakG) != std::string::npos) meanings += chainOf(report.trials) + " ";
    report.page.paragraph(meanings.substr(0, meanings.size() - 1));
    report.page.table(table.text(), "levels-and-exposure.csv");
    tellStimuli(report);
    if (meanings.find(trialColumns::exposure) == std::string::npos)
        report.page.note("exposure was not measured in these trials");
}

// Report section on the condition orders as run.

namespace {

/// Conditions of each participant in the order of first main trials; participants in file order.
using Orders = std::vector<std::pair<std::string, std::vector<std::string>>>;

Orders ordersOf(const CsvTable& all) {
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

void tellOrders(ReportBuilder& report) {
    // rows of other programs may be sorted, so their order is unknown
    if (!report.trials.knowTasks() || !report.trials.all.column("trial")) return;
    const Orders orders = ordersOf(report.trials.all);
    std::vector<std::vector<std::string>> each;
    for (const auto& [participant, order] : orders) each.push_back(order);
    const OrderBalance balance = orderBalance(each);
    if (balance.possibleSuccessions == 0) return;
    ExportTable table{"orders", report.isSimulated(), "participant,place,condition"};
    for (const auto& [participant, order] : orders)
        for (std::size_t place = 0; place < order.size(); ++place)
            table.row(participant, place + 1, order[place]);
    report.addTable("orders.csv", table.text());
    report.page.subheading("Orders of the conditions");
    report.page.paragraph(
        "A condition was at one place of the order " + std::to_string(balance.fewestAtPlace) +
        (balance.mostAtPlace > balance.fewestAtPlace ? " to " + std::to_string(balance.mostAtPlace) : "") +
        " times; " + std::to_string(balance.successions) + " of " +
        std::to_string(balance.possibleSuccessions) + " successions of two conditions occurred.");
    report.page.table(table.text(), "orders.csv", 200, true);
}

} // namespace physvib
