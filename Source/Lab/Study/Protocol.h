// SPDX-License-Identifier: MIT
// A study protocol as data: conditions (stimuli and layouts) and sessions (tasks, repetitions and orders),
// and the check of the calls that it contains.
#pragma once
#include "Core/Actuators/Exposure.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/QuestMethod.h"
#include "Lab/Study/StimulusJob.h"
#include "Lab/Study/StudyTasks.h"
#include "Stimuli/PinkNoise.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {
/// All spatiotemporal patterns of a number of actuators (thesis 3.2).
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
    std::vector<std::string> labels{}; ///< names of the values in answers and rows; empty: the values
    std::string alternative{};         ///< the only alternative with these values; empty: all parts
    std::string otherValue{};          ///< value of all other parts
    bool operator==(const StudyFactor&) const = default;
};

/// A quantity of a call that follows the trial's level, as a ratio: at0Db * 10^(level / 20 dB).
struct StudyVariable {
    std::string name; ///< with its unit, e.g. "decay_per_s"
    double at0Db = 1.0;
    bool isRoving = false; ///< follows the trial's rove_db, which then changes nothing else
    bool operator==(const StudyVariable&) const = default;
    double valueAt(double levelDb) const noexcept {
        return std::round(at0Db * std::pow(10.0, 0.05 * levelDb) * 1e6) * 1e-6; // few digits, as levels have
    }
};

/// Stimuli made by calls of `physvib`: every combination of the factors' values replaces {name} in `call`.
/// {alternative}, {object}, {level_db} and the variables are replaced by those of the trial.
struct CallSet {
    std::vector<StudyFactor> factors;
    std::string call; ///< e.g. "render drop --set pair={pair} --method {alternative}"
    std::vector<StudyVariable> variables{};
    bool operator==(const CallSet&) const = default;
};

/// Scenes that the participant sees and feels: calls of `render` with options of its scene.
struct WorldSet : CallSet {
    /// The participant drags bodies and tilts the world for any time; else the scene ends by its call.
    bool isInteractive = false;
    /// Metres of the world per metre on the display (50: 1:50); 0: as large as fits.
    double displayScale = 0.0;
    bool operator==(const WorldSet&) const = default;
};

using StimulusSet = std::variant<PatternSet, GridSet, CallSet, WorldSet>;

/// The calls of a stimulus set; null for other kinds. Any thread.
inline const CallSet* findCalls(const StimulusSet& set) noexcept {
    if (const auto* world = std::get_if<WorldSet>(&set)) return world;
    return std::get_if<CallSet>(&set);
}

/// A contact recording for the material of that frequency, for calls that play recordings.
struct StudySoundFile {
    double frequencyHz = 0.0;
    std::string file; ///< a WAV file, or synthetic-SEED
    bool operator==(const StudySoundFile&) const = default;
};

/// The participant's own picture for bodies of a material.
struct MaterialPictureFile {
    std::string material; ///< part of the material's name
    std::string file;     ///< PNG; {participant} in the path is replaced by the participant's code
    bool operator==(const MaterialPictureFile&) const = default;
};

struct ConditionPlan {
    std::string name;
    std::string group; ///< conditions of a group stay together, e.g. those of one day
    std::string layout = "phone4";
    double frequencyHz = 205.0, levelG = 1.0;
    StimulusSet stimuli;
    bool isAtResonance = false; ///< use the resonance of the layout's actuators instead of frequencyHz
    /// Localisation blur of simulated observers here, as a share of the field; 0: the observer's own.
    double observerBlur = 0.0;
    bool operator==(const ConditionPlan&) const = default;
};

/// An alternative to choose; its level is relative to the condition's.
struct Alternative {
    std::string name;
    double levelDb = 0.0;
    bool operator==(const Alternative&) const = default;
};

/// Method of adjustment: the participant changes this alternative's level.
struct Adjustment {
    std::string alternative;
    double startDb = 0.0, stepDb = 1.0, minDb = -40.0, maxDb = 40.0;
    bool hasRandomStart = false; ///< start at a random step of the range, from the seed
    bool operator==(const Adjustment&) const = default;
};

