// SPDX-License-Identifier: GPL-3.0-or-later
// A call of `render` is a value: each of its options is in it, and the same words are the same value.
#include "Calls/CallOptions.h"
#include "Io/Text/NumberText.h"
#include "Options/OptionTable.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

Result<RenderJob> jobOf(const std::string& call) {
    OptionTable table{"render", {}};
    RenderJob job;
    declareRenderOptions(table, job);
    const auto parsed = parseText(table, call);
    return parsed.fault.empty() ? Result<RenderJob>{job} : Failure{parsed.reason()};
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
        return plainNumber(option.initial == plainNumber(option.low) ? option.high : option.low);
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
                          call = option.isPlace ? otherWord(option) : name + '=' + otherWord(option);
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
    EXPECT_EQ(renderInputFault(job), "render: give either a scene or --from-events EVENTS.csv");
    job.scene = "drop";
    EXPECT_EQ(renderInputFault(job), "");
    EXPECT_EQ(renderFault(job), "render: nothing to write; give --out, --events, --picture, --movie, "
                                "--pattern, --contact-sound or --marker");
    job.isRemapped = true;
    EXPECT_EQ(sceneFault(job), "--remap: expected an --actuator, whose band is to be used");
    job = {};
    job.playsRecordings = true;
    EXPECT_EQ(sceneFault(job), "--method SV: expected a --sound for each material");
}

} // namespace
} // namespace physvib
