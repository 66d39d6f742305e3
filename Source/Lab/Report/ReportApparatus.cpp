// SPDX-License-Identifier: MIT
// Report section on the apparatus, from the rows of the trials and not from the protocol.
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Report/ReportSections.h"
#include <algorithm>
#include <map>

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
    report.page.paragraph(
        "Device, master level in dB, root mean square of the pink noise in dB of full scale (off: there was "
        "none), version of the program, and by how much the limiter lowered what was felt.");
    report.page.table(table.text(), "apparatus.csv");
    for (const std::string& sentence : sentencesOf(kinds)) report.page.paragraph(sentence);
    tellNoise(report, kinds);
    if (kinds.size() > 1)
        report.page.note("trials had " + std::to_string(kinds.size()) +
                         " different settings of the apparatus");
}

} // namespace physvib
