// SPDX-License-Identifier: MIT
// Finds table entries by name, and joins names to text: with a separator, as a list of a message ("linear,
// log or energy"), with numbered names as ranges; and quotes a word for a shell.
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
constexpr std::array<std::string_view, size> entryNames(const std::array<Row, size>& rows) {
    std::array<std::string_view, size> names{};
    for (std::size_t i = 0; i < size; ++i) names[i] = rows[i].name;
    return names;
}

/// The first item whose member `name` equals `name`; nullptr: none. Any thread.
template <class List>
auto* findNamed(List& list, std::string_view name) noexcept {
    const auto found =
        std::find_if(list.begin(), list.end(), [name](const auto& item) { return item.name == name; });
    return found == list.end() ? nullptr : &*found;
}

/// The names with `separator` in between. Any thread.
template <class Names>
std::string joinNames(const Names& names, std::string_view separator) {
    std::string all;
    for (const auto& name : names) all.append(all.empty() ? std::string_view{} : separator).append(name);
    return all;
}

/// `text` as one word of a shell: in apostrophes, which themselves become '\''. Any thread (allocates).
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
std::string nameList(const Names& names, std::string_view lastSeparator = ", ") {
    std::string all;
    for (std::size_t i = 0; i < std::size(names); ++i) {
        if (i > 0) all.append(i + 1 < std::size(names) ? ", " : lastSeparator);
        all.append(std::data(names)[i]);
    }
    return all;
}

/// A list in which names with consecutive last digits are ranges: "phone1..phone4, ring1". Any thread.
inline std::string rangeList(std::span<const std::string_view> names, std::string_view rangeMark = "..",
                             std::string_view lastSeparator = ", ") {
    const auto isConsecutive = [&](std::size_t i) {
        const std::string_view a = names[i], b = names[i + 1];
        return a.size() == b.size() && a.substr(0, a.size() - 1) == b.substr(0, b.size() - 1) &&
               a.back() + 1 == b.back();
    };
    std::vector<std::string> ranges;
    for (std::size_t first = 0, end = 0; first < names.size(); first = ++end) {
        while (end + 1 < names.size() && isConsecutive(end)) ++end;
        ranges.emplace_back(names[first]);
        if (end > first) ranges.back().append(rangeMark).append(names[end]);
    }
    return nameList(ranges, lastSeparator);
}

} // namespace physvib
