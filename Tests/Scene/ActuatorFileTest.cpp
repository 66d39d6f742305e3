// SPDX-License-Identifier: MIT
// Actuator profiles survive writing and reading, say what is not known, and a bad one is named by its field.
#include "Scene/ActuatorFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Scene/MaterialTable.h"
#include "Scene/PadFile.h"
#include "Support/FileTesting.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>

namespace physvib::actuator_file_test {

ActuatorProfile measured() {
    ActuatorProfile p;
    p.name = "mine";
    p.description = "a \"coin\"";
    p.source = "measured";
    p.resonanceHz = 204.7;
    p.q = 11.25;
    p.band = FrequencyBand{180.0, 230.0};
    p.driveLimitVolts = 2.8;
    p.riseSeconds = 0.038;
    p.fullScaleG = 1.3;
    p.delaySeconds = 0.0;
    return p;
}

/// Of a text with one thing replaced.
std::string errorOf(auto read, std::string text, const std::string& what, const std::string& with) {
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    const auto found = read(text.replace(at, what.size(), with), "my.json");
    EXPECT_FALSE(found) << text;
    EXPECT_TRUE(found.value == decltype(found.value){});
    return found.error;
}
std::string errorOf(const std::string& what, const std::string& with) {
    return errorOf(readActuator, actuatorJson(measured()), what, with);
}

TEST(ActuatorFile, WrittenAndReadItIsTheSame) {
    for (ActuatorProfile p : builtInActuators())
        EXPECT_TRUE(readActuator(actuatorJson(p), "a").value == p) << p.name;
    EXPECT_TRUE(readActuator(actuatorJson(measured()), "a").value == measured());
}

TEST(ActuatorFile, TheBuiltInProfilesHaveTheFiguresOfTheThesisAndNoOthers) {
    const auto& all = builtInActuators();
    ASSERT_EQ(all.size(), 7u);
    EXPECT_EQ(findActuator("lra-205").value.resonanceHz, 205.0);
    EXPECT_EQ(findActuator("piezo-230").value.resonanceHz, 230.0);
    EXPECT_EQ(findActuator("haptuator-mark-2").value.bandOrUnknown(), (FrequencyBand{90.0, 1000.0}));
    EXPECT_EQ(findActuator("haptuator-2").value.driveLimitVolts, 3.0);
    EXPECT_EQ(findActuator("erm-coin").value.kind, ActuatorKind::rotating);
    for (const auto& p : all) {
        EXPECT_FALSE(p.q) << p.name; // nobody printed one
        EXPECT_FALSE(p.source.empty()) << p.name;
    }
}

TEST(ActuatorFile, TheExampleForAnAmplifierIsOneToFillIn) {
    const auto read = loadActuator(PHYSVIB_SOURCE_DIR "/Standalone/Examples/max98357a.json");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.driveLimitVolts, 2.5);
    EXPECT_FALSE(read.value.resonanceHz) << "which is the actuator's";
}

TEST(ActuatorFile, SaysWhatKeepsAnActuatorFromBeingEqualised) {
    EXPECT_EQ(equaliserError(findActuator("lra-205").value),
              "q is not known (measure it with physvib calibrate)");
    EXPECT_EQ(equaliserError(findActuator("voice-coil").value).rfind("resonance_hz is not known", 0), 0u);
    EXPECT_EQ(equaliserError(findActuator("erm-coin").value).rfind("a rotating mass", 0), 0u);
    EXPECT_EQ(equaliserError(measured()), "");
    EXPECT_TRUE(measured().resonator().isKnown());
    EXPECT_FALSE(findActuator("lra-205").value.resonator().isKnown());
}

