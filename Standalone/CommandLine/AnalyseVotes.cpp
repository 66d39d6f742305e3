// SPDX-License-Identifier: GPL-3.0-or-later
// Shares and means in words and tables.
#include "CommandLine/AnalyseVotes.h"
#include "CommandLine/AnalyseCommand.h"
#include "CommandLine/StudyOutput.h"
#include "Host/StudyPictures.h"

namespace physvib {
namespace {

std::string percent(double share) { return fixedNumber(100.0 * share, 1); }

std::string chance(double p) { return p < 0.001 ? "p < 0.001" : "p = " + fixedNumber(p, 3); }

void tell(const ChoiceSummary& summary) {
    std::cout << printable(summary.condition) << ':';
    for (const ChoiceShare& share : summary.shares)
        std::cout << (&share == &summary.shares.front() ? " " : ", ") << printable(share.alternative) << ' ' << percent(share.votes.share) << " % ("
                  << percent(share.votes.least) << " to " << percent(share.votes.most) << ')';
    std::cout << " of " << summary.shares.front().votes.trials << " trials";
    if (summary.shares.size() == 2) std::cout << ", " << chance(summary.pByChance);
    std::cout << '\n';
}

} // namespace

int analyseChoices(const AnalyseOptions& o) {
    const auto data = readStudyFiles(o.files, [](const std::vector<NamedText>& files) { return readChoices(files); });
    if (!data) return leave(exitFailed, data.error);
    const auto summaries = summariseChoices(data.value.conditions.front().trials);
    ExportTable table{"choices", data.value.isSimulated, "condition,alternative,votes,trials,percent,least_percent,most_percent,participants,participants_median_percent,p_sign_test"};
    tellIfSimulated(data.value.isSimulated);
    if (summaries.front().shares.size() == 1) warn("every choice is " + printable(summaries.front().shares.front().alternative) + ": nothing to compare");
    for (const auto& summary : summaries) {
        tell(summary);
        for (const auto& share : summary.shares) {
            table.cell(summary.condition).cell(share.alternative).cell(std::size_t{share.votes.hits}).cell(std::size_t{share.votes.trials});
            for (const double part : {share.votes.share, share.votes.least, share.votes.most}) table.cell(100.0 * part);
            table.cell(summary.participants).cell(100.0 * share.participantsMedian).cell(summary.pByChance);
            table.endRow();
        }
    }
    return writeStudyFiles({{o.exportPath, table.text()}, {o.picturePath, [&] { return choicePicture(summaries, pictureWords(o.files, data.value.isSimulated)); }}});
}

int analyseRatings(const AnalyseOptions& o) {
    const auto ratings = readStudyFiles(o.files, [](const std::vector<NamedText>& files) { return readRatings(files); });
    if (!ratings) return leave(exitFailed, ratings.error);
    const auto& [scales, data] = ratings.value;
    const auto summaries = summariseRatings(data.conditions.front().trials);
    ExportTable table{"ratings", data.isSimulated, "condition,scale,trials,participants,mean,standard_deviation,half_interval"};
    tellIfSimulated(data.isSimulated);
    for (const auto& summary : summaries) {
        std::cout << printable(summary.condition) << ": " << summary.trials << (summary.trials == 1 ? " trial" : " trials");
        for (std::size_t s = 0; s < scales.size(); ++s) {
            std::cout << ", " << printable(scales[s]) << ' ' << fixedNumber(summary.means[s], 1);
            if (summary.halfIntervals[s] > 0.0) std::cout << " +- " << fixedNumber(summary.halfIntervals[s], 1);
            table.cell(summary.condition).cell(scales[s]).cell(summary.trials).cell(summary.participants);
            for (const double number : {summary.means[s], summary.deviations[s], summary.halfIntervals[s]}) table.cell(number);
            table.endRow();
        }
        std::cout << '\n';
    }
    return writeStudyFiles({{o.exportPath, table.text()}, {o.picturePath, [&] { return ratingPicture(scales, summaries, pictureWords(o.files, data.isSimulated)); }}});
}

} // namespace physvib
