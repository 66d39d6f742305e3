// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of conditions in a report: a row per person and condition, compared within people.
#include "Calls.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Files/ProtocolFile.h"
#include "System/Process.h"
#include <algorithm>
#include <map>

namespace physvib {
namespace {

class ReportThresholds : public test::CommandLine {
protected:
    /// A built-in protocol in three conditions, with simulated participants, as a report.
    void reportOf(const std::string& name, int participants) const {
        Protocol protocol = *std::ranges::find(builtInProtocols(), name, &Protocol::name);
        protocol.name = "three-" + name;
        protocol.conditions.resize(3, protocol.conditions.front());
        for (std::size_t i = 0; i < 3; ++i)
            protocol.conditions[i].name = std::string("C").append(1, "abc"[i]);
        write("three.json", protocolJson(protocol));
        ASSERT_EQ(
            call("study run three.json --observer simulated --participants " + std::to_string(participants))
                .exitCode,
            0);
        const auto outcome = call("report three-" + name + "-P*.csv --out out");
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    void expectPairs(const std::string& method, int participants) const {
        std::map<std::string, int> people;
        for (const CsvRow& row : readCsvTable(read("out/thresholds.csv"), "t").value.rows) {
            EXPECT_EQ(row.cells[0], method);
            ++people[row.cells[1]];
        }
        ASSERT_EQ(people.size(), 3u);
        for (const auto& [condition, number] : people) EXPECT_EQ(number, participants) << condition;
        if (hasProgram("Rscript"))
            EXPECT_NE(read("out/tests.csv").find("pairs by t of threshold by " + method + " by condition"),
                      std::string::npos);
    }
};

TEST_F(ReportThresholds, AreComparedWithinPeople) {
    reportOf("level-steps", 4), expectPairs("staircase", 4);
    reportOf("level-quest", 4), expectPairs("quest", 4);
}

} // namespace
} // namespace physvib