/// Transformed up-down staircase (Levitt 1971) on this alternative's level: choosing it is correct.
struct StaircasePlan {
    std::string alternative;
    double startDb = 6.0, stepDb = 2.0; ///< the step is halved at every reversal, down to minStepDb
    /// Start levels of several staircases, instead of startDb: each trial belongs to a random one of those
    /// that have not ended.
    std::vector<double> startsDb{};
    double minStepDb = 0.5, minDb = 0.0, maxDb = 40.0;
    double upRatio = 1.0; ///< upward step / downward step; 3, `down` 1: converges to 75 % (Kaernbach 1991)
    int down = 2;         ///< consecutive correct answers that lower the level; 2 converges to 70.7 %
    int reversals = 8;    ///< number of reversals at which a staircase ends
    int maxTrials = 200;  ///< maximum for each staircase
    bool operator==(const StaircasePlan&) const = default;
    std::vector<double> starts() const { return startsDb.empty() ? std::vector{startDb} : startsDb; }
};

/// Labels for the ends of rating scales where a session has none.
inline constexpr std::array<std::string_view, 2> defaultAnchors{"Strongly disagree", "Strongly agree"};

struct SessionPlan {
    enum class Order {
        given,  ///< as listed
        random, ///< shuffled across repetitions
        blocks  ///< each repetition shuffled separately
    };
    std::string name;
    bool isTraining = false; ///< not analysed
    StudyTask task = StudyTask::identify;
    std::string question;         ///< text for the participant; empty: the default text of the task
    std::string instruction;      ///< text of the page before the session; empty: that of the task
    bool givesFeedback = false;   ///< shows after each answer whether it was correct
    double intervalSeconds = 0.0; ///< parts are played in sequence at this interval; 0: one by one
    Order order = Order::random;
    int repetitions = 1;
    int minTouches = 0;         ///< explore: minimum number of touches; 0: every stimulus once
    int maxPlays = 0;           ///< maximum plays of a trial's stimulus; 0: unlimited
    double minSeconds = 0.0;    ///< minimum time with each part of a trial before an answer is accepted
    double answerSeconds = 0.0; ///< time for an answer, from where one is accepted; 0: unlimited
    double breakBeforeSeconds = 0.0;
    int breakEvery = 0; ///< trials; 0: no breaks
    double breakSeconds = 0.0;
    std::vector<Alternative> alternatives; ///< choose, adjust
    bool bothOrders = false; ///< choose: each order of the two alternatives once, instead of a random order
    std::vector<std::string> answers; ///< choose: answers to one stimulus, instead of alternatives
    std::vector<std::string> objects; ///< rate: parts of every trial, in random order
    std::vector<std::string> scales;  ///< rate; empty: a score of each object, side by side
    std::string reference;            ///< rate: an object that is also presented by name, before the others
    int points = 0;                   ///< rate: highest score of scores from 1; 0: from 0 to 100
    bool isQuestionnaire = false;     ///< rate, describe: one trial per condition, without a stimulus
    bool comparesPairs = false;       ///< rate: the parts of a trial are two of the stimuli
    std::vector<std::string> definitions; ///< description of each scale, shown beside it; may be empty
    std::vector<std::string> anchors;     ///< labels of the scale ends; empty: defaultAnchors
    bool showsNumbers = false;            ///< rate: show the score as a number
    std::optional<Adjustment> adjustment;
    std::optional<StaircasePlan> staircase;
    std::optional<QuestMethod> quest;
    std::string correct;  ///< choose: the correct alternative; empty: a staircase's, or none
    int untilCorrect = 0; ///< ends after this many correct answers in a row; 0: after all trials
    double roveDb = 0.0;  ///< all parts of a trial are raised or lowered together by up to this, at random
    std::string modulus;  ///< estimate: the stimulus that each trial begins with
    double modulusNumber = 10.0; ///< number assigned to the modulus
    bool mayBeEmpty = false;     ///< describe: an empty answer is accepted
    std::string levelsFrom;      ///< an earlier session whose adjusted levels apply here
    std::string levelsFile;      ///< path of a file with levels of other participants, instead of levelsFrom
    bool operator==(const SessionPlan&) const = default;

