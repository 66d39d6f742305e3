// SPDX-License-Identifier: GPL-3.0-or-later
// Many renders as a user asks for them: one table, the same bytes whoever made it and how often it was cut
// off.
#include "CommandLine/Calls.h"
#include "Core/PanningLaws.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Scene/EventsCsv.h"
#include "TestPlaces.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using namespace test;
namespace fs = std::filesystem;

class SweepCommand : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        write(
            "design.json",
            R"({"physvib_sweep": 1, "name": "small", "scenes": ["shake-the-box", {"scene": "drop", "variables": {"height": ["1", "2"]}}],
  "seeds": {"from": 1, "count": 2}, "layouts": ["phone4", "ring2"], "laws": ["linear", "energy"], "options": {"seconds": 1, "rate": 8000}})");
    }
    CsvTable index(const std::string& folder) const {
        const auto table = loadCsvTable(folder_ / folder / "index.csv");
        EXPECT_TRUE(table) << table.error;
        return table.value;
    }
    /// Paths of all files below `folder`, that end so.
    std::vector<fs::path> below(const std::string& folder, const std::string& ending) const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::recursive_directory_iterator{folder_ / folder})
            if (entry.is_regular_file() && entry.path().string().ends_with(ending))
                found.push_back(entry.path());
        std::ranges::sort(found);
        return found;
    }
    /// How often the logs say `word`.
    std::size_t logged(const std::string& folder, const std::string& word) const {
        std::size_t count = 0;
        for (const auto& path : below(folder + "/log", ".txt")) {
            std::ifstream lines{path};
            for (std::string line; std::getline(lines, line);) count += line.starts_with(word) ? 1 : 0;
        }
        return count;
    }
};

double cell(const CsvTable& table, std::size_t row, const std::string& name) {
    const auto column = table.column(name);
    if (!column) ADD_FAILURE() << name;
    return column ? parseNumber<double>(table.rows[row].cells[*column]).value_or(NAN) : NAN;
}
std::string words(const CsvTable& table, std::size_t row, const std::string& name) {
    return table.rows[row].cells[*table.column(name)];
}

TEST_F(SweepCommand, OneTableOfAllTasksWhateverTheNumberOfCalls) {
    const Outcome outcome = call("sweep design.json --out one");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "one/index.csv  24 tasks, 24 rendered now\n");
    EXPECT_EQ(outcome.err, "");
    // As the page says: a part per processor, all at once.
    ASSERT_EQ(std::system(("cd '" + folder_.string() +
                           "' && seq 3 | xargs -P 3 -I {} '" PHYSVIB_PROGRAM
                           "' sweep design.json --out three --part {}/3 >said")
                              .c_str()),
              0);
    ASSERT_EQ(call("sweep design.json --out three --gather").exitCode, 0);
    EXPECT_EQ(below("three/log", ".txt").size(), 3u) << "each did some";
    EXPECT_EQ(read("one/index.csv"), read("three/index.csv"));
    EXPECT_EQ(call("sweep design.json --out one").out, "one/index.csv  24 tasks, 0 rendered now\n");
    EXPECT_EQ(read("one/design.json"), read("design.json"));
    const CsvTable table = index("one");
    ASSERT_EQ(table.rows.size(), 24u);
    EXPECT_EQ(words(table, 0, "set_height"), "");
    EXPECT_EQ(words(table, 23, "set_height"), "2");
    EXPECT_EQ(words(table, 23, "call"),
              "render drop --set height=2 --seed=2 --layout=ring2 --law=energy --rate=8000 --seconds=1");
    EXPECT_EQ(words(table, 23, "files").rfind("drop=", 0), 0u);
    EXPECT_TRUE(std::isnan(cell(table, 23, "peak_3"))) << "two enchanters";
}

