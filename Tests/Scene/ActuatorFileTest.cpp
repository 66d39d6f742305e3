// SPDX-License-Identifier: MIT
// Actuator profiles survive writing and reading, say what is not known, and a bad one is named by its field.
#include "Scene/ActuatorFile.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ReadFile.h"
#include "Support/FileTesting.h"
#include "TestPlaces.h"

namespace physvib {
namespace {

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

/// The profile above with one thing replaced.
std::string errorOf(const std::string& what, const std::string& with) {
    std::string text = actuatorJson(measured());
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    const auto read = readActuator(text.replace(at, what.size(), with), "my.json");
    EXPECT_FALSE(read) << text;
    EXPECT_TRUE(read.value == ActuatorProfile{});
    return read.error;
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
    EXPECT_EQ(findActuator("haptuator-mark-2").value.bandOrNone(), (FrequencyBand{90.0, 1000.0}));
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
    EXPECT_EQ(equaliserFault(findActuator("lra-205").value),
              "q is not known (measure it with physvib calibrate)");
    EXPECT_EQ(equaliserFault(findActuator("voice-coil").value).rfind("resonance_hz is not known", 0), 0u);
    EXPECT_EQ(equaliserFault(findActuator("erm-coin").value).rfind("a rotating mass", 0), 0u);
    EXPECT_EQ(equaliserFault(measured()), "");
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

} // namespace
} // namespace physvib
