// SPDX-License-Identifier: GPL-3.0-or-later
// A call of `render` is a value: each of its options is in it, and the same words are the same value.
#include "Calls/CallOptions.h"
#include "Calls/LoadedRender.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Experiment.h"
#include "Options/OptionTable.h"
#include "Scene/ActuatorFile.h"
#include "Support/FileTesting.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib::render_words_test {

Result<RenderJob> jobOf(const std::string& call) {
    OptionTable table{"render", {}};
    RenderJob job;
    declareRenderOptions(table, job);
    const auto parsed = parseText(table, call);
    return parsed.error.empty() ? Result<RenderJob>{job} : Failure{parsed.reason()};
}

/// A word that the option takes, other than what it is if nobody says one.
std::string otherWord(const Option& option) {
    const std::string name = option.spellings.front();
    if (name == "--field") return "2,3";
    if (name == "--set") return "a=b";
    if (name == "--sound") return "200=hit.wav";
    if (name == "--method") return "AF-FV-DRF";
    if (name == "--law") return "energy";
    if (std::holds_alternative<bool*>(option.target)) return "true";
    if (option.check == Option::Check::choice)
        return option.choices.front() == option.initial ? option.choices.back() : option.choices.front();
    if (option.check == Option::Check::range)
        return plainNumber(option.initial == plainNumber(option.minValue) ? option.maxValue
                                                                          : option.minValue);
    if (option.check == Option::Check::ending) return "other" + option.type.substr(option.type.rfind('.'));
    return "other";
}

TEST(RenderWords, EveryOptionChangesTheJob) {
    OptionTable table{"render", {}};
    RenderJob job;
    declareRenderOptions(table, job);
    std::size_t tried = 0;
    for (const Option& option : table.options) {
        if (option.spellings.back() == "--help") continue;
        const std::string name = option.spellings.front(),
                          call = option.isPositional ? otherWord(option) : name + '=' + otherWord(option);
        const auto once = jobOf(call), again = jobOf(call);
        ASSERT_TRUE(once) << call << ": " << once.error;
        EXPECT_EQ(once.value, again.value) << call;
        EXPECT_NE(once.value, RenderJob{}) << call;
        ++tried;
    }
    EXPECT_GE(tried, 35u);
}

TEST(RenderWords, TextIsReadWhereItStands) {
    const auto job = jobOf(
        "drop --set ball=steel --set n=3 --field 0.5,2 --law log-outer --method AF-FV-DRF --sound "
        "200=a.wav --sound 90.5=b=c.wav --sound oak=d.wav --limiter off --marker m.wav --marker-of hits");
    ASSERT_TRUE(job) << job.error;
    EXPECT_EQ(job.value.settings, (SceneSettings{{"ball", "steel"}, {"n", "3"}}));
    EXPECT_EQ(job.value.field, (FieldSize{0.5, 2.0}));
    EXPECT_EQ(job.value.law, PanningLaw::logOuter);
    EXPECT_EQ(job.value.methodName(), "AF-FV-DRF");
    EXPECT_EQ(job.value.sounds,
              (RecordedSounds{{"", 200.0, "a.wav"}, {"", 90.5, "b=c.wav"}, {"oak", 0.0, "d.wav"}}));
    EXPECT_EQ(job.value.limiting, Limiting::off);
    EXPECT_EQ(job.value.marks(), MarkedOnsets::hits);
    EXPECT_EQ(jobOf("drop").value.marks(), std::nullopt);
    EXPECT_EQ(jobOf("drop --method SV").value.methodName(), "SV");
}