TEST_F(SweepCommand, ARowIsWhatItsCallRenders) {
    ASSERT_EQ(call("sweep design.json --out s --wav --events").exitCode, 0);
    const CsvTable table = index("s");
    for (const std::size_t row : {0u, 23u}) {
        const std::string hash = words(table, row, "hash"),
                          kept = "s/tasks/" + hash.substr(0, 2) + '/' + hash;
        ASSERT_EQ(call(words(table, row, "call") + " --out again.wav --events again.csv").exitCode, 0);
        EXPECT_EQ(read("again.wav"), read(kept + ".wav"));
        EXPECT_EQ(read("again.csv"), read(kept + ".events.csv"));
        const auto events = loadEventsCsv(folder_ / "again.csv").value.events;
        EXPECT_EQ(cell(table, row, "hits"), static_cast<double>(events.size()));
        EXPECT_NEAR(cell(table, row, "first_s"), static_cast<double>(events.front().timeNs) * 1e-9, 1e-12);
        double sum = 0.0, x = 0.0, weights = 0.0;
        for (const CollisionEvent& e : events)
            sum += e.source.impulseNewtonSeconds, x += e.amplitude * e.x, weights += e.amplitude;
        EXPECT_NEAR(cell(table, row, "impulse_sum_ns"), sum, 1e-9 * sum);
        EXPECT_NEAR(cell(table, row, "hit_x_m"), x / weights, 1e-9);
        double largest = 0.0, squares = 0.0, shares = 0.0;
        const std::string wav = read("again.wav");
        const int channels = row == 0 ? 4 : 2;
        for (std::size_t at = wav.size() - 8000u * static_cast<unsigned>(channels) * 4; at < wav.size();
             at += 4u * static_cast<unsigned>(channels)) {
            float sample = 0.0f;
            std::copy_n(wav.data() + at, 4, reinterpret_cast<char*>(&sample));
            largest = std::max(largest, std::abs(static_cast<double>(sample)));
            squares += static_cast<double>(sample) * static_cast<double>(sample);
        }
        EXPECT_EQ(cell(table, row, "peak_1"), largest);
        EXPECT_NEAR(cell(table, row, "rms_1"), std::sqrt(squares / 8000.0), 1e-9);
        for (const char* band :
             {"band_0_50", "band_50_100", "band_100_200", "band_200_400", "band_400_800", "band_800_up"})
            shares += cell(table, row, band);
        EXPECT_NEAR(shares, 1.0, 1e-9);
        EXPECT_GT(cell(table, row, "centroid_hz"), 10.0);
        EXPECT_GT(cell(table, row, "a8_m_per_s2"), 0.0);
    }
}

TEST_F(SweepCommand, PartsMakeTheWholeAndNothingTwice) {
    EXPECT_EQ(call("sweep design.json --out parts --part 1/5").out, "part 1/5  5 rendered\n");
    const Outcome early = call("sweep design.json --out parts --gather");
    EXPECT_EQ(early.exitCode, 1);
    EXPECT_EQ(
        early.err.rfind("physvib: 19 tasks of 24 not done, the first: render shake-the-box --seed=2", 0), 0u)
        << early.err;
    EXPECT_FALSE(fs::exists(folder_ / "parts/index.csv"));
    // Two at once in one folder: each does what the other does not.
    const std::string sweep = "'" PHYSVIB_PROGRAM "' sweep design.json --out parts --part 1/1 >>said 2>&1";
    EXPECT_EQ(std::system(("cd '" + folder_.string() + "'; " + sweep + " & " + sweep + "; wait").c_str()), 0);
    ASSERT_EQ(call("sweep design.json --out parts --gather").exitCode, 0) << read("said") << read(".err");
    EXPECT_EQ(logged("parts", "begun"), 24u);
    EXPECT_EQ(logged("parts", "finished"), 24u);
    ASSERT_EQ(call("sweep design.json --out whole").exitCode, 0);
    EXPECT_EQ(read("parts/index.csv"), read("whole/index.csv"));
}

TEST_F(SweepCommand, AResultThatIsNotWholeIsMadeAgain) {
    ASSERT_EQ(call("sweep design.json --out s").exitCode, 0);
    const std::string index = read("s/index.csv");
    const auto results = below("s/tasks", ".csv");
    ASSERT_EQ(results.size(), 24u);
    fs::resize_file(results[3], 40);
    fs::resize_file(results[4], 0);
    fs::remove(results[5]);
    EXPECT_EQ(call("sweep design.json --out s").out, "s/index.csv  24 tasks, 3 rendered now\n");
    EXPECT_EQ(read("s/index.csv"), index);
    EXPECT_EQ(call("sweep design.json --out s --events").out, "s/index.csv  24 tasks, 24 rendered now\n")
        << "what is wanted now was not kept before";
}

