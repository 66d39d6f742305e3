// SPDX-License-Identifier: MIT
// State of a plug-in instance, saved as versioned JSON in the host's session. It contains the whole scene, so
// that a session sounds the same after the built-in scenes change.
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

/// Version of the format that is written, and the newest that is read. A new field makes a new version.
/// 2: choices by name, strips, equalisers, editor size; the default controllers of version 1 are dropped. 3:
/// direct mode. 4: parameter `beats`. 5: voice of notes; older states get the default voice.
constexpr int pluginStateVersion = 5;

enum class TransportMode {
    free,          ///< the scene runs whenever the host renders
    restartOnPlay, ///< the scene starts from its seed when the transport starts or jumps; stopped: silent
    inTempo ///< as restartOnPlay, but script and motors start on a beat and run at the host's tempo; a scene
            ///< runs at its own speed at 120 beats per minute
};

// indexed by TransportMode
inline constexpr std::array<std::string_view, 3> transportNames{"free", "restart-on-play", "in-tempo"};

enum class NoteKind {
    strike, ///< plays a material at a place, at once
    push,   ///< applies an impulse to a body of the scene
    spawn   ///< drops a disc of a material at a place
};

// indexed by NoteKind
inline constexpr std::array<std::string_view, 3> noteKindNames{"strike", "push", "spawn"};

/// What one MIDI note does instead of playing the default voice (NoteVoice).
struct NoteRule {
    int note = 0; ///< 0 to 127
    NoteKind kind = NoteKind::strike;
    int material = 0; ///< strike, spawn: index into Scene::materials
    double x = 0.5;   ///< strike, spawn: place in the field, 0 to 1 from its lower left corner
    double y = 0.5;
    std::string object{};      ///< push: name of a body the scene starts with
    Vector atFullVelocity{};   ///< push: N s; spawn: m/s
    double radiusMetres = 0.1; ///< spawn
    bool operator==(const NoteRule&) const = default;
};

/// Pitch of a note without a rule.
enum class NotePitch {
    material, ///< each octave plays one of the scene's materials
    note      ///< the note's own frequency, moved by octaves into the range of touch
};
inline constexpr std::array<std::string_view, 2> notePitchNames{"material", "note"}; // indexed by NotePitch

/// Where a note without a rule is played.
enum class NotePlacement {
    octave,    ///< from left (C) to right (B), at half height
    actuators, ///< on one actuator after the other
    middle     ///< in the middle of the field
};
// indexed by NotePlacement
inline constexpr std::array<std::string_view, 3> notePlacementNames{"octave", "actuators", "middle"};

/// Sound of the notes: all settings apply to notes without a rule; rules that strike use level and velocity.
struct NoteVoice {
    NotePitch pitch = NotePitch::material;
    NotePlacement placement = NotePlacement::octave;
    bool isHeld = false;           ///< with NotePitch::note: sounds until note-off; otherwise it decays
    bool levelsPeak = false;       ///< the loudest actuator has the strike level; otherwise they share it
    double decayPerSecond = 12.0;  ///< with NotePitch::note, if not held
    double releaseSeconds = 0.2;   ///< of a held note, to -60 dB
    double velocityExponent = 1.0; ///< exponent of velocity / 127
    double bendSemitones = 0.0;    ///< range of the pitch wheel; 0: the wheel moves the place
    bool operator==(const NoteVoice&) const = default;
};

/// Limits of a voice's numbers: 1/s, s, exponent, semitones.
struct NoteVoiceLimits {
    static constexpr double minDecayPerSecond = 0.5, maxDecayPerSecond = 200.0, minReleaseSeconds = 0.005,
                            maxReleaseSeconds = 10.0;
    static constexpr double minExponent = 0.1, maxExponent = 10.0, maxSemitones = 96.0;
};

