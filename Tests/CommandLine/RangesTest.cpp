// SPDX-License-Identifier: GPL-3.0-or-later
// Options that take a number of a range: whatever is not in it is refused in one line, and so is what is no
// number at all.
#include "Calls.h"
#include <regex>
#include <sstream>

namespace physvib {
namespace {

using Ranges = test::CommandLine;

/// Long names of the options that take a number, as the command's own help has them.
std::vector<std::string> numbersOf(const std::string& help) {
    static const std::regex option{R"(^ .*(--[a-z-]+) [A-Z]+:(POSITIVE|[-0-9.e]+ to ).*)"};
    std::vector<std::string> names;
    std::istringstream lines{help};
    std::smatch found;
    for (std::string line; std::getline(lines, line);)
        if (std::regex_match(line, found, option)) names.push_back(found[1]);
    return names;
}

TEST_F(Ranges, NoOptionTakesWhatIsNoNumber) {
    std::size_t count = 0;
    for (const std::string command :
         {"play", "export drop --to x.hjif", "stimulus phantom", "stimulus pattern A-100",
          "study run patterns", "board none info", "material", "calibrate"})
        for (const auto& option : numbersOf(call(command + " --help").out)) {
            SCOPED_TRACE(command + ' ' + option);
            refuses(command + ' ' + option + " nan", 2, option + ": expected ");
            ++count;
        }
    EXPECT_GE(count, 35u);
}

} // namespace
} // namespace physvib