TEST_F(SweepCommand, WhatIsKeptOfATaskIsMadeAgainWhereItIsNotWhole) {
    const std::string sweep = "sweep design.json --out s --wav --events";
    ASSERT_EQ(call(sweep).exitCode, 0);
    const std::string index = read("s/index.csv");
    const auto wavs = below("s/tasks", ".wav"), lists = below("s/tasks", ".events.csv");
    ASSERT_EQ(wavs.size(), 24u);
    ASSERT_EQ(lists.size(), 24u);
    const auto whole = fs::file_size(wavs[3]);
    const auto at = [&](std::size_t i) { return lists[i].string().substr(folder_.string().size() + 1); };
    const std::string list = read(at(9));
    fs::resize_file(wavs[3], 0); // a machine that lost its power
    fs::resize_file(wavs[4], 20);
    fs::resize_file(wavs[5], whole / 2);
    fs::resize_file(lists[8], 0);
    write(at(9), list.substr(0, list.rfind('\n', list.size() - 2) + 1)); // up to a whole row
    fs::resize_file(lists[10], fs::file_size(lists[10]) - 5);
    EXPECT_EQ(call(sweep + " --gather").exitCode, 1);
    EXPECT_EQ(call(sweep).out, "s/index.csv  24 tasks, 6 rendered now\n") << read(".err");
    EXPECT_EQ(fs::file_size(wavs[3]), whole);
    EXPECT_EQ(read(at(9)), list);
    EXPECT_EQ(read("s/index.csv"), index);
    EXPECT_EQ(call(sweep).out, "s/index.csv  24 tasks, 0 rendered now\n");
}

TEST_F(SweepCommand, ALargerDesignTakesWhatIsThereAndAnotherSceneFileDoesNot) {
    const std::string scene =
        R"({"physvib_scene":1,"name":"ball","field_m":[4,2],"materials":[{"name":"wood","density_kg_per_m2":850,"friction":0.4,"restitution":0.6,"frequency_hz":80,"decay_per_s":30}],
"bodies":[{"name":"floor","type":"static","position_m":[2,0.1],"mass_kg":10,"fixtures":[{"shape":"box","size_m":[4,0.2],"material":"wood"}]},
{"name":"ball","position_m":[2,1.5],"fixtures":[{"shape":"circle","radius_m":0.2,"material":"wood","camera":true}]}]})";
    const auto design = [this](const std::string& seeds) {
        write("own.json", R"({"physvib_sweep": 1, "name": "own", "scenes": ["ball.json"], "seeds": )" +
                              seeds + R"(, "options": {"seconds": 0.2, "rate": 8000}})");
    };
    write("ball.json", scene);
    design("[1, 2]");
    EXPECT_EQ(call("sweep own.json --out s").out, "s/index.csv  2 tasks, 2 rendered now\n") << read(".err");
    design("[3, 2, 1]");
    EXPECT_EQ(call("sweep own.json --out s").out, "s/index.csv  3 tasks, 1 rendered now\n");
    write("ball.json", scene + "\n");
    EXPECT_EQ(call("sweep own.json --out s").out, "s/index.csv  3 tasks, 3 rendered now\n");
}

TEST_F(SweepCommand, NumpyReadsTheIndex) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no numpy here";
    ASSERT_EQ(call("sweep design.json --out s").exitCode, 0);
    write("read.py", R"(import numpy
t = numpy.genfromtxt("s/index.csv", delimiter=",", skip_header=1, names=True, dtype=None, encoding="utf-8")
assert t.shape == (24,) and t["hits"].min() >= 0 and t["rms_1"].dtype == float, t.dtype
assert numpy.isnan(t["peak_4"][t["layout"] == "ring2"]).all() and not numpy.isnan(t["peak_4"][t["layout"] == "phone4"]).any()
)");
    EXPECT_EQ(std::system(("cd '" + folder_.string() + "' && /usr/bin/python3 read.py").c_str()), 0);
}

TEST_F(SweepCommand, ATaskThatFailsIsToldAndTheOthersAreKept) {
    write(
        "odd.json",
        R"({"extent_m": [0.2, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "full_scale_g": 1}, {"x_m": 0.2, "y_m": 0.1, "full_scale_g": 2}]})");
    write(
        "mixed.json",
        R"({"physvib_sweep": 1, "name": "m", "scenes": ["drop"], "seeds": [1], "layouts": ["phone4", "odd.json"], "methods": ["AV-FV-DRV", "AF-FF-DRF"], "options": {"seconds": 0.2, "rate": 8000}})");
    const Outcome outcome = call("sweep mixed.json --out s");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.err,
              "physvib: 1 task failed, the first: render drop --seed=1 --layout=odd.json --method=AF-FF-DRF "
              "--rate=8000 --seconds=0.2: odd.json: --method AF-FF-DRF: expected one full_scale_g for "
              "all actuators, found 1 and 2\n");
    EXPECT_EQ(below("s/tasks", ".csv").size(), 3u);
    EXPECT_FALSE(fs::exists(folder_ / "s/index.csv"));
    EXPECT_TRUE(below("s", ".part").empty());
}

