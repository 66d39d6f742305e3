// SPDX-License-Identifier: MIT
// Locates the level of an experimental factor in the rows of a table. Private to the .cpp files of Lab/Files.
#pragma once
#include "Io/Text/CsvTable.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace physvib::detail {

/// The source is one of: a column of that name; `condition.2`, the second hyphen-separated part of column
/// `condition`; `name=level` among the words of a condition or stimulus; or a letter in the name of one of
/// the thesis' methods (5.3), e.g. factors A, F and DR of AV-FF-DRV have levels V, F and V.
struct FactorSource {
    std::size_t column = 0;
    std::string mark{}; ///< "pair="; empty: use the whole cell of `column`
    std::optional<std::size_t> alsoIn{};
    std::size_t part = 0; ///< from 1; 0: no hyphen-separated part

    static std::optional<FactorSource> of(const CsvTable& table, const std::string& factor) {
        if (const auto column = table.column(factor)) return FactorSource{*column};
        if (factor.size() > 2 && factor[factor.size() - 2] == '.' && factor.back() >= '1' &&
            factor.back() <= '9')
            if (const auto column = table.column(std::string_view{factor}.substr(0, factor.size() - 2)))
                return FactorSource{*column, {}, {}, static_cast<std::size_t>(factor.back() - '0')};
        const auto condition = table.column("condition"), stimulus = table.column("stimulus");
        if (!condition && !stimulus) return std::nullopt;
        return FactorSource{condition.value_or(stimulus.value_or(0)), factor + "=", stimulus};
    }
    /// The level; empty if the row has none.
    std::string_view level(const CsvRow& row) const {
        if (part > 0) return partIn(row.cells[column]);
        if (mark.empty()) return row.cells[column];
        const std::string_view found = markedIn(row.cells[column]);
        return found.empty() && alsoIn ? markedIn(row.cells[*alsoIn]) : found;
    }
    std::string expected() const {
        return part > 0       ? std::to_string(part) + " parts between hyphens"
               : mark.empty() ? "a level"
                              : "a word " + printable(mark) + "...";
    }

private:
    std::string_view partIn(std::string_view rest) const {
        std::string_view found;
        for (std::size_t i = 0; i < part; ++i) found = takeUntil('-', rest);
        return found;
    }
    std::string_view markedIn(std::string_view rest) const {
        while (!rest.empty()) {
            const std::string_view word = takeUntil(' ', rest);
            if (word.starts_with(mark)) return word.substr(mark.size());
            if (const std::string_view letter = methodLetterIn(word); !letter.empty()) return letter;
        }
        return {};
    }
    std::string_view methodLetterIn(std::string_view word) const {
        const std::string_view factor = std::string_view{mark}.substr(0, mark.size() - 1);
        while (!word.empty()) {
            const std::string_view piece = takeUntil('-', word),
                                   letter = piece.substr(std::min(factor.size(), piece.size()));
            if (piece.starts_with(factor) && (letter == "V" || letter == "F")) return letter;
        }
        return {};
    }
};

} // namespace physvib::detail
