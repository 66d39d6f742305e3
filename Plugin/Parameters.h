// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the plug-in's parameters: ids, names, units, ranges, defaults, scales and choices; and
// conversions of their values. Plug-in, window, saved state and Docs/plugin-reference.md use it.
#pragma once
#include "Core/PanningLaws.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// In the order in which hosts list them. New ones go to the end, before `count`: hosts may number them.
enum class Parameter {
    level,
    law,
    exponent,
    gravity,
    tilt,
    material,
    strikeLevel,
    strikeX,
    strikeY,
    bypass,
    beats,
    music,
    musicSides,
    timing,
    decay,
    release,
    velocityCurve,
    hold,
    placement,
    bendRange,
    noteMaterial,
    count
};
constexpr auto parameterCount = static_cast<std::size_t>(Parameter::count);

/// How a host's value, 0 to 1, maps to the range.
enum class ParameterScale {
    linear,
    log,    ///< equal steps are equal ratios; the range is above 0
    choice, ///< one of `choices`, in equal steps; each keeps its value from 0 to 1 (decision 34)
    toggle  ///< 0 or 1
};

struct ParameterRow {
    Parameter parameter; ///< its number, which is its place in the table
    std::string_view id; ///< never changes, because the sessions of hosts contain it
    std::string_view name;
    std::string_view shortName; ///< 8 letters at most, for small displays; the first four differ from others'
    std::string_view unit;
    double minimum = 0.0;
    double maximum = 1.0;
    double initial = 0.0;
    ParameterScale scale = ParameterScale::linear;
    std::span<const std::string_view> choices{};
    int version = 1; ///< of the plug-in that first had it; AU sorts by it
    std::string_view help{};
};

/// Parameters that belong together, in the order of the table. Each is in one group, but for `level` and
/// `bypass`, which are in none.
struct ParameterGroup {
    std::string_view id; ///< never changes
    std::string_view name;
    std::span<const Parameter> parameters;
};

