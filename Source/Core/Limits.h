// SPDX-License-Identifier: MIT
// All limits of the renderer, each with the reason for its value.
#pragma once
#include <cstdint>

namespace physvib {

namespace limits {
constexpr int maxActuators = 64;        // more actuators than fit on two hands; more channels than any audio
                                        // interface known to us
constexpr int minSampleRateHz = 5000;   // the thesis' vibration rate r_v
constexpr int maxSampleRateHz = 192000; // the fastest common audio interface
constexpr int maxBlockFrames = 8192;    // the largest block a host is known to send
constexpr double maxFrequencyHz = 20000.0; // far above touch (about 1 kHz); recordings are rendered otherwise
constexpr double slowestToneHz = 5.0; // lowest frequency of a sustained tone: below it nothing is felt and a
                                      // coil only grows warm
constexpr double slowDecayPerSecond = 1.0;   // minimum decay of a slower tone: it has fallen by 60 dB in 7 s
constexpr double maxDecayPerSecond = 2000.0; // 0.5 ms: shorter is a click; p^tile stays a float at 5 kHz
constexpr double maxAmplitude = 1.0e6;       // keeps sums of thousands of strikes finite in a float
constexpr double maxLevelDb = 80.0; // gain range of the whole output, plus or minus: beyond it vibrations are
                                    // imperceptible or mask everything else
constexpr std::int64_t maxTimeNs = 100'000'000'000'000'000; // 3.2 years: installations run for months; ten
                                                            // times as long still fits 64 bits
constexpr double retireDecibels = 140.0;        // a mode ends when it has fallen by this much (24-bit floor)
constexpr double stealFadePerSecond = 1000.0;   // a stolen mode falls by 60 dB in 7 ms: no click, soon gone
constexpr double silenceFadePerSecond = 2000.0; // 140 dB in 8 ms: silence within 10 ms, without a click
constexpr double channelRampSeconds = 0.01;     // gains, mutes, detached channels: no click, at once to touch
constexpr double maxChannelDelaySeconds = 0.05; // aligns vibration and sound; more is felt as a second impact
constexpr double limiterLookAheadSeconds = 0.001; // attack of the limiter = its constant latency
constexpr double limiterReleaseSeconds = 0.2; // from silence to full gain: slower than a touch period (20 Hz)

// Limits of one renderer.
constexpr int tileFrames = 64;          // strikes and retirement of modes are aligned to this absolute grid
constexpr int maxModes = 4096;          // distinct (frequency, decay) pairs sounding at once
constexpr int maxFadingModes = 64;      // stolen modes that are fading out
constexpr int maxGates = 4096;          // strikes with a duration that sound at once
constexpr int maxSampleVoices = 64;     // recorded contacts at once: 128 a second of half a second each
constexpr int maxMovingTones = 16;      // moving phantoms at once: more than hands can tell apart
constexpr int maxPending = 8192;        // events ahead of their time: 80 ms at 10^5 events per second
constexpr int maxLookAheadFrames = 192; // 1 ms at 192 kHz
constexpr int maxDelayFrames = 9600;    // maxChannelDelaySeconds at 192 kHz
constexpr int maxControls = 256;        // control changes ahead of their time: a user makes tens per second
constexpr int playedQueueSize = 4096;   // 40 ms at 10^5 events per second until the reader empties it

// The four-channel board: 72 MHz, 12 KB of RAM and 4 KB beside the core. Reasons: Docs/board.md.
namespace board {
constexpr int sampleRateHz = 8000; // 20 samples in a period of the fastest felt vibration (400 Hz); divides
                                   // 72 and 64 MHz
constexpr int channels = 4;        // two dual converters
constexpr int blockFrames = 4;     // 4 frames x 4 channels are the 16 sums that fit in registers
constexpr int maxModes = 128;      // 49 bytes each
constexpr int maxPending = 64;     // the link delivers 720 events a second: this is 88 ms of them
constexpr int gridPerHz = 16; // frequencies and decays are sent in sixteenths of 1 Hz and of 1 per second
constexpr int amplitudeUnit = 4096; // of full scale: amplitudes up to 8, in steps of 1/32 of a converter step
constexpr int amplitudeBits = 12;
constexpr int retireOctaves = 17; // 2^-17 is a thousandth of a step: even 128 tails together stay below one
} // namespace board
} // namespace limits

} // namespace physvib
