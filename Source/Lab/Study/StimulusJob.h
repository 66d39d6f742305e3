// SPDX-License-Identifier: MIT
// A stimulus specification as a value, used by `physvib stimulus`, protocols and screens; its events; and
// levels of stimuli that other participants adjusted.
#pragma once
#include "Core/Limits.h"
#include "Core/PhantomPanner.h"
#include "Io/Result.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Summaries.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {
/// Valid ranges of a job's numbers, inclusive. Protocols and options share them.
struct ParameterRange {
    double min, max;
    constexpr bool contains(double number) const noexcept { return number >= min && number <= max; }
};
namespace parameterRanges {
inline constexpr ParameterRange share{0.0, 1.0}, frequencyHz{limits::slowestToneHz, limits::maxFrequencyHz},
    levelG{1e-6, 1000.0}, gapSeconds{0.0, 10.0}, exponent{0.01, 100.0}, seconds{0.001, 600.0},
    decayPerSecond{0.0, 10000.0};
} // namespace parameterRanges

/// Consecutive pulses on single actuators.
struct PatternJob {
    std::string label; ///< "ABA-250"
    double gapSeconds = pulseGapSeconds;
    bool operator==(const PatternJob&) const = default;
};

/// A point of a grid.
struct GridPlace {
    PhantomGrid grid;
    GridCell cell;
    bool operator==(const GridPlace&) const = default;
};

/// The quantity that levelG specifies: the peak; the peak of an undamped tone with the same root mean square
/// over the length; that of an undamped tone of one second with the same energy; or that of an undamped tone
/// whose root mean square is the stimulus' over the length behind the weighting W_h (see Exposure.h).
enum class LevelMeasure { peak, rms, energy, weighted };
inline constexpr std::array<std::string_view, 4> levelMeasureNames{"peak", "rms", "energy", "weighted"};

/// A phantom sensation between the actuators.
struct PhantomJob {
    std::variant<FieldPlace, GridPlace> target;
    PanningLaw law = PanningLaw::linear;
    double exponent = 1.0, seconds = 1.0;
    double decayPerSecond = 0.0; ///< of the amplitude, exp(-decay t); 0: a rectangular burst
    LevelMeasure levelMeasure = LevelMeasure::peak;
    std::string recording{}; ///< a mono file instead of the tone, of its own rate and length
    bool operator==(const PhantomJob&) const = default;

    FieldPlace place() const noexcept {
        if (const auto* const point = std::get_if<GridPlace>(&target)) return point->grid.place(point->cell);
        return *std::get_if<FieldPlace>(&target);
    }
    /// Peak, relative to levelG, at which a tone of that frequency has the level by levelMeasure.
    double peakFactor(double frequencyHz) const noexcept;
};

struct StimulusJob {
    std::variant<PatternJob, PhantomJob> stimulus;
    std::string layout = "phone4";             ///< a preset's name, or a layout file
    std::optional<double> frequencyHz = 205.0; ///< none: use the resonance of the layout's actuators
    double levelG = 1.0;                       ///< peak acceleration at gain 1
    bool operator==(const StimulusJob&) const = default;
};

/// Option names in the text of a job, each before its value, for its writers and readers.
namespace stimulusOptions {
inline constexpr char place[] = "--at", grid[] = "--grid", cell[] = "--cell", points[] = "--points",
                      layout[] = "--layout", frequency[] = "--frequency", levelG[] = "--level-g",
                      gap[] = "--gap", law[] = "--law", exponent[] = "--exponent", seconds[] = "--seconds",
                      decay[] = "--decay", levelMeasure[] = "--level-of";
inline constexpr char resonance[] = "resonance"; ///< in place of a frequency
} // namespace stimulusOptions

/// The `physvib` arguments that recreate the job, "stimulus phantom --at 0.5,0.5 ...". Any thread
/// (allocates).
std::string textOf(const StimulusJob& job);

/// The grid and its point rule in such text; nullopt if it has no grid. Any thread.
std::optional<PhantomGrid> parseGrid(std::string_view call) noexcept;

/// The invalid option of a job's text (empty for a pattern label) and the expected value. An empty
/// expectation means no error.
struct JobError {
    std::string_view option{};
    std::string expected{};
    explicit operator bool() const noexcept { return !expected.empty(); }
    std::string text() const {
        return (option.empty() ? "" : std::string{option} + ": ") + "expected " + expected;
    }
};

/// The first error of the job that does not depend on a layout. Any thread (allocates).
JobError jobError(const StimulusJob& job);

// Creates a stimulus (events) from a StimulusJob and an actuator layout.

/// Empty, or one line naming the actuator of the job that the layout lacks. Any thread (allocates).
std::string layoutError(const StimulusJob& job, const LayoutDescription& layout);

/// Events of a valid job without a recording, on its layout; or an error in one line. Message thread only.
Result<Stimulus> makeStimulus(const StimulusJob& job, const LayoutDescription& layout);

// Stimulus levels from other participants' adjustments, averaged per stimulus (thesis 5.2.1: three experts).

struct StimulusLevel {
    std::string condition, stimulus, alternative; ///< alternative: the one that was adjusted
    double levelDb = 0.0;
    std::size_t participants = 0;
    double deviationDb = 0.0; ///< between participants; 0 for one
    bool operator==(const StimulusLevel&) const = default;
};

/// Mean adjustments: over each participant's repetitions, then over participants. Any thread (allocates).
inline std::vector<StimulusLevel> averageLevels(const std::vector<LevelTrial>& trials,
                                                const std::string& alternative) {
    // (condition, stimulus), participant
    std::map<std::pair<std::string, std::string>, std::map<std::string, std::vector<double>>> settings;
    for (const LevelTrial& trial : trials)
        if (trial.kind == LevelTrial::Kind::adjustment)
            settings[{trial.condition, trial.stimulus}][trial.participant].push_back(trial.value);
    std::vector<StimulusLevel> levels;
    for (const auto& [place, participants] : settings) {
        std::vector<double> means;
        for (const auto& [participant, values] : participants) means.push_back(Moments{values}.mean);
        const Moments moments{means};
        levels.push_back(
            {place.first, place.second, alternative, moments.mean, means.size(), moments.deviation});
    }
    return levels;
}

/// The level of a stimulus; null if it has none. Any thread.
inline const StimulusLevel* findLevel(const std::vector<StimulusLevel>& levels, const std::string& condition,
                                      const std::string& stimulus) {
    const auto found = std::ranges::find_if(levels, [&](const StimulusLevel& level) {
        return level.condition == condition && level.stimulus == stimulus;
    });
    return found == levels.end() ? nullptr : &*found;
}

} // namespace physvib
