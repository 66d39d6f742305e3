// SPDX-License-Identifier: GPL-3.0-or-later
// --perceived-level in event lists, in files and in saved sessions, and where it is refused.
#include "Calls.h"

namespace physvib {
namespace {

class PerceivedLevelCommand : public test::CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        write("hits.csv",
              header +
                  "0.1,20,10,0.25,0,0\n0.2,80,34.13,0.25,0,0\n0.5,500,50,0.25,0,0\n0.7,500,50,0.75,0,0\n");
    }
    static std::string session(const std::string& shaping) {
        return R"({"physvib_session": 3, "seconds": 2, "steps_per_second": 100, "timing": "onset", "location": "contact", "limiter": true, )" +
               shaping +
               R"("channels": 1, "panning": {"layout": {"name": "", "extent_m": [0.1, 0.1], "enchanters": [{"label": "A", "x_m": 0, "y_m": 0, "actuator": "none", "full_scale_g": 1}]},
                   "law": "linear", "exponent": 1, "field_m": [4, 2]},
                 "takes": [{"start_s": 0, "world_end_s": 2, "seed": 1, "scene": {"name": "a ball falls on a plate", "field_m": [4, 2], "gravity_m_per_s2": [0, -9.8],
                   "materials": [{"name": "steel", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 430, "decay_per_s": 50}],
                   "bodies": [{"name": "plate", "type": "static", "position_m": [2, 0.1], "mass_kg": 740, "fixtures": [{"shape": "box", "size_m": [4, 0.2], "material": "steel", "camera": true}]},
                              {"name": "ball", "position_m": [1, 1.5], "fixtures": [{"shape": "circle", "radius_m": 0.15, "material": "steel"}]}]}}]})";
    }
    static inline const std::string header = "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n";
    static constexpr const char* render =
        "render --from-events hits.csv --layout phone1 --seconds 1 --out a.wav ";
};

TEST_F(PerceivedLevelCommand, WeighsTheEventsThatAreListedAndPlayed) {
    ASSERT_EQ(call(render).exitCode, 0);
    const auto plain = read("a.wav");
    ASSERT_EQ(call(std::string{render} + "--perceived-level off").exitCode, 0);
    EXPECT_EQ(read("a.wav"), plain);
    const auto outcome = call(std::string{render} + "--perceived-level on --events b.csv");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(read("a.wav"), plain);
    EXPECT_NE(read("a.wav").find("perceived_level=on"), std::string::npos);
    const std::string listed = read("b.csv");
    for (const char* row : {"\n0.100000000,20,10,0.125,", "\n0.200000000,80,34.13,0.25,",
                            "\n0.500000000,500,50,0.5,", "\n0.700000000,500,50,1,"})
        EXPECT_NE(listed.find(row), std::string::npos) << row << listed;
    ASSERT_EQ(call("render --from-events b.csv --layout phone1 --seconds 1 --out b.wav").exitCode, 0);
    // without the line on its origin
    const auto tail = [](const std::string& wav) { return wav.substr(wav.size() - 100'000); };
    EXPECT_EQ(tail(read("b.wav")), tail(read("a.wav")));
}

TEST_F(PerceivedLevelCommand, ASavedSessionKeepsItUnlessTheCallSaysOtherwise) {
    const auto events = [&](const std::string& saved, const std::string& options) {
        EXPECT_EQ(call("render " + saved + " --seconds 2 --events s.csv " + options).exitCode, 0)
            << read(".err");
        const std::string csv = read("s.csv");
        return csv.substr(csv.find("\ntime_s"));
    };
    write("plain.json", session(""));
    write("weighted.json", session(R"("shaping": {"perceived_level": true}, )"));
    const auto plain = events("plain.json", ""), weighted = events("plain.json", "--perceived-level on");
    EXPECT_NE(plain.find(",430,"), std::string::npos) << "the ball hits the plate: " << plain;
    EXPECT_NE(weighted, plain);
    EXPECT_EQ(events("weighted.json", ""), weighted);
    EXPECT_EQ(events("weighted.json", "--perceived-level off"), plain);
}

TEST_F(PerceivedLevelCommand, IsRefusedWhereItMeansNothing) {
    refuses(std::string{render} + "--perceived-level loud", 2, "--perceived-level", 1);
    refuses(std::string{render} + "--perceived-level on --method SV --sound 80=synthetic-1", 2,
            "--perceived-level: recordings have no one frequency to be weighted by", 1);
    write("recorded.json",
          session(
              R"("recordings": [{"time_s": 0, "files": [{"frequency_hz": 430, "file": "synthetic-7"}]}], )"));
    refuses("render recorded.json --out a.wav --perceived-level on", 2,
            "--perceived-level: recordings have no one frequency to be weighted by", 2);
    EXPECT_EQ(call("render recorded.json --out a.wav --perceived-level on --method AV-FV-DRV").exitCode, 0)
        << read(".err");
    std::filesystem::remove(folder_ / "a.wav");
    std::filesystem::remove(folder_ / "recorded.json");
    refuses("play drop --board /dev/none --perceived-level on", 2,
            "--board: not yet with --method, --level-db, --gamma, --perceived-level and --actuator", 1);
}

} // namespace
} // namespace physvib