namespace parameterTable {

/// Spreads choices over 0 to 1: the `first` ones in equal steps, as in the first version; later ones half-way
/// between them, then at the quarters, so that no saved value changes (decision 34). An entry without a
/// choice of its own repeats the one before.
template <std::size_t first, std::size_t count>
constexpr auto spacedChoices(const std::array<std::string_view, count>& names) {
    constexpr std::size_t halves = 2 * first - 1, quarters = 2 * halves - 1; // numbers of places
    static_assert(count <= quarters, "others need a parameter of their own");
    constexpr std::size_t step = count == first ? 1 : count <= halves ? 2 : 4;
    std::array<std::string_view, step*(first - 1) + 1> places{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t rest = i % step, own = rest == 0          ? i / step
                                                 : 2 * rest == step ? first + i / step
                                                                    : halves + i / 2;
        places[i] = own < count ? names[own] : places[i - 1];
    }
    return places;
}

inline constexpr auto lawNames = spacedChoices<4>(panningLawNames);
inline constexpr std::array<std::string_view, 9> materialNames{
    "as the scene", "1", "2", "3", "4", "5", "6", "7", "8"};
inline constexpr std::array<std::string_view, 2> switchNames{"off", "on"};
inline constexpr std::array<std::string_view, 2> sideNames{"summed", "left and right"};
inline constexpr std::array<std::string_view, 2> timingNames{"safe", "tight"}; // indexed by StepTiming
// The first choice of each list below keeps the preset's value.
inline constexpr std::array<std::string_view, 3> holdNames{"as the preset", "off", "on"};
inline constexpr std::array<std::string_view, 4> placementNames{"as the preset", "octave", "actuators",
                                                                "middle"};
inline constexpr std::array<std::string_view, 9> bendNames{
    "as the preset", "moves the place", "1 semitone",   "2 semitones", "5 semitones",
    "7 semitones",   "12 semitones",    "24 semitones", "48 semitones"};
inline constexpr std::array bendSemitones{0.0, 0.0, 1.0, 2.0, 5.0, 7.0, 12.0, 24.0, 48.0};
static_assert(bendSemitones.size() == bendNames.size());
inline constexpr std::array<std::string_view, 9> noteMaterialNames{
    "as the preset", "1", "2", "3", "4", "5", "6", "7", "8"};
inline constexpr std::span<const std::string_view> noChoices{};
inline constexpr double silentDb = -60.0; // imperceptible, as full scale is a few g

using enum ParameterScale;
inline constexpr std::array<ParameterRow, parameterCount> rows{{
    {Parameter::level, "level", "Level", "Level", "dB", silentDb, 0.0, -12.0, linear, noChoices, 1,
     "Master level; the least is silence"},
    {Parameter::law, "law", "Panning law", "Law", "", 0, 3, 0, choice, lawNames, 1,
     "How an impact is spread over the actuators"},
    {Parameter::exponent, "exponent", "Panning exponent", "Exponent", "", 0.25, 4.0, 1.0, log, noChoices, 1,
     "Exponent of the panning law"},
    {Parameter::gravity, "gravity", "Gravity", "Gravity", "x", 0.0, 4.0, 1.0, linear, noChoices, 1,
     "Gravity, times the scene's"},
    {Parameter::tilt, "tilt", "Tilt", "Tilt", "deg", -180.0, 180.0, 0.0, linear, noChoices, 1,
     "How the device is held: gravity turns counter-clockwise"},
    {Parameter::material, "material", "Material", "Material", "", 0, 8, 0, choice, materialNames, 1,
     "Material of what is felt: the scene's own, or the n-th of its list"},
    {Parameter::strikeLevel, "strike_level", "Strike level", "Hit lev", "dB", silentDb, 12.0, 6.0, linear,
     noChoices, 1, "Amplitude of a MIDI strike at full velocity; the least is silence"},
    {Parameter::strikeX, "strike_x", "Strike shift x", "X shift", "%", -100.0, 100.0, 0.0, linear, noChoices,
     1, "Shifts MIDI strikes to the right, in parts of the field's width"},
    {Parameter::strikeY, "strike_y", "Strike shift y", "Y shift", "%", -100.0, 100.0, 0.0, linear, noChoices,
     1, "Shifts MIDI strikes upwards, in parts of the field's height"},
    {Parameter::bypass, "bypass", "Bypass", "Bypass", "", 0, 1, 0, toggle, switchNames, 1,
     "Silence; the world goes on"},
    {Parameter::beats, "beats", "Beats", "Beats", "%", 0.0, 100.0, 0.0, linear, noChoices, 2,
     "How readily beats of the side chain strike; the least is never"},
    {Parameter::music, "music", "Music", "Music", "dB", silentDb, 12.0, silentDb, linear, noChoices, 3,
     "Level of the side chain's own low frequencies (20 to 400 Hz) on the actuators; the least is silence"},
    {Parameter::musicSides, "music_sides", "Music channels", "Sides", "", 0, 1, 0, choice, sideNames, 3,
     "Where the side chain is played: summed, on all actuators, or its left on the left ones and its right "
     "on the right ones"},
    {Parameter::timing, "timing", "Timing", "Timing", "", 0, 1, 0, choice, timingNames, 4,
     "Output latency of a world. Safe: stepped by a thread of its own. Tight: stepped in the render call, "
     "which needs a computer with time to spare; the output is silent for a moment when this changes"},
    // Factors from 1/2^n to 2^n: the middle of their scale is exactly 1, which changes no sample.
    {Parameter::decay, "decay", "Decay", "Decay", "x", 0.125, 8.0, 1.0, log, noChoices, 5,
     "How long strikes by notes ring, times the preset's"},
    {Parameter::release, "release", "Release", "Release", "x", 0.0625, 16.0, 1.0, log, noChoices, 5,
     "How long a held note takes to fall after its key, times the preset's"},
    {Parameter::velocityCurve, "velocity_curve", "Velocity curve", "Velocity", "x", 0.25, 4.0, 1.0, log,
     noChoices, 5, "Exponent of a note's velocity, times the preset's: above 1, soft keys are softer"},
    {Parameter::hold, "hold", "Hold", "Hold", "", 0, 2, 0, choice, holdNames, 5,
     "Whether a note without a rule sounds until its key is released"},
    {Parameter::placement, "placement", "Placement", "Place", "", 0, 3, 0, choice, placementNames, 5,
     "Where a note without a rule is felt: from left (C) to right (B), on one actuator after the other, "
     "or in the middle"},
    {Parameter::bendRange, "bend_range", "Bend range", "Bend", "", 0, 8, 0, choice, bendNames, 5,
     "How far a full pitch bend moves the pitch; or it moves the place"},
    {Parameter::noteMaterial, "note_material", "Note material", "Note mat", "", 0, 8, 0, choice,
     noteMaterialNames, 5,
     "What a note without a rule sounds like: the preset's pitch, or the n-th material of the list, at its "
     "frequency"},
}};
static_assert(std::ranges::all_of(rows, [](const ParameterRow& row) {
    return &row == &rows[static_cast<std::size_t>(row.parameter)];
}));

inline constexpr std::array panningGroup{Parameter::law, Parameter::exponent};
inline constexpr std::array worldGroup{Parameter::gravity, Parameter::tilt, Parameter::material};
inline constexpr std::array strikeGroup{Parameter::strikeLevel, Parameter::strikeX, Parameter::strikeY};
inline constexpr std::array beatGroup{Parameter::beats, Parameter::music, Parameter::musicSides};
inline constexpr std::array timeGroup{Parameter::timing};
inline constexpr std::array instrumentGroup{
    Parameter::decay,     Parameter::release,   Parameter::velocityCurve, Parameter::hold,
    Parameter::placement, Parameter::bendRange, Parameter::noteMaterial};
inline constexpr std::array<ParameterGroup, 6> groups{{{"panning", "Panning", panningGroup},
                                                       {"world", "World", worldGroup},
                                                       {"strikes", "Strikes by notes", strikeGroup},
                                                       {"side_chain", "Side chain", beatGroup},
                                                       {"time", "Time", timeGroup},
                                                       {"instrument", "Instrument", instrumentGroup}}};

} // namespace parameterTable

/// Any thread.
const ParameterRow& rowOf(Parameter parameter) noexcept;
const std::array<ParameterRow, parameterCount>& allParameters() noexcept;

std::span<const ParameterGroup> parameterGroups() noexcept; ///< any thread

/// Index of the parameter with that id in the table; -1 if there is none. Any thread.
int findParameter(std::string_view id) noexcept;

/// Convert a value in the parameter's unit to a host's value, 0 to 1, and back; both clamp. Any thread.
double normalised(const ParameterRow& row, double value) noexcept;
double denormalised(const ParameterRow& row, double normal) noexcept;

/// Convert a value to text ("-12.0 dB", "on") and back; unreadable text gives the default. Any thread.
std::string valueText(const ParameterRow& row, double value);
double valueFromText(const ParameterRow& row, std::string_view text);

/// The panning law of a value of Parameter::law. Any thread.
PanningLaw lawFromValue(double value) noexcept;

/// The gain of a level in dB; the minimum of the range is silence. Any thread.
double gainFromLevelDb(double levelDb) noexcept;

} // namespace physvib