void visitFields(auto& v, FieldsOf<NoteVoice>) {
    using V = NoteVoice;
    using L = NoteVoiceLimits;
    v.field("pitch", &V::pitch, kinds::OneOf{notePitchNames});
    v.field("places", &V::placement, kinds::OneOf{notePlacementNames});
    v.field("held", &V::isHeld, kinds::boolean);
    v.field("loudest", &V::levelsPeak, kinds::boolean);
    v.field("decay_per_s", &V::decayPerSecond, kinds::range(L::minDecayPerSecond, L::maxDecayPerSecond));
    v.field("release_s", &V::releaseSeconds, kinds::range(L::minReleaseSeconds, L::maxReleaseSeconds));
    v.field("velocity_exponent", &V::velocityExponent, kinds::range(L::minExponent, L::maxExponent));
    v.field("bend_semitones", &V::bendSemitones, kinds::range(0.0, L::maxSemitones));
}

/// Maps a MIDI controller to the whole range of a parameter.
struct ControllerRule {
    int controller = 0;    ///< 0 to 119; higher numbers are channel mode messages
    std::string parameter; ///< parameter id
    bool operator==(const ControllerRule&) const = default;
};

void visitFields(auto& v, FieldsOf<ControllerRule>) {
    v.field("controller", &ControllerRule::controller, kinds::wholeNumber(0, 119));
    v.field("parameter", &ControllerRule::parameter, kinds::text);
}

/// A number in the parameter's unit, or the name of a choice (version 1 wrote its index).
using ParameterValue = std::variant<double, std::string>;
using ParameterValues = std::vector<std::pair<std::string, ParameterValue>>; // by parameter id

struct PluginState {
    Scene scene;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    LayoutDescription layout;
    std::vector<Strip> strips; ///< one per actuator, which plays on the channel of the same number; missing
                               ///< strips are default ones
    EqualisedActuators equalised{}; ///< per actuator
    bool limiterEnabled = true;
    TransportMode transport = TransportMode::free;
    bool isDirect = false; ///< notes are felt after the limiter's latency only, not that of collisions
    NoteVoice voice;
    std::vector<NoteRule> notes; ///< other notes use `voice`
    std::vector<ControllerRule> controllers;
    int editorWidth = 0, editorHeight = 0; ///< in pixels; 0: default size
    ParameterValues parameters;
};

namespace kinds {
struct LayoutFile {}; ///< a layout; errors name it as a file
struct Notes {
    const Scene* scene;
};
} // namespace kinds
struct EditorSize {}; // also a JSON kind

void visitFields(auto& v, FieldsOf<PluginState>) {
    using S = PluginState;
    v.version("physvib_plugin_state", pluginStateVersion);
    v.field("scene", &S::scene, Custom<Scene>{});
    v.field("seed", &S::seed, Custom<std::uint32_t>{});
    v.field("steps_per_second", &S::stepsPerSecond,
            kinds::wholeNumber(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond));
    v.field("layout", &S::layout, kinds::LayoutFile{});
    v.field("strips", &S::strips, kinds::PluginStrips{v.object.layout.geometry.count},
            Need::required.from(2));
    v.field("equalised", &S::equalised, PerChannel<EqualisedActuators>{v.object.layout.geometry.count},
            Need::required.from(2));
    v.field("limiter", &S::limiterEnabled, kinds::boolean);
    v.field("transport", &S::transport, kinds::OneOf{transportNames});
    v.field("direct", &S::isDirect, kinds::boolean, Need::required.from(3));
    v.field("voice", &S::voice, kinds::Object<NoteVoice>{}, Need::required.from(5));
    v.field("notes", &S::notes, kinds::Notes{&v.object.scene});
    v.field("controllers", &S::controllers, Custom<std::vector<ControllerRule>>{});
    v.field("editor_px", memberPair(&S::editorWidth, &S::editorHeight), EditorSize{}, Need::optional.from(2));
    v.field("parameters", &S::parameters, Custom<ParameterValues>{});
}

/// Parses a state; or one line about the first error, such as `name: notes[3].x: expected a number from 0 to
/// 1, found 2`. Parameter and controller ids are not checked. Any thread.
Result<PluginState> readPluginState(std::string_view text, std::string_view name);

/// Writes a state. readPluginState restores it bit for bit, except the scene's variables. Any thread.
std::string pluginStateJson(const PluginState& state);

} // namespace physvib
