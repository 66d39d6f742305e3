// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib study`: each of the thesis' studies run whole by the observer, cut off in the middle, and analysed.
#include "Calls.h"
#include "Files/Text/CsvTable.h"
#include <algorithm>

namespace physvib {
namespace {

class Study : public test::CommandLine {
protected:
    /// Runs a study of that many participants; the names of their files.
    std::string run(const std::string& protocol, int participants, const std::string& more = "--observer simulated") const {
        const auto outcome = call("study run " + protocol + " --participants " + std::to_string(participants) + " " + more);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("SIMULATED"), std::string::npos);
        std::string names;
        for (int n = 1; n <= participants; ++n) names += " " + protocol + "-P0" + std::to_string(n) + ".csv";
        return names;
    }
    /// The analysis succeeds, marks the data as simulated, and leaves a picture.
    std::string analyse(const std::string& kind, const std::string& files) const {
        const auto outcome = call("analyse " + kind + files + " --picture " + kind + ".png --export " + kind + "-export.csv");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(outcome.out.rfind("SIMULATED", 0), 0u) << outcome.out;
        EXPECT_EQ(read(kind + ".png").substr(1, 3), "PNG");
        EXPECT_EQ(outcome.out.find("nan"), std::string::npos);
        return outcome.out;
    }
};

TEST_F(Study, PatternsWhole) {
    const std::string out = analyse("confusion", run("patterns", 3));
    for (const char* words : {"PHONE-2\n  trials: 84 (28 stimuli)\n", "RING-4\n  trials: 504 (168 stimuli)\n"}) EXPECT_NE(out.find(words), std::string::npos) << out;
    EXPECT_NE(call("analyse icons patterns-P01.csv patterns-P02.csv --meanings 24").out.find("enough"), std::string::npos);
}

TEST_F(Study, PhantomGridsWhole) {
    const std::string files = run("phantom-grids", 2, "--observer simulated-RING");
    EXPECT_NE(analyse("confusion", files).find("RING-5x5\n  trials: 500 (25 stimuli)\n"), std::string::npos);
    EXPECT_NE(call("analyse confusion" + files + " --tolerance 1").out.find("PHONE-3x3\n  trials: 180 (9 stimuli)\n"), std::string::npos);
}

TEST_F(Study, PhantomPlacesWhole) {
    const std::string out = analyse("resolution", run("phantom-places", 4, "--observer simulated-RING"));
    for (const char* condition : {"PHONE-LINEAR: ", "PHONE-LOGARITHM: ", "RING-LINEAR: ", "RING-LOGARITHM: "}) EXPECT_NE(out.find(condition), std::string::npos) << out;
}

TEST_F(Study, ModelOrSoundWhole) {
    const std::string out = analyse("choices", run("model-or-sound", 3));
    EXPECT_NE(out.find("all: AV-FV-DRV "), std::string::npos) << out;
    EXPECT_NE(out.find(", 324 trials of 3 participants, signed ranks p "), std::string::npos) << out;
    EXPECT_NE(out.find("\nsize=small: "), std::string::npos) << out;
}

TEST_F(Study, RecordingsOfTheCallStandInEveryRowAndWhatIsSyntheticIsNamed) {
    ASSERT_EQ(call("render drop --layout phone1 --set pair=wood-wood --seconds 2 --out wood.wav").exitCode, 0);
    ASSERT_EQ(call("study run model-or-sound --observer simulated --sound 349=wood.wav").exitCode, 0);
    const auto table = readCsvTable(read("model-or-sound-P01.csv"), "rows").value;
    std::string last;
    for (const auto& row : table.rows) {
        const std::string& calls = row.cells[*table.column("render")];
        const auto sv = calls.find("--method SV --sound-match rms --level-db 0 --sound 80=synthetic-1 --sound 430=synthetic-1 --sound 349=wood.wav");
        ASSERT_NE(sv, std::string::npos) << calls;
        const auto model = calls.find("--method AV-FV-DRV --sound-match rms --level-db ");
        ASSERT_NE(model, std::string::npos) << calls;
        last = calls.substr(std::min(model, sv) == model ? 0 : calls.find(" ; ") + 3);
        last = last.substr(0, last.find(" ; "));
    }
    const auto outcome = call(last + " --out again.wav"); // the model at its matched level
    EXPECT_EQ(outcome.exitCode, 0) << last << outcome.err;
    refuses("study run model-or-sound --observer simulated --out other --sound 349=gone.wav", 1, "gone.wav: cannot be read", 3);
    refuses("study run model-or-sound --observer simulated --out other --sound gone.wav", 1, "--sound: expected HZ=FILE.wav", 3);
}

TEST_F(Study, EightMethodsWhole) {
    const std::string out = analyse("ratings", run("eight-methods", 2));
    EXPECT_NE(out.find("AV-FV-DRV: 20 trials, realism "), std::string::npos) << out;
    EXPECT_NE(out.find("\nFF: 80 trials, realism "), std::string::npos) << out;
}

TEST_F(Study, EveryTrialCarriesWhatRendersItAgain) {
    run("phantom-grids", 1);
    run("patterns", 1);
    for (const char* name : {"phantom-grids-P01.csv", "patterns-P01.csv"}) {
        const auto table = readCsvTable(read(name), name);
        ASSERT_TRUE(table) << table.error;
        const auto render = *table.value.column("render");
        for (std::size_t i = 3; i < table.value.rows.size(); i += 397) {
            const std::string& again = table.value.rows[i].cells[render];
            EXPECT_EQ(call(again + " --out again.wav").exitCode, 0) << again;
            EXPECT_EQ(read("again.wav").substr(0, 4), "RIFF");
        }
    }
}

TEST_F(Study, KilledInTheMiddleOfATrialItGoesOnAndTheFileIsTheSame) {
    for (const std::string protocol : {"patterns", "phantom-grids", "phantom-places", "model-or-sound", "eight-methods"}) {
        const std::string file = protocol + "-P01.csv", study = "study run " + protocol + " --observer simulated";
        ASSERT_EQ(call(study + " --out .").exitCode, 0);
        const std::string whole = read(file);
        std::filesystem::remove(folder_ / file);
        const std::string background = "cd '" + folder_.string() + "' && { '" PHYSVIB_PROGRAM "' " + study + " --pace 0.02 >.out 2>.err & pid=$!; "
                                       "until [ \"$(cat " + file + " | wc -c)\" -gt 3000 ]; do sleep 0.01; done; kill -9 $pid; wait $pid; } 2>/dev/null";
        EXPECT_NE(std::system(background.c_str()), 0);
        const std::string cut = read(file);
        ASSERT_GT(cut.size(), 3000u) << "some trials were answered";
        ASSERT_LT(cut.size(), whole.size()) << "and not all";
        EXPECT_EQ(cut, whole.substr(0, cut.size()));
        EXPECT_EQ(cut.back(), '\n');
        write(file, cut + whole.substr(cut.size(), 17)); // as if the machine had gone down while a row was written
        const auto outcome = call(study);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("of them there before"), std::string::npos) << outcome.out;
        EXPECT_EQ(read(file), whole) << protocol;
    }
}

