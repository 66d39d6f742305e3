// SPDX-License-Identifier: MIT
// Groups isolation recordings: repetitions share a condition, and layers share the reference of their drive.
#include "Lab/Study/Attenuation.h"
#include "Lab/Study/Coupling.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <map>
#include <tuple>

namespace physvib {
namespace {

using Levels = std::vector<double>;

/// Mean levels of the reference recordings of one drive.
struct GammaSums {
    Levels levels;
    std::size_t count = 0;
    bool areAlike = true; ///< all have the same number of channels
};
using Drive = std::tuple<std::string, std::string, double>;

Drive driveOf(const IsolationCondition& c) { return {c.axis, c.voltage, c.frequencyHz}; }

std::map<Drive, GammaSums> referencesIn(const std::vector<IsolationMeasurement>& measurements) {
    std::map<Drive, GammaSums> references;
    for (const IsolationMeasurement& m : measurements) {
        if (!m.isReference) continue;
        GammaSums& sums = references[driveOf(m.condition)];
        if (sums.count++ == 0) sums.levels.assign(m.levels.size(), 0.0);
        sums.areAlike &= sums.levels.size() == m.levels.size();
        for (std::size_t i = 0; i < std::min(sums.levels.size(), m.levels.size()); ++i)
            sums.levels[i] += m.levels[i];
    }
    for (auto& [drive, sums] : references)
        for (double& level : sums.levels) level /= static_cast<double>(sums.count);
    return references;
}

} // namespace

IsolationStudy summariseIsolation(const std::vector<IsolationMeasurement>& measurements) {
    const auto references = referencesIn(measurements);
    std::map<std::tuple<std::string, std::string, std::string, Drive>, IsolationResult> results;
    for (const IsolationMeasurement& m : measurements) {
        if (m.isReference) continue;
        const auto reference = references.find(driveOf(m.condition));
        if (reference == references.end() || !reference->second.areAlike ||
            reference->second.levels.size() != m.levels.size())
            return {
                m.source +
                    ": expected a reference of the same frequency, voltage and axis, with as many channels",
                {}};
        if (std::ranges::any_of(reference->second.levels, [](double level) { return !(level > 0.0); }))
            return {m.source + ": expected a reference that vibrates on every channel", {}};
        IsolationResult& result = results[{m.condition.material, m.condition.softener, m.condition.thickness,
                                           driveOf(m.condition)}];
        result.condition = m.condition;
        result.gammas.push_back(combinedAttenuation(attenuationRatios(m.levels, reference->second.levels)));
    }
    if (results.empty()) return {"expected recordings behind a layer, found none", {}};
    IsolationStudy study;
    for (auto& [key, result] : results) {
        const Moments moments{result.gammas};
        result.mean = moments.mean;
        result.deviation = moments.deviation;
        study.results.push_back(std::move(result));
    }
    return study;
}

} // namespace physvib
