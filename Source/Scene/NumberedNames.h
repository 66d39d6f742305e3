// SPDX-License-Identifier: MIT
// Names by the numbers that events carry instead of them.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Names of sounds, or of parts of a body. One thread at a time.
class NumberedNames {
public:
    /// The name of that number; null if it has none.
    const std::string* find(int number) const {
        const auto known = placeOf(number);
        return isAt(known, number) ? &known->name : nullptr;
    }

    /// A list has no quotes: a name that would not be read again as it is stays out.
    void add(int number, std::string_view name) {
        const auto next = placeOf(number);
        if (names_.size() < mostNames && !isAt(next, number) && isPlain(name))
            names_.insert(next, {number, std::string{name}});
    }

    bool operator==(const NumberedNames&) const = default;

private:
    static bool isPlain(std::string_view name) {
        const auto breaks = [](char c) {
            return c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ';
        };
        return !name.empty() && std::ranges::none_of(name, breaks) && name.front() != ' ' &&
               name.back() != ' ';
    }

    struct Entry {
        int number;
        std::string name;
        bool operator==(const Entry&) const = default;
    };
    using Place = std::vector<Entry>::const_iterator;
    Place placeOf(int number) const { return std::ranges::lower_bound(names_, number, {}, &Entry::number); }
    bool isAt(Place place, int number) const { return place != names_.end() && place->number == number; }

    static constexpr std::size_t mostNames = 4096; // so that an untrusted list is still read quickly
    std::vector<Entry> names_;                     // sorted by number
};

} // namespace physvib
