// SPDX-License-Identifier: GPL-3.0-or-later
// The parameter table, and its two mappings between 0 to 1 and the parameter's range.
#include "Parameters.h"
#include "Core/Decibels.h"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace physvib {

namespace {

/// The first choices stand where they have always stood, the others between them (decision 34); where nobody
/// is yet stands the one before.
template <std::size_t first, std::size_t count>
constexpr auto atTheirPlaces(const std::array<std::string_view, count>& names) {
    static_assert(count < 2 * first, "others need a parameter of their own");
    constexpr std::size_t step = count == first ? 1 : 2;
    std::array<std::string_view, step*(first - 1) + 1> places{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool isBetween = i % step != 0 && first + i / 2 < count;
        places[i] = isBetween ? names[first + i / 2] : names[i / step];
    }
    return places;
}

constexpr auto lawNames = atTheirPlaces<4>(panningLawNames);
constexpr std::array<std::string_view, 9> materialNames{
    "as the scene", "1", "2", "3", "4", "5", "6", "7", "8"};
constexpr std::array<std::string_view, 2> switchNames{"off", "on"};
constexpr std::array<std::string_view, 2> sideNames{"summed", "left and right"};
constexpr std::span<const std::string_view> noWords{};
constexpr double silentDb = -60.0; // below it nobody feels anything: full scale is some g

using enum ParameterScale;
constexpr std::array<ParameterRow, parameterCount> table{{
    {Parameter::level, "level", "Level", "Level", "dB", silentDb, 0.0, -12.0, linear, noWords, 1,
     "Master level; the least is silence"},
    {Parameter::law, "law", "Panning law", "Law", "", 0, 3, 0, choice, lawNames, 1,
     "How an impact is spread over the actuators"},
    {Parameter::exponent, "exponent", "Panning exponent", "Exponent", "", 0.25, 4.0, 1.0, log, noWords, 1,
     "Exponent of the panning law"},
    {Parameter::gravity, "gravity", "Gravity", "Gravity", "x", 0.0, 4.0, 1.0, linear, noWords, 1,
     "Gravity, times the scene's"},
    {Parameter::tilt, "tilt", "Tilt", "Tilt", "deg", -180.0, 180.0, 0.0, linear, noWords, 1,
     "How the device is held: gravity turns counter-clockwise"},
    {Parameter::material, "material", "Material", "Material", "", 0, 8, 0, choice, materialNames, 1,
     "Material of what is felt: the scene's own, or the n-th of its list"},
    {Parameter::strikeLevel, "strike_level", "Strike level", "Hit lev", "dB", silentDb, 12.0, 6.0, linear,
     noWords, 1, "Amplitude of a MIDI strike at full velocity; the least is silence"},
    {Parameter::strikeX, "strike_x", "Strike shift x", "X shift", "%", -100.0, 100.0, 0.0, linear, noWords, 1,
     "Shifts MIDI strikes to the right, in parts of the field's width"},
    {Parameter::strikeY, "strike_y", "Strike shift y", "Y shift", "%", -100.0, 100.0, 0.0, linear, noWords, 1,
     "Shifts MIDI strikes upwards, in parts of the field's height"},
    {Parameter::bypass, "bypass", "Bypass", "Bypass", "", 0, 1, 0, toggle, switchNames, 1,
     "Silence; the world goes on"},
    {Parameter::beats, "beats", "Beats", "Beats", "%", 0.0, 100.0, 0.0, linear, noWords, 2,
     "How readily beats of the side chain strike; the least is never"},
    {Parameter::music, "music", "Music", "Music", "dB", silentDb, 12.0, silentDb, linear, noWords, 3,
     "Level of the side chain's own low frequencies (20 to 400 Hz) on the actuators; the least is silence"},
    {Parameter::musicSides, "music_sides", "Music channels", "Sides", "", 0, 1, 0, choice, sideNames, 3,
     "Where the side chain is played: summed, on all actuators, or its left on the left ones and its right "
     "on the right ones"},
}};
static_assert(std::ranges::all_of(table, [](const ParameterRow& row) {
    return &row == &table[static_cast<std::size_t>(row.parameter)];
}));

constexpr std::array panningGroup{Parameter::law, Parameter::exponent};
constexpr std::array worldGroup{Parameter::gravity, Parameter::tilt, Parameter::material};
constexpr std::array strikeGroup{Parameter::strikeLevel, Parameter::strikeX, Parameter::strikeY};
constexpr std::array beatGroup{Parameter::beats, Parameter::music, Parameter::musicSides};
constexpr std::array<ParameterGroup, 4> groups{{{"panning", "Panning", panningGroup},
                                                {"world", "World", worldGroup},
                                                {"strikes", "Strikes by notes", strikeGroup},
                                                {"side_chain", "Side chain", beatGroup}}};

bool hasWords(const ParameterRow& row) noexcept { return !row.choices.empty(); }

double stepOf(const ParameterRow& row) noexcept {
    return (row.most - row.least) / static_cast<double>(row.choices.size() - 1);
}

std::string_view wordOf(const ParameterRow& row, double value) noexcept {
    return row.choices[static_cast<std::size_t>(
        std::lround((std::clamp(value, row.least, row.most) - row.least) / stepOf(row)))];
}

} // namespace

const std::array<ParameterRow, parameterCount>& allParameters() noexcept { return table; }
std::span<const ParameterGroup> parameterGroups() noexcept { return groups; }
const ParameterRow& rowOf(Parameter parameter) noexcept { return table[static_cast<std::size_t>(parameter)]; }

int parameterOfId(std::string_view id) noexcept {
    const auto found = std::ranges::find(table, id, &ParameterRow::id);
    return found == table.end() ? -1 : static_cast<int>(found - table.begin());
}

double normalised(const ParameterRow& row, double value) noexcept {
    const double v = std::clamp(value, row.least, row.most);
    if (row.scale == log) return std::log(v / row.least) / std::log(row.most / row.least);
    return (v - row.least) / (row.most - row.least);
}

double denormalised(const ParameterRow& row, double normal) noexcept {
    const double n = std::clamp(normal, 0.0, 1.0);
    if (row.scale == log) return row.least * std::pow(row.most / row.least, n);
    const double value = row.least + n * (row.most - row.least);
    return hasWords(row) ? row.least + stepOf(row) * std::round((value - row.least) / stepOf(row)) : value;
}

std::string valueText(const ParameterRow& row, double value) {
    if (hasWords(row)) return std::string{wordOf(row, value)};
    if (row.unit == "dB" && value <= row.least) return "-inf dB";
    std::array<char, 32> digits{};
    const int decimals = row.unit == "x" || row.unit.empty() ? 2 : 1;
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals)
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

double gainOfLevel(double levelDb) noexcept { return levelDb <= silentDb ? 0.0 : fromDecibels(levelDb); }

} // namespace physvib