TEST(RenderWords, WrongTextIsRefusedWithItsOption) {
    EXPECT_EQ(jobOf("drop --field 1").error, "--field: expected W,H in metres (0.001 to 1e6), found \"1\"");
    EXPECT_EQ(jobOf("drop --field 1,nan").error,
              "--field: expected W,H in metres (0.001 to 1e6), found \"1,nan\"");
    EXPECT_EQ(jobOf("drop --set =3").error, "--set: expected NAME=VALUE");
    EXPECT_EQ(jobOf("drop --law loud").error, "--law: expected linear, log, log-outer, energy, neighbours, "
                                              "auto, distance or triangles, found \"loud\"");
    EXPECT_EQ(jobOf("drop --method AX-FV-DRV").error,
              "--method: expected a name from AV-FV-DRV to AF-FF-DRF, or SV, found \"AX-FV-DRV\"");
    for (const char* word : {"0=a.wav", "oak", "oak=", "=a.wav"})
        EXPECT_EQ(jobOf(std::string{"drop --sound "} + word).error,
                  "--sound: expected MATERIAL=FILE.wav, a material and its recorded contact, or HZ=FILE.wav, "
                  "its frequency");
    EXPECT_EQ(jobOf("drop --sound 80=a.wav --sound 80.0=b.wav").error,
              "--sound: expected one recording of 80, found another");
    EXPECT_EQ(jobOf("drop --sound oak=a.wav --sound oak=a.wav").error,
              "--sound: expected one recording of oak, found another");
}

TEST(RenderWords, WhatDoesNotFitTogetherIsAFaultOfTheJob) {
    RenderJob job;
    EXPECT_EQ(inputOptionsError(job), "render: give either a scene or --from-events EVENTS.csv");
    job.scene = "drop";
    EXPECT_EQ(inputOptionsError(job), "");
    EXPECT_EQ(renderOptionsError(job), "render: nothing to write; give --out, --events, --picture, --movie, "
                                       "--pattern, --contact-sound or --marker");
    job.isRemapped = true;
    EXPECT_EQ(sceneOptionsError(job), "--remap: expected an --actuator, whose band is to be used");
    job = {};
    job.playsRecordings = true;
    EXPECT_EQ(sceneOptionsError(job), "--method SV: expected a --sound for each material");
}

// Frequencies are moved to where every actuator of the layout plays, whichever stands first.

using CommonBand = FolderTest;

TEST_F(CommonBand, IsWhatAllActuatorsOfALayoutPlay) {
    const auto bandOf = [&](const std::vector<FrequencyBand>& bands) {
        LayoutDescription layout = presetLayout("phone4"); // without actuators
        for (std::size_t j = 0; j < bands.size(); ++j) {
            const auto path = folder / (std::to_string(j) + ".json");
            ActuatorProfile profile;
            profile.name = "a" + std::to_string(j);
            if (bands[j].isKnown()) profile.band = bands[j];
            put(path, actuatorJson(profile));
            layout.actuators[j].actuator = path.string();
        }
        const auto job = jobOf("drop --actuator layout --equalise off --remap on");
        const auto choice = chooseActuators(job.value, layout);
        return choice ? plainNumber(choice.value.remap.band.lowHz) + " to " +
                            plainNumber(choice.value.remap.band.highHz)
                      : choice.error;
    };
    const FrequencyBand deep{40, 200}, middle{100, 300}, high{150, 800}, wide{20, 1000}, far{400, 900};
    EXPECT_EQ(bandOf({middle}), "100 to 300");
    for (const auto& bands : {std::vector{deep, middle}, {middle, deep}})
        EXPECT_EQ(bandOf(bands), "100 to 200");
    for (const auto& bands : {std::vector{wide, middle}, {middle, wide}})
        EXPECT_EQ(bandOf(bands), "100 to 300");
    for (const auto& bands : {std::vector{deep, high, wide}, {high, wide, deep}, {wide, deep, high}})
        EXPECT_EQ(bandOf(bands), "150 to 200");
    for (const auto& bands : {std::vector{deep, far}, {far, deep}, {wide, deep, far}})
        EXPECT_EQ(bandOf(bands), "--remap: the layout's actuators have no band in common");
    EXPECT_EQ(bandOf({deep, {}}), "a1: band_hz is not known: nothing to remap into");
}

// What a row of a study says is read as the value that it was written from.

Result<StimulusJob> read(const std::string& call) {
    OptionTable words{"physvib", {}};
    StimulusOptions options;
    OptionTable& stimulus = words.addCommand("stimulus", {});
    declareStimulus(stimulus, options);
    if (const auto parsed = parseText(words, call); !parsed.error.empty()) return Failure{parsed.error};
    return readStimulus(stimulus, options);
}

