// SPDX-License-Identifier: MIT
// JSON form of render controls and panners, for session files and input lines. Included by .cpp files of
// documents only.
#pragma once
#include "Io/Json/FieldTable.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonLines.h"
#include "Io/Text/NameList.h"
#include "Live/Documents/InputLine.h"
#include "Live/Documents/Mix.h"
#include <array>
#include <string_view>

namespace physvib {

/// A control as files and lines have it: its name, and the field and range of its value.
struct ControlDescription {
    enum class Holds { panner, number, truth, nothing }; ///< number and truth belong to a channel
    std::string_view name;
    RenderControl::Kind kind;
    Holds holds;
    std::string_view field{};
    double least = 0.0, most = 0.0;
};

inline constexpr auto controlTable = std::to_array<ControlDescription>({
    {"layout", RenderControl::Kind::panner, ControlDescription::Holds::panner, "panning"},
    {"gain", RenderControl::Kind::gain, ControlDescription::Holds::number, "value", -1000.0, 1000.0},
    {"mute", RenderControl::Kind::mute, ControlDescription::Holds::truth, "on"},
    {"stop", RenderControl::Kind::stopAll, ControlDescription::Holds::nothing},
    {"delay", RenderControl::Kind::delay, ControlDescription::Holds::number, "seconds", 0.0,
     limits::maxChannelDelaySeconds},
    {"ceiling", RenderControl::Kind::ceiling, ControlDescription::Holds::number, "value", 1e-6, 1.0},
});
inline constexpr auto controlNames = namesOf(controlTable);

/// Throws JsonError.
PhantomPanner readKind(const JsonField& json, const DescribedPanner<LayoutDescription>& kind);
OrderedJson writeKind(const DescribedPanner<const LayoutDescription>& kind, const PhantomPanner& panner);

/// Reads a control without its time; `otherField` may be present too. Throws JsonError.
OwnedControl readControl(const JsonField& json, int channels, std::string_view otherField = {});

OrderedJson controlJson(const RenderControl& control); ///< without its time

} // namespace physvib