    AnswerKind answerKind() const noexcept { return taskDescription(task).answer; }
    /// Names of the scores of the task `rate`; empty for other tasks, even with objects.
    const std::vector<std::string>& scores() const noexcept {
        static const std::vector<std::string> none;
        return answerKind() != AnswerKind::scores ? none : scales.empty() ? objects : scales;
    }
    bool ratesSideBySide() const noexcept { return scales.empty() && !objects.empty(); }
    /// The alternative whose level a staircase or QUEST+ controls; null if there is none.
    const std::string* adaptedAlternative() const noexcept {
        return staircase ? &staircase->alternative : quest ? &quest->alternative : nullptr;
    }
    /// True if answers are correct or not.
    bool hasCorrectAnswers() const noexcept {
        return answerKind() == AnswerKind::label || adaptedAlternative() != nullptr || !correct.empty();
    }
    /// Chance of a correct guess in a choice.
    double guessRate() const noexcept { return 1.0 / static_cast<double>(alternatives.size()); }
};

struct Protocol {
    enum class ConditionOrder { given, random, latinSquare };
    std::string name, title;
    int seed = 1;
    bool hasPinkNoise = false;                             ///< played on another output than the stimuli
    double pinkNoiseDb = PinkNoise::safeDb;                ///< its root mean square, in dB of full scale
    double exposureLimit = exposureActionMetresPerSecond2; ///< A(8), m/s^2: the study pauses at this exposure
    std::vector<StudySoundFile> sounds;                    ///< recordings for calls with --method SV
    std::vector<MaterialPictureFile> pictures;             ///< replace the textures of their materials
    ConditionOrder conditionOrder = ConditionOrder::given;
    double conditionBreakSeconds = 0.0; ///< before every condition but the first
    std::string closingQuestion;        ///< answered in free text at the end; empty: no question
    std::string translation; ///< texts for participants: a built-in language or a file; empty: English
    std::vector<ConditionPlan> conditions;
    std::vector<SessionPlan> sessions; ///< each runs in every condition
    std::vector<StimulusLevel> levels; ///< contents of the sessions' levelsFile
    std::string folder;                ///< searched first for the protocol's files; not stored in a file
    bool operator==(const Protocol&) const = default;
};

/// Empty, or the first inconsistency, e.g. `sessions[1].alternatives: expected two or more to choose from,
/// found 1`. The reader of the file checks the ranges of single fields. Any thread (allocates).
std::string validate(const Protocol& protocol);

/// Empty, or a level that the sessions need and the protocol's levels lack. Any thread (allocates).
std::string levelsError(const Protocol& protocol);

/// A picture's path for that participant. Any thread (allocates).
std::string picturePath(const MaterialPictureFile& picture, const std::string& participant);

/// All scales of a protocol, in the order of their first mention. Any thread (allocates).
std::vector<std::string> protocolScales(const Protocol& protocol);

/// Separates the labels of two stimuli that are compared.
constexpr std::string_view pairSeparator = " & ";

/// A stimulus of a condition: its label and, for a CallSet, the values of its factors.
struct StimulusItem {
    std::string label;
    std::vector<std::pair<std::string, std::string>> values;
};

/// All stimuli of a condition, in a fixed order. Any thread (allocates).
std::vector<StimulusItem> conditionStimuli(const ConditionPlan& condition);

/// Stimuli of a session's trials: those of the condition, every pair of them ("200 & 250"), or one without a
/// label that stands for the whole condition. Any thread (allocates).
std::vector<StimulusItem> stimulusItems(const SessionPlan& session, const ConditionPlan& condition);