void expectBack(const StimulusJob& job) {
    const auto back = read(textOf(job));
    ASSERT_TRUE(back) << textOf(job) << ": " << back.error;
    EXPECT_EQ(back.value, job) << textOf(job) << " became " << textOf(back.value);
}

TEST(StimulusWords, WhatIsWrittenIsReadAsTheSameValue) {
    expectBack({PatternJob{"ABA-250", 0.2}, "ring3", std::nullopt, 0.5});
    expectBack({PhantomJob{FieldPlace{0.1, 1.0}, PanningLaw::logOuter, 2.5, 0.25}, "own.json", 60.5, 1e-6});
    for (const auto points : {PhantomGrid::Points::corners, PhantomGrid::Points::middles})
        expectBack({PhantomJob{GridPlace{{7, 5, points}, {2, 6}}}});
}

TEST(StimulusWords, SoIsEveryStimulusOfTheBuiltInProtocols) {
    std::size_t jobs = 0;
    for (const Protocol& protocol : builtInProtocols())
        for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
            for (const StimulusItem& item : conditionStimuli(protocol.conditions[c])) {
                TrialRecord record;
                record.trial.condition = c;
                record.trial.stimulus = item.label;
                for (const TrialJob& job : trialJobs(protocol, record))
                    if (const auto* const stimulus = std::get_if<StimulusJob>(&job))
                        expectBack(*stimulus), ++jobs;
            }
    EXPECT_GT(jobs, 300u);
}

TEST(StimulusWords, WhatIsNoStimulusIsToldInTheWordsOfTheCall) {
    EXPECT_EQ(read("stimulus phantom --at 0.5,1.5").error,
              "--at: expected X,Y from 0 to 1, found \"0.5,1.5\"");
    EXPECT_EQ(read("stimulus phantom --grid 7x5.5 --cell 1,1").error,
              "--grid: expected COLUMNSxROWS like 7x5, found \"7x5.5\"");
    EXPECT_EQ(read("stimulus phantom --grid 7x5 --cell 1,8").error,
              "--cell: expected r,c of the grid (row 1 is the upper one), found \"1,8\"");
    EXPECT_EQ(read("stimulus phantom --grid 7x5").error,
              "give either --at X,Y or --grid CxR with --cell r,c");
    EXPECT_EQ(read("stimulus pattern ABA").error,
              "expected a pattern like ABA-250 (one to three enchanters, then milliseconds), found \"ABA\"");
    EXPECT_EQ(read("stimulus pattern A-100 --frequency 1e9").error,
              "--frequency: expected 5 to 20000 Hz, or resonance, found \"1e9\"");
}

// What a table of options takes, refuses and shows.

struct Values {
    int count = 3;
    double level = 0.5;
    bool isOn = true, isFlagged = false;
    std::string name = "anna", folder;
    std::vector<std::string> several;
    std::vector<double> pairs;
};

/// A table of one row of each kind.
struct Rig {
    Rig() {
        table.add("name", values.name, "who");
        table.add("--count", values.count, "how many").in(1, 9, " pieces");
        table.add("--level", values.level, "how much").positive();
        table.addSwitch("--light", values.isOn, "on or off");
        table.add("-f,--flag", values.isFlagged, "a flag");
        table.add("--several", values.several, "words").single();
        table.addRead(
            "--half", "2",
            [this](const std::string& word) {
                return word == "2" ? (values.level = 1.0, std::string{}) : "expected 2, found " + word;
            },
            "read");
        table
            .addRow("--all", WordsReader{[this](const std::vector<std::string>& words) {
                        return values.several = words, std::string{};
                    }},
                    "read together")
            .single();
    }
    std::string fault(const std::string& call) { return parseText(table, call).reason(); }
    Values values;
    OptionTable table{"program", "a program"};
};

TEST(OptionTables, ADeprecatedOptionSaysSoOnce) {
    std::string quick = "--quick", program = "program";
    for (const std::string& expected :
         {std::string{"--quick is deprecated: write --speed 2\n"}, std::string{}}) {
        bool isQuick = false;
        OptionTable table{"program", "a program"};
        table.addCommand("run", "runs").add("--quick", isQuick, "soon").deprecated("write --speed 2");
        std::string run = "run";
        char* words[]{program.data(), run.data(), quick.data()};
        testing::internal::CaptureStderr();
        EXPECT_EQ(parseArguments(table, expected.empty() ? 2 : 3, words).error, "");
        EXPECT_EQ(testing::internal::GetCapturedStderr(), expected);
        EXPECT_EQ(isQuick, !expected.empty());
    }
}

