// SPDX-License-Identifier: MIT
// Fuzz target of the readers of study files, and of the analyses on whatever they let through: no number may
// be missing.
#include "Fuzzing.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Study/Identification.h"
#include <cmath>

namespace {
using namespace physvib;

void analyse(const StudyData<IdentificationTrial>& data) {
    for (const auto& condition : data.conditions) {
        const auto it = informationTransfer(ConfusionMatrix{withTolerance(condition.trials, 1)});
        fuzz::demand(std::isfinite(it.bits) && std::isfinite(it.biasBits) && std::isfinite(it.leastBits) &&
                         std::isfinite(it.trialsPerCell),
                     "a number is missing");
    }
}

void analyse(const StudyData<LocationTrial>& data) {
    for (const auto& condition : data.conditions) {
        const auto normals = responseNormals(condition.trials);
        if (!normals.fault.empty()) continue;
        for (const double p : percentCounts(normals, likelihoodMap(normals, 31, 16), "c").percent)
            fuzz::demand(std::isfinite(p), "a number is missing");
    }
}

void analyse(const StudyData<PercentCounts>& data) {
    for (const auto& condition : data.conditions)
        if (const auto& counts = condition.trials.front(); counts.rows < 8 && counts.columns < 8)
            perceptualResolution(counts);
}

void analyse(const StudyData<ChoiceTrial>& data) {
    for (const auto& summary : summariseChoices(data.conditions.front().trials))
        if (const auto& interval = summary.shares.front().interval)
            fuzz::demand(std::isfinite(interval->least) && std::isfinite(interval->most),
                         "a number is missing");
}

void analyse(const StudyData<LevelTrial>& data) {
    for (const auto& summary : summariseLevels(data.conditions.front().trials))
        fuzz::demand(std::isfinite(summary.estimate) && std::isfinite(summary.deviation),
                     "a number is missing");
}

void analyse(const RatingData& ratings) {
    for (const auto& summary : summariseRatings(ratings.conditions.front().trials))
        for (const double half : summary.halfIntervals)
            fuzz::demand(std::isfinite(half), "a number is missing");
}

void analyse(const StudyData<LevelAnswer>& data) {
    const PsychometricModel model{PsychometricShape::normal};
    for (const auto& own : psychometricByParticipant(data.conditions.front().trials, model))
        fuzz::demand(!own.fit.fault.empty() ||
                         (std::isfinite(own.fit.function.threshold) && std::isfinite(own.fit.function.width)),
                     "a number is missing");
}

template <class T>
bool isEmpty(const StudyData<T>& data) {
    return data.conditions.empty();
}

template <class Read>
void tryOne(Read read, std::string_view text) {
    const NamedText file{text, "f"};
    const auto data = read(std::span{&file, 1});
    if (data)
        analyse(data.value);
    else
        fuzz::demandClearRefusal(data, isEmpty(data.value));
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
