// SPDX-License-Identifier: MIT
// Sessions from anywhere: what is out of range is named by its place, not taken for something else.
#include "Live/Documents/SessionFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Live/Documents/DocumentJson.h"
#include "Support/FileTesting.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>

namespace physvib::session_file_test {

/// The corpus' session with another piece.
std::string sessionWith(const std::string& from, const std::string& to,
                        const std::string& name = "two-takes") {
    std::string text =
        readFile(PHYSVIB_SOURCE_DIR "/Tests/Fuzz/corpus/session/" + name + ".json", 10'000).value;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string faultWith(const std::string& from, const std::string& to) {
    return readSession(sessionWith(from, to), "s.json").error;
}

TEST(SessionFile, AStrikeThatWouldHoldACoilAtDirectCurrentIsNamed) {
    const auto fault = [](const std::string& sound) {
        return faultWith("\"channels\": 2,",
                         "\"channels\": 2, \"strikes\": [{\"time_s\": 0.01, " + sound +
                             ", \"amplitude\": 1, \"x_m\": 0, \"y_m\": 0, \"duration_s\": 60}],");
    };
    EXPECT_EQ(fault("\"frequency_hz\": 5, \"decay_per_s\": 0"), "");
    EXPECT_EQ(fault("\"frequency_hz\": 2, \"decay_per_s\": 1"), "");
    EXPECT_EQ(fault("\"frequency_hz\": 2, \"decay_per_s\": 0"),
              "s.json: strikes[0].frequency_hz: expected at least 5 Hz, or a decay of at least 1 per second, "
              "found 2 Hz");
}

TEST(SessionFile, StrikesKeepDepthPartAndKindWhereTheyHaveThem) {
    const auto with = [](const std::string& place) {
        return sessionWith("\"channels\": 2,",
                           "\"channels\": 2, \"strikes\": [{\"time_s\": 0.01, \"frequency_hz\": 200, "
                           "\"decay_per_s\": 30, \"amplitude\": 1, \"x_m\": 0, \"y_m\": 0" +
                               place + "}],");
    };
    const auto session = readSession(with(", \"z_m\": -0.25, \"part\": 12"), "s.json");
    ASSERT_EQ(session.error, "");
    const auto& strikes = session.value.log.strikes;
    ASSERT_EQ(strikes.size(), 1U);
    EXPECT_EQ(strikes[0].z, -0.25);
    EXPECT_EQ(strikes[0].source.part, 12);
    EXPECT_EQ(readSession(sessionJson(session.value), "s.json").value.log.strikes, strikes);
    const auto grain = readSession(with(", \"kind\": \"slide\""), "s.json");
    ASSERT_EQ(grain.error, "");
    EXPECT_EQ(grain.value.log.strikes[0].source.kind, ContactKind::slide) << "panned as it was";
    EXPECT_EQ(readSession(sessionJson(grain.value), "s.json").value.log.strikes, grain.value.log.strikes);
    const std::string flat = sessionJson(readSession(with(""), "s.json").value);
    for (const char* absent : {"z_m", "\"part\"", "\"kind\""})
        EXPECT_EQ(flat.find(absent), std::string::npos) << "as it was";
    EXPECT_EQ(readSession(with(", \"part\": -1"), "s.json").error,
              "s.json: strikes[0].part: expected 0 to 2147483647, found -1");
    const std::string largest = std::to_string(std::numeric_limits<PartNumber>::max());
    const auto far = readSession(with(", \"part\": " + largest + ", \"sound\": " + largest), "s.json");
    ASSERT_EQ(far.error, "") << "names are numbers up to there";
    EXPECT_EQ(readSession(sessionJson(far.value), "s.json").value.log.strikes, far.value.log.strikes);
    EXPECT_EQ(far.value.log.strikes[0].sound, far.value.log.strikes[0].source.part);
    EXPECT_EQ(readSession(with(", \"part\": 2147483648"), "s.json").error,
              "s.json: strikes[0].part: expected a whole number, found 2147483648");
}

TEST(SessionFile, ClipsOfOlderSessionsAreKnownByTheirFrequency) {
    const auto old = readFile(PHYSVIB_SOURCE_DIR "/Tests/Fuzz/corpus/session/clips.json", 100'000).value;
    const auto session = readSession(old, "s.json");
    ASSERT_EQ(session.error, "");
    ASSERT_FALSE(session.value.log.clips.empty());
    const auto& strikes = session.value.log.strikes;
    ASSERT_FALSE(strikes.empty());
    EXPECT_EQ(strikes.front().sound, soundOfClip(1)) << "2/1024 Hz";
    EXPECT_EQ(strikes.front().frequencyHz, clipFrequencyHz);
    const auto again = readSession(sessionJson(session.value), "s.json");
    ASSERT_EQ(again.error, "");
    EXPECT_EQ(again.value.log.strikes, strikes);
    EXPECT_EQ(again.value.log.clips.size(), session.value.log.clips.size());
}

TEST(SessionFile, ARecordingNamesItsMaterial) {
    const auto session = readSession(
        sessionWith("\"channels\": 2,",
                    "\"channels\": 2, \"recordings\": [{\"time_s\": 0.1, \"files\": [{\"frequency_hz\": 80, "
                    "\"file\": \"synthetic-1\", \"material\": \"oak\"}, {\"frequency_hz\": 80, \"file\": "
                    "\"synthetic-2\"}]}],"),
        "s.json");
    ASSERT_EQ(session.error, "");
    const auto& files = session.value.log.recordings.front().files;
    EXPECT_EQ(files[0].sound(), soundOfMaterial("oak"));
    EXPECT_EQ(files[1].sound(), 0);
    EXPECT_EQ(readSession(sessionJson(session.value), "s.json").value.log.recordings,
              session.value.log.recordings);
}

TEST(SessionFile, AnEqualiserOutOfRangeIsNamed) {
    const auto fault = [](const std::string& resonator, const std::string& band) {
        return faultWith("\"channels\": 2,", "\"channels\": 2, \"equalised\": [null, {" + resonator +
                                                 ", \"band_hz\": " + band + "}],");
    };
    EXPECT_EQ(fault("\"resonance_hz\": 200, \"q\": 10", "[50, 400]"), "");
    EXPECT_EQ(fault("\"resonance_hz\": 1e30, \"q\": 10", "[50, 400]"),
              "s.json: equalised[1].resonance_hz: expected 1 to 20000, found 1e+30");
    EXPECT_EQ(fault("\"resonance_hz\": 200, \"q\": 1e9", "[50, 400]"),
              "s.json: equalised[1].q: expected 0.05 to 1000, found 1e+09");
    EXPECT_EQ(fault("\"resonance_hz\": 200, \"q\": 10", "[400, 400]"),
              "s.json: equalised[1].band_hz: expected a highest frequency above the lowest");
    EXPECT_EQ(fault("\"resonance_hz\": 200, \"q\": 10", "[5e-324, 400]"),
              "s.json: equalised[1].band_hz[0]: expected 1 to 20000, found 5e-324");
}

TEST(SessionFile, EveryNumberOutOfItsRangeIsNamed) {
    const std::string strike =
        R"("frequency_hz": 200, "decay_per_s": 30, "amplitude": 1, "x_m": 0, "y_m": 0)";
    const struct {
        std::string from, to, fault;
    } rows[]{
        {"5.009333333", "-1", "seconds: expected a number from 0 to 1e+06, found -1"},
        {"5.009333333", "1e7", "seconds: expected a number from 0 to 1e+06, found 10000000.0"},
        {"\"steps_per_second\": 100", "\"steps_per_second\": 9",
         "steps_per_second: expected 10 to 10000, found 9"},
        {"\"steps_per_second\": 100", "\"steps_per_second\": 99.5",
         "steps_per_second: expected a whole number, found 99.5"},
        {"\"channels\": 2", "\"channels\": 65", "channels: expected 1 to 64, found 65"},
        {"[0.5, 1]", "[0.5]", "ceilings: expected 2 numbers, one per channel"},
        {"[0.5, 1]", "[0, 1]", "ceilings[0]: expected 1e-06 to 1, found 0"},
        {"[0.5, 1]", "[1, 1e-50]", "ceilings[1]: expected 1e-06 to 1, found 1e-50"},
        {"[0.5, 1]", "[1, 1.5]", "ceilings[1]: expected 1e-06 to 1, found 1.5"},
        {"\"exponent\": 1", "\"exponent\": 101", "panning.exponent: expected 0.001 to 100, found 101"},
        {"[4, 2]", "[4, 0]", "panning.field_m[1]: expected 0.001 to 1e+06, found 0"},
        {"\"start_s\": 0", "\"start_s\": -1",
         "takes[0].start_s: expected a number from 0 to 1e+06, found -1"},
        {"\"world_end_s\": 1.5", "\"world_end_s\": 1e7",
         "takes[0].world_end_s: expected a number from 0 to 1e+06, found 10000000.0"},
        {"\"seed\": 1", "\"seed\": -1", "takes[0].seed: expected a number from 0 to 4294967295, found -1"},
        {"\"seed\": 1", "\"seed\": 1.5", "takes[0].seed: expected a whole number, found 1.5"},
        {"0.000666667", "-1", "takes[0].stalls[0].seconds: expected a number from 0 to 1e+06, found -1"},
        {"0.000666667", "1, \"steps\": 0", "takes[0].stalls[0].steps: expected 1 to 1000000000, found 0"},
        {"\"channel\": 1", "\"channel\": 3", "controls[0].channel: expected a channel from 1 to 2, found 3"},
        {"\"value\": 0.5", "\"value\": 1001", "controls[0].value: expected -1000 to 1000, found 1001"},
        {"\"time_s\": 0.2", "\"time_s\": 0.05",
         "controls[1].time_s: expected a time that is not before that of the item above"},
        {"\"gain\", \"channel\": 1, \"value\"", "\"delay\", \"channel\": 1, \"seconds\"",
         "controls[0].seconds: expected 0 to 0.05, found 0.5"},
        {"\"controls\"", "\"shaping\": { \"fixed_amplitude\": -1 }, \"controls\"",
         "shaping.fixed_amplitude: expected a number from 0 to 1e+06, found -1"},
        {"\"controls\"", "\"shaping\": { \"gain\": 1e7 }, \"controls\"",
         "shaping.gain: expected a number from 0 to 1e+06, found 10000000.0"},
        {"\"controls\"", "\"shaping\": { \"gamma\": 1 }, \"controls\"",
         "shaping.gamma: expected 0 to 0.99, found 1"},
        {"\"controls\"",
         "\"recordings\": [{ \"time_s\": 0, \"files\": [{ \"frequency_hz\": 0, \"file\": \"a\" }] }], "
         "\"controls\"",
         "recordings[0].files[0].frequency_hz: expected a number > 0, found 0"},
        {"\"controls\"", "\"clips\": [{ \"file\": \"a\", \"hash\": \"0\", \"channel\": 64 }], \"controls\"",
         "clips[0].channel: expected 0 to 63, found 64"},
        {"\"controls\"", "\"strikes\": [{ \"time_s\": -1, " + strike + " }], \"controls\"",
         "strikes[0].time_s: expected a number from 0 to 1e+06, found -1"},
        {"\"controls\"", "\"strikes\": [{ \"time_s\": 1, \"kind\": \"fall\", " + strike + " }], \"controls\"",
         "strikes[0].kind: expected one of hit, roll, slide, found \"fall\""},
    };
    for (const auto& row : rows) EXPECT_EQ(faultWith(row.from, row.to), "s.json: " + row.fault) << row.to;
    for (const auto& [from, to, fault] :
         {std::array{"\"output\":4", "\"output\":4.5", "output: expected a whole number, found 4.5"},
          {"\"output\":4", "\"output\":1025", "output: expected 0 to 1024, found 1025"},
          {"\"group\":6", "\"group\":6.5", "group: expected a whole number, found 6.5"},
          {"\"group\":6", "\"group\":0", "group: expected 1 to 16, found 0"}})
        EXPECT_EQ(readSession(sessionWith(from, to, "lanes"), "s.json").error,
                  std::string{"s.json: desk.strips[2]."} + fault);
}

TEST(SessionFile, EndsPausedIfItsLastWorldStoodStillToTheEnd) {
    const std::string end = "\"world_end_s\": 3.4,";
    for (const auto& [seconds, isPaused] : {std::pair{"0.1", true}, {"0.09", false}}) {
        const auto text =
            sessionWith(end, end + R"("stalls": [{"time_s": 3.4, "seconds": )" + seconds + "}],");
        EXPECT_EQ(endsPaused(readSession(text, "s").value), isPaused) << seconds;
    }
}

TEST(SessionFile, TakesOutOfOrderAndALayoutWithoutExtentAreNamed) {
    EXPECT_EQ(faultWith("\"start_s\": 0", "\"start_s\": 2"),
              "s.json: takes[1].start_s: expected a time that is not before that of the take above");
    EXPECT_EQ(faultWith("\"extent_m\": [0.12, 0.06]", "\"extent_m\": [5e-324, 0.06]"),
              "s.json: panning.layout.extent_m[0]: expected 0.001 to 1e+06, found 5e-324");
    EXPECT_EQ(faultWith("\"full_scale_g\": 1", "\"full_scale_g\": 5e-324"),
              "s.json: panning.layout.enchanters[0].full_scale_g: expected 1e-06 to 1e+06, found 5e-324");
}

TEST(SessionFile, ItsTakesAreBoundedByTheirBodies) {
    const std::string last = "{ \"start_s\": 1.6, \"world_end_s\": 3.4, \"seed\": 2 }";
    std::string spawning =
        "{ \"start_s\": 1.6, \"world_end_s\": 1.6, \"seed\": 2, \"scene\": { \"name\": \"many\", "
        "\"field_m\": [4, 2], \"materials\": [{ \"name\": \"wood\", \"density_kg_per_m2\": 850, "
        "\"friction\": 0.4, \"restitution\": 0.6, \"frequency_hz\": 80, \"decay_per_s\": 30 }], \"bodies\": "
        "[], \"script\": [{ \"time_s\": 0, \"times\": 4000, \"every_s\": 1, "
        "\"input\": \"spawn\", \"body\": { \"name\": \"ball\", \"position_m\": [2, 1], \"fixtures\": [{ "
        "\"shape\": \"circle\", \"radius_m\": 0.2, \"material\": \"wood\" }] } }] } }";
    std::string takes = spawning;
    for (int i = 0; i < 260; ++i) takes += ", " + last;
    EXPECT_EQ(faultWith(last, takes), "s.json: takes: expected at most 1000000 bodies in all takes");
}

class SessionFileInAFolder : public FolderTest {
protected:
    std::string faultOfRecording(const std::string& file, const std::string& hash) const {
        const std::string recording = "{\"frequency_hz\": 80, \"file\": \"" + file + "\"" +
                                      (hash.empty() ? "" : ", \"hash\": \"" + hash + "\"") + "}";
        EXPECT_EQ(writeFile(folder / "s.json",
                            sessionWith("\"channels\": 2,",
                                        "\"channels\": 2, \"recordings\": [{\"time_s\": 0, \"files\": [" +
                                            recording + "]}],")),
                  "");
        return loadSession(folder / "s.json").error;
    }
};

TEST_F(SessionFileInAFolder, AFileElsewhereIsReadByItsHashOnly) {
    EXPECT_EQ(faultOfRecording("a.wav", ""), "");
    EXPECT_EQ(faultOfRecording("below/a.wav", ""), "");
    EXPECT_EQ(faultOfRecording("synthetic-3", ""), "");
    EXPECT_EQ(faultOfRecording("../a.wav", "0123456789abcdef"), "")
        << "as --save writes what was played from there";
    const std::string why = "s.json: recordings: expected a hash for a file that is not in the session's "
                            "folder or below, found none for ";
    EXPECT_EQ(faultOfRecording("../a.wav", ""), (folder / "").string() + why + "\"../a.wav\"");
    EXPECT_EQ(faultOfRecording("b/../../a.wav", ""), (folder / "").string() + why + "\"b/../../a.wav\"");
    EXPECT_EQ(faultOfRecording("/etc/passwd", ""), (folder / "").string() + why + "\"/etc/passwd\"");
}

// The law of parts of the body in session files: what is rendered again is panned as it was live.

/// A row of three on the index, tilted, beside the tips of a hand.
ActuatorLayout gloveWithRow() {
    ActuatorLayout layout;
    EXPECT_TRUE(layoutPreset("glove5", layout));
    for (int j = 0; j < 2; ++j)
        layout.places[static_cast<std::size_t>(layout.count++)] = {
            0.06 - 0.01 * (j + 1), 0.085 - 0.03 * (j + 1), -0.01 - 0.005 * (j + 1), partNamed("index")};
    return layout;
}

OrderedJson written(const PhantomPanner& panner) {
    LayoutDescription described;
    return writeCustom(DescribedPanner<const LayoutDescription>{64, described}, panner);
}

PhantomPanner readBack(const OrderedJson& text) {
    LayoutDescription described;
    const Json json = Json::parse(text.dump());
    return readCustom(JsonField{json, "panning"}, DescribedPanner<LayoutDescription>{64, described});
}

PhantomPanner::Gains indexGains(const PhantomPanner& panner) {
    CollisionEvent event{.x = 0.056, .y = 0.07, .z = -0.012};
    event.source.part = partNamed("index");
    PhantomPanner::Gains gains{};
    panner.gainsAt(event, gains);
    return gains;
}

TEST(PartLaw, ComesBackWithTheSession) {
    const PhantomPanner live{gloveWithRow(), PanningLaw::automatic, 1.0, 0.14, 0.095};
    ASSERT_EQ(live.law(), PanningLaw::distance);
    EXPECT_EQ(written(live)["law"], "distance");
    EXPECT_EQ(written(live)["part_law"], "auto");
    const PhantomPanner back = readBack(written(live));
    EXPECT_EQ(back.requestedLaw(), PanningLaw::automatic);
    EXPECT_EQ(indexGains(back), indexGains(live));
    EXPECT_EQ(written(back).dump(), written(live).dump());
}

TEST(PartLaw, IsTheLawOfAllWhereAFileNamesNone) {
    const PhantomPanner live{gloveWithRow(), PanningLaw::automatic, 1.0, 0.14, 0.095};
    OrderedJson before = written(live);
    before.erase("part_law");
    const PhantomPanner named{gloveWithRow(), PanningLaw::distance, 1.0, 0.14, 0.095};
    EXPECT_EQ(indexGains(readBack(before)), indexGains(named));
    EXPECT_NE(indexGains(readBack(before)), indexGains(live));
    EXPECT_FALSE(written(named).contains("part_law"));
    ActuatorLayout phone;
    ASSERT_TRUE(layoutPreset("phone4", phone));
    EXPECT_FALSE(written({phone, PanningLaw::automatic, 1.0, 1.0, 0.5}).contains("part_law"))
        << "a layout without parts is written as before";
}

// The law of grains in session files.

TEST(GrainLaw, ComesBackAndIsTheLawOfAllElseWhereAFileNamesNone) {
    ActuatorLayout layout;
    ASSERT_TRUE(layoutPreset("phone4", layout));
    PhantomPanner panner{layout, PanningLaw::linear, 1.0, 1.0, 0.5};
    LayoutDescription described;
    const DescribedPanner<const LayoutDescription> kind{4, described};
    EXPECT_FALSE(writeCustom(kind, panner).contains("grain_law")) << "as before";
    const auto back = [&](const OrderedJson& written) {
        LayoutDescription read;
        const Json json = Json::parse(written.dump());
        return readCustom(JsonField{json, "panning"}, DescribedPanner<LayoutDescription>{4, read}).grains();
    };
    EXPECT_EQ(back(writeCustom(kind, panner)), Spread::layout);
    panner.setGrains(grainSpread);
    EXPECT_EQ(writeCustom(kind, panner)["grain_law"], "energy");
    EXPECT_EQ(back(writeCustom(kind, panner)), grainSpread);
    described = describeLayout("own", layout);
    described.actuators[1].fullScaleG = 2.5;
    const Json json = Json::parse(writeCustom(kind, panner).dump());
    LayoutDescription read;
    readCustom(JsonField{json, "panning"}, DescribedPanner<LayoutDescription>{4, read});
    EXPECT_EQ(read.name, "own");
    EXPECT_EQ(read.actuators, described.actuators) << "full scales too";
}

} // namespace physvib::session_file_test
