// SPDX-License-Identifier: MIT
// Names of the sounds that events carry as numbers, as event lists write and read them.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

inline constexpr std::string_view clipNamePrefix = "clip-";   // and its number, from 1 on
inline constexpr std::string_view soundNamePrefix = "sound-"; // and the number of a material without a name

/// The number of the sound that a list calls `name`; 0 if it has none. Any thread.
inline SoundNumber soundNamed(std::string_view name) noexcept {
    if (name.empty()) return 0;
    const auto after = [name](std::string_view prefix) {
        return name.starts_with(prefix) ? parseNumber<SoundNumber>(name.substr(prefix.size())).value_or(0)
                                        : SoundNumber{0};
    };
    if (const SoundNumber clip = after(clipNamePrefix); isClip(clip)) return clip;
    if (const SoundNumber material = after(soundNamePrefix); material > mostClips) return material;
    return soundOfMaterial(name);
}

/// Before events had numbers, clip `k`, from 0 on, was the frequency (k + 1) / 1024 Hz. Gives an event of an
/// old file its number. Any thread.
inline void takeFormerClip(CollisionEvent& event) noexcept {
    const double number = event.frequencyHz * 1024.0;
    if (!(number >= 1.0 && number <= mostClips) || number != std::floor(number)) return;
    event.sound = static_cast<SoundNumber>(number);
    event.frequencyHz = clipFrequencyHz;
}

/// The names of materials by their numbers. One thread at a time.
class SoundNames {
public:
    SoundNames() = default;

    /// Those of a scene's materials.
    template <class Materials>
    explicit SoundNames(const Materials& materials) {
        addAll(materials);
    }
    template <class Materials>
    void addAll(const Materials& materials) {
        for (const auto& material : materials) add(material.name);
    }

    /// A list has no quotes: a material whose name would not be read again as it is stays without one.
    void add(std::string_view name) {
        const SoundNumber sound = soundOfMaterial(name);
        const auto next = placeOf(sound);
        if (names_.size() < mostNames && !isAt(next, sound) && soundNamed(name) == sound && isPlain(name))
            names_.insert(next, {sound, std::string{name}});
    }
    bool has(SoundNumber sound) const { return isAt(placeOf(sound), sound); }

    /// What a list writes: the material's name or else its number (sound-923368111), clip-1 and so on, or
    /// nothing for 0.
    std::string of(SoundNumber sound) const {
        if (sound == 0) return {};
        if (const auto known = placeOf(sound); isAt(known, sound)) return known->name;
        return std::string{isClip(sound) ? clipNamePrefix : soundNamePrefix} + std::to_string(sound);
    }

    bool operator==(const SoundNames&) const = default;

private:
    static bool isPlain(std::string_view name) {
        const auto breaks = [](char c) {
            return c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ';
        };
        return std::ranges::none_of(name, breaks) && name.front() != ' ' && name.back() != ' ';
    }

    struct Entry {
        SoundNumber sound;
        std::string name;
        bool operator==(const Entry&) const = default;
    };
    using Place = std::vector<Entry>::const_iterator;
    Place placeOf(SoundNumber sound) const {
        return std::ranges::lower_bound(names_, sound, {}, &Entry::sound);
    }
    bool isAt(Place place, SoundNumber sound) const { return place != names_.end() && place->sound == sound; }

    static constexpr std::size_t mostNames = 4096; // so that an untrusted list is still read quickly
    std::vector<Entry> names_;                     // sorted by number
};

} // namespace physvib
