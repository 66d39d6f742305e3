// SPDX-License-Identifier: MIT
// Designs of sweeps are read strictly; their tasks are to be had one by one.
#include "Lab/Files/SweepFile.h"
#include "Lab/Study/Protocol.h"
#include "Support/FileTesting.h"
#include <set>

namespace physvib {
namespace {

const std::string good = R"({"physvib_sweep": 1, "name": "two worlds",
  "scenes": [{"scene": "drop", "variables": {"height": ["1", "2"], "material": ["wood", "metal", "rubber"]}}, "mine/box.json"],
  "seeds": {"from": 5, "count": 4}, "layouts": ["phone4", "ring2"], "laws": ["linear"], "methods": ["AV-FV-DRV", "SV"],
  "sounds": ["80=a.wav", "160=synthetic-1"], "options": {"seconds": 2, "level-db": [-6, 0.5]}})";

/// The file above with one thing replaced.
std::string errorOf(const std::string& what, const std::string& with) {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    const auto read = readSweep(text.replace(at, what.size(), with), "s.json");
    EXPECT_FALSE(read) << text;
    EXPECT_EQ(read.value.size(), 0u);
    return read.error;
}

TEST(SweepFile, EveryCombinationIsATaskAndSeedsChangeFirst) {
    const auto read = readSweep(good, "s.json");
    ASSERT_TRUE(read) << read.error;
    const SweepDesign& design = read.value;
    ASSERT_EQ(design.size(), (6u + 1u) * 4 * 2 * 2 * 2);
    EXPECT_EQ(design.task(0).call, "render drop --set height=1 --set material=wood --seed=5 --layout=phone4 "
                                   "--law=linear --method=AV-FV-DRV --level-db=-6 --seconds=2");
    EXPECT_EQ(design.task(1).call, "render drop --set height=1 --set material=wood --seed=6 --layout=phone4 "
                                   "--law=linear --method=AV-FV-DRV --level-db=-6 --seconds=2");
    EXPECT_EQ(design.task(4).options,
              (std::vector<std::string>{"phone4", "linear", "AV-FV-DRV", "0.5", "2"}));
    EXPECT_EQ(design.task(8).call,
              "render drop --set height=1 --set material=wood --seed=5 --layout=phone4 --law=linear "
              "--method=SV --sound 80=a.wav --sound 160=synthetic-1 --level-db=-6 --seconds=2");
    EXPECT_EQ(design.task(32).variables, (std::vector<std::string>{"1", "metal"}));
    EXPECT_EQ(design.task(design.size() - 1).call,
              "render mine/box.json --seed=8 --layout=ring2 --law=linear --method=SV --sound 80=a.wav "
              "--sound 160=synthetic-1 --level-db=0.5 --seconds=2");
    std::set<std::string> calls;
    for (std::uint64_t i = 0; i < design.size(); ++i) calls.insert(design.task(i).call);
    EXPECT_EQ(calls.size(), design.size()) << "no task twice";
}

TEST(SweepFile, AListOfSeedsAndNothingElseIsEnough) {
    const auto read =
        readSweep(R"({"physvib_sweep": 1, "name": "n", "scenes": ["driving"], "seeds": [7, 3]})", "s");
    ASSERT_TRUE(read) << read.error;
    ASSERT_EQ(read.value.size(), 2u);
    EXPECT_EQ(read.value.task(1).call, "render driving --seed=3");
}

TEST(SweepFile, TenMillionTasksAreAsManyAsAreTaken) {
    EXPECT_EQ(errorOf("\"count\": 4", "\"count\": 1000000000"),
              "s.json: expected at most 10000000 tasks, found more");
    std::string values = "\"0\"";
    for (int i = 1; i < 4096; ++i) values += ",\"" + std::to_string(i) + '"';
    EXPECT_EQ(errorOf("[-6, 0.5]", "[" + values + "], \"gamma\": [" + values + "], \"block\": [" + values +
                                       "], \"rate\": [" + values + "], \"exponent\": [" + values + "]"),
              "s.json: expected at most 10000000 tasks, found more")
        << "and no product wraps around";
}

TEST(SweepFile, FaultsNameTheirPlace) {
    EXPECT_EQ(errorOf("\"physvib_sweep\": 1", "\"physvib_sweep\": 2"),
              "s.json: physvib_sweep: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(errorOf("\"laws\"", "\"law\""), "s.json: unknown field \"law\"");
    EXPECT_EQ(errorOf("\"ring2\"", "\"phone4\""),
              "s.json: layouts[1]: expected each only once, found \"phone4\" again");
    EXPECT_EQ(errorOf("\"mine/box.json\"", "\"drop\""),
              "s.json: scenes[1]: expected each scene only once, found \"drop\" again");
    EXPECT_EQ(errorOf("mine/box.json", "--picture"),
              "s.json: scenes[1]: expected the name of a scene, found \"--picture\"");
    EXPECT_EQ(errorOf("mine/box.json", "/etc/box.json"),
              "s.json: scenes[1]: expected files in the folder or below, found /etc/box.json");
    EXPECT_EQ(errorOf("80=a.wav", "80=../a.wav"),
              "s.json: sounds[0]: expected files in the folder or below, found --sound=80=../a.wav");
    EXPECT_EQ(errorOf("[\"1\", \"2\"]", "[]"),
              "s.json: scenes[0].variables.height: expected 1 to 4096 items, found 0");
    EXPECT_EQ(errorOf("\"height\"", "\"a b\""),
              "s.json: scenes[0].variables: expected names of variables, found \"a b\"");
    EXPECT_EQ(errorOf("\"wood\"", "\"wood $(ls)\""), "s.json: scenes[0].variables.material[0]: expected "
                                                     "letters, digits and _-+.,:=/%, found \"wood $(ls)\"");
    EXPECT_EQ(errorOf("\"from\": 5", "\"from\": -5"),
              "s.json: seeds.from: expected a seed from 0 to 1000000000, found -5");
    EXPECT_EQ(errorOf("\"count\": 4", "\"count\": 0"), "s.json: seeds.count: expected at least 1, found 0");
    EXPECT_EQ(errorOf("\"seconds\": 2", "\"seed\": 2"),
              "s.json: options: expected \"seed\" in a field of its own");
    EXPECT_EQ(errorOf("\"seconds\": 2", "\"--seconds\": 2, \"A\": 1"),
              "s.json: options: expected names of options of render without dashes in front, found \"A\"");
    EXPECT_EQ(errorOf("\"seconds\": 2", "\"seconds\": true"),
              "s.json: options.seconds: expected a string, found a boolean");
    EXPECT_EQ(errorOf("\"name\": \"two worlds\",", ""), "s.json: field \"name\" is missing");
}

TEST(SweepFile, NoAccidentGetsPastTheReaderUnnoticed) {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const auto read = readSweep(mutated(good, "{}[]\",:0123456789.-e nul/$", random), "f");
        if (!read) {
            EXPECT_EQ(read.error.rfind("f: ", 0), 0u) << read.error;
            EXPECT_TRUE(read.value.scenes.empty());
            continue;
        }
        ASSERT_GE(read.value.size(), 1u);
        for (const std::uint64_t at : {std::uint64_t{0}, read.value.size() / 2, read.value.size() - 1})
            EXPECT_EQ(callFault(read.value.task(at).call), "");
    }
}

} // namespace
} // namespace physvib
