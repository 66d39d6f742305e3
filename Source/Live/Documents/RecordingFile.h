// SPDX-License-Identifier: MIT
// Reference to a recorded contact, as sessions and commands store it: path of the samples, and a hash to
// detect changes.
#pragma once
#include "Core/NameNumbers.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Json/FieldTable.h"
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

struct RecordingFile {
    double frequencyHz = 0.0;    ///< of the material's mode
    std::string path{};          ///< a WAV file, or "synthetic-SEED"
    double decayPerSecond = 0.0; ///< of the material; 0: unknown
    bool isMatched = false;      ///< scaled to the energy of the material's mode; otherwise to a peak of 1
    std::string hash{}; ///< contentHash of the file when it was read; empty: not checked; always empty for
                        ///< synthetic contacts
    std::string material{}; ///< whose events play it; empty: all events of that frequency
    bool operator==(const RecordingFile&) const = default;

    SoundNumber sound() const noexcept { return material.empty() ? 0 : soundOfMaterial(material); }
};

void visitFields(auto& v, FieldsOf<RecordingFile>) {
    using R = RecordingFile;
    v.field("frequency_hz", &R::frequencyHz, kinds::positive);
    v.field("file", &R::path, kinds::text);
    v.field("hash", &R::hash, kinds::text, Need::optional);
    v.field("decay_per_s", &R::decayPerSecond, kinds::positive, Need::optional);
    v.field("matched", &R::isMatched, kinds::truth, Need::optional);
    v.field("material", &R::material, kinds::text, Need::optional.from(9));
}

/// The seed in "synthetic-7", a synthetic contact; none: `path` is a file. Any thread.
inline std::optional<std::uint32_t> syntheticSeed(std::string_view path) noexcept {
    constexpr std::string_view prefix = "synthetic-";
    std::uint32_t seed = 0;
    if (!path.starts_with(prefix)) return {};
    const auto [end, error] = std::from_chars(path.data() + prefix.size(), path.data() + path.size(), seed);
    return error == std::errc{} && end == path.data() + path.size() ? std::optional{seed} : std::nullopt;
}

} // namespace physvib
