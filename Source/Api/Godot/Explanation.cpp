// SPDX-License-Identifier: MIT
// The table of phrases that are translated, and the search for them.
#include "Api/Godot/Explanation.h"

#include <algorithm>
#include <array>

namespace physvib::godot {
namespace {
struct Phrase {
    std::string_view cPhrase, godotPhrase;
};

constexpr std::string_view addonError = "please report this as an error of the addon"; // not of the scene

// If a phrase begins another one, the longer one comes first.
constexpr std::array phrases{
    Phrase{"report them within a step (physvib_world_begin_step and physvib_world_end_step)", addonError},
    Phrase{"make one for each step of the engine (physvib_world_begin_step and physvib_world_end_step)",
           "wait for a physics tick; a paused scene has none"},
    Phrase{"give physvib_world_begin_step the seconds since the last step", "set Engine.time_scale above 0"},
    Phrase{"nothing has touched, or contacts are not reported (physvib_world_touch)",
           "nothing has touched a felt body: look at collision layers and masks, sleeping and freeze"},
    Phrase{"make several steps of 0.01 s (seconds, not milliseconds)",
           "raise Engine.physics_ticks_per_second"},
    Phrase{"make shorter steps", "raise Engine.physics_ticks_per_second"},
    Phrase{"set mass_kg of the one that moves", "set static_mass_kg of the HapticBody"},
    Phrase{"set approach_m_per_s or impulse_n_s, or call physvib_world_move with each body's motion before "
           "its contacts",
           addonError},
    Phrase{"it must point from a to b (turn it round), and speeds be those before the engine's solver",
           "scripts must set velocities in _physics_process"},
    Phrase{"report metres: divide lengths by the pixels of a metre (100, say)",
           "set metres_per_unit of the world (0.01, say)"},
    Phrase{"call physvib_world_set_body for every body that touches, floors too", addonError},
    Phrase{"is a haptic source: set is_camera of the bodies that are to be felt",
           "is felt: add a HapticBody child to each that is to be, with felt on"},
    Phrase{"set is_muted of the world to false", "set silent of the world to false"},
    Phrase{", in the first settling_s of its time: set it lower", " in its first moments"},
    Phrase{"set frequency_hz and decay_per_s of the haptic source (or its voice to that of what strikes it), "
           "and its mass_kg or static_mass_kg",
           "set frequency_hz and decay_per_s of its HapticMaterial, and static_mass_kg of its HapticBody"},
    Phrase{"than hits_per_step or there is memory for", "than can be told apart"},
    Phrase{
        ", as it is at first: set field_width_m of the world and of the renderer or device to what x spans",
        ": set field_corner and field_size of the world to what bodies span"},
    Phrase{"set field_width_m of the world and of the renderer or device to what x spans",
           "set field_corner and field_size of the world to what bodies span"},
    Phrase{", and reach the output: if nothing is felt, look at amplifier and cables",
           ": nothing is wrong in this scene; look at outputs and level_db of the world, and at the device"},
    Phrase{"No device plays the events: open one, or connect it again",
           "The world has no outputs: add one, such as controllers"},
    Phrase{"Silence is held: end it where it was asked for", "silent of the world is on: set it to false"},
    Phrase{"of a haptic source", "of a felt body"},
    Phrase{"of haptic sources", "of felt bodies"},
    Phrase{"of the haptic source", "of its HapticBody"},
};
} // namespace

std::string translateForGodot(std::string_view sentence) {
    std::string translated;
    while (!sentence.empty()) {
        const auto found = std::ranges::find_if(
            phrases, [&](const Phrase& phrase) { return sentence.starts_with(phrase.cPhrase); });
        const bool isPhrase = found != phrases.end();
        translated += isPhrase ? found->godotPhrase : sentence.substr(0, 1);
        sentence.remove_prefix(isPhrase ? found->cPhrase.size() : 1);
    }
    return translated;
}

} // namespace physvib::godot
