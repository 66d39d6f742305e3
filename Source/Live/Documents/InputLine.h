// SPDX-License-Identifier: MIT
// Messages and answers as names with values, and the parser of a line of JSON: input, control or message.
#pragma once
#include "Core/RenderControl.h"
#include "Io/Result.h"
#include "Scene/Scene.h"
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace physvib {

// A message or an answer in a form independent of its transport (line, OSC, C): a name and named values.
// Source/Live/Messages defines what each message does.

using PlainValue = std::variant<double, std::string, std::vector<double>>;

struct NamedValue {
    std::string name;
    PlainValue value;
    bool operator==(const NamedValue&) const = default;
};

struct PlainMessage {
    std::string name;
    std::vector<NamedValue> values;
    bool operator==(const PlainMessage&) const = default;
};

/// As a line of JSON: `{ "answer": "latency", "play_out_s": 0.03 }`. Any thread.
std::string answerLine(const PlainMessage& answer);

/// Silences the output at once, or ends the silence.
struct SilenceControl {
    bool isOn = true;
    static constexpr std::uint64_t unnumbered = UINT64_MAX;
    std::uint64_t number = unnumbered; ///< request number within its input; for off: the last request that it
                                       ///< ends. Set by the reader of the input
};

/// A control with the panner that it sets, if it sets one.
struct OwnedControl : RenderControl {
    std::shared_ptr<const PhantomPanner> ownedPanner{};
};

using LineInput = std::variant<Action, OwnedControl, SilenceControl, PlainMessage>;

/// The input or the error of a line, and its number "id", which the answer repeats.
struct InputLine : Result<LineInput> {
    using Result<LineInput>::Result;
    std::optional<double> id{}; ///< a whole number; also of an unreadable line, if it contains one
};

/// Kinds of lines:
/// `{"input": "impulse", "body": "ball", "impulse_ns": [0, 5]}`: as in a scene's script, without a time.
/// `{"control": "gain", "channel": 1, "value": 0.5}`: as in a session file, without a time; also `{"control":
/// "silence", "on": true}`.
/// `{"message": "path", "places": [[0, 0], [1, 2]], "seconds": 1}`: values are numbers, strings, or lists of
/// numbers or of pairs.
/// The error is one line about the first fault, such as `body: ...`. Any thread.
InputLine readInputLine(std::string_view line, const std::vector<Material>& materials, int channels);

/// Whether the text contains the word "silence", in upper or lower case. Any thread.
bool containsSilenceWord(std::string_view text) noexcept;

/// Whether a line requests silence: its control, input or message is silence, unless it is a well-formed
/// `off`. An unreadable line requests silence if it contains the word. Any thread.
bool requestsSilence(std::string_view line);

/// Appended to the error of an unreadable line that silenced the output.
inline constexpr std::string_view silencedAnyway = "; silenced all the same";

/// Reads an input or a control given as a name and named values (`gain` with `channel` and `value`). Only
/// those without nested fields; a number other than 0 is true. Any thread.
Result<LineInput> readPlainInput(const PlainMessage& plain, const std::vector<Material>& materials,
                                 int channels);

/// Reads the values of a control `silence`. Any thread.
Result<SilenceControl> readPlainSilence(const std::vector<NamedValue>& values);

} // namespace physvib
