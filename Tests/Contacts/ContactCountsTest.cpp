// SPDX-License-Identifier: MIT
// Counts in words: `--explain` promises these lines.
#include "Contacts/ContactCounts.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

ContactCounts tenContacts() {
    ContactCounts counts;
    counts.contacts = 10;
    counts.steps = 20;
    counts.hasSources = true;
    counts.thresholdMetresPerSecond = 0.15;
    return counts;
}

void made(ContactCounts& counts, double x, double y) { counts.made({1, x, y, x, y}); }

TEST(ContactCounts, AreTheLinesThatArePromised) {
    ContactCounts counts = tenContacts();
    counts.belowThreshold = 3;
    counts.withoutSource = 2;
    counts.unplayable = 1;
    counts.muted = 4;
    counts.dropped = 5;
    counts.handedOn = 7;
    counts.events = 6;
    const std::string text = describe(counts);
    const std::string lines = "contacts 10\nbelow the threshold of 0.15 m/s: 3\nno haptic source: "
                              "2\nunplayable: 1\nmuted: 4\ndropped: 5\nhanded on by movable sources: "
                              "7\nevents: 6\n";
    ASSERT_GT(text.size(), lines.size());
    EXPECT_EQ(text.substr(text.size() - lines.size()), lines);
}

TEST(ContactCounts, NameTheMostFrequentReason) {
    const auto reason = [](std::uint64_t ContactCounts::*most) {
        ContactCounts counts = tenContacts();
        counts.belowThreshold = counts.unplayable = counts.muted = counts.dropped = 1;
        counts.*most = 7;
        return explain(counts);
    };
    EXPECT_NE(reason(&ContactCounts::belowThreshold).find("slower than the threshold of 0.15 m/s"),
              std::string::npos);
    EXPECT_NE(reason(&ContactCounts::unplayable).find("set frequency_hz and decay_per_s"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::muted).find("muted"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::dropped).find("left out"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::events).find("7 events were made"), std::string::npos);
    EXPECT_NE(explain({}).find("No step"), std::string::npos);
    ContactCounts unfelt = tenContacts();
    unfelt.hasSources = false;
    EXPECT_NE(explain(unfelt).find("haptic source: set is_camera"), std::string::npos);
    EXPECT_NE(inNames(explain(unfelt), Names::cpp).find("haptic source: set isCamera"), std::string::npos);
    EXPECT_NE(inNames(explain(unfelt), Names::scene).find("haptic source: set camera"), std::string::npos);
    EXPECT_NE(inNames(explain(unfelt), Names::mixer).find("with Select, tick 'haptic source' of"),
              std::string::npos);
}

TEST(ContactCounts, NameTheOptionOfTheCommandLine) {
    EXPECT_EQ(inNames("set field_width_m and field_height_m of the renderer", Names::scene),
              "set the field (--field) of the renderer");
    EXPECT_EQ(inNames("set field_width_m", Names::cpp), "set fieldWidthMetres");
}

TEST(ContactCounts, ExplainWhatCameSince) {
    ContactCounts ever = tenContacts(), since;
    made(ever, 0.5, 0.5);
    EXPECT_EQ(explain(since, ever).find("Nothing was stepped since the last explanation; before: 1 event"),
              0u)
        << explain(since, ever);
    since.steps = 3;
    since.hasSources = true;
    since.longestStepSeconds = 0.01;
    EXPECT_EQ(explain(since, ever).find("No contact has begun in 3 steps"), 0u) << explain(since, ever);
    since.note(EngineNote::asleep, 4);
    since.note(EngineNote::asleep, 5);
    EXPECT_NE(explain(since, ever).find("body 5 (and 1 other source) is asleep"), std::string::npos)
        << explain(since, ever);
}

// A device that was opened without a field spans centimetres: what a world of metres makes lies outside.
TEST(ContactCounts, NameWhereEventsLieWhichTheFieldMustSpan) {
    ContactCounts counts = tenContacts(), other = tenContacts();
    counts.fieldWidthMetres = 20.0;
    made(counts, 3.0, 0.5);
    made(counts, 19.8, 0.25);
    EXPECT_NE(explain(counts).find("2 events were made, at x 3 to 19.8 m, y 0.25 to 0.5 m: nothing is "
                                   "wrong in this world. What plays it was not looked at: the field of the "
                                   "renderer or device must span these places"),
              std::string::npos)
        << explain(counts);
    other.fieldWidthMetres = 200.0;
    made(other, -1.0, 9.0);
    EXPECT_EQ((counts += tenContacts()).events, 2u);
    counts += other;
    EXPECT_EQ(counts.events, 3u);
    EXPECT_NE(explain(counts).find("at x -1 to 19.8 m, y 0.25 to 9 m"), std::string::npos) << explain(counts);
    counts.events = ~std::uint64_t{0};
    counts.leastX = counts.leastY = -1.23456e-100;
    counts.mostX = counts.mostY = -1.23456e-101;
    EXPECT_LT(explain(counts).size(), 512u) << "as physvib.h promises";
}

} // namespace
} // namespace physvib
