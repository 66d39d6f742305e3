// SPDX-License-Identifier: GPL-3.0-or-later
// Protocols that are well written and answer nothing: `physvib study check` names each, `study run` refuses
// what the check refuses, and the protocols that are shipped have none of it.
#include "Calls.h"
#include <sstream>

namespace physvib::spoiled_studies_test {

struct Spoiled {
    const char* name;
    bool isRefused; ///< else: a warning
    const char* conditions;
    const char* sessions;
    const char* words; ///< in the line of the check
};

// clang-format off
#define TONE(more) R"({"name": "c", "layout": "phone1", "stimuli": "grid", "columns": 1, "rows": 1, "seconds": 0.1, "level_g": 0.2)" more "}"
#define CALL(name, more, options) R"({"name": ")" name R"(", "layout": "phone1", "stimuli": "calls", )" more R"("call": "stimulus phantom --at 0.5,0.5 --layout phone1 --seconds 0.1 )" options "\"}"
#define FACTOR(name, values) R"("factors": [{"name": ")" name R"(", "values": [)" values "]}], "
#define TWO R"("alternatives": [{"name": "a"}, {"name": "b"}])"
#define CHOOSE(more) R"({"name": "main", "task": "choose", )" TWO more "}"
#define STEPS(more) CHOOSE(R"(, "staircase": {"alternative": "b")" more "}")
#define RATE(more) R"({"name": "main", "task": "rate", "scales": ["hard"])" more "}"

constexpr Spoiled spoiled[] = {
    // levels that change nothing
    {"a staircase on a call without a level", true, CALL("c", "", "--level-g 0.2"), STEPS(R"(, "most_db": 10)"), "b: its level changes nothing"},
    {"QUEST+ on such a call", true, CALL("c", "", "--level-g 0.2"), CHOOSE(R"(, "quest": {"alternative": "b", "most_db": 10})"), "b: its level changes nothing"},
    {"an adjustment on such a call", true, CALL("c", "", "--level-g 0.2"), R"({"name": "main", "task": "adjust", )" TWO R"(, "adjustment": {"alternative": "b", "least_db": -10, "most_db": 5}})", "b: its level changes nothing"},
    {"a variable that the call lacks", true, CALL("c", R"("variables": [{"name": "g", "at_0_db": 0.1}], )", "--level-g 0.2"), STEPS(R"(, "most_db": 10)"), "b: its level changes nothing"},
    {"levels from a matching that moves nothing", true, CALL("c", "", "--level-g 0.2 --frequency {alternative}"), R"({"name": "match", "training": true, "task": "adjust", "alternatives": [{"name": "80"}, {"name": "160"}], "adjustment": {"alternative": "160", "least_db": -10, "most_db": 0}}, {"name": "main", "task": "choose", "alternatives": [{"name": "80"}, {"name": "160"}], "levels_from": "match"})", "160: its level changes nothing"},
    {"an alternative's own level on such a call", true, CALL("c", "", "--level-g 0.2"), R"({"name": "main", "task": "choose", "alternatives": [{"name": "a"}, {"name": "b", "level_db": -6}]})", "alternatives a, b are the same samples"},
    {"mixed staircases on such a call", true, CALL("c", FACTOR("hz", R"("80", "160")"), "--frequency {hz} --level-g 0.2"), STEPS(R"(, "starts_db": [8, 2], "most_db": 10)"), "b: its level changes nothing"},
    // parts that are one sound
    {"alternatives that the call does not name", true, TONE(""), CHOOSE(""), "alternatives a, b are the same samples"},
    {"alternatives that the call takes for one", true, CALL("c", "", "--level-g {alternative}"), R"({"name": "main", "task": "choose", "alternatives": [{"name": "0.2"}, {"name": "0.20"}]})", "alternatives 0.2, 0.20 are the same samples"},
    {"a right one that another one is too", true, CALL("c", "", "--level-g {alternative}"), R"({"name": "main", "task": "choose", "alternatives": [{"name": "0.1"}, {"name": "0.10"}, {"name": "0.2"}], "correct": "0.10"})", "alternatives 0.10, 0.1 are the same samples"},
    {"a factor of an alternative that there is not", true, CALL("c", R"("factors": [{"name": "hz", "values": ["150", "180"], "alternative": "hihger", "otherwise": "100"}], )", "--frequency {hz} --level-g 0.2"), R"({"name": "main", "task": "choose", "alternatives": [{"name": "low"}, {"name": "higher"}], "correct": "higher"})", "factor hz changes nothing"},
    {"objects that the call does not name", true, CALL("c", FACTOR("hz", R"("80", "160")"), "--frequency {hz} --level-g 0.2"), RATE(R"(, "objects": ["wood", "steel"])"), "objects wood, steel are the same samples"},
    {"two of three objects that are one", false, CALL("c", "", "--level-g {object}"), RATE(R"(, "objects": ["0.1", "0.10", "0.2"])"), "objects 0.1, 0.10 are the same samples"},
    {"roved alternatives that are one", true, CALL("c", R"("variables": [{"name": "g", "at_0_db": 0.1}], )", "--level-g {g}"), CHOOSE(R"(, "rove_db": 2)"), "alternatives a, b are the same samples"},
    // factors and stimuli
    {"a factor that the call lacks", true, CALL("c", FACTOR("decay", R"("10", "40")"), "--level-g 0.2"), RATE(""), "factor decay changes nothing"},
    {"one of two factors that the call lacks", true, CALL("c", R"("factors": [{"name": "hz", "values": ["80", "160"]}, {"name": "decay", "values": ["10", "40"]}], )", "--frequency {hz} --level-g 0.2"), RATE(""), "factor decay changes nothing"},
    {"values that are one number", true, CALL("c", FACTOR("g", R"("0.2", "0.20", "2e-1")"), "--level-g {g}"), RATE(""), "factor g changes nothing"},
    {"a gap of patterns of one pulse", true, R"({"name": "c", "layout": "phone1", "stimuli": "calls", )" FACTOR("gap", R"("0.05", "0.2")") R"("call": "stimulus pattern A-250 --layout phone1 --level-g 0.2 --gap {gap}"})", RATE(""), "factor gap changes nothing"},
    {"two of three values that are one number", false, CALL("c", FACTOR("g", R"("0.1", "0.2", "0.20")"), "--level-g {g}"), RATE(""), "stimuli 0.2 and 0.20 are the same samples"},
    {"places on a single actuator", true, R"({"name": "c", "layout": "phone1", "stimuli": "grid", "columns": 3, "rows": 1, "seconds": 0.1, "level_g": 0.2})", R"({"name": "main", "task": "identify"})", "are the same samples, as all others"},
    // conditions
    {"two equal conditions", false, TONE("") "," R"({"name": "d", "layout": "phone1", "stimuli": "grid", "columns": 1, "rows": 1, "seconds": 0.1, "level_g": 0.2})", RATE(""), "conditions c and d are the same samples"},
    {"a condition's level that its call does not take", false, CALL("c", R"("level_g": 0.1, )", "--level-g 0.2") "," CALL("d", R"("level_g": 0.4, )", "--level-g 0.2"), RATE(""), "conditions c and d are the same samples"},
    {"a condition's frequency that its call does not take", false, CALL("c", R"("frequency_hz": 80, )", "--level-g 0.2") "," CALL("d", R"("frequency_hz": 160, )", "--level-g 0.2"), RATE(""), "conditions c and d are the same samples"},
    // numbers that cannot be reached
    {"reversals beyond the trials", false, TONE(""), STEPS(R"(, "most_db": 10, "reversals": 20, "most_trials": 14)"), "reversals: 20 need 31 trials at least, and most_trials is 14"},
    {"reversals beyond the trials, 3 down", false, TONE(""), STEPS(R"(, "most_db": 10, "down": 3, "reversals": 10, "most_trials": 20)"), "reversals: 10 need 21 trials at least"},
    {"a step beyond the range", true, TONE(""), STEPS(R"(, "most_db": 8, "step_db": 12)"), "step_db 12 is larger than the range from 0 to 8 dB"},
    {"an adjustment's step beyond the range", true, TONE(""), R"({"name": "main", "task": "adjust", )" TWO R"(, "adjustment": {"alternative": "b", "least_db": -2, "most_db": 2, "step_db": 5}})", "step_db 5 is larger than the range from -2 to 2 dB"},
    {"a staircase from below its reference", true, TONE(""), STEPS(R"(, "start_db": -6, "least_db": -10, "most_db": 8)"), "b is at -6 dB, the others at up to 0 dB"},
    {"a staircase that its own level puts below", true, TONE(""), R"({"name": "main", "task": "choose", "alternatives": [{"name": "a"}, {"name": "b", "level_db": -10}], "staircase": {"alternative": "b", "start_db": 6, "most_db": 12}})", "b is at -4 dB, the others at up to 0 dB"},
    {"QUEST+ below its reference", true, TONE(""), CHOOSE(R"(, "quest": {"alternative": "b", "least_db": -20, "most_db": -1})"), "the others at up to 0 dB"},
    {"a staircase that may go below its reference", false, TONE(""), STEPS(R"(, "least_db": -6, "most_db": 10)"), "least_db -6: there b is below the others"},
    {"right answers in a row beyond the trials", false, TONE(""), R"({"name": "main", "task": "identify", "repetitions": 4, "until_correct": 6})", "until_correct: 6 in a row cannot be reached in 4 trials"},
    {"a time that so few plays never last", true, TONE(""), RATE(R"(, "least_s": 3, "most_plays": 2)"), "least_s: 3 s cannot be reached by most_plays 2, which last 0.20 s"},
    {"breaks after the last trial", false, TONE(""), RATE(R"(, "repetitions": 10, "break_every": 20, "break_s": 60)"), "break_every: 20 trials are never over before the last of 10"},
    // the study as a whole
    {"a training only", false, TONE(""), RATE(R"(, "training": true)"), "expected one that is no training"},
    {"a day's work", false, TONE(""), RATE(R"(, "repetitions": 1000}, {"name": "more", "task": "estimate", "repetitions": 1000, "break_every": 10, "break_s": 60)"), "more than 180 min"},
    {"hours of breaks", false, TONE(""), RATE(R"(, "break_before_s": 3600}, {"name": "b", "task": "estimate", "break_before_s": 3600}, {"name": "c", "task": "estimate", "break_before_s": 3600}, {"name": "d", "task": "estimate", "break_before_s": 3600)"), "more than 180 min"},
    {"a roving of what is no level", false, CALL("c", R"("variables": [{"name": "hz", "at_0_db": 150}], )", "--frequency {hz} --level-g 0.2"), CHOOSE(R"(, "rove_db": 2, "staircase": {"alternative": "b", "start_db": 4, "least_db": 0.1, "most_db": 6, "step_db": 1})"), "rove_db moves hz of condition c by a factor of up to 1.26"},
};
// clang-format on
#undef TONE
#undef CALL
#undef FACTOR
#undef TWO
#undef CHOOSE
#undef STEPS
#undef RATE

class SpoiledStudies : public test::CommandLine {
protected:
    static std::string lineWith(const std::string& text, const std::string& words) {
        std::istringstream lines{text};
        for (std::string line; std::getline(lines, line);)
            if (line.find(words) != line.npos) return line;
        return {};
    }
};

TEST_F(SpoiledStudies, EachIsNamedAndWhatIsRefusedIsNotRun) {
    static_assert(std::size(spoiled) >= 34);
    for (const Spoiled& one : spoiled) {
        SCOPED_TRACE(one.name);
        write("s.json", std::string{R"({"physvib_protocol": 1, "name": "s", "title": "t", "conditions": [)"} +
                            one.conditions + "], \"sessions\": [" + one.sessions + "]}");
        const auto checked = call("study check s.json");
        EXPECT_EQ(checked.exitCode, one.isRefused ? 1 : 0) << checked.err << checked.out;
        const std::string line = lineWith(checked.out, one.words);
        EXPECT_TRUE(line.starts_with(one.isRefused ? "error: " : "warning: ")) << line << checked.out;
        if (one.isRefused) refuses("study run s.json --observer simulated --out rows", 1, one.words, 1);
    }
}

TEST_F(SpoiledStudies, NoneOfTheShippedProtocolsIsAmongThem) {
    std::vector<std::string> names;
    std::istringstream list{call("study list").out};
    for (std::string line; std::getline(list, line);) names.push_back(line.substr(0, line.find(' ')));
    const std::filesystem::path examples = PHYSVIB_SOURCE_DIR "/Docs/protocol-examples";
    for (const auto& entry : std::filesystem::directory_iterator{examples})
        if (entry.path().extension() == ".json") names.push_back("'" + entry.path().string() + "'");
    EXPECT_GE(names.size(), 24u);
    for (const std::string& name : names) {
        const auto checked = runs("study check " + name + " --accept-deviations");
        for (const char* words :
             {"error: ", "same samples", "changes nothing", "cannot be reached", "larger than", "the others",
              "there is no break", "rove_db", "more than 180 min", "no training"})
            EXPECT_EQ(lineWith(checked.out, words), "") << name;
    }
}

// Faults planted into the built-in protocols, one at a time: each is refused by `study run` and by `study
// check`, with place and expectation.

struct PlantedFault {
    const char *protocol, *from, *to; ///< the first `from` becomes `to`
    const char* words;                ///< of the line that refuses it
};

constexpr PlantedFault plantedFaults[] = {
    {"phantom-grids", "\"sessions\": [", "\"sessions\": ", "mine.json: line "},
    {"phantom-grids", "\"RING-3x3\"", "\"PHONE-3x3\"",
     "mine.json: conditions: expected a name of its own for each"},
    {"phantom-grids", "\"layout\": \"ring4\"", "\"layout\": \"rings\"", "mine.json: condition RING-3x3: "},
    {"phantom-grids", "\"columns\": 3", "\"columns\": 3, \"level_g\": 5",
     "mine.json: condition PHONE-3x3, 1,1: "},
    {"patterns", "\"enchanters\": 2", "\"enchanters\": 3",
     "mine.json: condition PHONE-2: expected as many enchanters as the layout has (2), found 3"},
    {"model-or-sound", "\"rubber-concrete\"", "\"glass-glass\"", "mine.json: condition drop: call: "},
    {"model-or-sound", "--seconds 4", "--seconds 4 --out x.wav", "mine.json: conditions[0].call: "},
    {"model-or-sound", "\"synthetic-1\"", "\"nobody.wav\"", "nobody.wav"},
    {"model-or-sound", "\"level_db\": -8", "\"level_db\": 8", "mine.json: condition drop, pair="},
    {"model-or-sound", "--method {alternative}", "--method {alternativ}", "mine.json: conditions[0].call: "},
    {"eight-methods", "--layout study1", "--layout phone1",
     "mine.json: condition box: call: --layout: expected the condition's own layout, study1, found phone1"},
    {"model-or-sound", "\"layout\": \"study1\"", "\"layout\": \"phone4\"",
     "mine.json: condition drop: call: --layout: expected the condition's own layout, phone4, found study1"},
    {"magnitudes", "\"stimuli\"", "\"layout\": \"phone1\", \"stimuli\"",
     "mine.json: condition PHONE: call: --layout: expected the condition's own layout, phone1, found phone4"},
    {"eight-methods", "\"least_s\": 10", "\"least_s\": -10", "mine.json: sessions[0].least_s: expected "},
    {"level-steps", "\"choose\"", "\"estimate\"", "mine.json: sessions[0]."},
};

class StudyFaults : public test::CommandLine {};

TEST_F(StudyFaults, EveryPlantedFaultIsRefusedWithItsPlaceBeforeAnythingIsAsked) {
    for (const PlantedFault& fault : plantedFaults) {
        std::string text = call(std::string{"study show "} + fault.protocol).out;
        const std::size_t at = text.find(fault.from);
        ASSERT_NE(at, std::string::npos) << fault.protocol << ": " << fault.from;
        write("mine.json", text.replace(at, std::string_view{fault.from}.size(), fault.to));
        refuses("study run mine.json --observer simulated --out rows", 1, fault.words, 1);
        const auto checked = call("study check mine.json");
        EXPECT_EQ(checked.exitCode, 1) << fault.from << " -> " << fault.to;
        std::string place = fault.words; // the check's page names the file once
        if (place.starts_with("mine.json: ")) place.erase(0, 11);
        EXPECT_TRUE(has((checked.out + checked.err), place))
            << "\nsaid: " << checked.out.substr(0, 500) << checked.err;
    }
}

} // namespace physvib::spoiled_studies_test
