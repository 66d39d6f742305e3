// SPDX-License-Identifier: MIT
// Studies at their boundaries, against closed forms: matrices with and without empty cells, targets that were
// asked unequally often, more than two alternatives, and the exposure of another day.
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/StudyRun.h"
#include "Stimuli/SeededRandom.h"
#include "Support/FileTesting.h"
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>

namespace physvib::boundaries_test {

/// Miller's correction: degrees of freedom over 2 n ln 2, of the cells that occurred.
TEST(Boundaries, TheBiasOfInformationTransferIsMillersForEveryMatrix) {
    for (int rows = 1; rows <= 6; ++rows)
        for (int columns = 1; columns <= 6; ++columns)
            for (const int each : {1, 3}) {
                std::vector<IdentificationTrial> trials;
                for (int i = 0; i < rows; ++i)
                    for (int j = 0; j < columns; ++j)
                        for (int n = 0; n < each + (i + j) % 2; ++n)
                            trials.push_back({std::to_string(i), std::to_string(j)});
                const auto it = informationTransfer(ConfusionMatrix{trials});
                const double n = static_cast<double>(trials.size());
                EXPECT_NEAR(it.biasBits, (rows - 1) * (columns - 1) / (2.0 * n * std::numbers::ln2), 1e-12)
                    << rows << " x " << columns;
            }
    // bands of cells around the diagonal: cells - rows - columns + 1
    for (int size = 2; size <= 9; ++size) {
        std::vector<IdentificationTrial> trials;
        for (int i = 0; i < size; ++i)
            for (int j = std::max(0, i - 1); j <= std::min(size - 1, i + 1); ++j)
                trials.push_back({std::to_string(i), std::to_string(j)});
        const double freedom = std::max(0.0, static_cast<double>(trials.size()) - 2.0 * size + 1.0);
        EXPECT_NEAR(informationTransfer(ConfusionMatrix{trials}).biasBits,
                    freedom / (2.0 * static_cast<double>(trials.size()) * std::numbers::ln2), 1e-12)
            << size;
    }
}

TEST(Boundaries, ErrorsOfPointingAreMeansOverTargetsHoweverOftenEachWasAsked) {
    SeededRandom random{7};
    for (int round = 0; round < 20; ++round) {
        std::vector<PlaceTrial> trials;
        double variable = 0.0, constantX = 0.0, constantY = 0.0;
        int repeated = 0, targets = 0;
        for (int target = 0; target < 5; ++target) {
            const int count = round == 0 ? 1 : static_cast<int>(random.below(5));
            if (count == 0) continue;
            ++targets;
            std::vector<double> dx, dy;
            for (int k = 0; k < count; ++k) {
                dx.push_back(random.uniform()), dy.push_back(random.uniform());
                trials.push_back({"P", std::to_string(target), 10.0 * target, 3.0 * target,
                                  10.0 * target + dx.back(), 3.0 * target + dy.back()});
            }
            const auto meanOf = [](const std::vector<double>& v) {
                double sum = 0.0;
                for (const double x : v) sum += x;
                return sum / static_cast<double>(v.size());
            };
            constantX += meanOf(dx), constantY += meanOf(dy);
            if (count < 2) continue;
            double squares = 0.0;
            for (int k = 0; k < count; ++k) {
                const auto at = static_cast<std::size_t>(k);
                squares += std::pow(dx[at] - meanOf(dx), 2) + std::pow(dy[at] - meanOf(dy), 2);
            }
            variable += std::sqrt(squares / (count - 1));
            ++repeated;
        }
        if (targets == 0) continue;
        const ParticipantError one = participantErrors(trials).front();
        EXPECT_EQ(one.hasVariable, repeated > 0);
        EXPECT_NEAR(one.variable, repeated > 0 ? variable / repeated : 0.0, 1e-12) << round;
        EXPECT_NEAR(one.constantX, constantX / targets, 1e-12) << round;
        EXPECT_NEAR(one.constantY, constantY / targets, 1e-12) << round;
        EXPECT_EQ(one.targets, static_cast<std::size_t>(targets));
    }
}

/// Whatever their number, alternatives stand in every order about equally often.
TEST(Boundaries, AlternativesStandInEveryOrder) {
    for (const std::size_t count : {2U, 3U, 4U}) {
        Protocol p;
        p.name = "test";
        CallSet calls{{{"size", {}}}, "render drop {size} {alternative}"};
        for (int i = 0; i < 48; ++i) calls.factors[0].values.push_back(std::to_string(i));
        p.conditions = {{"A", "", "phone4", 205.0, 1.0, calls}};
        SessionPlan main{.name = "main", .task = StudyTask::choose, .repetitions = 5};
        for (std::size_t k = 0; k < count; ++k)
            main.alternatives.push_back({std::string(1, static_cast<char>('a' + k))});
        p.sessions = {main};
        ASSERT_EQ(validate(p), "");
        std::map<std::vector<std::string>, int> seen;
        Experiment experiment{p, {"P01", 1}};
        int trials = 0;
        for (; !experiment.isDone(); ++trials) {
            const std::vector<std::string> parts = experiment.trial().parts;
            EXPECT_EQ(std::set<std::string>(parts.begin(), parts.end()).size(), count);
            ++seen[parts];
            experiment.acceptAnswer({.response = parts.front()});
        }
        const std::size_t orders = count == 2 ? 2 : count == 3 ? 6 : 24;
        ASSERT_EQ(seen.size(), orders) << count << " alternatives";
        const double expected = static_cast<double>(trials) / static_cast<double>(orders);
        for (const auto& [order, times] : seen) // five standard deviations
            EXPECT_NEAR(times, expected, 5.0 * std::sqrt(expected)) << count << " alternatives";
    }
}

/// And so do the objects that are rated side by side.
TEST(Boundaries, ObjectsStandInEveryOrder) {
    Protocol p;
    p.name = "test";
    CallSet calls{{{"size", {}}}, "render drop {size} {object}"};
    for (int i = 0; i < 60; ++i) calls.factors[0].values.push_back(std::to_string(i));
    p.conditions = {{"A", "", "phone4", 205.0, 1.0, calls}};
    p.sessions = {{.name = "main", .task = StudyTask::rate, .objects = {"x", "y", "z"}, .scales = {"rough"}}};
    ASSERT_EQ(validate(p), "");
    std::map<std::vector<std::string>, int> seen;
    Experiment experiment{p, {"P01", 1}};
    while (!experiment.isDone()) {
        ++seen[experiment.trial().parts];
        const Answer answer{.scores = {50.0}};
        ASSERT_EQ(experiment.answerError(answer), "");
        experiment.acceptAnswer(answer);
    }
    EXPECT_EQ(seen.size(), 6U);
    for (const auto& [order, times] : seen) EXPECT_LT(times, 30);
}

class ExposureOfADay : public FolderTest {};

TEST_F(ExposureOfADay, IsTodaysOnlyIfItWasWrittenToday) {
    using namespace std::chrono;
    const StudyRun run{findProtocol("magnitudes").value, {"P01", 1}, folder};
    {
        StudyInProgress study{run};
        EXPECT_EQ(study.exposureToday(), 0.0);
        const SimulatedObserver observer{*observerNamed("simulated"), run.protocol, run.participant};
        for (const double exposure : {0.75, 1.5}) {
            Answer answer = observer.answer(study.experiment());
            answer.exposure = exposure;
            ASSERT_TRUE(study.acceptAnswer(answer)) << study.error();
        }
    }
    const auto writtenAt = std::filesystem::last_write_time(run.trialFile());
    for (const int days : {0, -1, 1, -2, -7, -365, -366, -730, -731}) {
        std::filesystem::last_write_time(run.trialFile(), writtenAt + hours{24 * days});
        const StudyInProgress again{run};
        ASSERT_EQ(again.error(), "");
        EXPECT_EQ(again.exposureToday(), days == 0 ? 1.5 : 0.0) << days << " days from today";
    }
}

} // namespace physvib::boundaries_test