TEST_F(Study, ProtocolsOfOnesOwnNeedNoCode) {
    const auto shown = call("study show level-steps");
    ASSERT_EQ(shown.exitCode, 0);
    write("mine.json", shown.out);
    ASSERT_EQ(call("study run mine.json --observer simulated --participant anna_1").exitCode, 0);
    EXPECT_NE(read("level-steps-anna_1.csv").find(",choose,"), std::string::npos);
    ASSERT_EQ(call("study run magnitudes --observer simulated").exitCode, 0);
    EXPECT_NE(read("magnitudes-P01.csv").find(",estimate,"), std::string::npos);
    EXPECT_NE(analyse("levels", " level-steps-anna_1.csv").find("PHONE: threshold "), std::string::npos);
    ASSERT_EQ(call("study run level-quest --observer simulated --participants 2").exitCode, 0);
    const auto quest = analyse("levels", " level-quest-P01.csv level-quest-P02.csv");
    EXPECT_NE(quest.find("PHONE: threshold by QUEST+ "), std::string::npos) << quest;
    EXPECT_NE(quest.find(", 95 % interval "), std::string::npos) << quest;
    EXPECT_NE(analyse("levels", " magnitudes-P01.csv").find("PHONE, 0.4: magnitude "), std::string::npos);
    EXPECT_EQ(std::ranges::count(call("study list").out, '\n'), 8);
}

TEST_F(Study, BadCallsAndFilesAreRefused) {
    refuses("study run patterns", 2, "--observer");
    refuses("study run patterns --observer GLOVE", 2, "--observer");
    refuses("study run none --observer simulated", 1, "no protocol \"none\" (see physvib study list)");
    refuses("study run none.json --observer simulated", 1, "none.json: cannot be read");
    refuses("study run patterns --observer simulated --participant '../x'", 2, "--participant");
    refuses("study run patterns --observer simulated --out none", 1, "cannot be written");
    refuses("study", 2, "");
    write("patterns-P01.csv", "my diary\n");
    refuses("study run patterns --observer simulated", 1, "patterns-P01.csv:1: expected a trial file of physvib, found something else", 1);
    EXPECT_EQ(read("patterns-P01.csv"), "my diary\n");
    write("bad.json", R"({ "physvib_protocol": 1, "name": "bad", "conditions": [{ "name": "A", "layout": "phone2", "stimuli": "patterns", "enchanters": 4 }], "sessions": [{ "name": "main" }] })");
    refuses("study run bad.json --observer simulated", 1, "bad.json: condition A: expected as many enchanters as the layout has (2), found 4", 2);
}

} // namespace
} // namespace physvib