/// True if a variable of the condition's calls follows rove_db alone. Any thread.
bool hasRovingVariable(const ConditionPlan& condition) noexcept;

/// The call of a stimulus, names replaced; `part`: the alternative or object. Any thread (allocates).
std::string resolveCall(const CallSet& set, const StimulusItem& item, const std::string& part, double levelDb,
                        double roveDb = 0.0);

/// True if the condition's calls name the alternative or object. Any thread (allocates).
bool hasPartPlaceholders(const ConditionPlan& condition);

/// What a trial's level changes in the condition's calls other than the strength of the stimulus: variables
/// that are used elsewhere than right after --level-g, and level_db if it is used elsewhere than right after
/// --level-db. `byRove`: what rove_db changes. Any thread (allocates).
std::vector<std::string> nonGainVariables(const ConditionPlan& condition, bool byRove = false);

/// All alternatives and objects that can be put into calls; else one empty name. Any thread (allocates).
std::set<std::string> callPartNames(const Protocol& protocol);

/// Empty, or the first error that `check` returns for the calls of the condition, each as it stands in a
/// row. Any thread (allocates).
std::string firstCallError(const Protocol& protocol, const ConditionPlan& condition,
                           const std::function<std::string(const std::string& call)>& check);

/// Number of stimuli, computed without listing them. Any thread.
double stimulusCount(const ConditionPlan& condition) noexcept;

// Validates the `physvib` calls in a protocol. Protocols are untrusted files. Their calls are run, and also
// stand in every row of the trial file, where users copy them into a shell. So a call may only render and
// read files below its folder. The options that write files are listed in Standalone/Calls/CallOptions.h.

/// Length limit of a call with its recordings. A row of the trial file holds the calls of all parts.
constexpr std::size_t maxCallBytes = 2000;

/// Letters (including non-ASCII), digits, and characters that a shell does not interpret.
constexpr bool isPlainCharacter(char c) noexcept {
    const bool isLetter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    return isLetter || (c >= '0' && c <= '9') ||
           std::string_view{"_-+.,:=/%"}.find(c) != std::string_view::npos;
}

/// True for a relative path that stays below its starting folder and has only plain characters and spaces.
/// Names that are not paths pass too. Any thread.
constexpr bool isPlainPath(std::string_view path) noexcept {
    if (path.starts_with('/') ||
        !std::ranges::all_of(path, [](char c) { return c == ' ' || isPlainCharacter(c); }))
        return false;
    for (;;) {
        const std::size_t end = path.find('/');
        if (path.substr(0, end) == "..") return false;
        if (end == std::string_view::npos) return true;
        path.remove_prefix(end + 1);
    }
}

/// Empty, or the reason why a protocol may not make this call (with all names filled in), from its characters
/// and paths. Any thread (allocates).
inline std::string callError(std::string_view call) {
    if (!call.starts_with("render ") && !call.starts_with("stimulus "))
        return "expected render or stimulus, and what they take";
    if (const auto unknown = call.find('{'); unknown != std::string_view::npos)
        return "expected names of factors or variables in braces, or alternative, object, level_db; found " +
               std::string(call.substr(unknown, call.find('}', unknown) - unknown)) + "}";
    if (!std::ranges::all_of(call, [](char c) { return c == ' ' || isPlainCharacter(c); }))
        return "expected letters, digits, spaces and _-+.,:=/%";
    while (!call.empty()) {
        const std::string_view word = call.substr(0, call.find(' '));
        call.remove_prefix(std::min(word.size() + 1, call.size()));
        for (std::string_view rest = word; !rest.empty();) { // splits words like 80=ball.wav
            const std::string_view piece = rest.substr(0, rest.find_first_of("=,:"));
            rest.remove_prefix(std::min(piece.size() + 1, rest.size()));
            if (!isPlainPath(piece))
                return "expected files in the folder or below, found " + std::string(word);
        }
    }
    return {};
}

} // namespace physvib
