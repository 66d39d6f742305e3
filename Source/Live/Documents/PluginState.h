// SPDX-License-Identifier: MIT
// What an instance of the plug-in plays, and as versioned JSON in its host's session: whole in itself, so
// that a session sounds the same when the built-in scenes have changed.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include "Scene/Scene.h"
#include "Scene/World/Simulation.h"
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read. A new field makes a new version.
/// 2: choices by their words; what version 1 gave every instance as controllers is left out; strips,
/// equalisers, the editor's size. 3: direct strikes. 4: the parameter `beats`. 5: the voice of notes; without
/// one they are as they were.
constexpr int pluginStateVersion = 5;

enum class TransportMode {
    free,         ///< the scene runs whenever the host renders
    restartOnPlay ///< it starts at its seed whenever the transport starts or jumps, and is silent while that
                  ///< stands
};

// as TransportMode
inline constexpr std::array<std::string_view, 2> transportNames{"free", "restart-on-play"};

enum class NoteKind {
    strike, ///< sounds a material at a place, at once
    push,   ///< an impulse on a body of the scene
    spawn   ///< drops a disc of a material at a place
};

inline constexpr std::array<std::string_view, 3> noteKindNames{"strike", "push", "spawn"}; // as NoteKind

/// A note that does not do what the default map says.
struct NoteRule {
    int note = 0; ///< 0 to 127
    NoteKind kind = NoteKind::strike;
    int material = 0; ///< strike, spawn: index into Scene::materials
    double x = 0.5;   ///< strike, spawn: place in parts of the field, 0 to 1 from the lower left corner
    double y = 0.5;
    std::string object;        ///< push: name of a body that the scene starts with
    Vector atFullVelocity;     ///< push: N s; spawn: m/s
    double radiusMetres = 0.1; ///< spawn
    bool operator==(const NoteRule&) const = default;
};

/// What a note sounds like that no rule names.
enum class NotePitch {
    material, ///< every octave is one of the scene's materials
    note      ///< its own frequency, in the octave from which it is felt
};
inline constexpr std::array<std::string_view, 2> notePitchNames{"material", "note"}; // as NotePitch

/// Where it is felt.
enum class NotePlaces {
    octave,    ///< from left (C) to right (B), at half height
    actuators, ///< at one actuator after the other
    middle     ///< in the middle of the field
};
// as NotePlaces
inline constexpr std::array<std::string_view, 3> notePlaceNames{"octave", "actuators", "middle"};

/// How notes sound: those without a rule in all of it, struck materials in level and velocity.
struct NoteVoice {
    NotePitch pitch = NotePitch::material;
    NotePlaces places = NotePlaces::octave;
    bool isHeld = false;    ///< with a pitch of its own: it sounds until the key is let go; else it decays
    bool isLoudest = false; ///< the loudest actuator gets the strike level; else they share it
    double decayPerSecond = 12.0;  ///< of a note with a pitch of its own that is not held
    double releaseSeconds = 0.2;   ///< of a held one, to -60 dB
    double velocityExponent = 1.0; ///< of velocity / 127
    double bendSemitones = 0.0;    ///< that a full bend of the wheel moves the pitch; 0: it moves the place
    bool operator==(const NoteVoice&) const = default;
};

/// Limits of the numbers of a voice: 1/s, s, exponent, semitones.
struct NoteVoiceLimits {
    static constexpr double leastDecayPerSecond = 0.5, mostDecayPerSecond = 200.0,
                            leastReleaseSeconds = 0.005, mostReleaseSeconds = 10.0;
    static constexpr double leastExponent = 0.1, mostExponent = 10.0, mostSemitones = 96.0;
};

