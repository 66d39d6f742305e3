// SPDX-License-Identifier: MIT
// Fuzz target of the readers of study files, and of the analyses on whatever they let through: no number may
// be missing.
#include "Fuzzing.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Study/Identification.h"
#include <cmath>

namespace {
using namespace physvib;

void demandNumbers(std::initializer_list<double> all) {
    for (const double number : all) fuzz::demand(std::isfinite(number), "a number is missing");
}

void analyse(const StudyData<IdentificationTrial>& data) {
    for (const auto& condition : data.groups) {
        const auto it = informationTransfer(ConfusionMatrix{tolerate(condition.trials, 1)});
        demandNumbers({it.bits, it.biasBits, it.minBits, it.trialsPerCell});
    }
}

void analyse(const StudyData<LocationTrial>& data) {
    for (const auto& condition : data.groups) {
        const auto normals = responseNormals(condition.trials);
        if (!normals.error.empty()) continue;
        for (const double p : percentCounts(normals, likelihoodMap(normals, 31, 16), "c").percent)
            demandNumbers({p});
    }
}

void analyse(const StudyData<PercentCounts>& data) {
    for (const auto& condition : data.groups)
        if (const auto& counts = condition.trials.front(); counts.rows < 8 && counts.columns < 8)
            perceptualResolution(counts);
}

void analyse(const StudyData<ChoiceTrial>& data) {
    for (const auto& summary : summariseChoices(data.groups.front().trials))
        if (const auto& interval = summary.shares.front().interval)
            demandNumbers({interval->lower, interval->upper});
}

void analyse(const StudyData<LevelTrial>& data) {
    for (const auto& summary : summariseLevels(data.groups.front().trials))
        demandNumbers({summary.estimate, summary.deviation});
}

void analyse(const RatingData& ratings) {
    for (const auto& summary : summariseRatings(ratings.groups.front().trials))
        for (const double half : summary.halfIntervals) demandNumbers({half});
}

void analyse(const StudyData<LevelAnswer>& data) {
    const PsychometricModel model{PsychometricShape::normal};
    for (const auto& own : psychometricByParticipant(data.groups.front().trials, model))
        if (own.fit.error.empty()) demandNumbers({own.fit.function.threshold, own.fit.function.width});
}

template <class Read>
void tryOne(Read read, std::string_view text) {
    const NamedText file{text, "f"};
    const auto data = read(std::span{&file, 1});
    if (data)
        analyse(data.value);
    else
        fuzz::demandClearRefusal(data, data.value.groups.empty());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto text = fuzz::asText(data, size);
    tryOne(readIdentification, text);
    tryOne(readLocations, text);
    tryOne(readChoices, text);
    tryOne(readRatings, text);
    tryOne(readLevels, text);
    tryOne(readPercentCounts, text);
    tryOne([](const auto& files) { return readLevelAnswers(files, {"level_db", "correct", false}); }, text);
    return 0;
}
