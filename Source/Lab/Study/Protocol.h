// SPDX-License-Identifier: MIT
// A study as data: conditions (what is felt, where) and sessions (what is asked, how often, in which order).
#pragma once
#include "Core/Actuators/HandWeighting.h"
#include "Core/PhantomPanner.h"
#include "Lab/Study/PhantomGrid.h"
#include "Lab/Study/QuestMethod.h"
#include "Lab/Study/StimulusLevels.h"
#include "Lab/Study/StudyTasks.h"
#include "Stimuli/PinkNoise.h"
#include "Stimuli/PulsePattern.h"
#include "Stimuli/Stimulus.h"
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

/// All spatiotemporal patterns of so many enchanters (thesis 3.2).
struct PatternSet {
    int enchanters = 0;
    std::vector<double> pulseSeconds{pulseDurationsSeconds.begin(), pulseDurationsSeconds.end()};
    double gapSeconds = pulseGapSeconds;
    bool operator==(const PatternSet&) const = default;
};

/// Phantoms on a grid (thesis 4.1, 4.2).
struct GridSet {
    int columns = 0, rows = 0;
    PhantomGrid::Points points = PhantomGrid::Points::corners;
    PanningLaw law = PanningLaw::linear;
    double exponent = 1.0, seconds = 1.0;
    bool operator==(const GridSet&) const = default;
    PhantomGrid grid() const noexcept { return {columns, rows, points}; }
};

struct StudyFactor {
    std::string name;
    std::vector<std::string> values;
    bool operator==(const StudyFactor&) const = default;
};

/// Anything that a call of the program makes: every combination of the factors' values, put into `call` where
/// it says {name}; also {alternative}, {object} and {level_db} of the trial.
struct CallSet {
    std::vector<StudyFactor> factors;
    std::string call; ///< e.g. "render drop --set pair={pair} --method {alternative}"
    bool operator==(const CallSet&) const = default;
};

/// Scenes that the participant watches while they are felt: calls of `render` and its scene's options.
struct WorldSet : CallSet {
    bool hasHands = false; ///< bodies are dragged and the world is tilted, for as long as the participant
                           ///< wants; else it runs for the call's seconds
    /// So many metres of the world are one on the display (50: 1:50); 0: as large as fits.
    double displayScale = 0.0;
    bool operator==(const WorldSet&) const = default;
};

using StimulusSet = std::variant<PatternSet, GridSet, CallSet, WorldSet>;

/// The calls of a set; null if it makes none. Any thread.
inline const CallSet* callSetOf(const StimulusSet& set) noexcept {
    if (const auto* world = std::get_if<WorldSet>(&set)) return world;
    return std::get_if<CallSet>(&set);
}

/// The recorded contact of the material of that frequency, for calls that play recordings.
struct StudySoundFile {
    double frequencyHz = 0.0;
    std::string file; ///< a WAV file, or synthetic-SEED
    bool operator==(const StudySoundFile&) const = default;
};

/// What bodies of a material look like, of the participant's own choosing.
struct MaterialPictureFile {
    std::string material; ///< a word in the material's name
    std::string file;     ///< PNG; {participant} in it is the participant's code
    bool operator==(const MaterialPictureFile&) const = default;
};

struct ConditionPlan {
    std::string name;
    std::string group; ///< conditions of a group stay together, e.g. those of one day
    std::string layout = "phone4";
    double frequencyHz = 205.0, levelG = 1.0;
    StimulusSet stimuli;
    bool isAtResonance = false; ///< of the layout's actuators, instead of frequencyHz
    double observerBlur = 0.0;  ///< of places as a simulated observer feels them here, share of the field; 0:
                                ///< the observer's own
    bool operator==(const ConditionPlan&) const = default;
};

/// One of the things to choose from; the level is relative to the condition's.
struct Alternative {
    std::string name;
    double levelDb = 0.0;
    bool operator==(const Alternative&) const = default;
};

/// Method of adjustment: the participant moves this alternative's level.
struct Adjustment {
    std::string alternative;
    double startDb = 0.0, stepDb = 1.0, leastDb = -40.0, mostDb = 40.0;
    bool startsAnywhere = false; ///< at any step of the range instead, by the seed
    bool operator==(const Adjustment&) const = default;
};

/// Transformed up-down staircase (Levitt 1971) on this alternative's level: choosing it is correct.
struct StaircasePlan {
    std::string alternative;
    double startDb = 6.0, stepDb = 2.0; ///< the step is halved at every reversal, down to leastStepDb
    double leastStepDb = 0.5, leastDb = 0.0, mostDb = 40.0;
    int down = 2;      ///< correct answers in a row that make it harder; 2 aims at 70.7 %
    int reversals = 8; ///< then it ends
    int mostTrials = 200;
    bool operator==(const StaircasePlan&) const = default;
};

/// Of the two ends of a scale, where a session names none.
inline constexpr std::array<std::string_view, 2> usualAnchors{"Strongly disagree", "Strongly agree"};

