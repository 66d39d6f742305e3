// SPDX-License-Identifier: GPL-3.0-or-later
// What a row of a study says is read as the value that it was written from.
#include "Calls/CallOptions.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Experiment.h"
#include "Options/OptionTable.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

Result<StimulusJob> read(const std::string& call) {
    OptionTable words{"physvib", {}};
    StimulusOptions options;
    OptionTable& stimulus = words.addCommand("stimulus", {});
    declareStimulus(stimulus, options);
    if (const auto parsed = parseText(words, call); !parsed.fault.empty()) return Failure{parsed.fault};
    return readStimulus(stimulus, options);
}

void expectBack(const StimulusJob& job) {
    const auto back = read(textOf(job));
    ASSERT_TRUE(back) << textOf(job) << ": " << back.error;
    EXPECT_EQ(back.value, job) << textOf(job) << " became " << textOf(back.value);
}

TEST(StimulusWords, WhatIsWrittenIsReadAsTheSameValue) {
    expectBack({PatternJob{"ABA-250", 0.2}, "ring3", std::nullopt, 0.5});
    expectBack({PhantomJob{FieldPlace{0.1, 1.0}, PanningLaw::logOuter, 2.5, 0.25}, "own.json", 60.5, 1e-6});
    for (const auto points : {PhantomGrid::Points::corners, PhantomGrid::Points::middles})
        expectBack({PhantomJob{GridPlace{{7, 5, points}, {2, 6}}}});
}

TEST(StimulusWords, SoIsEveryStimulusOfTheBuiltInProtocols) {
    std::size_t jobs = 0;
    for (const Protocol& protocol : builtInProtocols())
        for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
            for (const StimulusItem& item : stimuliOf(protocol.conditions[c])) {
                TrialRecord record;
                record.trial.condition = c;
                record.trial.stimulus = item.label;
                for (const TrialJob& job : jobsOf(protocol, record))
                    if (const auto* const stimulus = std::get_if<StimulusJob>(&job))
                        expectBack(*stimulus), ++jobs;
            }
    EXPECT_GT(jobs, 300u);
}

TEST(StimulusWords, WhatIsNoStimulusIsToldInTheWordsOfTheCall) {
    EXPECT_EQ(read("stimulus phantom --at 0.5,1.5").error,
              "--at: expected X,Y from 0 to 1, found \"0.5,1.5\"");
    EXPECT_EQ(read("stimulus phantom --grid 7x5.5 --cell 1,1").error,
              "--grid: expected COLUMNSxROWS like 7x5, found \"7x5.5\"");
    EXPECT_EQ(read("stimulus phantom --grid 7x5 --cell 1,8").error,
              "--cell: expected r,c of the grid (row 1 is the upper one), found \"1,8\"");
    EXPECT_EQ(read("stimulus phantom --grid 7x5").error,
              "give either --at X,Y or --grid CxR with --cell r,c");
    EXPECT_EQ(read("stimulus pattern ABA").error,
              "expected a pattern like ABA-250 (one to three enchanters, then milliseconds), found \"ABA\"");
    EXPECT_EQ(read("stimulus pattern A-100 --frequency 1e9").error,
              "--frequency: expected 5 to 20000 Hz, or resonance, found \"1e9\"");
}

} // namespace
} // namespace physvib
