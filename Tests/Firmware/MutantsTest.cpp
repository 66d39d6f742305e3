// SPDX-License-Identifier: MIT
// Images with a planted fault: each must be found by what the other tests look at.
#include "Rig.h"
#include "Support/BoardHazards.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

test::Parity play(test::Rig& rig) {
    return test::comparePlay(rig, {300, 2000, 28'000, 20, 0.2, 0}, 8, 30'000);
}
std::string mutant(const std::string& name) { return PHYSVIB_MUTANTS "/" + name + "/build/physvib-f334.elf"; }

TEST(BoardMutants, WithoutSetUpDelayTheConvertersTimesAreViolated) {
    test::Rig rig(mutant("no-delay"));
    EXPECT_GT(play(rig).timingViolations, 1000);
    const auto& t = rig.board.io().converters.timings();
    EXPECT_LT(t.writePulse, 50.0);
}

TEST(BoardMutants, SwappedChipSelectsPlayWrongCodes) {
    test::Rig rig(mutant("swapped-chips"));
    EXPECT_GT(play(rig).differing, 1000u);
}

TEST(BoardMutants, ContractedFloatsLeaveAnotherState) {
    test::Rig rig(mutant("contracted"));
    const auto parity = play(rig);
    EXPECT_FALSE(parity.sameState);
    EXPECT_LE(parity.worstFromClosedForm, 1) << "which the codes alone hardly show";
}

TEST(BoardMutants, WithoutTheGuardDirectCurrentLeaves) {
    test::Rig rig(mutant("no-guard"));
    rig.connect();
    const auto hazard = test::boardHazards(2000, 1).front();
    rig.play(hazard.events, 2000 + 2 * 8000);
    EXPECT_GT(test::worstSlowFigures(rig.codes()).mean, 5 * limits::guardShare);
}

TEST(BoardMutants, AnotherPolynomialDoesNotAnswer) {
    test::Rig rig(mutant("polynomial"));
    EXPECT_THROW(rig.connect(), std::runtime_error);
}

} // namespace
} // namespace physvib
