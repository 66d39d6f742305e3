// SPDX-License-Identifier: MIT
// A stimulus as a value: what `physvib stimulus`, a protocol and a screen ask for, before anything is made of
// it.
#pragma once
#include "Core/Limits.h"
#include "Core/PhantomPanner.h"
#include "Lab/Study/PhantomGrid.h"
#include "Stimuli/PulsePattern.h"
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace physvib {

/// What numbers of a job may be, ends included; protocols and options have the same ranges.
struct StimulusRange {
    double least, most;
    constexpr bool holds(double number) const noexcept { return number >= least && number <= most; }
};
namespace stimulusRanges {
inline constexpr StimulusRange share{0.0, 1.0}, frequencyHz{limits::slowestToneHz, limits::maxFrequencyHz},
    levelG{1e-6, 1000.0}, gapSeconds{0.0, 10.0}, exponent{0.01, 100.0}, seconds{0.001, 600.0};
} // namespace stimulusRanges

/// Pulses on one enchanter after the other.
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

/// A sensation between the enchanters.
struct PhantomJob {
    std::variant<FieldPlace, GridPlace> at;
    PanningLaw law = PanningLaw::linear;
    double exponent = 1.0, seconds = 1.0;
    std::string recording{}; ///< a file of one channel instead of a tone, at its own rate and length; empty:
                             ///< none
    bool operator==(const PhantomJob&) const = default;

    FieldPlace place() const noexcept;
};

struct StimulusJob {
    std::variant<PatternJob, PhantomJob> what;
    std::string layout = "phone4";             ///< a preset's name, or a layout file
    std::optional<double> frequencyHz = 205.0; ///< none: the resonance of the layout's actuators
    double levelG = 1.0;                       ///< peak acceleration at gain 1
    bool operator==(const StimulusJob&) const = default;
};

/// The words of a call that makes a job, each before its value. Whoever writes and whoever reads a call takes
/// them from here.
namespace stimulusWords {
inline constexpr char at[] = "--at", grid[] = "--grid", cell[] = "--cell", points[] = "--points",
                      layout[] = "--layout", frequency[] = "--frequency", levelG[] = "--level-g",
                      gap[] = "--gap", law[] = "--law", exponent[] = "--exponent", seconds[] = "--seconds";
inline constexpr char resonance[] = "resonance"; ///< instead of a frequency
} // namespace stimulusWords

/// The arguments of `physvib` that make it again, "stimulus phantom --at 0.5,0.5 ...". Any thread
/// (allocates).
std::string textOf(const StimulusJob& job);

/// The grid of such a call, with its points; none: it names no grid. Any thread.
std::optional<PhantomGrid> gridOf(std::string_view call) noexcept;

/// Which word of a job's text is wrong (a pattern has none), and what was expected of it. No words: nothing.
struct JobFault {
    std::string_view word{};
    std::string expected{};
    explicit operator bool() const noexcept { return !expected.empty(); }
    std::string words() const {
        return (word.empty() ? "" : std::string{word} + ": ") + "expected " + expected;
    }
};

/// The first that is wrong with the job on any layout. Any thread (allocates).
JobFault faultOf(const StimulusJob& job);

} // namespace physvib
