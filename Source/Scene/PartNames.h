// SPDX-License-Identifier: MIT
// Names of sounds and of parts of the user's body: text in files, numbers (hashes of the names) in events.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Names of sounds, or of parts of a body, by their numbers. One thread at a time.
class NumberedNames {
public:
    /// The name of that number; null if it has none.
    const std::string* find(int number) const {
        const auto known = placeOf(number);
        return isAt(known, number) ? &known->name : nullptr;
    }

    /// Ignores names that an event list cannot store, because its cells have no quotes.
    void add(int number, std::string_view name) {
        const auto next = placeOf(number);
        if (names_.size() < maxNames && !isAt(next, number) && isPlain(name))
            names_.insert(next, {number, std::string{name}});
    }

    bool operator==(const NumberedNames&) const = default;

private:
    static bool isPlain(std::string_view name) {
        const auto isForbidden = [](char c) {
            return c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ';
        };
        return !name.empty() && std::ranges::none_of(name, isForbidden) && name.front() != ' ' &&
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

    static constexpr std::size_t maxNames = 4096; // so that an untrusted list is still read quickly
    std::vector<Entry> names_;                    // sorted by number
};

inline constexpr std::string_view partNamePrefix = "part-"; // before the number of a part without a name

/// The number of the part that a file calls `name`; 0 if it has none. Any thread.
inline PartNumber toPartNumber(std::string_view name) noexcept {
    if (name.starts_with(partNamePrefix))
        if (const auto number = parseNumber<PartNumber>(name.substr(partNamePrefix.size())).value_or(0);
            number > 0)
            return number;
    return partNamed(name);
}

/// The names of parts by their numbers. One thread at a time.
class PartNames {
public:
    /// Ignores a name that would be read as another part.
    void add(std::string_view name) {
        if (const PartNumber part = toPartNumber(name); part == partNamed(name)) names_.add(part, name);
    }

    /// The part's text in files: a name that was added, a built-in name (chest), or else its number
    /// (part-923368111); empty for 0.
    std::string nameOf(PartNumber part) const {
        if (part == 0) return {};
        if (const std::string* const known = names_.find(part)) return *known;
        for (const std::string_view name : bodyParts)
            if (partNamed(name) == part) return std::string{name};
        return std::string{partNamePrefix} + std::to_string(part);
    }

    bool operator==(const PartNames&) const = default;

private:
    NumberedNames names_;
};

inline constexpr std::string_view clipNamePrefix = "clip-";   // before its number, from 1 on
inline constexpr std::string_view soundNamePrefix = "sound-"; // before the number of a material without a
                                                              // name

/// The number of the sound that a list calls `name`; 0 if it has none. Any thread.
inline SoundNumber toSoundNumber(std::string_view name) noexcept {
    if (name.empty()) return 0;
    const auto numberAfter = [name](std::string_view prefix) {
        return name.starts_with(prefix) ? parseNumber<SoundNumber>(name.substr(prefix.size())).value_or(0)
                                        : SoundNumber{0};
    };
    if (const SoundNumber clip = numberAfter(clipNamePrefix); isClip(clip)) return clip;
    if (const SoundNumber material = numberAfter(soundNamePrefix); material > maxClips) return material;
    return soundOfMaterial(name);
}

/// Converts a clip of an old file, which had no material column: there clip `k`, from 0 on, was the frequency
/// (k + 1) / 1024 Hz. Other events stay. Any thread.
inline void convertLegacyClip(CollisionEvent& event) noexcept {
    const double number = event.frequencyHz * 1024.0;
    if (!(number >= 1.0 && number <= maxClips) || number != std::floor(number)) return;
    event.sound = static_cast<SoundNumber>(number);
    event.frequencyHz = clipFrequencyHz;
}

/// The names of materials by the numbers of their sounds, and those of parts. One thread at a time.
class SoundNames {
public:
    SoundNames() = default;

    /// Begins with the names of a scene's materials.
    template <class Materials>
    explicit SoundNames(const Materials& materials) {
        addAll(materials);
    }
    template <class Materials>
    void addAll(const Materials& materials) {
        for (const auto& material : materials) add(material.name);
    }

    /// Adds the names of a scene's materials, and of the body parts that its fixtures are bound to.
    template <class Scene>
    void addScene(const Scene& scene) {
        addAll(scene.materials);
        for (const auto& body : scene.bodies)
            for (const auto& fixture : body.fixtures)
                if (!fixture.part.empty()) parts.add(fixture.part);
    }

    /// Ignores the name of a material that would be read as another sound.
    void add(std::string_view name) {
        if (const SoundNumber sound = soundOfMaterial(name); toSoundNumber(name) == sound)
            names_.add(sound, name);
    }
    bool has(SoundNumber sound) const { return names_.find(sound) != nullptr; }

    /// The sound's text in lists: the material's name or number (sound-923368111), clip-1...; empty for 0.
    std::string nameOf(SoundNumber sound) const {
        if (sound == 0) return {};
        if (const std::string* const known = names_.find(sound)) return *known;
        return std::string{isClip(sound) ? clipNamePrefix : soundNamePrefix} + std::to_string(sound);
    }

    PartNames parts; ///< names of the parts of a body

    bool operator==(const SoundNames&) const = default;

private:
    NumberedNames names_;
};

} // namespace physvib
