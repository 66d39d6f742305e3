// SPDX-License-Identifier: MIT
// What JavaScript calls the members of the structures of physvib.h. Where they are, the module says.
// Written by Source/Api/bindings.py: change the header, not this.
export const names = {
    physvib_event: { time_ns: 'timeNs', duration_ns: 'durationNs', frequency_hz: 'frequencyHz', decay_per_s: 'decayPerSecond', amplitude: 'amplitude', x_m: 'x',
                     y_m: 'y', impulse_n_s: 'impulse', mass_kg: 'massKg', fixture: 'fixture', other: 'other', kind: 'kind', sound: 'sound', z_m: 'z',
                     part: 'part' },
    physvib_layout: { extent_width_m: 'extentWidth', extent_height_m: 'extentHeight', x_m: 'x', y_m: 'y', count: 'count', z_m: 'z', part: 'part' },
    physvib_renderer_settings: { rate_hz: 'rate', channels: 'channels', law: 'law', limiter: 'limiter', exponent: 'exponent', field_width_m: 'fieldWidth',
                                 field_height_m: 'fieldHeight', layout: 'layout' },
    physvib_renderer_status: { live_modes: 'liveModes', pending: 'pending', frames: 'frames', played: 'played', late: 'late', rejected: 'rejected',
                               refused: 'refused' },
    physvib_world_settings: { is_muted: 'isMuted', hits_per_step: 'hitsPerStep', at_body: 'atBody', drops_hits_of_removed: 'dropsHitsOfRemoved',
                              field_width_m: 'fieldWidth', field_x_m: 'fieldX', field_y_m: 'fieldY', field_radians: 'fieldAngle',
                              normalisation_s_per_m: 'normalisation', hand_mass_kg: 'handMassKg', drive_gain: 'driveGain', threshold_m_per_s: 'threshold',
                              full_scale_impulse_n_s: 'fullScaleImpulse', settling_s: 'settling' },
    physvib_body: { is_camera: 'isSource', voice: 'voice', surface: 'surface', mass_kg: 'massKg', inertia_kg_m2: 'inertia', gravity_scale: 'gravityScale',
                    frequency_hz: 'frequencyHz', decay_per_s: 'decayPerSecond', static_mass_kg: 'staticMassKg', gain: 'gain', hand_mass_kg: 'handMassKg',
                    overtone_hz: 'overtoneHz', overtone_decay_per_s: 'overtoneDecayPerSecond', overtone_amplitude: 'overtoneAmplitude', grain_m: 'grain',
                    roughness: 'roughness', rolling: 'rolling', is_ridged: 'isRidged', device: 'device', part: 'part' },
    physvib_contact: { a: 'a', b: 'b', x_m: 'x', y_m: 'y', normal_x: 'normalX', normal_y: 'normalY', impulse_n_s: 'impulse', tangential_n_s: 'tangential',
                       approach_m_per_s: 'approach', restitution: 'restitution', effective_mass_kg: 'effectiveMassKg', fraction: 'fraction', gap_m: 'gap',
                       gap_fraction: 'gapFraction', along_a_m_per_s: 'alongA', along_b_m_per_s: 'alongB', is_soft: 'isSoft', point_id: 'point',
                       is_impulse_of_pair: 'isImpulseOfPair', z_m: 'z', normal_z: 'normalZ', friction_x_n_s: 'frictionX', friction_y_n_s: 'frictionY',
                       friction_z_n_s: 'frictionZ' },
    physvib_world_counts: { contacts: 'contacts', below_threshold: 'belowThreshold', no_source: 'noSource', unplayable: 'unplayable', muted: 'muted',
                            dropped: 'dropped', events: 'events', threshold_m_per_s: 'threshold' },
    physvib_output_facts: { is_missing: 'isMissing', is_silent: 'isSilent', channels: 'channels', level: 'level', muted_channels: 'mutedChannels', late: 'late',
                            dropped: 'dropped', rejected: 'rejected', renderer: 'renderer', without_part: 'withoutPart' },
};
// End of what bindings.py has written.

/** Numbers of physvib.h that are words here. */
export const words = {
    kind: new Map([['hit', 0], ['roll', 1], ['slide', 2]]),
    voice: new Map([['own', 0], ['other', 1], ['both', 2]]),
    point: new Map([['none', -1], ['place', -2]]),
    isSoft: new Map([['whole', 2]]), // PHYSVIB_SOFT_WHOLE
    fullScaleImpulse: new Map([['automatic', -1]]), // PHYSVIB_AUTOMATIC
};
