// SPDX-License-Identifier: MIT
// Stimuli as values: what is wrong with one, and the words that make it again.
#include "Lab/Study/Stimulus.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::string faultText(const StimulusJob& job) {
    const JobFault fault = faultOf(job);
    return fault ? fault.words() : std::string{};
}

TEST(StimulusJob, ItsWordsAreThoseOfTheProgram) {
    EXPECT_EQ(textOf(StimulusJob{PatternJob{"ABA-250", 0.2}, "ring3", std::nullopt, 0.5}),
              "stimulus pattern ABA-250 --layout ring3 --frequency resonance --level-g 0.5 --gap 0.2");
    EXPECT_EQ(textOf(StimulusJob{PhantomJob{FieldPlace{0.25, 1.0}}}),
              "stimulus phantom --at 0.25,1 --layout phone4 --frequency 205 --level-g 1 --law linear "
              "--exponent 1 --seconds 1");
    const GridPlace cell{{7, 5, PhantomGrid::Points::middles}, {2, 6}};
    EXPECT_EQ(textOf(StimulusJob{PhantomJob{cell, PanningLaw::energy, 2.0, 0.5}, "phone4", 60.5}),
              "stimulus phantom --grid 7x5 --cell 2,6 --points middles --layout phone4 --frequency 60.5 "
              "--level-g 1 --law energy --exponent 2 --seconds 0.5");
}

TEST(StimulusJob, FaultsNameTheWord) {
    EXPECT_EQ(faultText({PatternJob{"ABA-250"}}), "");
    EXPECT_EQ(faultText({PhantomJob{GridPlace{{7, 5}, {5, 7}}}}), "");
    EXPECT_EQ(faultText({PatternJob{"250"}}),
              "expected a pattern like ABA-250 (one to three enchanters, then milliseconds)");
    EXPECT_EQ(faultText({PhantomJob{FieldPlace{0.5, 1.1}}}), "--at: expected X,Y from 0 to 1");
    EXPECT_EQ(faultText({PhantomJob{GridPlace{{17, 5}, {1, 1}}}}), "--grid: expected COLUMNSxROWS like 7x5");
    EXPECT_EQ(faultText({PhantomJob{GridPlace{{7, 5}, {0, 1}}}}),
              "--cell: expected r,c of the grid (row 1 is the upper one)");
    EXPECT_EQ(faultText({PhantomJob{FieldPlace{}, PanningLaw::linear, 0.0}}),
              "--exponent: expected 0.01 to 100");
    EXPECT_EQ(faultText({PatternJob{"A-100"}, "phone4", 0.0}),
              "--frequency: expected 5 to 20000 Hz, or resonance");
    EXPECT_EQ(faultText({PatternJob{"A-100"}, "phone4", 205.0, 2000.0}), "--level-g: expected 1e-06 to 1000");
}

TEST(StimulusJob, IsEqualIfAllOfItIs) {
    const StimulusJob one{PhantomJob{FieldPlace{0.5, 0.5}}};
    StimulusJob other = one;
    EXPECT_EQ(one, other);
    std::get<PhantomJob>(other.what).law = PanningLaw::log;
    EXPECT_NE(one, other);
}

} // namespace
} // namespace physvib
