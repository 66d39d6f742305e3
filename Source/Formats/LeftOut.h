// SPDX-License-Identifier: MIT
// Counts the contents of an imported file that are not played, and reports them as one line.
#pragma once
#include "Io/Text/NumberText.h"
#include <map>
#include <string>
#include <string_view>

namespace physvib {

/// One thread at a time.
class LeftOut {
public:
    /// Counts one more of that kind; its name may come from the file.
    void add(std::string_view what) {
        std::string name = printable(what);
        ++counts_[counts_.size() < mostKinds || counts_.contains(name) ? std::move(name) : "others"];
    }
    /// "left out: AttackTime (3), Sustained (1)"; empty: none.
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
    static constexpr std::size_t mostKinds = 12; // to keep the report short
    std::map<std::string, int> counts_;
};

} // namespace physvib
