// SPDX-License-Identifier: MIT
// Protocols as JSON, and the thesis' studies as protocols.
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/Translation.h"
#include "Support/Has.h"
#include "Support/Studies.h"
#include <gtest/gtest.h>
#include <map>

namespace physvib::protocol_file_test {

const std::string head = R"({ "physvib_protocol": 1, "name": "p", )";
const std::string oneGrid =
    R"("conditions": [{ "name": "A", "stimuli": "grid", "columns": 3, "rows": 3 }], )";

TEST(ProtocolFile, TheShortestProtocolHasDefaults) {
    const auto p = readProtocol(head + oneGrid + R"("sessions": [{ "name": "main" }] })", "p.json");
    ASSERT_TRUE(p) << p.error;
    EXPECT_EQ(p.value.sessions[0].task, StudyTask::identify);
    EXPECT_EQ(p.value.conditions[0].frequencyHz, 205.0);
    EXPECT_EQ(std::get<GridSet>(p.value.conditions[0].stimuli).columns, 3);
}

TEST(ProtocolFile, FaultsAreNamedByTheirField) {
    const auto readError = [](const std::string& text) { return readProtocol(text, "p.json").error; };
    const auto fault = [&](const std::string& session, const std::string& before = oneGrid) {
        return readError(head + before + R"("sessions": [{ "name": "main")" + session + "}] }");
    };
    EXPECT_EQ(fault(R"(, "repetitions": 0)"), "p.json: sessions[0].repetitions: expected 1 to 1000, found 0");
    EXPECT_EQ(fault(R"(, "task": "guess")"),
              "p.json: sessions[0].task: expected one of explore, identify, locate, choose, rate, adjust, "
              "estimate, describe, found \"guess\"");
    EXPECT_EQ(fault(R"(, "order": "random", "sound": 1)"), "p.json: sessions[0]: unknown field \"sound\"");
    EXPECT_EQ(fault(R"(, "task": "rate")"),
              "p.json: sessions[0].scales: expected them of the task rate, and of no other");
    EXPECT_EQ(fault("", R"("conditions": [{ "name": "A", "stimuli": "grid", "columns": 17, "rows": 3 }], )"),
              "p.json: conditions[0].columns: expected 1 to 16, found 17");
    EXPECT_EQ(fault(R"(, "task": "rate", "scales": ["x"])"),
              "p.json: scales: expected names that no other column of a trial file has, found \"x\"");
    EXPECT_EQ(fault("", oneGrid + R"("words": "../ko.json", )"),
              "p.json: words: expected a name, or a file in the folder or below");
    EXPECT_EQ(readError(R"({ "physvib_protocol": 2 })"),
              "p.json: physvib_protocol: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(readError("{"),
              "p.json: line 1, column 2: syntax error while parsing object key - unexpected end "
              "of input; expected string literal");
}

TEST(ProtocolFile, AWorldIsASceneThatIsWatchedAndMayHaveHands) {
    const auto worldOf = [](const std::string& more) {
        return readProtocol(
            head +
                R"("conditions": [{ "name": "A", "stimuli": "world", "factors": [{ "name": "pair", "values": ["wood-wood"] }], )" +
                more + R"( }], "sessions": [{ "name": "main" }] })",
            "p.json");
    };
    const auto watched = worldOf(R"("call": "render drop --set pair={pair}")"),
               played = worldOf(R"("call": "render box-study --set pair={pair}", "hands": true)");
    ASSERT_TRUE(watched && played) << watched.error << played.error;
    EXPECT_FALSE(std::get<WorldSet>(watched.value.conditions[0].stimuli).isInteractive);
    EXPECT_TRUE(std::get<WorldSet>(played.value.conditions[0].stimuli).isInteractive);
    EXPECT_EQ(conditionStimuli(played.value.conditions[0]).front().label, "wood-wood");
    EXPECT_EQ(worldOf(R"("call": "stimulus phantom --at 0.5,0.5 {pair}")").error,
              "p.json: conditions[0].call: expected render and a scene, which a world needs");
}

TEST(ProtocolFile, ScalesHaveADefinitionEachAndTwoAnchors) {
    const auto fault = [](const std::string& more) {
        return readProtocol(head + oneGrid +
                                R"("sessions": [{ "name": "main", "task": "rate", "scales": ["a", "b"], )" +
                                more + "}] }",
                            "p.json")
            .error;
    };
    EXPECT_EQ(
        fault(R"("definitions": ["It was a.", "It was b."], "anchors": ["no", "yes"], "show_numbers": true)"),
        "");
    EXPECT_EQ(fault(R"("definitions": ["It was a."])"),
              "p.json: sessions[0].definitions: expected one of each scale");
    EXPECT_EQ(fault(R"("anchors": ["no", "so so", "yes"])"),
              "p.json: sessions[0].anchors: expected two, of the left end and of the right");
}

TEST(ProtocolFile, EveryBuiltInProtocolIsReadBackAsWritten) {
    ASSERT_EQ(builtInProtocols().size(), 8u);
    for (const Protocol& p : builtInProtocols()) {
        const std::string text = protocolJson(p);
        const auto again = readProtocol(text, p.name);
        ASSERT_TRUE(again) << again.error << text;
        EXPECT_EQ(again.value, p) << p.name;
        EXPECT_EQ(protocolJson(again.value), text);
        EXPECT_EQ(findProtocol(p.name).value, p);
    }
    EXPECT_EQ(findProtocol("none").error, "no protocol \"none\" (see physvib study list)");
}

TEST(ProtocolFile, VersionsAsPublishedMakeEveryChangeThatTheListKnows) {
    std::vector<std::string> names;
    for (const Protocol& p : thesisVersions()) {
        names.push_back(p.name);
        EXPECT_EQ(readProtocol(protocolJson(p), p.name).value, p) << p.name;
        EXPECT_EQ(findProtocol(p.name).value, p);
        const Protocol builtIn = findProtocol(p.name.substr(0, p.name.size() - thesisSuffix.size())).value;
        EXPECT_NE(protocolHash(p), protocolHash(builtIn)) << "rows say which of the two they are of";
        std::size_t edits = 0, left = findDeviations(p).size();
        for (const ThesisDeviation& one : findDeviations(builtIn)) edits += one.edit != ThesisEdit::none;
        EXPECT_GE(edits, 1u) << p.name;
        EXPECT_EQ(left + edits, findDeviations(builtIn).size()) << p.name;
        for (const ConditionPlan& condition : p.conditions)
            if (findCalls(condition.stimuli) != nullptr) {
                const std::string& call = findCalls(condition.stimuli)->call;
                EXPECT_TRUE(has(call, " --timing release --gamma 0.1"));
                EXPECT_EQ(call.ends_with("each --set drive_gain=1 --limiter blocks"), p.name[0] == 'e')
                    << call;
                EXPECT_FALSE(has(call, "--sound-match rms"));
            }
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{"patterns-thesis", "phantom-grids-thesis", "phantom-places-thesis",
                                        "model-or-sound-thesis", "eight-methods-thesis"}));
    const auto groups = [](const char* name) {
        return std::ranges::count_if(findProtocol(name).value.conditions,
                                     [](const ConditionPlan& c) { return !c.group.empty(); });
    };
    EXPECT_EQ(groups("phantom-grids"), 6);
    EXPECT_EQ(groups("phantom-grids-thesis"), 0);
    EXPECT_EQ(groups("phantom-places-thesis"), 0);
    EXPECT_EQ(groups("patterns-thesis"), 6) << "a day for PHONE, one for RING";
    const auto restsBefore = [](const char* name) {
        return findProtocol(name).value.sessions.back().breakBeforeSeconds;
    };
    EXPECT_EQ(restsBefore("patterns"), 120.0);
    EXPECT_EQ(restsBefore("patterns-thesis"), 0.0);
    EXPECT_EQ(restsBefore("eight-methods-thesis"), 0.0);
    EXPECT_EQ(restsBefore("phantom-grids-thesis"), 120.0);
    Protocol changed = thesisVersions().front();
    changed.seed += 1;
    EXPECT_TRUE(findDeviations(changed).empty()) << "of a changed one nobody knows what holds";
}

/// Trials of a participant's main sessions, by condition.
std::map<std::string, int> mainTrials(const Protocol& p) {
    std::map<std::string, int> counts;
    for (const auto& [trial, answer] : answered(p))
        if (!p.sessions[trial.session].isTraining) ++counts[p.conditions[trial.condition].name];
    return counts;
}

TEST(ProtocolFile, TheThesisStudiesHaveTheirNumbersOfTrials) {
    const auto counts = [](const char* name) { return mainTrials(findProtocol(name).value); };
    EXPECT_EQ(counts("patterns"), (std::map<std::string, int>{{"PHONE-2", 28},
                                                              {"PHONE-3", 78},
                                                              {"PHONE-4", 168},
                                                              {"RING-2", 28},
                                                              {"RING-3", 78},
                                                              {"RING-4", 168}}));
    EXPECT_EQ(counts("phantom-grids"), (std::map<std::string, int>{{"PHONE-3x3", 90},
                                                                   {"PHONE-4x4", 160},
                                                                   {"PHONE-5x5", 250},
                                                                   {"RING-3x3", 90},
                                                                   {"RING-4x4", 160},
                                                                   {"RING-5x5", 250}}));
    EXPECT_EQ(
        counts("phantom-places"),
        (std::map<std::string, int>{
            {"PHONE-LINEAR", 175}, {"PHONE-LOGARITHM", 175}, {"RING-LINEAR", 175}, {"RING-LOGARITHM", 175}}));
    EXPECT_EQ(counts("model-or-sound"), (std::map<std::string, int>{{"drop", 108}}));
    EXPECT_EQ(counts("eight-methods"), (std::map<std::string, int>{{"box", 80}}));
}

// Words of a language: what is wrong with a file of them, and what the Korean ones have to hold.

const std::string wordsHead = R"({"physvib_words": 1, "name": "xx", "language": "X", "texts": )";

TEST(Words, ATextThatIsNotThereStaysEnglish) {
    const auto words =
        readTranslation(wordsHead + R"({"Begin": "Los", "trial {n}": "{n}. Versuch"}})", "x.json");
    ASSERT_TRUE(words) << words.error;
    EXPECT_EQ(words.value.translate("Begin"), "Los");
    EXPECT_EQ(words.value.translate("Close"), "Close");
    EXPECT_TRUE(findTranslation("en").value.texts.empty());
    std::string names = "en";
    for (const Translation& one : builtInTranslations()) names += ", " + one.name;
    EXPECT_EQ(findTranslation("xx").error, "no words \"xx\"; expected " + names + " or a file");
}

TEST(Words, FaultsAreNamedByTheirText) {
    const auto fault = [](const std::string& texts) {
        return readTranslation(wordsHead + texts + "}", "x.json").error;
    };
    EXPECT_EQ(fault(R"({"trial {n}": "Versuch"})"),
              "x.json: texts.trial {n}: expected the same names in braces as in the English text");
    EXPECT_EQ(fault(R"({"Begin": 1})"), "x.json: texts.Begin: expected a string, found a number");
    EXPECT_EQ(fault("[]"), "x.json: texts: expected an object, found an array");
}

TEST(Words, EachLanguageHasAllThatBuiltInProtocolsAsk) {
    ASSERT_FALSE(builtInTranslations().empty());
    for (const Translation& words : builtInTranslations()) {
        const auto expect = [&](const std::string& text) {
            EXPECT_TRUE(text.empty() || words.texts.contains(text)) << words.name << ": " << text;
        };
        for (const Protocol& protocol : builtInProtocols()) {
            expect(protocol.closingQuestion);
            for (const SessionPlan& session : protocol.sessions) {
                expect(session.question);
                for (const auto* list :
                     {&session.scales, &session.definitions, &session.anchors, &session.objects})
                    for (const std::string& text : *list) expect(text);
            }
        }
    }
}

} // namespace physvib::protocol_file_test