struct SessionPlan {
    enum class Order {
        given,  ///< as listed
        random, ///< all shuffled together
        blocks  ///< each repetition shuffled by itself
    };
    std::string name;
    bool isTraining = false; ///< not analysed
    StudyTask task = StudyTask::identify;
    std::string question; ///< what a participant reads; empty: the words of the task
    Order order = Order::random;
    int repetitions = 1;
    int fewestTouches = 0;     ///< explore: so many; 0: every stimulus once
    int mostPlays = 0;         ///< of a trial's stimulus; 0: as often as wanted
    double leastSeconds = 0.0; ///< with each part of a trial before the answer unlocks
    double breakBeforeSeconds = 0.0;
    int breakEvery = 0; ///< trials; 0: no breaks
    double breakSeconds = 0.0;
    std::vector<Alternative> alternatives; ///< choose, adjust
    bool bothOrders = false; ///< choose: every order of two alternatives once, instead of a random one
    std::vector<std::string> objects;     ///< rate: parts of every trial, in random order
    std::vector<std::string> scales;      ///< rate
    std::vector<std::string> definitions; ///< what each scale means, to be read beside it; none: nothing
    std::vector<std::string> anchors;     ///< of its two ends; none: usualAnchors
    bool showsNumbers = false;            ///< rate: how many points were set
    std::optional<Adjustment> adjustment;
    std::optional<StaircasePlan> staircase;
    std::optional<QuestMethod> quest;
    std::string levelsFrom; ///< an earlier session whose adjustments hold here
    std::string levelsFile; ///< or others' (Lab/Files/LevelsFile.h)
    bool operator==(const SessionPlan&) const = default;

    AnswerKind answer() const noexcept { return describe(task).answer; }
    /// Which alternative's level follows the answers, by a staircase or QUEST+; none if no level does.
    const std::string* adaptedAlternative() const noexcept {
        return staircase ? &staircase->alternative : quest ? &quest->alternative : nullptr;
    }
    /// of choices
    double guessRate() const noexcept { return 1.0 / static_cast<double>(alternatives.size()); }
};

struct Protocol {
    enum class ConditionOrder { given, random, latinSquare };
    std::string name, title;
    int seed = 1;
    bool hasPinkNoise = false;                  ///< on another output than the stimuli
    double pinkNoiseDb = PinkNoise::safeDb;     ///< its root mean square, in dB of full scale
    double exposureLimit = exposureActionValue; ///< A(8) in m/s^2 of a participant, from which on the study
                                                ///< pauses
    std::vector<StudySoundFile> sounds;         ///< what calls with --method SV get
    std::vector<MaterialPictureFile> pictures;  ///< instead of the textures of their materials
    ConditionOrder conditionOrder = ConditionOrder::given;
    double conditionBreakSeconds = 0.0; ///< before every condition but the first
    std::string closingQuestion; ///< answered in the participant's own words at the end; empty: nothing is
                                 ///< asked
    std::string words; ///< what participants read: built-in words, or a file of them; empty: English
    std::vector<ConditionPlan> conditions;
    std::vector<SessionPlan> sessions; ///< of every condition
    std::vector<StimulusLevel> levels; ///< of the sessions' levelsFile
    std::string folder;                ///< where its files are looked for first; no part of a file
    bool operator==(const Protocol&) const = default;
};

/// What makes no sense as a whole, `sessions[1].alternatives: expected two or more to choose from, found 1`;
/// empty if all does. Ranges of single fields are the reader's business. Any thread (allocates).
std::string validate(const Protocol& protocol);

/// What the levels of a protocol lack of those that its sessions want; empty if nothing. Any thread
/// (allocates).
std::string levelsFault(const Protocol& protocol);

/// A picture's path for that participant. Any thread (allocates).
std::string picturePath(const MaterialPictureFile& picture, const std::string& participant);

/// All scales of a protocol, in the order of their first mention. Any thread (allocates).
std::vector<std::string> scalesOf(const Protocol& protocol);

/// A stimulus of a condition: what it is called, and, of a CallSet, its factors' values.
struct StimulusItem {
    std::string label;
    std::vector<std::pair<std::string, std::string>> values;
};

/// All stimuli of a condition, in a fixed order. Any thread (allocates).
std::vector<StimulusItem> stimuliOf(const ConditionPlan& condition);

/// The call of a stimulus with all names filled in; `part` is the alternative or object. Any thread
/// (allocates).
std::string callOf(const CallSet& set, const StimulusItem& item, const std::string& part,
                   const std::string& levelDb);

/// What alternatives and objects can be put into calls; at least one, which has no name. Any thread
/// (allocates).
std::set<std::string> callPartsOf(const Protocol& protocol);

/// Empty, or the first that `faultOf` finds wrong with a call which the condition can make, as it would stand
/// in a row. Any thread (allocates).
std::string firstCallFault(const Protocol& protocol, const ConditionPlan& condition,
                           const std::function<std::string(const std::string& call)>& faultOf);

/// Number of stimuli without making them. Any thread.
double stimulusCount(const ConditionPlan& condition) noexcept;

} // namespace physvib
