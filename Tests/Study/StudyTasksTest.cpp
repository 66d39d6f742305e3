// SPDX-License-Identifier: MIT
// The page that users read names every task of the table.
#include "Lab/Study/StudyTasks.h"
#include "Io/Disk/ReadFile.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(StudyTasks, EachHasALineInTheTableOfProtocols) {
    const auto studies = readFile(PHYSVIB_SOURCE_DIR "/Docs/protocols.md", 1'000'000);
    ASSERT_TRUE(studies) << studies.error;
    for (const auto& task : studyTasks)
        EXPECT_NE(studies.value.find("\n| `" + std::string{task.name} + "` | "), std::string::npos)
            << task.name;
}

TEST(StudyTasks, NamesAreFoundAndOthersAreNot) {
    for (const auto& task : studyTasks) EXPECT_EQ(studyTaskNamed(task.name), &describe(task.task));
    EXPECT_EQ(studyTaskNamed("count"), nullptr);
    EXPECT_EQ(answerOf("").has_value(), false);
}

} // namespace
} // namespace physvib