TEST(ActuatorFile, FaultsNameTheirField) {
    EXPECT_EQ(errorOf("204.7", "0"), "my.json: resonance_hz: expected 1 to 20000, found 0");
    EXPECT_EQ(errorOf("11.25", "-1"), "my.json: q: expected 0.05 to 1000, found -1");
    EXPECT_EQ(errorOf("11.25", "1e999").rfind("my.json: ", 0), 0u);
    EXPECT_EQ(errorOf("11.25", "\"high\""), "my.json: q: expected a number, found a string");
    EXPECT_EQ(errorOf("[180, 230]", "[230, 180]"),
              "my.json: band_hz: expected a highest frequency above the lowest");
    EXPECT_EQ(errorOf("[180, 230]", "[180]"),
              "my.json: band_hz: expected [lowest, highest] or null, found 1 items");
    EXPECT_EQ(errorOf("230]", "23000]"), "my.json: band_hz[1]: expected 1 to 20000, found 23000");
    EXPECT_EQ(errorOf("\"linear\"", "\"magic\""),
              "my.json: kind: expected one of linear, rotating, found \"magic\"");
    EXPECT_EQ(errorOf("\"mine\"", "\"\""), "my.json: name: expected a name, found an empty string");
    EXPECT_EQ(errorOf("\"physvib_actuator\": 1", "\"physvib_actuator\": 2"),
              "my.json: physvib_actuator: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(errorOf("\"q\"", "\"Q\""), "my.json: unknown field \"Q\"");
    EXPECT_EQ(errorOf(",\n  \"delay_s\": 0", ""), "my.json: field \"delay_s\" is missing");
    EXPECT_EQ(findActuator("tapper").error, "no actuator \"tapper\" (see physvib actuators)");
}

TEST(ActuatorFile, NoAccidentGetsPastTheReaderUnnoticed) {
    std::mt19937 random(1);
    const std::string good = actuatorJson(measured());
    for (int i = 0; i < 3000; ++i) {
        const auto read = readActuator(mutated(good, "{}[]\",:0123456789.-e nul", random), "f");
        if (read)
            EXPECT_TRUE(readActuator(actuatorJson(read.value), "f").value == read.value);
        else
            EXPECT_EQ(read.error.rfind("f: ", 0), 0u) << read.error;
    }
}

using ActuatorFileOnDiskTest = FolderTest;