TEST(OptionTables, WhatIsSaidLandsInItsValue) {
    Rig rig;
    EXPECT_EQ(rig.fault("bea --count 9 --level=0.25 --light off -f --several a --several b"), "");
    EXPECT_EQ(rig.values.name, "bea");
    EXPECT_EQ(rig.values.count, 9);
    EXPECT_EQ(rig.values.level, 0.25);
    EXPECT_FALSE(rig.values.isOn);
    EXPECT_TRUE(rig.values.isFlagged);
    EXPECT_EQ(rig.values.several, (std::vector<std::string>{"a", "b"}));
}

TEST(OptionTables, WhatIsNotSaidStaysAsItWas) {
    Rig rig;
    EXPECT_EQ(rig.fault(""), "");
    EXPECT_EQ(rig.values.name, "anna");
    EXPECT_EQ(rig.values.count, 3);
    EXPECT_TRUE(rig.values.isOn);
    EXPECT_EQ(rig.values.level, 0.5);
}

TEST(OptionTables, AReaderSaysWhatItExpectedAndTheTableOfWhat) {
    Rig rig;
    EXPECT_EQ(rig.fault("--half 3"), "--half: expected 2, found 3");
    EXPECT_EQ(rig.fault("--half 2"), "");
    EXPECT_EQ(rig.values.level, 1.0);
    EXPECT_EQ(rig.fault("--all x --all y"), "");
    EXPECT_EQ(rig.values.several, (std::vector<std::string>{"x", "y"}));
}

TEST(OptionTables, WrongWordsAreRefused) {
    Rig rig;
    EXPECT_EQ(rig.fault("--count 10"), "--count: expected 1 to 9 pieces, found \"10\"");
    EXPECT_EQ(rig.fault("--count nan"), "--count: expected 1 to 9 pieces, found \"nan\"");
    EXPECT_EQ(rig.fault("--level nan"), "--level: expected more than 0, found \"nan\"");
    EXPECT_EQ(rig.fault("--level 0"), "--level: expected more than 0, found \"0\"");
    EXPECT_EQ(rig.fault("--light dim"), "--light: dim not in {on,off}");
    EXPECT_EQ(rig.fault("--colour red"), "unknown: --colour");
}

TEST(OptionTables, WhatACallSaidIsKnownAfterwards) {
    Rig rig;
    ASSERT_EQ(rig.fault("--count 4 --light on"), "");
    for (const Option& option : rig.table.options) {
        const bool isSaid = option.spellings.front() == "--count" || option.spellings.front() == "--light";
        EXPECT_EQ(!option.arguments.empty(), isSaid) << option.spellings.front();
    }
}

TEST(OptionTables, RowsShowWhatTheyTakeAndWhatTheyAreIfNobodySaysIt) {
    Rig rig;
    const auto row = [&](const std::string& name) -> const Option& {
        return *std::ranges::find_if(rig.table.options,
                                     [&](const Option& option) { return option.spellings.back() == name; });
    };
    EXPECT_EQ(row("--count").value(), "INT:1 to 9 pieces");
    EXPECT_EQ(row("--count").initial, "3");
    EXPECT_EQ(row("--light").value(), "TEXT:{on,off}");
    EXPECT_EQ(row("--light").initial, "on");
    EXPECT_EQ(row("--half").initial, "2");
    EXPECT_EQ(row("--flag").value(), "");
}

TEST(OptionTables, TheCommandOfACallIsKnown) {
    OptionTable program{"program", "a program"};
    std::string from, to;
    program.addCommand("take", "takes").add("--from", from, "where");
    program.addCommand("put", "puts").add("--to", to, "where");
    EXPECT_EQ(parseText(program, "put --to there").reason(), "");
    EXPECT_TRUE(program.isCalled("put"));
    EXPECT_EQ(to, "there");
    EXPECT_NE(parseText(program, "").error, "");
}

} // namespace physvib::render_words_test
