// SPDX-License-Identifier: MIT
// What of a stranger's file is not felt, counted while it is read, and told as one line.
#pragma once
#include "Io/Text/NumberText.h"
#include <map>
#include <string>
#include <string_view>

namespace physvib {

/// One thread at a time.
class LeftOut {
public:
    /// One more of that kind; its name may be the file's.
    void add(std::string_view what) {
        std::string name = printable(what);
        ++counts_[counts_.size() < mostKinds || counts_.contains(name) ? std::move(name) : "others"];
    }
    /// "left out: AttackTime (3), Sustained (1)"; empty: nothing.
    std::string line() const {
        std::string text;
        for (const auto& [name, count] : counts_)
            text.append(text.empty() ? "left out: " : ", ")
                .append(name)
                .append(" (")
                .append(std::to_string(count))
                .append(")");
        return text;
    }

private:
    static constexpr std::size_t mostKinds = 12; // so that it stays a line
    std::map<std::string, int> counts_;
};

} // namespace physvib
