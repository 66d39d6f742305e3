// SPDX-License-Identifier: GPL-3.0-or-later
// The two mappings of a parameter's values.
#include "Parameters.h"
#include "Core/Units.h"
#include <charconv>
#include <cmath>

namespace physvib {

namespace {

bool hasWords(const ParameterRow& row) noexcept { return !row.choices.empty(); }

double stepOf(const ParameterRow& row) noexcept {
    return (row.most - row.least) / static_cast<double>(row.choices.size() - 1);
}

std::string_view wordOf(const ParameterRow& row, double value) noexcept {
    return row.choices[static_cast<std::size_t>(
        std::lround((std::clamp(value, row.least, row.most) - row.least) / stepOf(row)))];
}

} // namespace

const std::array<ParameterRow, parameterCount>& allParameters() noexcept { return parameterTable::rows; }
std::span<const ParameterGroup> parameterGroups() noexcept { return parameterTable::groups; }
const ParameterRow& rowOf(Parameter parameter) noexcept {
    return parameterTable::rows[static_cast<std::size_t>(parameter)];
}

int parameterOfId(std::string_view id) noexcept {
    const auto& rows = parameterTable::rows;
    const auto found = std::ranges::find(rows, id, &ParameterRow::id);
    return found == rows.end() ? -1 : static_cast<int>(found - rows.begin());
}

double normalised(const ParameterRow& row, double value) noexcept {
    const double v = std::clamp(value, row.least, row.most);
    if (row.scale == ParameterScale::log) return std::log(v / row.least) / std::log(row.most / row.least);
    return (v - row.least) / (row.most - row.least);
}

double denormalised(const ParameterRow& row, double normal) noexcept {
    const double n = std::clamp(normal, 0.0, 1.0);
    if (row.scale == ParameterScale::log) return row.least * std::pow(row.most / row.least, n);
    const double value = row.least + n * (row.most - row.least);
    return hasWords(row) ? row.least + stepOf(row) * std::round((value - row.least) / stepOf(row)) : value;
}

std::string valueText(const ParameterRow& row, double value) {
    if (hasWords(row)) return std::string{wordOf(row, value)};
    if (row.unit == "dB" && value <= row.least) return "-inf dB";
    std::array<char, 32> digits{};
    const int decimals = row.unit == "x" || row.unit.empty() ? 2 : 1;
    const double shown = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value; // not "-0.0"
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), shown, std::chars_format::fixed, decimals)
            .ptr;
    const std::string number{digits.data(), end};
    return row.unit.empty() ? number : number + " " + std::string{row.unit};
}

double valueOf(const ParameterRow& row, std::string_view text) {
    const auto word = std::ranges::find(row.choices, text);
    if (hasWords(row))
        return word == row.choices.end()
                   ? row.initial
                   : row.least + stepOf(row) * static_cast<double>(word - row.choices.begin());
    while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
    if (text.starts_with("-inf")) return row.least;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && std::isfinite(value) ? std::clamp(value, row.least, row.most)
                                                        : row.initial;
}

PanningLaw lawOf(double value) noexcept {
    PanningLaw law{};
    panningLawNamed(wordOf(rowOf(Parameter::law), value), law);
    return law;
}

double gainOfLevel(double levelDb) noexcept {
    return levelDb <= parameterTable::silentDb ? 0.0 : fromDecibels(levelDb);
}

} // namespace physvib
