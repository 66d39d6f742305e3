// SPDX-License-Identifier: GPL-3.0-or-later
// No writer says "saved" where the disk failed: each call that writes a file is made again for every write,
// flush and rename that it does, with that one failing.
#include "Calls.h"
#include <algorithm>
#include <map>
#include <string_view>

namespace physvib::test {
namespace {

class FailingDisk : public CommandLine {
protected:
    /// Of `physvib`, or, where the words begin with "physvib-render ", of the small program.
    Outcome call(const std::string& arguments, const std::string& before = {}) const {
        constexpr std::string_view small = "physvib-render ";
        return arguments.starts_with(small)
                   ? CommandLine::call(arguments.substr(small.size()), before, PHYSVIB_RENDER_PROGRAM)
                   : CommandLine::call(arguments, before);
    }

    /// The call with its nth `system` call failing; false in `hasFailed` if it has not so many.
    Outcome callWith(const std::string& arguments, const std::string& system, int nth,
                     bool& hasFailed) const {
        std::filesystem::remove(mark());
        const Outcome outcome =
            call(arguments, "export LD_PRELOAD='" PHYSVIB_FAILING_DISK "' PHYSVIB_FAILS='" + system + " " +
                                std::to_string(nth) + "' PHYSVIB_FAILED='" + mark() + "'; ");
        hasFailed = std::filesystem::exists(mark());
        return outcome;
    }
    std::string mark() const { return folder_.string() + ".failed"; }
    void TearDown() override {
        std::filesystem::remove(mark());
        CommandLine::TearDown();
    }
    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> all;
        for (const std::string& name : files())
            if (!std::filesystem::is_directory(folder_ / name)) all[name] = read(name);
        return all;
    }
    void empty() const {
        for (const std::string& name : files()) std::filesystem::remove_all(folder_ / name);
    }

    /// Of each system call that fails: exit code 1 and one line; the files of before are there, whole or as
    /// they were, and nothing else is. `appends`: a log, which keeps what it has.
    void failsAtEach(const std::string& arguments, const std::map<std::string, std::string>& before = {},
                     bool appends = false) {
        const auto prepare = [&] {
            empty();
            for (const auto& [name, text] : before) write(name, text);
        };
        prepare();
        ASSERT_EQ(call(arguments).exitCode, 0) << arguments << "\n" << read(".err");
        const auto whole = contents();
        ASSERT_NE(whole, before) << arguments;
        int tried = 0;
        for (const std::string system : {"write", "fsync", "rename"})
            for (int nth = 1; nth <= 12; ++nth) {
                prepare();
                bool hasFailed = false;
                const Outcome outcome = callWith(arguments, system, nth, hasFailed);
                if (!hasFailed) break;
                ++tried;
                const std::string what = arguments + "\nwith " + system + " " + std::to_string(nth) +
                                         " failing; said: " + outcome.err;
                EXPECT_EQ(outcome.exitCode, 1) << what;
                EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << what;
                for (const auto& [name, text] : contents()) {
                    EXPECT_TRUE(whole.contains(name)) << name << ": left behind\n" << what;
                    const bool isOld = before.contains(name) && before.at(name) == text;
                    if (!appends)
                        EXPECT_TRUE(isOld || text == whole.at(name)) << name << ": neither old nor whole\n"
                                                                     << what;
                }
            }
        EXPECT_GE(tried, 2) << arguments;
        empty();
    }
};

TEST_F(FailingDisk, IsToldByEveryFileOfARender) {
    failsAtEach("render shake-the-box --seconds 0.3 --out a.wav");
    failsAtEach("render shake-the-box --seconds 0.3 --out a.wav --events a.csv --picture a.png --pattern "
                "p.csv --marker m.wav");
    failsAtEach("render shake-the-box --seconds 0.3 --out a.wav --events a.csv",
                {{"a.wav", "old"}, {"a.csv", "older"}});
    failsAtEach("render shake-the-box --seconds 0.3 --pad pad-generic --out motors.csv");
}

TEST_F(FailingDisk, IsToldByTheSmallProgram) {
    failsAtEach("physvib-render shake-the-box --seconds 0.3 --out a.wav");
    failsAtEach("physvib-render shake-the-box --seconds 0.3 --out a.wav --events a.csv");
    failsAtEach("physvib-render shake-the-box --seconds 0.3 --events a.csv");
}

TEST_F(FailingDisk, IsToldByHapticFilesAndStimuli) {
    for (const std::string ending : {"hjif", "haptic", "ahap"})
        failsAtEach("export shake-the-box --seconds 0.3 --layout phone1 --to a." + ending);
    failsAtEach("stimulus phantom --at 0.5,0.5 --out a.wav");
}

TEST_F(FailingDisk, IsToldByAStudysFiles) {
    failsAtEach("study plan level-steps --participants 2 --out plan.txt");
    failsAtEach("study run level-steps --participant P01 --observer simulated", {}, true);
}

} // namespace
} // namespace physvib::test
