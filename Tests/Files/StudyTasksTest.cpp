// SPDX-License-Identifier: MIT
// The pages that users read name every task of the table.
#include "Files/Disk/ReadFile.h"
#include "Study/StudyTasks.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

std::string page(const char* path) { return readFile(path, 1'000'000).value; }

TEST(StudyTasks, EachHasALineInTheTableOfProtocols) {
    const std::string studies = page(PHYSVIB_SOURCE_DIR "/Docs/studies.md");
    for (const auto& task : studyTasks) EXPECT_NE(studies.find("\n| `" + std::string{task.name} + "` | "), std::string::npos) << task.name;
}

TEST(StudyTasks, EachThatIsAnalysedIsInTheTableOfReports) {
    const std::string report = page(PHYSVIB_SOURCE_DIR "/Docs/report.md");
    const std::string table = report.substr(report.find("| trials of the task |"), report.find("Other tables") - report.find("| trials of the task |"));
    for (const auto& task : studyTasks) EXPECT_EQ(table.find("`" + std::string{task.name} + "`") != std::string::npos, !task.analysis.empty()) << task.name;
}

TEST(StudyTasks, NamesAreFoundAndOthersAreNot) {
    for (const auto& task : studyTasks) EXPECT_EQ(studyTaskNamed(task.name), &describe(task.task));
    EXPECT_EQ(studyTaskNamed("count"), nullptr);
    EXPECT_EQ(answerOf("").has_value(), false);
}

} // namespace
} // namespace physvib
