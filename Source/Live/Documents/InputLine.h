// SPDX-License-Identifier: MIT
// One line of JSON that does something to a session: an input, a control, or a message.
#pragma once
#include "Core/RenderControl.h"
#include "Io/Result.h"
#include "Live/Documents/PlainMessage.h"
#include "Scene/Scene.h"
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace physvib {

/// Everything heard goes, or may be heard again, at once.
struct SilenceControl {
    bool isOn = true;
    static constexpr std::uint64_t unnumbered = UINT64_MAX;
    std::uint64_t number = unnumbered; ///< which of its input's requests it is; off: the last one that it
                                       ///< lifts. Set by who reads the input
};

using LineInput = std::variant<Action, RenderControl, SilenceControl, PlainMessage>;

/// A line and, if it has one, the number by which its answer is known: "id".
struct InputLine : Result<LineInput> {
    using Result<LineInput>::Result;
    std::optional<double> id{}; ///< whole; also of a line that cannot be read, if the number stands in it
};

/// `{"input": "impulse", "body": "ball", "impulse_ns": [0, 5]}`: as in a scene's script, without a time.
/// `{"control": "gain", "channel": 1, "value": 0.5}`: as in a session file, without a time; `{"control":
/// "silence", "on": true}` as well. `{"message": "path", "places": [[0, 0], [1, 2]], "seconds": 1}`: a
/// message with values that are numbers, words, or lists of numbers or of pairs of them. Or, of the first
/// thing that is wrong, one line `body: ...`. Any thread.
InputLine readInputLine(std::string_view line, const std::vector<Material>& materials, int channels);

/// Whether the word stands in it, in letters of any case. Any thread.
bool namesSilence(std::string_view text) noexcept;

/// Whether a line silences: its control, input or message is silence, and it is not off in its right form. A
/// line that cannot be read silences if the word stands in it. Any thread.
bool asksForSilence(std::string_view line);

/// What is told of an error that silences.
inline constexpr std::string_view silencedAllTheSame = "; silenced all the same";

/// The same of an input or a control that comes as a name and named values (`gain`, with `channel` and
/// `value`): those without nested fields; a number other than 0 is true. Any thread.
Result<LineInput> readPlainInput(const PlainMessage& plain, const std::vector<Material>& materials,
                                 int channels);

} // namespace physvib