TEST_F(SweepCommand, APlanIsFastAndSmallAndLeavesNothing) {
    write(
        "many.json",
        R"({"physvib_sweep": 1, "name": "many", "scenes": ["drop"], "seeds": {"from": 1, "count": 25000}, "layouts": ["phone4", "ring2"], "laws": ["linear", "energy"]})");
#if defined(PHYSVIB_SANITIZED)
    const Outcome outcome = call("sweep many.json --plan");
#else
    const Outcome outcome = call("sweep many.json --plan", "ulimit -d 60000; "); // kB
#endif
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 7);
    EXPECT_NE(outcome.out.find("  render drop --seed=1 --layout=phone4 --law=linear\n"), std::string::npos)
        << outcome.out;
    EXPECT_TRUE(outcome.out.ends_with("...\n100000 tasks, 0 of them done\n")) << outcome.out;
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(SweepCommand, AJobArrayIsWrittenAndSubmitted) {
    write("sbatch", "#!/bin/sh\ncp \"$1\" submitted\necho Submitted batch job 7\n");
    fs::permissions(folder_ / "sbatch", fs::perms::owner_all);
    const Outcome outcome = call("sweep design.json --out s --slurm --sbatch=--time=10:00 --wav",
                                 "export PATH='" + folder_.string() + "':\"$PATH\"; ");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "Submitted batch job 7\ns/slurm/sweep.sbatch  24 tasks in an array of 1; when it "
                           "is over, the same call with --gather instead of --slurm\n");
    const std::string script = read("submitted");
    EXPECT_EQ(script, read("s/slurm/sweep.sbatch"));
    EXPECT_NE(script.find("#SBATCH --array=1-1\n"), std::string::npos) << script;
    EXPECT_NE(script.find("#SBATCH --time=10:00\n"), std::string::npos) << script;
    // As Slurm would run it.
    ASSERT_EQ(std::system(("cd / && SLURM_ARRAY_TASK_ID=1 sh -c 'cd \"" + folder_.string() +
                           "\" && sh submitted >said 2>&1'")
                              .c_str()),
              0)
        << read("said");
    EXPECT_EQ(call("sweep design.json --out s --gather --wav").exitCode, 0);
    write("sbatch", "#!/bin/sh\nexit 1\n");
    EXPECT_EQ(call("sweep design.json --out s --slurm", "export PATH='" + folder_.string() + "':\"$PATH\"; ")
                  .exitCode,
              1);
    EXPECT_EQ(read(".err"), "physvib: sbatch did not take s/slurm/sweep.sbatch\n");
}

TEST_F(SweepCommand, WrongCallsAndDesignsAreToldInOneLine) {
    refuses("sweep design.json", 2, "sweep: expected --out FOLDER, or --plan", 1);
    refuses("sweep design.json --out s --gather --slurm", 2,
            "sweep: expected one of --plan, --gather, --slurm and --part", 1);
    refuses("sweep design.json --out s --part 3/2", 2,
            "--part: expected K/N, the K-th of N parts, found \"3/2\"", 1);
    refuses("sweep design.json --out s --slurm --sbatch time", 2, "--sbatch: expected options of sbatch", 1);
    refuses("sweep none.json --out s", 1, "none.json: cannot be read", 1);
    const auto refusesDesign = [this](const std::string& fields, const std::string& line) {
        write("bad.json", R"({"physvib_sweep": 1, "name": "b", "seeds": [1], )" + fields + "}");
        refuses("sweep bad.json --out s", 1, line, 2);
    };
    refusesDesign(R"("scenes": ["nowhere"])", "bad.json: scenes[0]: no scene \"nowhere\"");
    refusesDesign(R"("scenes": ["drop", {"scene": "box-study", "variables": {"size": ["1"]}}])",
                  "bad.json: scenes[1]: ");
    refusesDesign(R"("scenes": ["drop"], "layouts": ["phone4", "phone9"])",
                  "bad.json: layouts: phone9: cannot be read");
    refusesDesign(R"("scenes": ["drop"], "laws": ["steep"])",
                  "bad.json: laws: --law: expected " + listed(panningLawNames, " or ") + ", found \"steep\"");
    refusesDesign(R"("scenes": ["drop"], "options": {"rate": 7})",
                  "bad.json: options.rate: --rate: expected 5000 to 192000 Hz, found \"7\"");
    refusesDesign(R"("scenes": ["drop"], "options": {"frobnicate": 7})", "bad.json: options.frobnicate: ");
    refusesDesign(R"("scenes": ["drop"], "options": {"help": 1})",
                  "bad.json: options.help: expected words that say what is rendered, found a call for help");
}

} // namespace
} // namespace physvib
