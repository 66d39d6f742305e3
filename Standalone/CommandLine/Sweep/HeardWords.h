// SPDX-License-Identifier: GPL-3.0-or-later
// Captures text on standard error, to store it in a table instead of printing it.
#pragma once
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

namespace physvib {

/// Redirects std::cerr of this process during its lifetime. Message thread only, one at a time.
class HeardWords {
public:
    HeardWords()
        : before_{std::cerr.rdbuf(words_.rdbuf())} {}
    ~HeardWords() { std::cerr.rdbuf(before_); }
    HeardWords(const HeardWords&) = delete;
    HeardWords& operator=(const HeardWords&) = delete;

    /// The last line, as the reason of a failure.
    std::string reason() const {
        std::string last;
        each([&](std::string_view line) { last = line; });
        return last.empty() ? "it failed without a word" : last;
    }
    /// All warnings in one line.
    std::string warnings() const {
        constexpr std::string_view mark = "warning: ";
        std::string all;
        each([&](std::string_view line) {
            if (line.starts_with(mark)) all.append(all.empty() ? "" : "; ").append(line.substr(mark.size()));
        });
        return all;
    }

private:
    template <class Take>
    void each(Take take) const {
        constexpr std::string_view name = "physvib: ";
        std::istringstream lines{words_.str()};
        for (std::string line; std::getline(lines, line);)
            take(std::string_view{line}.substr(line.starts_with(name) ? name.size() : 0));
    }

    std::ostringstream words_;
    std::streambuf* before_;
};

} // namespace physvib