TEST_F(ActuatorFileOnDiskTest, LoadsWhatWasWrittenAndRefusesWhatIsNoProfile) {
    const std::string path = (folder / "mine.json").string();
    ASSERT_EQ(writeFile(path, actuatorJson(measured())), "");
    EXPECT_TRUE(findActuator(path).value == measured());
    ASSERT_EQ(writeFile(path, std::string(200'000, ' ')), "");
    EXPECT_EQ(findActuator(path).error, path + ": expected at most 100000 bytes, found more");
    EXPECT_NE(findActuator((folder / "none.json").string()).error.find("cannot be read"), std::string::npos);
}

// Profiles of game controllers survive writing and reading, and a bad one is named by its field; a render's
// commands as a table.

std::string padErrorOf(const std::string& what, const std::string& with) {
    return errorOf(readPad, padJson(builtInPads().front()), what, with);
}

TEST(PadFile, WrittenAndReadItIsTheSame) {
    ASSERT_EQ(builtInPads().size(), 3u);
    for (const PadProfile& p : builtInPads()) {
        EXPECT_TRUE(readPad(padJson(p), "a").value == p) << p.name;
        EXPECT_FALSE(p.source.empty()) << p.name;
        EXPECT_TRUE(findPad(p.name).value == p);
    }
    PadProfile mine = builtInPads()[1];
    mine.law.low.threshold = 0.1 + 0.2;
    mine.law.leadSeconds = 0.0;
    EXPECT_TRUE(readPad(padJson(mine), "a").value == mine);
}

TEST(PadFile, TheXboxProfileHasTheMeasuredFigures) {
    const PadModel law = findPad("pad-xbox").value.law;
    for (const PadMotor& motor : {law.low, law.high}) {
        EXPECT_EQ(motor.threshold, 0.3);
        EXPECT_EQ(motor.half, 0.5);
        EXPECT_EQ(motor.full, 0.86);
    }
    EXPECT_EQ(law.low.riseSeconds, 0.19);
    EXPECT_EQ(law.high.riseSeconds, 0.11);
}

TEST(PadFile, ABadProfileIsNamedByItsField) {
    EXPECT_EQ(padErrorOf("\"half\": 0.5", "\"half\": 0.3"),
              "my.json: low.half: expected more than threshold, 0.3");
    EXPECT_EQ(padErrorOf("\"full\": 0.86", "\"full\": 0.4"),
              "my.json: low.full: expected more than half, 0.5");
    PadProfile high = builtInPads().front(); // its low motor is right
    high.law.high.half = high.law.high.full;
    EXPECT_EQ(readPad(padJson(high), "my.json").error.rfind("my.json: high.full: expected more than half", 0),
              0u);
    EXPECT_EQ(padErrorOf("\"commands_per_s\": 30", "\"commands_per_s\": 0")
                  .rfind("my.json: commands_per_s: expected", 0),
              0u);
    EXPECT_EQ(padErrorOf("\"rise_s\"", "\"rise_ms\"").rfind("my.json: low", 0), 0u);
    EXPECT_EQ(padErrorOf("pad-generic", ""), "my.json: name: expected a name, found an empty string");
    EXPECT_EQ(findPad("pad-atari").error, "no controller profile \"pad-atari\": expected pad-generic, "
                                          "pad-xbox, pad-dualshock or a file NAME.json");
}

TEST(PadCommands, ATableBeginsAndEndsAtRestAndHoldsWhatDiffers) {
    ActuatorLayout phone;
    layoutPreset("phone4", phone);
    const PhantomPanner panner{phone, PanningLaw::linear, 1.0, 1.0, 1.0};
    CollisionEvent hit;
    hit.timeNs = 500'000'000;
    hit.frequencyHz = 60.0;
    hit.decayPerSecond = 1.0;
    hit.amplitude = 1.0;
    hit.x = hit.y = 0.5;
    const PadModel law = builtInPads().front().law;
    const auto rings = padCommands(law, {&hit, 1}, {}, panner, 900'000'000);
    ASSERT_GE(rings.size(), 3u);
    EXPECT_TRUE(rings.front().isSame({}));
    EXPECT_EQ(rings[1].timeNs, 470'000'000) << "the lead";
    EXPECT_TRUE(rings.back().isSame({}));
    EXPECT_EQ(rings.back().timeNs, 900'000'000) << "it still rings, and is ended";
    for (std::size_t i = 1; i < rings.size(); ++i) EXPECT_FALSE(rings[i].isSame(rings[i - 1]));

    RenderControl stop;
    stop.timeNs = 600'000'000;
    const auto stopped = padCommands(law, {&hit, 1}, {&stop, 1}, panner, 900'000'000);
    EXPECT_GE(stopped.back().timeNs, 600'000'000);
    EXPECT_LT(stopped.back().timeNs, 640'000'000);
    EXPECT_EQ(motorsCsv({{}, {470'000'000, 1.0, 0.55}}, {"1", {}}),
              "# physvib 1\ntime_s,low,high\n0.000000000,0.00,0.00\n0.470000000,1.00,0.55\n");
}

// Material libraries survive writing and reading, and Table 5.1 is what the thesis printed.

std::string tableErrorOf(const std::string& text) {
    const auto read = readMaterials(text, "my.json");
    EXPECT_FALSE(read);
    EXPECT_TRUE(read.value == MaterialTable{});
    return read.error;
}

TEST(MaterialTable, HasTheRowsOfTheThesis) {
    const MaterialTable& table = builtInMaterials().front();
    ASSERT_EQ(table.materials.size(), 6U);
    const Material& steel = table.materials[5];
    EXPECT_EQ(steel.name, "steel plate");
    EXPECT_EQ(steel.densityKgPerSquareMetre, 7820.0);
    EXPECT_EQ(steel.restitution, 0.597);
    EXPECT_EQ(steel.frequencyHz, 430.0);
    EXPECT_EQ(steel.decayPerSecond, 11.97);
    EXPECT_EQ(table.materials[0].densityKgPerSquareMetre, 120.0);
}

TEST(MaterialTable, FaultsNameTheirField) {
    const auto with = [](const std::string& materials) {
        return tableErrorOf(R"({"physvib_materials": 1, "name": "n", "materials": [)" + materials + "]}");
    };
    const std::string good = R"({"name": "a", "density_kg_per_m2": 1, "friction": 0, "restitution": 0})";
    EXPECT_EQ(with(R"({"name": "a", "density_kg_per_m2": 1, "friction": -1, "restitution": 0})"),
              "my.json: materials[0].friction: expected 0 to 100, found -1");
    EXPECT_EQ(with(good + "," + good),
              "my.json: materials[1].name: expected a name of its own, found \"a\" again");
    EXPECT_EQ(with("3"), "my.json: materials[0]: expected an object, found a number");
    EXPECT_EQ(tableErrorOf(R"({"physvib_materials": 2})"),
              "my.json: physvib_materials: made for a newer PhysVib: expected a version up to 1, found 2");
    EXPECT_EQ(tableErrorOf(R"({"physvib_materials": 1, "nam": ""})"), "my.json: unknown field \"nam\"");
}

TEST(MaterialTable, AFileIsReadAsTheTableThatIsBuiltIn) {
    EXPECT_TRUE(loadMaterials(PHYSVIB_SOURCE_DIR "/Source/Scene/Materials/table-5-1.json").value ==
                builtInMaterials().front());
}

} // namespace physvib::actuator_file_test
