// SPDX-License-Identifier: MIT
// Counts in words: `--explain` promises these lines.
#include "Contacts/ContactCounts.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

ContactCounts tenContacts() {
    ContactCounts counts;
    counts.contacts = 10;
    counts.hasStepped = counts.hasSources = true;
    counts.thresholdMetresPerSecond = 0.15;
    return counts;
}

TEST(ContactCounts, AreTheLinesThatArePromised) {
    ContactCounts counts = tenContacts();
    counts.belowThreshold = 3;
    counts.withoutSource = 2;
    counts.unplayable = 1;
    counts.muted = 4;
    counts.dropped = 5;
    counts.events = 6;
    const std::string text = describe(counts);
    const std::string lines = "contacts 10\nbelow the threshold of 0.15 m/s: 3\nno haptic source: 2\nunplayable: 1\nmuted: 4\ndropped: 5\nevents: 6\n";
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
    EXPECT_NE(reason(&ContactCounts::belowThreshold).find("slower than the threshold of 0.15 m/s"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::unplayable).find("frequency and the decay"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::muted).find("muted"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::dropped).find("left out"), std::string::npos);
    EXPECT_NE(reason(&ContactCounts::events).find("7 events were made"), std::string::npos);
    EXPECT_NE(explain({}).find("No step"), std::string::npos);
    ContactCounts unfelt = tenContacts();
    unfelt.hasSources = false;
    EXPECT_NE(explain(unfelt).find("haptic source: set is_camera"), std::string::npos);
}

} // namespace
} // namespace physvib