void visitFields(auto& v, FieldsOf<NoteVoice>) {
    using V = NoteVoice;
    using L = NoteVoiceLimits;
    v.field("pitch", &V::pitch, kinds::OneOf{notePitchNames});
    v.field("places", &V::places, kinds::OneOf{notePlaceNames});
    v.field("held", &V::isHeld, kinds::truth);
    v.field("loudest", &V::isLoudest, kinds::truth);
    v.field("decay_per_s", &V::decayPerSecond, kinds::within(L::leastDecayPerSecond, L::mostDecayPerSecond));
    v.field("release_s", &V::releaseSeconds, kinds::within(L::leastReleaseSeconds, L::mostReleaseSeconds));
    v.field("velocity_exponent", &V::velocityExponent, kinds::within(L::leastExponent, L::mostExponent));
    v.field("bend_semitones", &V::bendSemitones, kinds::within(0.0, L::mostSemitones));
}

/// A controller that moves a parameter over its whole range.
struct ControllerRule {
    int controller = 0;    ///< 0 to 119: the others are channel modes
    std::string parameter; ///< its id
    bool operator==(const ControllerRule&) const = default;
};

void visitFields(auto& v, FieldsOf<ControllerRule>) {
    v.field("controller", &ControllerRule::controller, kinds::whole(0, 119));
    v.field("parameter", &ControllerRule::parameter, kinds::text);
}

/// A number in the parameter's unit; the word of a choice, of which version 1 wrote the place.
using ParameterValue = std::variant<double, std::string>;
using ParameterValues = std::vector<std::pair<std::string, ParameterValue>>; // by their ids

struct PluginState {
    Scene scene;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    LayoutDescription layout;
    std::vector<Strip> strips;      ///< one per enchanter, which leaves by the channel of its number; those
                                    ///< missing are as new ones
    EqualisedActuators equalised{}; ///< per enchanter
    bool limiterEnabled = true;
    TransportMode transport = TransportMode::free;
    bool isDirect = false; ///< strikes by notes are felt the limiter's latency later, not L as collisions are
    NoteVoice voice;
    std::vector<NoteRule> notes; ///< others as the voice says
    std::vector<ControllerRule> controllers;
    int editorWidth = 0, editorHeight = 0; ///< in pixels; 0: as it comes
    ParameterValues parameters;
};

namespace kinds {
struct LayoutFile {}; ///< a layout whose errors name it as a file
struct Notes {
    const Scene* scene;
};
} // namespace kinds
struct EditorSize {}; // a kind as well

void visitFields(auto& v, FieldsOf<PluginState>) {
    using S = PluginState;
    v.version("physvib_plugin_state", pluginStateVersion);
    v.field("scene", &S::scene, Own<Scene>{});
    v.field("seed", &S::seed, Own<std::uint32_t>{});
    v.field("steps_per_second", &S::stepsPerSecond,
            kinds::whole(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond));
    v.field("layout", &S::layout, kinds::LayoutFile{});
    v.field("strips", &S::strips, kinds::PluginStrips{v.object.layout.geometry.count},
            Need::required.from(2));
    v.field("equalised", &S::equalised, PerChannel<EqualisedActuators>{v.object.layout.geometry.count},
            Need::required.from(2));
    v.field("limiter", &S::limiterEnabled, kinds::truth);
    v.field("transport", &S::transport, kinds::OneOf{transportNames});
    v.field("direct", &S::isDirect, kinds::truth, Need::required.from(3));
    v.field("voice", &S::voice, kinds::Object<NoteVoice>{}, Need::required.from(5));
    v.field("notes", &S::notes, kinds::Notes{&v.object.scene});
    v.field("controllers", &S::controllers, Own<std::vector<ControllerRule>>{});
    v.field("editor_px", both(&S::editorWidth, &S::editorHeight), EditorSize{}, Need::optional.from(2));
    v.field("parameters", &S::parameters, Own<ParameterValues>{});
}

/// The state that `text` describes; or, of the first thing that is wrong, one line
/// `name: notes[3].x: expected a number from 0 to 1, found 2`. Parameters and controllers may bear any ids.
/// Any thread.
Result<PluginState> readPluginState(std::string_view text, std::string_view name);

/// `state` as JSON; readPluginState gives all of it back but the scene's variables, bit for bit. Any thread.
std::string pluginStateJson(const PluginState& state);

} // namespace physvib
