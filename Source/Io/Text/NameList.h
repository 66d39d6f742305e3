// SPDX-License-Identifier: MIT
// Formats lists of names for help texts and error messages: "linear, log or energy"; and words of a shell.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The names of a table's entries. Any thread.
template <class Row, std::size_t size>
constexpr std::array<std::string_view, size> namesOf(const std::array<Row, size>& rows) {
    std::array<std::string_view, size> names{};
    for (std::size_t i = 0; i < size; ++i) names[i] = rows[i].name;
    return names;
}

/// The first item of that name; nullptr: none. Any thread.
template <class List>
auto* findNamed(List& list, std::string_view name) noexcept {
    const auto found =
        std::find_if(list.begin(), list.end(), [name](const auto& item) { return item.name == name; });
    return found == list.end() ? nullptr : &*found;
}

/// The names with `between` in between. Any thread.
template <class Names>
std::string joined(const Names& names, std::string_view between) {
    std::string all;
    for (const auto& name : names) all.append(all.empty() ? std::string_view{} : between).append(name);
    return all;
}

/// `text` in quotes, as one word of a shell. Any thread (allocates).
inline std::string shellWord(std::string_view text) {
    std::string out(1, '\'');
    for (const char c : text) {
        if (c == '\'') out += "'\\'";
        out += c;
    }
    out += '\'';
    return out;
}

/// "linear, log, energy", or with another separator before the last: "linear, log or energy". Any thread.
template <class Names>
std::string listed(const Names& names, std::string_view last = ", ") {
    std::string all;
    for (std::size_t i = 0; i < std::size(names); ++i) {
        if (i > 0) all.append(i + 1 < std::size(names) ? ", " : last);
        all.append(std::data(names)[i]);
    }
    return all;
}

/// Abbreviates consecutively numbered names: "phone1..phone4, ring1..ring4". Any thread.
inline std::string listedByNumber(std::span<const std::string_view> names, std::string_view to = "..",
                                  std::string_view last = ", ") {
    const auto follows = [&](std::size_t i) {
        const std::string_view a = names[i], b = names[i + 1];
        return a.size() == b.size() && a.substr(0, a.size() - 1) == b.substr(0, b.size() - 1) &&
               a.back() + 1 == b.back();
    };
    std::vector<std::string> runs;
    for (std::size_t first = 0, end = 0; first < names.size(); first = ++end) {
        while (end + 1 < names.size() && follows(end)) ++end;
        runs.emplace_back(names[first]);
        if (end > first) runs.back().append(to).append(names[end]);
    }
    return listed(runs, last);
}

} // namespace physvib
